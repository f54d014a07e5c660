#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "arcsim/base/error.hpp"
#include "formwork/segment/developability.hpp"
#include "formwork/segment/face_graph.hpp"
#include "formwork/segment/k_means.hpp"
#include "formwork/segment/spectral_split.hpp"
#include "tests/formwork/segment/sample_surfaces.hpp"

using namespace formwork;
using std::numbers::pi;

namespace {

double sum_of(const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0); }

std::vector<int> all_faces(const Surface& s) {
    std::vector<int> faces(s.n_faces());
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
}

double eta_sum(const Surface& s) { return sum_of(covariance_eta(s, arcsim::build_topology(s))); }

bool is_connected(const Topology& t, const std::vector<int>& part, int label) {
    std::vector<char> seen(part.size(), 0);
    std::vector<int> stack;
    int count = 0, members = 0;
    for (std::size_t f = 0; f < part.size(); ++f)
        if (part[f] == label && members++ == 0) stack.push_back(static_cast<int>(f)), seen[f] = 1;
    while (!stack.empty()) {
        const int f = stack.back();
        stack.pop_back();
        ++count;
        for (int k = 0; k < 3; ++k)
            if (const int g = t.neighbour(f, k); g >= 0 && part[g] == label && !seen[g]) seen[g] = 1, stack.push_back(g);
    }
    return count == members;
}

}  // namespace

TEST_CASE("eta vanishes on flat, cylindrical and creased sheets") {
    CHECK(eta_sum(samples::grid(6, 6, 0.1)) == Approx(0).margin(1e-12));
    CHECK(eta_sum(samples::tube(24, 8, 1, 2)) == Approx(0).margin(1e-12));
    Surface folded = samples::grid(6, 6, 0.1);
    for (auto& x : folded.x)
        if (x[0] > 0.31) x[2] = x[0] - 0.3;
    CHECK(eta_sum(folded) == Approx(0).margin(1e-12));
}

TEST_CASE("eta of a sphere sums to 1.16 times its curvature at every resolution and size") {
    CHECK(eta_sum(samples::icosphere(5)) == Approx(14.59192).epsilon(1e-6));   // computed elsewhere from its file
    const double fine = eta_sum(samples::icosphere(4));
    CHECK(fine == Approx(1.16 * 4 * pi).epsilon(0.005));
    CHECK(eta_sum(samples::icosphere(3)) == Approx(fine).epsilon(0.005));
    Surface large = samples::icosphere(4);
    for (auto& x : large.x) x *= 7;
    CHECK(eta_sum(large) == Approx(fine).epsilon(1e-9));
}

TEST_CASE("only nodes inside a panel count for its energy") {
    const Surface s = samples::icosphere(3);
    const Topology t = arcsim::build_topology(s);
    const std::vector<double> eta = covariance_eta(s, t);
    std::vector<int> panel(s.n_faces()), north;
    for (int f = 0; f < s.n_faces(); ++f) {
        panel[f] = arcsim::face_centroid(s, f)[2] > 0 ? 1 : 0;
        if (panel[f] == 1) north.push_back(f);
    }
    const std::vector<double> energy = panel_energies(t, eta, panel, 2);
    CHECK(energy[1] == Approx(patch_energy(t, eta, north)));
    CHECK(energy[0] + energy[1] < sum_of(eta));
    CHECK(energy[0] + energy[1] > 0.85 * sum_of(eta));
}

TEST_CASE("a cap's stretch follows from its energy") {
    // One of eight caps of a sphere: curvature 4 pi / 8, measured +7/-6 % when flattened conformally.
    CHECK(stretch_for_energy(1.16 * 4 * pi / 8) == Approx(0.0625).epsilon(0.01));
    CHECK(energy_for_stretch(0.05) == Approx(1.46).epsilon(0.01));
    CHECK(stretch_for_energy(energy_for_stretch(0.03)) == Approx(0.03));
}

TEST_CASE("low modes of a ring come in pairs with known eigenvalues") {
    const int n = 30;
    WeightedGraph ring{n, {}};
    for (int i = 0; i + 1 < n; ++i) ring.links.push_back({i, i + 1, 1.0});
    ring.links.push_back({0, n - 1, 1.0});
    const LowModes plain = low_modes(ring, 3, false), normalised = low_modes(ring, 3, true);
    CHECK(plain.value[0] == Approx(0).margin(1e-7));
    for (int k : {1, 2}) {
        CHECK(plain.value[k] == Approx(2 - 2 * std::cos(2 * pi / n)).epsilon(1e-6));
        CHECK(normalised.value[k] == Approx(1 - std::cos(2 * pi / n)).epsilon(1e-6));
    }
}

TEST_CASE("k-means finds separate heaps") {
    std::vector<double> points;
    for (int i = 0; i < 30; ++i) points.insert(points.end(), {i % 3 * 10.0 + 0.01 * i, i % 3 == 1 ? 5.0 : 0.0});
    const std::vector<int> label = k_means(points, 30, 2, 3);
    for (int i = 3; i < 30; ++i) CHECK(label[i] == label[i % 3]);
    CHECK(std::set<int>(label.begin(), label.end()).size() == 3);
}

TEST_CASE("the stable split gives connected parts of fair size whatever the contrast") {
    const Surface s = samples::slab_with_holes(1, 5);
    const Topology t = arcsim::build_topology(s);
    const std::vector<double> eta = covariance_eta(s, t);
    for (double p : {0.1, 1.0, 100.0, 1e4})
        for (int k : {2, 4}) {
            SplitParams params;
            params.p = p;
            params.k = k;
            const std::vector<int> part = split_faces(s, t, all_faces(s), eta, params);
            const int n = *std::max_element(part.begin(), part.end()) + 1;
            INFO("p " << p << ", k " << k << ", parts " << n);
            CHECK(n >= k);
            std::vector<int> count(n, 0);
            for (int c : part) ++count[c];
            for (int c = 0; c < n; ++c) {
                CHECK(is_connected(t, part, c));
                CHECK(count[c] > 0.01 * s.n_faces());
            }
        }
}

TEST_CASE("the literal split cuts a dumbbell at its neck and fails by name when its weights fall apart") {
    // Two boxes joined by a bar: with weights near one the plain Laplacian cuts the bar.
    const Surface s = samples::cubes(7, 2, 2, 3, [](int i, int j, int k) { return i < 2 || i > 4 || (j == 0 && k == 0); });
    const Topology t = arcsim::build_topology(s);
    const std::vector<double> eta = covariance_eta(s, t);
    SplitParams params;
    params.method = SplitMethod::spectral;
    params.p = 0.1;
    const std::vector<int> part = split_faces(s, t, all_faces(s), eta, params);
    REQUIRE(*std::max_element(part.begin(), part.end()) == 1);
    const auto part_at = [&](double x) {
        for (int f = 0; f < s.n_faces(); ++f)
            if (std::abs(arcsim::face_centroid(s, f)[0] - x) < 0.2) return part[f];
        return -1;
    };
    CHECK(part_at(0.5) != part_at(6.5));
    params.p = 1e6;
    CHECK_THROWS_AS(split_faces(s, t, all_faces(s), eta, params), arcsim::NumericalError);
}

TEST_CASE("a patch of two faces is split into its faces") {
    const Surface s = samples::grid(1, 1, 1);
    const Topology t = arcsim::build_topology(s);
    CHECK(split_faces(s, t, {0, 1}, covariance_eta(s, t), {}) == std::vector<int>{0, 1});
}
