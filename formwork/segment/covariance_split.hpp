#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "formwork/segment/cut_mesh.hpp"
#include "formwork/segment/segment.hpp"
#include "formwork/segment/spectral_split.hpp"

namespace formwork {

/// A better border between the two parts of a set of faces: a curve of the cut mesh; nothing: the border along edges stays.
/// @param part   0 or 1 per entry of `faces`
using BetterBorder = std::function<std::optional<Curve>(const CutMesh& cut, const std::vector<int>& faces, const std::vector<int>& part)>;

/// Developability as the source tests it (§8): a panel whose energy (15) is above the threshold is split
/// (split_faces), worst first, until none is, or `max_panels` are reached. Borders follow edges of the mesh unless a
/// better one is found. A split that would leave a part with a hole is not made.
/// @param cut   its seams are extended
/// @return number of splits made
int split_by_covariance(CutMesh& cut, double max_energy, int max_panels, const SplitParams& params, const BetterBorder& better = {});

/// The same for a finished layout of the input. `spectral_stable` replaces the border of two parts by a curve along the
/// field that parts the panel nearly alike and is at most 1.3 times as long, when there is one. Seams are straightened as
/// lay_out does, and each panel that stays above the threshold is added to the violations.
Segmentation split_by_covariance(const Segmentation& layout, const Surface& input, const std::vector<DirectionData>& data,
                                 const SegmentParams& params, double max_energy, const SplitParams& split);

/// Energy (15) of each panel.
std::vector<double> panel_energies(const Segmentation& s);

}  // namespace formwork
