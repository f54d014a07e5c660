#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formwork/report/colour.hpp"

namespace formwork {

/// A picture in memory, rows from the top, white where nothing is drawn.
struct Image {
    int width = 0, height = 0;
    std::vector<Rgb> pixel;

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixel(static_cast<size_t>(w) * h, Rgb{1, 1, 1}) {}
    Rgb& at(int x, int y) { return pixel[static_cast<size_t>(y) * width + x]; }
    const Rgb& at(int x, int y) const { return pixel[static_cast<size_t>(y) * width + x]; }
    /// Lays `c` over a pixel with opacity `alpha`; places outside the picture are ignored.
    void blend(int x, int y, const Rgb& c, double alpha);
};

/// The bytes of a PNG file (8 bit RGB). @throws std::runtime_error when libpng fails
std::string encode_png(const Image& image);

/// @throws arcsim::InputError when the place cannot be written; an earlier file survives
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace formwork
