#pragma once

#include <optional>
#include <vector>

#include "formwork/equilibrium/equilibrium.hpp"
#include "formwork/panels/flat_panel.hpp"
#include "formwork/segment/segmentation.hpp"
#include "formwork/sew/sew_params.hpp"

namespace formwork {

/// What the sewn bag is made of; all of it comes from earlier stages.
struct SewInput {
    const Segmentation& segmentation;
    const std::vector<FlatPanel>& panels;
    const std::vector<Triangle>& input_faces;   // of the mesh that was segmented
    const std::vector<Vector3d>& inflated;      // its nodes in the inflated shape, m
    const std::vector<char>& input_fixed;       // its held degrees of freedom, 3n flags
    Vector3d up{0, 0, 1};
    PlasterParams plaster;
    std::optional<double> inflated_level;       // m: fills given by level or depth keep this level ...
    std::optional<double> inflated_volume;      // m³: ... those given by volume or fraction this volume
    std::optional<Surface> target;              // the shape that the cast should have
    const Surface* designed = nullptr;          // the cast is compared with it; null: with the surface that is cut
};

/// One edge of a seam: where thread and panels meet.
struct SeamEdge {
    int seam = 0;                     // of Segmentation::seams
    std::array<int, 2> node;          // of Segmentation::mesh
    double length = 0;                // L, on the surface that was cut, m
    std::array<int, 2> face{-1, -1};  // of the panel left and right of the chain
};

/// The sewn bag before it is filled.
struct SewnBag {
    Surface cut;                       // the surface that was cut; its nodes and faces are those of the problem
    std::vector<FlatTriangle> flat;    // per face: rest coordinates in the weave frame, m
    std::vector<char> fixed;           // 3n flags
    std::vector<Vector3d> inflated;    // nodes on the inflated isotropic shape
    std::vector<SeamEdge> edges;       // of sewn seams, darts included; rims are not sewn
    std::vector<SeamSpring> springs;   // (10); with `stitch` also the stitches
    std::vector<int> node_of_cut;      // per node of `cut`: node of Segmentation::mesh
    int n_stitches = 0;                // the last ones of `springs`
};

/// Rest coordinates per face of the segmentation's mesh, from the panel that the face lies in.
/// @throws InputError: a face that lies in no panel
std::vector<FlatTriangle> flat_from_panels(const Segmentation& s, const std::vector<FlatPanel>& panels);

/// Held degrees of freedom of the cut mesh: those of the input's nodes, and of points that the cut made on a held
/// border or inside held faces.
std::vector<char> fixed_on_cut_mesh(const Segmentation& s, const std::vector<Triangle>& input_faces,
                                    const std::vector<char>& input_fixed);

/// Positions of the cut mesh's nodes on a deformed input mesh, by their barycentric coordinates.
std::vector<Vector3d> carry_to_cut_mesh(const Segmentation& s, const std::vector<Triangle>& input_faces,
                                        const std::vector<Vector3d>& x);

/// Edges of all sewn seams. @throws InputError: a seam that does not run along edges of the mesh
std::vector<SeamEdge> seam_edges(const Segmentation& s);

SewnBag make_sewn_bag(const SewInput& input, const SewParams& params);

/// The same equilibrium as the inflated bag's, of another fabric: liquid, level, held nodes.
EquilibriumProblem sewn_problem(const SewInput& input, const SewParams& params, const SewnBag& bag);

}  // namespace formwork
