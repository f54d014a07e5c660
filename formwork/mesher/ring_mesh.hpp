#pragma once

#include <vector>

#include "arcsim/mesh/surface.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Triangle;
using arcsim::Vector3d;

/// Builds a surface ring by ring. Every ring is a closed polyline, counter-clockwise seen from above; rings
/// come from the bottom's centre outwards and then up the wall, and the normals point out of the bag.
class RingMesh {
public:
    /// The first ring may be one point: a pole.
    void add_ring(const std::vector<Vector3d>& ring);
    /// Closes the surface with a pole.
    void add_pole(const Vector3d& point) { add_ring({point}); }
    Surface take() { return std::move(surface_); }

private:
    Surface surface_;
    std::vector<int> last_;   // nodes of the last ring
};

/// A triangulated surface of nearly equilateral triangles over a profile: `n_rows` rows between s = 0 and
/// s = 1 of each segment, `edge` (m) the wanted edge length.
struct SweptSection {
    /// Point at parameter s (0..1 along the whole profile) and t (0..1 around, equal steps in length).
    virtual Vector3d point(double s, double t) const = 0;
    /// Parameters s that must carry a ring: 0, corners of the profile, 1.
    virtual std::vector<double> breaks() const = 0;
    virtual ~SweptSection() = default;
};
Surface mesh_swept_section(const SweptSection& section, double edge);

}  // namespace formwork
