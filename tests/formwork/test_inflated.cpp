#include <catch2/catch.hpp>

#include "formwork/mesher/mesh_kinds.hpp"
#include "reference_cases.hpp"

using namespace formwork;

namespace {

void hold(EquilibriumProblem& p, int node, std::initializer_list<int> axes) {
    for (int c : axes) p.fixed[3 * node + c] = 1;
}

int nearest(const Surface& s, const Vector3d& q) {
    int best = 0;
    for (int i = 1; i < s.n_nodes(); ++i)
        if ((s.x[i] - q).norm() < (s.x[best] - q).norm()) best = i;
    return best;
}

double mirror_volume(const Surface& s, const std::vector<Vector3d>& x) {   // between the shape and the plane z = 0
    double V = 0;
    for (const auto& t : s.faces)
        V += 0.5 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]])[2] * (x[t[0]] + x[t[1]] + x[t[2]])[2] / 3;
    return std::abs(V);
}

}  // namespace

TEST_CASE("a closed sphere swells to its exact radius (B3)") {
    for (const auto& c : reference::data().at("b3")) {
        if (double(c.at("lam")) > 1.2 && c.at("law") == "const") continue;
        double previous = 0;
        for (const double edge : {0.012, 0.0038}) {                        // 1 k and 10 k nodes
            if (edge < 0.01 && double(c.at("lam")) != 1.1) continue;
            EquilibriumProblem p;
            p.rest = make_sphere({.radius = c.at("R0"), .edge = edge, .opening = 0});
            p.fixed.assign(3 * p.rest.x.size(), 0);
            const double R0 = c.at("R0");
            hold(p, nearest(p.rest, {0, 0, 0}), {0, 1, 2});
            hold(p, nearest(p.rest, {0, 0, 2 * R0}), {0, 1});
            hold(p, nearest(p.rest, {R0, 0, R0}), {1});
            p.material = reference::material("iso300", c.at("law"));   // tab300 alike: no shear in equal stretch
            p.plaster.density = 0;
            p.plaster.overpressure = c.at("p");
            p.self_weight = false;
            const EquilibriumResult r = find_equilibrium(p);
            INFO(c.dump() << " nodes " << r.vertices);
            const double R = std::cbrt(3 * r.capacity_m3 / (4 * M_PI));
            const double error = std::abs(R / double(c.at("R")) - 1);
            CHECK(error < (edge > 0.01 ? 5e-3 : 5e-4));
            CHECK(r.support_force_N.norm() < 1e-6 * double(c.at("p")) * R0 * R0);
            if (previous > 0) CHECK(error < previous / 6);
            previous = error;
        }
    }
}

TEST_CASE("blown upward or downward, a sheet has the same depth and capacity, and its prestress the same effect") {
    EquilibriumProblem p;
    p.rest = make_strip({.length = 0.3, .width = 0.3, .edge = 0.015});
    for (const Vector3d& x : p.rest.x) {
        const bool border = std::min({x[0], x[1], 0.3 - x[0], 0.3 - x[1]}) < 1e-9;
        p.fixed.insert(p.fixed.end(), 3, border);
    }
    p.plaster.overpressure = 1500;
    p.self_weight = false;
    const EquilibriumResult one = find_equilibrium(p);
    for (auto& t : p.rest.faces) std::swap(t[1], t[2]);
    const EquilibriumResult other = find_equilibrium(p);
    REQUIRE(one.x[nearest(p.rest, {0.15, 0.15, 0})][2] * other.x[nearest(p.rest, {0.15, 0.15, 0})][2] < -1e-3);
    REQUIRE(one.wrinkled_faces > 0);
    REQUIRE(one.depth_m > 0.05);
    REQUIRE(one.depth_m == Approx(other.depth_m).epsilon(1e-6));
    REQUIRE(one.capacity_m3 == Approx(other.capacity_m3).epsilon(1e-6));
    REQUIRE(one.regularisation.depth_effect > 0);
    REQUIRE(one.regularisation.volume_effect == Approx(other.regularisation.volume_effect).epsilon(1e-3));
}

TEST_CASE("two inextensible disks blow up to the balloon of Paulsen's volume, wrinkled all over") {
    // V = 1.2185 R³, radius 0.7628 R, half thickness 0.4569 R; the mirror half, its edge free in its own plane
    EquilibriumProblem p;
    const double R = 0.15;
    const shapes::Bag b = shapes::disk(R, 29);
    p.rest = b.surface;
    p.fixed.assign(b.held.size(), 0);
    for (std::size_t d = 2; d < b.held.size(); d += 3) p.fixed[d] = b.held[d];
    hold(p, 0, {0, 1});
    const int rim = nearest(p.rest, {R, 0, 0});
    hold(p, rim, {1});
    p.material.rest = p.material.max = {450000, 100, 450000, 1};
    p.plaster.overpressure = 2000;
    p.self_weight = false;
    const EquilibriumResult r = find_equilibrium(p);
    double radius = 0;                                      // of the edge; single nodes of it are gathered in and out
    int n = 0;
    for (std::size_t i = 0; i < r.x.size(); ++i)
        if (b.held[3 * i]) radius += r.x[i].head<2>().norm(), ++n;
    REQUIRE(2 * mirror_volume(p.rest, r.x) == Approx(1.2185 * R * R * R).epsilon(4e-3));
    REQUIRE(std::abs(r.x[0][2]) == Approx(0.4569 * R).epsilon(1.5e-2));
    REQUIRE(radius / n == Approx(0.7628 * R).epsilon(5e-3));
    REQUIRE(r.regularisation.volume_effect < 1e-3);
    REQUIRE(r.wrinkled_faces + r.slack_faces > r.faces / 2);
}

TEST_CASE("the square airbag rises as published (Contri, Kang, Jarasjarungkiat)") {
    EquilibriumProblem p;
    const double w = 0.6 * std::sqrt(2.);
    const shapes::Bag b = shapes::square(w, 40);
    p.rest = b.surface;
    p.fixed.assign(b.held.size(), 0);
    for (std::size_t d = 2; d < b.held.size(); d += 3) p.fixed[d] = b.held[d];
    hold(p, nearest(p.rest, {0, 0, 0}), {0, 1});
    hold(p, nearest(p.rest, {w / 2, 0, 0}), {1});
    p.material.rest = p.material.max = {420000, 168000, 420000, 252000};
    p.plaster.overpressure = 5000;
    p.self_weight = false;
    const EquilibriumResult r = find_equilibrium(p);
    const double centre = std::abs(r.x[nearest(p.rest, {0, 0, 0})][2]);
    REQUIRE(centre > 0.205);
    REQUIRE(centre < 0.220);
    const double edge_moves = w / 2 - r.x[nearest(p.rest, {w / 2, 0, 0})][0];
    REQUIRE(edge_moves == Approx(0.1227).epsilon(0.03));
}
