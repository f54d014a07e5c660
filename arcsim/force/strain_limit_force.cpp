#include "arcsim/force/strain_limit_force.hpp"

#include <algorithm>
#include <cmath>

#include "arcsim/force/strain_limit_element.hpp"

namespace arcsim {
namespace {

Vector3d as_vector(const stretch::Strain<double>& G) { return {G.uu, G.vv, G.uv}; }

stretch::Stress<double> as_stress(const Vector3d& S) { return {S[0], S[1], S[2]}; }

double green_strain(double stretch) { return 0.5 * (stretch * stretch - 1); }

}  // namespace

StrainLimitForce::StrainLimitForce(std::vector<LimitedFace> faces) {
    for (LimitedFace& f : faces) {
        if (f.face.area <= 0) continue;
        const double lower = f.smallest > 0 ? green_strain(f.smallest) : -std::numeric_limits<double>::infinity();
        faces_.push_back({f, lower, green_strain(f.largest), {}, {}});
        faces_.back().lambda_max.setZero();
        faces_.back().lambda_min.setZero();
    }
}

Vector3d StrainLimitForce::trial_max(const Item& f, const Vector3d& G) const {
    if (!std::isfinite(f.g_max)) return Vector3d::Zero();
    return f.lambda_max + mu_ * (G - f.g_max * Vector3d(1, 1, 0));
}

Vector3d StrainLimitForce::trial_min(const Item& f, const Vector3d& G) const {
    if (!std::isfinite(f.g_min)) return Vector3d::Zero();
    return f.lambda_min + mu_ * (f.g_min * Vector3d(1, 1, 0) - G);
}

std::optional<double> StrainLimitForce::energy(const State& s) const {
    double energy = 0;
    for (const Item& f : faces_) {
        const Vector3d G = as_vector(strain_of(f.limit.face, s.x));
        for (const auto& [trial, lambda] : {std::pair(trial_max(f, G), f.lambda_max), std::pair(trial_min(f, G), f.lambda_min)}) {
            const double now = limit::squared_norm(limit::positive_part_of(trial).value);
            energy += f.limit.face.area * (now - limit::squared_norm(lambda)) / (2 * mu_);
        }
    }
    return energy;
}

void StrainLimitForce::add_gradient(const State& s, VectorXd& g) const {
    for (const Item& f : faces_) {
        const auto strain = strain_of(f.limit.face, s.x);
        const Vector3d G = as_vector(strain);
        const Vector3d S = limit::positive_part_of(trial_max(f, G)).value - limit::positive_part_of(trial_min(f, G)).value;
        if (S.isZero(0)) continue;
        double g1[3], g2[3];
        stretch::gradient(stretch::shape_of(f.limit.face.D_inverse), strain, as_stress(S), f.limit.face.area, g1, g2);
        const Triangle& node = f.limit.face.node;
        for (int c = 0; c < 3; ++c) {
            g[3 * node[0] + c] -= g1[c] + g2[c];
            g[3 * node[1] + c] += g1[c];
            g[3 * node[2] + c] += g2[c];
        }
    }
}

void StrainLimitForce::add_hessian(const State& s, Tangent t, BlockMatrix& H) const {
    const BlockPattern& pattern = H.pattern();
    for (const Item& f : faces_) {
        const auto strain = strain_of(f.limit.face, s.x);
        const Vector3d G = as_vector(strain);
        const auto upper = limit::positive_part_of(trial_max(f, G)), lower = limit::positive_part_of(trial_min(f, G));
        const Matrix3d D = mu_ * (upper.derivative + lower.derivative);
        if (D.isZero(0)) continue;
        const Vector3d S = t == Tangent::exact ? Vector3d(upper.value - lower.value) : upper.value;
        const StretchFace& face = f.limit.face;
        const Matrix9d B = stretch::exact_hessian(stretch::shape_of(face.D_inverse), strain, as_stress(S), D, face.area);
        for (int i = 0; i < 3; ++i) {
            H.add_diagonal(face.node[i], B.block<3, 3>(3 * i, 3 * i));
            const int j = (i + 1) % 3;
            H.add(pattern.slot(face.node[i], face.node[j]), B.block<3, 3>(3 * i, 3 * j), B.block<3, 3>(3 * j, 3 * i));
        }
    }
}

double StrainLimitForce::update(const VectorXd& x) {
    double largest = 0;
    for (Item& f : faces_) {
        const Vector3d G = as_vector(strain_of(f.limit.face, x));
        const Vector3d upper = limit::positive_part_of(trial_max(f, G)).value, lower = limit::positive_part_of(trial_min(f, G)).value;
        largest = std::max({largest, limit::squared_norm(upper - f.lambda_max), limit::squared_norm(lower - f.lambda_min)});
        f.lambda_max = upper;
        f.lambda_min = lower;
    }
    return std::sqrt(largest) / mu_;
}

bool StrainLimitForce::is_idle(const VectorXd& x) const {
    return worst(x).beyond <= 0 && std::all_of(faces_.begin(), faces_.end(), [](const Item& f) {
               return f.lambda_max.isZero(0) && f.lambda_min.isZero(0);
           });
}

StrainLimitForce::Excess StrainLimitForce::worst(const VectorXd& x) const {
    Excess excess;
    for (const Item& f : faces_) {
        const auto G = strain_of(f.limit.face, x);
        const double mean = 1 + G.uu + G.vv, half = std::hypot(G.uu - G.vv, 2 * G.uv);   // of C
        const double most = std::sqrt(mean + half), least = std::sqrt(std::max(mean - half, 0.0));
        if (most - f.limit.largest > excess.beyond) excess = {f.limit.number, most, most - f.limit.largest};
        if (f.limit.smallest - least > excess.beyond) excess = {f.limit.number, least, f.limit.smallest - least};
    }
    return excess;
}

std::vector<double> StrainLimitForce::multipliers() const {
    std::vector<double> values;
    values.reserve(n_multipliers());
    for (const Item& f : faces_)
        for (const Vector3d& lambda : {f.lambda_max, f.lambda_min}) values.insert(values.end(), lambda.begin(), lambda.end());
    return values;
}

void StrainLimitForce::set_multipliers(const std::vector<double>& values) {
    const bool fits = values.size() == n_multipliers();
    for (std::size_t i = 0; i < faces_.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            faces_[i].lambda_max[c] = fits ? values[6 * i + c] : 0;
            faces_[i].lambda_min[c] = fits ? values[6 * i + 3 + c] : 0;
        }
}

}  // namespace arcsim
