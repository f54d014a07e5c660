#include "formwork/segment/stretch_estimate.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>
#include <unordered_map>

namespace formwork {

using arcsim::VectorXd;

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Angle at a corner, and its cotangent.
std::pair<double, double> corner_angle_at(const Surface& s, const arcsim::Triangle& t, int k) {
    const Vector3d a = s.x[t[(k + 1) % 3]] - s.x[t[k]], b = s.x[t[(k + 2) % 3]] - s.x[t[k]];
    const double sine = a.cross(b).norm(), cosine = a.dot(b);
    return {std::atan2(sine, cosine), cosine / sine};
}

/// Cell of every inner node: nearest of about `max_cells` seeds evenly apart, after one round of recentring.
std::vector<int> make_cells(const PanelPatch& p, int max_cells, std::vector<int>& seeds) {
    const int n = p.surface.n_nodes();
    seeds.clear();
    for (int v = 0; v < n; ++v)
        if (!p.topology.is_boundary_node(v)) seeds.push_back(v);
    if (static_cast<int>(seeds.size()) <= max_cells) {   // small panels: every node is a cell
        std::vector<int> cell(n, -1);
        for (std::size_t i = 0; i < seeds.size(); ++i) cell[seeds[i]] = static_cast<int>(i);
        return cell;
    }
    const EdgeLengths g(p);
    const double radius = 0.95 * std::sqrt(p.area() / max_cells);   // spacing of a hexagonal grid is 1.07 of this
    using Item = std::tuple<double, int, int>;
    const auto grow = [&](const std::vector<int>& from) {
        std::vector<double> distance(n, std::numeric_limits<double>::infinity());
        std::vector<int> cell(n, -1);
        std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
        for (std::size_t i = 0; i < from.size(); ++i) queue.emplace(distance[from[i]] = 0, from[i], static_cast<int>(i));
        while (!queue.empty()) {
            const auto [d, v, c] = queue.top();
            queue.pop();
            if (cell[v] >= 0) continue;
            cell[v] = c;
            for (const auto& [w, l] : g.around(v))
                if (!p.topology.is_boundary_node(w) && d + l < distance[w]) queue.emplace(distance[w] = d + l, w, c);
        }
        return cell;
    };
    seeds.clear();
    std::vector<double> near(n, std::numeric_limits<double>::infinity());
    for (int v = 0; v < n; ++v) {
        if (p.topology.is_boundary_node(v) || near[v] < radius) continue;
        seeds.push_back(v);
        std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
        queue.emplace(near[v] = 0, v);
        while (!queue.empty()) {
            const auto [d, w] = queue.top();
            queue.pop();
            if (d > near[w]) continue;
            for (const auto& [u, l] : g.around(w))
                if (!p.topology.is_boundary_node(u) && d + l < std::min(radius, near[u])) queue.emplace(near[u] = d + l, u);
        }
    }
    std::vector<int> cell = grow(seeds);
    std::vector<Vector3d> centre(seeds.size(), Vector3d::Zero());
    std::vector<int> count(seeds.size(), 0);
    for (int v = 0; v < n; ++v)
        if (cell[v] >= 0) {
            centre[cell[v]] += p.surface.x[v];
            ++count[cell[v]];
        }
    std::vector<double> nearest(seeds.size(), std::numeric_limits<double>::infinity());
    for (int v = 0; v < n; ++v)
        if (cell[v] >= 0) {
            const double d = (p.surface.x[v] - centre[cell[v]] / count[cell[v]]).squaredNorm();
            if (d < nearest[cell[v]]) {
                nearest[cell[v]] = d;
                seeds[cell[v]] = v;
            }
        }
    return grow(seeds);
}

}  // namespace

struct StretchModel::Impl {
    std::vector<int> cell;         // per node; -1: border
    std::vector<int> seed;         // per cell
    std::vector<double> area;      // per cell, m²
    VectorXd curvature;            // per cell: sum of angle defects
    std::vector<std::vector<int>> neighbours;
    SparseMatrix laplacian;        // upper triangle
    std::vector<int> place;        // per cell: in the elimination order, which the two below follow
    std::vector<int> diagonal;     // per place: of the matrix's values
    Eigen::SimplicialLLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> factor;
    std::unordered_map<std::vector<bool>, StretchEstimate> known;   // by the cells on the curve: many curves run through the same ones

    void order(int n, const std::vector<Eigen::Triplet<double>>& entries);
    StretchEstimate measure(const std::vector<bool>& on_curve);
    VectorXd solve(const std::vector<bool>& on_curve);
};

/// The matrix in an order of little fill: found once, it serves every curve.
void StretchModel::Impl::order(int n, const std::vector<Eigen::Triplet<double>>& entries) {
    SparseMatrix whole(n, n);
    whole.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
    Eigen::AMDOrdering<int>()(whole, inverse);
    const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order = inverse.inverse();
    place.assign(order.indices().data(), order.indices().data() + n);
    laplacian.resize(n, n);
    laplacian.selfadjointView<Eigen::Upper>() = whole.selfadjointView<Eigen::Upper>().twistedBy(order);
    laplacian.makeCompressed();
    for (int c = 0; c < n; ++c)
        for (int k = laplacian.outerIndexPtr()[c]; k < laplacian.outerIndexPtr()[c + 1]; ++k)
            if (laplacian.innerIndexPtr()[k] == c) diagonal.push_back(k);
    factor.analyzePattern(laplacian);
}

VectorXd StretchModel::Impl::solve(const std::vector<bool>& on_curve) {
    SparseMatrix a = laplacian;
    VectorXd b(curvature.size());
    for (std::size_t c = 0; c < on_curve.size(); ++c) {
        b[place[c]] = on_curve[c] ? 0 : curvature[static_cast<int>(c)];
        if (on_curve[c]) a.valuePtr()[diagonal[place[c]]] *= 1e8;   // phi = 0, kept in the pattern
    }
    factor.factorize(a);
    const VectorXd x = factor.solve(b);
    VectorXd phi(b.size());
    for (std::size_t c = 0; c < place.size(); ++c) phi[static_cast<int>(c)] = x[place[c]];
    return phi;
}

StretchModel::StretchModel(const PanelPatch& p, int max_cells) : impl_(std::make_unique<Impl>()) {
    Impl& m = *impl_;
    const Surface& s = p.surface;
    m.cell = make_cells(p, max_cells, m.seed);
    const int n = static_cast<int>(m.seed.size());
    m.area.assign(n, 0);
    m.curvature = VectorXd::Zero(n);
    m.neighbours.resize(n);
    std::vector<Vector3d> centre(n, Vector3d::Zero());
    std::vector<int> count(n, 0);
    for (int v = 0; v < s.n_nodes(); ++v)
        if (m.cell[v] >= 0) {
            m.curvature[m.cell[v]] += 2 * std::numbers::pi;
            centre[m.cell[v]] += s.x[v];
            ++count[m.cell[v]];
        }
    for (int c = 0; c < n; ++c) centre[c] /= count[c];
    std::vector<Eigen::Triplet<double>> entries;
    for (int f = 0; f < s.n_faces(); ++f) {
        const arcsim::Triangle& t = s.faces[f];
        const double a = arcsim::face_area(s, f);
        for (int k = 0; k < 3; ++k) {
            const int c = m.cell[t[k]];
            const auto [angle, cotangent] = corner_angle_at(s, t, k);
            if (c >= 0) {
                m.area[c] += a / 3;
                m.curvature[c] -= angle;
            }
            const int i = t[(k + 1) % 3], j = t[(k + 2) % 3];
            const int ci = m.cell[i], cj = m.cell[j];
            if (ci == cj) continue;
            // Flux between two cells, exact for a linear phi: sum of w_ij (x_i - x_j) against the cells' distance.
            const double w = std::max(0.02, 0.5 * cotangent);
            const Vector3d gap = (ci >= 0 ? centre[ci] : s.x[i]) - (cj >= 0 ? centre[cj] : s.x[j]);
            const double g = std::max(0.05 * w, w * (s.x[i] - s.x[j]).dot(gap) / std::max(gap.squaredNorm(), 1e-30));
            if (ci >= 0) entries.emplace_back(ci, ci, g);
            if (cj >= 0) entries.emplace_back(cj, cj, g);
            if (ci >= 0 && cj >= 0) {
                entries.emplace_back(ci, cj, -g);
                entries.emplace_back(cj, ci, -g);
                m.neighbours[ci].push_back(cj);
                m.neighbours[cj].push_back(ci);
            }
        }
    }
    for (auto& list : m.neighbours) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    for (int c = 0; c < n; ++c) entries.emplace_back(c, c, 1e-9);   // closed surfaces: no border holds phi
    if (n > 0) m.order(n, entries);
}

StretchModel::~StretchModel() = default;

StretchEstimate StretchModel::with_cut(const Curve& curve) const {
    Impl& m = *impl_;
    const int n = n_cells();
    if (n == 0) return {};
    std::vector<bool> on_curve(n, false);
    for (const CurvePoint& q : curve) {
        const int v = q.is_node() || q.t < 0.5 ? q.a : q.b;
        int c = m.cell[v];
        if (c < 0 && !q.is_node()) c = m.cell[v == q.a ? q.b : q.a];
        if (c >= 0) on_curve[c] = true;
    }
    const auto [known, is_new] = m.known.try_emplace(on_curve);
    if (is_new) known->second = m.measure(on_curve);
    return known->second;
}

StretchEstimate StretchModel::Impl::measure(const std::vector<bool>& on_curve) {
    const int n = static_cast<int>(seed.size());
    StretchEstimate e;
    const VectorXd phi = solve(on_curve);
    std::vector<int> piece(n, -1), stack;
    std::vector<std::vector<int>> pieces;
    for (int first = 0; first < n; ++first) {
        if (piece[first] >= 0 || on_curve[first]) continue;
        pieces.emplace_back();
        piece[first] = static_cast<int>(pieces.size()) - 1;
        stack.assign(1, first);
        while (!stack.empty()) {
            const int c = stack.back();
            stack.pop_back();
            pieces.back().push_back(c);
            for (int d : neighbours[c])
                if (piece[d] < 0 && !on_curve[d]) {
                    piece[d] = piece[first];
                    stack.push_back(d);
                }
        }
    }
    std::vector<double> areas;
    for (const auto& cells : pieces) {
        double total = 0, mean = 0;
        for (int c : cells) {
            total += area[c];
            mean += area[c] * phi[c];
        }
        if (total <= 0) continue;
        mean /= total;
        std::vector<std::pair<double, double>> off;   // |phi - mean|, area
        for (int c : cells) {
            const double d = phi[c] - mean;
            e.energy += area[c] * d * d;
            off.emplace_back(std::abs(d), area[c]);
        }
        double above = 0;   // the few largest are enough to pass 5 % of the area
        for (std::size_t done = 0, next = 0; done < off.size() && above <= 0.05 * total; done = next) {
            next = std::min(off.size(), done + std::max<std::size_t>(8, off.size() / 10));
            std::partial_sort(off.begin() + static_cast<std::ptrdiff_t>(done), off.begin() + static_cast<std::ptrdiff_t>(next), off.end(),
                              std::greater<>());
            for (std::size_t i = done; i < next; ++i)
                if ((above += off[i].second) > 0.05 * total) {
                    e.p95 = std::max(e.p95, off[i].first);
                    break;
                }
        }
        e.area += total;
        areas.push_back(total);
    }
    std::sort(areas.begin(), areas.end(), std::greater<>());
    e.smallest_piece = areas.size() < 2 ? 0 : areas[1];
    return e;
}

std::vector<int> StretchModel::nodes_by_stretch() const {
    Impl& m = *impl_;
    const int n = n_cells();
    if (n == 0) return {};
    const VectorXd phi = m.solve(std::vector<bool>(n, false));
    std::vector<int> order(n);
    for (int c = 0; c < n; ++c) order[c] = c;
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return std::abs(phi[a]) > std::abs(phi[b]); });
    for (int& c : order) c = m.seed[c];
    return order;
}

int StretchModel::n_cells() const { return static_cast<int>(impl_->seed.size()); }
const std::vector<int>& StretchModel::cell_nodes() const { return impl_->seed; }

}  // namespace formwork
