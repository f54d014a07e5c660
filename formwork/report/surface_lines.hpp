#pragma once

#include <string>
#include <vector>

#include "formwork/report/render_surface.hpp"
#include "formwork/segment/segmentation.hpp"

namespace formwork {

/// What pictures draw upon a surface.

/// Faces spread evenly over the surface, at least `spacing` (m) apart; the order is that of the
/// faces.
std::vector<int> spread_faces(const Surface& s, double spacing);

/// About `count` small crosses along the directions of the faces. @param theta  per face, from edge
/// v0->v1
std::vector<Line3> cross_lines(const Surface& s, const std::vector<double>& theta, int count);

/// Valence beside every singular node; warm colours for positive index, cool ones for negative.
std::vector<Mark3> singularity_marks(const Surface& s,
                                     const std::vector<Singularity>& singularities);
std::string singularity_note(const std::vector<Singularity>& singularities);

std::vector<Line3> seam_lines(const Segmentation& segmentation, const Surface& shown);

/// Distance of every node from the nearest seam or rim, along edges, m.
std::vector<double> distance_from_seams(const Segmentation& segmentation, const Surface& shown);

/// Per panel the face where its name has most room; -1 for a panel without faces.
std::vector<int> panel_label_faces(const Segmentation& segmentation, const Surface& shown);

/// The panels' printed names, at several places each, of which every view draws the one that it
/// sees best.
std::vector<Mark3> panel_name_marks(const Segmentation& segmentation, const Surface& shown);

}  // namespace formwork
