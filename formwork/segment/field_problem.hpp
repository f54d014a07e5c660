#pragma once

#include <complex>
#include <vector>

#include "formwork/segment/angle_transport.hpp"
#include "formwork/segment/cross_field.hpp"
#include "formwork/segment/sparse_cholesky.hpp"

/// The pieces of smooth_cross_field. One unknown angle per face, one term per inner edge.
namespace formwork {

using Complex = std::complex<double>;

/// An inner edge as (12) sees it: residual r = theta_i - theta_j + kappa + pi/2 p.
struct DualEdge {
    int edge;       // of the Topology
    int i, j;       // face[0], face[1]
    double kappa;
};

/// (12) made ready: who neighbours whom, how strongly each face is held.
struct FieldProblem {
    int n_faces = 0;
    std::vector<DualEdge> edges;
    std::vector<double> weight;   // alpha_f w_f
    std::vector<double> target;   // data angle, rad
    std::vector<char> fixed;      // hard direction: theta is `target`
    LowerPattern pattern;
    std::vector<int> edge_entry;  // place of each dual edge's off-diagonal in pattern.row
    std::vector<int> anchors;     // one face of each component without any data: it keeps its angle
    bool has_data = false;        // some weight is positive, or some face is fixed
};

/// @throws InputError as smooth_cross_field
FieldProblem make_field_problem(const Surface& s, const Topology& t, const std::vector<DirectionData>& data,
                                const FieldParams& params);

/// Angles and periods under way: r per dual edge, p per dual edge, branch of the data per face.
struct FieldState {
    std::vector<double> theta;
    std::vector<int> period;
    double energy = 0;   // (12)
};

/// The nearest period on every edge, and the energy.
FieldState match_periods(const FieldProblem& problem, std::vector<double> theta);

/// (12) for these angles and periods, data modulo a quarter turn.
double field_energy(const FieldProblem& problem, const std::vector<double>& theta, const std::vector<int>& period);

/// Residual of one dual edge, rad.
inline double residual(const DualEdge& e, const std::vector<double>& theta, int period) {
    return theta[e.i] - theta[e.j] + e.kappa + quarter_turn * period;
}

/// The matrix of (12) in the angles: graph Laplacian plus weights; it does not depend on the periods, so it
/// is factored once. Fixed faces have rows of the identity; components without data are held at their anchors.
class AngleSystem {
public:
    AngleSystem(const FieldProblem& problem, const SparseCholesky& ordering);

    /// Angles of least energy for these periods, the data on the branch nearest to `theta`; repeated until
    /// no face changes its branch. Energy never rises.
    void relax(FieldState& s) const;

    /// Solving for the angles, and rounding periods and branches, in turn until none changes.
    void alternate(FieldState& s) const;

    const SparseCholesky& factor() const { return factor_; }
    const FieldProblem& problem() const { return problem_; }

private:
    double solve(FieldState& s) const;

    const FieldProblem& problem_;
    SparseCholesky factor_;
};

/// Representation z = exp(4 i theta) per face: periods vanish, noise averages.
class PowerField {
public:
    PowerField(const FieldProblem& problem, const SparseCholesky& ordering);

    /// Minimum of sum |z_j - e^{4 i kappa} z_i|² + sum weight |z - z_data|²: one linear solve.
    std::vector<Complex> linear() const;

    /// Normalise and diffuse in turn, time step tau (Merriman-Bence-Osher; removes the pairs that the linear
    /// solve leaves where |z| ~ 0). [Viertel, Osting 2019]
    std::vector<Complex> diffuse(std::vector<Complex> z, double tau, int max_steps) const;

private:
    std::vector<Complex> matrix(double shift) const;
    void add_fixed_neighbours(std::vector<Complex>& rhs) const;
    const FieldProblem& problem_;
    const SparseCholesky& ordering_;
};

std::vector<double> angles_of(const std::vector<Complex>& z);

/// The best state found from diffused starts by PeriodSearch, as FieldParams ask.
FieldState minimise_field(const Surface& s, const Topology& t, const FieldProblem& problem, const FieldParams& params,
                          const FieldObserver& observer);

}  // namespace formwork
