#pragma once

#include <vector>

#include "formwork/segment/cross_field.hpp"
#include "formwork/segment/cut_mesh.hpp"

namespace formwork {

/// Cost of running along a curve, (13):
///
///   cost(v -> w) = |w - v| / lambda_u (1 + alpha (angle / theta_max)²)
///
/// lambda_u is the stretch along the layer's direction u; steps that drift by more than theta_max do not exist.
struct DriftCost {
    double alpha = 5;           // drift_penalty
    double theta_max = 0.7854;  // rad
};

/// The field on one surface, ready to be followed: per face one arm, and the strain along any direction.
struct SurfaceField {
    std::vector<double> theta;            // per face: one arm, from edge v0->v1, rad
    std::vector<DirectionData> data;      // per face
};

/// The field-coherent graph of [Pietroni et al. 2016]: its nodes are samples (every vertex, and
/// `per_edge` points inside every edge) times four layers, one per arm of the cross. An arc leads within one
/// face from a sample to another along the layer's arm; crossing an edge or turning about a vertex changes the
/// layer by the field's matching, so that following arcs follows the field.
///
/// At a singular vertex the layers are not told apart: no arc enters it, and arcs leave it by `ports`, one for
/// each arm that starts there (3, 5, 2 or 6).
class FieldGraph {
public:
    struct Arc {
        int to;        // node: 4 sample + layer, the layer in which the walk goes on
        float cost;
    };
    /// Sectors around a singular vertex that one arm leads out of.
    struct Port {
        int vertex;
        std::vector<Arc> arcs;
    };

    FieldGraph(const Surface& s, const Topology& t, const SurfaceField& field, const DriftCost& cost, int per_edge);

    int n_samples() const { return static_cast<int>(points_.size()); }
    int n_nodes() const { return 4 * n_samples(); }
    const CurvePoint& point(int sample) const { return points_[sample]; }
    bool is_border(int sample) const { return border_[sample]; }
    bool is_singular(int vertex) const { return singular_[vertex]; }
    const std::vector<Port>& ports() const { return ports_; }

    const Arc* arcs_begin(int node) const { return arcs_.data() + start_[node]; }
    const Arc* arcs_end(int node) const { return arcs_.data() + start_[node + 1]; }
    static int opposite(int node) { return (node & ~3) | ((node + 2) & 3); }

private:
    struct Raw {
        int from;
        Arc arc;
    };
    struct Leaving {   // an arc out of a singular vertex, in the face's own layer
        int vertex, face, layer;
        Arc arc;
    };
    void match(const Surface& s, const Topology& t, const SurfaceField& field);
    void place_samples(const Surface& s, const Topology& t, int per_edge);
    void add_face(const Surface& s, const Topology& t, const SurfaceField& field, const DriftCost& cost, int per_edge,
                  int f, std::vector<Raw>& raw, std::vector<Leaving>& leaving) const;
    void find_ports(const Surface& s, const SurfaceField& field, std::vector<Leaving> leaving);

    std::vector<std::array<int, 3>> vertex_layer_;   // per face, corner: face layer = vertex layer + this
    std::vector<std::array<double, 3>> fan_angle_;   // per face, corner of a boundary vertex: where the face's sector begins
    std::vector<double> total_angle_;                // per boundary vertex
    std::vector<int> edge_match_;                    // per edge: layer in face[1] = layer in face[0] + this
    std::vector<CurvePoint> points_;
    std::vector<char> border_, singular_;
    std::vector<int> start_;
    std::vector<Arc> arcs_;
    std::vector<Port> ports_;
};

}  // namespace formwork
