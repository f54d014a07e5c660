#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/mesher/mesh_file.hpp"

namespace formwork {

using arcsim::InputError;

namespace {

struct Property {
    std::string name, type, count_type;   // count_type: of a list
};
struct Element {
    std::string name;
    long count = 0;
    std::vector<Property> properties;
};

/// Takes words, lines and numbers off the front of a PLY file.
class PlyReader {
public:
    PlyReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    Surface read() {
        header();
        Surface s;
        for (const Element& e : elements_)
            for (long i = 0; i < e.count; ++i) item(e, i, s);
        return s;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(name_ + (binary_ ? ": byte " + std::to_string(at_) : ":" + std::to_string(line_)) + ": " + what);
    }
    std::string_view line() {
        if (at_ >= bytes_.size()) fail("the file ends too early. Export it again.");
        const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
        std::string_view text = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        ++line_;
        if (text.ends_with('\r')) text.remove_suffix(1);
        return text;
    }
    static std::vector<std::string> words(std::string_view text) {
        std::vector<std::string> out;
        for (std::size_t i = 0; i < text.size();) {
            i = std::min(text.find_first_not_of(" \t", i), text.size());
            const std::size_t end = std::min(text.find_first_of(" \t", i), text.size());
            if (end > i) out.emplace_back(text.substr(i, end - i));
            i = end;
        }
        return out;
    }
    void header() {
        if (line() != "ply") fail("is not a PLY file: the first line must be \"ply\".");
        for (;;) {
            const std::vector<std::string> w = words(line());
            if (w.empty() || w[0] == "comment" || w[0] == "obj_info") continue;
            if (w[0] == "end_header") break;
            if (w[0] == "format" && w.size() >= 2) {
                format_ = w[1];
                if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian")
                    fail("the format \"" + format_ + "\" is not known. Export as ascii or binary PLY.");
            } else if (w[0] == "element" && w.size() == 3) {
                long count = -1;
                if (!arcsim::parse_integer(w[2], count) || count < 0 || count > 100'000'000) fail("\"" + w[2] + "\" is not a number of elements.");
                elements_.push_back({w[1], count, {}});
            } else if (w[0] == "property" && !elements_.empty() && w.size() == 3) {
                elements_.back().properties.push_back({w[2], w[1], ""});
            } else if (w[0] == "property" && !elements_.empty() && w.size() == 5 && w[1] == "list") {
                elements_.back().properties.push_back({w[4], w[3], w[2]});
            } else {
                fail("\"" + w[0] + "\" is not understood in a PLY header.");
            }
        }
        binary_ = format_ != "ascii";
    }
    template <class T>
    double raw() {
        if (at_ + sizeof(T) > bytes_.size()) fail("the file ends too early. Export it again.");
        unsigned char b[sizeof(T)];
        std::memcpy(b, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        if ((format_ == "binary_big_endian") == (std::endian::native == std::endian::little)) std::reverse(b, b + sizeof(T));
        T v;
        std::memcpy(&v, b, sizeof(T));
        return static_cast<double>(v);
    }
    double number(const std::string& type) {
        if (!binary_) {
            while (word_ >= line_words_.size()) line_words_ = words(line()), word_ = 0;
            double v = 0;
            if (!arcsim::parse_number(line_words_[word_++], v)) fail("\"" + line_words_[word_ - 1] + "\" is not a number.");
            return v;
        }
        if (type == "float" || type == "float32") return raw<float>();
        if (type == "double" || type == "float64") return raw<double>();
        if (type == "uchar" || type == "uint8") return raw<std::uint8_t>();
        if (type == "char" || type == "int8") return raw<std::int8_t>();
        if (type == "ushort" || type == "uint16") return raw<std::uint16_t>();
        if (type == "short" || type == "int16") return raw<std::int16_t>();
        if (type == "uint" || type == "uint32") return raw<std::uint32_t>();
        if (type == "int" || type == "int32") return raw<std::int32_t>();
        fail("the type \"" + type + "\" is not known.");
    }
    void item(const Element& e, long index, Surface& s) {
        arcsim::Vector3d x = arcsim::Vector3d::Zero();
        for (const Property& p : e.properties) {
            if (p.count_type.empty()) {
                const double v = number(p.type);
                if (p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z') x[p.name[0] - 'x'] = v;
                continue;
            }
            const double n = number(p.count_type);
            if (!(n >= 0 && n <= 10'000)) fail("a list cannot have " + arcsim::format_short(n) + " entries.");
            std::vector<double> list(static_cast<std::size_t>(n));
            for (double& v : list) v = number(p.type);
            if (e.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index")) face(list, index, s);
        }
        if (e.name != "vertex") return;
        if (!x.allFinite()) fail("vertex " + std::to_string(index) + ": a coordinate is not a finite number. Export the mesh again.");
        s.x.push_back(x);
    }
    void face(const std::vector<double>& corners, long index, Surface& s) {
        for (const double c : corners)
            if (!(c >= 0 && c < s.n_nodes()) || c != std::floor(c))
                fail("face " + std::to_string(index) + ": there is no vertex " + arcsim::format_short(c, 10) + " (the file has " +
                     std::to_string(s.n_nodes()) + "). Export the mesh again.");
        if (corners.size() < 3) fail("face " + std::to_string(index) + ": fewer than three corners.");
        for (std::size_t k = 1; k + 1 < corners.size(); ++k)
            s.faces.push_back({static_cast<int>(corners[0]), static_cast<int>(corners[k]), static_cast<int>(corners[k + 1])});
    }

    std::string_view bytes_;
    std::string name_, format_ = "ascii";
    std::size_t at_ = 0;
    int line_ = 0;
    bool binary_ = false;
    std::vector<std::string> line_words_;
    std::size_t word_ = 0;
    std::vector<Element> elements_;
};

}  // namespace

Surface parse_ply(std::string_view bytes, const std::string& name) { return PlyReader(bytes, name).read(); }

}  // namespace formwork
