#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "arcsim/mesh/surface.hpp"

namespace formwork {

/// How far two shapes lie apart, m.
struct FileComparison {
    std::string name;          // of the file
    bool same_mesh = false;    // same faces: rms and max are between equal vertices; else to the nearest point
    double rms = 0, max = 0;
    double hausdorff = 0;      // larger of the two one-sided distances from vertices to the other surface
};
FileComparison compare_surfaces(const arcsim::Surface& a, const arcsim::Surface& b);

/// Two OBJ files, or all OBJ files of the same name in two folders: of ours (inflate/, segment/, panels/, sew/) or of ArcSim
/// (FFFF_CC.obj).
/// @throws InputError: unreadable, a file and a folder, no file in common
std::vector<FileComparison> compare_results(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace formwork
