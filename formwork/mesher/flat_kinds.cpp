#include <cmath>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "formwork/mesher/mesh_kinds.hpp"
#include "formwork/mesher/ring_mesh.hpp"

namespace formwork {

using arcsim::InputError;
using std::numbers::pi;

Surface make_disk(const DiskSize& size) {
    const int rings = static_cast<int>(std::lround(size.radius / size.edge));
    if (rings < 1) throw InputError("formwork mesh disk: --edge must be smaller than --radius.");
    RingMesh mesh;
    mesh.add_pole({0, 0, 0});
    for (int k = 1; k <= rings; ++k) {   // 6, 12, 18 ... points: the hexagonal grid bent round
        std::vector<Vector3d> ring;
        const double r = size.radius * k / rings;
        for (int i = 0; i < 6 * k; ++i) ring.push_back({r * std::cos(pi * i / (3 * k)), r * std::sin(pi * i / (3 * k)), 0});
        mesh.add_ring(ring);
    }
    Surface s = mesh.take();
    for (Triangle& t : s.faces) std::swap(t[1], t[2]);   // seen from above, not from below
    return s;
}

Surface make_strip(const StripSize& size) {
    const int nx = std::max(1, static_cast<int>(std::lround(size.length / size.edge)));
    const int ny = std::max(1, static_cast<int>(std::lround(size.width / size.edge)));
    Surface s;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) s.x.push_back({size.length * i / nx, size.width * j / ny, 0});
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const int a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = a + nx + 1;
            if ((i + j) % 2 == 0) {   // alternating diagonals: no direction is preferred
                s.faces.push_back({a, b, c});
                s.faces.push_back({a, c, d});
            } else {
                s.faces.push_back({a, b, d});
                s.faces.push_back({b, c, d});
            }
        }
    return s;
}

}  // namespace formwork
