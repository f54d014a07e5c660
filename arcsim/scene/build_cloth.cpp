#include "arcsim/scene/build_cloth.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "arcsim/scene/motion.hpp"

namespace arcsim {
namespace {

/// A directed edge of a face; `corner` is opposite.
struct HalfEdge {
    int a, b;        // from node a to node b
    int face, corner;
};

/// Both half-edges of every interior edge, in the order of their first face.
std::vector<std::array<HalfEdge, 2>> interior_edges(const ClothMesh& mesh, const std::string& name) {
    std::vector<HalfEdge> all;
    for (int f = 0; f < mesh.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Triangle& t = mesh.face_nodes[f];
            all.push_back({t[k], t[(k + 1) % 3], f, (k + 2) % 3});
        }
    const auto key = [](const HalfEdge& e) { return std::pair(std::min(e.a, e.b), std::max(e.a, e.b)); };
    std::stable_sort(all.begin(), all.end(), [&](const HalfEdge& p, const HalfEdge& q) { return key(p) < key(q); });
    std::vector<std::array<HalfEdge, 2>> pairs;
    for (size_t i = 0; i < all.size();) {
        size_t end = i + 1;
        while (end < all.size() && key(all[end]) == key(all[i])) ++end;
        const std::string where = name + ": edge between nodes " + std::to_string(all[i].a + 1) + " and " +
                                  std::to_string(all[i].b + 1) + " (counted from 1)";
        if (end - i > 2)
            throw InputError(where + " belongs to " + std::to_string(end - i) + " faces; a cloth has two at most. Split the mesh there.");
        if (end - i == 2) {
            if (all[i].a == all[i + 1].a)
                throw InputError(where + ": faces " + std::to_string(all[i].face + 1) + " and " +
                                 std::to_string(all[i + 1].face + 1) + " look to opposite sides. Turn one of them over.");
            pairs.push_back({all[i], all[i + 1]});
        }
        i = end;
    }
    std::sort(pairs.begin(), pairs.end(), [](const auto& p, const auto& q) {
        return std::pair(p[0].face, p[0].corner) < std::pair(q[0].face, q[0].corner);
    });
    return pairs;
}

const ClothMaterialParams& material_of(const ClothMesh& mesh, const ClothParams& cloth, int face) {
    const int label = mesh.face_label[face];
    if (label < 0 || label >= static_cast<int>(cloth.materials.size()))
        throw InputError(cloth.mesh.name + ": face " + std::to_string(face + 1) + " has the label " +
                         std::to_string(label) + ", but the cloth has " + std::to_string(cloth.materials.size()) +
                         " materials (counted from 0). Add the material or change the label.");
    return cloth.materials[label];
}

std::vector<StretchFace> stretch_faces(const ClothMesh& mesh, const ClothParams& cloth) {
    std::vector<StretchFace> faces;
    for (int f = 0; f < mesh.n_faces(); ++f) {
        const ClothMaterialParams& material = material_of(mesh, cloth, f);
        const double area = mesh.material_area(f);
        if (area < 0)
            throw InputError(cloth.mesh.name + ": face " + std::to_string(f + 1) +
                             " runs clockwise in material space (vt). Mirror the material coordinates or turn the face over.");
        const Triangle& t = mesh.face_verts[f];
        Matrix2d D;
        D << mesh.u[t[1]] - mesh.u[t[0]], mesh.u[t[2]] - mesh.u[t[0]];
        faces.push_back({mesh.face_nodes[f], area > 0 ? Matrix2d(D.inverse()) : Matrix2d(Matrix2d::Zero()), area,
                         material.damping, 1 + material.weakening * mesh.face_damage[f], mesh.face_label[f]});
    }
    return faces;
}

/// Null when no material has limits.
std::unique_ptr<StrainLimitForce> strain_limits(const std::vector<StretchFace>& faces, const ClothParams& cloth) {
    std::vector<LimitedFace> limited;
    for (size_t f = 0; f < faces.size(); ++f)
        if (const auto& limits = cloth.materials[faces[f].material].strain_limits)
            limited.push_back({static_cast<int>(f), faces[f], (*limits)[0], (*limits)[1]});
    return limited.empty() ? nullptr : std::make_unique<StrainLimitForce>(std::move(limited));
}

/// The vert of `face` at `node`.
int vert_at(const ClothMesh& mesh, int face, int node) {
    for (int k = 0; k < 3; ++k)
        if (mesh.face_nodes[face][k] == node) return mesh.face_verts[face][k];
    return -1;
}

std::vector<Hinge> hinges(const ClothMesh& mesh, const ClothParams& cloth, const std::vector<BendingTable>& tables) {
    std::map<std::pair<int, int>, const EdgeRecord*> records;
    for (const EdgeRecord& e : mesh.edges) records[std::minmax(e.node[0], e.node[1])] = &e;
    std::vector<Hinge> result;
    for (const auto& sides : interior_edges(mesh, cloth.mesh.name)) {
        Hinge h;
        h.node = {sides[0].a, sides[0].b, mesh.face_nodes[sides[0].face][sides[0].corner],
                  mesh.face_nodes[sides[1].face][sides[1].corner]};
        double damage = 0;
        for (int s = 0; s < 2; ++s) {
            const int face = sides[s].face;
            const Vector2d e = mesh.u[vert_at(mesh, face, h.node[0])] - mesh.u[vert_at(mesh, face, h.node[1])];
            h.length += e.norm() / 2;
            h.area += mesh.material_area(face);
            h.direction[s] = BendingTable::direction(e);
            h.material[s] = mesh.face_label[face];
            h.damping += cloth.materials[mesh.face_label[face]].damping / 2;
        }
        if (const auto it = records.find(std::minmax(h.node[0], h.node[1])); it != records.end()) {
            h.rest_angle = it->second->rest_angle;
            damage = it->second->damage;
        }
        const double weakening = std::max(cloth.materials[h.material[0]].weakening, cloth.materials[h.material[1]].weakening);
        h.softening = 1 + weakening * damage;
        const bool resists = !tables[h.material[0]].is_zero() || !tables[h.material[1]].is_zero();
        if (resists && h.area > 0 && h.length > 0) result.push_back(h);   // nothing bends between faces without area
    }
    return result;
}

VectorXd positions(const ClothMesh& mesh) {
    VectorXd x(3 * mesh.n_nodes());
    for (int i = 0; i < mesh.n_nodes(); ++i) x.segment<3>(3 * i) = mesh.x[i];
    return x;
}

}  // namespace

ClothMesh place_mesh(const ClothParams& cloth) {
    ClothMesh mesh = read_obj(cloth.mesh.path);
    const Pose pose = pose_of(cloth.transform);
    for (int i = 0; i < mesh.n_nodes(); ++i) {
        mesh.x[i] = pose.apply(mesh.x[i]);
        const VelocityParams& v = cloth.velocity;
        mesh.v[i] = v.linear + v.angular.cross(mesh.x[i] - v.origin);
    }
    for (Vector2d& u : mesh.u) u *= cloth.transform.scale;
    return mesh;
}

ClothModel build_model(const ClothMesh& mesh, const ClothParams& cloth, const SceneParams& scene) {
    if (mesh.n_faces() == 0) throw InputError(cloth.mesh.name + ": has no faces.");
    if (cloth.materials.empty())
        throw InputError("cloth " + cloth.mesh.name + ": has no materials. Add \"materials\": [{\"data\": \"file.json\"}] to it.");
    ClothModel model;
    model.faces = mesh.face_nodes;
    std::vector<std::shared_ptr<const StiffnessTable>> tables;
    std::vector<BendingTable> bending;
    std::vector<double> density;
    for (const ClothMaterialParams& m : cloth.materials) {
        const MaterialData data = read_material(m.data.path);
        tables.push_back(std::make_shared<StiffnessTable>(data.stretching, m.sampling, m.stretching_mult * m.thicken));
        bending.emplace_back(data.bending, m.bending_mult * m.thicken);
        density.push_back(data.density * m.density_mult * m.thicken);
    }
    const VectorXd x = positions(mesh);
    std::vector<StretchFace> faces = stretch_faces(mesh, cloth);
    std::vector<WindForce::Face> wind_faces;
    for (int axis = 0; axis < 3; ++axis) {
        const auto along = x(Eigen::seq(axis, Eigen::last, 3));
        model.size = std::max(model.size, along.maxCoeff() - along.minCoeff());
    }
    model.mass = VectorXd::Zero(mesh.n_nodes());
    for (const StretchFace& f : faces) {
        for (int node : f.node) model.mass[node] += density[f.material] * f.area / 3;
        wind_faces.push_back({f.node, f.area});
    }
    model.gravity = std::make_unique<GravityForce>(model.mass, scene.gravity);
    for (double& mass : model.mass)
        if (mass == 0) mass = 1;   // nodes without faces: nothing acts on them, any mass keeps the matrix regular
    if (!scene.disables("strainlimiting")) model.limits = strain_limits(faces, cloth);
    model.stretch = std::make_unique<StretchForce>(std::move(faces), std::move(tables));
    std::vector<Hinge> folds = hinges(mesh, cloth, bending);
    model.bend = std::make_unique<BendForce>(std::move(folds), std::move(bending), x);
    if (scene.magic.preserve_creases) model.bend->set_rest_angles_from(x);
    model.wind = std::make_unique<WindForce>(std::move(wind_faces), scene.wind.density, scene.wind.drag,
                                             scene.wind.velocity, x);
    return model;
}

}  // namespace arcsim
