// A panel as a surface of its own. Who is next to whom is known from the cut mesh: nothing has to be searched for.

#include <utility>

#include "formwork/segment/panel_patch.hpp"

namespace formwork {
namespace {

/// Builds the patch and its topology; local faces are numbered as they are given, nodes and edges as faces first name them.
class Extraction {
public:
    Extraction(const CutMesh& cut, const std::vector<int>& faces) : cut_(cut), s_(cut.surface()), local_(s_.faces.size(), -1) {
        p_.face = faces;
        for (std::size_t i = 0; i < faces.size(); ++i) local_[faces[i]] = static_cast<int>(i);
        number_nodes();
        number_edges();
        arcsim::find_components_and_loops(p_.surface, p_.topology);
        find_junctions();
    }
    PanelPatch take() { return std::move(p_); }

private:
    /// The local face across an edge that is no border; -1: a border of the patch.
    int inner_neighbour(int f, int k) const {
        const int g = cut_.across(f, k);
        return g < 0 || cut_.is_seam_at(f, k) ? -1 : local_[g];
    }

    /// One node for every fan of faces that hang together about a node of the cut mesh.
    void number_nodes() {
        p_.surface.faces.assign(p_.face.size(), {-1, -1, -1});
        for (std::size_t i = 0; i < p_.face.size(); ++i)
            for (int k = 0; k < 3; ++k)
                if (p_.surface.faces[i][k] < 0) add_node(static_cast<int>(i), k);
    }

    void add_node(int i, int k) {
        const int v = s_.faces[p_.face[i]][k], id = p_.surface.n_nodes();
        p_.node.push_back(v);
        p_.surface.x.push_back(s_.x[v]);
        int start = i;   // clockwise to the border, if there is one
        bool open = false;
        for (int at = i, c = k;;) {
            const int next = inner_neighbour(p_.face[at], c);
            if (next < 0) {
                open = true;
                start = at;
                break;
            }
            at = next;
            c = arcsim::corner_of(s_.faces[p_.face[at]], v);
            if (at == i) break;
        }
        std::vector<int> fan;
        for (int at = start; at >= 0;) {
            const int c = arcsim::corner_of(s_.faces[p_.face[at]], v);
            p_.surface.faces[at][c] = id;
            fan.push_back(at);
            at = inner_neighbour(p_.face[at], (c + 2) % 3);
            if (at == start) break;
        }
        p_.topology.node_faces.push_back(std::move(fan));
        p_.topology.boundary_node.push_back(open);
    }

    void number_edges() {
        Topology& t = p_.topology;
        t.face_edges.assign(p_.face.size(), {-1, -1, -1});
        t.edges.reserve(p_.face.size() * 3 / 2 + 16);
        for (int i = 0; i < p_.surface.n_faces(); ++i)
            for (int corner = 0; corner < 3; ++corner) {   // and the edge opposite
                if (t.face_edges[i][corner] >= 0) continue;
                const int e = static_cast<int>(t.edges.size()), k = (corner + 1) % 3, other = inner_neighbour(p_.face[i], k);
                const arcsim::Triangle& here = p_.surface.faces[i];
                t.edges.push_back({{here[k], here[(k + 1) % 3]}, {i, -1}, {corner, -1}});
                t.face_edges[i][corner] = e;
                if (other < 0) continue;
                const int opposite = (arcsim::corner_of(p_.surface.faces[other], here[k]) + 1) % 3;
                t.edges[e].face[1] = other;
                t.edges[e].corner[1] = opposite;
                t.face_edges[other][opposite] = e;
            }
    }

    /// Borders at a node of the cut mesh are each seam edge and rim edge there. A node where the patch's two borders are one
    /// seam and one rim, or where another seam leaves on the far side, is a junction.
    void find_junctions() {
        p_.junction.assign(p_.node.size(), 0);
        p_.given.assign(p_.node.size(), 0);
        for (int v = 0; v < p_.surface.n_nodes(); ++v) {
            if (!p_.topology.is_boundary_node(v)) continue;
            int seams = 0, rims = 0, given = 0;
            const int first = p_.face[p_.topology.node_faces[v].front()];
            int f = first;
            for (int turn = 0; turn < 2; ++turn) {   // counter-clockwise, then clockwise if a rim stopped us
                int steps = 0;
                do {
                    const int k = arcsim::corner_of(s_.faces[f], p_.node[v]), side = turn == 0 ? (k + 2) % 3 : k;
                    const int next = cut_.across(f, side);
                    if (cut_.is_seam_at(f, side)) ++seams, given += cut_.is_given_at(f, side);
                    if (next < 0) ++rims;
                    f = next;
                } while (f >= 0 && f != first && ++steps < 1000);
                if (f == first) break;
                f = first;
            }
            p_.given[v] = seams > 0 && given == seams;
            p_.junction[v] = seams >= 3 || (seams >= 1 && rims >= 1) || seams == 1;
        }
    }

    const CutMesh& cut_;
    const Surface& s_;
    std::vector<int> local_;   // face of the cut mesh -> of the patch
    PanelPatch p_;
};

}  // namespace

PanelPatch extract_patch(const CutMesh& cut, const std::vector<int>& faces) { return Extraction(cut, faces).take(); }

}  // namespace formwork
