#include "formwork/segment/spectral_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formwork/segment/developability.hpp"
#include "formwork/segment/face_graph.hpp"
#include "formwork/segment/k_means.hpp"

namespace formwork {
namespace {

constexpr double weight_floor = 1e-3;       // keeps the graph connected whatever p
constexpr double least_share = 0.02;        // of the area: smaller parts join a neighbour
constexpr double least_side = 0.1;          // of the area on either side of a sweep cut

/// A set of faces with its inner edges; numbers are places in `faces`.
struct FaceSet {
    struct Link {
        int a, b;          // a < b
        double eta_jump;   // |eta_a - eta_b|
        double length;     // of the shared edge, m
        double dual;       // between the faces' centroids, m
    };
    std::vector<int> faces;
    std::vector<double> area;
    std::vector<Link> links;
    double total_area = 0;

    FaceSet(const Surface& s, const Topology& t, std::vector<int> set, const std::vector<double>& eta) : faces(std::move(set)) {
        std::vector<int> place(s.n_faces(), -1);
        for (std::size_t i = 0; i < faces.size(); ++i) place[faces[i]] = static_cast<int>(i);
        const auto face_eta = [&](int f) { return eta[s.faces[f][0]] + eta[s.faces[f][1]] + eta[s.faces[f][2]]; };
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const int f = faces[i];
            area.push_back(arcsim::face_area(s, f));
            total_area += area.back();
            for (int k = 0; k < 3; ++k) {
                const int g = t.neighbour(f, k);
                if (g < 0 || place[g] <= static_cast<int>(i)) continue;
                const double length = (s.x[s.faces[f][(k + 1) % 3]] - s.x[s.faces[f][(k + 2) % 3]]).norm();
                const double dual = (arcsim::face_centroid(s, f) - arcsim::face_centroid(s, g)).norm();
                links.push_back({static_cast<int>(i), place[g], std::abs(face_eta(f) - face_eta(g)), length, dual});
            }
        }
    }
    int size() const { return static_cast<int>(faces.size()); }
};

/// Labels that are connected each, numbered in the order of their first faces.
std::vector<int> connected_parts(const FaceSet& set, const std::vector<int>& label) {
    std::vector<int> root(set.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const auto& link : set.links)
        if (label[link.a] == label[link.b]) {
            const int a = find(link.a), b = find(link.b);
            root[std::max(a, b)] = std::min(a, b);
        }
    std::vector<int> part(set.size(), -1);
    int count = 0;
    for (int i = 0; i < set.size(); ++i) part[i] = find(i) == i ? count++ : part[find(i)];
    return part;
}

/// Parts below `least_share` of the area join the neighbour with the longest border, smallest first.
std::vector<int> merge_small(const FaceSet& set, std::vector<int> part) {
    while (true) {
        const int n = *std::max_element(part.begin(), part.end()) + 1;
        std::vector<double> area(n, 0.0), border(n, 0.0);
        for (int i = 0; i < set.size(); ++i) area[part[i]] += set.area[i];
        const int small = static_cast<int>(std::min_element(area.begin(), area.end()) - area.begin());
        if (n == 1 || area[small] >= least_share * set.total_area) return part;
        for (const auto& link : set.links) {
            if (part[link.a] == part[link.b]) continue;
            if (part[link.a] == small) border[part[link.b]] += link.length;
            if (part[link.b] == small) border[part[link.a]] += link.length;
        }
        const int to = static_cast<int>(std::max_element(border.begin(), border.end()) - border.begin());
        if (border[to] == 0) return part;
        std::replace(part.begin(), part.end(), small, to);
        part = connected_parts(set, part);
    }
}

std::vector<int> split_literally(const FaceSet& set, const SplitParams& params) {
    WeightedGraph graph{set.size(), {}};
    for (const auto& link : set.links) graph.links.push_back({link.a, link.b, std::exp(-params.p * link.eta_jump)});
    const LowModes modes = low_modes(graph, params.k, false);
    std::vector<double> rows(static_cast<std::size_t>(set.size()) * params.k);
    for (int i = 0; i < set.size(); ++i)
        for (int c = 0; c < params.k; ++c) rows[i * params.k + c] = modes.vector[c][i];
    return connected_parts(set, k_means(rows, set.size(), params.k, params.k));
}

/// Median of the positive jumps; 1 when there is none (a developable patch: split by shape alone).
double median_jump(const FaceSet& set) {
    std::vector<double> jumps;
    for (const auto& link : set.links)
        if (link.eta_jump > 0) jumps.push_back(link.eta_jump);
    if (jumps.empty()) return 1;
    std::nth_element(jumps.begin(), jumps.begin() + jumps.size() / 2, jumps.end());
    return jumps[jumps.size() / 2];
}

/// Two parts by the prefix of the Fiedler order with the least conductance.
std::vector<int> split_in_two(const FaceSet& set, double p) {
    const double median = median_jump(set);
    WeightedGraph graph{set.size(), {}};
    std::vector<double> degree(set.size(), 0.0);
    std::vector<std::vector<std::pair<int, double>>> around(set.size());
    for (const auto& link : set.links) {
        const double a = std::max(weight_floor, std::exp(-p * link.eta_jump / median)) * link.length / std::max(link.dual, 1e-3 * link.length);
        graph.links.push_back({link.a, link.b, a});
        degree[link.a] += a;
        degree[link.b] += a;
        around[link.a].emplace_back(link.b, a);
        around[link.b].emplace_back(link.a, a);
    }
    const std::vector<double> fiedler = low_modes(graph, 2, true).vector[1];
    std::vector<double> height(set.size());
    for (int i = 0; i < set.size(); ++i) height[i] = degree[i] > 0 ? fiedler[i] / std::sqrt(degree[i]) : 0;
    std::vector<int> order(set.size()), side(set.size(), 1), best;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return height[a] < height[b]; });
    const double volume = std::accumulate(degree.begin(), degree.end(), 0.0);
    double inside = 0, cut = 0, area = 0, least = std::numeric_limits<double>::infinity();
    int best_prefix = 0;
    for (int n = 0; n + 1 < set.size(); ++n) {
        const int i = order[n];
        for (const auto& [j, a] : around[i]) cut += side[j] == 0 ? -a : a;
        side[i] = 0;
        inside += degree[i];
        area += set.area[i];
        if (std::min(area, set.total_area - area) < least_side * set.total_area) continue;
        const double conductance = cut / std::min(inside, volume - inside);
        if (conductance < least) {
            least = conductance;
            best_prefix = n + 1;
        }
    }
    if (best_prefix == 0) best_prefix = set.size() / 2;   // few large faces
    for (int n = 0; n < set.size(); ++n) side[order[n]] = n < best_prefix ? 0 : 1;
    return merge_small(set, connected_parts(set, side));
}

}  // namespace

std::vector<int> split_faces(const Surface& s, const Topology& t, const std::vector<int>& faces,
                             const std::vector<double>& eta, const SplitParams& params) {
    const FaceSet whole(s, t, faces, eta);
    if (whole.size() <= params.k) {
        std::vector<int> each(whole.size());
        std::iota(each.begin(), each.end(), 0);
        return each;
    }
    if (params.method == SplitMethod::spectral) return split_literally(whole, params);
    std::vector<int> part(whole.size(), 0);
    std::vector<char> done;                    // parts that could not be split
    for (int n = 1; n < params.k;) {
        done.resize(n, 0);
        std::vector<std::vector<int>> members(n), places(n);
        for (int i = 0; i < whole.size(); ++i) {
            members[part[i]].push_back(whole.faces[i]);
            places[part[i]].push_back(i);
        }
        int worst = -1;
        double most = -1;
        for (int c = 0; c < n; ++c) {
            if (done[c] || members[c].size() < 2) continue;
            const double energy = patch_energy(t, eta, members[c]);
            if (energy > most) most = energy, worst = c;
        }
        if (worst < 0) break;
        const std::vector<int> halves = split_in_two(FaceSet(s, t, members[worst], eta), params.p);
        const int more = *std::max_element(halves.begin(), halves.end());
        if (more == 0) {
            done[worst] = 1;
            continue;
        }
        for (std::size_t i = 0; i < halves.size(); ++i)
            if (halves[i] > 0) part[places[worst][i]] = n + halves[i] - 1;
        n += more;
    }
    return connected_parts(whole, part);
}

}  // namespace formwork
