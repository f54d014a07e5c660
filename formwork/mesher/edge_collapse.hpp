#pragma once

#include <vector>

#include "arcsim/mesh/surface.hpp"

namespace formwork {

/// A surface whose edges can be drawn together, and its lines: rims and creases, which keep their course. What both
/// coarseners share; which edge goes next, and what a face may become, is theirs.
struct CollapsingMesh {
    arcsim::Surface surface;                 // faces that are gone: {-1, -1, -1}
    std::vector<std::vector<int>> around;    // per node: its faces; empty once it is gone
    std::vector<std::vector<int>> line;      // per node: other ends of its rim and crease edges; two inside a line
    int n_faces;                             // that are left

    /// @param crease_cosine  of the angle between two faces' normals, below which their edge is a crease
    CollapsingMesh(const arcsim::Surface& s, double crease_cosine);

    bool is_on_line(int a, int b) const;
    /// The line's node after a, seen from b; a is inside a line, b its neighbour on it.
    int beyond(int a, int b) const { return line[a][line[a][0] == b ? 1 : 0]; }
    /// A node of a line is drawn along it only; an end or a crossing stays.
    bool keeps_lines(int a, int b) const { return line[a].empty() || (line[a].size() == 2 && is_on_line(a, b)); }
    /// Whether the surface stays one when a is drawn into b: they share a face, and no neighbours but those faces' apexes.
    bool keeps_surface(int a, int b) const;
    /// Draws a into b; b stays where it is. The faces that they share go.
    void draw(int a, int b);
    /// Appends the neighbours of a, each once.
    void ring(int a, std::vector<int>& nodes) const;
};

}  // namespace formwork
