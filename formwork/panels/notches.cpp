#include "formwork/panels/notches.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace formwork {
namespace {

constexpr int n_shapes = 3;
constexpr double slit_spacing = 3, wide_spacing = 5;   // mm: the bar of a T and the mouth of a V are 4 mm wide

/// Row number `code` of `length` strokes, read as digits.
std::vector<NotchShape> strokes_of(int code, int length) {
    std::vector<NotchShape> strokes(length);
    for (int i = length; i-- > 0; code /= n_shapes) strokes[i] = static_cast<NotchShape>(code % n_shapes);
    return strokes;
}

double spacing(NotchShape a, NotchShape b) { return a == NotchShape::slit && b == NotchShape::slit ? slit_spacing : wide_spacing; }

double offset_from_first(const std::vector<NotchShape>& strokes, std::size_t stroke) {
    double at = 0;
    for (std::size_t i = 0; i < stroke; ++i) at += spacing(strokes[i], strokes[i + 1]);
    return at;
}

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

double NotchStyle::width_mm() const { return offset_from_first(strokes, strokes.size() - 1); }

double stroke_offset_mm(const NotchStyle& style, std::size_t stroke) {
    return offset_from_first(style.strokes, stroke) - style.width_mm() / 2;
}

NotchStyle notch_style(int style) {
    constexpr std::array<double, 3> firsts{0.5, 0.35, 0.65};
    int left = style;
    for (int length = 1, codes = n_shapes;; ++length, codes *= n_shapes)
        for (int code = 0; code < codes; ++code) {
            std::vector<NotchShape> strokes = strokes_of(code, length);
            if (std::lexicographical_compare(strokes.rbegin(), strokes.rend(), strokes.begin(), strokes.end())) continue;
            if (left-- == 0) return {std::move(strokes), firsts[style % firsts.size()]};
        }
}

std::string notch_words(const NotchStyle& style) {
    static constexpr std::array<const char*, n_shapes> shapes{"slit", "T", "V"}, counts{"single", "double", "triple"};
    const std::size_t n = style.strokes.size();
    const bool alike = std::equal(style.strokes.begin() + 1, style.strokes.end(), style.strokes.begin());
    if (alike && n <= counts.size()) return std::string(counts[n - 1]) + " " + shapes[static_cast<int>(style.strokes[0])];
    std::string words;
    for (NotchShape shape : style.strokes) words += (words.empty() ? "" : " ") + std::string(shapes[static_cast<int>(shape)]);
    return words;
}

void place_notches(PanelSet& set) {
    constexpr double reserve = 1.06;   // stretch that differs along the seam, and what the equality of its sides adds
    std::vector<std::size_t> sewn;
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        set.seams[i].notch_rest.clear();
        if (!set.seams[i].is_rim()) sewn.push_back(i);
    }
    std::stable_sort(sewn.begin(), sewn.end(), [&](std::size_t a, std::size_t b) { return set.seams[a].rest_length < set.seams[b].rest_length; });
    for (std::size_t style = 0; style < sewn.size(); ++style) {
        PanelSeam& seam = set.seams[sewn[style]];
        seam.style = static_cast<int>(style);
        const double first = notch_style(seam.style).first, interval = set.params.notch_spacing_mm / 1000;
        const int count = std::max(1, static_cast<int>(std::ceil(reserve * longest_length(set, seam) / interval - first)));
        for (int i = 0; i < count; ++i) seam.notch_rest.push_back((i + first) / (count + first));
    }
}

}  // namespace formwork
