#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formwork/study/sweep_plan.hpp"

namespace formwork {

/// A table of text cells with named columns; cells that a row does not have stay empty.
class SweepTable {
public:
    void add_row() { rows_.emplace_back(); }
    void set(const std::string& column, const std::string& value);   // of the last row
    std::string csv() const;                                         // RFC 4180

    std::size_t n_rows() const { return rows_.size(); }
    const std::vector<std::string>& columns() const { return columns_; }
    /// Empty when the row has nothing in that column, or no column has that name.
    std::string cell(std::size_t row, const std::string& column) const;

private:
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> rows_;
};

struct SweepRow {
    const SweepPoint* point;
    std::string status;
    int exit_code;
    double wall_s;
    std::string message;
    std::filesystem::path summary;
};

SweepTable points_table(const std::vector<SweepPoint>& points);

/// One row a point: its number, status, message and overrides, then every number, truth value and short text of its
/// summary.json, named by its path ("inflate.depth_m").
SweepTable results_table(const std::vector<SweepRow>& rows);

}  // namespace formwork
