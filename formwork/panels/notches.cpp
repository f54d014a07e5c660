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

/// Lengths along a seam from its start to each of its nodes, m.
struct Ruler {
    std::vector<double> surface{0}, flat{0};   // flat: the mean of both pieces
    std::vector<double> longest{0};            // every edge as long as it is where it is longest
};

Ruler ruler_of(const PanelSet& set, const Segmentation& s, std::size_t seam) {
    const std::vector<int>& nodes = s.seams[seam].nodes;
    const std::array<std::vector<Vector2d>, 2> chain{flat_chain(set, set.seams[seam].side[0]), flat_chain(set, set.seams[seam].side[1])};
    Ruler ruler;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const double surface = (s.mesh.x[nodes[k + 1]] - s.mesh.x[nodes[k]]).norm();
        const double a = (chain[0][k + 1] - chain[0][k]).norm(), b = (chain[1][k + 1] - chain[1][k]).norm();
        ruler.surface.push_back(ruler.surface.back() + surface);
        ruler.flat.push_back(ruler.flat.back() + (a + b) / 2);
        ruler.longest.push_back(ruler.longest.back() + std::max({surface, a, b}));
    }
    return ruler;
}

/// Where `at` on one scale lies on another.
double carried(const std::vector<double>& from, const std::vector<double>& to, double at) {
    const auto next = std::upper_bound(from.begin() + 1, from.end() - 1, at);
    const std::ptrdiff_t k = next - from.begin() - 1;
    return to[k] + (to[k + 1] - to[k]) * (at - from[k]) / (from[k + 1] - from[k]);
}

/// How far the nearest notch is from one of the row read backwards.
double distance_backwards(const std::vector<double>& row, double length) {
    double nearest = length;
    for (double a : row)
        for (double b : row) nearest = std::min(nearest, std::abs(a - (length - b)));
    return nearest;
}

}  // namespace

double NotchStyle::width_mm() const { return offset_from_first(strokes, strokes.size() - 1); }

double stroke_offset_mm(const NotchStyle& style, std::size_t stroke) {
    return offset_from_first(style.strokes, stroke) - style.width_mm() / 2;
}

NotchStyle notch_style(int style) {
    int left = style;
    for (int length = 1, codes = n_shapes;; ++length, codes *= n_shapes)
        for (int code = 0; code < codes; ++code) {
            std::vector<NotchShape> strokes = strokes_of(code, length);
            if (std::lexicographical_compare(strokes.rbegin(), strokes.rend(), strokes.begin(), strokes.end())) continue;
            if (left-- == 0) return {std::move(strokes)};
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

void place_notches(PanelSet& set, const Segmentation& s) {
    constexpr double reserve = 1.03;   // what the equality of its sides may still add to a seam
    std::vector<std::size_t> sewn;
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        set.seams[i].notch_rest.clear();
        if (!set.seams[i].is_rim()) sewn.push_back(i);
    }
    std::stable_sort(sewn.begin(), sewn.end(), [&](std::size_t a, std::size_t b) { return set.seams[a].rest_length < set.seams[b].rest_length; });
    for (std::size_t style = 0; style < sewn.size(); ++style) {
        PanelSeam& seam = set.seams[sewn[style]];
        seam.style = static_cast<int>(style);
        const Ruler ruler = ruler_of(set, s, sewn[style]);
        const double length = ruler.longest.back(), interval = set.params.notch_spacing_mm / 1000 / reserve;
        double farthest = -1;
        for (double first : {0.5, 0.45, 0.55, 0.4, 0.6, 0.35, 0.65}) {
            const int count = std::max(1, static_cast<int>(std::ceil(length / interval - first)));
            std::vector<double> rest, flat;
            for (int i = 0; i < count; ++i) {
                const double at = (i + first) / (count + first) * length;
                rest.push_back(carried(ruler.longest, ruler.surface, at) / ruler.surface.back());
                flat.push_back(carried(ruler.longest, ruler.flat, at));
            }
            const double distance = distance_backwards(flat, ruler.flat.back());
            if (distance > farthest) farthest = distance, seam.notch_rest = std::move(rest);
        }
    }
}

bool notches_too_far_apart(const PanelSet& set) {
    return std::any_of(set.seams.begin(), set.seams.end(), [&](const PanelSeam& seam) {
        double before = 0, widest = 0;
        for (double at : seam.notch) widest = std::max(widest, at - before), before = at;
        return !seam.is_rim() && std::max(widest, 1 - before) * seam.side[0].length > set.params.notch_spacing_mm / 1000;
    });
}

}  // namespace formwork
