#include "arcsim/mesh/cloth_mesh.hpp"

namespace arcsim {

int ClothMesh::add_node(const Vector3d& position) {
    x.push_back(position);
    v.push_back(Vector3d::Zero());
    ny.push_back(position);
    node_label.push_back(0);
    return n_nodes() - 1;
}

int ClothMesh::add_vert(const Vector2d& material) {
    u.push_back(material);
    vert_label.push_back(0);
    return n_verts() - 1;
}

void ClothMesh::add_face(const Triangle& nodes, const Triangle& verts, int group) {
    face_nodes.push_back(nodes);
    face_verts.push_back(verts);
    face_label.push_back(0);
    face_plastic.push_back(Matrix2d::Zero());
    face_damage.push_back(0);
    face_group.push_back(group);
}

double ClothMesh::material_area(int f) const {
    const Triangle& t = face_verts[f];
    const Vector2d a = u[t[1]] - u[t[0]], b = u[t[2]] - u[t[0]];
    return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

bool ClothMesh::one_vert_per_node() const {
    std::vector<int> vert_of_node(x.size(), -1), node_of_vert(u.size(), -1);
    for (int f = 0; f < n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int node = face_nodes[f][k], vert = face_verts[f][k];
            if (vert_of_node[node] < 0) vert_of_node[node] = vert;
            if (node_of_vert[vert] < 0) node_of_vert[vert] = node;
            if (vert_of_node[node] != vert || node_of_vert[vert] != node) return false;
        }
    return true;
}

}  // namespace arcsim
