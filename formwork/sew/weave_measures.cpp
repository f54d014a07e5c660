#include "formwork/sew/weave_measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "formwork/fabric/membrane_law.hpp"

namespace formwork {
namespace {

/// Principal tensions per rest width: the singular values of P = F S have the squares of the eigenvalues of S C S.
double largest_tension(const Vector3d& S, const Vector3d& eps) {
    arcsim::Matrix2d s, C;
    s << S[0], S[2], S[2], S[1];
    C << 1 + 2 * eps[0], 2 * eps[2], 2 * eps[2], 1 + 2 * eps[1];
    const arcsim::Matrix2d Q = s * C * s;
    const double mean = 0.5 * (Q(0, 0) + Q(1, 1)), radius = std::hypot(0.5 * (Q(0, 0) - Q(1, 1)), 0.5 * (Q(0, 1) + Q(1, 0)));
    return std::sqrt(std::max(mean + radius, 0.0));
}

FaceWeave weave_of(const FaceStrain& f, const MembraneLaw& law) {
    const Vector3d eps(f.eps_uu, f.eps_vv, f.eps_uv);
    const Vector3d S = evaluate_one(law, eps, Want::stress).S;
    FaceWeave w;
    w.stretch_warp = std::sqrt(std::max(1 + 2 * f.eps_uu, 0.0));
    w.stretch_weft = std::sqrt(std::max(1 + 2 * f.eps_vv, 0.0));
    w.cos_angle = 2 * f.eps_uv / std::max(w.stretch_warp * w.stretch_weft, 1e-12);
    w.tension_warp = w.stretch_warp * S[0];
    w.tension_weft = w.stretch_weft * S[1];
    w.tension_max = largest_tension(S, eps);
    w.fabric_shear = law.fabric_strain(eps)[2];
    return w;
}

}  // namespace

Spread spread(const std::vector<double>& value, const std::vector<double>& weight) {
    Spread s;
    if (value.empty()) return s;
    std::vector<int> order(value.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return value[a] < value[b]; });
    const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
    s.min = value[order.front()];
    s.p95 = s.max = value[order.back()];
    double below = 0;
    bool found = false;
    for (int i : order) {
        s.mean += weight[i] * value[i] / total;
        below += weight[i];
        if (!found && below >= 0.95 * total) s.p95 = value[i], found = true;
    }
    return s;
}

WeaveMeasures measure_weave(const EquilibriumResult& result, const MaterialParams& material, const std::vector<double>& area,
                            const std::optional<double>& strength) {
    const std::unique_ptr<MembraneLaw> law = make_membrane_law(material);
    WeaveMeasures m;
    std::vector<double> shear, fabric_shear, warp, weft, cosine, tension;
    double taut_area = 0;
    m.angle_histogram.assign(n_angle_bins, 0.0);
    const double total = std::accumulate(area.begin(), area.end(), 0.0);
    for (size_t f = 0; f < result.strain.size(); ++f) {
        const FaceStrain& e = result.strain[f];
        m.face.push_back(weave_of(e, *law));
        shear.push_back(std::abs(e.eps_uv));
        fabric_shear.push_back(std::abs(m.face.back().fabric_shear));
        warp.push_back(e.eps_uu);
        weft.push_back(e.eps_vv);
        cosine.push_back(m.face.back().cos_angle);
        tension.push_back(m.face.back().tension_max);
        if (e.state == FaceState::taut) {
            taut_area += area[f];
            m.taut_mean_abs_shear += area[f] * shear.back();
        }
        const double off = std::asin(std::clamp(std::abs(cosine.back()), 0.0, 1.0)) * 180 / std::numbers::pi;
        m.angle_histogram[std::min(static_cast<int>(off / angle_bin_deg), n_angle_bins - 1)] += area[f] / total;
    }
    m.abs_shear = spread(shear, area);
    m.fabric_abs_shear = spread(fabric_shear, area);
    m.eps_warp = spread(warp, area);
    m.eps_weft = spread(weft, area);
    m.cos_angle = spread(cosine, area);
    m.tension = spread(tension, area);
    if (taut_area > 0) m.taut_mean_abs_shear /= taut_area;
    m.taut_share = total > 0 ? taut_area / total : 0;
    if (strength) m.utilisation = m.tension.max / *strength;
    return m;
}

}  // namespace formwork
