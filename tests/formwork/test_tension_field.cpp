#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "formwork/fabric/tensor_law.hpp"
#include "reference_cases.hpp"

using namespace formwork;

namespace {

arcsim::StretchingRows constant_rows(double kuu, double kuv, double kvv, double kss) {
    arcsim::StretchingRows rows;
    rows.fill({kuu, kuv, kvv, kss});
    return rows;
}

arcsim::StretchingRows table_rows() {
    arcsim::StretchingRows rows;
    rows[0] = {36000, 1000, 64000, 2000};
    for (int i = 1; i < 6; ++i) rows[i] = {100000. - 5000 * i, 5000. + 500 * i, 160000. + 10000 * i, 6000. + 100 * i};
    return rows;
}

std::vector<std::shared_ptr<MembraneLaw>> relaxed_laws() {
    std::vector<std::shared_ptr<MembraneLaw>> laws;
    for (IsotropicLaw law : {IsotropicLaw::secant, IsotropicLaw::separable}) {
        MaterialParams p;
        p.law = law;
        p.rest = {300, 40, 300, 1};
        p.max = {600, 50, 600, 1};
        laws.push_back(make_membrane_law(p));
    }
    const auto exact = arcsim::Sampling::exact;
    laws.push_back(std::make_shared<TensorMembrane>(constant_rows(450000, 25, 500000, 10800), exact, 0.5, Compression::tension_field));
    laws.push_back(std::make_shared<TensorMembrane>(constant_rows(300, 90, 800, 150), exact, 0.5, Compression::tension_field));
    laws.push_back(std::make_shared<TensorMembrane>(table_rows(), exact, 0.5, Compression::tension_field));
    return laws;
}

Vector3d random_strain(std::mt19937& random) {
    std::uniform_real_distribution<double> u(-0.25, 0.25);
    return {u(random), u(random), 0.5 * u(random)};
}

}  // namespace

TEST_CASE("relaxed tangents are the derivative of the stress, in every state") {
    std::mt19937 random(4);
    int states[3] = {0, 0, 0}, straddling = 0;
    for (const auto& law : relaxed_laws())
        for (int i = 0; i < 2000; ++i) {
            const Vector3d e = random_strain(random);
            const FaceStress at = evaluate_one(*law, e);
            const double h = 1e-7;
            arcsim::Matrix3d D;
            bool switches = false;
            for (int k = 0; k < 3; ++k) {
                Vector3d a = e, b = e;
                a[k] += h;
                b[k] -= h;
                switches = switches || law->state(a) != law->state(e) || law->state(b) != law->state(e);
                D.col(k) = (evaluate_one(*law, a).S - evaluate_one(*law, b).S) / (2 * h) * (k == 2 ? 0.5 : 1);
            }
            const auto kink = [&](double strain) { return std::abs(std::sqrt(1 + 2 * strain) - 7. / 6) < 1e-5 || std::abs(strain) < 1e-5; };
            const double m = 0.5 * (e[0] + e[1]), R = std::hypot(0.5 * (e[0] - e[1]), e[2]);
            if (switches || kink(m + R) || kink(m - R)) {
                ++straddling;
                continue;
            }
            ++states[static_cast<int>(law->state(e))];
            INFO(e.transpose() << " state " << to_string(law->state(e)));
            REQUIRE((D - at.C).norm() < 1e-5 * (at.C.norm() + 1e-3 * law->rest_stiffness()));
        }
    REQUIRE(states[0] > 500);
    REQUIRE(states[1] > 500);
    REQUIRE(states[2] > 500);
    REQUIRE(straddling < 100);
}

TEST_CASE("relaxed stresses never press, and are uniaxial where a face is wrinkled") {
    std::mt19937 random(5);
    for (const auto& law : relaxed_laws())
        for (int i = 0; i < 2000; ++i) {
            const Vector3d e = random_strain(random), S = evaluate_one(*law, e).S;
            const double m = 0.5 * (S[0] + S[1]), R = std::hypot(0.5 * (S[0] - S[1]), S[2]);
            INFO(e.transpose());
            REQUIRE(m - R > -1e-9 * law->rest_stiffness());
            if (law->state(e) == FaceState::wrinkled) REQUIRE(std::abs(m - R) < 1e-9 * law->rest_stiffness());
            if (law->state(e) == FaceState::slack) REQUIRE(S.norm() == 0);
        }
}

TEST_CASE("relaxed energies are convex, and their stress is their gradient") {
    std::mt19937 random(6);
    for (const auto& law : relaxed_laws()) {
        if (!law->has_potential()) continue;
        for (int i = 0; i < 2000; ++i) {
            const Vector3d a = random_strain(random), b = random_strain(random);
            const auto W = [&](const Vector3d& e) { return evaluate_one(*law, e, Want::energy).psi; };
            const double t = 0.3, convex = (1 - t) * W(a) + t * W(b) - W((1 - t) * a + t * b);
            REQUIRE(convex > -1e-12 * (W(a) + W(b) + 1e-12));
            const Vector3d S = evaluate_one(*law, a, Want::stress).S;
            for (int k = 0; k < 3; ++k) {
                Vector3d p = a, m = a;
                p[k] += 1e-6;
                m[k] -= 1e-6;
                const double slope = (W(p) - W(m)) / 2e-6;
                REQUIRE(slope == Approx(S[k] * (k == 2 ? 2 : 1)).margin(2e-6 * law->rest_stiffness()));
            }
        }
    }
}

TEST_CASE("the orthotropic relaxed energy is the minimum over all wrinkle strains") {
    std::mt19937 random(7);
    const TensorMembrane law(constant_rows(300, 90, 800, 150), arcsim::Sampling::exact, 0.5, Compression::tension_field);
    const TensorMembrane full(constant_rows(300, 90, 800, 150), arcsim::Sampling::exact, 0.5, Compression::full);
    int wrinkled = 0;
    for (int i = 0; i < 300; ++i) {
        const Vector3d e = random_strain(random);
        if (law.state(e) != FaceState::wrinkled) continue;
        ++wrinkled;
        // rank-one wrinkle strains p n n^T suffice; the energy is quadratic in p
        double best = 1e300, best_a = 0;
        const auto scan = [&](double from, double to, int n) {
            for (int j = 0; j <= n; ++j) {
                const double a = from + (to - from) * j / n, c = std::cos(a), s = std::sin(a);
                const Vector3d normal(s * s, c * c, -s * c);
                const auto W = [&](double p) { return evaluate_one(full, e + p * normal, Want::energy).psi; };
                const double w0 = W(0), w1 = W(0.1), w2 = W(0.2), q = 50 * (w2 - 2 * w1 + w0), l = 10 * (w1 - w0) - 0.1 * q;
                if (const double w = W(std::max(0.0, -l / (2 * q))); w < best) best = w, best_a = a;
            }
        };
        scan(0, std::numbers::pi, 1000);
        const double middle = best_a;
        scan(middle - 0.004, middle + 0.004, 1000);
        CAPTURE(e.transpose());
        const double psi = evaluate_one(law, e, Want::energy).psi;
        REQUIRE(psi <= best * (1 + 1e-9));
        REQUIRE(psi >= best * (1 - 1e-5) - 1e-9);
    }
    REQUIRE(wrinkled > 50);
}

TEST_CASE("the fabric's own strain is the face's plus a wrinkle, and carries the same stress") {
    std::mt19937 random(8);
    for (const auto& law : relaxed_laws())
        for (int i = 0; i < 2000; ++i) {
            const Vector3d e = random_strain(random), own = law->fabric_strain(e), P = own - e;
            const FaceState state = law->state(e);
            INFO(e.transpose() << " state " << to_string(state));
            if (state == FaceState::slack) REQUIRE(own.norm() == 0);
            if (state == FaceState::taut) REQUIRE(P.norm() == 0);
            if (state != FaceState::wrinkled) continue;
            REQUIRE(P[0] + P[1] >= 0);   // positive semidefinite, of rank one
            REQUIRE(P[0] * P[1] - P[2] * P[2] == Approx(0).margin(1e-12));
            // Where stiffness is constant, or read at the larger principal strain alone, it is the same law's stress.
            if (!law->has_potential()) continue;
            REQUIRE((evaluate_one(*law, own).S - evaluate_one(*law, e).S).norm() < 1e-9 * law->rest_stiffness());
        }
}

TEST_CASE("the exact gradient of (5) has two stable stretches under one load: why it is not offered") {
    // Uniaxial, table 2 as `isotropic`: W = k(lambda) eps² / 2, nominal tension N = dW/dlambda; k_uv = 2 hardly counts.
    const auto k = [](double l) { return 300 + 300 * std::min(1.0, (l - 1) * 6); };
    const auto tension = [&](double l, double slope) {
        const double eps = 0.5 * (l * l - 1);
        return k(l) * eps * l + 0.5 * slope * eps * eps;
    };
    const double end = 7. / 6, before = tension(end, 1800), after = tension(end, 0);
    REQUIRE(after / before == Approx(1 - 0.188).margin(1e-3));                       // the stress drops where the table ends
    REQUIRE(tension(1.158, 1800) == Approx(tension(1.182, 0)).epsilon(1e-2));       // one load, two stretches
    const double h = 1e-6;                                                          // both stable: tension rises with stretch
    REQUIRE(tension(1.158 + h, 1800) > tension(1.158, 1800));
    REQUIRE(tension(1.182 + h, 0) > tension(1.182, 0));
    // The two laws that are offered rise through the table's end.
    for (const IsotropicLaw law : {IsotropicLaw::secant, IsotropicLaw::separable}) {
        MaterialParams p;
        p.rest = {300, 2, 300, 298};
        p.max = {600, 2, 600, 598};
        p.law = law;
        const auto offered = make_membrane_law(p);
        double last = 0;
        for (double l = 1.001; l < 1.3; l += 1e-3) {
            const Vector3d S = evaluate_one(*offered, {0.5 * (l * l - 1), 0, 0}, Want::stress).S;
            REQUIRE(l * S[0] > last);
            last = l * S[0];
        }
    }
}

TEST_CASE("homogeneous patches carry the exact forces, on any triangles (B1)") {
    // Forces per rest width of a stretched square, by the law alone: x = F u on every face.
    for (const auto& c : reference::data().at("b1").at("stretch")) {
        const auto law = make_membrane_law(reference::material(c.at("mat"), c.at("law")));
        const double l = c.at("lam");
        const auto nominal = [&](double lu, double lv) {
            const Vector3d S = evaluate_one(*law, {0.5 * (lu * lu - 1), 0.5 * (lv * lv - 1), 0}).S;
            return arcsim::Vector2d(lu * S[0], lv * S[1]);
        };
        INFO(c.dump());
        const double scale = std::abs(double(c.at("biax_Puu")));
        CHECK(nominal(l, l)[0] == Approx(double(c.at("biax_Puu"))).epsilon(1e-10));
        CHECK(nominal(l, l)[1] == Approx(double(c.at("biax_Pvv"))).epsilon(1e-10));
        CHECK(nominal(l, 1)[0] == Approx(double(c.at("planar_Puu"))).epsilon(1e-10));
        CHECK(nominal(l, 1)[1] == Approx(double(c.at("planar_Pvv"))).epsilon(1e-10));
        CHECK(nominal(l, c.at("uni_u_l2"))[0] == Approx(double(c.at("uni_u_P"))).epsilon(1e-10));
        CHECK(std::abs(nominal(l, c.at("uni_u_l2"))[1]) < 1e-10 * scale);
    }
}

TEST_CASE("a stretched patch finds its free width and its force by equilibrium (B1)") {
    for (const auto& c : reference::data().at("b1").at("stretch")) {
        if (c.at("mat") == "woven" && c.at("law") == "secant") continue;
        shapes::Bag b = shapes::square(0.2, 6);
        shapes::jiggle(b.surface.x, b.held, 0.006, 8);
        for (auto& x : b.surface.x) x[2] = 0;
        EquilibriumProblem p;
        p.rest = b.surface;
        p.material = reference::material(c.at("mat"), c.at("law"));
        for (const auto& t : p.rest.faces) {
            FlatTriangle flat;
            for (int k = 0; k < 3; ++k) flat[k] = {-p.rest.x[t[k]][0], p.rest.x[t[k]][1]};   // seen from below
            p.flat.push_back(flat);
        }
        p.start = p.rest.x;
        p.fixed.assign(3 * p.rest.x.size(), 0);
        const double l = c.at("lam");
        for (std::size_t i = 0; i < p.start.size(); ++i) {
            const bool left = std::abs(p.rest.x[i][0] + 0.1) < 1e-9, right = std::abs(p.rest.x[i][0] - 0.1) < 1e-9;
            p.start[i][0] *= l;
            if (left || right) p.fixed[3 * i] = 1;                  // rollers: free to contract
            p.fixed[3 * i + 2] = 1;
            if (std::abs(p.rest.x[i][1] + 0.1) < 1e-9) p.fixed[3 * i + 1] = 1;
        }
        INFO(c.dump());
        p.solver.tolerance = 1e-12;
        const EquilibriumResult r = find_equilibrium(p);
        double force = 0;
        for (std::size_t f = 0; f < r.strain.size(); ++f) {
            CHECK(r.strain[f].lambda1 == Approx(l).epsilon(1e-10));
            CHECK(r.strain[f].lambda2 == Approx(double(c.at("uni_u_l2"))).epsilon(1e-10));
            force += r.strain[f].tension1 * r.strain[f].lambda1 / static_cast<double>(r.strain.size());
        }
        CHECK(force == Approx(double(c.at("uni_u_P"))).epsilon(1e-10));
    }
}
