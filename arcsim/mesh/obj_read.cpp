#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/obj_io.hpp"

namespace arcsim {
namespace {

/// A word of the file as a message shows it: a broken file may hold words of any length.
std::string shown(std::string_view word) {
    constexpr std::size_t most = 40;
    return word.size() <= most ? std::string(word) : std::string(word.substr(0, most)) + "…";
}

constexpr std::string_view blanks = " \t\r\v\f";

/// The words of one line, and messages that name it.
class Line {
public:
    Line(const std::string& file, int number, std::string_view text)
        : file_(file), number_(number), rest_(text.substr(0, text.find('#'))) {}

    std::string_view word() {
        const auto begin = rest_.find_first_not_of(blanks);
        if (begin == std::string_view::npos) return rest_ = {};
        rest_.remove_prefix(begin);
        const auto end = std::min(rest_.find_first_of(blanks), rest_.size());
        const std::string_view w = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return w;
    }

    /// Everything that is left, without surrounding blanks.
    std::string_view remainder() const {
        const auto begin = rest_.find_first_not_of(blanks);
        if (begin == std::string_view::npos) return {};
        return rest_.substr(begin, rest_.find_last_not_of(blanks) - begin + 1);
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(file_ + ":" + std::to_string(number_) + ": " + what);
    }

    double number(std::string_view keyword) {
        const std::string_view w = word();
        if (w.empty()) fail(std::string(keyword) + ": a number is missing at the end of the line.");
        return number_from(w, keyword);
    }

    int integer(std::string_view keyword) {
        const std::string_view w = word();
        const auto value = integer_from(w);
        if (!value) fail(std::string(keyword) + ": expected an integer, got \"" + shown(w) + "\".");
        return *value;
    }

    template <int N>
    Eigen::Matrix<double, N, 1> vector(std::string_view keyword) {
        Eigen::Matrix<double, N, 1> r;
        for (int i = 0; i < N; ++i) r[i] = number(keyword);
        return r;
    }

    static std::optional<int> integer_from(std::string_view w) {
        int value = 0;
        const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
        if (w.empty() || error != std::errc() || end != w.data() + w.size()) return std::nullopt;
        return value;
    }

private:
    double number_from(std::string_view w, std::string_view keyword) const {
        std::string_view digits = w;
        if (digits.front() == '+') digits.remove_prefix(1);
        double value = 0;
        auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error == std::errc::result_out_of_range) {   // too small is 0, too large is an error
            value = std::strtod(std::string(digits).c_str(), nullptr);
            error = std::errc();
        }
        if (error != std::errc() || end != digits.data() + digits.size())
            fail(std::string(keyword) + ": expected a number, got \"" + shown(w) + "\".");
        if (!std::isfinite(value))
            fail(std::string(keyword) + ": " + shown(w) + " is not a finite number. Repair the program that wrote the mesh.");
        return value;
    }

    const std::string& file_;
    int number_;
    std::string_view rest_;
};

class Reader {
public:
    explicit Reader(const std::string& name) : name_(name) {}

    ClothMesh read(std::string_view text) {
        if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
        int number = 0;
        std::string joined;
        while (!text.empty()) {
            const auto end = text.find('\n');
            std::string_view line = text.substr(0, end);
            text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
            ++number;
            if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
            if (!line.empty() && line.back() == '\\') {   // the line goes on
                joined += std::string(line.substr(0, line.size() - 1)) + " ";
                continue;
            }
            if (joined.empty()) {
                read_line(Line(name_, number, line));
            } else {
                joined += line;
                read_line(Line(name_, number, joined));
                joined.clear();
            }
        }
        return std::move(mesh_);
    }

private:
    void read_line(Line line) {
        const std::string_view k = line.word();
        if (k.empty()) return;
        const char c = k[0];
        if (c == 'v') return read_vertex(k, line);
        if (c == 'n') return read_node_datum(k, line);
        if (c == 'e') return read_edge(k, line);
        if (c == 'f' && k.size() == 1) return read_face(line);
        if (c == 'f' || c == 't') return read_face_datum(k, line);
        if (k == "g" || k == "o") {
            group_name_ = line.remainder();
            group_ = -1;
        }
        if (k == "ms") {
            const Vector3d m = line.vector<3>(k);
            if (m.z() != 0) line.fail("ms: a material point out of the plane z = 0. Only flat material spaces are read.");
            mesh_.add_vert(m.head<2>());
        }
    }

    void read_vertex(std::string_view k, Line& line) {
        if (k == "v") {
            mesh_.add_node(line.vector<3>(k));
            first_vert_.push_back(-1);
        } else if (k == "vt") {
            mesh_.add_vert(line.vector<2>(k));
        } else if (k == "vl") {
            last(mesh_.vert_label, k, "vt", line) = line.integer(k);
        }
    }

    void read_node_datum(std::string_view k, Line& line) {
        if (k == "ny") last(mesh_.ny, k, "v", line) = line.vector<3>(k);
        if (k == "nv") last(mesh_.v, k, "v", line) = line.vector<3>(k);
        if (k == "nl") last(mesh_.node_label, k, "v", line) = line.integer(k);
    }

    void read_edge(std::string_view k, Line& line) {
        if (k == "e") {
            EdgeRecord e{};
            for (int& node : e.node) node = index(line.word(), mesh_.n_nodes(), "node", line);
            mesh_.edges.push_back(e);
        }
        if (k == "ea") last(mesh_.edges, k, "e", line).rest_angle = line.number(k);
        if (k == "ed") last(mesh_.edges, k, "e", line).damage = line.number(k);
        if (k == "el") last(mesh_.edges, k, "e", line).label = line.integer(k);
    }

    void read_face_datum(std::string_view k, Line& line) {
        if (k == "tl" || k == "fl") {
            const int label = line.integer(k);
            last(mesh_.face_label, k, "f", line);
            std::fill(mesh_.face_label.begin() + polygon_start_, mesh_.face_label.end(), label);
        } else if (k == "ts" || k == "fs") {
            const auto s = line.vector<4>(k);
            last(mesh_.face_plastic, k, "f", line);
            const Matrix2d tensor = (Matrix2d() << s[0], s[1], s[2], s[3]).finished();
            std::fill(mesh_.face_plastic.begin() + polygon_start_, mesh_.face_plastic.end(), tensor);
        } else if (k == "td" || k == "fd") {
            const double damage = line.number(k);
            last(mesh_.face_damage, k, "f", line);
            std::fill(mesh_.face_damage.begin() + polygon_start_, mesh_.face_damage.end(), damage);
        }
    }

    struct Corner {
        int node, vert;   // vert -1: not given
    };

    void read_face(Line& line) {
        std::vector<Corner> corners;
        for (std::string_view w = line.word(); !w.empty(); w = line.word()) corners.push_back(corner(w, line));
        if (corners.size() < 3)
            line.fail("f: a face needs at least 3 corners, got " + std::to_string(corners.size()) + ".");
        for (Corner& c : corners) {
            int& first = first_vert_[c.node];
            if (c.vert < 0) c.vert = first >= 0 ? first : mesh_.add_vert(mesh_.x[c.node].head<2>());
            if (first < 0) first = c.vert;
        }
        polygon_start_ = mesh_.n_faces();
        const size_t start = best_fan(corners), n = corners.size();
        for (size_t i = 1; i + 1 < n; ++i) {
            const Corner &a = corners[start], &b = corners[(start + i) % n], &c = corners[(start + i + 1) % n];
            mesh_.add_face({a.node, b.node, c.node}, {a.vert, b.vert, c.vert}, group());
        }
    }

    Corner corner(std::string_view w, Line& line) const {
        const auto slash = w.find('/');
        Corner c{index(w.substr(0, slash), mesh_.n_nodes(), "node", line), -1};
        if (slash == std::string_view::npos) return c;
        std::string_view vert = w.substr(slash + 1);
        vert = vert.substr(0, vert.find('/'));   // a third index is a normal: not ours
        if (!vert.empty()) c.vert = index(vert, mesh_.n_verts(), "vert", line);
        return c;
    }

    /// Where to start the fan of a polygon: the corner with the largest smallest angle.
    size_t best_fan(const std::vector<Corner>& corners) const {
        const size_t n = corners.size();
        if (n == 3) return 0;
        size_t best = 0;
        double best_angle = -1;
        for (size_t start = 0; start < n; ++start) {
            double angle = 4;
            for (size_t i = 1; i + 1 < n; ++i)
                angle = std::min(angle, min_angle(mesh_.x[corners[start].node], mesh_.x[corners[(start + i) % n].node],
                                                  mesh_.x[corners[(start + i + 1) % n].node]));
            if (angle > best_angle) best = start, best_angle = angle;
        }
        return best;
    }

    static int index(std::string_view w, int count, const char* what, Line& line) {
        const auto value = Line::integer_from(w);
        if (!value) line.fail(std::string("expected the index of a ") + what + ", got \"" + shown(w) + "\".");
        const int i = *value < 0 ? count + *value : *value - 1;
        if (*value == 0 || i < 0 || i >= count)
            line.fail(std::string(what) + " " + std::to_string(*value) + " does not exist: " +
                      (count == 0 ? std::string("none is") : "1 to " + std::to_string(count) + " are") +
                      " defined above this line.");
        return i;
    }

    template <class T>
    static T& last(std::vector<T>& list, std::string_view keyword, const char* owner, Line& line) {
        if (list.empty())
            line.fail(std::string(keyword) + ": belongs to the \"" + owner + "\" line before it, and there is none.");
        return list.back();
    }

    int group() {
        if (group_ < 0 && !group_name_.empty()) {
            const auto [entry, is_new] = group_index_.try_emplace(group_name_, static_cast<int>(mesh_.groups.size()));
            if (is_new) mesh_.groups.push_back(group_name_);
            group_ = entry->second;
        }
        return group_;
    }

    const std::string& name_;
    ClothMesh mesh_;
    std::vector<int> first_vert_;   // per node, -1: none yet
    int polygon_start_ = 0;         // first triangle of the last f line
    std::string group_name_;
    std::unordered_map<std::string, int> group_index_;
    int group_ = -1;
};

}  // namespace

ClothMesh parse_obj(std::string_view text, const std::string& name) { return Reader(name).read(text); }

ClothMesh read_obj(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file))
        throw InputError(file.string() + ": cannot be opened. Check the name; it is looked up beside the scene file, then in the working directory.");
    std::ostringstream text;
    text << in.rdbuf();
    return parse_obj(std::move(text).str(), file.string());
}

}  // namespace arcsim
