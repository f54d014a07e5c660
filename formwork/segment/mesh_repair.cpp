#include "formwork/segment/mesh_repair.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "formwork/segment/degree.hpp"

namespace formwork {
namespace {

constexpr double thin = 20 * degree;            // faces with a smaller angle are mended where possible
constexpr double folded = 0.90;                 // least cosine between faces that a flip may join
constexpr double crease = 45 * degree;           // of the input: nodes on such an edge stay on it, or its faces lose area
constexpr int rounds = 6;

class Repair {
public:
    Repair(const CutMesh& cut, const Surface& input, const Topology& t, const std::vector<int>& fixed)
        : input_(input), topology_(t), s_(cut.surface()), source_(cut.source()), source_face_(cut.source_face()),
          around_(s_.x.size()), borders_(s_.x.size()), fixed_(s_.x.size(), 0) {
        for (int f = 0; f < s_.n_faces(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = s_.faces[f][k], b = s_.faces[f][(k + 1) % 3];
                around_[a].push_back(f);
                if (cut.is_seam(a, b)) seams_[std::minmax(a, b)] = cut.is_given(a, b);
                if (cut.is_border(a, b)) {
                    borders_[a].insert(b);
                    borders_[b].insert(a);
                    if (cut.is_rim(a, b)) fixed_[a] = fixed_[b] = 1;
                    if (cut.is_given(a, b))   // asked for just here
                        for (int v : {a, b}) fixed_[v] = fixed_[v] || is_input_node(v);
                }
            }
        for (int v : fixed) fixed_[v] = 1;
        find_creases();
        for (std::size_t v = 0; v < borders_.size(); ++v)
            if (!borders_[v].empty() && borders_[v].size() != 2) fixed_[v] = 1;
    }

    RepairedMesh run() {
        for (int v = 0; v < s_.n_nodes(); ++v) {   // edges split between moved nodes: back onto the surface
            if ((point_at(input_, source_[v]) - s_.x[v]).squaredNorm() < 1e-24) continue;
            source_[v] = nearest_point(input_, topology_, source_[v].face, s_.x[v]);
            s_.x[v] = point_at(input_, source_[v]);
        }
        for (int round = 0; round < rounds; ++round) {
            if (round < rounds - 1) slide_seams();
            bool changed = false;
            for (int f = 0; f < s_.n_faces(); ++f)
                if (is_alive(f) && least_angle(s_.faces[f]) < thin) changed |= mend(f);
            if (!changed && round > 2) break;
        }
        return compact();
    }

private:
    bool is_alive(int f) const { return s_.faces[f][0] >= 0; }
    bool is_seam(int a, int b) const { return seams_.count(std::minmax(a, b)) > 0; }

    bool is_input_node(int v) const {
        const auto& b = source_[v].barycentric;
        return *std::max_element(b.begin(), b.end()) > 1 - 1e-12;
    }

    double least_angle(const arcsim::Triangle& t) const { return arcsim::min_angle(s_, t); }
    Vector3d normal(const arcsim::Triangle& t) const { return arcsim::face_normal(s_, t); }
    double least_around(int v) const {
        double least = std::numbers::pi;
        for (int f : around_[v]) least = std::min(least, least_angle(s_.faces[f]));
        return least;
    }
    bool faces_agree(int v) const {   // no face around v is turned away from the input under it
        return std::all_of(around_[v].begin(), around_[v].end(), [&](int f) {
            return normal(s_.faces[f]).dot(arcsim::face_normal(input_, source_face_[f])) > 0.7;
        });
    }

    /// Nodes on creases of the input: those at its nodes are held, the others keep to their edge.
    void find_creases() {
        std::set<std::pair<int, int>> bent;
        std::vector<char> at_crease(input_.x.size(), 0);
        for (const arcsim::Edge& e : topology_.edges) {
            if (e.is_boundary() || arcsim::bend_angle(input_, e) < crease) continue;
            bent.insert(std::minmax(e.node[0], e.node[1]));
            for (int v : e.node) at_crease[v] = 1;
        }
        rail_.assign(s_.x.size(), {-1, -1});
        for (int v = 0; v < s_.n_nodes() && !bent.empty(); ++v) {
            const arcsim::Triangle& t = input_.faces[source_[v].face];
            const auto& b = source_[v].barycentric;
            for (int k = 0; k < 3; ++k) {
                const std::pair<int, int> edge = std::minmax(t[(k + 1) % 3], t[(k + 2) % 3]);
                if (b[k] < 1e-9 && bent.count(edge)) rail_[v] = edge;
                if (b[k] > 1 - 1e-9 && at_crease[t[k]]) fixed_[v] = 1;
            }
        }
    }
    bool is_on_crease(int v) const { return rail_[v].first >= 0; }

    /// Moves v to the surface point nearest to x when no angle around it falls below `floor` (or below what it was).
    bool move(int v, Vector3d x, double floor) {
        const Vector3d old = s_.x[v];
        if (is_on_crease(v)) {
            const Vector3d a = input_.x[rail_[v].first], along = input_.x[rail_[v].second] - a;
            x = a + std::clamp(along.dot(x - a) / along.squaredNorm(), 0.02, 0.98) * along;
        }
        const SurfacePoint p = nearest_point(input_, topology_, source_[v].face, x);
        const double before = least_around(v);
        s_.x[v] = point_at(input_, p);
        if (least_around(v) < std::min(floor, before) || !faces_agree(v)) {
            s_.x[v] = old;
            return false;
        }
        source_[v] = p;
        return true;
    }

    void slide_seams() {
        for (int v = 0; v < s_.n_nodes(); ++v) {
            if (fixed_[v] || borders_[v].size() != 2) continue;
            const Vector3d &a = s_.x[*borders_[v].begin()], &b = s_.x[*borders_[v].rbegin()];
            move(v, 0.5 * s_.x[v] + 0.25 * (a + b), thin);
        }
    }

    bool mend(int f) {
        const arcsim::Triangle t = s_.faces[f];
        int longest = 0, shortest = 0;
        const auto length = [&](int k) { return (s_.x[t[k]] - s_.x[t[(k + 1) % 3]]).squaredNorm(); };
        for (int k = 1; k < 3; ++k) {
            if (length(k) > length(longest)) longest = k;
            if (length(k) < length(shortest)) shortest = k;
        }
        if (flip(t[longest], t[(longest + 1) % 3])) return true;
        for (int k : {shortest, (shortest + 1) % 3, (shortest + 2) % 3}) {
            if (k == longest) continue;
            if (collapse(t[k], t[(k + 1) % 3]) || collapse(t[(k + 1) % 3], t[k])) return true;
        }
        bool moved = false;
        for (int v : t) {
            if (fixed_[v] || !borders_[v].empty()) continue;
            Vector3d mean = Vector3d::Zero();
            for (int g : around_[v]) mean += arcsim::face_centroid(s_, g);
            const double before = least_around(v);
            if (move(v, mean / static_cast<double>(around_[v].size()), thin) && least_around(v) > before) moved = true;
        }
        return moved;
    }

    std::vector<int> faces_at(int a, int b) const {
        std::vector<int> both;
        for (int f : around_[a])
            if (std::count(s_.faces[f].begin(), s_.faces[f].end(), b)) both.push_back(f);
        return both;
    }

    bool flip(int a, int b) {
        if (is_seam(a, b)) return false;
        const auto both = faces_at(a, b);
        if (both.size() != 2) return false;
        arcsim::Triangle s = s_.faces[both[0]], t = s_.faces[both[1]];
        const auto apex = [&](const arcsim::Triangle& u) { return u[0] + u[1] + u[2] - a - b; };
        int c = apex(s), d = apex(t);
        if (normal(s).dot(normal(t)) < folded || !faces_at(c, d).empty()) return false;
        for (int k = 0; k < 3; ++k)
            if (s[k] == b && s[(k + 1) % 3] == a) std::swap(c, d);   // c lies left of a -> b
        const arcsim::Triangle u{c, a, d}, v{d, b, c};
        const double before = std::min(least_angle(s), least_angle(t));
        if (std::min(least_angle(u), least_angle(v)) < 1.05 * before) return false;
        const Vector3d n = normal(s) + normal(t);
        if (normal(u).dot(n) < folded || normal(v).dot(n) < folded) return false;
        set_face(both[0], u);
        set_face(both[1], v);
        return true;
    }

    void set_face(int f, const arcsim::Triangle& t) {
        for (int v : s_.faces[f])
            if (v >= 0) std::erase(around_[v], f);
        s_.faces[f] = t;
        for (int v : t) around_[v].push_back(f);
        relocate(f);
    }
    void relocate(int f) {
        source_face_[f] = nearest_point(input_, topology_, source_face_[f], arcsim::face_centroid(s_, f)).face;
    }

    /// Draws a into b.
    bool collapse(int a, int b) {
        if (fixed_[a] || is_input_node(a) || is_on_crease(a)) return false;
        const bool along_seam = is_seam(a, b);
        if (!borders_[a].empty() && !along_seam) return false;
        const auto both = faces_at(a, b);
        if (both.size() != 2) return false;
        std::set<int> link_a, link_b;
        for (int f : around_[a]) link_a.insert(s_.faces[f].begin(), s_.faces[f].end());
        for (int f : around_[b]) link_b.insert(s_.faces[f].begin(), s_.faces[f].end());
        int common = 0;
        for (int v : link_a) common += v != a && v != b && link_b.count(v);
        if (common != 2) return false;
        int beyond = -1;   // the seam's next node after a
        if (along_seam) {
            for (int v : borders_[a])
                if (v != b) beyond = v;
            if (beyond < 0 || link_b.count(beyond)) return false;
            const Vector3d u = s_.x[a] - s_.x[beyond], v = s_.x[b] - s_.x[a];
            if (u.dot(v) < 0.9 * u.norm() * v.norm()) return false;   // the seam would lose a bend
        }
        const double before = least_around(a);
        double after = std::numbers::pi;
        for (int f : around_[a]) {
            arcsim::Triangle t = s_.faces[f];
            if (std::count(t.begin(), t.end(), b)) continue;
            std::replace(t.begin(), t.end(), a, b);
            after = std::min(after, least_angle(t));
            if (normal(t).dot(normal(s_.faces[f])) < folded) return false;
        }
        if (after < std::min(1.05 * before, thin)) return false;
        if (after < 1.05 * before && after < thin) return false;
        for (int f : both) {
            for (int v : s_.faces[f]) std::erase(around_[v], f);
            s_.faces[f] = {-1, -1, -1};
        }
        const std::vector<int> moved = around_[a];
        for (int f : moved) {
            arcsim::Triangle t = s_.faces[f];
            std::replace(t.begin(), t.end(), a, b);
            set_face(f, t);
        }
        if (along_seam) {
            const bool given = seams_.at(std::minmax(a, beyond));
            seams_.erase(std::minmax(a, b));
            seams_.erase(std::minmax(a, beyond));
            seams_[std::minmax(b, beyond)] = given;
            borders_[b].erase(a);
            borders_[b].insert(beyond);
            borders_[beyond].erase(a);
            borders_[beyond].insert(b);
            borders_[a].clear();
        }
        return true;
    }

    RepairedMesh compact() const {
        RepairedMesh r;
        r.node.assign(s_.x.size(), -1);
        for (int v = 0; v < s_.n_nodes(); ++v)
            if (!around_[v].empty()) {
                r.node[v] = r.surface.n_nodes();
                r.surface.x.push_back(s_.x[v]);
                r.source.push_back(source_[v]);
            }
        for (int f = 0; f < s_.n_faces(); ++f) {
            if (!is_alive(f)) continue;
            const arcsim::Triangle& t = s_.faces[f];
            r.surface.faces.push_back({r.node[t[0]], r.node[t[1]], r.node[t[2]]});
            r.source_face.push_back(source_face_[f]);
        }
        for (const auto& [edge, given] : seams_) {
            r.seams.emplace_back(r.node[edge.first], r.node[edge.second]);
            r.given.push_back(given);
        }
        return r;
    }

    const Surface& input_;
    const Topology& topology_;
    Surface s_;
    std::vector<SurfacePoint> source_;
    std::vector<int> source_face_;
    std::vector<std::vector<int>> around_;      // node -> faces
    std::vector<std::set<int>> borders_;        // node -> other ends of its seam and rim edges
    std::map<std::pair<int, int>, bool> seams_; // edge -> was it asked for
    std::vector<char> fixed_;
    std::vector<std::pair<int, int>> rail_;     // per node: the input's crease edge that it lies on; -1: none
};

}  // namespace

RepairedMesh repair_mesh(const CutMesh& cut, const Surface& input, const Topology& input_topology,
                         const std::vector<int>& fixed) {
    return Repair(cut, input, input_topology, fixed).run();
}

}  // namespace formwork
