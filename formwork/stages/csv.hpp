#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace formwork {

/// Reads our own CSV files: a header line, then rows of equally many cells without quoting.
class CsvFile {
public:
    /// @throws InputError: unreadable, another header than `columns` (more columns may follow), a row of another length
    CsvFile(const std::filesystem::path& file, const std::vector<std::string>& columns);
    int n_columns() const { return n_columns_; }
    int n_rows() const { return static_cast<int>(rows_.size()); }
    double number(int row, int column) const;   ///< @throws InputError naming file and line
    int integer(int row, int column, int low, int high) const;   ///< in [low, high); @throws InputError
    const std::string& text(int row, int column) const { return rows_[row][column]; }

private:
    std::string name_;
    int n_columns_ = 0;
    std::vector<std::vector<std::string>> rows_;
};

/// Builds one: cells are appended, `end_row` ends the line. Numbers read back to the same double.
class CsvText {
public:
    explicit CsvText(const std::string& header) : text_(header + "\n") {}
    CsvText& add(double v);
    CsvText& add(int v);
    CsvText& add(std::string_view v);
    void end_row();
    const std::string& text() const { return text_; }

private:
    void separate();
    std::string text_;
    bool row_begun_ = false;
};

}  // namespace formwork
