// Cross field of one mesh and field file: energies, singularities, time and memory by step.
// Usage: bench_field MESH FIELD [ALPHA EFFORT SUBDIVISIONS]
// Each subdivision makes four faces of one and gives each its own noise of 15 degrees (fixed seed): for growth with size.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <random>

#include "arcsim/mesh/obj_io.hpp"
#include "formwork/segment/cross_field.hpp"
#include "scripts/bench/subdivide.hpp"

namespace {

double cpu_seconds() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    return static_cast<double>(u.ru_utime.tv_sec) + 1e-6 * static_cast<double>(u.ru_utime.tv_usec) +
           static_cast<double>(u.ru_stime.tv_sec) + 1e-6 * static_cast<double>(u.ru_stime.tv_usec);
}

double peak_mb() {
    rusage u{};
    getrusage(RUSAGE_SELF, &u);
    return static_cast<double>(u.ru_maxrss) / 1024;
}

void print(const char* what, const arcsim::Surface& s, const arcsim::Topology& t, const formwork::CrossField& field) {
    const auto found = formwork::find_singularities(s, t, field);
    int sum4 = 0;
    for (const auto& x : found) sum4 += x.index4;
    std::printf("%s faces=%d singularities=%zu sum4=%d turning4=%d euler=%d smoothness=%.4f alignment=%.4f energy=%.4f deviation_deg=%.3f\n",
                what, s.n_faces(), found.size(), sum4, formwork::boundary_turning4(s, t, field), t.euler_characteristic(),
                field.smoothness_energy, field.alignment_energy, field.energy, field.deviation_deg);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: bench_field MESH FIELD [ALPHA EFFORT SUBDIVISIONS]\n");
        return 2;
    }
    try {
        arcsim::Surface s = arcsim::read_obj(argv[1]).surface();
        arcsim::Topology t = arcsim::build_topology(s, argv[1]);
        auto data = formwork::read_field_file(argv[2], t, {});
        formwork::FieldParams params;
        if (argc > 3) params.alpha = std::atof(argv[3]);
        if (argc > 4) params.effort = std::atoi(argv[4]);
        const int subdivisions = argc > 5 ? std::atoi(argv[5]) : 0;
        for (int i = 0; i < subdivisions; ++i) subdivide(s, data);
        if (subdivisions > 0) {
            t = arcsim::build_topology(s);
            std::mt19937 random(1);
            std::normal_distribution<double> noise(0, 15 * std::numbers::pi / 180);
            for (auto& d : data) d.theta += noise(random);
        }
        std::vector<double> raw;
        for (const auto& d : data) raw.push_back(d.theta);
        print("input", s, t, formwork::match_cross_field(s, t, raw, data, params));
        const double cpu = cpu_seconds();
        const auto begin = std::chrono::steady_clock::now();
        const auto wall = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
        const formwork::CrossField field = formwork::smooth_cross_field(
            s, t, data, params, [&](const std::string& step, double energy, double cost) {
                std::printf("step cpu_s=%.3f wall_s=%.3f peak_mb=%.0f energy=%.4f cost=%.4f name=%s\n", cpu_seconds() - cpu, wall(),
                            peak_mb(), energy, cost, step.c_str());
            });
        const double cpu_total = cpu_seconds() - cpu, wall_total = wall();
        print("field", s, t, field);
        std::printf("total cpu_s=%.3f wall_s=%.3f peak_mb=%.0f\n", cpu_total, wall_total, peak_mb());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
