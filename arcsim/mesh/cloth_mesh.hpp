#pragma once

#include <limits>
#include <string>
#include <vector>

#include "arcsim/mesh/surface.hpp"

namespace arcsim {

/// An edge record of a mesh file: only edges that carry something beside their end nodes.
struct EdgeRecord {
    int node[2];              // 0-based
    double rest_angle = 0;    // rad
    double damage = 0;
    int label = 0;            // nonzero: the end nodes are preserved
};

/// A cloth as its file describes it. A *vert* is a point of the material, a *node* a point in space; along
/// seams and darts one node has several verts. All indices are 0-based here, 1-based in files.
struct ClothMesh {
    std::vector<Vector2d> u;            // verts: material coordinates, m
    std::vector<int> vert_label;

    std::vector<Vector3d> x;            // nodes: positions, m
    std::vector<Vector3d> v;            // velocities, m/s
    std::vector<Vector3d> ny;           // plastic embedding: x of the mesh file, kept as x moves, m
    std::vector<int> node_label;

    std::vector<EdgeRecord> edges;

    std::vector<Triangle> face_nodes;
    std::vector<Triangle> face_verts;
    std::vector<int> face_label;        // index of the material
    std::vector<Matrix2d> face_plastic; // plastic curvature, 1/m
    std::vector<double> face_damage;
    std::vector<int> face_group;        // index into groups, -1: none
    std::vector<std::string> groups;    // names of `g` and `o` lines, in order of appearance

    int n_nodes() const { return static_cast<int>(x.size()); }
    int n_verts() const { return static_cast<int>(u.size()); }
    int n_faces() const { return static_cast<int>(face_nodes.size()); }

    int add_node(const Vector3d& position);
    int add_vert(const Vector2d& material);
    void add_face(const Triangle& nodes, const Triangle& verts, int group = -1);

    Surface surface() const { return {x, face_nodes}; }

    /// Signed area of face f in material space, m²; negative when its corners run clockwise there.
    double material_area(int f) const;

    /// True when every vert of the file's faces belongs to one node and every node has one vert.
    bool one_vert_per_node() const;
};

}  // namespace arcsim
