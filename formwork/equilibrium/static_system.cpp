#include "formwork/equilibrium/static_system.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "arcsim/solve/fill_order.hpp"
#include "arcsim/solve/linear_solver.hpp"

namespace formwork {
namespace {

void check_sizes(const EquilibriumProblem& p) {
    using arcsim::InputError;
    const std::size_t n = p.rest.x.size(), m = p.rest.faces.size();
    if (m == 0) throw InputError("equilibrium: the mesh has no faces");
    if (!p.start.empty() && p.start.size() != n)
        throw InputError("equilibrium: the start has " + std::to_string(p.start.size()) + " nodes, the mesh " +
                         std::to_string(n));
    if (!p.flat.empty() && p.flat.size() != m)
        throw InputError("equilibrium: rest coordinates for " + std::to_string(p.flat.size()) + " faces, the mesh has " +
                         std::to_string(m));
    if (!p.fixed.empty() && p.fixed.size() != 3 * n)
        throw InputError("equilibrium: " + std::to_string(p.fixed.size()) + " hold flags for " + std::to_string(3 * n) +
                         " degrees of freedom");
}

/// Nodes without faces take part in nothing: held where they are.
std::vector<char> hold_flags(const EquilibriumProblem& p) {
    std::vector<char> held = p.fixed.empty() ? std::vector<char>(3 * p.rest.x.size(), 0) : p.fixed;
    std::vector<char> used(p.rest.x.size(), 0);
    for (const Triangle& t : p.rest.faces)
        for (int c = 0; c < 3; ++c) used[t[c]] = 1;
    for (const SeamSpring& s : p.seams) used[s.i] = used[s.j] = 1;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i]) held[3 * i] = held[3 * i + 1] = held[3 * i + 2] = 1;
    return held;
}

bool has_no_open_edge(const std::vector<Triangle>& faces) {
    std::vector<std::array<int, 2>> edges;
    for (const Triangle& t : faces)
        for (int k = 0; k < 3; ++k) edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); i += 2)
        if (i + 1 == edges.size() || edges[i] != edges[i + 1]) return false;
    return true;
}

/// Mean height of the nodes held in all axes; of any held ones when there are none.
double mean_held_height(const std::vector<char>& fixed, const VectorXd& x, const Vector3d& up) {
    for (int needed : {3, 1}) {
        double sum = 0;
        int n = 0;
        for (int i = 0; 3 * i < static_cast<int>(fixed.size()); ++i)
            if ((fixed[3 * i] != 0) + (fixed[3 * i + 1] != 0) + (fixed[3 * i + 2] != 0) >= needed)
                sum += x.segment<3>(3 * i).dot(up), ++n;
        if (n > 0) return sum / n;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Half widths of the rest shape along its principal axes, ascending: of a uniform box with the same second moments.
Vector3d half_widths(const Surface& s) {
    Vector3d mean = Vector3d::Zero();
    arcsim::Matrix3d second = arcsim::Matrix3d::Zero();
    const double area = total_area(s);
    for (int f = 0; f < s.n_faces(); ++f) {
        const Vector3d c = face_centroid(s, f);
        const double A = face_area(s, f);
        mean += A / area * c;
        second += A / area * c * c.transpose();
    }
    second -= mean * mean.transpose();
    const Vector3d variance = Eigen::SelfAdjointEigenSolver<arcsim::Matrix3d>(second).eigenvalues();
    return (3 * variance.cwiseMax(0)).cwiseSqrt();
}

/// How far a node is from the nearest node that is held against `up`, at most; 0 without such nodes. A sample of both is
/// enough for a scale.
double reach(const Surface& s, const std::vector<char>& fixed, const Vector3d& up) {
    std::vector<int> held;
    for (int i = 0; i < s.n_nodes(); ++i) {
        double hold = 0;
        for (int c = 0; c < 3; ++c) hold += fixed[3 * i + c] ? up[c] * up[c] : 0;
        if (hold > 0.5) held.push_back(i);
    }
    if (held.empty()) return 0;
    const int held_step = 1 + static_cast<int>(held.size()) / 200, node_step = 1 + s.n_nodes() / 2000;
    double farthest = 0;
    for (int i = 0; i < s.n_nodes(); i += node_step) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < held.size(); k += held_step)
            nearest = std::min(nearest, (s.x[i] - s.x[held[k]]).squaredNorm());
        farthest = std::max(farthest, nearest);
    }
    return std::sqrt(farthest);
}

/// Radius that the filled shape's curvature has: of a flat piece, the distance to where it is held; of a bag, its half
/// width across its second largest extent.
double radius_of(const Surface& s, const std::vector<char>& fixed, const Vector3d& up, const Vector3d& widths) {
    const double r = reach(s, fixed, up);
    const bool flat = widths[0] < 0.05 * widths[2];
    if (r == 0) return flat ? widths[1] : std::max(widths[1], 0.05 * widths[2]);
    return flat ? r : std::min(r, widths[1]);
}

}  // namespace

VectorXd flatten(const std::vector<Vector3d>& x) {
    VectorXd v(3 * static_cast<Eigen::Index>(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) v.segment<3>(3 * static_cast<Eigen::Index>(i)) = x[i];
    return v;
}

std::vector<Vector3d> unflatten(const VectorXd& x) {
    std::vector<Vector3d> v(x.size() / 3);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = x.segment<3>(3 * static_cast<Eigen::Index>(i));
    return v;
}

StaticSystem::StaticSystem(const EquilibriumProblem& p) : seams_(p.seams) {
    check_sizes(p);
    const int n = p.rest.n_nodes();
    std::vector<std::array<int, 2>> pairs;
    seams_.list_pairs(pairs);
    const double start = arcsim::cpu_seconds();
    pattern_ = std::make_unique<arcsim::BlockPattern>(n, p.rest.faces, pairs,
                                                      arcsim::fill_order(n, p.rest.faces, pairs));
    ordering_s_ = arcsim::cpu_seconds() - start;
    fixed_ = arcsim::FixedDofs(*pattern_, hold_flags(p));
    membrane_ = std::make_unique<MembraneForce>(p.rest.faces, p.flat.empty() ? rest_in_own_planes(p.rest) : p.flat,
                                                std::shared_ptr<MembraneLaw>(make_membrane_law(p.material)));
    pressure_ = std::make_unique<PressureForce>(p.rest.faces, p.up, p.plaster.density * p.plaster.gravity,
                                                p.plaster.overpressure, p.pressure, p.pressure_jacobian);
    membrane_->bind(*pattern_);
    pressure_->bind(*pattern_);
    seams_.bind(*pattern_);

    is_closed_ = has_no_open_edge(p.rest.faces);
    weight_.setZero(3 * n);
    has_weight_ = p.self_weight && p.fabric_density > 0;
    if (has_weight_)
        for (int f = 0; f < p.rest.n_faces(); ++f)
            for (int c = 0; c < 3; ++c)
                weight_.segment<3>(3 * p.rest.faces[f][c]) -=
                    p.fabric_density * p.plaster.gravity * membrane_->rest_area(f) / 3 * p.up.normalized();

    has_liquid_ = p.plaster.density > 0 && p.plaster.fill.has_value();
    has_load_ = has_liquid_ || p.plaster.overpressure != 0 || has_weight_;
    set_fill(p, flatten(p.start.empty() ? p.rest.x : p.start));
}

void StaticSystem::set_fill(const EquilibriumProblem& p, const VectorXd& start) {
    const VectorXd rest = flatten(p.rest.x);
    const Vector3d d = p.up.normalized();
    rim_height_ = mean_held_height(p.fixed, start, d);
    double lowest = 1e300, highest = -1e300;
    for (const Vector3d& q : p.rest.x) {
        lowest = std::min(lowest, q.dot(d));
        highest = std::max(highest, q.dot(d));
    }
    const double top = std::isfinite(rim_height_) && !is_closed_ ? rim_height_ : highest;
    scales_.area = membrane_->total_rest_area();
    const Vector3d widths = half_widths(p.rest);
    scales_.radius = radius_of(p.rest, fixed_.flags(), d, widths);
    scales_.reach = std::max(scales_.radius, widths[2]);
    double level = std::numeric_limits<double>::quiet_NaN();
    if (has_liquid_) {
        const FillParams& fill = *p.plaster.fill;
        if (fill.level) level = *fill.level;
        if (fill.depth_below_rim) {
            if (!std::isfinite(rim_height_))
                throw arcsim::InputError("/formwork/plaster/fill/depth_below_rim: no node is held, so there is no rim. "
                                         "Hold the rim under /formwork/fixed, or give the level");
            level = rim_height_ - *fill.depth_below_rim;
        }
        // Outward is decided once, on the rest shape.
        pressure_->set_orientation(liquid_orientation(p.rest.faces, rest, d, std::isfinite(level) ? level : top));
        if (fill.volume) target_volume_ = *fill.volume;
        if (fill.fraction) {
            const double capacity = pressure_->totals(rest, top).volume;
            const double size = highest - lowest;
            if (!(capacity > 1e-9 * size * size * size) || size == 0)
                throw arcsim::InputError("/formwork/plaster/fill/fraction: the rest shape encloses no volume, so there is "
                                         "nothing to take a fraction of. Give the volume or the level");
            target_volume_ = *fill.fraction * capacity;
        }
        if (level_is_unknown()) level = top;
        pressure_->set_level(level);
        if (level_is_unknown()) {
            level_cap_ = top + 0.5 * scales_.radius;
            update_level(rest);
        }
    } else {
        pressure_->set_level(-1e300);
    }
    pressure_->set_reference(top);

    const double liquid_level = has_liquid_ ? pressure_->level() : 0;
    // A flat sheet sags by about half its half width; a bag is at least as deep as its rest shape.
    if (has_liquid_)
        scales_.pressure = pressure_->rho_g() * std::max(liquid_level - lowest,
                                                         std::max(0.0, liquid_level - top) + 0.5 * scales_.radius);
    scales_.pressure += std::abs(p.plaster.overpressure);
    if (has_weight_) scales_.pressure = std::max(scales_.pressure, p.fabric_density * p.plaster.gravity);
    scales_.tension = scales_.pressure * scales_.radius;
    if (!has_load_) scales_.tension = 1e-3 * membrane_->law().rest_stiffness();
}

void StaticSystem::set_load_factor(double s) {
    load_factor_ = s;
    pressure_->set_scale(s);
}

void StaticSystem::update_level(const VectorXd& x) {
    if (!level_is_unknown()) return;
    const double level = level_of_volume(*pressure_, x, target_volume_, pressure_->level());
    level_is_capped_ = level > level_cap_;
    pressure_->set_level(std::min(level, level_cap_));
}

StaticSystem::Balance StaticSystem::gradient(const VectorXd& x, VectorXd& g) {
    update_level(x);
    state_.x = x;
    g = -load_factor_ * weight_;
    pressure_->add_gradient(state_, g);
    Balance b;
    const auto free_norm = [&](const VectorXd& v) {
        double sum = 0;
        for (Eigen::Index d = 0; d < v.size(); ++d) sum += fixed_[static_cast<int>(d)] ? 0 : v[d] * v[d];
        return std::sqrt(sum);
    };
    b.load = free_norm(g);
    membrane_->add_gradient(state_, g);
    seams_.add_gradient(state_, g);
    b.residual = free_norm(g);
    if (!has_load_) {
        double sum = 0;
        for (int d : fixed_.list()) sum += g[d] * g[d];
        b.load = std::sqrt(sum);
    }
    return b;
}

double StaticSystem::relative(const Balance& b) const {
    const double expected = has_load_ ? 1e-6 * load_factor_ * scales_.pressure * scales_.area /
                                            std::sqrt(double(state_.x.size()) / 3)
                                      : 1e-300;
    return b.residual / std::max(b.load, expected);
}

void StaticSystem::tangent(const VectorXd& x, double T0, BlockMatrix& H, VectorXd& border, arcsim::Tangent kind) {
    state_.x = x;
    H.set_zero();
    membrane_->add_hessian(state_, kind, H);
    seams_.add_hessian(state_, kind, H);
    pressure_->add_hessian(state_, kind, H);
    if (T0 > 0) membrane_->add_laplacian(T0, H);
    H.fix(fixed_);
    level_border(x, border);
}

void StaticSystem::weighted_tangent(const VectorXd& x, double w_fabric, double w_other, arcsim::Tangent kind, BlockMatrix& H,
                                    VectorXd& border) {
    state_.x = x;
    H.set_zero();
    membrane_->add_hessian(state_, kind, H);
    H.scale(w_fabric / w_other);
    seams_.add_hessian(state_, kind, H);
    pressure_->add_hessian(state_, arcsim::Tangent::exact, H);
    H.scale(w_other);
    level_border(x, border);
    border *= std::sqrt(w_other);
}

/// The rank-one term of the eliminated level.
void StaticSystem::level_border(const VectorXd& x, VectorXd& border) const {
    border.resize(0);
    if (!level_is_unknown() || level_is_capped_) return;
    const double waterplane = pressure_->totals(x, pressure_->level()).waterplane;
    if (!(waterplane > 0)) return;
    pressure_->level_derivative(x, border);
    fixed_.clear(border);
    border /= std::sqrt(pressure_->rho_g() * waterplane);
}

void StaticSystem::add_laplacian(double T0, BlockMatrix& H) const {
    membrane_->add_laplacian(T0, H);
    H.fix(fixed_);
}

void StaticSystem::add_pressure_tangent(BlockMatrix& H) const {
    pressure_->add_hessian(state_, arcsim::Tangent::exact, H);
    H.fix(fixed_);
}

}  // namespace formwork
