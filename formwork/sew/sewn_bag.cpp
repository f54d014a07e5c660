#include "formwork/sew/sewn_bag.hpp"

#include <map>
#include <set>

#include "arcsim/base/error.hpp"
#include "formwork/sew/stitches.hpp"

namespace formwork {

std::vector<FlatTriangle> flat_from_panels(const Segmentation& s, const std::vector<FlatPanel>& panels) {
    std::vector<FlatTriangle> flat(s.mesh.faces.size());
    std::vector<char> seen(flat.size(), 0);
    for (const FlatPanel& panel : panels)
        for (size_t k = 0; k < panel.face.size(); ++k) {
            const Triangle& nodes = s.mesh.faces[panel.face[k]];
            // The panel's corners may start elsewhere than the face's.
            for (int c = 0; c < 3; ++c)
                for (int d = 0; d < 3; ++d)
                    if (panel.node[panel.faces[k][d]] == nodes[c]) flat[panel.face[k]][c] = panel.u[panel.faces[k][d]];
            seen[panel.face[k]] = 1;
        }
    for (size_t f = 0; f < seen.size(); ++f)
        if (!seen[f])
            throw arcsim::InputError("sew: face " + std::to_string(f) +
                                     " of the cut mesh lies in no panel. Run the stages segment and panels again.");
    return flat;
}

std::vector<char> fixed_on_cut_mesh(const Segmentation& s, const std::vector<Triangle>& input_faces,
                                    const std::vector<char>& input_fixed) {
    std::map<std::pair<int, int>, std::vector<int>> opposite;   // of each edge: the corners across
    for (const Triangle& t : input_faces)
        for (int k = 0; k < 3; ++k) opposite[std::minmax(t[(k + 1) % 3], t[(k + 2) % 3])].push_back(t[k]);
    constexpr double tiny = 1e-9;   // of a barycentric coordinate
    std::vector<char> fixed(3 * s.source.size(), 0);
    for (size_t i = 0; i < s.source.size(); ++i) {
        const Triangle& t = input_faces[s.source[i].face];
        std::vector<int> corners;
        for (int k = 0; k < 3; ++k)
            if (s.source[i].barycentric[k] > tiny) corners.push_back(t[k]);
        for (int axis = 0; axis < 3; ++axis) {
            const auto held = [&](int node) { return input_fixed[3 * node + axis] != 0; };
            bool all = true;
            for (int node : corners) all = all && held(node);
            if (all && corners.size() == 2) {   // inside an edge: a held border, or beside a held face
                const std::vector<int>& across = opposite.at(std::minmax(corners[0], corners[1]));
                bool beside = across.size() == 1;
                for (int node : across) beside = beside || held(node);
                all = beside;
            }
            fixed[3 * i + axis] = all;
        }
    }
    return fixed;
}

std::vector<Vector3d> carry_to_cut_mesh(const Segmentation& s, const std::vector<Triangle>& input_faces,
                                        const std::vector<Vector3d>& x) {
    std::vector<Vector3d> carried;
    for (const SurfacePoint& p : s.source) {
        const Triangle& t = input_faces[p.face];
        carried.push_back(p.barycentric[0] * x[t[0]] + p.barycentric[1] * x[t[1]] + p.barycentric[2] * x[t[2]]);
    }
    return carried;
}

std::vector<SeamEdge> seam_edges(const Segmentation& s) {
    std::map<std::pair<int, int>, int> face_of;   // of each directed edge
    for (int f = 0; f < s.mesh.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) face_of[{s.mesh.faces[f][k], s.mesh.faces[f][(k + 1) % 3]}] = f;
    std::vector<SeamEdge> edges;
    for (size_t seam = 0; seam < s.seams.size(); ++seam) {
        const Seam& chain = s.seams[seam];
        if (chain.is_rim()) continue;
        for (size_t k = 0; k + 1 < chain.nodes.size(); ++k) {
            const int a = chain.nodes[k], b = chain.nodes[k + 1];
            const auto left = face_of.find({a, b}), right = face_of.find({b, a});
            if (left == face_of.end() || right == face_of.end())
                throw arcsim::InputError("sew: seam " + std::to_string(seam) + " is not an inner edge of the cut mesh between nodes " +
                                         std::to_string(a) + " and " + std::to_string(b) + ". Run the stage segment again.");
            edges.push_back({static_cast<int>(seam), {a, b}, (s.mesh.x[b] - s.mesh.x[a]).norm(), {left->second, right->second}});
        }
    }
    return edges;
}

SewnBag make_sewn_bag(const SewInput& input, const SewParams& params) {
    const Segmentation& s = input.segmentation;
    SewnBag bag;
    bag.cut = s.mesh;
    bag.flat = flat_from_panels(s, input.panels);
    bag.fixed = fixed_on_cut_mesh(s, input.input_faces, input.input_fixed);
    bag.inflated = carry_to_cut_mesh(s, input.input_faces, input.inflated);
    // Held nodes stand where the rest shape has them, exactly: the carried positions differ by rounding.
    for (size_t i = 0; i < bag.inflated.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (bag.fixed[3 * i + axis]) bag.inflated[i][axis] = bag.cut.x[i][axis];
    bag.edges = seam_edges(s);
    bag.node_of_cut.resize(s.mesh.x.size());
    for (size_t i = 0; i < bag.node_of_cut.size(); ++i) bag.node_of_cut[i] = static_cast<int>(i);
    const bool slack = params.thread_compression == ThreadCompression::slack;
    for (const SeamEdge& e : bag.edges) bag.springs.push_back({e.node[0], e.node[1], e.length, params.kappa(e.length), slack});
    if (params.seams == SeamModel::stitch) split_into_stitches(s, params, bag);
    return bag;
}

EquilibriumProblem sewn_problem(const SewInput& input, const SewParams& params, const SewnBag& bag) {
    EquilibriumProblem p;
    p.rest = bag.cut;
    p.flat = bag.flat;
    p.start = params.start == SewStart::inflated ? bag.inflated : bag.cut.x;
    p.fixed = bag.fixed;
    p.up = input.up;
    p.plaster = input.plaster;
    if (p.plaster.fill) {
        const bool by_volume = p.plaster.fill->volume || p.plaster.fill->fraction;
        FillParams same;
        if (by_volume) same.volume = input.inflated_volume;
        else same.level = input.inflated_level;
        if (same.volume || same.level) p.plaster.fill = same;
    }
    p.pressure = params.pressure;
    p.pressure_jacobian = params.pressure_jacobian;
    p.material = params.material;
    p.fabric_density = params.density;
    p.self_weight = params.self_weight;
    p.seams = bag.springs;
    p.solver = params.solver;
    return p;
}

}  // namespace formwork
