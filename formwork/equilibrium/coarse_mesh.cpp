#include "formwork/equilibrium/coarse_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>

#include "formwork/mesher/edge_collapse.hpp"

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
        : mesh_(s, crease_cosine), into_(s.x.size(), -1), held_(s.x.size(), 0), corner_(s.x.size(), 0) {
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            if (!held.empty()) held_[i] = static_cast<char>(held[3 * i] | held[3 * i + 1] << 1 | held[3 * i + 2] << 2);
            const std::vector<int>& l = mesh_.line[i];
            corner_[i] = !l.empty() && (l.size() != 2 || (s.x[l[0]] - s.x[i]).normalized().dot((s.x[l[1]] - s.x[i]).normalized()) > straight_cosine);
        }
    }

    void run(int target) {
        int left = 0;
        for (const auto& a : mesh_.around) left += !a.empty();
        // What cannot go at first may do so once its neighbours have gone.
        for (int sweep = 0; sweep < 3 && left > target; ++sweep) {
            fill_queue();
            const int before = left;
            while (!queue_.empty() && left > target) {
                const Candidate c = queue_.top();
                queue_.pop();
                if (mesh_.around[c.a].empty() || mesh_.around[c.b].empty()) continue;
                if (draw(c.a, c.b) || draw(c.b, c.a)) --left;
            }
            if (left == before) break;
        }
    }

    CoarseMesh result() const {
        CoarseMesh m;
        const std::vector<Vector3d>& x = mesh_.surface.x;
        std::vector<int> number(x.size(), -1);
        for (std::size_t i = 0; i < x.size(); ++i)
            if (!mesh_.around[i].empty()) {
                number[i] = static_cast<int>(m.fine_node.size());
                m.fine_node.push_back(static_cast<int>(i));
                m.surface.x.push_back(x[i]);
            }
        for (std::size_t f = 0; f < mesh_.surface.faces.size(); ++f)
            if (const Triangle& t = mesh_.surface.faces[f]; t[0] >= 0) {
                m.surface.faces.push_back({number[t[0]], number[t[1]], number[t[2]]});
                m.fine_face.push_back(static_cast<int>(f));
            }
        m.absorber.resize(x.size(), -1);
        for (std::size_t i = 0; i < x.size(); ++i) {
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

    void fill_queue() {
        queue_ = {};
        for (const Triangle& t : mesh_.surface.faces)
            if (t[0] >= 0)
                for (int k = 0; k < 3; ++k)
                    if (t[k] < t[(k + 1) % 3] || mesh_.line[t[k]].size() == 2) push(t[k], t[(k + 1) % 3]);
    }
    void push(int a, int b) { queue_.push({(mesh_.surface.x[a] - mesh_.surface.x[b]).squaredNorm(), a, b}); }

    /// No face may fold over or turn into a sliver.
    bool keeps_faces(int v, int w) const {
        const std::vector<Vector3d>& x = mesh_.surface.x;
        for (int f : mesh_.around[v]) {
            const Triangle& t = mesh_.surface.faces[f];
            if (t[0] == w || t[1] == w || t[2] == w) continue;
            Triangle moved = t;
            std::replace(moved.begin(), moved.end(), v, w);
            const Vector3d before = area_normal(x[t[0]], x[t[1]], x[t[2]]);
            const Vector3d after = area_normal(x[moved[0]], x[moved[1]], x[moved[2]]);
            const double a = before.norm(), b = after.norm();
            if (before.dot(after) < fold_cosine * a * b) return false;
            const double q = shape(x[moved[0]], x[moved[1]], x[moved[2]], b);
            if (q < good_shape && q < shape(x[t[0]], x[t[1]], x[t[2]], a)) return false;
        }
        return true;
    }

    bool draw(int v, int w) {
        if (corner_[v] || (held_[v] && held_[v] != held_[w]) || !mesh_.keeps_lines(v, w)) return false;
        if (!keeps_faces(v, w) || !mesh_.keeps_surface(v, w)) return false;
        std::vector<int> ring_v, ring_w;
        mesh_.ring(v, ring_v);
        mesh_.ring(w, ring_w);
        mesh_.draw(v, w);
        into_[v] = w;
        for (int n : ring_v)
            if (n != w && std::find(ring_w.begin(), ring_w.end(), n) == ring_w.end()) push(w, n);
        return true;
    }

    CollapsingMesh mesh_;
    std::vector<int> into_;
    std::vector<char> held_, corner_;   // corners of lines do not move
    std::priority_queue<Candidate> queue_;
};

}  // namespace

CoarseMesh coarsen(const Surface& fine, const std::vector<char>& held, int target) {
    Coarsener c(fine, held);
    c.run(target);
    return c.result();
}

}  // namespace formwork
