#include "formwork/segment/mirror_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "formwork/segment/mesh_repair.hpp"
#include "formwork/segment/nearest_surface.hpp"

namespace formwork {
namespace {

/// A part of the surface that grows by its mirror images.
struct Part {
    MeshOnInput mesh;
    std::vector<char> on_rim;                     // per node: on the input's own rim
    std::vector<std::vector<char>> on_plane;      // per plane, per node: on the border that lies on the plane
    std::vector<std::pair<int, int>> seams;
};

/// The kept faces of a cut mesh. A border of the part lies on the plane that parts its two faces.
Part take_part(const CutMesh& cut, const std::vector<char>& kept, const std::vector<MirrorPlane>& planes) {
    const Surface& s = cut.surface();
    Part part;
    part.on_plane.resize(planes.size());
    std::vector<int> number(s.x.size(), -1);
    const auto side = [&](int f, std::size_t k) { return planes[k].normal.dot(arcsim::face_centroid(s, f) - planes[k].point) >= 0; };
    for (int f = 0; f < s.n_faces(); ++f) {
        if (!kept[f]) continue;
        for (int v : s.faces[f]) {
            if (number[v] >= 0) continue;
            number[v] = part.mesh.surface.n_nodes();
            part.mesh.surface.x.push_back(s.x[v]);
            part.mesh.source.push_back(cut.source()[v]);
        }
        const arcsim::Triangle& t = s.faces[f];
        part.mesh.surface.faces.push_back({number[t[0]], number[t[1]], number[t[2]]});
        part.mesh.source_face.push_back(cut.source_face()[f]);
    }
    part.on_rim.assign(part.mesh.surface.x.size(), 0);
    for (auto& on : part.on_plane) on.assign(part.mesh.surface.x.size(), 0);
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = s.faces[f][k], b = s.faces[f][(k + 1) % 3], g = cut.across(f, k);
            if (!kept[f]) continue;
            if (g < 0) part.on_rim[number[a]] = part.on_rim[number[b]] = 1;
            if (cut.is_seam_at(f, k)) part.seams.emplace_back(number[a], number[b]);
            if (g < 0 || kept[g]) continue;
            for (std::size_t p = 0; p < planes.size(); ++p)
                if (side(f, p) != side(g, p)) part.on_plane[p][number[a]] = part.on_plane[p][number[b]] = 1;
        }
    return part;
}

/// The point of the rim nearest to x.
SurfacePoint nearest_on_rim(const Surface& input, const Topology& t, const Vector3d& x) {
    SurfacePoint p;
    double least = std::numeric_limits<double>::infinity();
    for (const arcsim::Edge& e : t.edges) {
        if (!e.is_boundary()) continue;
        const Vector3d a = input.x[e.node[0]], d = input.x[e.node[1]] - a;
        const double u = std::clamp((x - a).dot(d) / d.squaredNorm(), 0., 1.), off = (a + u * d - x).squaredNorm();
        if (off >= least) continue;
        least = off;
        p.face = e.face[0];
        p.barycentric = {0, 0, 0};
        p.barycentric[(e.corner[0] + 1) % 3] = 1 - u;
        p.barycentric[(e.corner[0] + 2) % 3] = u;
    }
    return p;
}

/// The part and its image, sewn along plane `k`. @returns false when a face of the image is turned over
bool add_image(Part& part, std::size_t k, const MirrorPlane& plane, const Surface& input, const Topology& t,
               const NearestSurface& nearest) {
    const int n = part.mesh.surface.n_nodes(), n_faces = part.mesh.surface.n_faces();
    std::vector<int> image(n);
    for (int v = 0; v < n; ++v) {
        image[v] = v;
        if (part.on_plane[k][v]) continue;
        const Vector3d x = plane.mirror(part.mesh.surface.x[v]);
        const SurfacePoint p = part.on_rim[v] ? nearest_on_rim(input, t, x) : nearest_point(input, t, nearest.point(x).face, x);
        image[v] = part.mesh.surface.n_nodes();
        part.mesh.surface.x.push_back(point_at(input, p));
        part.mesh.source.push_back(p);
        part.on_rim.push_back(part.on_rim[v]);
        for (auto& on : part.on_plane) on.push_back(on[v]);
    }
    bool sound = true;
    for (int f = 0; f < n_faces; ++f) {
        const arcsim::Triangle u = part.mesh.surface.faces[f];
        part.mesh.surface.faces.push_back({image[u[0]], image[u[2]], image[u[1]]});
        const int g = part.mesh.surface.n_faces() - 1;
        const int near = part.mesh.source[image[u[0]]].face;
        part.mesh.source_face.push_back(nearest_point(input, t, near, arcsim::face_centroid(part.mesh.surface, g)).face);
        const Vector3d normal = arcsim::area_vector(part.mesh.surface, g);
        sound = sound && normal.dot(arcsim::face_normal(input, part.mesh.source_face.back())) >= 0.3 * normal.norm();
    }
    for (std::size_t i = 0, size = part.seams.size(); i < size; ++i)
        part.seams.emplace_back(image[part.seams[i].first], image[part.seams[i].second]);
    return sound;
}

}  // namespace

MirroredMesh mirror_part(const CutMesh& cut, const std::vector<char>& is_kept, const Surface& input, const Topology& t,
                         const std::vector<MirrorPlane>& planes) {
    Part part = take_part(cut, is_kept, planes);
    const NearestSurface nearest(input, t);
    MirroredMesh m;
    m.is_sound = true;
    m.face_image.resize(planes.size());
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const int n = part.mesh.surface.n_faces();
        m.is_sound = add_image(part, k, planes[k], input, t, nearest) && m.is_sound;
        for (std::size_t j = 0; j < k; ++j)   // images across the earlier planes, in the new half as in the old one
            for (int f = 0; f < n; ++f) m.face_image[j].push_back(m.face_image[j][f] + n);
        for (int f = 0; f < 2 * n; ++f) m.face_image[k].push_back(f < n ? f + n : f - n);
    }
    m.mesh = std::move(part.mesh);
    std::set<std::pair<int, int>> seams;
    for (const auto& [a, b] : part.seams) seams.insert(std::minmax(a, b));
    m.seams.assign(seams.begin(), seams.end());
    m.is_sound = m.is_sound && std::abs(arcsim::total_area(m.mesh.surface) / arcsim::total_area(input) - 1) < 0.01;
    return m;
}

}  // namespace formwork
