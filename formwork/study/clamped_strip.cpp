#include "formwork/study/clamped_strip.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "arcsim/base/error.hpp"

namespace formwork {

using arcsim::Matrix2d;

namespace {

using StrainRows = Eigen::Matrix<double, 3, 12>;   // d(G_uu, G_vv, G_uv) / d(x of six nodes)

StrainRows strain_rows(const Eigen::Matrix<double, 6, 2>& gradient, const Matrix2d& F) {
    StrainRows B;
    for (int a = 0; a < 6; ++a) {
        B.block<1, 2>(0, 2 * a) = gradient(a, 0) * F.col(0).transpose();
        B.block<1, 2>(1, 2 * a) = gradient(a, 1) * F.col(1).transpose();
        B.block<1, 2>(2, 2 * a) = 0.5 * (gradient(a, 0) * F.col(1) + gradient(a, 1) * F.col(0)).transpose();
    }
    return B;
}
double largest(const arcsim::VectorXd& v) {
    double m = 0;
    for (double entry : v) m = std::max(m, std::abs(entry));
    return m;
}
/// Dunavant's six points, exact for polynomials of degree 4: barycentric (a, b, b) and its rotations.
struct QuadraturePoint {
    double weight, L[3];
};
std::array<QuadraturePoint, 6> quadrature() {
    std::array<QuadraturePoint, 6> points;
    const double rule[2][3] = {{0.223381589678011, 0.108103018168070, 0.445948490915965},
                               {0.109951743655322, 0.816847572980459, 0.091576213509771}};
    for (int k = 0; k < 6; ++k) {
        points[k].weight = rule[k / 3][0];
        for (int corner = 0; corner < 3; ++corner) points[k].L[corner] = rule[k / 3][corner == k % 3 ? 1 : 2];
    }
    return points;
}
/// Gradients of the quadratic shape functions from those of the barycentric coordinates.
Eigen::Matrix<double, 6, 2> shape_gradients(const double L[3], const Eigen::Matrix<double, 3, 2>& dL) {
    Eigen::Matrix<double, 6, 2> g;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        g.row(k) = (4 * L[k] - 1) * dL.row(k);
        g.row(3 + k) = 4 * (L[k] * dL.row(next) + L[next] * dL.row(k));
    }
    return g;
}
const Vector3d work_weight(1, 1, 2);   // S : dE = S_uu dE_uu + S_vv dE_vv + 2 S_uv dE_uv

}  // namespace

ClampedStrip::ClampedStrip(StripMesh mesh, double angle) : mesh_(std::move(mesh)) {
    const int n = static_cast<int>(mesh_.X.size());
    node_dof_.assign(n, {0, 0});
    for (int node : mesh_.held) node_dof_[node] = {fixed_dof, fixed_dof};
    for (int node : mesh_.moving) node_dof_[node] = {clamp_dof, fixed_dof};
    for (auto& dof : node_dof_)
        if (dof[0] == 0) dof = {n_free_, n_free_ + 1}, n_free_ += 2;

    // u = (x along the warp); the strip's axis makes `angle` with it.
    const Vector2d axis(std::cos(angle), std::sin(angle)), across(-axis[1], axis[0]);
    std::vector<Eigen::Triplet<double>> pattern;
    const std::array<QuadraturePoint, n_points> points = quadrature();
    for (const std::array<int, n_nodes>& nodes : mesh_.elements) {
        Element e;
        e.node = nodes;
        Matrix2d edges;
        for (int k = 0; k < 2; ++k) {
            const Vector2d d = mesh_.X[nodes[k + 1]] - mesh_.X[nodes[0]];
            edges.col(k) = d[0] * axis + d[1] * across;
        }
        const Matrix2d inverse = edges.inverse();
        Eigen::Matrix<double, 3, 2> dL;
        dL << -inverse.row(0) - inverse.row(1), inverse.row(0), inverse.row(1);
        for (int q = 0; q < n_points; ++q)
            e.point[q] = {0.5 * edges.determinant() * points[q].weight, shape_gradients(points[q].L, dL)};
        for (int k = 0; k < n_dofs; ++k) e.dof[k] = node_dof_[nodes[k / 2]][k % 2];
        for (int c : e.dof)
            for (int r : e.dof)
                if (r >= 0 && c >= 0) pattern.emplace_back(r, c, 1.0);
        elements_.push_back(e);
    }
    K_.resize(n_free_, n_free_);
    K_.setFromTriplets(pattern.begin(), pattern.end());
    K_.makeCompressed();
    for (Element& e : elements_)
        for (int c = 0; c < n_dofs; ++c)
            for (int r = 0; r < n_dofs; ++r)
                e.place[n_dofs * c + r] = e.dof[r] >= 0 && e.dof[c] >= 0
                                         ? static_cast<int>(&K_.coeffRef(e.dof[r], e.dof[c]) - K_.valuePtr())
                                         : -1;
}

StripState ClampedStrip::at_rest() const {
    StripState s;
    s.x = mesh_.X;
    return s;
}

Vector3d ClampedStrip::strain(const Element& e, const Point& p, const StripState& s, Matrix2d& F) {
    F.setZero();
    for (int a = 0; a < n_nodes; ++a) F += s.x[e.node[a]] * p.gradient.row(a);
    const Matrix2d C = F.transpose() * F;
    return {0.5 * (C(0, 0) - 1), 0.5 * (C(1, 1) - 1), 0.5 * C(0, 1)};
}

ClampedStrip::System ClampedStrip::assemble(const StripLaw& law, const StripState& s, bool with_matrix) {
    System y;
    y.residual = VectorXd::Zero(n_free_);
    y.column = VectorXd::Zero(n_free_);
    y.row = VectorXd::Zero(n_free_);
    if (with_matrix) std::fill(K_.valuePtr(), K_.valuePtr() + K_.nonZeros(), 0.0);
    for (const Element& e : elements_) {
        Eigen::Matrix<double, n_dofs, 1> force = Eigen::Matrix<double, n_dofs, 1>::Zero();
        Eigen::Matrix<double, n_dofs, n_dofs> K = Eigen::Matrix<double, n_dofs, n_dofs>::Zero();
        for (const Point& p : e.point) {
            Matrix2d F;
            const StripStress t = law.stress(strain(e, p, s, F));
            const StrainRows B = strain_rows(p.gradient, F);
            force += p.area * B.transpose() * work_weight.cwiseProduct(t.S);
            if (!with_matrix) continue;
            const StrainRows DB = p.area * work_weight.asDiagonal() * t.D * B;
            K.noalias() += B.transpose() * DB;
            Matrix2d S;
            S << t.S[0], t.S[2], t.S[2], t.S[1];
            const Gradient gS = p.area * p.gradient * S;
            for (int a = 0; a < n_nodes; ++a)
                for (int b = 0; b < n_nodes; ++b)
                    K.block<2, 2>(2 * a, 2 * b).diagonal().array() += gS.row(a).dot(p.gradient.row(b));
        }
        for (double v : force) y.scale = std::max(y.scale, std::abs(v));
        for (int k = 0; k < n_dofs; ++k) {
            if (e.dof[k] >= 0) y.residual[e.dof[k]] += force[k];
            if (e.dof[k] == clamp_dof) y.force += force[k];
        }
        if (!with_matrix) continue;
        for (int c = 0; c < n_dofs; ++c)
            for (int r = 0; r < n_dofs; ++r) {
                const int place = e.place[n_dofs * c + r];
                if (place >= 0) K_.valuePtr()[place] += K(r, c);
                else if (e.dof[r] >= 0 && e.dof[c] == clamp_dof) y.column[e.dof[r]] += K(r, c);
                else if (e.dof[r] == clamp_dof && e.dof[c] >= 0) y.row[e.dof[c]] += K(r, c);
                else if (e.dof[r] == clamp_dof && e.dof[c] == clamp_dof) y.stiffness += K(r, c);
            }
    }
    return y;
}

void ClampedStrip::move(StripState& s, const VectorXd& du, double d_clamp, double part) const {
    for (size_t i = 0; i < s.x.size(); ++i)
        for (int axis = 0; axis < 2; ++axis) {
            const int dof = node_dof_[i][axis];
            if (dof >= 0) s.x[i][axis] += part * du[dof];
            else if (dof == clamp_dof) s.x[i][axis] += part * d_clamp;
        }
    s.displacement += part * d_clamp;
}

/// One increment. The first step moves the clamp along the tangent, so the inner nodes follow at once.
bool ClampedStrip::newton(const StripLaw& law, StripState& s, bool force_control, double target) {
    constexpr int max_steps = 25;
    constexpr double tolerance = 1e-11;        // of the largest nodal force: a few digits above rounding
    double previous = std::numeric_limits<double>::infinity();
    for (int step = 0; step < max_steps; ++step) {
        const System y = assemble(law, s, true);
        if (!(y.scale < 1e30)) return false;   // also NaN
        const double misfit = force_control ? target - y.force : 0;
        const double gap = force_control ? 0 : target - s.displacement;
        const double size = std::max(largest(y.residual), std::abs(misfit));
        s.residual = y.scale > 0 ? size / y.scale : 0;
        s.force = y.force;
        const bool there = gap == 0 && (step > 0 || y.scale > 0);
        if (!lu_.factorize(K_)) return false;
        const VectorXd b = lu_.solve(-y.column);
        s.stiffness = y.stiffness + y.row.dot(b);
        // Below the tolerance, or at the floor that rounding sets.
        if (there && (s.residual < tolerance || (s.residual < 1e-8 && size > 0.3 * previous))) return true;
        previous = gap == 0 ? size : std::numeric_limits<double>::infinity();
        const VectorXd a = lu_.solve(-y.residual);
        double d_clamp = gap;
        if (force_control) {
            if (s.stiffness == 0) return false;
            d_clamp = (misfit - y.row.dot(a)) / s.stiffness;
        }
        const VectorXd du = a + d_clamp * b;
        move(s, du, d_clamp, 1);
        if (!force_control) s.displacement = target;
        ++s.iterations;
    }
    return false;
}

StripState ClampedStrip::increment(const StripLaw& law, StripState s, bool force_control, double target) {
    const double start = force_control ? s.force : s.displacement;
    constexpr double smallest = 1.0 / 1024;
    double done = 0, step = 1;
    while (done < 1) {
        StripState trial = s;
        trial.iterations = s.iterations;
        const double goal = done + step >= 1 ? target : start + (done + step) * (target - start);
        if (newton(law, trial, force_control, goal)) {
            s = std::move(trial);
            done += step;
            step = std::min(2 * step, 1 - done);
            continue;
        }
        s.iterations = trial.iterations;
        step /= 2;
        if (step < smallest)
            throw arcsim::NumericalError("strip: no equilibrium found beyond a displacement of " +
                                         std::to_string(1e3 * s.displacement) + " mm and a force of " +
                                         std::to_string(s.force) +
                                         " N. The cloth collapses sideways or the force is more than it can carry.");
    }
    return s;
}

StripState ClampedStrip::pull_to(const StripLaw& law, const StripState& from, double displacement) {
    return increment(law, from, false, displacement);
}
StripState ClampedStrip::load_to(const StripLaw& law, const StripState& from, double force) {
    return increment(law, from, true, force);
}

arcsim::VectorXd ClampedStrip::force_sensitivity(const StripLaw& law, const StripState& s) {
    const System y = assemble(law, s, true);
    if (!lu_.factorize(K_)) throw arcsim::NumericalError("strip: the tangent is singular at this state");
    const VectorXd adjoint = lu_.solve_transposed(y.row);
    VectorXd dF = VectorXd::Zero(law.n_parameters());
    for (const Element& e : elements_) {
        Eigen::Matrix<double, n_dofs, 1> w;
        for (int k = 0; k < n_dofs; ++k)
            w[k] = e.dof[k] >= 0 ? -adjoint[e.dof[k]] : e.dof[k] == clamp_dof ? 1.0 : 0.0;
        for (const Point& p : e.point) {
            Matrix2d F;
            const Vector3d G = strain(e, p, s, F);
            const Vector3d virtual_strain = p.area * work_weight.cwiseProduct(strain_rows(p.gradient, F) * w);
            const StressSensitivity t = law.sensitivity(G);
            for (size_t j = 0; j < t.parameter.size(); ++j) dF[t.parameter[j]] += virtual_strain.dot(t.dS[j]);
        }
    }
    return dF;
}

double ClampedStrip::mid_half_width(const StripState& s) const {
    // The long edges' points at half length, linearly between edge nodes.
    double low = 0, high = 0;
    const double middle = 0.5 * mesh_.length, half = 0.5 * mesh_.width, tiny = 1e-9 * mesh_.length;
    for (double side : {-1.0, 1.0}) {
        std::vector<int> edge;
        for (size_t i = 0; i < mesh_.X.size(); ++i)
            if (std::abs(mesh_.X[i][1] - side * half) < tiny) edge.push_back(static_cast<int>(i));
        std::sort(edge.begin(), edge.end(), [&](int a, int b) { return mesh_.X[a][0] < mesh_.X[b][0]; });
        for (size_t k = 0; k + 1 < edge.size(); ++k) {
            const Vector2d &A = mesh_.X[edge[k]], &B = mesh_.X[edge[k + 1]];
            if (A[0] > middle + tiny || B[0] < middle - tiny) continue;
            const double t = (middle - A[0]) / (B[0] - A[0]);
            (side < 0 ? low : high) = (1 - t) * s.x[edge[k]][1] + t * s.x[edge[k + 1]][1];
        }
    }
    return 0.5 * (high - low);
}

Vector3d ClampedStrip::mean_strain(const StripState& s) const {
    Vector3d sum = Vector3d::Zero();
    double area = 0;
    for (const Element& e : elements_)
        for (const Point& p : e.point) {
            Matrix2d F;
            sum += p.area * strain(e, p, s, F);
            area += p.area;
        }
    return sum / area;
}

}  // namespace formwork
