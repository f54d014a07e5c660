#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "formwork/strain/strain_field.hpp"

namespace formwork {

using arcsim::Surface;

/// Numbers on the nodes or faces of a surface: `components` of them (1 or 3) per place, one place
/// after the other.
struct VtuArray {
    std::string name;
    int components = 1;
    std::vector<double> values;
};

/// A triangle mesh as VTK XML unstructured grid (.vtu), compressed binary appended: nodes in double
/// precision, fields in single precision. ParaView and VTK read it.
/// @throws std::invalid_argument  an array does not fit (our own error)      @throws
/// arcsim::InputError  cannot write
void write_vtu(const std::filesystem::path& path, const Surface& surface,
               const std::vector<VtuArray>& node_data, const std::vector<VtuArray>& face_data);

/// The list of a series for ParaView's time slider: (time in s, file beside the list).
void write_pvd(const std::filesystem::path& path,
               const std::vector<std::pair<double, std::string>>& frames);

/// Everything a strain field holds, one array each: lambda1, lambda2, direction,
/// direction_deformed, eps_uu, eps_vv, eps_uv, tension1, tension2 (N/m), state (0 taut, 1 wrinkled,
/// 2 slack).
std::vector<VtuArray> strain_arrays(const StrainField& strain);

VtuArray vector_array(std::string name, const std::vector<arcsim::Vector3d>& v);
VtuArray integer_array(std::string name,
                       const std::vector<int>& v);  // shown as numbers, for example panels

}  // namespace formwork
