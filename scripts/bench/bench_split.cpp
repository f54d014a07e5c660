// Where the literal spectral split (source §8.2) fails, and what the stable one gives: one line per variant.
// Usage: bench_split MESH
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <numeric>

#include "arcsim/mesh/obj_io.hpp"
#include "formwork/segment/developability.hpp"
#include "formwork/segment/spectral_split.hpp"

using namespace formwork;

namespace {

void split(const Surface& s, const Topology& t, const std::vector<double>& eta, SplitMethod method, double p, int k) {
    std::vector<int> faces(s.n_faces());
    std::iota(faces.begin(), faces.end(), 0);
    const auto begin = std::chrono::steady_clock::now();
    std::string outcome;
    try {
        const std::vector<int> part = split_faces(s, t, faces, eta, {method, p, k});
        const int n = *std::max_element(part.begin(), part.end()) + 1;
        std::vector<int> count(n, 0);
        for (int c : part) ++count[c];
        const double all = s.n_faces();
        const int tiny = static_cast<int>(std::count_if(count.begin(), count.end(), [&](int c) { return c < 0.005 * all; }));
        const std::vector<double> energy = panel_energies(t, eta, part, n);
        char text[160];
        std::snprintf(text, sizeof text, "%d | %d | %.2f%% | %.2f%% | %.2f", n, tiny, 100 * *std::max_element(count.begin(), count.end()) / all,
                      100 * *std::min_element(count.begin(), count.end()) / all, *std::max_element(energy.begin(), energy.end()));
        outcome = text;
    } catch (const std::exception& error) {
        outcome = std::string(error.what()).substr(0, 60) + " | | | |";
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("| %s | %g | %d | %s | %.2f |\n", std::string(name_of(split_method_names, method)).c_str(), p, k, outcome.c_str(), seconds);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: bench_split MESH\n");
        return 2;
    }
    try {
        const Surface s = arcsim::read_obj(argv[1]).surface();
        const Topology t = arcsim::build_topology(s, argv[1]);
        const std::vector<double> eta = covariance_eta(s, t);
        std::printf("eta sum %.5f, max %.4f\n\n", std::accumulate(eta.begin(), eta.end(), 0.0), *std::max_element(eta.begin(), eta.end()));
        std::printf("| split | p | k | parts | below 0.5%% of faces | largest | smallest | largest energy (15) | s |\n|---|---|---|---|---|---|---|---|---|\n");
        for (int k : {4, 12})
            for (const auto& [method, p] : {std::pair{SplitMethod::spectral, 1.0}, {SplitMethod::spectral, 100.0}, {SplitMethod::spectral, 1000.0},
                                            {SplitMethod::spectral_stable, 1.0}, {SplitMethod::spectral_stable, 100.0}, {SplitMethod::spectral_stable, 1000.0}})
                split(s, t, eta, method, p, k);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
