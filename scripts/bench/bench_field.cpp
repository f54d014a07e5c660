// Cross field of one mesh and field file: energies, singularities, time and memory, one line.
// Usage: bench_field MESH FIELD [alpha]
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "arcsim/mesh/obj_io.hpp"
#include "formwork/segment/cross_field.hpp"

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

void print(const char* step, const arcsim::Surface& s, const arcsim::Topology& t, const formwork::CrossField& field,
           double cpu, double wall) {
    const auto found = formwork::find_singularities(s, t, field);
    int sum4 = 0;
    for (const auto& x : found) sum4 += x.index4;
    std::printf("%s %d %zu %d %d %d %.4f %.4f %.4f %.3f %.3f %.0f\n", step, s.n_faces(), found.size(), sum4,
                formwork::boundary_turning4(s, t, field), t.euler_characteristic(), field.smoothness_energy,
                field.alignment_energy, field.energy, cpu, wall, peak_mb());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: bench_field MESH FIELD [alpha] [effort]\n");
        return 2;
    }
    try {
        const arcsim::Surface s = arcsim::read_obj(argv[1]).surface();
        const arcsim::Topology t = arcsim::build_topology(s, argv[1]);
        const auto data = formwork::read_field_file(argv[2], t, {});
        formwork::FieldParams params;
        if (argc > 3) params.alpha = std::atof(argv[3]);
        if (argc > 4) params.effort = std::atoi(argv[4]);
        std::vector<double> raw;
        for (const auto& d : data) raw.push_back(d.theta);
        print("input", s, t, formwork::match_cross_field(s, t, raw, data, params), 0, 0);
        const double cpu = cpu_seconds();
        const auto begin = std::chrono::steady_clock::now();
        const formwork::CrossField field = formwork::smooth_cross_field(s, t, data, params);
        const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        print("field", s, t, field, cpu_seconds() - cpu, wall);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
