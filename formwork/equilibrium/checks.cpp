#include "formwork/equilibrium/checks.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <numeric>

namespace formwork {

std::vector<int> connected_parts(const EquilibriumProblem& p, int& n_parts) {
    std::vector<int> parent(p.rest.n_nodes());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::vector<char> used(parent.size(), 0);
    const auto join = [&](int a, int b) {
        used[a] = used[b] = 1;
        parent[root(a)] = root(b);
    };
    for (const Triangle& t : p.rest.faces) join(t[0], t[1]), join(t[1], t[2]);
    for (const SeamSpring& s : p.seams) join(s.i, s.j);
    std::vector<int> part(parent.size(), -1);
    n_parts = 0;
    for (int i = 0; i < p.rest.n_nodes(); ++i)
        if (used[i] && root(i) == i) part[i] = n_parts++;
    for (int i = 0; i < p.rest.n_nodes(); ++i)
        if (used[i]) part[i] = part[root(i)];
    return part;
}

std::vector<std::string> free_motions(const EquilibriumProblem& p, bool has_liquid, bool has_weight) {
    int n_parts = 0;
    const std::vector<int> part = connected_parts(p, n_parts);
    const Vector3d d = p.up.normalized();
    const std::vector<Vector3d>& x = p.start.empty() ? p.rest.x : p.start;
    std::vector<std::string> found;
    for (int k = 0; k < n_parts; ++k) {
        Vector3d centre = Vector3d::Zero();
        int n = 0, example = -1;
        for (std::size_t i = 0; i < x.size(); ++i)
            if (part[i] == k) centre += x[i], ++n, example = example < 0 ? static_cast<int>(i) : example;
        centre /= n;
        double size = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            if (part[i] == k) size = std::max(size, (x[i] - centre).norm());
        // Motions that the load does not resist: a shift, or a turn about an axis through the centre.
        std::vector<Vector3d> turns{d};
        if (!has_liquid && !has_weight) turns = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
        const int n_modes = 3 + static_cast<int>(turns.size());
        // Normal matrix of the held degrees of freedom's motion in each mode.
        arcsim::MatrixXd gram = arcsim::MatrixXd::Zero(n_modes, n_modes);
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (part[i] != k || p.fixed.empty()) continue;
            for (int c = 0; c < 3; ++c) {
                if (!p.fixed[3 * i + c]) continue;
                VectorXd row = VectorXd::Zero(n_modes);
                row[c] = 1;
                for (std::size_t m = 0; m < turns.size(); ++m)
                    row[3 + static_cast<int>(m)] = turns[m].cross(x[i] - centre)[c] / size;
                gram += row * row.transpose();
            }
        }
        const Eigen::JacobiSVD<arcsim::MatrixXd> svd(gram);
        const double largest = svd.singularValues()[0];
        int rank = 0;
        for (int m = 0; m < n_modes; ++m) rank += svd.singularValues()[m] > 1e-10 * std::max(largest, 1e-300);
        if (largest == 0) rank = 0;
        if (rank == n_modes) continue;
        found.push_back("part " + std::to_string(k) + " of " + std::to_string(n_parts) + " (" + std::to_string(n) +
                        " nodes, among them node " + std::to_string(example) + ") is free to move as a whole: " +
                        std::to_string(n_modes - rank) + " rigid motions that neither held nodes nor load resist. "
                        "Hold nodes of it under /formwork/fixed");
    }
    return found;
}

double load_number(const StaticSystem& s) {
    const Scales& c = s.scales();
    const double p = s.has_liquid() ? s.pressure().rho_g() * c.radius : 0;
    return (p + std::abs(s.pressure().overpressure())) * c.radius / s.membrane().law().rest_stiffness();
}

}  // namespace formwork
