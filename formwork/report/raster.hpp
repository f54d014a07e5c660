#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formwork/report/camera.hpp"
#include "formwork/report/image.hpp"

namespace formwork {

/// One corner of a triangle on its way to the picture.
struct RasterVertex {
    Projected at;     // px of the final picture
    Vector3d normal;  // unit, right / up / towards the eye
    Rgb colour;
};

/// A z-buffer with several samples per pixel and way. Shading is soft: a bright sky, one lamp over
/// the viewer's left shoulder, and dimmed hollows, so that colours stay close to those of the
/// legend.
class Raster {
public:
    Raster(int width, int height);

    /// @param inside   the triangle shows its back: drawn darker and greyer
    void triangle(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c, bool inside);

    void flat_triangle(const RasterVertex& a, const RasterVertex& b,
                       const RasterVertex& c);  // unshaded

    /// A stroke between two points of the surface. It is hidden where the surface lies in front of
    /// it by more than the bias already contained in the points' nearness.
    void stroke(const Projected& a, const Projected& b, double width_px, const Rgb& colour,
                double opacity);

    bool is_visible(const Projected& p) const;

    /// Averages the samples into the picture, on the picture's own background.
    void resolve(Image& image, double ambient_radius_px) const;

private:
    static constexpr int samples_ = 3;  // per pixel and way
    int width_, height_;                // in samples
    std::vector<std::uint8_t> rgb_;
    std::vector<float> nearness_;  // 0: nothing there
    void fill(const std::array<const RasterVertex*, 3>& v, const std::array<Rgb, 3>& colour);
    std::vector<float> hollows(double radius_px) const;  // per pixel, 0 open .. 1 enclosed
};

}  // namespace formwork
