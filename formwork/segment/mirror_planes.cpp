#include "formwork/segment/mirror_planes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "formwork/segment/nearest_surface.hpp"

namespace formwork {
namespace {

using arcsim::Matrix3d;

/// Centre and second moments of the area; moments about the centre.
struct Moments {
    Vector3d centre = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
    explicit Moments(const Surface& s) {
        double area = 0;
        for (int f = 0; f < s.n_faces(); ++f) {
            const double a = arcsim::face_area(s, f);
            area += a;
            centre += a * arcsim::face_centroid(s, f);
        }
        centre /= area;
        for (int f = 0; f < s.n_faces(); ++f) {   // three edge middles integrate squares exactly
            const double a = arcsim::face_area(s, f) / 3;
            for (int k = 0; k < 3; ++k) {
                const Vector3d m = (s.x[s.faces[f][k]] + s.x[s.faces[f][(k + 1) % 3]]) / 2 - centre;
                second += a * m * m.transpose();
            }
        }
    }
};

/// Normals worth a look: the coordinate axes, the principal axes, and where two or three principal moments
/// are (nearly) equal, directions between their axes.
std::vector<Vector3d> candidate_normals(const Matrix3d& second) {
    constexpr double equal = 0.02;   // relative difference of moments below which axes are not trusted
    std::vector<Vector3d> list{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(second);
    const Vector3d m = eigen.eigenvalues();
    for (int k = 0; k < 3; ++k) list.push_back(eigen.eigenvectors().col(k));
    const bool low = m[1] - m[0] < equal * m[2], high = m[2] - m[1] < equal * m[2];
    if (low && high) {
        constexpr int n = 200;
        for (int i = 0; i < n; ++i) {   // half a sphere, evenly
            const double z = (i + 0.5) / n, turn = i * std::numbers::pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
            list.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
        }
    } else if (low || high) {
        constexpr int n = 60;
        const Vector3d a = eigen.eigenvectors().col(low ? 0 : 1), b = eigen.eigenvectors().col(low ? 1 : 2);
        for (int i = 0; i < n; ++i) {
            const double angle = std::numbers::pi * i / n;
            list.push_back(std::cos(angle) * a + std::sin(angle) * b);
        }
    }
    return list;
}

class Finder {
public:
    Finder(const Surface& s, const Topology& t, const MirrorParams& params)
        : s_(s), near_(s, t), tolerance_(params.tolerance * arcsim::bounding_diagonal(s)) {
        std::vector<int> used;
        for (int v = 0; v < s.n_nodes(); ++v)
            if (!t.node_faces[v].empty()) used.push_back(v);
        const std::size_t stride = std::max<std::size_t>(1, used.size() / 300);
        for (std::size_t i = 0; i < used.size(); i += stride) sample_.push_back(used[i]);
        all_ = std::move(used);
    }

    /// The plane refined by closest points; none when it does not hold.
    std::optional<MirrorPlane> check(MirrorPlane plane) const {
        constexpr int refinements = 6;
        if (mean_error(plane, nullptr, 10 * tolerance_) > 10 * tolerance_) return std::nullopt;
        double error = mean_error(plane, nullptr);
        for (int i = 0; i < refinements && error > 1e-3 * tolerance_; ++i) {
            MirrorPlane next;
            mean_error(plane, &next);
            const double better = mean_error(next, nullptr);
            if (better > 0.99 * error) break;
            plane = next;
            error = better;
        }
        if (error > tolerance_) return std::nullopt;
        double deviation = 0;
        for (int v : all_) {
            deviation = std::max(deviation, near_.point(plane.mirror(s_.x[v])).distance);
            if (deviation > tolerance_) return std::nullopt;
        }
        plane.deviation = deviation;
        int axis = 0;
        plane.normal.cwiseAbs().maxCoeff(&axis);
        if (plane.normal[axis] < 0) plane.normal = -plane.normal;
        return plane;
    }

    void add_mates(MirrorPlane& plane) const {
        plane.mate.assign(s_.x.size(), -1);
        plane.exact = true;
        for (int v : all_) plane.mate[v] = near_.node(plane.mirror(s_.x[v]));
        const double close = 1e-3 * arcsim::mean_edge_length(s_);
        for (int v : all_)
            plane.exact &= plane.mate[plane.mate[v]] == v && (s_.x[plane.mate[v]] - plane.mirror(s_.x[v])).norm() < close;
    }

    double tolerance() const { return tolerance_; }

private:
    /// Mean distance of mirrored sample nodes from the surface. `best`: the plane that fits the pairs of
    /// nodes x and the surface points y nearest to their images: minimises sum |mirror(x) - y|².
    /// @param enough  of the mean: when the sum so far exceeds it already, the rest is not looked at
    double mean_error(const MirrorPlane& plane, MirrorPlane* best, double enough = std::numeric_limits<double>::infinity()) const {
        const double n = static_cast<double>(sample_.size());
        double sum = 0;
        Vector3d mx = Vector3d::Zero(), my = Vector3d::Zero();
        std::vector<Vector3d> hit;
        for (int v : sample_) {
            const auto h = near_.point(plane.mirror(s_.x[v]));
            sum += h.distance;
            if (sum > n * enough) break;
            hit.push_back(h.x);
            mx += s_.x[v];
            my += h.x;
        }
        if (best) {
            Matrix3d m = Matrix3d::Zero();
            for (std::size_t i = 0; i < sample_.size(); ++i) m += (s_.x[sample_[i]] - mx / n) * (hit[i] - my / n).transpose();
            const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen((m + m.transpose()) / 2);
            best->normal = eigen.eigenvectors().col(0);
            best->point = (mx + my) / (2 * n);
        }
        return sum / n;
    }

    const Surface& s_;
    NearestSurface near_;
    double tolerance_;
    std::vector<int> sample_, all_;
};

/// As many planes of the best grade as are asked for, two of them at right angles: on a sphere or a body of revolution
/// nothing better comes.
template <class Grade>
bool is_enough(const std::vector<MirrorPlane>& found, const Grade& grade, int asked) {
    std::vector<Vector3d> best;
    for (const MirrorPlane& p : found)
        if (grade(p) == 0) best.push_back(p.normal);
    if (static_cast<int>(best.size()) < asked) return false;
    return std::any_of(best.begin() + 1, best.end(), [&](const Vector3d& n) { return std::abs(n.dot(best[0])) < 0.02; });
}

}  // namespace

std::vector<MirrorPlane> find_mirror_planes(const Surface& s, const Topology& t, const MirrorParams& params) {
    constexpr double same_plane = 0.999;   // cosine between normals (2.5 degrees)
    const Moments moments(s);
    const Finder finder(s, t, params);
    const auto grade = [&](const MirrorPlane& p) { return static_cast<int>(p.deviation / (0.1 * finder.tolerance())); };
    std::vector<MirrorPlane> found;
    for (const Vector3d& normal : candidate_normals(moments.second)) {
        const auto known = [&](const Vector3d& n) {
            return std::any_of(found.begin(), found.end(), [&](const MirrorPlane& p) { return std::abs(p.normal.dot(n)) > same_plane; });
        };
        if (known(normal)) continue;
        MirrorPlane plane;
        plane.point = moments.centre;
        plane.normal = normal;
        const auto checked = finder.check(std::move(plane));
        if (checked && !known(checked->normal)) found.push_back(*checked);
        if (is_enough(found, grade, params.max_planes)) break;
    }
    // Coordinate axes come first in the list of candidates: a stable sort by grades of deviation keeps them ahead.
    std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return grade(a) < grade(b); });
    std::vector<MirrorPlane> chosen;
    while (!found.empty() && static_cast<int>(chosen.size()) < params.max_planes) {
        // Same grade: the one closest to a right angle with those chosen.
        auto next = found.begin();
        const auto skew = [&](const MirrorPlane& p) {
            double most = 0;
            for (const MirrorPlane& c : chosen) most = std::max(most, std::abs(c.normal.dot(p.normal)));
            return most;
        };
        for (auto it = found.begin(); it != found.end() && grade(*it) == grade(*found.begin()); ++it)
            if (!chosen.empty() && skew(*it) < skew(*next) - 0.02) next = it;
        chosen.push_back(std::move(*next));
        found.erase(next);
        finder.add_mates(chosen.back());
    }
    return chosen;
}

}  // namespace formwork
