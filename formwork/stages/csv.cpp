#include "formwork/stages/csv.hpp"

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"

namespace formwork {

using arcsim::InputError;

namespace {

std::vector<std::string> cells(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    std::vector<std::string> out;
    for (std::size_t at = 0; at <= line.size();) {
        const std::size_t end = std::min(line.find(',', at), line.size());
        std::string_view cell = line.substr(at, end - at);
        while (cell.starts_with(' ')) cell.remove_prefix(1);
        out.emplace_back(cell);
        at = end + 1;
    }
    return out;
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file, const std::vector<std::string>& columns) : name_(file.string()) {
    const std::string text = arcsim::read_text_file(file);
    int line_number = 0;
    std::size_t width = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::vector<std::string> row = cells(std::string_view(text).substr(at, end - at));
        at = end + 1;
        if (++line_number == 1) {
            for (std::size_t k = 0; k < columns.size(); ++k)
                if (k >= row.size() || row[k] != columns[k])
                    throw InputError(name_ + ":1: expected the header \"" + arcsim::join(columns, ",") + "\". Run the stage that writes it again.");
            width = row.size();
        } else {
            if (row.size() != width)
                throw InputError(name_ + ":" + std::to_string(line_number) + ": expected " + std::to_string(width) + " cells, got " +
                                 std::to_string(row.size()) + ". Run the stage that writes it again.");
            rows_.push_back(std::move(row));
        }
    }
    n_columns_ = static_cast<int>(width);
    if (line_number == 0) throw InputError(name_ + ": is empty. Run the stage that writes it again.");
}

double CsvFile::number(int row, int column) const {
    double v = 0;
    if (!arcsim::parse_number(rows_[row][column], v))
        throw InputError(name_ + ":" + std::to_string(row + 2) + ": \"" + rows_[row][column] + "\" is not a number.");
    return v;
}

int CsvFile::integer(int row, int column, int low, int high) const {
    long v = 0;
    if (!arcsim::parse_integer(rows_[row][column], v) || v < low || v >= high)
        throw InputError(name_ + ":" + std::to_string(row + 2) + ": expected a whole number from " + std::to_string(low) + " to " +
                         std::to_string(high - 1) + ", got \"" + rows_[row][column] + "\".");
    return static_cast<int>(v);
}

void CsvText::separate() {
    if (row_begun_) text_ += ',';
    row_begun_ = true;
}
CsvText& CsvText::add(double v) {
    separate();
    text_ += arcsim::format_number(v);
    return *this;
}
CsvText& CsvText::add(int v) {
    separate();
    text_ += std::to_string(v);
    return *this;
}
CsvText& CsvText::add(std::string_view v) {
    separate();
    text_ += v;
    return *this;
}
void CsvText::end_row() {
    text_ += '\n';
    row_begun_ = false;
}

}  // namespace formwork
