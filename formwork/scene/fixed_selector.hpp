#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/mesh/cloth_mesh.hpp"
#include "arcsim/mesh/topology.hpp"

namespace formwork {

using arcsim::Vector3d;

struct SphereRegion {
    Vector3d center{0, 0, 0};
    double radius = 0;   // m
};
template <class Archive>
void visit(Archive& a, SphereRegion& p) {
    a.required("center", p.center, "m", arcsim::any_number, "Centre, in world coordinates.");
    a.required("radius", p.radius, "m", arcsim::positive, "Radius.");
}

struct BoxRegion {
    Vector3d min{0, 0, 0}, max{0, 0, 0};   // m
};
template <class Archive>
void visit(Archive& a, BoxRegion& p) {
    a.required("min", p.min, "m", arcsim::any_number, "Lowest corner, in world coordinates.");
    a.required("max", p.max, "m", arcsim::any_number, "Highest corner.");
    a.check((p.min.array() <= p.max.array()).all(), "max", "every coordinate must be at least that of \"min\".");
}

/// Which nodes of the rest mesh are held, and along which axes. Exactly one way of choosing.
struct FixedSelector {
    std::optional<std::string> boundary;     // "top", "bottom", "all", or the number of a loop
    std::optional<int> label;                // nl of the OBJ
    std::optional<std::vector<int>> nodes;   // counted from 0
    std::optional<bool> all;
    std::optional<std::string> group;        // nodes of the faces of an OBJ group
    std::optional<SphereRegion> sphere;
    std::optional<BoxRegion> box;
    std::string axes = "xyz";
};
template <class Archive>
void visit(Archive& a, FixedSelector& p) {
    using namespace arcsim;
    a.name_or_index("boundary", p.boundary,
                    "A boundary loop: \"top\", \"bottom\", \"all\", or its number (0 is the longest).");
    a.optional("label", p.label, "", non_negative, "Nodes with this label (nl in the OBJ).");
    a.optional("nodes", p.nodes, "", non_negative, "Nodes by number, counted from 0.");
    a.optional("all", p.all, "Every node, for holding single axes.");
    a.optional("group", p.group, "Nodes of the faces of this OBJ group.");
    a.nested("sphere", p.sphere, "Nodes inside a sphere.");
    a.nested("box", p.box, "Nodes inside a box.");
    a.exactly_one_of({"boundary", "label", "nodes", "all", "group", "sphere", "box"});
    a.optional("axes", p.axes, "Directions that are held: any of x, y, z.");
    a.check(!p.axes.empty() && p.axes.find_first_not_of("xyz") == std::string::npos, "axes",
            "expected some of the letters x, y, z, for example \"z\".");
}

/// Boundary loops as the scene numbers them: by decreasing length.
struct BoundaryLoop {
    std::vector<int> nodes;
    double length = 0;        // m
    double mean_height = 0;   // along up, m
    std::string name;         // "top", "bottom" or the number
};
std::vector<BoundaryLoop> boundary_loops(const arcsim::Surface& s, const arcsim::Topology& t, const Vector3d& up);

/// 3n flags by 3 node + axis.
/// @param where  for messages: "column.json: /formwork/fixed"
/// @throws InputError when a selector chooses no node, names a loop, group or node that does not exist, or
///         when nothing is held in all three directions somewhere
std::vector<char> held_dofs(const std::vector<FixedSelector>& selectors, const arcsim::ClothMesh& mesh,
                            const arcsim::Topology& t, const Vector3d& up, const std::string& where);

}  // namespace formwork
