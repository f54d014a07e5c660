#include "formwork/scene/fixed_selector.hpp"

#include <algorithm>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"

namespace formwork {

using arcsim::InputError;

std::vector<BoundaryLoop> boundary_loops(const arcsim::Surface& s, const arcsim::Topology& t, const Vector3d& up) {
    std::vector<BoundaryLoop> loops;
    for (const std::vector<int>& chain : t.boundary_loops) {
        BoundaryLoop loop{chain, 0, 0, ""};
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const Vector3d &a = s.x[chain[i]], &b = s.x[chain[(i + 1) % chain.size()]];
            const double d = (b - a).norm();
            loop.length += d;
            loop.mean_height += d * (a + b).dot(up) / 2;
        }
        loop.mean_height /= std::max(loop.length, 1e-300);
        loops.push_back(std::move(loop));
    }
    std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.length > b.length; });
    for (std::size_t i = 0; i < loops.size(); ++i) loops[i].name = std::to_string(i);
    const auto by_height = [](const auto& a, const auto& b) { return a.mean_height < b.mean_height; };
    if (!loops.empty()) {
        std::min_element(loops.begin(), loops.end(), by_height)->name = "bottom";
        std::max_element(loops.begin(), loops.end(), by_height)->name = "top";   // a single loop answers to both
    }
    return loops;
}

namespace {

std::vector<int> loop_nodes(const std::string& name, const std::vector<BoundaryLoop>& loops, const std::string& where) {
    if (loops.empty())
        throw InputError(where + "/boundary: the mesh is closed and has no boundary loop. Cut an opening, or hold nodes by \"sphere\", \"box\" or \"nodes\".");
    std::vector<int> nodes;
    long number = -1;
    const bool is_number = arcsim::parse_integer(name, number);
    if (!is_number && name != "top" && name != "bottom" && name != "all")
        throw InputError(where + "/boundary: expected \"top\", \"bottom\", \"all\" or a number from 0, got \"" + name + "\".");
    if (is_number && (number < 0 || number >= static_cast<long>(loops.size())))
        throw InputError(where + "/boundary: there is no loop " + name + "; the mesh has " + std::to_string(loops.size()) +
                         ", numbered from 0 by decreasing length. `formwork check` lists them.");
    const auto by_height = [](const auto& a, const auto& b) { return a.mean_height < b.mean_height; };
    const auto low = std::min_element(loops.begin(), loops.end(), by_height);
    const auto high = std::max_element(loops.begin(), loops.end(), by_height);
    for (auto loop = loops.begin(); loop != loops.end(); ++loop)
        if (name == "all" || (is_number && number == loop - loops.begin()) || (name == "top" && loop == high) ||
            (name == "bottom" && loop == low))
            nodes.insert(nodes.end(), loop->nodes.begin(), loop->nodes.end());
    return nodes;
}

std::vector<int> chosen_nodes(const FixedSelector& f, const arcsim::ClothMesh& mesh, const std::vector<BoundaryLoop>& loops,
                              const std::string& where) {
    std::vector<int> nodes;
    const auto add_if = [&](auto&& holds) {
        for (int i = 0; i < mesh.n_nodes(); ++i)
            if (holds(i)) nodes.push_back(i);
    };
    if (f.boundary) return loop_nodes(*f.boundary, loops, where);
    if (f.label) add_if([&](int i) { return mesh.node_label[i] == *f.label; });
    if (f.all && *f.all) add_if([](int) { return true; });
    if (f.sphere) add_if([&](int i) { return (mesh.x[i] - f.sphere->center).norm() <= f.sphere->radius; });
    if (f.box)
        add_if([&](int i) { return (mesh.x[i].array() >= f.box->min.array()).all() && (mesh.x[i].array() <= f.box->max.array()).all(); });
    if (f.nodes)
        for (const int i : *f.nodes) {
            if (i >= mesh.n_nodes())
                throw InputError(where + "/nodes: there is no node " + std::to_string(i) + "; the mesh has " + std::to_string(mesh.n_nodes()) + ", counted from 0.");
            nodes.push_back(i);
        }
    if (f.group) {
        const auto at = std::find(mesh.groups.begin(), mesh.groups.end(), *f.group);
        if (at == mesh.groups.end()) {
            const std::string guess = arcsim::nearest_word(*f.group, mesh.groups);
            throw InputError(where + "/group: the mesh has no group \"" + *f.group + "\"." + (guess.empty() ? "" : " Did you mean \"" + guess + "\"?") +
                             (mesh.groups.empty() ? " It has no groups." : " It has: " + arcsim::join(mesh.groups) + "."));
        }
        const int number = static_cast<int>(at - mesh.groups.begin());
        for (int face = 0; face < mesh.n_faces(); ++face)
            if (mesh.face_group[face] == number) nodes.insert(nodes.end(), mesh.face_nodes[face].begin(), mesh.face_nodes[face].end());
    }
    return nodes;
}

}  // namespace

std::vector<char> held_dofs(const std::vector<FixedSelector>& selectors, const arcsim::ClothMesh& mesh,
                            const arcsim::Topology& t, const Vector3d& up, const std::string& where) {
    const std::vector<BoundaryLoop> loops = boundary_loops(mesh.surface(), t, up);
    std::vector<char> held(3 * mesh.x.size(), 0);
    for (std::size_t k = 0; k < selectors.size(); ++k) {
        const std::string place = where + "/" + std::to_string(k);
        const std::vector<int> nodes = chosen_nodes(selectors[k], mesh, loops, place);
        if (nodes.empty())
            throw InputError(place + ": holds no node. `formwork check` lists boundary loops, groups and the bounding box.");
        for (const int node : nodes)
            for (const char axis : selectors[k].axes) held[3 * node + (axis - 'x')] = 1;
    }
    for (int axis = 0; axis < 3; ++axis) {
        bool any = false;
        for (int i = 0; i < mesh.n_nodes(); ++i) any = any || held[3 * i + axis];
        if (!any)
            throw InputError(where + ": no node is held along " + std::string(1, static_cast<char>('x' + axis)) +
                             ": the bag would drift away. Hold its rim, for example \"fixed\": [{\"boundary\": \"top\"}].");
    }
    return held;
}

}  // namespace formwork
