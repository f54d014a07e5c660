#include <cmath>
#include <cstring>
#include <map>

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "formwork/mesher/mesh_file.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::Vector3d;

namespace {

/// Collects triangles, one node per place.
class Soup {
public:
    explicit Soup(const std::string& name) : name_(name) {}
    void corner(double x, double y, double z, const std::string& where) {
        if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
            throw InputError(name_ + where + ": a coordinate is not a finite number. Export the mesh again.");
        const auto [at, fresh] = node_.try_emplace({x + 0.0, y + 0.0, z + 0.0}, s_.n_nodes());
        if (fresh) s_.x.push_back({x, y, z});
        t_[k_++] = at->second;
        if (k_ < 3) return;
        k_ = 0;
        if (t_[0] != t_[1] && t_[1] != t_[2] && t_[2] != t_[0]) s_.faces.push_back(t_);   // STL files hold needles of no width
    }
    bool complete() const { return k_ == 0; }
    Surface take() { return std::move(s_); }

private:
    std::string name_;
    Surface s_;
    std::map<std::array<double, 3>, int> node_;
    arcsim::Triangle t_{};
    int k_ = 0;
};

Surface parse_binary(std::string_view bytes, const std::string& name) {
    constexpr std::size_t header = 84, record = 50;
    std::uint32_t n = 0;
    std::memcpy(&n, bytes.data() + 80, 4);
    if (bytes.size() != header + record * static_cast<std::size_t>(n))
        throw InputError(name + ": is cut short or not STL: " + std::to_string(n) + " triangles need " +
                         std::to_string(header + record * static_cast<std::size_t>(n)) + " bytes, the file has " +
                         std::to_string(bytes.size()) + ". Export it again.");
    Soup soup(name);
    for (std::uint32_t i = 0; i < n; ++i) {
        float v[9];
        std::memcpy(v, bytes.data() + header + record * i + 12, sizeof v);
        for (int k = 0; k < 3; ++k) soup.corner(v[3 * k], v[3 * k + 1], v[3 * k + 2], ": triangle " + std::to_string(i + 1));
    }
    return soup.take();
}

}  // namespace

Surface parse_stl(std::string_view bytes, const std::string& name) {
    // A binary header may begin with "solid" too; its length tells.
    if (bytes.size() >= 84) {
        std::uint32_t n = 0;
        std::memcpy(&n, bytes.data() + 80, 4);
        if (bytes.size() == 84 + 50 * static_cast<std::size_t>(n)) return parse_binary(bytes, name);
    }
    if (!bytes.starts_with("solid")) {
        if (bytes.size() < 84) throw InputError(name + ": is too short for an STL file. Export it again.");
        return parse_binary(bytes, name);
    }
    Soup soup(name);
    int line_number = 0;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
        std::string_view line = bytes.substr(at, end - at);
        at = end + 1;
        ++line_number;
        const std::size_t word = line.find_first_not_of(" \t\r");
        if (word == std::string_view::npos || line.substr(word, 6) != "vertex") continue;
        line.remove_prefix(word + 6);
        double v[3];
        for (double& number : v) {
            const std::size_t first = std::min(line.find_first_not_of(" \t\r"), line.size());
            const std::size_t last = std::min(line.find_first_of(" \t\r", first), line.size());
            if (!arcsim::parse_number(line.substr(first, last - first), number))
                throw InputError(name + ":" + std::to_string(line_number) + ": expected three numbers after \"vertex\". Export the mesh again.");
            line.remove_prefix(last);
        }
        soup.corner(v[0], v[1], v[2], ":" + std::to_string(line_number));
    }
    if (!soup.complete()) throw InputError(name + ": ends within a triangle. Export it again.");
    return soup.take();
}

}  // namespace formwork
