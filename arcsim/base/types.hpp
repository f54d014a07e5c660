#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

/// Names of the few linear-algebra types that cross between files. Lengths are metres throughout.
namespace arcsim {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix32d = Eigen::Matrix<double, 3, 2>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Vector9d = Eigen::Matrix<double, 9, 1>;

/// Node (or material vertex) indices of one triangle, counter-clockwise seen from outside.
using Triangle = std::array<int, 3>;

}  // namespace arcsim
