#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/segment/covariance_split.hpp"
#include "formwork/segment/panel_patch.hpp"
#include "formwork/segment/segment.hpp"
#include "formwork/stages/segmentation_file.hpp"
#include "formwork/stages/stage.hpp"
#include "formwork/stages/strain_file.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::JsonValue;

namespace {

/// The surface that is cut, and what the weave is to follow on it.
struct SegmentInput {
    Surface surface;
    std::vector<DirectionData> data;
};

SegmentInput read_field_input(const FormworkScene& scene) {
    const SegmentKeys& keys = scene.formwork.segment;
    BagMesh bag = load_bag_mesh(scene);
    if (bag.stray_vertices > 0)
        throw InputError(scene.mesh_file().path.string() + ": " + std::to_string(bag.stray_vertices) +
                         (bag.stray_vertices == 1 ? " vertex belongs" : " vertices belong") + " to no face. Remove unreferenced vertices from a mesh to which /formwork/segment/field belongs.");
    return {std::move(bag.surface), read_field_file(keys.field->path.string(), bag.topology, keys.directions)};
}

SegmentInput read_input(const StageContext& context) {
    const SegmentKeys& keys = context.scene.formwork.segment;
    if (keys.field) return read_field_input(context.scene);
    SegmentInput in;
    const bool inflated = context.scene.formwork.panels.from == PanelSource::inflated;
    const std::filesystem::path folder = context.dir / "inflate";
    in.surface = arcsim::read_obj(folder / (inflated ? "inflated.obj" : "rest.obj")).surface();
    StrainField strain = read_strain(folder, in.surface.n_faces());
    if (inflated)
        for (FaceStrain& f : strain) f.dir = f.dir_deformed;   // left singular vectors, on the surface that is cut
    in.data = directions_from_strain(in.surface, arcsim::build_topology(in.surface), strain, keys.directions);
    return in;
}

/// "+1/4": how SYSTEM.md writes an index.
std::string index_name(int index4) {
    const std::string sign = index4 > 0 ? "+" : "-";
    const int n = std::abs(index4);
    return n % 4 == 0 ? sign + std::to_string(n / 4) : n % 2 == 0 ? sign + std::to_string(n / 2) + "/2" : sign + std::to_string(n) + "/4";
}

double seam_length(const Segmentation& s) {
    double length = 0;
    for (const Seam& seam : s.seams)
        for (std::size_t i = 0; !seam.is_rim() && i + 1 < seam.nodes.size(); ++i)
            length += (s.mesh.x[seam.nodes[i + 1]] - s.mesh.x[seam.nodes[i]]).norm();
    return length;
}

/// Once it is cut open along seams that run inside it, every panel is a disk.
bool all_disks(const Segmentation& s) {
    CutMesh cut(s.mesh);
    for (const Seam& seam : s.seams)
        for (std::size_t i = 0; !seam.is_rim() && i + 1 < seam.nodes.size(); ++i) cut.mark_seam(seam.nodes[i], seam.nodes[i + 1]);
    const auto panels = panel_faces(s.panel, s.n_panels);
    return std::all_of(panels.begin(), panels.end(), [&](const auto& faces) { return extract_patch(cut, faces).is_disk(); });
}

JsonValue summary_of(const SegmentInput& in, const Segmentation& s, double wall) {
    // Figures of the field are those on the mesh that was given, before seams split its faces.
    const Topology t = arcsim::build_topology(in.surface);
    const CrossField& field = s.field;
    const std::vector<Singularity> found = find_singularities(in.surface, t, field);
    std::map<std::string, int> counts;
    int sum4 = 0;
    for (const Singularity& q : found) {
        ++counts[index_name(q.index4)];
        sum4 += q.index4;
    }
    JsonValue v = JsonValue::object(), singularities = JsonValue::object();
    for (const auto& [name, n] : counts) singularities.set(name, n);
    v.set("panels", s.n_panels);
    v.set("singularities", std::move(singularities));
    v.set("index_sum", 0.25 * sum4);
    v.set("boundary_turning", 0.25 * boundary_turning4(in.surface, t, field));
    v.set("euler_characteristic", t.euler_characteristic());
    v.set("smoothness_energy", field.smoothness_energy);
    v.set("alignment_energy", field.alignment_energy);
    v.set("field_deviation_deg", field.deviation_deg);
    v.set("seam_length_m", seam_length(s));
    v.set("all_disks", all_disks(s));
    const std::vector<double> energy = panel_energies(s);
    v.set("max_panel_covariance_energy", energy.empty() ? 0.0 : *std::max_element(energy.begin(), energy.end()));
    JsonValue violations = JsonValue::array();
    for (const std::string& text : s.violations) violations.add(text);
    v.set("violations", std::move(violations));
    v.set("wall_s", wall);
    return v;
}

}  // namespace

void check_field_scene(const FormworkScene& scene) {
    const SegmentInput in = read_field_input(scene);
    check_segment_input(in.surface, in.data, scene.formwork.segment.layout);
}

JsonValue run_segment(const StageContext& context) {
    const SegmentInput in = read_input(context);
    context.progress.update({});
    const auto start = std::chrono::steady_clock::now();
    const SegmentKeys& keys = context.scene.formwork.segment;
    SegmentParams params = keys.layout;
    int step = 0;
    params.on_step = [&](std::string_view text) { context.progress.update({++step, -1, -1, {}, std::string(text)}); };
    Segmentation s = segment(in.surface, in.data, params);
    if (keys.max_covariance_energy > 0) s = split_by_covariance(s, in.surface, in.data, params, keys.max_covariance_energy, keys.split);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write_segmentation(context.dir / "segment", s);
    const JsonValue summary = summary_of(in, s, wall);
    context.progress.end("segment: " + std::to_string(s.n_panels) + " panels, " + std::to_string(s.singularities.size()) + " singularities, " +
                         arcsim::format_short(summary.find("seam_length_m")->number) + " m of seams, " + arcsim::format_duration(wall));
    for (const std::string& text : s.violations) context.progress.warning("segment: " + text);
    return summary;
}

}  // namespace formwork
