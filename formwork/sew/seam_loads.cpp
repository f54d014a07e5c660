#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "formwork/fabric/membrane_law.hpp"
#include "formwork/sew/weave_measures.hpp"

namespace formwork {
namespace {

using arcsim::Matrix2d;

/// |P N| on the edge (a, b) of face f: force per rest length that the face hands across that edge, N/m.
double line_load(const SewnBag& bag, const EquilibriumResult& r, const MembraneLaw& law, int f, int a, int b) {
    const Triangle& t = bag.cut.faces[f];
    const FlatTriangle& u = bag.flat[f];
    Matrix2d rest;
    rest << u[1] - u[0], u[2] - u[0];
    arcsim::Matrix32d edges;
    edges << r.x[t[1]] - r.x[t[0]], r.x[t[2]] - r.x[t[0]];
    const arcsim::Matrix32d F = edges * rest.inverse();
    const FaceStrain& e = r.strain[f];
    const Vector3d S = evaluate_one(law, {e.eps_uu, e.eps_vv, e.eps_uv}, Want::stress).S;
    Matrix2d s;
    s << S[0], S[2], S[2], S[1];
    Vector2d along = Vector2d::Zero();
    for (int k = 0; k < 3; ++k) {
        const int i = bag.node_of_cut[t[k]], j = bag.node_of_cut[t[(k + 1) % 3]];
        if ((i == a && j == b) || (i == b && j == a)) along = u[(k + 1) % 3] - u[k];
    }
    const Vector2d normal = Vector2d(along[1], -along[0]).normalized();
    return (F * s * normal).norm();
}

/// Force of a spring as the equilibrium has it: none where a slack one is shorter than at rest.
double spring_force(const SeamSpring& s, const EquilibriumResult& r) {
    const double longer = (r.x[s.j] - r.x[s.i]).norm() - s.L;
    return s.goes_slack && longer < 0 ? 0 : s.kappa * longer;
}

}  // namespace

std::vector<SeamEdgeLoad> measure_seam_edges(const SewnBag& bag, const SewParams& params, const EquilibriumResult& result) {
    const std::unique_ptr<MembraneLaw> law = make_membrane_law(params.material);
    const bool stitched = params.seams == SeamModel::stitch;   // a spring along either side
    std::vector<SeamEdgeLoad> loads;
    for (size_t k = 0; k < bag.edges.size(); ++k) {
        const SeamEdge& e = bag.edges[k];
        SeamEdgeLoad load;
        load.thread_force = stitched ? spring_force(bag.springs[2 * k], result) + spring_force(bag.springs[2 * k + 1], result)
                                     : spring_force(bag.springs[k], result);
        for (int face : e.face) load.line_load = std::max(load.line_load, line_load(bag, result, *law, face, e.node[0], e.node[1]));
        loads.push_back(load);
    }
    return loads;
}

std::vector<SeamLoad> measure_seams(const SewnBag& bag, const std::vector<SeamEdgeLoad>& edges, const EquilibriumResult& result,
                                    int n_seams) {
    std::vector<SeamLoad> loads(n_seams);
    for (int s = 0; s < n_seams; ++s) loads[s].seam = s;
    for (size_t k = 0; k < bag.edges.size(); ++k) {
        const SeamEdge& e = bag.edges[k];
        SeamLoad& load = loads[e.seam];
        load.length += e.length;
        load.thread_force_max = std::max(load.thread_force_max, edges[k].thread_force);
        load.thread_force_min = std::min(load.thread_force_min, edges[k].thread_force);
        load.thread_force_mean += e.length * edges[k].thread_force;
        load.line_load_max = std::max(load.line_load_max, edges[k].line_load);
    }
    for (SeamLoad& load : loads)
        if (load.length > 0) load.thread_force_mean /= load.length;
    for (size_t k = bag.springs.size() - bag.n_stitches; k < bag.springs.size(); ++k) {
        const SeamSpring& stitch = bag.springs[k];
        const double gap = (result.x[stitch.j] - result.x[stitch.i]).norm();
        const int node = bag.node_of_cut[stitch.i];
        for (const SeamEdge& e : bag.edges)
            if (e.node[0] == node || e.node[1] == node) loads[e.seam].gap_max = std::max(loads[e.seam].gap_max, gap);
    }
    return loads;
}

}  // namespace formwork
