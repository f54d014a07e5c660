#include "formwork/panels/sewn_rest.hpp"

namespace formwork {

arcsim::ClothMesh sewn_rest(const PanelSet& set, const Segmentation& s) {
    arcsim::ClothMesh cloth;
    for (const arcsim::Vector3d& x : s.mesh.x) cloth.add_node(x);
    for (const Seam& seam : s.seams)
        if (seam.is_rim())
            for (int node : seam.nodes) cloth.node_label[node] = 1;
    std::vector<Triangle> verts(s.mesh.faces.size());
    for (const FlatPanel& panel : set.panels) {
        const int first = cloth.n_verts();
        cloth.groups.push_back(panel_name(panel.id));
        for (const Vector2d& u : panel.u) cloth.add_vert(u);
        for (std::size_t k = 0; k < panel.face.size(); ++k)
            for (int c = 0; c < 3; ++c) verts[panel.face[k]][c] = first + panel.faces[k][c];
    }
    for (int f = 0; f < s.mesh.n_faces(); ++f) cloth.add_face(s.mesh.faces[f], verts[f], s.panel[f]);
    return cloth;
}

}  // namespace formwork
