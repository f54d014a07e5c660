#pragma once

#include <filesystem>

#include "arcsim/base/json_value.hpp"
#include "formwork/sew/sew.hpp"

namespace formwork {

/// Files of the stage beside sewn.obj and strain.csv:
///   weave.csv      per face: stretch and tension (N per rest metre) of warp and weft, cosine of the angle between them
///   panels.csv     per panel: area, mean shear, share of its area that is taut, its share of all shear
///   seams.csv      per sewn seam: thread force, tension across it, gap
///   deviation.csv  per node: signed distance from the surface that was cut, the inflated one, and the target when there is one
void write_sew_tables(const std::filesystem::path& folder, const SewResult& result, const Segmentation& s);

/// The keys of SYSTEM §5 that only `sew` has, and what else the stage answers.
void add_sew_summary(const SewResult& result, arcsim::JsonValue& v);

}  // namespace formwork
