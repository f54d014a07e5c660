#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "arcsim/material/material_data.hpp"

namespace arcsim {

/// How the interpolation between the data rows is evaluated.
enum class Sampling {
    arcsim,  // from a 30^3 grid with trilinear interpolation, as ArcSim; kinks every 1/30 of strain
    exact    // directly
};

/// Stiffness of a strain state and its derivative; G = (G_uu, G_vv, G_uv), G_uv tensor shear.
struct StiffnessSample {
    Stiffness4 k;                        // N/m
    Eigen::Matrix<double, 4, 3> dk_dG;   // N/m
};

/// What becomes of the direction where the principal stretches are equal, and with it has no meaning.
enum class EqualStretches {
    jump,    // as ArcSim, whose grid blurs it over 1/30 of strain
    blend    // its say fades to the mean over all directions: k is continuous
};

/// The rule that both samplings share: with C = 2G + I, its largest eigenvalue l1 and the angle phi of its
/// eigenvector to the u axis, s = (sqrt(l1) - 1) / full_strain in [0, 1], a = phi / 22.5°:
///
///   k(G) = factor * max(0, (1-s) row_0 + s ((1-frac a) row_{1+floor a} + (frac a) row_{2+floor a}))
///
/// jump: with equal eigenvalues and l1 > 1 k depends on the side from which one comes; the derivative drops the angle's
/// part there. A bag has such a place on its bottom and around its wall, where hoop and meridian carry the same: with a
/// stress that jumps, no equilibrium exists there (0.1 % of the load was left on a woven column of 0.9 m).
/// blend: where the smaller principal strain is more than half the larger one, the angle's row fades into the mean of
/// rows 1..5 over all directions; tension along one direction is untouched.
StiffnessSample interpolate_stiffness(const StretchingRows& rows, const Vector3d& G, double full_strain,
                                      double factor, EqualStretches equal = EqualStretches::blend);

/// k(G) of one material. ArcSim multiplies every entry of a material file by 2; `file_factor` is that 2.
class StiffnessTable {
public:
    static constexpr double file_factor = 2;
    static constexpr double full_strain = 1.0 / 6;   // rows 1..5 are reached at a stretch of 1 + 1/6
    static constexpr int n = 30;                     // grid points per axis
    static constexpr double grid_step = 1.0 / 30;    // of strain
    static constexpr double grid_min = -0.25;        // of G_uu and G_vv; G_uv starts at 0

    /// @param multiplier  of the finished table (stretching_mult * thicken)
    StiffnessTable(const StretchingRows& rows, Sampling sampling, double multiplier = 1);

    Sampling sampling() const { return sampling_; }

    /// N/m. The sign of G_uv does not matter.
    Stiffness4 k(const Vector3d& G) const {
        return sampling_ == Sampling::arcsim
                   ? grid_k(G)
                   : interpolate_stiffness(rows_, G, full_strain, file_factor * multiplier_).k;
    }

    /// k and its derivative: one-sided on a grid line, zero beyond the grid.
    StiffnessSample sample(const Vector3d& G) const;

    /// Stiffness at rest as this sampling gives it.
    Stiffness4 rest() const { return k(Vector3d::Zero()); }

private:
    struct Cell {
        int base;       // index of the first corner, in entries of four doubles
        Vector3d t;     // position in the cell, 0..1 (grid ends: just below)
    };
    static Cell locate(const Vector3d& G);
    Stiffness4 grid_k(const Vector3d& G) const;

    StretchingRows rows_;
    Sampling sampling_;
    double multiplier_;
    std::vector<Stiffness4, Eigen::aligned_allocator<Stiffness4>> grid_;   // [(i n + j) n + k], uu, vv, uv
};

inline StiffnessTable::Cell StiffnessTable::locate(const Vector3d& G) {
    // Just below the last point, as ArcSim, so that the cell to the right of it is never asked for.
    static constexpr double last = n - 1 - 1e-5;
    // The order of the arguments of max sends NaN to 0, so that a failed state stays inside the table.
    const auto inside = [](double g) { return std::min(std::max(0.0, g), last); };
    const Vector3d c(inside((G[0] - grid_min) * n), inside((G[1] - grid_min) * n), inside(std::abs(G[2]) * n));
    const int i = static_cast<int>(c[0]), j = static_cast<int>(c[1]), k = static_cast<int>(c[2]);
    return {(i * n + j) * n + k, {c[0] - i, c[1] - j, c[2] - k}};
}

inline Stiffness4 StiffnessTable::grid_k(const Vector3d& G) const {
    const Cell c = locate(G);
    const Stiffness4* p = grid_.data() + c.base;
    const auto along_uv = [&](int offset) -> Stiffness4 {
        return p[offset] + c.t[2] * (p[offset + 1] - p[offset]);
    };
    const Stiffness4 low = along_uv(0) + c.t[1] * (along_uv(n) - along_uv(0));
    const Stiffness4 high = along_uv(n * n) + c.t[1] * (along_uv(n * n + n) - along_uv(n * n));
    return low + c.t[0] * (high - low);
}

}  // namespace arcsim
