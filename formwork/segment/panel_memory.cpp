#include "formwork/segment/panel_memory.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "formwork/segment/mixed_bits.hpp"

namespace formwork {

PanelMemory::Key PanelMemory::key_of(const Surface& s) {
    std::vector<std::uint64_t> place;
    place.reserve(s.x.size());
    for (const Vector3d& x : s.x) {
        std::uint64_t h = 0x9E3779B97F4A7C15u;
        for (int k = 0; k < 3; ++k) h = mixed_bits(h + std::bit_cast<std::uint64_t>(x[k]));
        place.push_back(h);
    }
    Key key = s.faces.size();
    for (const arcsim::Triangle& t : s.faces) key += mixed_bits(place[t[0]] + place[t[1]] + place[t[2]]);   // sums: in any order
    return key;
}

bool PanelMemory::is_hopeless(const GroupTrace& g) const {
    constexpr double near = 0.02;   // of the group's size: what mending seams may move
    constexpr double worse = 0.3;   // in panels: a group that has become worse by more is tried again
    return std::any_of(hopeless.begin(), hopeless.end(), [&](const GroupTrace& h) {
        return h.members == g.members && g.spare <= h.spare && g.cost <= h.cost + worse && std::abs(g.area - h.area) < near * h.area &&
               (g.centre - h.centre).squaredNorm() < near * near * h.area;
    });
}

}  // namespace formwork
