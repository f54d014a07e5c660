#include "formwork/panels/notches.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace formwork {

NotchStyle notch_style(int style) {
    constexpr std::array<double, 3> firsts{0.5, 0.35, 0.65};
    return {1 + style % 3, static_cast<NotchShape>(style / 3 % 3), firsts[style / 9 % 3]};
}

namespace {

/// The longest that the seam is on the surface and on either piece, m.
double longest_length(const PanelSet& set, const PanelSeam& seam) {
    double longest = seam.rest_length;
    for (const SeamSide& side : seam.side) {
        const std::vector<Vector2d> chain = flat_chain(set, side);
        double length = 0;
        for (std::size_t k = 0; k + 1 < chain.size(); ++k) length += (chain[k + 1] - chain[k]).norm();
        longest = std::max(longest, length);
    }
    return longest;
}

}  // namespace

void place_notches(PanelSet& set) {
    constexpr double reserve = 1.06;   // stretch that differs along the seam, and what the equality of its sides adds
    std::vector<std::set<int>> taken(set.panels.size());   // styles on each panel
    std::set<int> taken_anywhere;
    for (PanelSeam& seam : set.seams) {
        seam.notch_rest.clear();
        if (seam.is_rim()) continue;
        const std::set<int>& left = taken[seam.side[0].panel];
        const std::set<int>& right = taken[seam.side[1].panel];
        int style = 0, fallback = -1;
        for (; style < n_notch_styles; ++style) {
            const bool free_here = !left.count(style) && !right.count(style);
            if (free_here && fallback < 0) fallback = style;
            if (free_here && !taken_anywhere.count(style)) break;
        }
        if (style == n_notch_styles) style = std::max(fallback, 0);
        seam.style = style;
        taken_anywhere.insert(style);
        for (const SeamSide& side : seam.side) taken[side.panel].insert(style);

        const double first = notch_style(style).first, spacing = set.params.notch_spacing_mm / 1000;
        const int count = std::max(1, static_cast<int>(std::ceil(reserve * longest_length(set, seam) / spacing - first)));
        for (int i = 0; i < count; ++i) seam.notch_rest.push_back((i + first) / (count + first));
    }
}

}  // namespace formwork
