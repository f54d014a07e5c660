#include <chrono>
#include <cmath>
#include <sstream>

#include "arcsim/solve/linear_solver.hpp"
#include "formwork/equilibrium/checks.hpp"
#include "formwork/equilibrium/equilibrium.hpp"
#include "formwork/equilibrium/measure.hpp"
#include "formwork/equilibrium/method.hpp"

namespace formwork {
namespace {

constexpr double prestress_part = 0.01;        // Tp = 0.01 T* (tension_field.md 3)
// r = Tp / (0.5 k_max): no Green strain is below -1/2, so that the residual's compression r k e never exceeds Tp and the
// membrane stays convex. (tension_field.md 3 takes 0.25 k at rest; crumpled dry cloth is compressed further than that.)
constexpr double residual_part = 0.5;
constexpr double wrinkles_known_at = 1e-3;     // residual at which the wrinkled region is settled enough to judge
constexpr int most_cap_raises = 6;             // of R each: a head over the rim beyond that is a mistake
constexpr double allowed_part = 0.8;           // of the promised accuracy: the regularisation's effect on depth and volume
constexpr double promised_accuracy = 1e-3;     // when no other is asked for
constexpr double mesh_error_times_vertices = 4.5;   // largest relative error of a bag's volume, times vertices (docs/speed_accuracy)
constexpr double units_are_wrong = 100;        // N = rho g R² / k, STABILITY row 16
constexpr double units_are_doubtful = 3;

std::string number(double v, int digits = 3) {
    std::ostringstream s;
    s.precision(digits);
    s << v;
    return s.str();
}

/// One run: the system, its solver and the phases it goes through.
class Run {
public:
    explicit Run(const EquilibriumProblem& p)
        : p_(p), system_(p), method_(make_method(system_, p)),
          x_(flatten(p.start.empty() ? p.rest.x : p.start)) {}

    EquilibriumResult find() {
        check();
        leave_trivial_branch();
        const bool automatic = system_.membrane().law().is_tension_field() && !p_.material.prestress &&
                               !p_.material.residual && system_.has_load();
        if (automatic) {
            solve_tension_field();
        } else {
            Regulariser r;
            if (system_.membrane().law().is_tension_field())
                r = {p_.material.residual.value_or(0), p_.material.prestress.value_or(0)};
            system_.membrane().law().set_regulariser(r);
            solve_or_throw(p_.solver.tolerance, system_.scales().tension, "final");
        }
        return result(true);
    }

private:
    void check() {
        if (p_.solver.accuracy && mesh_error_times_vertices / p_.rest.n_nodes() > *p_.solver.accuracy)
            warnings_.push_back("accuracy " + number(*p_.solver.accuracy) + ": a mesh of " + std::to_string(p_.rest.n_nodes()) +
                                " vertices is itself good to about " + number(mesh_error_times_vertices / p_.rest.n_nodes(), 1) +
                                " of the volume; refine it to about " +
                                std::to_string(std::lround(mesh_error_times_vertices / *p_.solver.accuracy)) + " vertices");
        const double N = load_number(system_);
        if (N > units_are_wrong)
            throw failure("the load number rho g R² / k is " + number(N) + ": this fabric (k = " +
                          number(system_.membrane().law().rest_stiffness()) + " N/m) cannot hold a bag of half width " +
                          number(system_.scales().radius) + " m. Is the mesh in millimetres or centimetres? Set /formwork/units, "
                          "or check the stiffness (N/m) and the density (kg/m³)");
        if (N > units_are_doubtful)
            warnings_.push_back("load number rho g R² / k = " + number(N) +
                                ": beyond about 8 a fabric of constant stiffness balloons without end; check the units");
        const std::vector<std::string> free = free_motions(p_, system_.has_liquid(), p_.self_weight && p_.fabric_density > 0);
        if (!free.empty()) throw failure(free.front());
    }

    /// A flat sheet at the level of its rim carries no load and has no stiffness out of its plane: an equilibrium, but an
    /// unstable one (STABILITY row 9). Blow it up a little, by the pressure that is to come.
    void leave_trivial_branch() {
        if (!system_.has_load()) return;
        VectorXd g;
        const auto balance = system_.gradient(x_, g);
        const double expected = system_.scales().pressure * system_.scales().area / std::sqrt(double(x_.size()) / 3);
        if (balance.load > 0.05 * expected) return;
        PressureForce blow(p_.rest.faces, p_.up, 0, system_.scales().pressure, PressureQuadrature::consistent,
                           PressureJacobian::none);
        blow.set_orientation(system_.pressure().orientation());
        VectorXd push = VectorXd::Zero(x_.size()), d;
        State s;
        s.x = x_;
        blow.add_gradient(s, push);
        system_.fixed().clear(push);
        BlockMatrix L(system_.pattern());
        system_.add_laplacian(system_.scales().tension, L);
        const auto solver = arcsim::make_linear_solver(arcsim::SolverKind::cholmod);
        solver->analyze(system_.pattern());
        if (!solver->try_factorize(L)) return;
        solver->solve(push, d);
        // As deep as a membrane of this stiffness sags under that pressure, 0.66 R (p R / k)^(1/3) [Hencky 1915].
        const double tension = system_.scales().tension / system_.membrane().law().rest_stiffness();
        const double depth = 0.66 * system_.scales().radius * std::min(1.0, std::cbrt(tension));
        x_ -= depth / d.lpNorm<Eigen::Infinity>() * d;
    }

    void solve_or_throw(double tolerance, double T0, const std::string& phase) {
        outcome_ = method_->solve(x_, tolerance, T0, phase);
        for (int raised = 0; outcome_.ok() && system_.level_is_capped(); ++raised) {
            if (raised == most_cap_raises)
                throw failure("the bag does not hold the volume asked for (" + number(system_.target_volume()) +
                              " m³): its level would stand more than " + number(most_cap_raises * system_.scales().radius) +
                              " m above the rim. Lower /formwork/plaster/fill");
            system_.raise_level_cap();
            outcome_ = method_->solve(x_, tolerance, 0, phase);
        }
        if (!outcome_.ok()) explain_failure();
    }

    void solve_tension_field() {
        MembraneLaw& law = system_.membrane().law();
        const double T = system_.scales().tension;
        const auto regulariser = [&](double Tp) { return Regulariser{std::min(1.0, Tp / (residual_part * law.largest_stiffness())), Tp}; };
        double Tp = prestress_part * T;
        law.set_regulariser(regulariser(Tp));
        solve_or_throw(std::max(wrinkles_known_at, p_.solver.tolerance), T, "prestressed");
        if (count_wrinkles(system_.membrane(), x_).sum() == 0 && finish_without_prestress()) return;
        solve_or_throw(p_.solver.tolerance, 0, "prestressed");

        // Two values give the effect of Tp and r (which is proportional to Tp), and with it how small they have to be.
        Extent before = measure_extent(system_, x_);
        regularisation_ = {Tp, regulariser(Tp).r, 1, 1, before.depth, before.volume};
        for (int round = 0; round < 5; ++round) {
            const double smaller = round == 0 ? 0.25 * Tp : Tp * std::max(0.25, 0.8 * allowed_effect() / worst_effect());
            const VectorXd good = x_;
            const SolveOutcome good_outcome = outcome_;
            law.set_regulariser(regulariser(smaller));
            method_->allow_iterations(p_.solver.max_iterations);
            outcome_ = method_->solve(x_, p_.solver.tolerance, 0, "prestress " + number(smaller));
            if (!outcome_.ok()) {   // less prestress than this mesh needs to be well posed: keep the last good one
                x_ = good;
                outcome_ = good_outcome;
                if (round == 0) estimate_from_above(before, regulariser(2 * Tp));
                law.set_regulariser(regulariser(Tp));
                warnings_.push_back("the prestress could not be lowered below " + number(Tp) +
                                    " N/m; its effect on depth is about " + number(100 * regularisation_.depth_effect) +
                                    " %, on volume " + number(100 * regularisation_.volume_effect) + " %");
                return;
            }
            const Extent now = measure_extent(system_, x_);
            const double d_depth = (before.depth - now.depth) / (Tp - smaller);
            const double d_volume = (before.volume - now.volume) / (Tp - smaller);
            Tp = smaller;
            before = now;
            regularisation_.prestress = Tp;
            regularisation_.residual = regulariser(Tp).r;
            regularisation_.depth_extrapolated_m = now.depth - d_depth * Tp;
            regularisation_.volume_extrapolated_m3 = now.volume - d_volume * Tp;
            regularisation_.depth_effect = std::abs(d_depth) * Tp / std::max(std::abs(now.depth), 1e-300);
            regularisation_.volume_effect = std::abs(d_volume) * Tp / std::max(std::abs(now.volume), 1e-300);
            if (worst_effect() <= allowed_effect()) return;
        }
    }

    /// The effect of Tp from the solution at 2 Tp, where there is none below; x_ stays.
    void estimate_from_above(const Extent& at_Tp, const Regulariser& twice) {
        VectorXd x = x_;
        system_.membrane().law().set_regulariser(twice);
        method_->allow_iterations(p_.solver.max_iterations);
        if (!method_->solve(x, 1e-6, 0, "prestress " + number(twice.Tp)).ok()) return;
        const Extent above = measure_extent(system_, x);
        regularisation_.depth_extrapolated_m = 2 * at_Tp.depth - above.depth;
        regularisation_.volume_extrapolated_m3 = 2 * at_Tp.volume - above.volume;
        regularisation_.depth_effect = std::abs(above.depth - at_Tp.depth) / std::max(std::abs(at_Tp.depth), 1e-300);
        regularisation_.volume_effect = std::abs(above.volume - at_Tp.volume) / std::max(std::abs(at_Tp.volume), 1e-300);
    }

    /// @returns false when wrinkles appear once the prestress is gone; then x_ is where it was
    bool finish_without_prestress() {
        const VectorXd before = x_;
        const Regulariser regulariser = system_.membrane().law().regulariser();
        system_.membrane().law().set_regulariser({});
        outcome_ = method_->solve(x_, p_.solver.tolerance, 0, "final");
        if (outcome_.ok() && count_wrinkles(system_.membrane(), x_).sum() == 0) return true;
        if (!outcome_.ok()) method_->allow_iterations(p_.solver.max_iterations);
        x_ = before;
        system_.membrane().law().set_regulariser(regulariser);
        return false;
    }

    double allowed_effect() const { return allowed_part * p_.solver.accuracy.value_or(promised_accuracy); }
    double worst_effect() const { return std::max(regularisation_.depth_effect, regularisation_.volume_effect); }

    /// Tells ballooning from a solver that lost its way: looks for the largest part of the load that has an equilibrium.
    /// Bounded: three load steps of 40 iterations.
    [[noreturn]] void explain_failure() {
        const double stretch = system_.membrane().stretch_range(x_)[0];
        if (p_.solver.method != SolverMethod::static_newton) {   // load steps would take a method in time too long
            if (outcome_.status == SolveStatus::runaway)
                throw failure("the bag is ballooning, largest stretch " + number(stretch) + " and growing. The fabric is too "
                              "soft for this load: lower the fill, take a stiffer fabric, or check the units");
            throw failure(outcome_.reason + "; largest stretch " + number(stretch));
        }
        const double residual = outcome_.residual;
        double held = 0, failed = 1;
        VectorXd good = flatten(p_.start.empty() ? p_.rest.x : p_.start);
        for (double fraction : {0.5, 0.25, 0.75}) {
            if (fraction <= held || fraction >= failed || !system_.has_load()) continue;
            VectorXd x = good;
            system_.set_load_factor(fraction);
            method_->allow_iterations(40);
            if (method_->solve(x, 1e-4, held > 0 ? 0 : system_.scales().tension, "load factor " + number(fraction)).ok()) {
                held = fraction;
                good = x;
            } else {
                failed = fraction;
            }
        }
        system_.set_load_factor(1);
        x_ = held > 0 ? good : x_;
        std::string text;
        if (outcome_.status == SolveStatus::runaway || stretch > 2.5)
            text = "no equilibrium: the bag is ballooning, largest stretch " + number(stretch) +
                   " and growing; equilibrium was found up to " + number(held) + " of the load, not at " + number(failed) +
                   ". The fabric is too soft for this load: lower the fill, take a stiffer fabric, or check the units";
        else
            text = "no convergence: residual " + number(residual) + " after " + std::to_string(method_->iterations()) +
                   " iterations, largest stretch " + number(stretch) + "; equilibrium was found up to " + number(held) +
                   " of the load. Raise /formwork/inflate/solver/max_iterations, or fill less";
        throw failure(text);
    }

    EquilibriumError failure(const std::string& text) {
        EquilibriumResult last = result(false);
        return EquilibriumError("equilibrium: " + text + ".", last);
    }

    EquilibriumResult result(bool converged) {
        EquilibriumResult r;
        measure(p_, system_, x_, r);
        r.converged = converged;
        r.residual = outcome_.residual;
        r.rounding_floor = outcome_.rounding_floor;
        r.at_rounding_floor = outcome_.status == SolveStatus::rounding_floor;
        r.iterations = method_->iterations();
        r.factorizations = method_->factorizations();
        r.method = arcsim::name_of(solver_method_names, p_.solver.method);
        r.regularisation = regularisation_;
        if (regularisation_.prestress == 0) {
            const Extent e = measure_extent(system_, x_);
            r.regularisation.depth_extrapolated_m = e.depth;
            r.regularisation.volume_extrapolated_m3 = e.volume;
        }
        r.history = method_->history();
        r.times = method_->times();
        r.warnings = warnings_;
        if (r.at_rounding_floor && converged)
            r.warnings.push_back("the residual stopped at " + number(r.residual) + ", where rounding sets a floor of about " +
                                 number(r.rounding_floor) + "; the tolerance of " + number(p_.solver.tolerance) +
                                 " cannot be reached with this stiffness and mesh");
        return r;
    }

    const EquilibriumProblem& p_;
    StaticSystem system_;
    std::unique_ptr<EquilibriumMethod> method_;
    VectorXd x_;
    SolveOutcome outcome_;
    Regularisation regularisation_;
    std::vector<std::string> warnings_;
};

}  // namespace

EquilibriumResult find_equilibrium(const EquilibriumProblem& problem) {
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = arcsim::cpu_seconds();
    Run run(problem);
    EquilibriumResult r = run.find();
    r.cpu_s = arcsim::cpu_seconds() - cpu;
    r.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    return r;
}

}  // namespace formwork
