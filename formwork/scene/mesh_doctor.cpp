#include "formwork/scene/mesh_doctor.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/mesher/mesh_quality.hpp"
#include "formwork/scene/doubts.hpp"
#include "formwork/scene/fixed_selector.hpp"

namespace formwork {

using arcsim::format_short;
using arcsim::Triangle;
using arcsim::Vector3d;

namespace {

std::string mm(double metres) { return format_short(1000 * metres, 4); }

/// "3-4, 7-9, 12-13 and 5 more", counted from 1.
std::string listed(const std::vector<std::array<int, 2>>& edges) {
    std::string text;
    constexpr std::size_t shown = 6;
    for (std::size_t i = 0; i < std::min(shown, edges.size()); ++i)
        text += (i ? ", " : "") + std::to_string(edges[i][0] + 1) + "-" + std::to_string(edges[i][1] + 1);
    if (edges.size() > shown) text += " and " + std::to_string(edges.size() - shown) + " more";
    return text;
}
std::string listed(const std::vector<int>& numbers) {
    std::string text;
    constexpr std::size_t shown = 8;
    for (std::size_t i = 0; i < std::min(shown, numbers.size()); ++i) text += (i ? ", " : "") + std::to_string(numbers[i] + 1);
    if (numbers.size() > shown) text += " and " + std::to_string(numbers.size() - shown) + " more";
    return text;
}

std::string guess_unit(double size) {   // of a mesh whose largest side is `size` in its own unit
    if (size >= 20 && size <= 20000) return "mm";
    if (size < 20 && size >= 0.02) return "m";
    return "";
}

/// Collects faces and edges for the OBJ of faulty places.
class Places {
public:
    explicit Places(const Surface& s) : s_(s) {}
    void faces(const std::string& group, const std::vector<int>& list) {
        if (list.empty()) return;
        text_ += "g " + group + "\n";
        for (const int f : list)
            text_ += "f " + std::to_string(s_.faces[f][0] + 1) + " " + std::to_string(s_.faces[f][1] + 1) + " " + std::to_string(s_.faces[f][2] + 1) + "\n";
    }
    void edges(const std::string& group, const std::vector<std::array<int, 2>>& list) {
        if (list.empty()) return;
        text_ += "g " + group + "\n";
        for (const auto& e : list) text_ += "l " + std::to_string(e[0] + 1) + " " + std::to_string(e[1] + 1) + "\n";
    }
    std::string obj() const {
        if (text_.empty()) return "";
        Surface points{s_.x, {}};
        return format_plain_obj(points, "faulty places of a mesh; lengths in m") + text_;
    }

private:
    const Surface& s_;
    std::string text_;
};

std::vector<int> faces_at(const Surface& s, const std::vector<std::array<int, 2>>& edges) {
    std::set<std::pair<int, int>> wanted;
    for (const auto& e : edges) wanted.insert(std::minmax(e[0], e[1]));
    std::vector<int> out;
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k)
            if (wanted.count(std::minmax(s.faces[f][k], s.faces[f][(k + 1) % 3]))) {
                out.push_back(f);
                break;
            }
    return out;
}

void find_duplicates(const Surface& s, MeshDiagnosis& d) {
    std::map<std::array<int, 3>, int> seen;
    std::vector<int> twice;
    for (int f = 0; f < s.n_faces(); ++f) {
        Triangle t = s.faces[f];
        std::sort(t.begin(), t.end());
        if (!seen.emplace(t, f).second) twice.push_back(f);
    }
    if (!twice.empty()) d.faults.push_back(std::to_string(twice.size()) + " faces are there twice: " + listed(twice) + ". Delete the copies.");
    std::map<std::array<double, 3>, int> place;
    int coincident = 0;
    for (const Vector3d& p : s.x) coincident += !place.emplace(std::array<double, 3>{p[0], p[1], p[2]}, 0).second;
    if (coincident > 0) d.warnings.push_back(std::to_string(coincident) + " vertices lie at the place of another one and are not joined to it.");
}

void describe_topology(const Surface& s, const Vector3d& up, MeshDiagnosis& d) {
    const arcsim::Topology t = arcsim::build_topology(s);
    d.facts.push_back("components " + std::to_string(t.n_components) + ", Euler characteristic " + std::to_string(t.euler_characteristic()) +
                      ", boundary loops " + std::to_string(t.boundary_loops.size()));
    int number = 0;
    for (const BoundaryLoop& loop : boundary_loops(s, t, up)) {
        const std::string name = loop.name == std::to_string(number) ? loop.name : "\"" + loop.name + "\"";
        d.facts.push_back("  loop " + std::to_string(number++) + ": " + std::to_string(loop.nodes.size()) + " vertices, " + mm(loop.length) +
                          " mm long, at height " + mm(loop.mean_height) + " mm; hold it with {\"boundary\": " + name + "}");
    }
    if (const std::string doubt = doubt_about_up(s, t, up); !doubt.empty()) d.warnings.push_back(doubt);
    if (t.boundary_loops.empty()) d.warnings.push_back("the mesh is closed: there is no rim to hold or to pour through. Cut an opening, or hold nodes by \"sphere\", \"box\" or \"nodes\".");
    if (t.n_components > 1) d.warnings.push_back("the mesh has " + std::to_string(t.n_components) + " components: each must be held, and segment takes one at a time.");
}

void describe_quality(const Surface& s, MeshDiagnosis& d) {
    const MeshQuality q = measure_quality(s);
    d.facts.push_back("angles " + format_short(q.min_angle_deg, 3) + "° to " + format_short(q.max_angle_deg, 3) + "°; edges " + mm(q.min_edge) + " to " +
                      mm(q.max_edge) + " mm, mean " + mm(q.mean_edge) + " mm");
    if (q.n_below_5 > 0)
        d.warnings.push_back(std::to_string(q.n_below_5) + " faces have an angle below 5° (the worst is face " + std::to_string(q.worst_face + 1) +
                             "): remesh, or the strain there is noise.");
}

}  // namespace

MeshDiagnosis examine_mesh(const MeshFile& file, const BagMeshOptions& options, const Vector3d& up) {
    MeshDiagnosis d;
    ClothMesh cloth = file.mesh;
    const double scale = metres_per(options.unit);
    Eigen::AlignedBox3d box;
    for (Vector3d& p : cloth.x) box.extend(p), p *= scale;
    const int welded = options.weld_nodes ? weld(cloth) : 0;
    const Surface s = cloth.surface();
    d.facts.push_back(std::to_string(s.n_nodes()) + " vertices, " + std::to_string(s.n_faces()) + " faces" +
                      (cloth.groups.empty() ? "" : ", groups " + arcsim::join(cloth.groups)));
    if (s.n_faces() == 0) {
        d.faults.push_back("the mesh has no faces. Export it with its faces.");
        return d;
    }
    const Vector3d size = box.sizes();
    d.facts.push_back("bounding box " + mm(scale * size[0]) + " x " + mm(scale * size[1]) + " x " + mm(scale * size[2]) + " mm (read in " +
                      length_unit_names[static_cast<int>(options.unit)].name + ")");
    const double extent = scale * size.maxCoeff();
    if (extent < 0.02 || extent > 20) {
        const std::string unit = guess_unit(size.maxCoeff());
        d.warnings.push_back("a bag of " + mm(extent) + " mm is unusual" +
                             (unit.empty() || unit == length_unit_names[static_cast<int>(options.unit)].name ? ": check \"units\"." : "; if the mesh is in " + unit + ", set \"units\": \"" + unit + "\"."));
    }
    if (welded > 0) d.warnings.push_back(welded_note(welded));

    const arcsim::TopologyDefects defects = arcsim::find_defects(s);
    if (!defects.isolated_nodes.empty()) d.warnings.push_back(stray_note(static_cast<int>(defects.isolated_nodes.size())));
    Places places(s);
    if (!defects.repeated_corner_faces.empty()) {
        d.faults.push_back("faces with the same vertex twice: " + listed(defects.repeated_corner_faces) + ". Delete them.");
        places.faces("repeated_corner", defects.repeated_corner_faces);
    }
    if (!defects.nonmanifold_edges.empty()) {
        d.faults.push_back("edges of three or more faces (vertices): " + listed(defects.nonmanifold_edges) + ". Delete inner walls; a bag is a single skin.");
        places.edges("nonmanifold_edges", defects.nonmanifold_edges);
        places.faces("nonmanifold_faces", faces_at(s, defects.nonmanifold_edges));
    }
    if (!defects.misoriented_edges.empty()) {
        d.faults.push_back("neighbouring faces that look to opposite sides, at edges " + listed(defects.misoriented_edges) + ". Unify the normals.");
        places.edges("flipped_edges", defects.misoriented_edges);
        places.faces("flipped_faces", faces_at(s, defects.misoriented_edges));
    }
    if (!defects.nonmanifold_nodes.empty())
        d.faults.push_back("vertices where separate fans of faces touch: " + listed(defects.nonmanifold_nodes) + ". Split them.");
    find_duplicates(s, d);
    d.places_obj = places.obj();
    if (defects.empty()) describe_topology(s, up, d);
    describe_quality(s, d);
    return d;
}

}  // namespace formwork
