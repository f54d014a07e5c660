#include "formwork/equilibrium/coarse_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>

namespace formwork {
namespace {

using arcsim::Surface;
using arcsim::Triangle;
using arcsim::Vector3d;

constexpr double crease_cosine = 0.7;      // of the angle between normals (45°): beyond it an edge is a crease
constexpr double straight_cosine = -0.7;   // of the angle between a line's edges: sharper bends are corners
constexpr double fold_cosine = 0.5;        // a face may turn by up to 60°
constexpr double good_shape = 0.3;         // 4 sqrt(3) area over the sum of squared edges; an equilateral face has 1

Vector3d area_normal(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return 0.5 * (b - a).cross(c - a); }

double shape(const Vector3d& a, const Vector3d& b, const Vector3d& c, double area) {
    const double sum = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return sum > 0 ? 4 * std::sqrt(3.) * area / sum : 0;
}

class Coarsener {
public:
    Coarsener(const Surface& s, const std::vector<char>& held)
        : x_(s.x), faces_(s.faces), around_(s.x.size()), into_(s.x.size(), -1), held_(s.x.size(), 0), line_(s.x.size()) {
        for (int f = 0; f < s.n_faces(); ++f)
            for (int k = 0; k < 3; ++k) around_[faces_[f][k]].push_back(f);
        for (std::size_t i = 0; i < x_.size(); ++i)
            if (!held.empty()) held_[i] = static_cast<char>(held[3 * i] | held[3 * i + 1] << 1 | held[3 * i + 2] << 2);
        find_lines(s);
    }

    void run(int target) {
        int left = 0;
        for (const auto& a : around_) left += !a.empty();
        // What cannot go at first may do so once its neighbours have gone.
        for (int sweep = 0; sweep < 3 && left > target; ++sweep) {
            fill_queue();
            const int before = left;
            while (!queue_.empty() && left > target) {
                const Candidate c = queue_.top();
                queue_.pop();
                if (around_[c.a].empty() || around_[c.b].empty()) continue;
                if (draw(c.a, c.b) || draw(c.b, c.a)) --left;
            }
            if (left == before) break;
        }
    }

    CoarseMesh result() const {
        CoarseMesh m;
        std::vector<int> number(x_.size(), -1);
        for (std::size_t i = 0; i < x_.size(); ++i)
            if (!around_[i].empty()) {
                number[i] = static_cast<int>(m.fine_node.size());
                m.fine_node.push_back(static_cast<int>(i));
                m.surface.x.push_back(x_[i]);
            }
        for (std::size_t f = 0; f < faces_.size(); ++f)
            if (faces_[f][0] >= 0) {
                m.surface.faces.push_back({number[faces_[f][0]], number[faces_[f][1]], number[faces_[f][2]]});
                m.fine_face.push_back(static_cast<int>(f));
            }
        m.absorber.resize(x_.size(), -1);
        for (std::size_t i = 0; i < x_.size(); ++i) {
            int c = static_cast<int>(i);
            while (into_[c] >= 0) c = into_[c];
            m.absorber[i] = number[c];
        }
        return m;
    }

private:
    struct Candidate {
        double length2;
        int a, b;
        bool operator<(const Candidate& o) const { return length2 > o.length2; }   // shortest on top
    };
    /// Neighbours along borders and creases: two on a line's inside, none elsewhere; corners do not move.
    struct Line {
        std::vector<int> next;
        bool corner = false;
    };

    void find_lines(const Surface& s) {
        struct Side {
            int a, b, face;
            bool same_edge(const Side& o) const { return a == o.a && b == o.b; }
        };
        std::vector<Side> sides;
        sides.reserve(3 * s.faces.size());
        for (int f = 0; f < s.n_faces(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int i = s.faces[f][k], j = s.faces[f][(k + 1) % 3];
                sides.push_back({std::min(i, j), std::max(i, j), f});
            }
        std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
        for (std::size_t k = 0; k < sides.size(); ++k) {
            const bool inner = k + 1 < sides.size() && sides[k].same_edge(sides[k + 1]);
            if (!inner || face_normal(s, sides[k].face).dot(face_normal(s, sides[k + 1].face)) < crease_cosine) {
                line_[sides[k].a].next.push_back(sides[k].b);
                line_[sides[k].b].next.push_back(sides[k].a);
            }
            k += inner;
        }
        for (std::size_t i = 0; i < line_.size(); ++i) {
            Line& l = line_[i];
            if (l.next.empty()) continue;
            l.corner = l.next.size() != 2 || (x_[l.next[0]] - x_[i]).normalized().dot((x_[l.next[1]] - x_[i]).normalized()) > straight_cosine;
        }
    }

    void fill_queue() {
        queue_ = {};
        for (const Triangle& t : faces_)
            if (t[0] >= 0)
                for (int k = 0; k < 3; ++k)
                    if (t[k] < t[(k + 1) % 3] || line_[t[k]].next.size() == 2) push(t[k], t[(k + 1) % 3]);
    }
    void push(int a, int b) { queue_.push({(x_[a] - x_[b]).squaredNorm(), a, b}); }

    void ring(int v, std::vector<int>& nodes) const {
        nodes.clear();
        for (int f : around_[v])
            for (int n : faces_[f])
                if (n != v && std::find(nodes.begin(), nodes.end(), n) == nodes.end()) nodes.push_back(n);
    }

    bool may_move(int v, int w) const {
        const Line& l = line_[v];
        if (l.corner || (held_[v] && held_[v] != held_[w])) return false;
        return l.next.empty() || l.next[0] == w || l.next[1] == w;
    }

    /// Draws v into w when the surface stays a surface and no face folds over or turns into a sliver.
    bool draw(int v, int w) {
        if (!may_move(v, w)) return false;
        int shared = 0;
        for (int f : around_[v]) {
            const Triangle& t = faces_[f];
            if (t[0] == w || t[1] == w || t[2] == w) {
                ++shared;
                continue;
            }
            Triangle moved = t;
            for (int& n : moved)
                if (n == v) n = w;
            const Vector3d before = area_normal(x_[t[0]], x_[t[1]], x_[t[2]]);
            const Vector3d after = area_normal(x_[moved[0]], x_[moved[1]], x_[moved[2]]);
            const double a = before.norm(), b = after.norm();
            if (before.dot(after) < fold_cosine * a * b) return false;
            const double q = shape(x_[moved[0]], x_[moved[1]], x_[moved[2]], b);
            if (q < good_shape && q < shape(x_[t[0]], x_[t[1]], x_[t[2]], a)) return false;
        }
        ring(v, ring_v_);
        ring(w, ring_w_);
        int common = 0;
        for (int n : ring_v_) common += std::find(ring_w_.begin(), ring_w_.end(), n) != ring_w_.end();
        if (shared == 0 || common != shared) return false;

        for (int f : around_[v]) {
            Triangle& t = faces_[f];
            const bool gone = t[0] == w || t[1] == w || t[2] == w;
            if (gone) {
                for (int n : t)
                    if (n != v) std::erase(around_[n], f);
                t = {-1, -1, -1};
            } else {
                for (int& n : t)
                    if (n == v) n = w;
                around_[w].push_back(f);
            }
        }
        around_[v].clear();
        into_[v] = w;
        if (line_[v].next.size() == 2) {
            const int other = line_[v].next[line_[v].next[0] == w ? 1 : 0];
            for (int& n : line_[w].next)
                if (n == v) n = other;
            for (int& n : line_[other].next)
                if (n == v) n = w;
        }
        for (int n : ring_v_)
            if (n != w && std::find(ring_w_.begin(), ring_w_.end(), n) == ring_w_.end()) push(w, n);
        return true;
    }

    std::vector<Vector3d> x_;
    std::vector<Triangle> faces_;
    std::vector<std::vector<int>> around_;   // faces; empty: the node is gone
    std::vector<int> into_;
    std::vector<char> held_;
    std::vector<Line> line_;
    std::priority_queue<Candidate> queue_;
    std::vector<int> ring_v_, ring_w_;
};

}  // namespace

CoarseMesh coarsen(const Surface& fine, const std::vector<char>& held, int target) {
    Coarsener c(fine, held);
    c.run(target);
    return c.result();
}

}  // namespace formwork
