#pragma once

#include <optional>
#include <vector>

#include "formwork/segment/field_graph.hpp"

namespace formwork {

/// A walk over samples of a graph; `cost` by (13).
struct Path {
    std::vector<int> samples;
    double cost = 0;
};

/// The cheapest way from every node of the graph, along its layer, to the border: one Dijkstra serves every
/// border-to-border curve of a panel, since a curve through a sample is its way along one layer joined to its
/// way along the opposite one.
class BorderPaths {
public:
    /// @param landing  per sample, cost of ending there (infinite: not allowed); read at border samples
    BorderPaths(const FieldGraph& graph, const std::vector<double>& landing);

    double cost(int node) const { return cost_[node]; }
    /// The curve through a sample along layers `layer` and `layer + 2`; nothing when one of them does not
    /// arrive, or when the curve meets itself.
    std::optional<Path> through(int sample, int layer) const;
    /// The cost of leaving a singular vertex by a port; infinite when that way does not arrive.
    double cost(const FieldGraph::Port& p) const;
    /// The curve from border to border through two ports of one singular vertex.
    std::optional<Path> through_ports(const FieldGraph::Port& p, const FieldGraph::Port& q) const;

private:
    Path walk(int node) const;
    std::optional<Path> join(const Path& back, const Path& forth) const;
    const FieldGraph::Arc* best_arc(const FieldGraph::Port& p) const;
    std::optional<Path> from_port(const FieldGraph::Port& p) const;

    const FieldGraph& graph_;
    std::vector<float> cost_;
    std::vector<int> next_;
    mutable std::vector<int> met_by_;   // per sample: number of the last joined curve that ran through it
    mutable int n_joined_ = 0;
};

/// The cheapest closed curve through a vertex along a layer. @param limit  give up beyond this cost
std::optional<Path> closed_path(const FieldGraph& graph, int vertex, int layer, double limit);

/// The shortest path between two sets of samples, whatever the layers (strokes, and the last resort when
/// the field offers nothing). Never runs along or through the border except at its ends.
std::optional<Path> plain_path(const FieldGraph& graph, const std::vector<int>& from, const std::vector<int>& to);

}  // namespace formwork
