#include "arcsim/material/material_data.hpp"

#include "arcsim/base/json_reader.hpp"

namespace arcsim {
namespace {

/// The first `rows` x `columns` of an array of arrays; rows beyond are ignored, columns must fit.
template <class Store>
void read_rows(const JsonNode& node, int rows, int columns, const char* unit, const char* what, Store&& store) {
    if (node.kind() != JsonKind::array || node.size() < rows)
        node.fail("expected " + std::to_string(rows) + " rows of " + std::to_string(columns) + " numbers (" + unit +
                  "), got " + node.shown() + ". Rows: " + what + ".");
    for (int i = 0; i < rows; ++i) {
        const JsonNode row = node[i];
        if (row.kind() != JsonKind::array || row.size() != columns)
            row.fail("expected " + std::to_string(columns) + " numbers (" + unit + "), got " + row.shown() + ".");
        for (int j = 0; j < columns; ++j) store(i, j, row[j].number(any_number, unit));
    }
}

}  // namespace

MaterialData read_material(const std::filesystem::path& file) { return parse_material(read_json(file)); }

MaterialData parse_material(const JsonDocument& document) {
    const JsonNode root(document);
    if (root.kind() != JsonKind::object) root.fail("expected an object { ... }, got " + root.shown() + ".");
    MaterialData m;
    m.density = root.at("density").number(positive, "kg/m²", "The mass of the cloth per area.");
    read_rows(root.at("stretching"), 6, 4, "N/m", "rest, then fully strained at 0, 22.5, 45, 67.5, 90 degrees",
              [&](int i, int j, double v) { m.stretching[i][j] = v; });
    read_rows(root.at("bending"), 3, 5, "N m", "folds at 0, 45, 90 degrees",
              [&](int i, int j, double v) { m.bending[i][j] = v; });
    return m;
}

}  // namespace arcsim
