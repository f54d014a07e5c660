#include "formwork/panels/sewing_order.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "arcsim/base/error.hpp"

namespace formwork {
namespace {

constexpr double straight_run = 0.87;   // cosine of 30°: two seams count as one run through their node

/// Parts at hand: panels sewn together so far, and the length of edges still open.
class Parts {
public:
    explicit Parts(const PanelSet& set) : parent_(set.panels.size()), open_(set.panels.size(), 0.0) {
        std::iota(parent_.begin(), parent_.end(), 0);
        for (const PanelSeam& seam : set.seams)
            for (const SeamSide& side : seam.side)
                if (side.panel >= 0) open_[side.panel] += seam.rest_length;
    }
    int find(int p) const {
        while (parent_[p] != p) p = parent_[p];
        return p;
    }
    double open(int p) const { return open_[find(p)]; }
    void sew(int a, int b, double length) {
        const int ra = find(a), rb = find(b);
        if (ra != rb) open_[ra] += open_[rb], parent_[rb] = ra;
        open_[ra] -= 2 * length;
    }

private:
    std::vector<int> parent_;
    std::vector<double> open_;
};

double mean_height(const Segmentation& s, int seam, const Vector3d& up) {
    double sum = 0;
    for (int node : s.seams[seam].nodes) sum += s.mesh.x[node].dot(up);
    return sum / static_cast<double>(s.seams[seam].nodes.size());
}

/// before[i]: seams that end at a T on seam i and must be sewn first.
std::vector<std::set<int>> stems(const PanelSet& set, const Segmentation& s) {
    std::map<int, std::vector<std::pair<int, Vector3d>>> ends;   // node -> seam, direction away from the node
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        const std::vector<int>& n = s.seams[i].nodes;
        const auto direction = [&](int from, int to) { return Vector3d((s.mesh.x[to] - s.mesh.x[from]).normalized()); };
        ends[n.front()].emplace_back(i, direction(n[0], n[1]));
        ends[n.back()].emplace_back(i, direction(n[n.size() - 1], n[n.size() - 2]));
    }
    std::vector<std::set<int>> before(set.seams.size());
    for (const auto& [node, spokes] : ends) {
        if (spokes.size() != 3) continue;
        for (int stem = 0; stem < 3; ++stem) {
            const auto &a = spokes[(stem + 1) % 3], &b = spokes[(stem + 2) % 3];
            if (a.second.dot(b.second) > -straight_run) continue;
            if (set.seams[spokes[stem].first].is_rim()) continue;
            for (int run : {a.first, b.first})
                if (run != spokes[stem].first) before[run].insert(spokes[stem].first);
        }
    }
    return before;
}

/// The rims of every loop of the boundary, in the order in which they follow each other.
std::vector<std::vector<int>> rim_loops(const PanelSet& set, const Segmentation& s) {
    std::map<int, int> starting;   // node -> rim that begins there
    for (std::size_t i = 0; i < set.seams.size(); ++i)
        if (set.seams[i].is_rim()) starting[s.seams[i].nodes.front()] = static_cast<int>(i);
    std::vector<std::vector<int>> loops;
    while (!starting.empty()) {
        std::vector<int> loop;
        for (auto next = starting.begin(); next != starting.end(); next = starting.find(s.seams[loop.back()].nodes.back())) {
            loop.push_back(next->second);
            starting.erase(next);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

/// A slit that ends inside its panel; a seam between two far edges of one panel closes a tube instead.
bool is_dart(const PanelSeam& seam) {
    return seam.side[0].panel == seam.side[1].panel && (seam.side[0].vertex.front() == seam.side[1].vertex.front() ||
                                                        seam.side[0].vertex.back() == seam.side[1].vertex.back());
}

}  // namespace

std::string_view to_string(StepKind k) {
    switch (k) {
        case StepKind::dart: return "dart";
        case StepKind::join: return "join";
        case StepKind::close: return "close";
        case StepKind::hem: return "hem";
        case StepKind::opening: return "opening";
    }
    return "?";
}

std::vector<SewingStep> sewing_order(const PanelSet& set, const Segmentation& s, const Vector3d& up) {
    const int n = static_cast<int>(set.seams.size());
    bool has_rim = false;
    int opening = -1;   // of a closed bag: its highest seam
    double highest = -std::numeric_limits<double>::infinity();
    for (const PanelSeam& seam : set.seams) has_rim = has_rim || seam.is_rim();
    for (int i = 0; i < n && !has_rim; ++i) {
        const double height = mean_height(s, i, up);
        if (height > highest) highest = height, opening = i;
    }

    Parts parts(set);
    const std::vector<std::set<int>> before = stems(set, s);
    std::vector<char> done(n, 0);
    std::vector<SewingStep> order;
    const auto sew = [&](int i, StepKind kind) {
        const int a = set.seams[i].side[0].panel, b = set.seams[i].side[1].panel;
        SewingStep step{kind, {i}, {a}, parts.open(a) - 2 * set.seams[i].rest_length};
        if (a != b) step.panels.push_back(b);
        if (parts.find(a) != parts.find(b)) step.open_before += parts.open(b);
        parts.sew(a, b, set.seams[i].rest_length);
        done[i] = 1;
        order.push_back(std::move(step));
    };

    while (true) {
        int best = -1;
        std::tuple<int, int, double> best_rank;
        for (int i = 0; i < n; ++i) {
            const PanelSeam& seam = set.seams[i];
            if (done[i] || seam.is_rim() || i == opening) continue;
            const int a = seam.side[0].panel, b = seam.side[1].panel;
            int waiting = 0;   // stems not sewn yet; a ring of stems has no first one, then the fewest go first
            for (int stem : before[i]) waiting += !done[stem] && stem != opening;
            const int kind = is_dart(seam) ? 0 : parts.find(a) != parts.find(b) ? 1 : 2;
            const std::tuple rank{waiting, kind, mean_height(s, i, up)};   // low seams first: the top stays open longest
            if (best < 0 || rank < best_rank) best = i, best_rank = rank;
        }
        if (best < 0) break;
        const PanelSeam& seam = set.seams[best];
        const int a = seam.side[0].panel, b = seam.side[1].panel;
        sew(best, is_dart(seam) ? StepKind::dart : parts.find(a) != parts.find(b) ? StepKind::join : StepKind::close);
    }
    std::vector<std::vector<int>> loops = rim_loops(set, s);
    const auto height = [&](const std::vector<int>& loop) {
        double sum = 0, length = 0;
        for (int i : loop) sum += set.seams[i].rest_length * mean_height(s, i, up), length += set.seams[i].rest_length;
        return sum / length;
    };
    std::stable_sort(loops.begin(), loops.end(), [&](const auto& a, const auto& b) { return height(a) < height(b); });
    for (const std::vector<int>& loop : loops) {
        SewingStep step{StepKind::hem, loop, {}, parts.open(set.seams[loop.front()].side[0].panel)};
        for (int i : loop)
            if (const int p = set.seams[i].side[0].panel; std::find(step.panels.begin(), step.panels.end(), p) == step.panels.end()) step.panels.push_back(p);
        order.push_back(std::move(step));
    }
    if (!has_rim && opening >= 0) sew(opening, StepKind::opening);

    constexpr double closed = 1e-9;   // m
    for (std::size_t k = 0; k + 1 < order.size(); ++k)
        if (order[k].kind != StepKind::hem && order[k].open_before < closed)
            throw arcsim::NumericalError("panels: step " + std::to_string(k + 1) + ", seam " + seam_name(set, order[k].seams.front()) +
                                         ", would have to be sewn inside a closed bag.");
    return order;
}

}  // namespace formwork
