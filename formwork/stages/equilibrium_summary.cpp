#include "formwork/stages/equilibrium_summary.hpp"

#include <system_error>

#include "arcsim/base/text.hpp"
#include "arcsim/mesh/obj_io.hpp"

namespace formwork {

using arcsim::JsonValue;

namespace {
constexpr const char* unconverged = "not_converged.obj";
}

JsonValue equilibrium_summary(const EquilibriumResult& r) {
    JsonValue v = JsonValue::object();
    v.set("converged", r.converged);
    v.set("residual", r.residual);
    v.set("rounding_floor", r.rounding_floor);
    v.set("iterations", r.iterations);
    v.set("factorizations", r.factorizations);
    v.set("coarse_iterations", r.coarse_iterations);
    v.set("coarse_factorizations", r.coarse_factorizations);
    v.set("vertices", r.vertices);
    v.set("faces", r.faces);
    v.set("free_dofs", r.free_dofs);
    v.set("wall_s", r.wall_s);
    v.set("cpu_s", r.cpu_s);
    v.set("peak_rss_mb", r.peak_rss_mb);
    v.set("fill_level_m", r.fill_level_m);
    v.set("depth_m", r.depth_m);
    v.set("depth_below_rim_m", r.depth_below_rim_m);
    v.set("volume_m3", r.volume_m3);
    v.set("capacity_m3", r.capacity_m3);
    v.set("liquid_mass_kg", r.liquid_mass_kg);
    JsonValue force = JsonValue::array();
    for (int k = 0; k < 3; ++k) force.add(r.support_force_N[k]);
    v.set("support_force_N", std::move(force));
    v.set("max_stretch", r.max_stretch);
    v.set("min_stretch", r.min_stretch);
    v.set("wrinkled_faces", r.wrinkled_faces);
    v.set("slack_faces", r.slack_faces);
    v.set("method", r.method);
    JsonValue regularisation = JsonValue::object();
    regularisation.set("prestress_N_per_m", r.regularisation.prestress);
    regularisation.set("residual_stiffness", r.regularisation.residual);
    regularisation.set("depth_effect", r.regularisation.depth_effect);
    regularisation.set("volume_effect", r.regularisation.volume_effect);
    regularisation.set("depth_extrapolated_m", r.regularisation.depth_extrapolated_m);
    regularisation.set("volume_extrapolated_m3", r.regularisation.volume_extrapolated_m3);
    v.set("regularisation", std::move(regularisation));
    JsonValue history = JsonValue::array();
    for (const IterationReport& step : r.history) history.add(step.residual);
    v.set("residual_history", std::move(history));
    JsonValue warnings = JsonValue::array();
    for (const std::string& w : r.warnings) warnings.add(w);
    v.set("warnings", std::move(warnings));
    return v;
}

arcsim::ClothMesh mesh_with_rest(const std::vector<Vector3d>& x, const std::vector<Triangle>& faces,
                                 const std::vector<FlatTriangle>& flat) {
    arcsim::ClothMesh m;
    for (const Vector3d& p : x) m.add_node(p);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        Triangle verts;
        for (int k = 0; k < 3; ++k) verts[k] = m.add_vert(flat[f][k]);
        m.add_face(faces[f], verts);
    }
    return m;
}

std::string doubt_about_overflow(const EquilibriumResult& r, const PlasterParams& plaster) {
    if (!plaster.fill || !(plaster.fill->volume || plaster.fill->fraction)) return "";
    const double above = r.depth_m - r.depth_below_rim_m;
    constexpr double brimful = 1e-3;   // of the depth
    if (!(above > brimful * r.depth_m)) return "";
    return "the liquid's surface stands " + arcsim::format_short(1000 * above, 3) + " mm above the rim, as in a filling pipe: this bag holds " +
           arcsim::format_short(1000 * r.capacity_m3) + " l up to its rim, not " + arcsim::format_short(1000 * r.volume_m3) +
           " l. Lower /formwork/plaster/fill, or hold the rim higher.";
}

arcsim::NumericalError keep_unconverged(const std::string& stage, const std::filesystem::path& folder, const EquilibriumError& e,
                                        const arcsim::ClothMesh& last) {
    const std::filesystem::path kept = folder / unconverged;
    arcsim::write_obj(kept, last);
    return arcsim::NumericalError(stage + ": " + e.what() + " The last state, not converged, is " + kept.string() + ".");
}

void forget_unconverged(const std::filesystem::path& folder) {
    std::error_code ignored;
    std::filesystem::remove(folder / unconverged, ignored);
}

}  // namespace formwork
