#include "formwork/segment/panel_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formwork/segment/degree.hpp"

namespace formwork {
namespace {

constexpr double junction_turn = 40 * degree, corner_turn = 50 * degree;
constexpr double arm_share = 1. / 16, arm_edges = 4, longest_arm = 1. / 8;   // of the loop; edges of mean length; of the loop

/// One border loop of a patch: how far round its nodes lie, and how the outline turns there.
class OutlineLoop {
public:
    OutlineLoop(const PanelPatch& p, const std::vector<int>& loop) : patch_(p), loop_(loop), place_(loop.size() + 1, 0), turn_(loop.size()) {
        for (int i = 0; i < size(); ++i) {
            place_[i + 1] = place_[i] + (x(i + 1) - x(i)).norm();
            turn_[i] = p.given[loop[i]] ? 0 : std::numbers::pi - angle_sum(p, loop[i]);
        }
        close_darts();
        arm_ = length() * std::min(std::max(arm_share, arm_edges / size()), longest_arm);
        for (int i = 0; i < size(); ++i) seen_.push_back(turn_around(i));
    }

    double length() const { return place_.back(); }
    /// The turn at node i seen over an arm's length, rad; positive where the outline turns as round a disk.
    double turn(int i) const { return seen_[i]; }

    /// Nodes at which the outline turns most, more than `corner_turn`, and more than within half an arm of it.
    std::vector<int> corners(double care) const {
        std::vector<int> order, chosen;
        for (int i = 0; i < size(); ++i)
            if (std::abs(seen_[i]) > care * (patch_.junction[loop_[i]] ? junction_turn : corner_turn)) order.push_back(i);
        const auto weight = [&](int i) { return std::abs(seen_[i]) + 0.1 * std::abs(turn_[i]); };   // among equals, the node that turns itself
        std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return weight(i) > weight(j); });
        std::vector<char> covered(loop_.size(), 0);
        for (int i : order) {
            if (!covered[i]) chosen.push_back(i);
            each_within(i, 0.5 * arm_, [&](int j, double) { covered[j] = 1; });   // by lesser ones too: the flank of a peak is no corner
        }
        std::sort(chosen.begin(), chosen.end());
        return chosen;
    }

    /// Opening of the outline at node i: between the points `reach` m before and behind it, rad.
    double opening(int i, double reach) const {
        const double arm = std::min(reach, length() * longest_arm);
        return 2 * std::asin(std::min(1., (point(place_[i] + arm) - point(place_[i] - arm)).norm() / (2 * arm)));
    }

private:
    int size() const { return static_cast<int>(loop_.size()); }
    const Vector3d& x(int i) const { return patch_.surface.x[loop_[i % size()]]; }

    /// body(node, distance along the outline) for every node nearer than `reach` to node i, itself among them.
    template <class Body>
    void each_within(int i, double reach, Body body) const {
        body(i, 0.);
        for (int step : {1, -1})
            for (int j = (i + step + size()) % size(); j != i; j = (j + step + size()) % size()) {
                const double apart = std::abs(place_[j] - place_[i]), gone = std::min(apart, length() - apart);
                if (gone >= reach) break;
                body(j, gone);
            }
    }

    int wrapped(int i) const { return (i % size() + size()) % size(); }

    /// A dart is sewn before its panel is: its tip and sides do not turn, and the outline runs on over its mouth.
    void close_darts() {
        for (int tip = 0; tip < size(); ++tip) {
            const auto is_shut = [&](int k) { return patch_.node[loop_[wrapped(tip - k)]] == patch_.node[loop_[wrapped(tip + k)]]; };
            int mouth = 0;
            while (2 * (mouth + 1) < size() && is_shut(mouth + 1)) ++mouth;
            if (mouth == 0) continue;
            const double both = turn_[wrapped(tip - mouth)] + turn_[wrapped(tip + mouth)] - std::numbers::pi;
            for (int k = -mouth; k <= mouth; ++k) turn_[wrapped(tip + k)] = 0;
            turn_[wrapped(tip - mouth)] = both;
        }
    }

    double turn_around(int i) const {
        double sum = 0;
        each_within(i, arm_, [&](int j, double gone) { sum += (1 - gone / arm_) * turn_[j]; });
        return sum;
    }

    Vector3d point(double place) const {
        place -= length() * std::floor(place / length());
        const int i = std::clamp(static_cast<int>(std::upper_bound(place_.begin(), place_.end(), place) - place_.begin()) - 1, 0, size() - 1);
        return x(i) + (place - place_[i]) / (place_[i + 1] - place_[i]) * (x(i + 1) - x(i));
    }

    const PanelPatch& patch_;
    const std::vector<int>& loop_;
    std::vector<double> place_;   // m along the outline; one more than nodes: the last is the length
    std::vector<double> turn_, seen_;
    double arm_ = 0;              // m
};

}  // namespace

std::vector<int> corner_nodes(const PanelPatch& p, double care) {
    std::vector<int> nodes;
    for (const auto& loop : p.topology.boundary_loops)
        for (int i : OutlineLoop(p, loop).corners(care)) nodes.push_back(loop[i]);
    return nodes;
}

OutlineShape outline_shape(const PanelPatch& p, double reach, double care) {
    constexpr double sharp = 70 * degree;   // turn of a corner that may be a tip
    OutlineShape shape;
    for (const auto& nodes : p.topology.boundary_loops) {
        const OutlineLoop loop(p, nodes);
        for (int i : loop.corners(care)) {
            ++shape.corners;
            if (loop.turn(i) < 0) ++shape.inner_corners;
            if (loop.turn(i) > sharp) shape.sharpest = std::min({shape.sharpest, std::numbers::pi - loop.turn(i), loop.opening(i, reach)});
            if (p.junction[nodes[i]]) shape.sharpest = std::min(shape.sharpest, angle_sum(p, nodes[i]));
        }
    }
    shape.sharpest = std::max(0., shape.sharpest);
    return shape;
}

}  // namespace formwork
