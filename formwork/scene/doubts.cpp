#include "formwork/scene/doubts.hpp"

#include <algorithm>

#include "arcsim/base/text.hpp"

namespace formwork {

using arcsim::format_short;

std::string doubt_about_up(const arcsim::Surface& s, const arcsim::Topology& t, const Vector3d& up) {
    const std::vector<BoundaryLoop> loops = boundary_loops(s, t, up);
    if (loops.empty()) return "";
    const BoundaryLoop& mouth = loops.front();   // the longest
    Vector3d area = Vector3d::Zero(), rim = Vector3d::Zero(), middle = Vector3d::Zero();
    for (std::size_t i = 0; i < mouth.nodes.size(); ++i) {
        const Vector3d &a = s.x[mouth.nodes[i]], &b = s.x[mouth.nodes[(i + 1) % mouth.nodes.size()]];
        area += 0.5 * (a - s.x[mouth.nodes[0]]).cross(b - s.x[mouth.nodes[0]]);
        rim += a / static_cast<double>(mouth.nodes.size());
    }
    constexpr double round = 0.02;   // area over length²: a circle has 0.08, a flat spout has no direction to look
    if (area.norm() < round * mouth.length * mouth.length) return "";
    for (const Vector3d& p : s.x) middle += p / static_cast<double>(s.n_nodes());
    if ((rim - middle).dot(area) < 0) area = -area;   // out of the bag
    const Vector3d looks = area.normalized();
    constexpr double sideways = 0.5, along = 0.9;   // cosines
    if (std::abs(looks.dot(up)) > sideways) return "";
    std::string text = "the opening looks sideways, away from \"up\"";
    for (int k = 0; k < 3; ++k)
        if (std::abs(looks[k]) > along)
            text += ": for a mesh whose " + std::string(1, "xyz"[k]) + " points " + (looks[k] > 0 ? "up" : "down") + " set \"up\": \"" +
                    (looks[k] > 0 ? "" : "-") + "xyz"[k] + "\"";
    return text + ".";
}

std::vector<std::string> doubts_about_plaster(const PlasterParams& p, const arcsim::Surface& s, const std::vector<char>& held,
                                              const Vector3d& up) {
    std::vector<std::string> doubts;
    constexpr double lightest = 200;   // kg/m³, foamed plaster
    if (p.density > 0 && p.density < lightest)
        doubts.push_back("/formwork/plaster/density: " + format_short(p.density) + " kg/m³ is very light; plaster has about 1500, concrete 2400" +
                         (p.density < 4 ? " (1.5 g/cm³ is 1500 kg/m³)." : "."));
    if (!p.fill || p.density == 0 || s.x.empty()) return doubts;

    double low = up.dot(s.x[0]), high = low, rim = 0;
    int n_rim = 0;
    for (int i = 0; i < s.n_nodes(); ++i) {
        const double z = up.dot(s.x[i]);
        low = std::min(low, z), high = std::max(high, z);
        if (held[3 * i]) rim += z, ++n_rim;
    }
    std::optional<double> level = p.fill->level;
    const char* key = "level";
    if (p.fill->depth_below_rim && n_rim > 0) level = rim / n_rim - *p.fill->depth_below_rim, key = "depth_below_rim";
    if (!level) return doubts;
    const double height = high - low;
    constexpr double far = 3;   // bag heights: a head that high is a fill in mm
    const auto at = [&](const char* where) {
        doubts.push_back("/formwork/plaster/fill/" + std::string(key) + ": the liquid's surface lies at " + format_short(*level) + " m, " + where +
                         " (" + format_short(low) + " to " + format_short(high) + " m). Heights are in m, along \"up\".");
    };
    if (*level < low) at("below the whole bag: there is nothing to carry");
    else if (height > 0 && *level > high + far * height) at("far above the bag");
    return doubts;
}

}  // namespace formwork
