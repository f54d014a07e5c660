#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formwork/panels/flat_panel.hpp"
#include "formwork/report/seam_edge_force.hpp"
#include "formwork/segment/segmentation.hpp"
#include "formwork/strain/strain_field.hpp"

namespace formwork {

using arcsim::Vector3d;

/// One line of the sewing order, as it is to be read at the machine.
struct ReportStep {
    std::string text;         // for example "join P03 to P05, 242 mm"
    int seam = -1;            // of Segmentation::seams; clicking the line shows it
    std::vector<int> panels;  // 0-based, shown with it
};

/// The residual after each iteration of one solve, relative to the load.
struct ConvergenceCurve {
    std::string name;
    std::vector<double> residual;
};

/// A picture made by this program, embedded as it is.
struct ReportPicture {
    std::string name;  // of its file, without ending
    std::string title, caption;
    std::string png;  // the file's bytes (encode_png)
};

/// All that the report shows, as plain data. Whatever a run did not compute stays empty and is left
/// out.
struct ReportInput {
    std::string title;         // the scene's name
    std::string summary_json;  // text of summary.json
    std::string scene_json;    // text of the effective scene
    Vector3d up{0, 0, 1};

    Surface rest;                    // the input mesh, m
    std::vector<Vector3d> inflated;  // its nodes after `inflate`, m
    StrainField inflated_strain;     // per face of `rest`
    std::optional<Segmentation> segmentation;
    std::vector<std::vector<Vector3d>> candidates;  // curves that might have become seams, m
    std::vector<FlatPanel> panels;
    std::vector<Vector3d> sewn;  // nodes of segmentation->mesh after `sew`, m
    StrainField sewn_strain;     // per face of segmentation->mesh
    std::vector<double>
        deviation;  // per node of segmentation->mesh: signed distance, m; positive outside
    std::string deviation_from;  // of what: "the surface that was cut", "the target"
    std::vector<SeamEdgeForce> seam_forces;  // of the sewn bag

    std::vector<ReportStep> sewing_order;
    std::vector<ConvergenceCurve> convergence;
    std::vector<ReportPicture> pictures;
    std::vector<std::string> notes;  // assumptions and warnings of this run, one sentence each
};

/// The report as one HTML file that needs neither network nor other files.
std::string compose_report(const ReportInput& input);

/// @throws arcsim::InputError when the place cannot be written; std::invalid_argument when sizes do
/// not fit together
void write_report(const ReportInput& input, const std::filesystem::path& path);

}  // namespace formwork
