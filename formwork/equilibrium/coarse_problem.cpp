#include "formwork/equilibrium/coarse_problem.hpp"

#include <Eigen/LU>

namespace formwork {
namespace {

/// Rest coordinates of each coarse face in the frame of the fine face it grew from, turned into the coarse face's plane.
std::vector<FlatTriangle> coarse_flat(const EquilibriumProblem& p, const CoarseMesh& mesh) {
    const std::vector<FlatTriangle> own = p.flat.empty() ? rest_in_own_planes(p.rest) : std::vector<FlatTriangle>{};
    const std::vector<FlatTriangle>& fine_flat = p.flat.empty() ? own : p.flat;
    std::vector<FlatTriangle> flat(mesh.surface.faces.size());
    for (int f = 0; f < mesh.surface.n_faces(); ++f) {
        const int fine = mesh.fine_face[f];
        const Triangle& t = p.rest.faces[fine];
        const FlatTriangle& u = fine_flat[fine];
        const arcsim::FaceFrame frame = arcsim::face_frame(p.rest, fine);
        arcsim::Matrix2d edges, rest;
        edges << frame.local(p.rest.x[t[1]] - p.rest.x[t[0]]), frame.local(p.rest.x[t[2]] - p.rest.x[t[0]]);
        rest << u[1] - u[0], u[2] - u[0];
        const arcsim::Matrix2d map = rest * edges.inverse();
        const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(face_normal(mesh.surface, f), frame.n);
        const Triangle& c = mesh.surface.faces[f];
        flat[f][0].setZero();
        for (int k = 1; k < 3; ++k) flat[f][k] = map * frame.local(turn * (mesh.surface.x[c[k]] - mesh.surface.x[c[0]]));
    }
    return flat;
}

}  // namespace

CoarseProblem coarse_problem(const EquilibriumProblem& p, const StaticSystem& system) {
    CoarseProblem c;
    c.mesh = coarsen(p.rest, system.fixed().flags(), p.rest.n_nodes() / 4);
    EquilibriumProblem& q = c.problem;
    q = p;
    q.rest = c.mesh.surface;
    q.flat.clear();
    if (!p.flat.empty() || p.material.model != FabricModel::isotropic) q.flat = coarse_flat(p, c.mesh);
    q.fixed.clear();
    q.start.clear();
    for (int i : c.mesh.fine_node) {
        for (int k = 0; k < 3; ++k) q.fixed.push_back(system.fixed().flags()[3 * i + k]);
        if (!p.start.empty()) q.start.push_back(p.start[i]);
    }
    if (system.has_liquid()) {
        q.plaster.fill = FillParams{};
        if (system.level_is_unknown()) q.plaster.fill->volume = system.target_volume();
        else q.plaster.fill->level = system.pressure().level();
    }
    return c;
}

VectorXd fine_positions(const EquilibriumProblem& p, const CoarseProblem& coarse, const VectorXd& coarse_x,
                        Interpolation interpolation) {
    std::vector<Vector3d> u = unflatten(coarse_x);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] -= coarse.mesh.surface.x[i];
    VectorXd x = flatten(p.rest.x) + flatten(prolong(coarse.mesh, u, p.rest, interpolation));
    const std::vector<Vector3d>& start = p.start.empty() ? p.rest.x : p.start;
    for (std::size_t d = 0; d < p.fixed.size(); ++d)
        if (p.fixed[d]) x[static_cast<Eigen::Index>(d)] = start[d / 3][static_cast<Eigen::Index>(d % 3)];
    return x;
}

}  // namespace formwork
