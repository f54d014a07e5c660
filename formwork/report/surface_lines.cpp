#include "formwork/report/surface_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <random>

#include "formwork/panels/panel_set.hpp"

namespace formwork {
namespace {

using Cell = std::array<int, 3>;

Cell cell_of(const Vector3d& p, double size) {
    return {static_cast<int>(std::floor(p.x() / size)), static_cast<int>(std::floor(p.y() / size)),
            static_cast<int>(std::floor(p.z() / size))};
}

}  // namespace

std::vector<int> spread_faces(const Surface& s, double spacing) {
    std::map<Cell, std::vector<int>> grid;
    std::vector<int> chosen;
    // In shuffled order, since the faces' own often runs in rows; the seed is fixed so that
    // pictures repeat.
    std::vector<int> order(s.faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::mt19937 random(1);
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    for (const int f : order) {
        const Vector3d c = arcsim::face_centroid(s, f);
        const Cell here = cell_of(c, spacing);
        bool free = true;
        for (int k = 0; k < 27 && free; ++k) {
            const auto it =
                grid.find({here[0] + k % 3 - 1, here[1] + k / 3 % 3 - 1, here[2] + k / 9 - 1});
            if (it == grid.end()) continue;
            for (const int g : it->second)
                free = free && (arcsim::face_centroid(s, g) - c).norm() >= spacing;
        }
        if (!free) continue;
        chosen.push_back(f);
        grid[here].push_back(f);
    }
    return chosen;
}

std::vector<Line3> cross_lines(const Surface& s, const std::vector<double>& theta, int count) {
    // Throwing places at random until none fits fills about 0.7 places per square of the spacing.
    const double spacing = std::sqrt(0.7 * arcsim::total_area(s) / std::max(count, 1));
    std::vector<Line3> lines;
    for (const int f : spread_faces(s, spacing)) {
        const arcsim::FaceFrame frame = arcsim::face_frame(s, f);
        const Vector3d c = arcsim::face_centroid(s, f);
        for (int arm = 0; arm < 2; ++arm) {
            const Vector3d d = 0.46 * spacing * frame.direction(theta[f] + arm * M_PI / 2);
            lines.push_back({{c - d, c + d}, {0.08, 0.1, 0.16}, 1.9, 0.95, frame.n});
        }
    }
    return lines;
}

std::vector<Mark3> singularity_marks(const Surface& s,
                                     const std::vector<Singularity>& singularities) {
    std::vector<Mark3> marks;
    for (const Singularity& g : singularities) {
        const Rgb colour = g.index4 > 0 ? Rgb{0.80, 0.27, 0.02} : Rgb{0.05, 0.33, 0.70};
        marks.push_back({s.x[g.node], std::to_string(g.valence()), colour, 14});
    }
    return marks;
}

std::string singularity_note(const std::vector<Singularity>& singularities) {
    if (singularities.empty()) return {};
    std::map<int, int> count;
    for (const Singularity& g : singularities) ++count[g.valence()];
    std::string note;
    for (const auto& [valence, n] : count)
        note += (note.empty() ? "" : ", ") + std::to_string(n) + " of valence " +
                std::to_string(valence);
    return "singularities: " + note;
}

std::vector<Line3> seam_lines(const Segmentation& segmentation, const Surface& shown) {
    std::vector<Line3> lines;
    for (const Seam& seam : segmentation.seams) {
        Line3 line;
        line.width_px = seam.is_rim() ? 2.5 : 3.4;
        line.colour = seam.is_rim() ? Rgb{0.45, 0.47, 0.5} : Rgb{0.07, 0.08, 0.1};
        for (const int i : seam.nodes) line.points.push_back(shown.x[i]);
        lines.push_back(std::move(line));
    }
    return lines;
}

std::vector<double> distance_from_seams(const Segmentation& segmentation, const Surface& shown) {
    std::vector<std::vector<int>> around(shown.x.size());
    std::vector<double> distance(shown.x.size(), 1e300);
    for (const arcsim::Triangle& t : shown.faces)
        for (int k = 0; k < 3; ++k)
            around[t[k]].push_back(t[(k + 1) % 3]), around[t[(k + 1) % 3]].push_back(t[k]);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;  // Dijkstra
    for (const Seam& seam : segmentation.seams)
        for (const int i : seam.nodes) queue.push({distance[i] = 0, i});
    while (!queue.empty()) {
        const auto [d, i] = queue.top();
        queue.pop();
        if (d > distance[i]) continue;
        for (const int j : around[i]) {
            const double next = d + (shown.x[i] - shown.x[j]).norm();
            if (next < distance[j]) queue.push({distance[j] = next, j});
        }
    }
    return distance;
}

std::vector<int> panel_label_faces(const Segmentation& segmentation, const Surface& shown) {
    const std::vector<double> distance = distance_from_seams(segmentation, shown);
    std::vector<Vector3d> middle(segmentation.n_panels, Vector3d::Zero());
    std::vector<double> area(segmentation.n_panels, 0.0);
    for (int f = 0; f < shown.n_faces(); ++f) {
        const double a = arcsim::face_area(shown, f);
        middle[segmentation.panel[f]] += a * arcsim::face_centroid(shown, f);
        area[segmentation.panel[f]] += a;
    }
    std::vector<int> best(segmentation.n_panels, -1);
    const auto depth =
        [&](int f) {  // in a strip many places are equally deep: then the one in the middle
            const arcsim::Triangle& t = shown.faces[f];
            const int p = segmentation.panel[f];
            return (distance[t[0]] + distance[t[1]] + distance[t[2]]) / 3 -
                   0.2 * (arcsim::face_centroid(shown, f) - middle[p] / area[p]).norm();
        };
    for (int f = 0; f < shown.n_faces(); ++f) {
        int& b = best[segmentation.panel[f]];
        if (b < 0 || depth(f) > depth(b)) b = f;
    }
    return best;
}

std::vector<Mark3> panel_name_marks(const Segmentation& segmentation, const Surface& shown) {
    const std::vector<double> distance = distance_from_seams(segmentation, shown);
    std::vector<int> places = panel_label_faces(segmentation, shown);
    for (const int f : spread_faces(shown, std::sqrt(arcsim::total_area(shown) / 600)))
        places.push_back(f);
    std::vector<Mark3> marks;
    for (const int f : places) {
        if (f < 0) continue;
        const arcsim::Triangle& t = shown.faces[f];
        const int p = segmentation.panel[f];
        Mark3 m{arcsim::face_centroid(shown, f), panel_name(p), {0.07, 0.08, 0.1}, 0};
        m.normal = arcsim::face_normal(shown, f);
        m.group = p;
        m.weight = (distance[t[0]] + distance[t[1]] + distance[t[2]]) / 3;
        marks.push_back(m);
    }
    return marks;
}

}  // namespace formwork
