#include <catch2/catch.hpp>

#include "tests/formwork/sew/sewn_sock.hpp"

using namespace formwork;

namespace {

double largest_difference(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
    double d = 0;
    for (size_t i = 0; i < a.size(); ++i) d = std::max(d, (a[i] - b[i]).norm());
    return d;
}

/// The inflated shape of a soft isotropic bag: far from the sewn one.
EquilibriumResult inflate(const SewnSock& sock, double level) {
    EquilibriumProblem p;
    p.rest = sock.bag.surface;
    p.fixed = sock.bag.held;
    p.plaster = sock.input(level).plaster;
    p.material.rest = {1500, 2, 1500, 1498};
    p.material.max = {3000, 2, 3000, 2998};
    return find_equilibrium(p);
}

}  // namespace

TEST_CASE("the sewn bag ends in one state from the inflated and from the rest shape, and carries its weight") {
    const SewnSock sock(0.1, 0.15, 5);
    const double level = 0;
    const EquilibriumResult soft = inflate(sock, level);
    SewInput input = sock.input(level);
    const SewInput filled{input.segmentation, input.panels, input.input_faces, soft.x, input.input_fixed,
                          input.up, input.plaster, soft.fill_level_m, soft.volume_m3, {}};
    SewParams params = SewnSock::params();
    const SewResult from_inflated = sew_bag(filled, params);
    params.start = SewStart::rest;
    const SewResult from_rest = sew_bag(filled, params);

    REQUIRE(largest_difference(soft.x, sock.bag.surface.x) > 5e-3);
    REQUIRE(largest_difference(from_inflated.equilibrium.x, from_rest.equilibrium.x) < 1e-8);
    const EquilibriumResult& r = from_inflated.equilibrium;
    REQUIRE(r.residual < 1e-8);
    REQUIRE(r.fill_level_m == Approx(level));
    const double weight = 9.81 * (0.2 * arcsim::total_area(sock.cut.mesh) + 1500 * r.volume_m3);
    REQUIRE(r.support_force_N[2] == Approx(weight).epsilon(1e-7));
    REQUIRE(r.iterations < 40);   // the whole unsymmetric tangent: its symmetric half needs hundreds
    REQUIRE(r.support_force_N.head<2>().norm() < 1e-6 * weight);
    REQUIRE(from_inflated.from_inflated.rms > 1e-3);
    REQUIRE(from_inflated.from_cut.rms > 1e-3);
    REQUIRE(from_inflated.from_cut.max >= from_inflated.from_cut.rms);
}

TEST_CASE("threads that push, as (10) reads, and threads that go slack: either way both starts end in one state") {
    const SewnSock sock(0.1, 0.15, 4);
    const EquilibriumResult soft = inflate(sock, 0.02);
    const SewInput input = sock.input(0.02);
    const SewInput filled{input.segmentation, input.panels, input.input_faces, soft.x, input.input_fixed,
                          input.up, input.plaster, soft.fill_level_m, soft.volume_m3, {}};
    for (ThreadCompression compression : {ThreadCompression::full, ThreadCompression::slack}) {
        SewParams params = SewnSock::params();
        params.thread_compression = compression;
        const SewResult bag = sew_bag(filled, params);
        params.start = SewStart::rest;
        REQUIRE(largest_difference(bag.equilibrium.x, sew_bag(filled, params).equilibrium.x) < 1e-7);
        const std::vector<SeamSpring>& springs = bag.bag.springs;
        const auto length = [&](const SeamSpring& s) { return (bag.equilibrium.x[s.j] - bag.equilibrium.x[s.i]).norm(); };
        REQUIRE(std::any_of(springs.begin(), springs.end(), [&](const SeamSpring& s) { return length(s) < s.L; }));
        REQUIRE(std::any_of(springs.begin(), springs.end(), [&](const SeamSpring& s) { return length(s) > s.L; }));
        REQUIRE((bag.seam_max_compression_N > 0) == (compression == ThreadCompression::full));
        const double weight = 9.81 * (0.2 * arcsim::total_area(sock.cut.mesh) + 1500 * bag.equilibrium.volume_m3);
        REQUIRE(bag.equilibrium.support_force_N[2] > 0.9 * weight);   // a head of 2 cm stands over the rim
    }
}

TEST_CASE("weave along the meridians of a sock sees little shear, weave at 45 degrees much more") {
    const SewnSock sock(0.1, 0.15, 5);
    SewParams params = SewnSock::params();
    params.start = SewStart::rest;
    params.compare = {"rotated_45", "random"};
    params.strength = 17500;
    const SewResult r = sew_bag(sock.input(0), params);
    REQUIRE(r.compare.size() == 2);
    for (const GrainVariant& v : r.compare) {
        INFO(v.name << ": " << v.failure);
        REQUIRE(v.failure.empty());
        REQUIRE(v.mean_abs_shear > r.weave.abs_shear.mean);
    }
    // The wall's upper half alone, where the weave can follow: no grain serves a disk like the bottom, which folds the
    // wall beside it.
    EquilibriumProblem p = sewn_problem(sock.input(0), params, r.bag);
    p.flat = turn_grain(r.bag.flat, sock.cut.panel, sock.cut.n_panels, "rotated_45", 1);
    const EquilibriumResult turned = find_equilibrium(p);
    double aligned_sum = 0, turned_sum = 0;
    for (int f = 0; f < sock.cut.mesh.n_faces(); ++f) {
        if (arcsim::face_centroid(sock.cut.mesh, f)[2] < -0.075) continue;
        aligned_sum += std::abs(r.equilibrium.strain[f].eps_uv);
        turned_sum += std::abs(turned.strain[f].eps_uv);
    }
    REQUIRE(turned_sum > 2 * aligned_sum);

    REQUIRE(r.weave.abs_shear.max >= r.weave.abs_shear.p95);
    REQUIRE(r.weave.abs_shear.p95 >= r.weave.abs_shear.mean);
    REQUIRE(*r.weave.utilisation == Approx(r.weave.tension.max / 17500));
    double sum = 0;
    for (double share : r.weave.angle_histogram) sum += share;
    REQUIRE(sum == Approx(1));
    for (const FaceWeave& w : r.weave.face) REQUIRE(std::abs(w.cos_angle) <= 1);
}

TEST_CASE("stitches hold the panels as shared nodes do, and gap by what they carry") {
    const SewnSock sock(0.1, 0.15, 4);
    SewParams params = SewnSock::params();
    params.start = SewStart::rest;
    const SewResult shared = sew_bag(sock.input(0), params);
    params.seams = SeamModel::stitch;
    const SewResult stitched = sew_bag(sock.input(0), params);
    REQUIRE(shared.bag.n_stitches == 0);
    REQUIRE(stitched.bag.n_stitches > 0);
    REQUIRE(stitched.bag.cut.n_nodes() > shared.bag.cut.n_nodes());
    REQUIRE(stitched.seam_gap_max_m > 0);
    REQUIRE(stitched.seam_gap_max_m < 1e-4);
    REQUIRE(stitched.equilibrium.depth_m == Approx(shared.equilibrium.depth_m).epsilon(2e-3));
    REQUIRE(stitched.seam_max_force_N == Approx(shared.seam_max_force_N).epsilon(0.1));
}

TEST_CASE("a thread of stiffness EA has kappa EA / L, and its tension grows with it") {
    const SewnSock sock(0.1, 0.15, 4);
    SewParams params = SewnSock::params();
    params.start = SewStart::rest;
    params.seam_EA = 1000;
    const SewnBag bag = make_sewn_bag(sock.input(0), params);
    REQUIRE(bag.springs.size() == bag.edges.size());
    for (const SeamSpring& s : bag.springs) REQUIRE(s.kappa == Approx(1000 / s.L));
    const SewResult soft = sew_bag(sock.input(0), params);
    params.seam_EA = 4000;
    const SewResult stiff = sew_bag(sock.input(0), params);
    REQUIRE(stiff.seam_max_force_N > 1.5 * soft.seam_max_force_N);
}

TEST_CASE("points that the cut made are held where the border is, and only there") {
    Segmentation s;
    // One square of two faces; the diagonal's ends are held, and so is the border's lower edge.
    const std::vector<Triangle> faces{{0, 1, 2}, {0, 2, 3}};
    std::vector<char> held(12, 0);
    for (int node : {0, 1, 2}) held[3 * node] = held[3 * node + 1] = held[3 * node + 2] = 1;
    s.source = {{0, {0.5, 0.5, 0}}, {1, {0.5, 0.5, 0}}, {1, {0.3, 0.3, 0.4}}, {1, {0, 0, 1}}, {0, {1, 0, 0}}, {0, {0.2, 0.3, 0.5}}};
    const std::vector<char> fixed = fixed_on_cut_mesh(s, faces, held);
    REQUIRE(fixed[0]);        // on the lower border
    REQUIRE(fixed[3]);        // on the diagonal, beside the held face
    REQUIRE_FALSE(fixed[6]);  // inside a face with a free corner
    REQUIRE_FALSE(fixed[9]);  // the free corner
    REQUIRE(fixed[12]);       // a held corner
    REQUIRE(fixed[15]);       // inside the held face
    held[3] = held[4] = held[5] = 0;
    REQUIRE_FALSE(fixed_on_cut_mesh(s, faces, held)[3]);   // now the diagonal only joins two held corners
}
