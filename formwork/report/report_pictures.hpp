#pragma once

#include <filesystem>
#include <vector>

#include "formwork/panels/pattern.hpp"
#include "formwork/report/report.hpp"

namespace formwork {

/// Every picture that the data allows, in the order of the stages. Drawn by up to `threads`
/// threads.
std::vector<ReportPicture> draw_pictures(const ReportInput& in, int threads = 2);

/// inflate/inflated.vtu and .glb, segment/panels.glb, sew/sewn.vtu and .glb below `folder`, as far
/// as there is data. Returns the names below the folder. @throws arcsim::InputError when the place
/// cannot be written
std::vector<std::string> write_viewer_files(const ReportInput& in,
                                            const std::filesystem::path& folder);

/// The sewing order in words: "S03: join P01 to P02, 302 mm".
std::vector<ReportStep> report_steps(const PanelSet& set, const std::vector<SewingStep>& order);

}  // namespace formwork
