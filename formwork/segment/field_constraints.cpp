#include "formwork/segment/field_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <sstream>

#include "arcsim/base/error.hpp"
#include "formwork/segment/angle_transport.hpp"
#include "formwork/segment/degree.hpp"
#include "formwork/segment/nearest_surface.hpp"

namespace formwork {
namespace {

/// Directions asked of each face, modulo a quarter turn.
struct Wishes {
    std::vector<std::complex<double>> sum;
    std::vector<double> total;
    explicit Wishes(int n) : sum(n, 0.0), total(n, 0.0) {}
    void add(int f, double theta, double weight) {
        sum[f] += std::polar(weight, 4 * theta);
        total[f] += weight;
    }
};

void add_stroke(const Surface& s, const NearestSurface& near, const Stroke& stroke, int number, Wishes& wishes) {
    const double step = arcsim::mean_edge_length(s) / 4, far = 0.05 * arcsim::bounding_diagonal(s);
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
        const arcsim::Vector3d d = stroke[i + 1] - stroke[i];
        const int n = std::max(1, static_cast<int>(std::ceil(d.norm() / step)));
        for (int k = 0; k < n; ++k) {
            const auto hit = near.point(stroke[i] + (k + 0.5) / n * d);
            if (!(hit.distance < far))
                throw arcsim::InputError("stroke " + std::to_string(number) + ": its piece " + std::to_string(i) + " is " +
                                         std::to_string(hit.distance) + " m away from the surface. Draw strokes on the surface, in its units.");
            const auto frame = arcsim::face_frame(s, hit.face);
            const double along = frame.local(d).norm();
            if (along > 0.5 * d.norm()) wishes.add(hit.face, frame.angle(d), along / n);   // else it pierces the surface
        }
    }
}

}  // namespace

std::vector<HardDirection> hard_directions(const Surface& s, const Topology& t, const ConstraintParams& params,
                                           const std::vector<Stroke>& strokes) {
    Wishes wishes(s.n_faces());
    const double crease = params.crease_angle_deg * degree;
    for (const arcsim::Edge& e : t.edges) {
        const bool follow = e.is_boundary() ? params.align_rims : crease > 0 && arcsim::bend_angle(s, e) > crease;
        for (int side = 0; follow && side < 2; ++side)
            if (e.face[side] >= 0)
                wishes.add(e.face[side], edge_angle(s, e.face[side], e.corner[side]), (s.x[e.node[0]] - s.x[e.node[1]]).norm());
    }
    if (!strokes.empty()) {
        const NearestSurface near(s, t);
        for (std::size_t i = 0; i < strokes.size(); ++i) add_stroke(s, near, strokes[i], static_cast<int>(i), wishes);
    }
    const double agree = std::cos(4 * 10 * degree);   // two wishes 20 degrees apart
    std::vector<HardDirection> hard;
    for (int f = 0; f < s.n_faces(); ++f)
        if (wishes.total[f] > 0 && std::abs(wishes.sum[f]) >= agree * wishes.total[f])
            hard.push_back({f, std::arg(wishes.sum[f]) / 4});
    return hard;
}

std::vector<Stroke> read_strokes(const std::string& path) {
    std::ifstream in(path);
    if (!in) throw arcsim::InputError(path + ": cannot be read. Give an OBJ file of polylines.");
    std::vector<arcsim::Vector3d> points;
    std::vector<Stroke> strokes;
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        const std::string where = path + ":" + std::to_string(number) + ": ";
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            arcsim::Vector3d x;
            if (!(words >> x[0] >> x[1] >> x[2]) || !x.allFinite())
                throw arcsim::InputError(where + "expected three coordinates: v x y z.");
            points.push_back(x);
        } else if (kind == "l") {
            Stroke stroke;
            for (std::string word; words >> word;) {
                char* end = nullptr;
                long index = std::strtol(word.c_str(), &end, 10);   // "7/3": the node comes first
                if (index < 0) index += static_cast<long>(points.size()) + 1;
                if (end == word.c_str() || index < 1 || index > static_cast<long>(points.size()))
                    throw arcsim::InputError(where + "\"" + word + "\" is not the number of a point above this line.");
                stroke.push_back(points[index - 1]);
            }
            if (stroke.size() < 2) throw arcsim::InputError(where + "a polyline needs two points or more.");
            strokes.push_back(std::move(stroke));
        }
    }
    if (strokes.empty()) throw arcsim::InputError(path + ": holds no polyline. Each one is a line: l 1 2 3 ...");
    return strokes;
}

}  // namespace formwork
