#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "arcsim/base/types.hpp"

namespace formwork {

using arcsim::Matrix2d;
using arcsim::Triangle;
using arcsim::Vector2d;
using arcsim::VectorXd;

/// The symmetric Dirichlet energy of a flat triangulation, less its minimum:
///
///   E(u) = sum_f A_f (s1² + s2² + 1/s1² + 1/s2² - 4) / sum_f A_f        [Smith and Schaefer 2015]
///
/// s are the singular values of the map from face f's own shape to the plane. E is infinite as soon as a
/// face loses its area. With `peak` k > 0 a face counts e_f + k e_f² instead of its e_f: faces far from
/// isometric give way first, so that stretch does not pile up at corners and singular nodes.
class IsometryEnergy {
public:
    /// @param shapes  per face, columns: edges 0->1 and 0->2 in the face's plane, m, positive determinant
    /// @param n       number of vertices; u has 2n entries (x0, y0, x1, ...)
    IsometryEnergy(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes, int n, double peak = 0);

    double value(const VectorXd& u) const;

    /// Energy, gradient (2n, 1/m) and positive semidefinite Hessian (lower triangle, 1/m²): each face's
    /// Hessian has its only possibly negative eigenvalue, the rotation's, clamped at zero
    /// [Smith, De Goes and Kim 2019, analytic eigensystems]. `shift` is added to the diagonal.
    double assemble(const VectorXd& u, double shift, VectorXd& gradient, Eigen::SparseMatrix<double>& hessian) const;

    /// Hessian, in the same pattern, of the conformal energy 1/4 sum cot |du|² - area / 2 [Levy et al. 2002], whose kernel
    /// holds the similarities of the plane.
    void assemble_conformal(Eigen::SparseMatrix<double>& hessian) const;

    /// The largest t <= 1 for which u + t du turns no face over, with a margin of 10 %.
    double largest_step(const VectorXd& u, const VectorXd& du) const;

    /// Sum over faces of A ‖F‖² and of A ‖F⁻¹‖²: the uniform scale (b/a)^(1/4) minimises E.
    double best_scale(const VectorXd& u) const;

    /// Mean of the Hessian's diagonal at an isometry, the yardstick of `shift`.
    double diagonal_scale() const { return diagonal_scale_; }

private:
    void find_pattern(int n);
    Matrix2d deformation(const VectorXd& u, int f) const;

    std::vector<Triangle> faces_;
    std::vector<Matrix2d> inverse_;   // of the shapes
    std::vector<double> weight_;      // A_f / sum A
    Eigen::SparseMatrix<double> pattern_;
    std::vector<std::array<int, 21>> slot_;   // of a face's lower triangle in the sparse values
    std::vector<int> diagonal_;
    double diagonal_scale_ = 0;
    double peak_ = 0;
};

}  // namespace formwork
