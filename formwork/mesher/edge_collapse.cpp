#include "formwork/mesher/edge_collapse.hpp"

#include <algorithm>

namespace formwork {

using arcsim::Surface;
using arcsim::Triangle;

namespace {

bool has_corner(const Triangle& t, int node) { return t[0] == node || t[1] == node || t[2] == node; }

}  // namespace

CollapsingMesh::CollapsingMesh(const Surface& s, double crease_cosine)
    : surface(s), around(s.x.size()), line(s.x.size()), n_faces(s.n_faces()) {
    struct Side {
        int a, b, face;
        bool same_edge(const Side& o) const { return a == o.a && b == o.b; }
    };
    std::vector<Side> sides;
    sides.reserve(3 * s.faces.size());
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int i = s.faces[f][k], j = s.faces[f][(k + 1) % 3];
            around[i].push_back(f);
            sides.push_back({std::min(i, j), std::max(i, j), f});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const bool inner = k + 1 < sides.size() && sides[k].same_edge(sides[k + 1]);
        if (!inner || face_normal(s, sides[k].face).dot(face_normal(s, sides[k + 1].face)) < crease_cosine) {
            line[sides[k].a].push_back(sides[k].b);
            line[sides[k].b].push_back(sides[k].a);
        }
        k += inner;
    }
}

bool CollapsingMesh::is_on_line(int a, int b) const { return std::find(line[a].begin(), line[a].end(), b) != line[a].end(); }

void CollapsingMesh::ring(int a, std::vector<int>& nodes) const {
    for (int f : around[a])
        for (int n : surface.faces[f])
            if (n != a && std::find(nodes.begin(), nodes.end(), n) == nodes.end()) nodes.push_back(n);
}

bool CollapsingMesh::keeps_surface(int a, int b) const {
    int shared = 0;
    for (int f : around[a]) shared += has_corner(surface.faces[f], b);
    if (shared == 0) return false;
    std::vector<int> ring_a, ring_b;
    ring(a, ring_a);
    ring(b, ring_b);
    int common = 0;
    for (int n : ring_a) common += std::find(ring_b.begin(), ring_b.end(), n) != ring_b.end();
    return common == shared;
}

void CollapsingMesh::draw(int a, int b) {
    for (int f : around[a]) {
        Triangle& t = surface.faces[f];
        if (has_corner(t, b)) {
            for (int n : t)
                if (n != a) std::erase(around[n], f);
            t = {-1, -1, -1};
            --n_faces;
        } else {
            std::replace(t.begin(), t.end(), a, b);
            around[b].push_back(f);
        }
    }
    around[a].clear();
    if (line[a].empty()) return;
    const int other = beyond(a, b);
    std::replace(line[b].begin(), line[b].end(), a, other);
    std::replace(line[other].begin(), line[other].end(), a, b);
    line[a].clear();
}

}  // namespace formwork
