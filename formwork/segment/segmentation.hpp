#pragma once

#include <array>
#include <string>
#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "formwork/segment/cross_field.hpp"

namespace formwork {

using arcsim::Vector3d;

/// Where a node of the cut mesh lies on the input mesh.
struct SurfacePoint {
    int face = 0;                                 // of the input mesh
    std::array<double, 3> barycentric{1, 0, 0};   // of its three corners
};

/// One seam: a chain of nodes of the cut mesh between two layout nodes (or a closed loop), with one panel
/// on each side. A rim (`panel[1]` = -1) is a piece of the input's boundary and is hemmed, not sewn.
struct Seam {
    std::vector<int> nodes;           // of the cut mesh; first == last for a closed loop
    std::array<int, 2> panel{-1, -1}; // panel[0] lies to the left of the chain (seen from outside)
    bool is_rim() const { return panel[1] < 0; }
    bool is_loop() const { return nodes.size() > 1 && nodes.front() == nodes.back(); }
};

/// A curve along the field that was compared with others when a panel of the first search was to be split.
struct CandidateCurve {
    enum class Kind { crossing, loop, separatrix };   // from border to border; closed; through a singularity
    Kind kind = Kind::crossing;
    double cost = 0;                  // by (13)
    std::vector<Vector3d> points;     // on the surface, m
};

/// The cut surface: what `segment` hands to `panels` and `sew`.
struct Segmentation {
    Surface mesh;                           // rest surface, faces split along the seams, same orientation
    std::vector<SurfacePoint> source;       // per node of `mesh`
    std::vector<int> source_face;           // per face of `mesh`: the input face that it is a part of
    std::vector<int> panel;                 // per face of `mesh`, 0 .. n_panels-1
    int n_panels = 0;
    std::vector<Seam> seams;                // every border between panels, and the rims; a seam inside one
                                            // panel (a dart) has panel[0] == panel[1]
    std::vector<DirectionData> direction;   // per face of `mesh`: target of the weave
    std::vector<double> field_theta;        // per face of `mesh`: one arm of the smoothed field, from edge v0->v1
    std::vector<Singularity> singularities; // nodes of `mesh`
    std::vector<CandidateCurve> candidates; // every one of the layout that was chosen
    CrossField field;                       // the smoothed field, on the input mesh; not read back from files
    std::vector<std::string> violations;    // bounds that this layout does not meet, one line each; empty: valid
};

}  // namespace formwork
