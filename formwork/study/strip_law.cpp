#include "formwork/study/strip_law.hpp"

#include <algorithm>
#include <cmath>

#include "arcsim/material/stiffness_table.hpp"

namespace formwork {
namespace {

/// The matrix K with S = K G, and dS/dk of each entry in the file's order uu, uv, vv, ss.
Matrix3d stiffness_matrix(const arcsim::Stiffness4& k) {
    Matrix3d K;
    K << k[0], k[1], 0, k[1], k[2], 0, 0, 0, k[3];
    return K;
}
std::array<Vector3d, 4> stress_per_entry(const Vector3d& G) {
    return {Vector3d(G[0], 0, 0), Vector3d(G[1], G[0], 0), Vector3d(0, G[1], 0), Vector3d(0, 0, G[2])};
}

/// Position between the rest row (0) and the strained row (1), and its derivative by G.
struct Stiffening {
    double s;
    Vector3d ds;
};
Stiffening stiffening(const Vector3d& G, double full_strain) {
    const double half = G[0] - G[1], radius = std::hypot(half, 2 * G[2]);
    const double l1 = std::max(1 + G[0] + G[1] + radius, 0.0), root = std::sqrt(l1);
    const double s = (root - 1) / full_strain;
    if (s <= 0 || s >= 1) return {std::clamp(s, 0.0, 1.0), Vector3d::Zero()};
    constexpr double tiny = 1e-12;   // of strain: below it the principal direction is noise
    const double c = radius > tiny ? half / radius : 0, d = radius > tiny ? 2 * G[2] / radius : 0;
    return {s, Vector3d(1 + c, 1 - c, 2 * d) * (0.5 / (root * full_strain))};
}

constexpr double largest_coupling = 0.9;   // of sqrt(k_uu k_vv)

}  // namespace

void TableStripLaw::make_stable(std::vector<double>& p) const {
    for (int row = 0; row < 6; ++row)
        p[4 * row + 1] = std::min(p[4 * row + 1], largest_coupling * std::sqrt(p[4 * row] * p[4 * row + 2]));
}
void IsotropicStripLaw::make_stable(std::vector<double>& p) const {
    for (int row = 0; row < 2; ++row) p[2 * row + 1] = std::min(p[2 * row + 1], largest_coupling * p[2 * row]);
}

TableStripLaw::TableStripLaw(const arcsim::StretchingRows& rows, double factor, double max_stretch)
    : rows_(rows), factor_(factor), full_strain_(max_stretch - 1) {}

StripStress TableStripLaw::stress(const Vector3d& G) const {
    const arcsim::StiffnessSample t = arcsim::interpolate_stiffness(rows_, G, full_strain_, factor_);
    const std::array<Vector3d, 4> e = stress_per_entry(G);
    StripStress r;
    r.D = stiffness_matrix(t.k);
    r.S = r.D * G;
    for (int entry = 0; entry < 4; ++entry) r.D += e[entry] * t.dk_dG.row(entry);
    return r;
}

StressSensitivity TableStripLaw::sensitivity(const Vector3d& G) const {
    // The weight of each row, asked of the same interpolation with unit rows: it cannot drift from it.
    arcsim::StretchingRows low, high;
    for (int row = 0; row < 6; ++row) {
        low[row] = arcsim::Stiffness4::Zero();
        high[row] = arcsim::Stiffness4::Zero();
        (row < 4 ? low[row][row] : high[row][row - 4]) = 1;
    }
    const arcsim::Stiffness4 a = arcsim::interpolate_stiffness(low, G, full_strain_, factor_).k;
    const arcsim::Stiffness4 b = arcsim::interpolate_stiffness(high, G, full_strain_, factor_).k;
    const arcsim::Stiffness4 k = arcsim::interpolate_stiffness(rows_, G, full_strain_, factor_).k;
    const std::array<Vector3d, 4> e = stress_per_entry(G);
    StressSensitivity r;
    for (int row = 0; row < 6; ++row) {
        const double weight = row < 4 ? a[row] : b[row - 4];
        if (weight == 0) continue;
        for (int entry = 0; entry < 4; ++entry) {
            if (k[entry] <= 0) continue;   // cut at zero: this row does not act
            r.parameter.push_back(4 * row + entry);
            r.dS.push_back(weight * e[entry]);
        }
    }
    return r;
}

std::string TableStripLaw::parameter_name(int j) const {
    static const char* rows[] = {"rest", "max_0", "max_22.5", "max_45", "max_67.5", "max_90"};
    static const char* entries[] = {"k_uu", "k_uv", "k_vv", "k_ss"};
    return std::string(rows[j / 4]) + " " + entries[j % 4];
}

std::vector<double> TableStripLaw::parameters() const {
    std::vector<double> p;
    for (const arcsim::Stiffness4& row : rows_) p.insert(p.end(), row.data(), row.data() + 4);
    return p;
}

std::unique_ptr<StripLaw> TableStripLaw::with(const std::vector<double>& p) const {
    arcsim::StretchingRows rows;
    for (int j = 0; j < 24; ++j) rows[j / 4][j % 4] = p[j];
    return std::make_unique<TableStripLaw>(rows, factor_, 1 + full_strain_);
}

IsotropicStripLaw::IsotropicStripLaw(const std::array<double, 4>& p, double factor, double max_stretch)
    : p_(p), factor_(factor), full_strain_(max_stretch - 1) {}

StripStress IsotropicStripLaw::stress(const Vector3d& G) const {
    // With k_ss = k_uu - k_uv the tensor is rotation invariant, and the principal-frame law needs no frame:
    // S = k_uv tr(G) I + (k_uu - k_uv) G.
    const Stiffening t = stiffening(G, full_strain_);
    const double kuu = factor_ * ((1 - t.s) * p_[0] + t.s * p_[2]), kuv = factor_ * ((1 - t.s) * p_[1] + t.s * p_[3]);
    StripStress r;
    r.D = stiffness_matrix({kuu, kuv, kuu, kuu - kuv});
    r.S = r.D * G;
    const double duu = factor_ * (p_[2] - p_[0]), duv = factor_ * (p_[3] - p_[1]);
    r.D += stiffness_matrix({duu, duv, duu, duu - duv}) * G * t.ds.transpose();
    return r;
}

StressSensitivity IsotropicStripLaw::sensitivity(const Vector3d& G) const {
    const double s = stiffening(G, full_strain_).s;
    const Vector3d uu = G, uv = Vector3d(G[1], G[0], -G[2]);
    return {{0, 1, 2, 3},
            {factor_ * (1 - s) * uu, factor_ * (1 - s) * uv, factor_ * s * uu, factor_ * s * uv}};
}

std::string IsotropicStripLaw::parameter_name(int j) const {
    static const char* names[] = {"rest k_uu", "rest k_uv", "max k_uu", "max k_uv"};
    return names[j];
}

std::unique_ptr<StripLaw> IsotropicStripLaw::with(const std::vector<double>& p) const {
    return std::make_unique<IsotropicStripLaw>(std::array<double, 4>{p[0], p[1], p[2], p[3]}, factor_,
                                               1 + full_strain_);
}

}  // namespace formwork
