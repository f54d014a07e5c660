#pragma once

#include <filesystem>

#include "formwork/panels/panel_set.hpp"
#include "formwork/segment/segmentation.hpp"

namespace formwork {

/// The files of the stage `segment`; together they hold a Segmentation to the last digit:
/// segments.obj (cut mesh, one group per panel), labels.csv (face,panel), field.csv (face,x,y,z: one arm of the smoothed
/// field), singularities.csv (vertex,index,x,y,z), seams.csv (seam,panel_a,panel_b,vertex_a,vertex_b: an edge of the chain
/// a line, in order; panel_b is -1 on a rim), source.csv (vertex,face,b0,b1,b2: where it lies on the input mesh),
/// directions.csv (face,source_face,theta,s1,s2,weight,field_theta), candidates.csv (curve,kind,cost,x,y,z: a point a line;
/// kind 0 from border to border, 1 closed, 2 through a singularity), violations.txt (only when there are any). layout.json
/// tells the same layout as nodes, arcs and panels. Everything is counted from 0.
void write_segmentation(const std::filesystem::path& folder, const Segmentation& s);

/// @throws InputError: a file is missing or broken, numbers do not fit together
Segmentation read_segmentation(const std::filesystem::path& folder);

/// The layout as its panels were cut: `panels/sewn_rest.obj` has the nodes, which `panels.recut` moves, and
/// `panels/directions.csv` what the grain follows, where that is not the strain of the inflated bag.
/// @throws InputError: the panels belong to another layout
Segmentation as_cut(Segmentation s, const std::filesystem::path& panels_folder);

/// Writes `panels/directions.csv` (face,theta,s1,s2,weight), or removes it when the grain follows the layout's own directions.
void write_grain_directions(const std::filesystem::path& panels_folder, const Segmentation& s, bool own);

/// The panels' flat shapes back from panels/sewn_rest.obj, whose verts stand panel after panel in the order of
/// FlatPanel::u; measures of the panels are those that follow from the shapes.
PanelSet read_panels(const std::filesystem::path& sewn_rest, const Segmentation& s);

}  // namespace formwork
