#include "formwork/panels/sewn_rest.hpp"

namespace formwork {

arcsim::ClothMesh sewn_rest(const PanelSet& set, const Segmentation& s) {
    arcsim::ClothMesh cloth;
    for (const arcsim::Vector3d& x : s.mesh.x) cloth.add_node(x);
    for (const Seam& seam : s.seams)
        if (seam.is_rim())
            for (int node : seam.nodes) cloth.node_label[node] = 1;
    for (const FlatPanel& panel : set.panels) {
        const int first = cloth.n_verts(), group = static_cast<int>(cloth.groups.size());
        cloth.groups.push_back(panel_name(panel.id));
        for (const Vector2d& u : panel.u) cloth.add_vert(u);
        for (const Triangle& t : panel.faces) {
            Triangle nodes, verts;
            for (int k = 0; k < 3; ++k) nodes[k] = panel.node[t[k]], verts[k] = first + t[k];
            cloth.add_face(nodes, verts, group);
        }
    }
    return cloth;
}

}  // namespace formwork
