#pragma once

#include <vector>

#include "formwork/segment/cut_mesh.hpp"
#include "formwork/segment/spectral_split.hpp"

namespace formwork {

/// Developability as the source tests it (§8): a panel whose energy (15) is above the threshold is split
/// (split_faces), worst first, until none is, or `max_panels` are reached. The borders follow edges of the
/// mesh. A split that would leave a part with a hole is not made.
/// @param cut     its seams are extended
/// @param panel   per face, 0 .. n_panels - 1; renewed
/// @return number of splits made
int split_by_covariance(CutMesh& cut, std::vector<int>& panel, int& n_panels, double max_energy, int max_panels,
                        const SplitParams& params);

/// The same for a finished segmentation: panels and seams are renewed, and each panel that stays above the
/// threshold is added to the violations.
int split_by_covariance(Segmentation& s, double max_energy, int max_panels, const SplitParams& params);

/// Energy (15) of each panel.
std::vector<double> panel_energies(const Segmentation& s);

}  // namespace formwork
