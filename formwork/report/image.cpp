#include "formwork/report/image.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "arcsim/base/files.hpp"

namespace formwork {
namespace {

void append_bytes(png_structp png, png_bytep data, png_size_t n) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), n);
}
void nothing_to_flush(png_structp) {}
void raise_error(png_structp, png_const_charp message) {
    throw std::runtime_error(std::string("libpng: ") + message);
}

}  // namespace

void Image::blend(int x, int y, const Rgb& c, double alpha) {
    if (x < 0 || y < 0 || x >= width || y >= height || alpha <= 0) return;
    at(x, y) = mix(at(x, y), c, std::min(alpha, 1.0));
}

std::string encode_png(const Image& image) {
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, raise_error, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (!info) throw std::runtime_error("libpng: no memory for a picture");
    try {
        png_set_write_fn(png, &bytes, append_bytes, nothing_to_flush);
        png_set_compression_level(png, 7);
        png_set_IHDR(png, info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_write_info(png, info);
        std::vector<png_byte> row(3 * static_cast<size_t>(image.width));
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const Rgb& c = image.at(x, y);
                const double part[3] = {c.r, c.g, c.b};
                for (int k = 0; k < 3; ++k)
                    row[3 * x + k] =
                        static_cast<png_byte>(std::lround(255 * std::clamp(part[k], 0.0, 1.0)));
            }
            png_write_row(png, row.data());
        }
        png_write_end(png, info);
    } catch (...) {
        png_destroy_write_struct(&png, &info);
        throw;
    }
    png_destroy_write_struct(&png, &info);
    return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
    arcsim::write_file_atomically(path, encode_png(image));
}

}  // namespace formwork
