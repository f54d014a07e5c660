#include "arcsim/force/bend_force.hpp"
#include "arcsim/force/stretch_force.hpp"
#include "tests/arcsim/cloth_fixture.hpp"
#include "tests/check_derivatives.hpp"

using namespace arcsim;

TEST_CASE("the stretch force's tangents pass the derivative check in every state") {
    for (const Sampling sampling : {Sampling::exact, Sampling::arcsim}) {
        const Patch patch;
        StretchForce force(patch.stretch_faces(0), {std::make_shared<StiffnessTable>(woven_rows(), sampling)});
        for (const auto& [name, state] : patch.states()) {
            // The tolerance leaves room for the kink of k at rest, which differences straddle.
            INFO(name << " sampling " << (sampling == Sampling::exact ? "exact" : "arcsim"));
            check_derivatives(force, state, patch.faces, {.step = 1e-8, .tolerance = 1e-4});
            check_invariants(force, state);
        }
    }
}

TEST_CASE("with its table held, the stretch force is the gradient of the frozen energy") {
    // A constant table: freezing changes nothing.
    const Patch patch;
    StretchForce force(patch.stretch_faces(0), {std::make_shared<StiffnessTable>(constant_rows(), Sampling::arcsim)});
    for (const auto& [name, state] : patch.states()) {
        VectorXd g = VectorXd::Zero(state.x.size()), difference(state.x.size());
        force.add_gradient(state, g);
        for (int d = 0; d < state.x.size(); ++d) {
            State up = state, down = state;
            up.x[d] += 1e-7;
            down.x[d] -= 1e-7;
            difference[d] = (force.frozen_energy(up) - force.frozen_energy(down)) / 2e-7;
        }
        INFO(name);
        CHECK((g - difference).cwiseAbs().maxCoeff() <= 1e-6 * (1 + g.cwiseAbs().maxCoeff()));
    }
}

TEST_CASE("there is no membrane force at rest and no bending moment in a flat sheet") {
    const Patch patch;
    const State rest = patch.states().at("rest");
    StretchForce stretch(patch.stretch_faces(0), {std::make_shared<StiffnessTable>(woven_rows(), Sampling::arcsim)});
    BendForce bend(patch.hinges(0), {BendingTable(bending_rows())}, rest.x);
    VectorXd g = VectorXd::Zero(rest.x.size());
    stretch.add_gradient(rest, g);
    CHECK(g.cwiseAbs().maxCoeff() <= 1e-9);
    bend.add_gradient(rest, g);
    CHECK(g.cwiseAbs().maxCoeff() <= 1e-9);
}

namespace {

/// Bending as the converged methods have it: the stiffness is that of the angle at hand.
struct FollowingBend final : Force {
    mutable BendForce bend;

    explicit FollowingBend(const BendForce& b) : bend(b) { bend.follow_angle(); }
    std::string_view name() const override { return "bend that follows"; }
    std::optional<double> energy(const State&) const override { return std::nullopt; }
    void add_gradient(const State& s, VectorXd& g) const override {
        bend.refresh(s.x);
        bend.add_gradient(s, g);
    }
    void add_hessian(const State& s, Tangent t, BlockMatrix& H) const override {
        bend.refresh(s.x);
        bend.add_hessian(s, t, H);
    }
    void list_pairs(std::vector<std::array<int, 2>>& pairs) const override { bend.list_pairs(pairs); }
    void bind(const BlockPattern& pattern) override { bend.bind(pattern); }
};

}  // namespace

TEST_CASE("the bending force's tangents pass the derivative check in every state") {
    const Patch patch;
    for (const auto& [name, state] : patch.states()) {
        BendForce force(patch.hinges(0), {BendingTable(bending_rows())}, state.x);
        INFO(name);
        check_derivatives(force, state, patch.faces, {.step = 1e-7, .tolerance = 1e-5});
        check_invariants(force, state);
        FollowingBend following{force};
        check_derivatives(following, state, patch.faces, {.step = 1e-8, .tolerance = 1e-4});
        check_invariants(following, state);
    }
}

TEST_CASE("theta is positive when the sheet folds towards the side of its normals") {
    // Normals point to +z; both wings bend up.
    const Hinge hinge{{0, 1, 2, 3}, 1, 1, 0, 0, 1, {}, {}};
    VectorXd x(12);
    x << 0, 0, 0, 0, 1, 0, -1, 0.5, 0.3, 1, 0.5, 0.3;   // side 0 runs 0, 1, 2: counter-clockwise
    BendForce force({hinge}, {BendingTable(bending_rows())}, x);
    CHECK(force.lagged_angles()[0] == Approx(2 * std::atan(0.3)));
    x[8] = x[11] = -0.3;
    force.refresh(x);
    CHECK(force.lagged_angles()[0] == Approx(-2 * std::atan(0.3)));
}

TEST_CASE("damping and the step's matrix are the definite tangent times h (h + beta) in every state") {
    const Patch patch;
    const double beta = 0.03, h = 0.01;
    for (const auto& [name, state] : patch.states()) {
        StretchForce stretch(patch.stretch_faces(beta), {std::make_shared<StiffnessTable>(woven_rows(), Sampling::arcsim)});
        BendForce bend(patch.hinges(beta), {BendingTable(bending_rows())}, state.x);
        for (ClothForce* force : {static_cast<ClothForce*>(&stretch), static_cast<ClothForce*>(&bend)}) {
            std::vector<std::array<int, 2>> pairs;
            force->list_pairs(pairs);
            const BlockPattern pattern(static_cast<int>(state.x.size()) / 3, patch.faces, pairs);
            force->bind(pattern);
            BlockMatrix A(pattern), H(pattern), D(pattern);
            VectorXd f = VectorXd::Zero(state.x.size()), g = f;
            force->add_step(state, h, f, A);
            force->add_gradient_and_hessian(state, Tangent::definite, g, H);
            force->add_damping(state, D);
            INFO(name << " " << force->name());
            CHECK((f + g).norm() <= 1e-12 * (g.norm() + 1e-9));
            CHECK((A.dense() - h * (h + beta) * H.dense()).norm() <= 1e-12 * A.dense().norm());
            CHECK((D.dense() - beta * H.dense()).norm() <= 1e-12 * D.dense().norm());
        }
    }
}

TEST_CASE("the derivative checker notices a wrong tangent", "[!shouldfail]") {
    struct Wrong final : Force {
        std::string_view name() const override { return "wrong"; }
        std::optional<double> energy(const State& s) const override { return 0.5 * s.x.squaredNorm(); }
        void add_gradient(const State& s, VectorXd& g) const override { g += s.x; }
        void add_hessian(const State& s, Tangent, BlockMatrix& H) const override {
            for (int i = 0; i < s.x.size() / 3; ++i) H.add_to_diagonal(i, 1.1);
        }
    } force;
    const Patch patch;
    check_derivatives(force, patch.states().at("rest"), patch.faces);
}

TEST_CASE("weight and springs are gradients of their energies") {
    const Patch patch;
    for (const auto& [name, state] : patch.states()) {
        GravityForce gravity(VectorXd::Constant(static_cast<int>(patch.u.size()), 0.01), {1, 2, -9.81});
        check_derivatives(gravity, state, patch.faces, {.step = 1e-5});
        SpringForce springs;
        springs.reserve_pairs({{0, 15}});
        springs.set({{3, 200, {0.1, 0, 0}}, {5, 40, {0, 0.2, 0}}}, {{0, 15, 30.0}});
        check_derivatives(springs, state, patch.faces, {.step = 1e-5});
        springs.set({}, {{0, 15, 30.0}});   // between two nodes of the cloth: internal, unlike springs to fixed points
        check_invariants(springs, state);
    }
}

TEST_CASE("the angles that a step has found are those that a refresh at its positions finds") {
    const Patch patch;
    const State rest = patch.states().at("rest");
    for (const auto& [name, state] : patch.states()) {
        BendForce kept(patch.hinges(0), {BendingTable(bending_rows())}, rest.x), refreshed = kept;
        std::vector<std::array<int, 2>> pairs;
        kept.list_pairs(pairs);
        const BlockPattern pattern(static_cast<int>(state.x.size()) / 3, patch.faces, pairs);
        kept.bind(pattern);
        BlockMatrix A(pattern);
        VectorXd f = VectorXd::Zero(state.x.size());
        kept.add_step(state, 0.01, f, A);
        kept.keep_step_angles();
        refreshed.refresh(state.x);
        INFO(name);
        for (std::size_t i = 0; i < kept.lagged_angles().size(); ++i)
            CHECK(kept.lagged_angles()[i] == Approx(refreshed.lagged_angles()[i]).margin(1e-13));
    }
}

TEST_CASE("the wind's derivatives by velocity and position are the limits of its differences, in every state") {
    const Patch patch;
    std::vector<WindForce::Face> faces;
    for (const StretchFace& f : patch.stretch_faces(0)) faces.push_back({f.node, f.area});
    const BlockPattern pattern(static_cast<int>(patch.u.size()), patch.faces);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> speed(-3, 3);
    for (auto [name, s] : patch.states())
        for (const double drag : {0.0, 0.3})
            for (const bool moves : {false, true}) {
                for (double& v : s.v) v = moves ? speed(random) : 0;
                WindForce wind(faces, 1.2, drag, {4, -1, 2}, s.x);
                wind.bind(pattern);
                BlockMatrix W(pattern);
                wind.add_velocity_hessian(s, W);
                const MatrixXd dense = W.dense();
                const auto gradient = [&](const State& at) {
                    VectorXd g = VectorXd::Zero(at.x.size());
                    wind.add_gradient(at, g);
                    return g;
                };
                INFO(name << " drag " << drag << (moves ? ", moving" : ", at rest"));
                for (int d = 0; d < s.v.size(); ++d) {
                    State up = s, down = s;
                    up.v[d] += 1e-6;
                    down.v[d] -= 1e-6;
                    CHECK(((gradient(up) - gradient(down)) / 2e-6 - dense.col(d)).cwiseAbs().maxCoeff() <= 1e-6 * dense.cwiseAbs().maxCoeff());
                }
                // It never drives: symmetric, without negative eigenvalue; lagged normals do not depend on x.
                CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(dense).eigenvalues()[0] >= -1e-12);
                check_derivatives(wind, s, patch.faces, {.step = 1e-7});
                wind.follow_normal();
                check_derivatives(wind, s, patch.faces, {.step = 1e-8, .tolerance = 1e-5});
            }
}

TEST_CASE("the wind turns with the cloth: all rotated together, so is its force") {
    const Patch patch;
    std::vector<WindForce::Face> faces;
    for (const StretchFace& f : patch.stretch_faces(0)) faces.push_back({f.node, f.area});
    const Matrix3d R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -3).normalized()).toRotationMatrix();
    for (auto [name, s] : patch.states()) {
        s.v = VectorXd::LinSpaced(s.x.size(), -2, 3);
        State turned = s;
        for (int i = 0; i < s.x.size(); i += 3) {
            turned.x.segment<3>(i) = R * s.x.segment<3>(i) + Vector3d(1, 2, 3);
            turned.v.segment<3>(i) = R * s.v.segment<3>(i);
        }
        const Vector3d air(4, -1, 2);
        VectorXd g = VectorXd::Zero(s.x.size()), g_turned = g;
        WindForce(faces, 1.2, 0.3, air, s.x).add_gradient(s, g);
        WindForce(faces, 1.2, 0.3, R * air, turned.x).add_gradient(turned, g_turned);
        for (int i = 0; i < g.size(); i += 3) g_turned.segment<3>(i) = R.transpose() * g_turned.segment<3>(i);
        INFO(name);
        CHECK((g_turned - g).norm() <= 1e-12 * g.norm());
    }
}

TEST_CASE("still air does not move a cloth at rest, and head wind pushes with the density times the area") {
    const Patch patch;
    State s = patch.states().at("rest");
    std::vector<WindForce::Face> faces;
    double area = 0;
    for (const StretchFace& f : patch.stretch_faces(0)) faces.push_back({f.node, f.area}), area += f.area;
    VectorXd g = VectorXd::Zero(s.x.size());
    WindForce(faces, 1.2, 0.3, {0, 0, 0}, s.x).add_gradient(s, g);
    CHECK(g.norm() == 0);
    WindForce(faces, 1.2, 0.3, {0, 0, 5}, s.x).add_gradient(s, g);
    double lift = 0;
    for (int i = 2; i < g.size(); i += 3) lift -= g[i];
    CHECK(lift == Approx(1.2 * area * 25));
}
