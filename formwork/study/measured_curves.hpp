#pragma once

#include <filesystem>
#include <vector>

namespace formwork {

/// One tensile test: force against displacement of a strip cut at one angle.
struct MeasuredCurve {
    double angle_deg = 0;
    std::vector<double> displacement_mm, force_N;   // in the order of the file
    std::vector<double> time_s{};                   // as measured; empty when the file has no such column
};

/// Reads angle_deg,displacement_mm,force_N[,time_s]; further columns and lines that begin with # are skipped; rows of one
/// angle make one curve.
/// @throws InputError naming file and line: another header, not a number, displacements or times of a curve that
/// go back
std::vector<MeasuredCurve> read_measured_curves(const std::filesystem::path& file);

}  // namespace formwork
