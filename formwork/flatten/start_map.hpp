#pragma once

#include <Eigen/CholmodSupport>
#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "formwork/flatten/isometry_energy.hpp"

namespace formwork {

using arcsim::Matrix2d;
using arcsim::Triangle;
using arcsim::Vector2d;
using arcsim::VectorXd;

using FlatteningSolver = Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower>;

/// Least squares conformal map of a disk: two boundary vertices far from each other are pinned, the
/// conformal energy E_D(u) - A(u) is minimised over the rest [Levy et al. 2002]. It may turn faces over.
/// @param outline  boundary vertices, counter-clockwise
/// @param energy   of the same disk
/// @param solver   is left with the analysis of the energy's pattern, which serves every Newton step after
/// @returns 2n coordinates; zeros when the map does not exist
VectorXd conformal_map(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes, const std::vector<int>& outline,
                       int n, const IsometryEnergy& energy, FlatteningSolver& solver);

enum class TutteWeights { mean_value, uniform };   // uniform: for slivers that mean value weights cannot resolve

/// Convex combination map onto a circle, the outline by arc length. No face turns over in exact arithmetic
/// since all weights are positive [Tutte 1963; Floater 2003].
VectorXd circle_map(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                    const std::vector<int>& outline, int n, TutteWeights weights);

}  // namespace formwork
