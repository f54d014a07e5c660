#include "formwork/segment/field_paths.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace formwork {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
using Item = std::pair<float, int>;
using Queue = std::priority_queue<Item, std::vector<Item>, std::greater<>>;

}  // namespace

BorderPaths::BorderPaths(const FieldGraph& graph, const std::vector<double>& landing)
    : graph_(graph), cost_(graph.n_nodes(), infinite), next_(graph.n_nodes(), -1), met_by_(graph.n_samples(), 0) {
    Queue queue;
    for (int i = 0; i < graph.n_samples(); ++i) {
        if (!graph.is_border(i) || !(landing[i] < infinite)) continue;
        for (int k = 0; k < 4; ++k) queue.emplace(cost_[4 * i + k] = static_cast<float>(landing[i]), 4 * i + k);
    }
    while (!queue.empty()) {
        const auto [c, node] = queue.top();
        queue.pop();
        if (c > cost_[node]) continue;
        // Arcs have the same cost both ways: those that lead here are those that leave on the opposite layer.
        const int back = FieldGraph::opposite(node);
        for (const auto* a = graph.arcs_begin(back); a != graph.arcs_end(back); ++a) {
            const int before = FieldGraph::opposite(a->to);
            if (graph.is_border(before / 4) || c + a->cost >= cost_[before]) continue;
            next_[before] = node;
            queue.emplace(cost_[before] = c + a->cost, before);
        }
    }
}

Path BorderPaths::walk(int node) const {
    Path p;
    p.cost = cost_[node];
    for (; node >= 0; node = next_[node]) p.samples.push_back(node / 4);
    return p;
}

std::optional<Path> BorderPaths::join(const Path& back, const Path& forth) const {
    Path p{{back.samples.rbegin(), back.samples.rend()}, back.cost + forth.cost};
    p.samples.insert(p.samples.end(), forth.samples.begin() + 1, forth.samples.end());
    ++n_joined_;
    for (int i : p.samples)
        if (std::exchange(met_by_[i], n_joined_) == n_joined_) return {};
    return p;
}

std::optional<Path> BorderPaths::through(int sample, int layer) const {
    const int node = 4 * sample + layer;
    if (cost_[node] == infinite || cost_[FieldGraph::opposite(node)] == infinite) return {};
    return join(walk(FieldGraph::opposite(node)), walk(node));
}

const FieldGraph::Arc* BorderPaths::best_arc(const FieldGraph::Port& p) const {
    const FieldGraph::Arc* best = nullptr;
    for (const auto& a : p.arcs)
        if (cost_[a.to] < infinite && (!best || a.cost + cost_[a.to] < best->cost + cost_[best->to])) best = &a;
    return best;
}

double BorderPaths::cost(const FieldGraph::Port& p) const {
    const FieldGraph::Arc* best = best_arc(p);
    return best ? best->cost + cost_[best->to] : infinite;
}

std::optional<Path> BorderPaths::from_port(const FieldGraph::Port& p) const {
    const FieldGraph::Arc* best = best_arc(p);
    if (!best) return {};
    Path walked = walk(best->to);
    walked.samples.insert(walked.samples.begin(), p.vertex);
    walked.cost += best->cost;
    return walked;
}

std::optional<Path> BorderPaths::through_ports(const FieldGraph::Port& p, const FieldGraph::Port& q) const {
    const auto back = from_port(p), forth = from_port(q);
    if (!back || !forth) return {};
    return join(*back, *forth);
}

std::optional<Path> closed_path(const FieldGraph& graph, int vertex, int layer, double limit) {
    const int start = 4 * vertex + layer;
    std::unordered_map<int, std::pair<float, int>> reached;   // node -> (cost, from)
    Queue queue;
    const auto relax_from = [&](int node, float c) {
        for (const auto* a = graph.arcs_begin(node); a != graph.arcs_end(node); ++a) {
            if (graph.is_border(a->to / 4) || c + a->cost > limit) continue;
            const auto [it, is_new] = reached.try_emplace(a->to, c + a->cost, node);
            if (!is_new) {
                if (c + a->cost >= it->second.first) continue;
                it->second = {c + a->cost, node};
            }
            queue.emplace(c + a->cost, a->to);
        }
    };
    relax_from(start, 0);
    while (!queue.empty()) {
        const auto [c, node] = queue.top();
        queue.pop();
        if (c > reached[node].first) continue;
        if (node == start) break;
        relax_from(node, c);
    }
    const auto end = reached.find(start);
    if (end == reached.end()) return {};
    Path p{{vertex}, end->second.first};
    for (int node = end->second.second; node != start; node = reached[node].second) p.samples.push_back(node / 4);
    std::vector<int> sorted = p.samples;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
    p.samples.push_back(vertex);
    std::reverse(p.samples.begin(), p.samples.end());
    return p;
}

std::optional<Path> plain_path(const FieldGraph& graph, const std::vector<int>& from, const std::vector<int>& to) {
    std::vector<float> cost(graph.n_samples(), infinite);
    std::vector<int> before(graph.n_samples(), -1);
    std::vector<char> is_target(graph.n_samples(), 0);
    for (int i : to) is_target[i] = 1;
    Queue queue;
    for (int i : from) queue.emplace(cost[i] = 0, i);
    int end = -1;
    while (!queue.empty() && end < 0) {
        const auto [c, i] = queue.top();
        queue.pop();
        if (c > cost[i]) continue;
        if (is_target[i] && before[i] >= 0) end = i;
        if (graph.is_border(i) && before[i] >= 0) continue;
        for (int k = 0; k < 4; ++k)
            for (const auto* a = graph.arcs_begin(4 * i + k); a != graph.arcs_end(4 * i + k); ++a) {
                const int j = a->to / 4;
                if (graph.is_border(j) && !is_target[j]) continue;
                if (c + a->cost >= cost[j]) continue;
                cost[j] = c + a->cost;
                before[j] = i;
                queue.emplace(cost[j], j);
            }
    }
    if (end < 0) return {};
    Path p{{}, cost[end]};
    for (int i = end; i >= 0; i = before[i]) p.samples.push_back(i);
    std::reverse(p.samples.begin(), p.samples.end());
    return p;
}

}  // namespace formwork
