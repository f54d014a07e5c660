#include "formwork/scene/bag_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"

namespace formwork {

using arcsim::format_short;
using arcsim::InputError;
using arcsim::Triangle;
using arcsim::Vector3d;

double metres_per(LengthUnit unit) {
    switch (unit) {
        case LengthUnit::cm: return 0.01;
        case LengthUnit::mm: return 0.001;
        case LengthUnit::in: return 0.0254;
        default: return 1;
    }
}

std::string welded_note(int vertices) {
    return std::to_string(vertices) + (vertices == 1 ? " vertex at the place of another is" : " vertices at the places of others are") + " welded (\"weld\": false keeps them apart); vertex numbers of the output differ.";
}

std::string stray_note(int vertices) {
    return std::to_string(vertices) + (vertices == 1 ? " vertex belongs to no face and is" : " vertices belong to no face and are") + " left out; vertex numbers of the output differ.";
}

namespace {

/// @returns how many
int drop_stray_nodes(ClothMesh& m) {
    std::vector<int> number(m.n_nodes(), -1);
    for (const Triangle& t : m.face_nodes)
        for (const int node : t) number[node] = 0;
    int kept = 0;
    for (int i = 0; i < m.n_nodes(); ++i) {
        if (number[i] < 0) continue;
        m.x[kept] = m.x[i], m.v[kept] = m.v[i], m.ny[kept] = m.ny[i], m.node_label[kept] = m.node_label[i];
        number[i] = kept++;
    }
    const int gone = m.n_nodes() - kept;
    if (gone == 0) return 0;
    m.x.resize(kept), m.v.resize(kept), m.ny.resize(kept), m.node_label.resize(kept);
    for (Triangle& t : m.face_nodes)
        for (int& node : t) node = number[node];
    std::erase_if(m.edges, [&](const arcsim::EdgeRecord& e) { return number[e.node[0]] < 0 || number[e.node[1]] < 0; });
    for (arcsim::EdgeRecord& e : m.edges)
        for (int& node : e.node) node = number[node];
    return gone;
}

void check_numbers(const ClothMesh& m, const std::string& name) {
    if (m.n_faces() == 0) throw InputError(name + ": holds no face. Export the mesh with its faces.");
    for (int i = 0; i < m.n_nodes(); ++i)
        if (!m.x[i].allFinite())
            throw InputError(name + ": vertex " + std::to_string(i + 1) + ": a coordinate is not a finite number. Export the mesh again.");
}

void check_size(const ClothMesh& m, const std::string& name, const BagMeshOptions& options) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& p : m.x) box.extend(p);
    const double size = box.sizes().maxCoeff();
    constexpr double largest = 60, smallest = 0.002;   // m: beyond these nobody sews a bag
    if (options.any_size || (size <= largest && size >= smallest)) return;
    const char* unit = length_unit_names[static_cast<int>(options.unit)].name;
    throw InputError(name + ": the mesh would be " + format_short(size, 3) + " m large, read in " + unit +
                     ". Set /formwork/units to the mesh's unit (\"m\", \"cm\", \"mm\" or \"in\"), or /formwork/any_size to true.");
}

void check_areas(const Surface& s, const std::string& name) {
    for (int f = 0; f < s.n_faces(); ++f) {
        const Triangle& t = s.faces[f];
        const double longest = std::max({(s.x[t[1]] - s.x[t[0]]).norm(), (s.x[t[2]] - s.x[t[1]]).norm(), (s.x[t[0]] - s.x[t[2]]).norm()});
        constexpr double flat = 1e-7;   // height over length below which a face has no usable area
        if (2 * arcsim::face_area(s, f) <= flat * longest * longest)
            throw InputError(name + ": face " + std::to_string(f + 1) + " (vertices " + std::to_string(t[0] + 1) + ", " + std::to_string(t[1] + 1) +
                             ", " + std::to_string(t[2] + 1) + ") has no area. Delete or collapse it in your modeller.");
    }
}

/// How the file's vt compare with space when one vt unit is `scale` metres.
struct RestFit {
    double share = 0;          // of edges whose lengths agree within `factor`
    int bad_face = -1;         // first one without positive area
};
RestFit compare_rest(const ClothMesh& m, double scale) {
    constexpr double factor = 1.5;
    RestFit fit;
    int good = 0;
    for (int f = 0; f < m.n_faces(); ++f) {
        if (m.material_area(f) <= 0 && fit.bad_face < 0) fit.bad_face = f;
        for (int k = 0; k < 3; ++k) {
            const double flat = scale * (m.u[m.face_verts[f][(k + 1) % 3]] - m.u[m.face_verts[f][k]]).norm();
            const double space = (m.x[m.face_nodes[f][(k + 1) % 3]] - m.x[m.face_nodes[f][k]]).norm();
            good += flat < factor * space && space < factor * flat;
        }
    }
    fit.share = good / (3.0 * m.n_faces());
    return fit;
}

void take_rest(BagMesh& bag, bool has_vt, const std::string& name, const BagMeshOptions& options) {
    if (options.rest == RestFrom::mesh) return;
    if (!has_vt) {
        if (options.rest == RestFrom::vt) throw InputError(name + ": has no vt lines to be the rest shape. Set /formwork/rest to \"mesh\".");
        return;
    }
    // vt are metres in ArcSim's dialect, but an exporter may have written them in the mesh's unit.
    double scale = 1;
    RestFit fit = compare_rest(bag.cloth, scale);
    if (const double unit = metres_per(options.unit); unit != 1 && fit.share < 0.95)
        if (const RestFit other = compare_rest(bag.cloth, unit); other.share > fit.share) fit = other, scale = unit;
    constexpr double enough = 0.95;   // a folded or stretched start shape may have a few odd edges
    if (fit.share < enough || fit.bad_face >= 0) {
        const std::string why = fit.bad_face >= 0 ? "face " + std::to_string(fit.bad_face + 1) + " has no positive area there"
                                                  : "only " + std::to_string(static_cast<int>(100 * fit.share)) + " % of the edges are about as long there as in space";
        if (options.rest == RestFrom::vt)
            throw InputError(name + ": the vt cannot be rest coordinates in metres: " + why + ". Mend them, or set /formwork/rest to \"mesh\".");
        bag.notes.push_back("vt are taken as texture coordinates (" + why + "): the mesh in space is the rest shape.");
        return;
    }
    for (auto& u : bag.cloth.u) u *= scale;
    for (int f = 0; f < bag.cloth.n_faces(); ++f) {
        const Triangle& t = bag.cloth.face_verts[f];
        bag.flat.push_back({bag.cloth.u[t[0]], bag.cloth.u[t[1]], bag.cloth.u[t[2]]});
    }
    bag.notes.push_back("vt are the flat rest shape (m); the mesh in space is the start.");
}

}  // namespace

BagMesh prepare_bag_mesh(MeshFile file, const std::string& name, const BagMeshOptions& options) {
    BagMesh bag;
    bag.cloth = std::move(file.mesh);
    check_numbers(bag.cloth, name);
    const double scale = metres_per(options.unit);
    for (Vector3d& p : bag.cloth.x) p *= scale;
    for (Vector3d& p : bag.cloth.ny) p *= scale;
    check_size(bag.cloth, name, options);
    if (options.weld_nodes)
        if (const int gone = weld(bag.cloth); gone > 0) bag.notes.push_back(welded_note(gone));
    bag.stray_vertices = drop_stray_nodes(bag.cloth);
    if (bag.stray_vertices > 0) bag.notes.push_back(stray_note(bag.stray_vertices));
    bag.surface = bag.cloth.surface();
    bag.topology = arcsim::build_topology(bag.surface, name);
    check_areas(bag.surface, name);
    take_rest(bag, file.has_rest_coordinates, name, options);
    return bag;
}

}  // namespace formwork
