#include "formwork/study/sweep_table.hpp"

#include <algorithm>

#include "arcsim/base/json_value.hpp"
#include "arcsim/base/text.hpp"

namespace formwork {
namespace {

using arcsim::JsonKind;
using arcsim::JsonValue;

std::string quoted(const std::string& cell) {
    if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
    std::string text = "\"";
    for (char c : cell) {
        if (c == '"') text += '"';
        text += c;
    }
    return text + "\"";
}

void flatten(const JsonValue& v, const std::string& name, SweepTable& table) {
    switch (v.kind) {
        case JsonKind::object:
            for (const auto& [key, member] : v.members) flatten(member, name.empty() ? key : name + "." + key, table);
            break;
        case JsonKind::array:
            // Histories and file lists are not figures; vectors of a few numbers are (a support force, say).
            if (v.items.size() <= 3)
                for (std::size_t i = 0; i < v.items.size(); ++i)
                    if (v.items[i].kind == JsonKind::number) flatten(v.items[i], name + "." + std::to_string(i), table);
            break;
        case JsonKind::number: table.set(name, arcsim::format_number(v.number)); break;
        case JsonKind::boolean: table.set(name, v.boolean ? "true" : "false"); break;
        case JsonKind::string:
            if (v.string.size() <= 40) table.set(name, v.string);
            break;
        default: break;
    }
}

void set_overrides(const SweepPoint& p, SweepTable& table) {
    for (const auto& [key, value] : p.overrides) table.set(key, value);
}

}  // namespace

void SweepTable::set(const std::string& column, const std::string& value) {
    const auto it = std::find(columns_.begin(), columns_.end(), column);
    const auto index = static_cast<std::size_t>(it - columns_.begin());
    if (it == columns_.end()) columns_.push_back(column);
    if (rows_.back().size() <= index) rows_.back().resize(index + 1);
    rows_.back()[index] = value;
}

std::string SweepTable::cell(std::size_t row, const std::string& column) const {
    const auto it = std::find(columns_.begin(), columns_.end(), column);
    const auto index = static_cast<std::size_t>(it - columns_.begin());
    return index < rows_[row].size() ? rows_[row][index] : std::string();
}

std::string SweepTable::csv() const {
    std::string text;
    for (std::size_t i = 0; i < columns_.size(); ++i) text += (i ? "," : "") + quoted(columns_[i]);
    text += '\n';
    for (const auto& row : rows_) {
        for (std::size_t i = 0; i < columns_.size(); ++i)
            text += (i ? "," : "") + (i < row.size() ? quoted(row[i]) : std::string());
        text += '\n';
    }
    return text;
}

SweepTable points_table(const std::vector<SweepPoint>& points) {
    SweepTable table;
    for (const SweepPoint& p : points) {
        table.add_row();
        table.set("point", std::to_string(p.number));
        set_overrides(p, table);
    }
    return table;
}

SweepTable results_table(const std::vector<SweepRow>& rows) {
    SweepTable table;
    for (const SweepRow& row : rows) {
        table.add_row();
        table.set("point", std::to_string(row.point->number));
        table.set("status", row.status);
        table.set("message", row.message);
        table.set("wall_s", row.exit_code < 0 ? "" : arcsim::format_short(row.wall_s, 4));
        set_overrides(*row.point, table);
        if (row.exit_code < 0 || !std::filesystem::exists(row.summary)) continue;
        flatten(arcsim::read_json(row.summary).root, "", table);
    }
    return table;
}

}  // namespace formwork
