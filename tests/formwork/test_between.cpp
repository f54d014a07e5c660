#include <catch2/catch.hpp>
#include <cstdlib>

#include "axisymmetric_bag.hpp"
#include "reference_cases.hpp"

using namespace formwork;

namespace {

/// Soft or stiff fabric of the references, its stiffness times `part`.
MaterialParams fabric(const std::string& name, const std::string& law, double part) {
    MaterialParams m = reference::material(name, law);
    for (auto* row : {&m.rest, &m.max})
        for (double& k : *row) k *= part;
    return m;
}

nlohmann::json bag_case(const axisymmetric::Bag& b) {
    nlohmann::json c{{"kind", b.kind}, {"a", b.radius}, {"h", b.height}, {"mat", "iso300"}, {"law", "const"}};
    if (b.pressure > 0) c["p"] = b.pressure;
    else c["rho"] = b.rho_g / 9.81, c["head"] = b.head;
    return c;
}

struct Errors {
    double depth, volume, reaction;
};

Errors errors(const EquilibriumResult& r, const axisymmetric::Shape& s) {
    return {r.depth_below_rim_m / s.depth - 1, r.capacity_m3 / s.volume - 1, std::abs(r.support_force_N[2]) / s.reaction - 1};
}

std::string described(const axisymmetric::Bag& b) {
    return b.kind + " a " + std::to_string(b.radius) + " h " + std::to_string(b.height) + " k " + std::to_string(b.fabric.rest[0]) + ".." +
           std::to_string(b.fabric.max[0]) + " rho g " + std::to_string(b.rho_g) + " head " + std::to_string(b.head) + " p " +
           std::to_string(b.pressure);
}

}  // namespace

TEST_CASE("shooting agrees with the stored references") {
    for (const char* id : {"b6", "b4"})
        for (const auto& c : reference::data().at(id)) {
            if (c.value("tension_field", false)) continue;
            INFO(c.value("kind", "disk") << " " << c.at("a") << " " << c.at("law"));
            axisymmetric::Bag b{c.value("kind", "disk"), c.at("a"), c.value("h", 0.0), reference::material(c.at("mat"), c.at("law")),
                                9.81 * c.value("rho", 0.0), c.value("head", 0.0), c.value("p", 0.0)};
            const axisymmetric::Shape s = solve(b, {.depth = 0.99 * double(c.at("depth")), .pole_stretch = 0.999 * double(c.at("lam_pole"))});
            REQUIRE(s.found);
            CHECK(s.depth == Approx(double(c.at("depth"))).epsilon(3e-6));
            CHECK(s.volume == Approx(double(c.at("volume"))).epsilon(3e-6));
            CHECK(s.reaction == Approx(double(c.at("reaction"))).epsilon(3e-6));
        }
    for (const auto& c : reference::data().at("b5")) {
        if (c.at("mat").is_null()) continue;
        const axisymmetric::Trough t{c.at("W"), c.at("L0"), reference::material(c.at("mat"), c.at("law")), 1500 * 9.81, c.at("head")};
        const axisymmetric::Section s = solve(t, {.depth = 0.99 * double(c.at("bottom_below_supports")), .stretch = double(c.at("lam")) + 1e-3});
        REQUIRE(s.found);
        CHECK(s.depth == Approx(double(c.at("bottom_below_supports"))).epsilon(3e-6));
        CHECK(s.tension == Approx(double(c.at("tension"))).epsilon(3e-6));
        CHECK(s.area == Approx(double(c.at("fluid_area"))).epsilon(3e-6));
    }
}

TEST_CASE("bags between the references agree with shooting, at second order (B4, B6)") {
    const auto soft = [](const char* law, double part = 1) { return fabric("iso300", law, part); };
    const auto stiff = [](double part = 1) { return fabric("iso36k", "const", part); };
    const double rho_g = 1500 * 9.81;
    const std::vector<axisymmetric::Bag> bags{
        {"disk", 0.12, 0, soft("secant"), 1650 * 9.81, 0.02, 0},  {"disk", 0.08, 0, soft("const"), rho_g, 0.03, 0},
        {"disk", 0.18, 0, soft("secant"), 1200 * 9.81, 0, 0},     {"disk", 0.1, 0, soft("secant", 0.5), rho_g, 0, 0},
        {"disk", 0.25, 0, soft("secant", 2), rho_g, 0, 0},        {"disk", 0.2, 0, stiff(), rho_g, 0.1, 0},
        {"hemisphere", 0.12, 0, soft("secant"), rho_g, 0.1, 0},   {"hemisphere", 0.1, 0, soft("const", 2), rho_g, 0.08, 0},
        {"sock", 0.08, 0.12, soft("secant"), rho_g, 0, 0},        {"sock", 0.1, 0.15, soft("secant", 0.8), rho_g, -0.07, 0},
        {"sock", 0.12, 0.15, soft("secant"), 1300 * 9.81, 0, 0},  {"sock", 0.1, 0.25, soft("secant", 0.9), rho_g, -0.13, 0},
        {"disk", 0.1, 0, soft("const"), 0, 0, 120},               {"disk", 0.1, 0, soft("const"), 0, 0, 1100},
        {"disk", 0.1, 0, soft("secant"), 0, 0, 650},              {"disk", 0.13, 0, stiff(), 0, 0, 4000},
        {"disk", 0.1, 0, soft("secant", 0.5), 0, 0, 1000},
    };
    for (const axisymmetric::Bag& b : bags) {
        INFO(described(b));
        Errors e[2];
        int nodes[2];
        axisymmetric::Shape s;
        for (const int fine : {0, 1}) {
            EquilibriumProblem p = reference::bag_problem(bag_case(b), fine ? 10267 : 1027);
            p.material = b.fabric;
            const EquilibriumResult r = find_equilibrium(p);
            if (!fine) s = solve(b, {.depth = r.depth_below_rim_m, .pole_stretch = r.max_stretch});
            REQUIRE(s.found);
            REQUIRE(s.least_tension > 0);
            e[fine] = errors(r, s);
            nodes[fine] = r.vertices;
        }
        const double kink = b.head < 0 ? 2 : 1;   // a wet line inside
        CHECK(std::abs(e[0].depth) < kink * 3e-3);
        CHECK(std::abs(e[1].depth) < kink * 3e-4);
        CHECK(std::abs(e[0].volume) < kink * 6e-3);
        CHECK(std::abs(e[1].volume) < kink * 6e-4);
        CHECK(std::abs(e[1].reaction) < kink * 6e-4);
        CHECK(reference::rate(e[0].volume, e[1].volume, nodes[0], nodes[1]) > 1.7);
        if (std::getenv("SHOW_ERRORS"))
            std::printf("%-90s depth %.2e %.2e volume %.2e %.2e reaction %.2e, hoops %.1f\n", described(b).c_str(), e[0].depth, e[1].depth,
                        e[0].volume, e[1].volume, e[1].reaction, s.least_tension);
    }
}

TEST_CASE("troughs between the references agree with shooting (B5)") {
    const double rho_g = 1500 * 9.81;
    const std::vector<axisymmetric::Trough> troughs{{0.4, 0.45, fabric("iso300", "secant", 1), rho_g, 0},
                                                    {0.4, 0.5, fabric("iso300", "secant", 0.5), rho_g, -0.03},
                                                    {0.4, 0.7, fabric("iso36k", "const", 1), rho_g, 0.1},
                                                    {0.3, 0.36, fabric("iso300", "const", 2), rho_g, 0.05}};
    for (const axisymmetric::Trough& t : troughs) {
        INFO("W " << t.width << " L " << t.length << " k " << t.fabric.rest[0] << " head " << t.head);
        nlohmann::json c{{"W", t.width}, {"L0", t.length}, {"head", t.head}, {"mat", "iso300"}, {"law", "const"},
                         {"bottom_below_supports", 1}, {"fluid_area", 1}, {"tension", 1}};
        const auto solve_at = [&](int across) {
            EquilibriumProblem p = reference::trough_problem(c, across);
            p.material = t.fabric;
            return find_equilibrium(p);
        };
        const EquilibriumResult coarse = solve_at(64), fine = solve_at(256);
        const axisymmetric::Section s = solve(t, {.depth = coarse.depth_below_rim_m, .stretch = coarse.max_stretch});
        REQUIRE(s.found);
        CHECK(std::abs(coarse.depth_below_rim_m / s.depth - 1) < 1e-3);
        CHECK(std::abs(fine.depth_below_rim_m / s.depth - 1) < 1e-4);
        CHECK(fine.max_stretch == Approx(s.stretch).epsilon(1e-4));
    }
}
