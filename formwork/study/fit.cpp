#include "formwork/study/fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "arcsim/material/stiffness_table.hpp"
#include "formwork/study/clamped_strip.hpp"

namespace formwork {

using arcsim::MatrixXd;
using arcsim::VectorXd;

namespace {

// In units of the sum of squares. A promise of 1 means that no entry lies further than one of its own standard deviations
// from the minimum of the linearised problem; kinks (a stiffness cut at zero) can keep the rest out of reach.
constexpr double gain_is_nothing = 1e-3, promise_is_nothing = 1;

/// The strips of all angles with the points that are used, and their last equilibria as warm starts.
class Bench {
public:
    Bench(const FitParams& p, const std::vector<MeasuredCurve>& measured) {
        for (const MeasuredCurve& c : measured) {
            Test t{ClampedStrip(make_strip(1e-3 * p.length_mm, 1e-3 * p.width_mm, p.resolution), c.angle_deg * std::numbers::pi / 180), {}};
            std::vector<int> usable;
            for (size_t i = 0; i < c.force_N.size(); ++i)
                if (c.displacement_mm[i] > 0 && (usable.empty() || c.displacement_mm[i] > c.displacement_mm[usable.back()]))
                    usable.push_back(static_cast<int>(i));
            const int n = std::min<int>(p.points_per_curve, static_cast<int>(usable.size()));
            for (int k = 1; k <= n; ++k) {
                const int i = usable[static_cast<size_t>(k) * usable.size() / n - 1];
                points.push_back({c.angle_deg, c.displacement_mm[i], c.force_N[i], 0,
                                  std::hypot(p.noise * c.force_N[i], p.noise_floor_N)});
                t.states.emplace_back();
            }
            tests_.push_back(std::move(t));
        }
        if (points.empty()) throw arcsim::InputError("fit: the measured curves hold no point with a displacement above 0.");
    }

    /// Forces of all points; with `J` also their derivatives. @returns false when a strip has no equilibrium
    bool simulate(const StripLaw& law, VectorXd& force, MatrixXd* J) {
        force.resize(static_cast<int>(points.size()));
        if (J) J->resize(force.size(), law.n_parameters());
        int k = 0;
        try {
            for (Test& t : tests_) {
                StripState before = t.strip.at_rest();
                for (StripState& warm : t.states) {
                    const double target = 1e-3 * points[k].displacement_mm;
                    StripState s = follow(t.strip, law, warm, before, target);
                    force[k] = s.force;
                    if (J) J->row(k) = t.strip.force_sensitivity(law, s).transpose();
                    warm = before = std::move(s);
                    ++k;
                    ++strips;
                }
            }
        } catch (const arcsim::NumericalError&) {
            return false;
        }
        return true;
    }

    std::vector<FittedPoint> points;
    int strips = 0;

private:
    struct Test {
        ClampedStrip strip;
        std::vector<StripState> states;
    };
    static StripState follow(ClampedStrip& strip, const StripLaw& law, const StripState& warm, const StripState& before, double target) {
        if (!warm.x.empty()) {
            try {
                return strip.pull_to(law, warm, target);
            } catch (const arcsim::NumericalError&) {   // the table has changed too much: from the point before
            }
        }
        return strip.pull_to(law, before, target);
    }
    std::vector<Test> tests_;
};

}  // namespace

FitResult fit_table(const FitParams& p, const std::vector<MeasuredCurve>& measured, std::unique_ptr<StripLaw> law,
                    const std::function<void(int, double)>& on_step) {
    Bench bench(p, measured);
    const int n = law->n_parameters(), m = static_cast<int>(bench.points.size());
    const std::vector<double> start = law->parameters();
    VectorXd scale(n), q(n);
    const double floor = 1e-6 * *std::max_element(start.begin(), start.end());
    for (int j = 0; j < n; ++j) scale[j] = std::max(start[j], floor), q[j] = start[j] / scale[j];
    const VectorXd q0 = q;
    const auto table = [&](const VectorXd& v) {
        std::vector<double> entries(n);
        for (int j = 0; j < n; ++j) entries[j] = v[j] * scale[j];
        return law->with(entries);
    };
    VectorXd force;
    MatrixXd J;
    const auto misfit = [&](const VectorXd& F, const VectorXd& v, VectorXd& r) {
        r.resize(m + n);
        for (int i = 0; i < m; ++i) r[i] = (F[i] - bench.points[i].measured_N) / bench.points[i].deviation_N;
        r.tail(n) = (v - q0) / p.prior_width;
        return r.squaredNorm();
    };
    if (!bench.simulate(*table(q), force, &J))
        throw arcsim::NumericalError("fit: the strip has no equilibrium with the starting table. Give another `initial`.");
    VectorXd r;
    double cost = misfit(force, q, r), mu = 1e-3;
    FitResult result;
    MatrixXd normal;
    const auto assemble = [&](MatrixXd& A, VectorXd& gradient) {
        MatrixXd W = J;
        for (int i = 0; i < m; ++i) W.row(i) = J.row(i).cwiseProduct(scale.transpose()) / bench.points[i].deviation_N;
        A = W.transpose() * W;
        A.diagonal().array() += 1 / (p.prior_width * p.prior_width);
        gradient = W.transpose() * r.head(m) + r.tail(n) / p.prior_width;
    };
    // An entry that stands at a bound and would go beyond it: 0, `largest`, or the coupling that a stable fabric has.
    const auto is_held = [&](int j, double slope) {
        if (q[j] <= 0) return slope > 0;
        if (slope >= 0) return false;
        if (q[j] * scale[j] >= p.largest) return true;
        constexpr double a_bit = 1e-3;
        std::vector<double> more(n);
        for (int k = 0; k < n; ++k) more[k] = q[k] * scale[k];
        more[j] *= 1 + a_bit;
        law->make_stable(more);
        return more[j] < (1 + 0.5 * a_bit) * q[j] * scale[j];
    };
    VectorXd gradient;
    for (; result.iterations < p.max_iterations; ++result.iterations) {
        assemble(normal, gradient);
        if (on_step) on_step(result.iterations, cost / m);
        bool accepted = false;
        double gain = 0;
        for (int attempt = 0; attempt < 12 && !accepted; ++attempt) {
            // Entries at a bound that the gradient presses against stay there.
            MatrixXd A = normal;
            VectorXd g = gradient;
            A.diagonal() *= 1 + mu;
            for (int j = 0; j < n; ++j) {
                if (!is_held(j, g[j])) continue;
                A.row(j).setZero();
                A.col(j).setZero();
                A(j, j) = 1;
                g[j] = 0;
            }
            VectorXd trial = q - A.ldlt().solve(g);
            // No entry changes by more than a factor of three at once: far from the solution the slopes mean little. Back to
            // its start it may always go: an entry that the data say nothing about does not stay where an early step threw it.
            std::vector<double> entries(n);
            for (int j = 0; j < n; ++j) {
                const double low = std::min(q[j] / 3 - 0.01, q0[j]), high = std::max(3 * q[j] + 0.1, q0[j]);
                entries[j] = scale[j] * std::clamp(std::clamp(trial[j], low, high), 0.0, p.largest / scale[j]);
            }
            law->make_stable(entries);
            for (int j = 0; j < n; ++j) trial[j] = entries[j] / scale[j];
            VectorXd trial_force, trial_r;
            if (bench.simulate(*table(trial), trial_force, nullptr)) {
                const double trial_cost = misfit(trial_force, trial, trial_r);
                if (trial_cost < cost) {
                    gain = cost - trial_cost;
                    q = trial;
                    accepted = true;
                }
            }
            mu = accepted ? std::max(mu / 5, 1e-12) : 4 * mu;
        }
        if (!accepted) break;
        if (!bench.simulate(*table(q), force, &J)) throw arcsim::NumericalError("fit: a strip lost its equilibrium");
        cost = misfit(force, q, r);
        if (gain < gain_is_nothing) break;
    }
    assemble(normal, gradient);
    // At a minimum even the full Gauss-Newton step of the free entries promises next to nothing.
    std::vector<int> free;
    for (int j = 0; j < n; ++j)
        if (!is_held(j, gradient[j])) free.push_back(j);
    const VectorXd free_gradient = gradient(free);
    const MatrixXd free_normal = normal(free, free);
    const double promised = free_gradient.dot(free_normal.ldlt().solve(free_gradient));
    result.converged = promised < std::max(promise_is_nothing, 1e-2 * cost);
    if (!result.converged)
        throw arcsim::NumericalError("fit: not converged after " + std::to_string(p.max_iterations) + " steps, misfit " +
                                     std::to_string(cost / m) + " times the noise. Raise max_iterations or give a better `initial`.");

    const double data_cost = r.head(m).squaredNorm();
    result.chi2_per_point = data_cost / m;
    MatrixXd covariance = normal.ldlt().solve(MatrixXd::Identity(n, n));
    // Entries that the prior holds use up no data.
    const double used = n - covariance.trace() / (p.prior_width * p.prior_width);
    covariance *= std::max(1.0, data_cost / std::max(1.0, m - used));
    const auto why_not = [&](int j) -> std::string {
        // Known to a third if all others were known? Then others can stand in for it: the one most correlated with it.
        if (std::sqrt(1 / normal(j, j)) > q[j] / 3) return "the forces hardly depend on it";
        int partner = j == 0 ? 1 : 0;
        const auto correlation = [&](int k) { return std::abs(covariance(j, k)) / std::sqrt(covariance(j, j) * covariance(k, k)); };
        for (int k = 0; k < n; ++k)
            if (k != j && correlation(k) > correlation(partner)) partner = k;
        return "cannot be told from " + law->parameter_name(partner);
    };
    for (int j = 0; j < n; ++j) {
        FittedEntry e;
        e.name = law->parameter_name(j);
        e.value = q[j] * scale[j];
        e.start = start[j];
        e.deviation = std::sqrt(std::max(covariance(j, j), 0.0)) * scale[j];
        for (int i = 0; i < m; ++i) e.influence = std::max(e.influence, std::abs(J(i, j)) * e.value / std::max(std::abs(force[i]), 1e-12));
        e.at_bound = q[j] <= 0 || e.value >= p.largest;
        e.determined = e.deviation < e.value / 3;
        if (!e.determined) e.why = why_not(j);
        result.entries.push_back(e);
    }
    for (int i = 0; i < m; ++i) {
        bench.points[i].fitted_N = force[i];
        result.points.push_back(bench.points[i]);
    }
    result.law = table(q);
    result.strips = bench.strips;
    return result;
}

std::unique_ptr<StripLaw> start_from_slopes(const FitParams& p, const std::vector<MeasuredCurve>& measured) {
    // Secant stiffness of a strip F L / (w d), at the first and the last point of the stiffest curve.
    double first = 0, last = 0;
    for (const MeasuredCurve& c : measured)
        for (size_t i = 0; i < c.force_N.size(); ++i)
            if (c.displacement_mm[i] > 0) {
                const double k = c.force_N[i] * p.length_mm / (1e-3 * p.width_mm * c.displacement_mm[i]);
                if (first == 0) first = k;
                last = std::max(last, k);
            }
    const bool tensor = p.model == FitModel::tensor;
    const double factor = tensor ? arcsim::StiffnessTable::file_factor : 1;
    const double rest = std::max(first, 1e-3) / factor, strained = 1.5 * std::max(last, first) / factor;
    if (!tensor) return std::make_unique<IsotropicStripLaw>(std::array<double, 4>{rest, 0.2 * rest, strained, 0.2 * strained}, factor);
    arcsim::StretchingRows rows;
    rows.fill({strained, 1e-3 * strained, strained, 0.1 * strained});
    rows[0] = {rest, 1e-3 * rest, rest, 0.1 * rest};
    return std::make_unique<TableStripLaw>(rows, factor);
}

}  // namespace formwork
