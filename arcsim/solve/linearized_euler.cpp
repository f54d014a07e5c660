#include <algorithm>
#include <cmath>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/solve/cloth_stepper.hpp"

namespace arcsim {

void ClothStepper::check_state(const VectorXd& x, double max_stretch) {
    const auto [face, stretch] = system_.model().stretch->largest_stretch(x);
    if (face < 0 || stretch <= max_stretch) return;
    throw NumericalError("face " + std::to_string(face) + " is stretched " + format_short(stretch) +
                         " times (limit " + format_short(max_stretch) + ": /solver/max_stretch)");
}

std::string ClothStepper::place_of(int node) const {
    const auto& faces = system_.model().faces;
    const auto at = std::find_if(faces.begin(), faces.end(), [&](const Triangle& t) { return std::find(t.begin(), t.end(), node) != t.end(); });
    return "node " + std::to_string(node) + (at == faces.end() ? "" : " (face " + std::to_string(at - faces.begin()) + ")");
}

void ClothStepper::restart() {
    if (auto& limits = system_.model().limits) limits->set_multipliers({});
}

std::vector<double> ClothStepper::memory() const {
    std::vector<double> memory;
    if (const auto& limits = system_.model().limits) memory = limits->multipliers();
    const std::vector<double> own = own_memory();
    memory.insert(memory.end(), own.begin(), own.end());
    return memory;
}

void ClothStepper::set_memory(const std::vector<double>& memory) {
    const auto& limits = system_.model().limits;
    const std::size_t n = limits ? std::min(limits->n_multipliers(), memory.size()) : 0;
    if (limits) limits->set_multipliers({memory.begin(), memory.begin() + static_cast<std::ptrdiff_t>(n)});
    set_own_memory({memory.begin() + static_cast<std::ptrdiff_t>(n), memory.end()});
}

void LinearizedEuler::restart() {
    ClothStepper::restart();
    previous_v_.resize(0);
}

void LinearizedEuler::set_own_memory(const std::vector<double>& memory) {
    previous_v_ = Eigen::Map<const VectorXd>(memory.data(), static_cast<Eigen::Index>(memory.size()));
}

StepResult LinearizedEuler::step(State& s, double h) {
    ClothModel& model = system_.model();
    BlockMatrix& A = system_.matrix();
    const double t0 = cpu_seconds();
    f_.setZero(s.x.size());
    model.gravity->add_gradient(s, f_);
    model.wind->add_gradient(s, f_);
    f_ = -f_;
    A.set_zero();
    model.stretch->add_step(s, h, f_, A);
    model.bend->add_step(s, h, f_, A);
    model.springs.add_step(s, h, f_, A);
    system_.add_mass(A);
    b_.resize(s.x.size());
    for (int i = 0; i < model.n_nodes(); ++i)
        b_.segment<3>(3 * i) = model.mass[i] * s.v.segment<3>(3 * i) + h * f_.segment<3>(3 * i);
    held_velocity_.clear();
    for (const HeldNode& n : model.held) held_velocity_.push_back((n.target - s.x.segment<3>(3 * n.node)) / h);
    system_.hold(A, b_, model.held, held_velocity_);
    const double t1 = cpu_seconds();

    LinearSolver& solver = system_.solver();
    if (!solver.try_factorize(A))
        throw NumericalError("the step's matrix is not positive definite at " + place_of(solver.breakdown().node) +
                             ": a material has k_uv² > k_uu k_vv, or a face is inverted");
    const double t2 = cpu_seconds();
    v_ = previous_v_.size() == s.v.size() ? VectorXd(2 * s.v - previous_v_) : s.v;   // a guess: the acceleration goes on
    solver.improve(b_, v_);
    const double t3 = cpu_seconds();

    if (!v_.allFinite()) {
        const auto bad = std::find_if(v_.begin(), v_.end(), [](double c) { return !std::isfinite(c); });
        throw NumericalError("the step gave velocities that are not finite at " + place_of(static_cast<int>((bad - v_.begin()) / 3)));
    }
    x_ = s.x + h * v_;
    if (projection_) {
        try {
            projection_->apply(A, h, x_, v_);
        } catch (const NumericalError&) {
            restart();
            throw;
        }
    }
    const double t4 = cpu_seconds();
    if (params_.max_stretch) check_state(x_, *params_.max_stretch);
    model.refresh_after_step(s.x);
    previous_v_ = s.v;
    s.v = v_;
    s.x.swap(x_);
    cost_.assembly += t1 - t0;
    cost_.factor += t2 - t1;
    cost_.solve += t3 - t2;
    cost_.limits += t4 - t3;
    cost_.rest += cpu_seconds() - t4;
    ++cost_.steps;
    ++cost_.factorizations;
    return {};
}

}  // namespace arcsim
