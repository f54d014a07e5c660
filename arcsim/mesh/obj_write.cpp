#include <charconv>

#include "arcsim/base/files.hpp"
#include "arcsim/mesh/obj_io.hpp"

namespace arcsim {
namespace {

class Text {
public:
    Text& key(const char* k) {
        text_ += k;
        return *this;
    }
    template <class Number>
    Text& operator<<(Number value) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        text_ += ' ';
        text_.append(digits, end);
        return *this;
    }
    template <class V>
    Text& numbers(const V& v) {
        for (int i = 0; i < v.size(); ++i) *this << double(v[i]);
        return *this;
    }
    Text& corner(int node, int vert) {
        *this << node + 1;
        text_ += '/';
        char digits[16];
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, vert + 1).ptr);
        return *this;
    }
    void end() { text_ += '\n'; }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

void write_verts(Text& t, const ClothMesh& m) {
    for (int i = 0; i < m.n_verts(); ++i) {
        t.key("vt").numbers(m.u[i]).end();
        if (m.vert_label[i] != 0) (t.key("vl") << m.vert_label[i]).end();
    }
}

void write_nodes(Text& t, const ClothMesh& m) {
    for (int i = 0; i < m.n_nodes(); ++i) {
        t.key("v").numbers(m.x[i]).end();
        if (m.ny[i] != m.x[i]) t.key("ny").numbers(m.ny[i]).end();
        if (m.v[i] != Vector3d::Zero()) t.key("nv").numbers(m.v[i]).end();
        if (m.node_label[i] != 0) (t.key("nl") << m.node_label[i]).end();
    }
}

void write_edges(Text& t, const ClothMesh& m) {
    for (const EdgeRecord& e : m.edges) {
        if (e.rest_angle == 0 && e.label == 0 && e.damage == 0) continue;
        (t.key("e") << e.node[0] + 1 << e.node[1] + 1).end();
        if (e.rest_angle != 0) (t.key("ea") << e.rest_angle).end();
        if (e.damage != 0) (t.key("ed") << e.damage).end();
        if (e.label != 0) (t.key("el") << e.label).end();
    }
}

void write_faces(Text& t, const ClothMesh& m) {
    int group = -1;
    for (int f = 0; f < m.n_faces(); ++f) {
        if (m.face_group[f] != group) {
            group = m.face_group[f];
            t.key("g ").key(group < 0 ? "default" : m.groups[group].c_str()).end();
        }
        t.key("f");
        for (int k = 0; k < 3; ++k) t.corner(m.face_nodes[f][k], m.face_verts[f][k]);
        t.end();
        if (m.face_label[f] != 0) (t.key("tl") << m.face_label[f]).end();
        const Matrix2d& s = m.face_plastic[f];
        if (s != Matrix2d::Zero()) (t.key("ts") << s(0, 0) << s(0, 1) << s(1, 0) << s(1, 1)).end();
        if (m.face_damage[f] != 0) (t.key("td") << m.face_damage[f]).end();
    }
}

}  // namespace

std::string format_obj(const ClothMesh& mesh) {
    Text t;
    write_verts(t, mesh);
    write_nodes(t, mesh);
    write_edges(t, mesh);
    write_faces(t, mesh);
    return t.take();
}

void write_obj(const std::filesystem::path& file, const ClothMesh& mesh) {
    write_file_atomically(file, format_obj(mesh));
}

}  // namespace arcsim
