#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formwork/segment/segmentation.hpp"

namespace formwork {

using arcsim::Vector2d;
using arcsim::Vector3d;

/// A point of a curve on a mesh: a node (b < 0), or the point a + t (b - a) inside the edge a-b.
struct CurvePoint {
    int a = -1, b = -1;
    double t = 0;
    bool is_node() const { return b < 0; }
};
using Curve = std::vector<CurvePoint>;   // neighbours share a face

inline Vector3d position(const Surface& s, const CurvePoint& p) {
    return p.is_node() ? s.x[p.a] : Vector3d((1 - p.t) * s.x[p.a] + p.t * s.x[p.b]);
}

/// The surface while it is being cut: faces are split where curves cross them, and the edges under the
/// curves are marked as seams. Nodes of the input keep their numbers; new ones follow.
class CutMesh {
public:
    explicit CutMesh(const Surface& input);
    /// A mesh that is cut already; its nodes and faces lie on the input as the sources say.
    CutMesh(const Surface& input, Surface cut, std::vector<SurfacePoint> source, std::vector<int> source_face);

    const Surface& surface() const { return surface_; }
    const std::vector<SurfacePoint>& source() const { return source_; }
    const std::vector<int>& source_face() const { return source_face_; }

    /// The face that face f was split off from; -1: a face of the input.
    int split_from(int f) const { return split_from_[f]; }

    /// The face on the other side of face f's edge from its corner k to the next; -1: rim.
    int across(int f, int k) const { return side_[f][k].across; }
    bool is_seam_at(int f, int k) const { return side_[f][k].mark != Mark::none; }
    bool is_given_at(int f, int k) const { return side_[f][k].mark == Mark::given; }

    /// The same by an edge's nodes. The face to the left of the directed edge a -> b; -1: none.
    int face_left(int a, int b) const { return side_left(a, b).face; }
    bool is_rim(int a, int b) const { return (face_left(a, b) < 0) != (face_left(b, a) < 0); }
    bool is_seam(int a, int b) const { return mark_of(a, b) != Mark::none; }
    bool is_border(int a, int b) const { return is_seam(a, b) || is_rim(a, b); }
    /// A seam that was asked for: the layout never removes it.
    bool is_given(int a, int b) const { return mark_of(a, b) == Mark::given; }
    void mark_seam(int a, int b, bool given = false) { set_mark(a, b, given ? Mark::given : Mark::seam); }
    void unmark_seam(int a, int b) { set_mark(a, b, Mark::none); }

    /// Splits the faces along the curve and returns its nodes. The pieces are not marked.
    std::vector<int> insert(const Curve& curve);
    /// insert(), and every step becomes a seam. Empty, and no seam, when the curve crosses itself.
    std::vector<int> insert_seam(const Curve& curve, bool given = false);

    /// Puts a node inside the edge a-b, at a + t (b - a); the faces at the edge become two each.
    int split_edge(int a, int b, double t);

private:
    enum class Mark : std::uint8_t { none, seam, given };
    struct Side {   // an edge seen from one of its faces
        int across = -1;
        Mark mark = Mark::none;
    };
    struct Corner {   // of a face; also the edge from there to the next corner
        int face = -1, k = 0;
    };
    void join_faces();
    Corner side_left(int a, int b) const;
    Mark mark_of(int a, int b) const;
    void set_mark(int a, int b, Mark mark);
    int split_side(Corner side, int m);
    SurfacePoint locate(int face, const Vector3d& x) const;

    const Surface* input_;
    Surface surface_;
    std::vector<SurfacePoint> source_;
    std::vector<int> source_face_, split_from_;
    std::vector<std::array<Side, 3>> side_;   // per face; [k] from corner k to the next
    std::vector<int> face_at_;                // per node: one of its faces
};

/// Barycentric coordinates of the point of face f's plane nearest to x; they sum to 1 and may be negative.
std::array<double, 3> barycentric_coordinates(const Surface& s, int f, const Vector3d& x);

}  // namespace formwork
