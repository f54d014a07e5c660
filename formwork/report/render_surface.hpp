#pragma once

#include <string>
#include <vector>

#include "arcsim/mesh/surface.hpp"
#include "formwork/report/image.hpp"
#include "formwork/report/paint.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Vector3d;

/// A chain of points on the surface. Hidden parts are not drawn.
struct Line3 {
    std::vector<Vector3d> points;  // m
    Rgb colour{0.1, 0.1, 0.12};
    double width_px = 3;
    double opacity = 1;
    Vector3d normal{
        0, 0, 0};  // of the surface there; when given, the line is left out where seen edge-on
};

/// A disc with a text at a point of the surface, drawn where the point is visible. Of marks with
/// one `group` (>= 0) every view draws one, where the surface there faces the viewer and `weight`
/// says that there is room.
struct Mark3 {
    Vector3d at;
    std::string text;  // empty: a dot
    Rgb colour{0.85, 0.25, 0.1};
    double radius_px = 15;     // 0: text alone, with a white rim
    Vector3d normal{0, 0, 0};  // needed by marks of a group
    int group = -1;
    double weight = 1;
};

struct PictureOptions {
    int width = 1280, height = 860;  // px; a slender shape gets a narrower picture
    Vector3d up{0, 0, 1};
    std::vector<double> azimuths_deg;  // one view each, side by side; empty: front and back, or one
                                       // for a flat shape
    double elevation_deg = -1000;      // below -90: chosen from the shape
    std::string title;                 // upper left
    std::string note;                  // smaller, below the title
};

/// Draws a surface with its colours, lines, marks and legend on white.
/// @throws std::invalid_argument when `paint` has neither one colour per face nor per node (our own
/// error)
Image render_surface(const Surface& surface, const Paint& paint, const std::vector<Line3>& lines,
                     const std::vector<Mark3>& marks, const PictureOptions& options);

/// Unit normals at the nodes, area-weighted; zero at nodes without faces.
std::vector<Vector3d> node_normals(const Surface& s);

}  // namespace formwork
