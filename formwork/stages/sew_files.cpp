#include "formwork/stages/sew_files.hpp"

#include <cmath>

#include "arcsim/base/files.hpp"
#include "formwork/panels/panel_set.hpp"
#include "formwork/report/chart.hpp"
#include "formwork/stages/csv.hpp"

namespace formwork {

using arcsim::JsonValue;

namespace {

JsonValue spread_summary(const Spread& s) {
    JsonValue v = JsonValue::object();
    v.set("mean", s.mean);
    v.set("p95", s.p95);
    v.set("min", s.min);
    v.set("max", s.max);
    return v;
}

JsonValue variant_summary(const GrainVariant& g) {
    JsonValue v = JsonValue::object();
    v.set("converged", g.failure.empty());
    if (!g.failure.empty()) {
        v.set("failure", g.failure);
        return v;
    }
    v.set("mean_abs_shear", g.mean_abs_shear);
    v.set("p95_abs_shear", g.p95_abs_shear);
    v.set("max_abs_shear", g.max_abs_shear);
    v.set("fabric_mean_abs_shear", g.fabric_mean_abs_shear);
    v.set("taut_mean_abs_shear", g.taut_mean_abs_shear);
    v.set("shape_rms_m", g.shape_rms_m);
    v.set("shape_max_m", g.shape_max_m);
    v.set("depth_m", g.depth_m);
    v.set("max_tension_N_per_m", g.max_tension_N_per_m);
    v.set("wrinkled_faces", g.wrinkled_faces);
    v.set("residual", g.residual);
    v.set("iterations", g.iterations);
    v.set("factorizations", g.factorizations);
    return v;
}

/// Which panels the shear is in: means over each panel's area, and its share of all shear.
std::string panel_table(const SewResult& r, const Segmentation& s) {
    struct Sum {
        double area = 0, shear = 0, fabric = 0, taut = 0;
    };
    std::vector<Sum> panels(s.n_panels);
    double shear_of_all = 0;
    for (int f = 0; f < s.mesh.n_faces(); ++f) {
        const double area = arcsim::face_area(s.mesh, f), shear = area * std::abs(r.equilibrium.strain[f].eps_uv);
        Sum& p = panels[s.panel[f]];
        p.area += area;
        p.shear += shear;
        p.fabric += area * std::abs(r.weave.face[f].fabric_shear);
        if (r.equilibrium.strain[f].state == FaceState::taut) p.taut += area;
        shear_of_all += shear;
    }
    CsvText text("panel,name,area_m2,mean_abs_shear,fabric_mean_abs_shear,taut_share,share_of_shear");
    for (int i = 0; i < s.n_panels; ++i) {
        const Sum& p = panels[i];
        text.add(i).add(panel_name(i)).add(p.area).add(p.shear / p.area).add(p.fabric / p.area).add(p.taut / p.area);
        text.add(shear_of_all > 0 ? p.shear / shear_of_all : 0).end_row();
    }
    return text.text();
}

/// Share of the cloth whose weave is off square by more than an angle: aligned and the other grains.
Image weave_angle_chart(const SewResult& r) {
    std::vector<ChartSeries> series;
    const auto add = [&](const std::string& name, const std::vector<double>& histogram) {
        ChartSeries s{name, {}, {}};
        s.colour = static_cast<int>(series.size());
        double beyond = 1;
        for (std::size_t k = 0; k < histogram.size(); ++k) {
            s.x.push_back(static_cast<double>(k) * angle_bin_deg);
            s.y.push_back(100 * std::max(beyond, 0.0));
            beyond -= histogram[k];
        }
        series.push_back(std::move(s));
    };
    add("aligned", r.weave.angle_histogram);
    for (const GrainVariant& g : r.compare)
        if (g.failure.empty()) add(g.name, g.angle_histogram);
    return line_chart(series, "Angle between warp and weft in the filled bag", "off square by more than, degrees", "share of the cloth, %");
}

}  // namespace

void write_sew_tables(const std::filesystem::path& folder, const SewResult& r, const Segmentation& s) {
    CsvText weave("face,panel,stretch_warp,stretch_weft,cos_angle,fabric_shear,tension_warp,tension_weft,tension_max");
    for (std::size_t f = 0; f < r.weave.face.size(); ++f) {
        const FaceWeave& w = r.weave.face[f];
        weave.add(static_cast<int>(f)).add(s.panel[f]).add(w.stretch_warp).add(w.stretch_weft).add(w.cos_angle);
        weave.add(w.fabric_shear);
        weave.add(w.tension_warp).add(w.tension_weft).add(w.tension_max).end_row();
    }
    arcsim::write_file_atomically(folder / "weave.csv", weave.text());

    arcsim::write_file_atomically(folder / "panels.csv", panel_table(r, s));

    CsvText seams("seam,panel_a,panel_b,length_m,thread_force_max_N,thread_force_min_N,thread_force_mean_N,line_load_max_N_per_m,gap_max_m");
    for (const SeamLoad& l : r.seams) {
        const Seam& seam = s.seams[l.seam];
        if (seam.is_rim()) continue;
        seams.add(l.seam).add(seam.panel[0]).add(seam.panel[1]).add(l.length).add(l.thread_force_max);
        seams.add(l.thread_force_min).add(l.thread_force_mean).add(l.line_load_max).add(l.gap_max).end_row();
    }
    arcsim::write_file_atomically(folder / "seams.csv", seams.text());

    CsvText edges("seam,vertex_a,vertex_b,length_m,thread_force_N,line_load_N_per_m");   // vertices of segments.obj
    for (std::size_t k = 0; k < r.bag.edges.size(); ++k) {
        const SeamEdge& e = r.bag.edges[k];
        edges.add(e.seam).add(e.node[0]).add(e.node[1]).add(e.length);
        edges.add(r.seam_edges[k].thread_force).add(r.seam_edges[k].line_load).end_row();
    }
    arcsim::write_file_atomically(folder / "seam_edges.csv", edges.text());

    CsvText deviation(std::string("vertex,from_cut_m,from_inflated_m") + (r.from_target ? ",from_target_m" : ""));
    for (std::size_t i = 0; i < r.from_cut.per_node.size(); ++i) {
        deviation.add(static_cast<int>(i)).add(r.from_cut.per_node[i]).add(r.from_inflated.per_node[i]);
        if (r.from_target) deviation.add(r.from_target->per_node[i]);
        deviation.end_row();
    }
    arcsim::write_file_atomically(folder / "deviation.csv", deviation.text());
    arcsim::write_file_atomically(folder / "weave_angle.png", encode_png(weave_angle_chart(r)));
}

void add_sew_summary(const SewResult& r, JsonValue& v) {
    v.set("mean_abs_shear", r.weave.abs_shear.mean);
    v.set("p95_abs_shear", r.weave.abs_shear.p95);
    v.set("max_abs_shear", r.weave.abs_shear.max);
    v.set("fabric_mean_abs_shear", r.weave.fabric_abs_shear.mean);
    v.set("fabric_p95_abs_shear", r.weave.fabric_abs_shear.p95);
    v.set("fabric_max_abs_shear", r.weave.fabric_abs_shear.max);
    v.set("taut_mean_abs_shear", r.weave.taut_mean_abs_shear);
    v.set("taut_share", r.weave.taut_share);
    v.set("min_cos_weave_angle", r.weave.cos_angle.min);
    v.set("max_cos_weave_angle", r.weave.cos_angle.max);
    v.set("warp_strain", spread_summary(r.weave.eps_warp));
    v.set("weft_strain", spread_summary(r.weave.eps_weft));
    JsonValue histogram = JsonValue::object(), share = JsonValue::array();
    for (double part : r.weave.angle_histogram) share.add(part);
    histogram.set("bin_deg", angle_bin_deg);
    histogram.set("area_share", std::move(share));
    v.set("weave_angle_off_square", std::move(histogram));
    v.set("shape_rms_m", r.from_cut.rms);
    v.set("shape_max_m", r.from_cut.max);
    v.set("inflated_rms_m", r.from_inflated.rms);
    v.set("inflated_max_m", r.from_inflated.max);
    if (r.from_target) {
        v.set("target_rms_m", r.from_target->rms);
        v.set("target_max_m", r.from_target->max);
    }
    v.set("max_tension_N_per_m", r.weave.tension.max);
    v.set("p95_tension_N_per_m", r.weave.tension.p95);
    if (r.weave.utilisation) v.set("utilisation", *r.weave.utilisation);
    v.set("seam_edges", static_cast<int>(r.bag.edges.size()));
    v.set("seam_edges_shorter", r.shorter_seam_edges);
    v.set("seam_max_force_N", r.seam_max_force_N);
    v.set("seam_max_compression_N", r.seam_max_compression_N);
    v.set("seam_max_line_load_N_per_m", r.seam_max_line_load_N_per_m);
    if (r.bag.n_stitches > 0) v.set("seam_max_gap_m", r.seam_gap_max_m);
    JsonValue compare = JsonValue::object();
    for (const GrainVariant& g : r.compare) compare.set(g.name, variant_summary(g));
    v.set("compare", std::move(compare));
}

}  // namespace formwork
