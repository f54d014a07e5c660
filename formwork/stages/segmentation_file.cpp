#include "formwork/segment/layout_json.hpp"
#include "formwork/stages/segmentation_file.hpp"

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/panels/cut_panels.hpp"
#include "formwork/stages/csv.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::Vector3d;
using arcsim::write_file_atomically;
namespace fs = std::filesystem;

namespace {

std::string obj_with_groups(const Segmentation& s) {
    std::string text;
    for (const Vector3d& x : s.mesh.x)
        text += "v " + arcsim::format_number(x[0]) + " " + arcsim::format_number(x[1]) + " " + arcsim::format_number(x[2]) + "\n";
    int group = -1;
    for (int f = 0; f < s.mesh.n_faces(); ++f) {   // faces keep their order, so a group may be named again
        if (s.panel[f] != group) text += "g " + panel_name(s.panel[f]) + "\n";
        group = s.panel[f];
        const Triangle& t = s.mesh.faces[f];
        text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
    }
    return text;
}

constexpr int no_limit = 1 << 30;

}  // namespace

void write_segmentation(const fs::path& folder, const Segmentation& s) {
    CsvText labels("face,panel"), field("face,x,y,z"), singular("vertex,index,x,y,z"), seams("seam,panel_a,panel_b,vertex_a,vertex_b"),
        source("vertex,face,b0,b1,b2"), directions("face,source_face,theta,s1,s2,weight,field_theta");
    for (int f = 0; f < s.mesh.n_faces(); ++f) {
        labels.add(f).add(s.panel[f]).end_row();
        const Vector3d arm = arcsim::face_frame(s.mesh, f).direction(s.field_theta[f]);
        field.add(f).add(arm[0]).add(arm[1]).add(arm[2]).end_row();
        const DirectionData& d = s.direction[f];
        directions.add(f).add(s.source_face[f]).add(d.theta).add(d.s1).add(d.s2).add(d.weight).add(s.field_theta[f]).end_row();
    }
    for (const Singularity& q : s.singularities) {
        const Vector3d& x = s.mesh.x[q.node];
        singular.add(q.node).add(0.25 * q.index4).add(x[0]).add(x[1]).add(x[2]).end_row();
    }
    for (std::size_t k = 0; k < s.seams.size(); ++k)
        for (std::size_t i = 0; i + 1 < s.seams[k].nodes.size(); ++i)
            seams.add(static_cast<int>(k)).add(s.seams[k].panel[0]).add(s.seams[k].panel[1]).add(s.seams[k].nodes[i]).add(s.seams[k].nodes[i + 1]).end_row();
    for (int i = 0; i < s.mesh.n_nodes(); ++i) {
        const SurfacePoint& p = s.source[i];
        source.add(i).add(p.face).add(p.barycentric[0]).add(p.barycentric[1]).add(p.barycentric[2]).end_row();
    }
    CsvText candidates("curve,kind,cost,x,y,z");
    for (std::size_t k = 0; k < s.candidates.size(); ++k)
        for (const Vector3d& x : s.candidates[k].points)
            candidates.add(static_cast<int>(k)).add(static_cast<int>(s.candidates[k].kind)).add(s.candidates[k].cost).add(x[0]).add(x[1]).add(x[2]).end_row();
    write_file_atomically(folder / "candidates.csv", candidates.text());
    write_file_atomically(folder / "segments.obj", obj_with_groups(s));
    write_file_atomically(folder / "labels.csv", labels.text());
    write_file_atomically(folder / "layout.json", arcsim::to_text(layout_json(s)) + "\n");
    write_file_atomically(folder / "field.csv", field.text());
    write_file_atomically(folder / "singularities.csv", singular.text());
    write_file_atomically(folder / "seams.csv", seams.text());
    write_file_atomically(folder / "source.csv", source.text());
    write_file_atomically(folder / "directions.csv", directions.text());
    std::error_code ignored;
    if (s.violations.empty()) fs::remove(folder / "violations.txt", ignored);   // ours, of an earlier layout
    else write_file_atomically(folder / "violations.txt", arcsim::join(s.violations, "\n") + "\n");
}

Segmentation read_segmentation(const fs::path& folder) {
    Segmentation s;
    s.mesh = arcsim::read_obj(folder / "segments.obj").surface();
    const int n_faces = s.mesh.n_faces(), n_nodes = s.mesh.n_nodes();
    const CsvFile labels(folder / "labels.csv", {"face", "panel"});
    const CsvFile directions(folder / "directions.csv", {"face", "source_face", "theta", "s1", "s2", "weight", "field_theta"});
    const CsvFile singular(folder / "singularities.csv", {"vertex", "index", "x", "y", "z"});
    const CsvFile seams(folder / "seams.csv", {"seam", "panel_a", "panel_b", "vertex_a", "vertex_b"});
    const CsvFile source(folder / "source.csv", {"vertex", "face", "b0", "b1", "b2"});
    if (labels.n_rows() != n_faces || directions.n_rows() != n_faces || source.n_rows() != n_nodes)
        throw InputError(folder.string() + ": labels.csv, directions.csv or source.csv do not fit segments.obj (" + std::to_string(n_faces) +
                         " faces, " + std::to_string(n_nodes) + " vertices). Run segment again.");
    s.panel.resize(n_faces), s.source_face.resize(n_faces), s.direction.resize(n_faces), s.field_theta.resize(n_faces), s.source.resize(n_nodes);
    for (int r = 0; r < n_faces; ++r) {
        const int f = labels.integer(r, 0, 0, n_faces);
        s.panel[f] = labels.integer(r, 1, 0, n_faces);
        s.n_panels = std::max(s.n_panels, s.panel[f] + 1);
        const int g = directions.integer(r, 0, 0, n_faces);
        s.source_face[g] = directions.integer(r, 1, 0, no_limit);
        s.direction[g] = {directions.number(r, 2), directions.number(r, 3), directions.number(r, 4), directions.number(r, 5)};
        s.field_theta[g] = directions.number(r, 6);
    }
    for (int r = 0; r < n_nodes; ++r)
        s.source[source.integer(r, 0, 0, n_nodes)] = {source.integer(r, 1, 0, no_limit), {source.number(r, 2), source.number(r, 3), source.number(r, 4)}};
    for (int r = 0; r < singular.n_rows(); ++r)
        s.singularities.push_back({singular.integer(r, 0, 0, n_nodes), static_cast<int>(std::lround(4 * singular.number(r, 1)))});
    for (int r = 0; r < seams.n_rows(); ++r) {
        const std::size_t k = seams.integer(r, 0, 0, seams.n_rows());
        const int a = seams.integer(r, 3, 0, n_nodes), b = seams.integer(r, 4, 0, n_nodes);
        if (k >= s.seams.size()) {
            s.seams.resize(k + 1);
            s.seams[k].panel = {seams.integer(r, 1, 0, s.n_panels), seams.integer(r, 2, -1, s.n_panels)};
            s.seams[k].nodes.push_back(a);
        }
        s.seams[k].nodes.push_back(b);
    }
    std::error_code ignored;
    if (fs::exists(folder / "candidates.csv", ignored)) {   // runs of earlier versions have none
        const CsvFile candidates(folder / "candidates.csv", {"curve", "kind", "cost", "x", "y", "z"});
        for (int r = 0; r < candidates.n_rows(); ++r) {
            const std::size_t k = candidates.integer(r, 0, 0, candidates.n_rows());
            if (k >= s.candidates.size()) {
                s.candidates.resize(k + 1);
                s.candidates[k].kind = static_cast<CandidateCurve::Kind>(candidates.integer(r, 1, 0, 3));
                s.candidates[k].cost = candidates.number(r, 2);
            }
            s.candidates[k].points.emplace_back(candidates.number(r, 3), candidates.number(r, 4), candidates.number(r, 5));
        }
    }
    if (fs::exists(folder / "violations.txt", ignored)) {
        const std::string text = arcsim::read_text_file(folder / "violations.txt");
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            s.violations.push_back(text.substr(at, end - at));
            at = end + 1;
        }
    }
    return s;
}

Segmentation as_cut(Segmentation s, const fs::path& panels_folder) {
    const fs::path rest = panels_folder / "sewn_rest.obj", file = panels_folder / "directions.csv";
    const std::size_t n_nodes = s.mesh.x.size();
    s.mesh.x = arcsim::read_obj(rest).x;
    if (s.mesh.x.size() != n_nodes) throw InputError(rest.string() + ": belongs to another layout. Run the stage panels again.");
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return s;
    const CsvFile directions(file, {"face", "theta", "s1", "s2", "weight"});
    if (directions.n_rows() != s.mesh.n_faces()) throw InputError(file.string() + ": belongs to another layout. Run the stage panels again.");
    for (int r = 0; r < directions.n_rows(); ++r)
        s.direction[directions.integer(r, 0, 0, s.mesh.n_faces())] = {directions.number(r, 1), directions.number(r, 2), directions.number(r, 3),
                                                                      directions.number(r, 4)};
    return s;
}

void write_grain_directions(const fs::path& panels_folder, const Segmentation& s, bool own) {
    const fs::path file = panels_folder / "directions.csv";
    std::error_code ignored;
    if (own) {
        fs::remove(file, ignored);
        return;
    }
    CsvText text("face,theta,s1,s2,weight");
    for (int f = 0; f < s.mesh.n_faces(); ++f) {
        const DirectionData& d = s.direction[f];
        text.add(f).add(d.theta).add(d.s1).add(d.s2).add(d.weight).end_row();
    }
    write_file_atomically(file, text.text());
}

PanelSet read_panels(const fs::path& sewn_rest, const Segmentation& s) {
    const arcsim::ClothMesh mesh = arcsim::read_obj(sewn_rest);
    PanelSet set;
    cut_panels(s, set);
    std::size_t next = 0;
    for (FlatPanel& panel : set.panels) {
        panel.u.resize(panel.node.size());
        for (auto& u : panel.u) {
            if (next >= mesh.u.size())
                throw InputError(sewn_rest.string() + ": has fewer vt than the panels have vertices. Run panels again.");
            u = mesh.u[next++];
        }
    }
    if (next != mesh.u.size()) throw InputError(sewn_rest.string() + ": has more vt than the panels have vertices. Run panels again.");
    measure_panels(set, s);
    return set;
}

}  // namespace formwork
