#include "formwork/report/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace formwork {
namespace {

/// Light that a surface element sends to the eye, about 0.55 (turned away) to 1.05 (facing the
/// lamp).
double light(const Vector3d& n) {
    static const Vector3d lamp = Vector3d(-0.42, 0.62, 0.66).normalized();
    const double wrapped = 0.5 + 0.5 * n.dot(lamp);
    const double facing = std::max(0.0, n.z());
    return 0.50 + 0.42 * wrapped * wrapped + 0.15 * facing;
}

Rgb shade(const Rgb& c, const Vector3d& n, bool inside) {
    if (!inside) return scaled(c, light(n));
    const double grey = 0.35 * c.r + 0.45 * c.g + 0.2 * c.b;
    return scaled(mix(c, {grey, grey, grey}, 0.35), 0.55 * light(n));
}

std::uint8_t code(double part) {
    return static_cast<std::uint8_t>(255 * std::clamp(part, 0.0, 1.0) + 0.5);
}

}  // namespace

Raster::Raster(int width, int height)
    : width_(width * samples_),
      height_(height * samples_),
      rgb_(3 * static_cast<size_t>(width_) * height_, 0),
      nearness_(static_cast<size_t>(width_) * height_, 0.0f) {}

void Raster::triangle(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c,
                      bool inside) {
    const std::array<const RasterVertex*, 3> v{&a, &b, &c};
    std::array<Rgb, 3> lit;
    for (int k = 0; k < 3; ++k)
        lit[k] = shade(v[k]->colour, inside ? Vector3d(-v[k]->normal) : v[k]->normal, inside);
    fill(v, lit);
}

void Raster::flat_triangle(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) {
    fill({&a, &b, &c}, {a.colour, b.colour, c.colour});
}

void Raster::fill(const std::array<const RasterVertex*, 3>& v, const std::array<Rgb, 3>& lit) {
    const RasterVertex &a = *v[0], &b = *v[1], &c = *v[2];
    const double s = samples_;
    const double ax = a.at.x * s, ay = a.at.y * s, bx = b.at.x * s, by = b.at.y * s,
                 cx = c.at.x * s, cy = c.at.y * s;
    const double area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    if (std::abs(area) < 1e-12 || !std::isfinite(area)) return;
    const int x0 = std::max(0, static_cast<int>(std::floor(std::min({ax, bx, cx}) - 0.5)));
    const int x1 = std::min(width_ - 1, static_cast<int>(std::ceil(std::max({ax, bx, cx}))));
    const int y0 = std::max(0, static_cast<int>(std::floor(std::min({ay, by, cy}) - 0.5)));
    const int y1 = std::min(height_ - 1, static_cast<int>(std::ceil(std::max({ay, by, cy}))));
    constexpr double rim =
        -1e-9;  // neighbours share their edge's samples, so that no gap opens between them
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const double px = x + 0.5, py = y + 0.5;
            const double wa = ((bx - px) * (cy - py) - (cx - px) * (by - py)) / area;
            const double wb = ((cx - px) * (ay - py) - (ax - px) * (cy - py)) / area;
            const double wc = 1 - wa - wb;
            if (wa < rim || wb < rim || wc < rim) continue;
            const size_t i = static_cast<size_t>(y) * width_ + x;
            const double near = wa * a.at.nearness + wb * b.at.nearness + wc * c.at.nearness;
            if (near <= nearness_[i]) continue;
            nearness_[i] = static_cast<float>(near);
            rgb_[3 * i] = code(wa * lit[0].r + wb * lit[1].r + wc * lit[2].r);
            rgb_[3 * i + 1] = code(wa * lit[0].g + wb * lit[1].g + wc * lit[2].g);
            rgb_[3 * i + 2] = code(wa * lit[0].b + wb * lit[1].b + wc * lit[2].b);
        }
    }
}

void Raster::stroke(const Projected& a, const Projected& b, double width_px, const Rgb& colour,
                    double opacity) {
    const double s = samples_, r = 0.5 * width_px * s;
    const double ax = a.x * s, ay = a.y * s, dx = b.x * s - ax, dy = b.y * s - ay,
                 l2 = dx * dx + dy * dy;
    if (!std::isfinite(l2)) return;
    const int x0 = std::max(0, static_cast<int>(std::floor(std::min(ax, ax + dx) - r)));
    const int x1 = std::min(width_ - 1, static_cast<int>(std::ceil(std::max(ax, ax + dx) + r)));
    const int y0 = std::max(0, static_cast<int>(std::floor(std::min(ay, ay + dy) - r)));
    const int y1 = std::min(height_ - 1, static_cast<int>(std::ceil(std::max(ay, ay + dy) + r)));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const double px = x + 0.5 - ax, py = y + 0.5 - ay;
            const double t = l2 > 0 ? std::clamp((px * dx + py * dy) / l2, 0.0, 1.0) : 0;
            if (std::hypot(px - t * dx, py - t * dy) > r) continue;
            const size_t i = static_cast<size_t>(y) * width_ + x;
            if (std::lerp(a.nearness, b.nearness, t) < nearness_[i]) continue;
            const double ink[3] = {colour.r, colour.g, colour.b};
            const bool covered =
                nearness_[i] > 0;  // strokes may stand over the bare background at an outline
            for (int k = 0; k < 3; ++k)
                rgb_[3 * i + k] =
                    code(std::lerp(covered ? rgb_[3 * i + k] / 255.0 : 1.0, ink[k], opacity));
            if (!covered) nearness_[i] = static_cast<float>(1e-30);
        }
}

bool Raster::is_visible(const Projected& p) const {
    const int x = static_cast<int>(p.x * samples_), y = static_cast<int>(p.y * samples_);
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
    return p.nearness >= nearness_[static_cast<size_t>(y) * width_ + x];
}

std::vector<float> Raster::hollows(double radius_px) const {
    // Ambient occlusion in the picture plane: how many places around a pixel lie in front of its
    // tangent plane.
    const int w = width_ / samples_, h = height_ / samples_;
    std::vector<float> depth(static_cast<size_t>(w) * h, 0.0f),
        result(static_cast<size_t>(w) * h, 0.0f);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            depth[static_cast<size_t>(y) * w + x] =
                nearness_[static_cast<size_t>(y * samples_ + samples_ / 2) * width_ + x * samples_ +
                          samples_ / 2];
    float lo = 1e30f, hi = 0;
    for (const float d : depth)
        if (d > 1e-20f) lo = std::min(lo, d), hi = std::max(hi, d);
    if (hi <= lo) return result;
    const double unit = (hi - lo) * 0.06;  // a step this much nearer counts as an occluder in full
    constexpr int n_pairs = 8;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const double d = depth[static_cast<size_t>(y) * w + x];
            if (d <= 1e-20) continue;
            double sum = 0;
            for (int k = 0; k < n_pairs; ++k) {
                const double angle = M_PI * (k + 0.37) / n_pairs;
                const double reach =
                    radius_px * (0.3 + 0.7 * ((k * 5) % n_pairs) / (n_pairs - 1.0));
                const int ox = static_cast<int>(std::lround(reach * std::cos(angle)));
                const int oy = static_cast<int>(std::lround(reach * std::sin(angle)));
                // A pair of opposite places: their mean equals the pixel's own depth on any plane.
                double rise = 0;
                for (const int side : {-1, 1}) {
                    const int qx = x + side * ox, qy = y + side * oy;
                    const double q = qx < 0 || qy < 0 || qx >= w || qy >= h
                                         ? 0
                                         : depth[static_cast<size_t>(qy) * w + qx];
                    rise += q > 1e-20 ? std::clamp((q - d) / unit, -1.5, 1.5) : -1.5;
                }
                sum += std::clamp(rise / 2, 0.0, 1.0);
            }
            result[static_cast<size_t>(y) * w + x] = static_cast<float>(sum / n_pairs);
        }
    return result;
}

void Raster::resolve(Image& image, double ambient_radius_px) const {
    const std::vector<float> hollow =
        ambient_radius_px > 0 ? hollows(ambient_radius_px) : std::vector<float>();
    const int w = std::min(image.width, width_ / samples_),
              h = std::min(image.height, height_ / samples_);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const double dim =
                hollow.empty()
                    ? 1
                    : 1 - 0.55 * hollow[static_cast<size_t>(y) * (width_ / samples_) + x];
            Rgb sum{0, 0, 0};
            const Rgb back = image.at(x, y);
            int n = 0;
            for (int sy = 0; sy < samples_; ++sy)
                for (int sx = 0; sx < samples_; ++sx, ++n) {
                    const size_t i =
                        static_cast<size_t>(y * samples_ + sy) * width_ + x * samples_ + sx;
                    const bool hit = nearness_[i] > 0;
                    sum.r += hit ? rgb_[3 * i] / 255.0 * dim : back.r;
                    sum.g += hit ? rgb_[3 * i + 1] / 255.0 * dim : back.g;
                    sum.b += hit ? rgb_[3 * i + 2] / 255.0 * dim : back.b;
                }
            image.at(x, y) = {sum.r / n, sum.g / n, sum.b / n};
        }
}

}  // namespace formwork
