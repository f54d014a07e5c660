#include "arcsim/solve/converged_stepper.hpp"

#include <cmath>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/solve/limit_rounds.hpp"

namespace arcsim {
namespace {

constexpr double default_max_stretch = 3;   // no cloth reaches it: beyond it a step has failed
constexpr int halvings_before_lu = 6;
constexpr int easy_iterations = 6;      // after a part that took more, the next one is not longer

}  // namespace

ConvergedStepper::ConvergedStepper(ClothModel& model, const StepParams& params, FillOrder order)
    : ClothStepper(model, params, order) {
    is_damped_ = model.stretch->is_damped() || model.bend->is_damped();
    if (is_damped_ || model.wind->acts()) viscous_ = std::make_unique<BlockMatrix>(system_.pattern());
    size_ = model.size;
    model.bend->follow_angle();
    model.wind->follow_normal();
}

StepResult ConvergedStepper::step(State& s, double h) {
    StepResult result;
    result.iterations = 0;
    const State start = s;
    const double begin = s.time - h;
    // Time as a binary fraction of h: `at` parts of h / 2^level are done.
    long at = 0;
    int level = 0;
    while (at < (1L << level)) {
        const double part = h / static_cast<double>(1L << level);
        s.time = begin + (static_cast<double>(at) + 1) * part;
        place_handles(s.time);
        level_ = level;
        const double tried_from = previous_h_;
        const int iterations_before = result.iterations;
        try {
            advance(s, part, result);
            ++at;
            const bool is_easy = result.iterations - iterations_before <= easy_iterations;
            const bool is_done = at == (1L << level);
            while (level > 0 && at % 2 == 0 && (is_easy || is_done)) at /= 2, --level;   // on a coarser grid again
        } catch (const NumericalError& e) {
            if (tried_from > 0 && params_.method == StepMethod::bdf2) {
                restart();                                       // first without the memory, at the same length
                continue;
            }
            if (level == params_.max_halvings) {
                s = start;
                restart();
                throw NumericalError(std::string(e.what()) + ", also with the step halved " +
                                     std::to_string(level) + " times");
            }
            ClothStepper::restart();                             // multipliers of a failed solve lead astray
            ++level;
            at *= 2;
            result.halvings = std::max(result.halvings, level);
        }
    }
    s.time = begin + h;
    ++cost_.steps;
    return result;
}

void ConvergedStepper::advance(State& s, double h, StepResult& result) {
    const bool second_order = params_.method == StepMethod::bdf2 && previous_h_ == h;
    const Problem p = second_order ? Problem{(4 * s.x - previous_x_) / 3, (4 * s.v - previous_v_) / 3, 2 * h / 3}
                                   : Problem{s.x, s.v, h};
    VectorXd v = solve(p, s, result);
    VectorXd x = p.x + p.h * v;
    check_state(x, params_.max_stretch.value_or(default_max_stretch));
    previous_x_ = std::move(s.x);
    previous_v_ = std::move(s.v);
    previous_h_ = h;
    s.x = std::move(x);
    s.v = std::move(v);
}

double ConvergedStepper::residual(const Problem& p, const VectorXd& v, VectorXd& r) {
    ClothModel& model = system_.model();
    trial_.v = v;
    trial_.x = p.x + p.h * v;
    if (!trial_.x.allFinite()) {
        r = VectorXd::Constant(v.size(), INFINITY);
        return 1;
    }
    model.refresh(trial_.x);
    g_.setZero(v.size());
    model.stretch->add_gradient(trial_, g_);
    model.bend->add_gradient(trial_, g_);
    if (model.limits) model.limits->add_gradient(trial_, g_);
    double scale = g_.cwiseAbs().maxCoeff();
    model.gravity->add_gradient(trial_, g_);
    model.wind->add_gradient(trial_, g_);
    model.springs.add_gradient(trial_, g_);
    if (is_damped_) {
        viscous_->set_zero();
        model.stretch->add_damping(trial_, *viscous_);
        model.bend->add_damping(trial_, *viscous_);
        viscous_->multiply_symmetric(v, product_);
        g_ += product_;
    }
    r = p.h * g_;
    for (int i = 0; i < model.n_nodes(); ++i) {
        const Vector3d inertia = model.mass[i] * (v - p.v).segment<3>(3 * i);
        r.segment<3>(3 * i) += inertia;
        scale = std::max(scale, inertia.cwiseAbs().maxCoeff() / p.h);
    }
    for (const HeldNode& n : model.held) r.segment<3>(3 * n.node).setZero();
    return scale;
}

bool ConvergedStepper::factorize(const Problem& p, const VectorXd& v, Direction direction) {
    ClothModel& model = system_.model();
    const double t0 = cpu_seconds();
    trial_.v = v;
    trial_.x = p.x + p.h * v;
    model.refresh(trial_.x);   // the last residual may have been another trial's
    if (direction == Direction::unsymmetric && !lu_) {
        unsymmetric_ = std::make_unique<BlockMatrix>(system_.pattern(), BlockMatrix::Kind::general);
        lu_ = make_linear_solver(SolverKind::umfpack);
    }
    BlockMatrix& A = direction == Direction::unsymmetric ? *unsymmetric_ : system_.matrix();
    const Tangent tangent = direction == Direction::definite ? Tangent::definite : Tangent::exact;
    A.set_zero();
    model.stretch->add_hessian(trial_, tangent, A);
    model.bend->add_hessian(trial_, tangent, A);
    model.springs.add_hessian(trial_, tangent, A);
    model.wind->add_hessian(trial_, tangent, A);
    if (model.limits) model.limits->add_hessian(trial_, tangent, A);
    A.scale(p.h * p.h);
    if (viscous_) {
        viscous_->set_zero();
        if (is_damped_) {
            model.stretch->add_damping(trial_, *viscous_);
            model.bend->add_damping(trial_, *viscous_);
        }
        model.wind->add_velocity_hessian(trial_, *viscous_);
        A.add_scaled(*viscous_, p.h);
    }
    system_.add_mass(A);
    system_.hold(A, model.held);
    const double t1 = cpu_seconds();
    solver_ = direction == Direction::unsymmetric ? lu_.get() : &system_.solver();
    const bool done = solver_->try_factorize(A);
    cost_.assembly += t1 - t0;
    cost_.factor += cpu_seconds() - t1;
    ++cost_.factorizations;
    return done;
}

void ConvergedStepper::correction(const VectorXd& r, VectorXd& dv) {
    const double t0 = cpu_seconds();
    minus_r_ = -r;
    solver_->solve(minus_r_, dv);
    cost_.solve += cpu_seconds() - t0;
}

double ConvergedStepper::mass_norm(const VectorXd& dv) const {
    const VectorXd& mass = const_cast<ConvergedStepper*>(this)->system_.model().mass;
    double sum = 0;
    for (int i = 0; i < mass.size(); ++i) sum += mass[i] * dv.segment<3>(3 * i).squaredNorm();
    return std::sqrt(sum);
}

void ConvergedStepper::fail(const std::string& why, const VectorXd& x) {
    const auto [face, stretch] = system_.model().stretch->largest_stretch(x);
    throw NumericalError(why + "; worst face " + std::to_string(face) + ", stretch " + format_short(stretch));
}

/// Where the iteration of one step stands.
struct ConvergedStepper::Iterate {
    VectorXd v, r;
    double scale = 1;             // of the forces, N
    double move = INFINITY;       // of the last iteration, m
    bool is_at_rounding = false;  // it could not be told from none
};

std::vector<ConvergedStepper::Direction> ConvergedStepper::directions() const {
    if (params_.tangent == StepTangent::definite) return {Direction::definite};
    if (level_ < std::min(halvings_before_lu, params_.max_halvings)) return {Direction::exact, Direction::definite};
    return {Direction::exact, Direction::definite, Direction::unsymmetric};
}

bool ConvergedStepper::try_direction(const Problem& p, Direction direction, Iterate& now) {
    const double rounding_move = 1e-13 * size_;
    if (!factorize(p, now.v, direction)) return false;
    correction(now.r, dv_);
    if (!dv_.allFinite()) return false;
    const double length = mass_norm(dv_);
    for (double alpha = 1; alpha > 1e-3; alpha /= 2) {
        v_next_ = now.v + alpha * dv_;
        const double scale = residual(p, v_next_, r_next_);
        if (!r_next_.allFinite()) continue;
        const double move = alpha * p.h * dv_.cwiseAbs().maxCoeff();
        const bool solved = r_next_.cwiseAbs().maxCoeff() / p.h <= params_.tolerance * scale;
        const bool smaller = r_next_.squaredNorm() <= std::pow(1 - alpha / 4, 2) * now.r.squaredNorm();
        if (!solved && !smaller && move > rounding_move) {
            correction(r_next_, dv_next_);
            if (!(mass_norm(dv_next_) <= (1 - alpha / 4) * length)) continue;
        }
        now.v.swap(v_next_);
        now.r.swap(r_next_);
        now.scale = scale;
        now.move = move;
        now.is_at_rounding = move <= rounding_move;
        return true;
    }
    return false;
}

VectorXd ConvergedStepper::solve(const Problem& p, const State& start, StepResult& result) {
    ClothModel& model = system_.model();
    if (!model.limits) return balance(p, start.v, result);
    LimitRounds rounds(model, p.h);
    VectorXd v = start.v;
    do {
        v = balance(p, std::move(v), result);
    } while (!rounds.are_done(p.x + p.h * v));
    return v;
}

VectorXd ConvergedStepper::balance(const Problem& p, VectorXd v, StepResult& result) {
    Iterate now;
    now.v = std::move(v);
    for (const HeldNode& n : system_.model().held)
        now.v.segment<3>(3 * n.node) = (n.target - p.x.segment<3>(3 * n.node)) / p.h;
    now.scale = residual(p, now.v, now.r);
    const double small_move = 1e-6 * size_;
    for (int iteration = 0; iteration < params_.max_iterations; ++iteration) {
        result.residual = now.r.cwiseAbs().maxCoeff() / p.h / std::max(now.scale, 1e-300);
        if (!std::isfinite(result.residual)) fail("the forces are not finite", p.x);
        const bool solved = result.residual <= params_.tolerance && now.move <= small_move;
        if (now.r.isZero(0) || now.is_at_rounding || solved) return std::move(now.v);
        ++result.iterations;
        bool accepted = false;
        for (const Direction direction : directions()) {
            accepted = try_direction(p, direction, now);
            if (accepted) break;
        }
        if (!accepted)
            fail("no step along Newton's direction helps, residual " + format_short(result.residual), p.x + p.h * now.v);
    }
    fail("no convergence in " + std::to_string(params_.max_iterations) + " iterations, residual " +
             format_short(result.residual), p.x + p.h * now.v);
}

void ConvergedStepper::restart() {
    ClothStepper::restart();
    previous_h_ = 0;
}

std::vector<double> ConvergedStepper::own_memory() const {
    if (params_.method != StepMethod::bdf2 || previous_h_ == 0) return {};
    std::vector<double> m{previous_h_};
    m.insert(m.end(), previous_x_.begin(), previous_x_.end());
    m.insert(m.end(), previous_v_.begin(), previous_v_.end());
    return m;
}

void ConvergedStepper::set_own_memory(const std::vector<double>& m) {
    previous_h_ = 0;
    if (m.empty()) return;
    const auto n = static_cast<Eigen::Index>((m.size() - 1) / 2);
    previous_h_ = m[0];
    previous_x_ = Eigen::Map<const VectorXd>(m.data() + 1, n);
    previous_v_ = Eigen::Map<const VectorXd>(m.data() + 1 + n, n);
}

}  // namespace arcsim
