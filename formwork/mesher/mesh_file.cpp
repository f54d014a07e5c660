#include "formwork/mesher/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/mesh/obj_io.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::Triangle;
using arcsim::Vector3d;

namespace {

bool has_material_lines(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view line = text.substr(at, 3);
        if (line == "vt " || line == "vt\t" || line == "ms ") return true;
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos) break;
        at = end + 1;
    }
    return false;
}

std::string point(const char* keyword, const double* v, int n) {
    std::string line = keyword;
    for (int k = 0; k < n; ++k) {
        char number[32];
        std::snprintf(number, sizeof number, " %.7f", v[k] + 0.0);
        std::string text = number;
        text.erase(text.find_last_not_of('0') + 1);   // 0.1200000 -> 0.12
        if (text.back() == '.') text.pop_back();
        line += text == " -0" ? " 0" : text;
    }
    return line + "\n";
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending != ".obj" && ending != ".ply" && ending != ".stl")
        throw InputError(file.string() + ": the ending \"" + ending + "\" is not a mesh format that is read. Export as OBJ, PLY or STL.");
    const std::string bytes = arcsim::read_text_file(file);
    if (bytes.starts_with("version https://git-lfs"))
        throw InputError(file.string() + ": is a Git LFS pointer, not the mesh itself. Run: git lfs pull");
    if (ending == ".ply") return {to_cloth_mesh(parse_ply(bytes, file.string())), false};
    if (ending == ".stl") return {to_cloth_mesh(parse_stl(bytes, file.string())), false};
    return {arcsim::parse_obj(bytes, file.string()), has_material_lines(bytes)};
}

ClothMesh to_cloth_mesh(const Surface& s) {
    ClothMesh m;
    for (const Vector3d& p : s.x) {
        m.add_node(p);
        m.add_vert(p.head<2>());
    }
    for (const Triangle& t : s.faces) m.add_face(t, t);
    return m;
}

std::string format_plain_obj(const Surface& s, const std::string& comment) {
    std::string out = comment.empty() ? "" : "# " + comment + "\n";
    for (const Vector3d& p : s.x) out += point("v", p.data(), 3);
    for (const Triangle& t : s.faces)
        out += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
    return out;
}

std::string format_plain_obj(const ClothMesh& m, const std::string& comment) {
    std::string out = comment.empty() ? "" : "# " + comment + "\n";
    for (const auto& u : m.u) out += point("vt", u.data(), 2);
    for (const Vector3d& p : m.x) out += point("v", p.data(), 3);
    int group = -1;
    for (int f = 0; f < m.n_faces(); ++f) {
        if (m.face_group[f] != group && m.face_group[f] >= 0) out += "g " + m.groups[m.face_group[f]] + "\n";
        group = m.face_group[f];
        out += "f";
        for (int k = 0; k < 3; ++k) out += " " + std::to_string(m.face_nodes[f][k] + 1) + "/" + std::to_string(m.face_verts[f][k] + 1);
        out += "\n";
    }
    return out;
}

int weld(ClothMesh& mesh) {
    using Key = std::array<double, 3>;
    const auto key = [&](int node) { return Key{mesh.x[node][0] + 0.0, mesh.x[node][1] + 0.0, mesh.x[node][2] + 0.0}; };

    std::map<std::pair<int, int>, int> uses;   // undirected edge -> faces
    for (const Triangle& t : mesh.face_nodes)
        for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];

    // Edges of single faces, by where their ends lie.
    std::map<std::pair<Key, Key>, std::vector<std::pair<int, int>>> open;
    for (const auto& [edge, n] : uses) {
        if (n != 1) continue;
        auto [a, b] = edge;
        if (key(b) < key(a)) std::swap(a, b);
        open[{key(a), key(b)}].push_back({a, b});
    }
    std::vector<int> root(mesh.n_nodes());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const auto& [place, edges] : open)
        for (std::size_t k = 1; k < edges.size(); ++k) {
            const int a0 = find(edges[0].first), a1 = find(edges[k].first);
            root[std::max(a0, a1)] = std::min(a0, a1);
            const int b0 = find(edges[0].second), b1 = find(edges[k].second);
            root[std::max(b0, b1)] = std::min(b0, b1);
        }

    std::vector<int> number(mesh.n_nodes(), -1);
    ClothMesh welded;   // nodes only; the rest is moved over
    int kept = 0;
    for (int i = 0; i < mesh.n_nodes(); ++i) {
        if (find(i) != i) continue;
        number[i] = kept++;
        welded.x.push_back(mesh.x[i]);
        welded.v.push_back(mesh.v[i]);
        welded.ny.push_back(mesh.ny[i]);
        welded.node_label.push_back(mesh.node_label[i]);
    }
    const int gone = mesh.n_nodes() - kept;
    if (gone == 0) return 0;
    for (Triangle& t : mesh.face_nodes)
        for (int& node : t) node = number[find(node)];
    for (arcsim::EdgeRecord& e : mesh.edges)
        for (int& node : e.node) node = number[find(node)];
    mesh.x = std::move(welded.x);
    mesh.v = std::move(welded.v);
    mesh.ny = std::move(welded.ny);
    mesh.node_label = std::move(welded.node_label);
    return gone;
}

}  // namespace formwork
