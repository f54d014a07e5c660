#include "formwork/load/cast_solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <ostream>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "formwork/load/ear_clipping.hpp"

namespace formwork {

using arcsim::Triangle;

namespace {

using EdgeCount = std::map<std::pair<int, int>, int>;   // directed, smaller node first: forward minus backward

EdgeCount count_edges(const std::vector<Triangle>& faces) {
    EdgeCount count;
    for (const Triangle& t : faces)
        for (int k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            count[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    return count;
}

class Caster {
public:
    Caster(const Surface& bag, const Vector3d& up, double level, int orientation)
        : bag_(bag), up_(up.normalized()), level_(level), orientation_(orientation) {
        double size = 0;
        for (const Vector3d& x : bag.x) size = std::max(size, (x - bag.x[0]).norm());
        on_level_ = 1e-10 * size;
    }

    Surface cast() {
        out_.x = bag_.x;
        for (const Triangle& t : bag_.faces) clip(t);
        if (out_.faces.empty()) throw arcsim::NumericalError("cast: no part of the bag lies below the level");
        wall();
        cap();
        drop_unused();
        return std::move(out_);
    }

private:
    double depth(int node) const { return level_ - out_.x[node].dot(up_); }
    int side(int node) const { return depth(node) > on_level_ ? 1 : depth(node) < -on_level_ ? -1 : 0; }

    /// The node where edge (a, b) meets the level: one per edge, whichever face asks.
    int cut(int a, int b) {
        const auto key = std::minmax(a, b);
        const auto [it, is_new] = cut_.try_emplace({key.first, key.second}, static_cast<int>(out_.x.size()));
        if (is_new) {
            const double qa = depth(key.first), qb = depth(key.second);
            out_.x.push_back(out_.x[key.first] + qa / (qa - qb) * (out_.x[key.second] - out_.x[key.first]));
            out_.x.back() += depth(it->second) * up_;   // onto the plane to the last digit
        }
        return it->second;
    }

    void add_face(int a, int b, int c) { out_.faces.push_back({a, b, c}); }

    void clip(Triangle t) {
        if (orientation_ < 0) std::swap(t[1], t[2]);
        std::vector<int> polygon;
        bool wet = false;
        for (int k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            if (side(a) >= 0) polygon.push_back(a);
            wet = wet || side(a) > 0;
            if (side(a) * side(b) < 0) polygon.push_back(cut(a, b));
        }
        if (!wet) return;
        for (std::size_t k = 2; k < polygon.size(); ++k) add_face(polygon[0], polygon[k - 1], polygon[k]);
    }

    int above(int node) {
        if (depth(node) <= on_level_) return node;
        const auto [it, is_new] = above_.try_emplace(node, static_cast<int>(out_.x.size()));
        if (is_new) out_.x.push_back(out_.x[node] + depth(node) * up_);
        return it->second;
    }

    /// Boundary edges below the level are part of a rim under a head of liquid.
    void wall() {
        for (const auto& [edge, count] : count_edges(out_.faces)) {
            if (count == 0) continue;
            const int a = count > 0 ? edge.second : edge.first, b = count > 0 ? edge.first : edge.second;   // reversed
            const int a_up = above(a), b_up = above(b);
            if (a != a_up) add_face(a, b, a_up);
            if (b != b_up) add_face(b, b_up, a_up);
        }
    }

    void cap() {
        std::map<int, std::vector<int>> next;   // boundary, against the faces' direction
        for (const auto& [edge, count] : count_edges(out_.faces)) {
            for (int k = 0; k < count; ++k) next[edge.second].push_back(edge.first);
            for (int k = 0; k < -count; ++k) next[edge.first].push_back(edge.second);
        }
        std::vector<std::vector<int>> loops;
        while (!next.empty()) {
            std::vector<int> loop;
            int node = next.begin()->first;
            while (next.count(node)) {
                loop.push_back(node);
                auto& ways = next[node];
                const int to = ways.back();
                ways.pop_back();
                if (ways.empty()) next.erase(node);
                node = to;
            }
            loops.push_back(loop);
        }
        const Vector3d e1 = up_.unitOrthogonal(), e2 = up_.cross(e1);
        std::vector<arcsim::Vector2d> flat(out_.x.size());
        for (std::size_t i = 0; i < flat.size(); ++i) flat[i] = {out_.x[i].dot(e1), out_.x[i].dot(e2)};
        for (const Triangle& t : triangulate_loops(loops, flat)) out_.faces.push_back(t);
    }

    void drop_unused() {
        std::vector<int> number(out_.x.size(), -1);
        std::vector<Vector3d> x;
        for (Triangle& t : out_.faces)
            for (int& i : t) {
                if (number[i] < 0) {
                    number[i] = static_cast<int>(x.size());
                    x.push_back(out_.x[i]);
                }
                i = number[i];
            }
        out_.x = std::move(x);
    }

    const Surface& bag_;
    Vector3d up_;
    double level_, on_level_;
    int orientation_;
    Surface out_;
    std::map<std::pair<int, int>, int> cut_;
    std::map<int, int> above_;
};

}  // namespace

Surface cast_solid(const Surface& bag, const Vector3d& up, double level, int orientation) {
    return Caster(bag, up, level, orientation).cast();
}

double enclosed_volume(const Surface& s) {
    const Vector3d origin = s.x.empty() ? Vector3d::Zero() : s.x[0];
    double six_volumes = 0;
    for (const Triangle& t : s.faces)
        six_volumes += (s.x[t[0]] - origin).dot((s.x[t[1]] - origin).cross(s.x[t[2]] - origin));
    return six_volumes / 6;
}

int open_edges(const Surface& s) {
    int n = 0;
    for (const auto& [edge, count] : count_edges(s.faces)) n += count != 0;
    return n;
}

void write_stl(const std::filesystem::path& file, const Surface& s, const std::string& name) {
    arcsim::write_file_atomically(file, [&](std::ostream& out) {
        char header[80] = {};
        std::strncpy(header, name.c_str(), sizeof header - 1);
        out.write(header, sizeof header);
        const auto n = static_cast<std::uint32_t>(s.faces.size());
        out.write(reinterpret_cast<const char*>(&n), 4);
        for (int f = 0; f < s.n_faces(); ++f) {
            const Vector3d N = arcsim::area_vector(s, f);
            const Vector3d normal = N.norm() > 0 ? N.normalized() : Vector3d::Zero();
            float data[12];
            for (int c = 0; c < 3; ++c) data[c] = static_cast<float>(normal[c]);
            for (int k = 0; k < 3; ++k)
                for (int c = 0; c < 3; ++c) data[3 + 3 * k + c] = static_cast<float>(s.x[s.faces[f][k]][c]);
            const std::uint16_t attribute = 0;
            out.write(reinterpret_cast<const char*>(data), sizeof data);
            out.write(reinterpret_cast<const char*>(&attribute), 2);
        }
    });
}

}  // namespace formwork
