#pragma once

#include <span>
#include <vector>

#include "formwork/segment/cut_mesh.hpp"

namespace formwork {

/// Panel number of every face: faces are of one panel when a walk over edges that are no seams joins them.
/// Numbered by the lowest face. @param n_panels is set
std::vector<int> label_panels(const CutMesh& cut, int& n_panels);

/// Faces of each panel, in increasing order.
std::vector<std::vector<int>> panel_faces(const std::vector<int>& panel, int n_panels);

/// One panel as a surface of its own, cut open along seams that end or run inside it.
struct PanelPatch {
    Surface surface;
    Topology topology;
    std::vector<int> node, face;   // local -> cut mesh
    std::vector<char> junction;    // per local node: three or more borders meet here, or a seam and the rim do
    std::vector<char> given;       // per local node: on the border, and every seam here was asked for

    bool is_disk() const { return topology.boundary_loops.size() == 1 && topology.euler_characteristic() == 1; }
    double area() const { return arcsim::total_area(surface); }
    double border_length() const;
};

/// Who is joined to whom by an edge of a patch, and how far away: for walks and shortest paths along edges.
class EdgeLengths {
public:
    struct Arc {
        int to;
        double length;   // m
    };
    explicit EdgeLengths(const PanelPatch& patch);
    std::span<const Arc> around(int node) const { return {arcs_.data() + start_[node], arcs_.data() + start_[node + 1]}; }

private:
    std::vector<int> start_;
    std::vector<Arc> arcs_;   // in the order of the edges
};

PanelPatch extract_patch(const CutMesh& cut, const std::vector<int>& faces);

/// Sum of the angles of the patch's faces at a node, rad: at a boundary node the interior angle.
double angle_sum(const PanelPatch& patch, int node);

/// Diameter of the largest disk in the patch, measured along edges: twice the largest distance to the border, m.
double patch_width(const PanelPatch& patch);

}  // namespace formwork
