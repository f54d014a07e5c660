#pragma once

#include <Eigen/SparseCore>

#include "arcsim/base/block_matrix.hpp"

namespace arcsim {

/// Both triangles of A in the pattern's fill order, scalar compressed columns.
/// @param with_skew  add the antisymmetric half
Eigen::SparseMatrix<double> full_matrix(const BlockMatrix& A, bool with_skew);

/// b in the pattern's fill order, and back.
VectorXd to_places(const BlockPattern& p, const VectorXd& b);
VectorXd to_nodes(const BlockPattern& p, const VectorXd& b);

}  // namespace arcsim
