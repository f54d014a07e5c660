#include <catch2/catch.hpp>
#include <cstdio>

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

TEST_CASE("exactness study: all references at growing sizes", "[.study]") {
    std::printf("%-4s %-100s %7s %10s %10s %10s %10s %4s %4s %7s\n", "id", "case", "nodes", "depth", "volume", "reaction", "meridian",
                "it", "fact", "cpu s");
    for (const char* id : {"b6", "b4", "b6c"})
        for (const auto& c : reference::data().at(id))
            for (const int n : {1027, 10267, 40000}) {
                const auto e = reference::solve_bag(c, n);
                std::printf("%-4s %-100s %7d %10.2e %10.2e %10.2e %10.2e %4d %4d %7.2f\n", id, name_of(c).c_str(), e.nodes, e.depth,
                            e.volume, e.reaction, e.meridian, e.result.iterations, e.result.factorizations, e.result.cpu_s);
            }
    for (const auto& c : reference::data().at("b5"))
        for (const int n : {32, 100, 200}) {
            const auto e = reference::solve_trough(c, n);
            std::printf("b5   %-100s %7d %10.2e %10.2e %10.2e\n", name_of(c).c_str(), n, e.depth, e.volume, e.reaction);
        }
}
