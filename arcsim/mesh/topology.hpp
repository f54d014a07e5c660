#pragma once

#include <array>
#include <string>
#include <vector>

#include "arcsim/mesh/surface.hpp"

namespace arcsim {

/// One edge of a manifold surface. `face[0]` runs through it from node[0] to node[1] in its own corner
/// order, `face[1]` from node[1] to node[0]; face[1] is -1 on the boundary.
/// `corner[i]` is the corner of face[i] opposite the edge.
struct Edge {
    std::array<int, 2> node;
    std::array<int, 2> face{-1, -1};
    std::array<int, 2> corner{-1, -1};
    bool is_boundary() const { return face[1] < 0; }
};

/// The corner at which a face has one of its nodes.
inline int corner_of(const Triangle& face, int node) { return face[0] == node ? 0 : face[1] == node ? 1 : 2; }

/// Angle by which the surface bends at an inner edge, rad: 0 where it is flat, either way positive.
double bend_angle(const Surface& s, const Edge& e);

/// Who touches whom on a manifold, consistently oriented surface. Edges are numbered in the order of
/// their first face, so the numbering depends on the faces' order alone.
struct Topology {
    std::vector<Edge> edges;
    std::vector<std::array<int, 3>> face_edges;       // [k] is opposite corner k
    std::vector<std::vector<int>> node_faces;         // counter-clockwise fan; starts at the boundary, if any
    std::vector<std::vector<int>> boundary_loops;     // node chains, in the direction of the faces' edges
    std::vector<int> component;                       // per node; -1: node without faces
    int n_components = 0;

    int neighbour(int face, int k) const {            // across the edge opposite corner k; -1: boundary
        const Edge& e = edges[face_edges[face][k]];
        return e.face[0] == face ? e.face[1] : e.face[0];
    }
    bool is_boundary_node(int node) const { return boundary_node[node]; }
    std::vector<char> boundary_node;

    /// V - E + F over the nodes that have faces.
    int euler_characteristic() const;
};

/// What stands in the way of a Topology, each by node and face numbers (0-based).
struct TopologyDefects {
    std::vector<std::array<int, 2>> nonmanifold_edges;    // edges of three or more faces
    std::vector<std::array<int, 2>> misoriented_edges;    // two faces run through it the same way
    std::vector<int> nonmanifold_nodes;                   // several fans meet in one node
    std::vector<int> isolated_nodes;                      // nodes without faces
    std::vector<int> repeated_corner_faces;               // a face with the same node twice
    bool empty() const {                                  // isolated nodes do not prevent a Topology
        return nonmanifold_edges.empty() && misoriented_edges.empty() && nonmanifold_nodes.empty() &&
               repeated_corner_faces.empty();
    }
};

TopologyDefects find_defects(const Surface& s);

/// @throws InputError naming the first defect and how to mend it
Topology build_topology(const Surface& s, const std::string& source_name = "mesh");

/// The last step of it alone, for a topology whose edges and fans are known: components and boundary loops.
void find_components_and_loops(const Surface& s, Topology& t);

}  // namespace arcsim
