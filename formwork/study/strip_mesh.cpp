#include "formwork/study/strip_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "arcsim/base/error.hpp"

namespace formwork {
namespace {

/// Points 0..1, n intervals, the first and last about `end_ratio` of the mean.
std::vector<double> graded(int n, double end_ratio) {
    std::vector<double> t(n + 1);
    for (int i = 0; i <= n; ++i) {
        const double s = static_cast<double>(i) / n;
        t[i] = s - (1 - end_ratio) * std::sin(2 * std::numbers::pi * s) / (2 * std::numbers::pi);
    }
    t[n] = 1;   // exactly: the clamp's nodes are recognised by it
    return t;
}

}  // namespace

StripMesh make_strip(double length, double width, int cells_across) {
    if (!(length > 0) || !(width > 0) || cells_across < 2)
        throw arcsim::InputError("strip: length and width must be positive and the resolution at least 2");
    constexpr double end_ratio = 0.25;
    const int ny = cells_across;
    const int nx = std::max(2, static_cast<int>(std::lround(ny * length / width)));
    const std::vector<double> tx = graded(nx, end_ratio), ty = graded(ny, end_ratio);
    StripMesh s;
    s.length = length;
    s.width = width;
    std::vector<arcsim::Triangle> faces;
    const auto corner = [&](int i, int j) { return i * (ny + 1) + j; };
    for (int i = 0; i <= nx; ++i)
        for (int j = 0; j <= ny; ++j) {
            if (i == 0) s.held.push_back(corner(i, j));
            if (i == nx) s.moving.push_back(corner(i, j));
            s.X.emplace_back(tx[i] * length, (ty[j] - 0.5) * width);
        }
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j) {
            const int a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
            const int m = static_cast<int>(s.X.size());
            s.X.push_back((s.X[a] + s.X[b] + s.X[c] + s.X[d]) / 4);
            faces.insert(faces.end(), {{a, b, m}, {b, c, m}, {c, d, m}, {d, a, m}});
        }
    std::map<std::pair<int, int>, int> midpoint;
    const auto middle = [&](int a, int b) {
        const auto [it, is_new] = midpoint.try_emplace(std::minmax(a, b), static_cast<int>(s.X.size()));
        if (is_new) {
            s.X.push_back(0.5 * (s.X[a] + s.X[b]));
            if (s.X[a][0] == 0 && s.X[b][0] == 0) s.held.push_back(it->second);
            if (s.X[a][0] == length && s.X[b][0] == length) s.moving.push_back(it->second);
        }
        return it->second;
    };
    for (const arcsim::Triangle& t : faces)
        s.elements.push_back({t[0], t[1], t[2], middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])});
    return s;
}

}  // namespace formwork
