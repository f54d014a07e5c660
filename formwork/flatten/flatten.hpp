#pragma once

#include <utility>
#include <vector>

#include "arcsim/mesh/surface.hpp"

namespace formwork {

using arcsim::Matrix2d;
using arcsim::Surface;
using arcsim::Triangle;
using arcsim::Vector2d;

/// What the cloth must do from its flat shape to the surface, face by face. sigma are the singular values
/// of the map flat -> surface, so sigma > 1 means that the cloth has to stretch. Shares are of the area.
struct StretchStatistics {
    double mean = 0;                 // area-weighted mean of max |sigma - 1|
    double p95 = 0;                  // 95 % of the area stays below it
    double max = 0;                  // largest |sigma - 1|
    double within_5_percent = 1;     // share of the area with |sigma - 1| <= 0.05
    double symmetric_dirichlet = 4;  // area mean of s1² + s2² + 1/s1² + 1/s2², s = 1/sigma; 4: isometric
    double area_change = 0;          // flat area over surface area, minus 1
    int flips = 0;                   // faces turned over
};

struct FlattenParams {
    int max_iterations = 200;   // Newton steps
    double tolerance = 1e-6;    // stop when a step lowers E - 4 by less than this share of it

    /// A few steps: statistics good enough to tell a valid panel from an invalid one.
    static FlattenParams fast() { return {8, 2e-2}; }
};

struct FlattenResult {
    std::vector<Vector2d> u;   // per node of the disk, m; faces counter-clockwise; nodes without faces at 0
    StretchStatistics stretch;
    int iterations = 0;
    bool converged = false;
};

/// Lays a disk flat with the least isometric distortion.
///
///   E = sum_f A_f (s1² + s2² + 1/s1² + 1/s2²) / sum_f A_f,   s: singular values surface -> plane
///                                                         [Smith and Schaefer 2015, symmetric Dirichlet]
///
/// Start: the least squares conformal map when it has no flips, else the convex map onto a circle. Then
/// Newton's method with each face's Hessian projected in closed form and a line search that never turns a
/// face over.
/// @param disk  one component, one boundary loop, no handles
/// @throws InputError when the surface is no disk or has a face without area; NumericalError when no start
///         without flips exists in double precision
FlattenResult flatten_disk(const Surface& disk, const FlattenParams& params = {});
/// The same for a surface that is known to be a disk, by its outline: boundary nodes in the faces' direction.
FlattenResult flatten_disk(const Surface& disk, const std::vector<int>& outline, const FlattenParams& params);

/// The shape of every face in a plane of its own: columns are the edges 0->1 and 0->2, m; first axis along
/// edge 0->1 (the FaceFrame of arcsim/mesh/surface.hpp).
std::vector<Matrix2d> rest_shapes(const Surface& s);

/// Statistics of the map from flat coordinates to faces of the given shapes (see rest_shapes).
StretchStatistics measure_stretch(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                                  const std::vector<Vector2d>& u);

/// max |sigma - 1| of each face, flat -> surface; infinity for a face turned over.
std::vector<double> face_distortions(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                                     const std::vector<Vector2d>& u);

/// Pairs (i, j) of edges i -> i+1 of a closed polygon that cross or touch although they are no
/// neighbours; at most `limit` pairs. A flattening without flips is one-to-one when there is none.
std::vector<std::pair<int, int>> outline_crossings(const std::vector<Vector2d>& outline, int limit = 16);

}  // namespace formwork
