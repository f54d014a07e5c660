#include <catch2/catch.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "reference_cases.hpp"

using namespace formwork;

namespace {

/// Tolerances of the shared references: 1 k and 10 k nodes.
struct Tolerance {
    double depth_1k, depth_10k, volume_1k, volume_10k;
};

std::string name_of(const nlohmann::json& c) {
    nlohmann::json short_form = c;
    for (const char* k : {"profile", "volume", "reaction", "lam_pole", "depth"}) short_form.erase(k);
    return short_form.dump();
}

}  // namespace

TEST_CASE("filled bags agree with their axisymmetric solutions, at second order (B6)") {
    for (const auto& c : reference::data().at("b6")) {
        INFO(name_of(c));
        const bool wrinkles = c.at("tension_field"), wet_line = c.at("head") < 0;
        const Tolerance t = wrinkles   ? Tolerance{2e-2, 1e-2, 2e-2, 1e-2}
                            : wet_line ? Tolerance{6e-3, 6e-4, 12e-3, 12e-4}
                                       : Tolerance{3e-3, 3e-4, 6e-3, 6e-4};
        const auto coarse = reference::solve_bag(c, 1027), fine = reference::solve_bag(c, 10267);
        CHECK(std::abs(coarse.depth) < t.depth_1k);
        CHECK(std::abs(fine.depth) < t.depth_10k);
        CHECK(std::abs(coarse.volume) < t.volume_1k);
        CHECK(std::abs(fine.volume) < t.volume_10k);
        CHECK(std::abs(fine.reaction) < t.volume_10k);
        if (!wrinkles) CHECK(reference::rate(coarse.depth, fine.depth, coarse.nodes, fine.nodes) > 1.7);
        if (c.at("kind") != "sock") CHECK(reference::rate(coarse.meridian, fine.meridian, coarse.nodes, fine.nodes) > 0.9);
    }
}

TEST_CASE("blown-up disks agree with their axisymmetric solutions, at second order (B4)") {
    for (const auto& c : reference::data().at("b4")) {
        INFO(name_of(c));
        const auto coarse = reference::solve_bag(c, 1027), fine = reference::solve_bag(c, 10267);
        CHECK(std::abs(coarse.depth) < 3e-3);
        CHECK(std::abs(fine.depth) < 3e-4);
        CHECK(std::abs(coarse.pole) < 1e-2);
        CHECK(std::abs(fine.pole) < 2e-3);
        CHECK(reference::rate(coarse.volume, fine.volume, coarse.nodes, fine.nodes) > 1.9);
        if (std::abs(coarse.depth) > 1.5e-4)   // smaller ones change their sign on the way
            CHECK(reference::rate(coarse.depth, fine.depth, coarse.nodes, fine.nodes) > 1.7);
    }
}

TEST_CASE("a disk of the square-symmetric table agrees with its extrapolated solution (B6c)") {
    for (const auto& c : reference::data().at("b6c")) {
        INFO(name_of(c));
        const auto coarse = reference::solve_bag(c, 1027), fine = reference::solve_bag(c, 10267);
        CHECK(std::abs(coarse.depth) < 5e-3);
        CHECK(std::abs(fine.depth) < 5e-4);
    }
}

TEST_CASE("a long trough hangs in its exact curve, at second order (B5)") {
    for (const auto& c : reference::data().at("b5")) {
        INFO(name_of(c));
        const auto coarse = reference::solve_trough(c, 64), fine = reference::solve_trough(c, 256);   // 4 nodes wide
        CHECK(std::abs(coarse.depth) < 1e-3);
        CHECK(std::abs(fine.depth) < 1e-4);
        CHECK(std::abs(coarse.reaction) < 1e-3);
        CHECK(std::abs(fine.reaction) < 1e-4);
        CHECK(std::log(coarse.depth / fine.depth) / std::log(4.) > 1.7);
    }
}

namespace {

/// One row of the study: relative errors at 1 k, 10 k and 40 k, and the exponent of the last refinement.
void print_row(const std::string& name, const char* what, const std::array<double, 3>& e, double exponent) {
    std::printf("| %s | %s | %.1e | %.1e | %.1e | %s |\n", name.c_str(), what, e[0], e[1], e[2],
                std::isnan(exponent) ? "" : std::to_string(exponent).substr(0, 4).c_str());
    std::fflush(stdout);
}

/// Not a number where the error changes its sign on the way, which tells no rate.
double exponent_of(const std::array<double, 3>& e, int coarse_nodes, int fine_nodes) {
    const bool monotone = e[1] * e[2] > 0 && std::abs(e[2]) < std::abs(e[1]);
    return monotone ? reference::rate(e[1], e[2], coarse_nodes, fine_nodes) : std::nan("");
}

std::string short_name(const std::string& id, const nlohmann::json& c) {
    std::ostringstream s;
    s << id << ' ' << c.value("kind", id == "b5" ? "trough" : "disk");
    for (const char* k : {"a", "h", "W", "L0"})
        if (c.contains(k) && c.at(k) != 0) s << ' ' << k << ' ' << c.at(k);
    s << ' ' << (c.contains("mat") ? c.at("mat").is_null() ? "inextensible" : c.at("mat").get<std::string>() : "tab300");
    if (c.contains("law") && !c.at("law").is_null()) s << ' ' << c.at("law").get<std::string>();
    for (const char* k : {"rho", "head", "p"})
        if (c.contains(k) && c.at(k) != 0) s << ' ' << k << ' ' << c.at(k);
    return s.str() + (c.value("tension_field", false) ? ", wrinkled" : "");
}

}  // namespace

TEST_CASE("exactness study: all references at growing sizes", "[.study]") {
    std::printf("| case | | 1 k | 10 k | 40 k | rate |\n|---|---|---|---|---|---|\n");
    for (const char* id : {"b6", "b4", "b6c"})
        for (const auto& c : reference::data().at(id)) {
            const std::string name = short_name(id, c);
            INFO(name);
            std::array<double, 3> depth, volume, meridian, pole;
            std::array<int, 3> nodes;
            for (const int i : {0, 1, 2}) {
                const auto e = reference::solve_bag(c, std::array{1027, 10267, 40000}[i]);
                depth[i] = e.depth, volume[i] = e.volume, meridian[i] = e.meridian, pole[i] = e.pole, nodes[i] = e.nodes;
            }
            const auto rate = [&](const auto& e) { return exponent_of(e, nodes[1], nodes[2]); };
            print_row(name, "depth", depth, rate(depth));
            print_row("", "volume", volume, rate(volume));
            if (c.contains("profile")) print_row("", "stretches along the meridian, rms", meridian, rate(meridian));
            if (id == std::string("b4")) print_row("", "stretch at the pole", pole, rate(pole));
            const bool wrinkles = c.value("tension_field", false), wet_line = c.value("head", 0.0) < 0;
            const double bound = wrinkles ? 1e-2 : id == std::string("b6c") ? 2e-4 : wet_line ? 2e-4 : 1e-4;
            CHECK(std::abs(depth[2]) < bound);
            CHECK(std::abs(volume[2]) < 2 * bound);
            if (!wrinkles && id != std::string("b6c")) CHECK(rate(volume) > 1.8);
        }
    for (const auto& c : reference::data().at("b5")) {
        const std::string name = short_name("b5", c);
        INFO(name);
        const std::array<int, 3> across{32, 100, 200};
        std::array<double, 3> depth, tension;
        for (const int i : {0, 1, 2}) {
            const auto e = reference::solve_trough(c, across[i]);
            depth[i] = e.depth, tension[i] = e.reaction;
        }
        print_row(name, "depth", depth, exponent_of(depth, across[1] * across[1], across[2] * across[2]));
        print_row("", "tension", tension, exponent_of(tension, across[1] * across[1], across[2] * across[2]));
        CHECK(std::abs(depth[2]) < 3e-5);
        CHECK(exponent_of(depth, across[1] * across[1], across[2] * across[2]) > 1.8);
    }
}
