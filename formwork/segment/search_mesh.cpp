#include "formwork/segment/search_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

#include "formwork/mesher/edge_collapse.hpp"
#include "formwork/segment/degree.hpp"
#include "formwork/segment/mesh_repair.hpp"

namespace formwork {
namespace {

constexpr double fold = 40 * degree;          // dihedral: such edges keep their course
constexpr double straight = 12 * degree;      // turn of the rim or a fold that a collapse may level
constexpr double least = 22 * degree;         // angle of a face after a collapse
constexpr double agreement = 0.93;            // cosine between a face's normal before and after, and to the input's

class Coarsening {
public:
    Coarsening(const Surface& input, const Topology& t)
        : input_(input), topology_(t), mesh_(input, std::cos(fold)), origin_(input.x.size()), stamp_(input.x.size(), 0) {
        for (int v = 0; v < input.n_nodes(); ++v) origin_[v] = t.node_faces[v].front();
        normal_.resize(input.faces.size());
        for (int f = 0; f < input.n_faces(); ++f) normal_[f] = arcsim::face_normal(input, f);
    }

    SearchMesh run(int target) {
        collapse_edges(target);
        for (int round = 0; round < 3; ++round) {
            flip_edges();
            relax();
        }
        return compact();
    }

private:
    struct Item {
        double length;
        int a, b, stamp_a, stamp_b;
        bool operator<(const Item& o) const { return length != o.length ? length > o.length : std::pair(a, b) > std::pair(o.a, o.b); }
    };

    double least_angle(const arcsim::Triangle& t) const { return arcsim::min_angle(s_, t); }
    Vector3d normal(const arcsim::Triangle& t) const { return arcsim::face_normal(s_, t); }

    void offer(int a, int b) { queue_.push({(s_.x[a] - s_.x[b]).norm(), std::min(a, b), std::max(a, b), stamp_[std::min(a, b)], stamp_[std::max(a, b)]}); }

    /// Least angle of the faces around a once it is drawn into b; negative when that must not be done.
    double after_collapse(int a, int b) const {
        if (!mesh_.keeps_lines(a, b)) return -1;
        if (!feature_[a].empty()) {   // only where the line is straight
            const int beyond = mesh_.beyond(a, b);
            const Vector3d u = s_.x[a] - s_.x[beyond], v = s_.x[b] - s_.x[a];
            if (u.dot(v) < std::cos(straight) * u.norm() * v.norm() || mesh_.is_on_line(beyond, b)) return -1;
        }
        if (!mesh_.keeps_surface(a, b)) return -1;
        double smallest = std::numbers::pi;
        for (int f : around_[a]) {
            arcsim::Triangle t = s_.faces[f];
            if (std::count(t.begin(), t.end(), b)) continue;
            std::replace(t.begin(), t.end(), a, b);
            if (normal(t).dot(normal_[f]) < agreement) return -1;
            smallest = std::min(smallest, least_angle(t));
        }
        return smallest;
    }

    void collapse(int a, int b) {
        mesh_.draw(a, b);
        ++stamp_[a];
        ++stamp_[b];
        std::set<int> ring;
        for (int f : around_[b]) ring.insert(s_.faces[f].begin(), s_.faces[f].end());
        ring.erase(b);
        for (int v : ring) offer(b, v);
    }

    void collapse_edges(int target) {
        for (const arcsim::Edge& e : topology_.edges) offer(e.node[0], e.node[1]);
        const double longest = 1.5 * std::sqrt(4 / std::sqrt(3.) * arcsim::total_area(input_) / target);
        while (mesh_.n_faces > target && !queue_.empty()) {
            const Item q = queue_.top();
            queue_.pop();
            if (stamp_[q.a] != q.stamp_a || stamp_[q.b] != q.stamp_b) continue;
            if (q.length > longest) break;
            const double into_b = after_collapse(q.a, q.b), into_a = after_collapse(q.b, q.a);
            if (std::max(into_a, into_b) < least) continue;
            if (into_b >= into_a)
                collapse(q.a, q.b);
            else
                collapse(q.b, q.a);
        }
    }

    void flip_edges() {
        for (int f = 0; f < s_.n_faces(); ++f)
            for (int k = 0; k < 3 && s_.faces[f][0] >= 0; ++k) flip(f, s_.faces[f][k], s_.faces[f][(k + 1) % 3]);
    }

    void flip(int f, int a, int b) {   // f lies left of a -> b
        if (mesh_.is_on_line(a, b)) return;
        int g = -1;
        for (int h : around_[a])
            if (h != f && std::count(s_.faces[h].begin(), s_.faces[h].end(), b)) g = h;
        if (g < 0) return;
        const auto apex = [&](int h) { return s_.faces[h][0] + s_.faces[h][1] + s_.faces[h][2] - a - b; };
        const int c = apex(f), d = apex(g);
        for (int h : around_[c])
            if (std::count(s_.faces[h].begin(), s_.faces[h].end(), d)) return;
        const arcsim::Triangle u{c, a, d}, v{d, b, c};
        if (std::min(least_angle(u), least_angle(v)) < 1.1 * std::min(least_angle(s_.faces[f]), least_angle(s_.faces[g]))) return;
        const Vector3d nf = normal(s_.faces[f]), ng = normal(s_.faces[g]), n = (nf + ng).normalized();
        if (nf.dot(ng) < 0.9 || normal(u).dot(n) < 0.9 || normal(v).dot(n) < 0.9) return;
        std::erase(around_[a], g);
        std::erase(around_[b], f);
        s_.faces[f] = u;
        s_.faces[g] = v;
        around_[c].push_back(g);
        around_[d].push_back(f);
    }

    void relax() {
        for (int v = 0; v < s_.n_nodes(); ++v) {
            if (around_[v].empty() || !feature_[v].empty()) continue;
            Vector3d mean = Vector3d::Zero();
            double before = std::numbers::pi;
            for (int f : around_[v]) {
                mean += arcsim::face_centroid(s_, f) / static_cast<double>(around_[v].size());
                before = std::min(before, least_angle(s_.faces[f]));
            }
            const Vector3d old = s_.x[v];
            const SurfacePoint p = nearest_point(input_, topology_, origin_[v], mean);
            s_.x[v] = point_at(input_, p);
            bool good = true;
            for (int f : around_[v])
                good = good && least_angle(s_.faces[f]) >= std::min(before, 30 * degree) &&
                       normal(s_.faces[f]).dot(arcsim::face_normal(input_, p.face)) > 0.8;
            if (good)
                origin_[v] = p.face;
            else
                s_.x[v] = old;
        }
    }

    SearchMesh compact() const {
        SearchMesh r;
        std::vector<int> node(s_.x.size(), -1);
        for (int v = 0; v < s_.n_nodes(); ++v)
            if (!around_[v].empty()) {
                node[v] = r.surface.n_nodes();
                r.surface.x.push_back(s_.x[v]);
                r.source.push_back(nearest_point(input_, topology_, origin_[v], s_.x[v]));
            }
        for (const arcsim::Triangle& t : s_.faces) {
            if (t[0] < 0) continue;
            r.surface.faces.push_back({node[t[0]], node[t[1]], node[t[2]]});
            r.source_face.push_back(nearest_point(input_, topology_, origin_[t[0]], (s_.x[t[0]] + s_.x[t[1]] + s_.x[t[2]]) / 3).face);
        }
        return r;
    }

    const Surface& input_;
    const Topology& topology_;
    CollapsingMesh mesh_;
    Surface& s_ = mesh_.surface;
    std::vector<std::vector<int>>& around_ = mesh_.around;
    const std::vector<std::vector<int>>& feature_ = mesh_.line;
    std::vector<int> origin_;                 // per node: an input face that it lies on
    std::vector<int> stamp_;
    std::vector<Vector3d> normal_;            // per face: of the input
    std::priority_queue<Item> queue_;
};

}  // namespace

SearchMesh search_mesh(const Surface& input, const Topology& t, int target) { return Coarsening(input, t).run(target); }

}  // namespace formwork
