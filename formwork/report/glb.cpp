#include "formwork/report/glb.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "arcsim/base/files.hpp"
#include "formwork/report/camera.hpp"

namespace formwork {
namespace {

using nlohmann::json;

// Numbers of the glTF 2.0 specification, 3.6.2 and 3.7.2.
constexpr int type_float = 5126, type_u16 = 5123, type_u32 = 5125, target_vertices = 34962,
              target_indices = 34963;
constexpr int mode_lines = 1, mode_triangles = 4;

/// The binary part and the tables that point into it.
class Buffer {
public:
    template <class T>
    int add(const std::vector<T>& values, int components, int component_type, int target,
            json extra = json::object()) {
        static const char* names[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
        views_.push_back({{"buffer", 0},
                          {"byteOffset", bytes_.size()},
                          {"byteLength", values.size() * sizeof(T)},
                          {"target", target}});
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        json accessor{{"bufferView", views_.size() - 1},
                      {"componentType", component_type},
                      {"count", values.size() / components},
                      {"type", names[components]}};
        accessor.update(extra);
        accessors_.push_back(accessor);
        return static_cast<int>(accessors_.size()) - 1;
    }
    int add_points(const std::vector<Vector3d>& points, bool bounds) {
        std::vector<float> v;
        std::vector<float> lo(3, 3e38f), hi(3, -3e38f);
        for (const Vector3d& p : points)
            for (int k = 0; k < 3; ++k) {
                v.push_back(static_cast<float>(p[k]));
                lo[k] = std::min(lo[k], v.back()), hi[k] = std::max(hi[k], v.back());
            }
        return add(v, 3, type_float, target_vertices,
                   bounds ? json{{"min", lo}, {"max", hi}} : json::object());
    }
    json views_ = json::array(), accessors_ = json::array();
    std::string bytes_;
};

std::uint16_t linear_step(double code) {
    const double c = std::clamp(code, 0.0, 1.0);
    return static_cast<std::uint16_t>(
        std::lround(65535 * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4))));
}

struct Turn {  // rows are glTF's axes
    Vector3d x, y, z;
    explicit Turn(const Vector3d& up) : y(up.normalized()) {
        horizontal_axes(up, x, z);
        z = -z;  // right-handed with y up: x cross y = z
    }
    Vector3d operator()(const Vector3d& p) const { return {p.dot(x), p.dot(y), p.dot(z)}; }
};

json surface_primitive(Buffer& buffer, const Surface& s, const Paint& paint, const Turn& turn) {
    const std::vector<Vector3d> normals = node_normals(s);
    const bool split =
        !paint.colour.empty() && !paint.per_node;  // one colour per face needs corners of its own
    std::vector<Vector3d> points, directions;
    std::vector<std::uint16_t> colours;
    std::vector<std::uint32_t> corners;
    const auto add = [&](int node, const Rgb& c, const Vector3d& n) {
        points.push_back(turn(s.x[node]));
        directions.push_back(turn(n.norm() > 0.5 ? n : Vector3d::UnitZ()));
        for (const double part : {c.r, c.g, c.b, 1.0}) colours.push_back(linear_step(part));
    };
    constexpr Rgb plain{0.8, 0.8, 0.8};
    if (!split)
        for (int i = 0; i < s.n_nodes(); ++i)
            add(i, paint.colour.empty() ? plain : paint.colour[i], normals[i]);
    for (int f = 0; f < s.n_faces(); ++f)
        for (const int node : s.faces[f]) {
            if (split) add(node, paint.colour[f], normals[node]);
            corners.push_back(split ? static_cast<std::uint32_t>(points.size() - 1)
                                    : static_cast<std::uint32_t>(node));
        }
    const int at = buffer.add_points(points, true), n = buffer.add_points(directions, false);
    const int c = buffer.add(colours, 4, type_u16, target_vertices, {{"normalized", true}});
    const int i = buffer.add(corners, 1, type_u32, target_indices);
    return {{"attributes", {{"POSITION", at}, {"NORMAL", n}, {"COLOR_0", c}}},
            {"indices", i},
            {"material", 0},
            {"mode", mode_triangles}};
}

json line_primitive(Buffer& buffer, const std::vector<Line3>& lines, const Turn& turn) {
    std::vector<Vector3d> points;
    std::vector<std::uint16_t> colours;
    for (const Line3& line : lines)
        for (size_t i = 0; i + 1 < line.points.size(); ++i)
            for (const size_t k : {i, i + 1}) {
                points.push_back(turn(line.points[k]));
                for (const double part : {line.colour.r, line.colour.g, line.colour.b, 1.0})
                    colours.push_back(linear_step(part));
            }
    if (points.empty()) return nullptr;
    const int at = buffer.add_points(points, true);
    const int c = buffer.add(colours, 4, type_u16, target_vertices, {{"normalized", true}});
    return {
        {"attributes", {{"POSITION", at}, {"COLOR_0", c}}}, {"material", 1}, {"mode", mode_lines}};
}

void append_u32(std::string& out, std::uint32_t v) {
    out.append(reinterpret_cast<const char*>(&v), 4);
}

void append_chunk(std::string& out, const char* type, std::string bytes, char fill) {
    bytes.resize((bytes.size() + 3) / 4 * 4, fill);
    append_u32(out, static_cast<std::uint32_t>(bytes.size()));
    out.append(type, 4);
    out += bytes;
}

}  // namespace

void write_glb(const std::filesystem::path& path, const Surface& surface, const Paint& paint,
               const std::vector<Line3>& lines, const Vector3d& up, const std::string& name) {
    const size_t expected = paint.per_node ? surface.x.size() : surface.faces.size();
    if (!paint.colour.empty() && paint.colour.size() != expected)
        throw std::invalid_argument("write_glb: colours and surface differ in number");
    Buffer buffer;
    const Turn turn(up);
    json primitives = json::array({surface_primitive(buffer, surface, paint, turn)});
    if (const json p = line_primitive(buffer, lines, turn); !p.is_null()) primitives.push_back(p);
    const json cloth{{"name", "cloth"},
                     {"doubleSided", true},
                     {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.9}}}};
    const json thread{{"name", "seam"},
                      {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};
    json materials = json::array({cloth});
    if (primitives.size() > 1) materials.push_back(thread);
    const json root{
        {"asset", {{"version", "2.0"}, {"generator", std::string("formwork ") + FORMWORK_VERSION}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}, {"name", name}}}},
        {"meshes", {{{"name", name}, {"primitives", primitives}}}},
        {"materials", materials},
        {"accessors", buffer.accessors_},
        {"bufferViews", buffer.views_},
        {"buffers", {{{"byteLength", (buffer.bytes_.size() + 3) / 4 * 4}}}}};
    std::string chunks;
    append_chunk(chunks, "JSON", root.dump(-1, ' ', false, json::error_handler_t::replace), ' ');
    append_chunk(chunks, "BIN\0", buffer.bytes_, '\0');
    std::string file = "glTF";
    append_u32(file, 2);
    append_u32(file, static_cast<std::uint32_t>(12 + chunks.size()));
    arcsim::write_file_atomically(path, file + chunks);
}

}  // namespace formwork
