#include <catch2/catch.hpp>
#include <random>

#include "arcsim/base/error.hpp"
#include "arcsim/solve/fill_order.hpp"
#include "arcsim/solve/gmres.hpp"
#include "arcsim/solve/linear_solver.hpp"
#include "arcsim/solve/pcg.hpp"

using namespace arcsim;

namespace {

/// An n x n grid of nodes, two triangles per cell.
std::vector<Triangle> grid_faces(int n) {
    std::vector<Triangle> faces;
    for (int i = 0; i + 1 < n; ++i)
        for (int j = 0; j + 1 < n; ++j) {
            const int a = i * n + j;
            faces.push_back({a, a + n, a + 1});
            faces.push_back({a + 1, a + n, a + n + 1});
        }
    return faces;
}

/// A random matrix, symmetric part positive definite, with an antisymmetric part when `general`.
BlockMatrix random_matrix(const BlockPattern& p, const std::vector<Triangle>& faces, BlockMatrix::Kind kind) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto block = [&] { return Matrix3d(Matrix3d::NullaryExpr([&] { return uniform(random); })); };
    BlockMatrix A(p, kind);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k) A.add(p.face_slots(static_cast<int>(f))[k], block(), block());
    for (int i = 0; i < p.n_nodes(); ++i) {
        A.add_diagonal(i, block());
        A.add_to_diagonal(i, 30);
    }
    return A;
}

VectorXd random_vector(int n) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    return VectorXd::NullaryExpr(n, [&] { return uniform(random); });
}

}  // namespace

TEST_CASE("a block matrix holds what was added, whatever the order of its nodes") {
    const std::vector<Triangle> faces{{0, 1, 2}, {2, 1, 3}};
    for (const std::vector<int>& order : {std::vector<int>{}, std::vector<int>{3, 1, 0, 2}}) {
        const BlockPattern p(4, faces, {{{0, 3}}}, order);
        BlockMatrix A(p, BlockMatrix::Kind::general);
        MatrixXd D = MatrixXd::Zero(12, 12);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> uniform(-1, 1);
        const auto block = [&] { return Matrix3d(Matrix3d::NullaryExpr([&] { return uniform(random); })); };
        for (const auto& [i, j] : {std::array{0, 1}, {1, 3}, {3, 0}, {2, 0}, {1, 2}}) {
            const Matrix3d K = block(), L = block();
            A.add(p.slot(i, j), K, L);
            D.block<3, 3>(3 * i, 3 * j) += K;
            D.block<3, 3>(3 * j, 3 * i) += L;
        }
        for (int i = 0; i < 4; ++i) {
            const Matrix3d K = block();
            A.add_diagonal(i, K);
            D.block<3, 3>(3 * i, 3 * i) += K;
        }
        REQUIRE((A.dense() - D).norm() < 1e-14);
        VectorXd y;
        A.multiply_symmetric(VectorXd::Ones(12), y);
        REQUIRE((y - 0.5 * (D + D.transpose()) * VectorXd::Ones(12)).norm() < 1e-13);
        REQUIRE((A.diagonal() - D.diagonal()).norm() < 1e-14);

        std::vector<char> held(12, 0);
        held[4] = held[9] = 1;
        const FixedDofs fixed(p, held);
        A.fix(fixed);
        for (int d : {4, 9}) {
            D.row(d).setZero();
            D.col(d).setZero();
            D(d, d) = 1;
        }
        REQUIRE((A.dense() - D).norm() < 1e-14);
        REQUIRE(fixed.n_free() == 10);
    }
    const BlockPattern p(4, faces);
    REQUIRE_THROWS_AS(p.slot(0, 3), std::out_of_range);
}

TEST_CASE("every linear solver agrees with Eigen's, in every fill order") {
    constexpr int n = 17;
    const std::vector<Triangle> faces = grid_faces(n);
    const VectorXd b = random_vector(3 * n * n);
    for (FillOrder order : {FillOrder::natural, FillOrder::amd, FillOrder::metis}) {
        const BlockPattern p(n * n, faces, {}, fill_order(n * n, faces, {}, order));
        BlockMatrix A = random_matrix(p, faces, BlockMatrix::Kind::symmetric);
        std::vector<char> held(3 * n * n, 0);
        held[5] = held[100] = 1;
        A.fix(FixedDofs(p, held));
        const auto oracle = make_linear_solver(SolverKind::eigen_ldlt);
        oracle->factorize(A);
        const VectorXd x = oracle->solve(b);
        VectorXd Ax;
        A.multiply(x, Ax);
        REQUIRE((Ax - b).norm() < 1e-10);
        for (SolverKind kind : {SolverKind::cholmod, SolverKind::umfpack, SolverKind::supernodal, SolverKind::mixed}) {
            const auto solver = make_linear_solver(kind);
            solver->analyze(p);
            for (int repeat = 0; repeat < 2; ++repeat) {
                solver->factorize(A);
                REQUIRE((solver->solve(b) - x).norm() < 1e-11 * x.norm());
            }
        }
    }
}

TEST_CASE("conjugate gradients on an incomplete factor solve to their tolerance, and find out that a matrix is indefinite") {
    constexpr int n = 30;
    const std::vector<Triangle> faces = grid_faces(n);
    const BlockPattern p(n * n, faces, {}, fill_order(n * n, faces));
    BlockMatrix A = random_matrix(p, faces, BlockMatrix::Kind::symmetric);
    const VectorXd x = random_vector(3 * n * n);
    VectorXd b;
    A.multiply(x, b);
    const auto solver = make_linear_solver(SolverKind::pcg);
    solver->factorize(A);
    CHECK((solver->solve(b) - x).norm() < 1e-9 * x.norm());
    A.add_to_diagonal(77, -60);
    CHECK_FALSE(solver->try_factorize(A));
    CHECK(solver->breakdown().node == 77);
    CHECK_THROWS_AS(solver->solve(b), NumericalError);
}

TEST_CASE("LU solves with the antisymmetric half") {
    constexpr int n = 9;
    const std::vector<Triangle> faces = grid_faces(n);
    const BlockPattern p(n * n, faces, {}, fill_order(n * n, faces));
    const BlockMatrix A = random_matrix(p, faces, BlockMatrix::Kind::general);
    const VectorXd b = random_vector(3 * n * n);
    const auto solver = make_linear_solver(SolverKind::umfpack);
    solver->factorize(A);
    REQUIRE((A.dense() * solver->solve(b) - b).norm() < 1e-11 * b.norm());
}

TEST_CASE("a matrix that is not positive definite is refused, and the node is named") {
    const std::vector<Triangle> faces = grid_faces(20);
    const BlockPattern p(400, faces, {}, fill_order(400, faces));
    BlockMatrix A(p);
    for (int i = 0; i < 400; ++i) A.add_to_diagonal(i, i == 123 ? -1 : 1);
    for (SolverKind kind : {SolverKind::cholmod, SolverKind::supernodal, SolverKind::single, SolverKind::mixed}) {
        const auto solver = make_linear_solver(kind);
        REQUIRE_FALSE(solver->try_factorize(A));
        REQUIRE(solver->breakdown().node == 123);
        REQUIRE_THROWS_WITH(solver->factorize(A), Catch::Contains("node 123"));
        REQUIRE_THROWS_AS(solver->solve(VectorXd::Ones(1200)), NumericalError);
    }
}

namespace {

/// Springs of stiffness 1 along the edges of a grid, in random directions, and `mass` on the diagonal: the smaller the
/// mass, the worse conditioned.
BlockMatrix spring_matrix(const BlockPattern& p, const std::vector<Triangle>& faces, double mass) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    BlockMatrix A(p);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Vector3d n = Vector3d::NullaryExpr([&] { return uniform(random); }).normalized();
            const Matrix3d K = n * n.transpose();
            A.add(p.face_slots(static_cast<int>(f))[k], -K);
            A.add_diagonal(faces[f][k], K);
            A.add_diagonal(faces[f][(k + 1) % 3], K);
        }
    for (int i = 0; i < p.n_nodes(); ++i) A.add_to_diagonal(i, mass);
    return A;
}

}  // namespace

TEST_CASE("the mixed solver keeps double precision where a single-precision factor alone has lost its digits") {
    constexpr int n = 40;   // wide supernodes and many rows below them
    const std::vector<Triangle> faces = grid_faces(n);
    const BlockPattern p(n * n, faces, {}, fill_order(n * n, faces, {}, FillOrder::metis));
    const VectorXd x = random_vector(3 * n * n);
    for (double mass : {1.0, 1e-3, 1e-5, 1e-7}) {   // the last one is beyond single precision
        const BlockMatrix A = spring_matrix(p, faces, mass);
        VectorXd b, r;
        A.multiply(x, b);
        const auto mixed = make_linear_solver(SolverKind::mixed), exact = make_linear_solver(SolverKind::cholmod);
        mixed->factorize(A);
        exact->factorize(A);
        const double reached = (exact->solve(b) - x).norm();
        INFO(mass);
        CHECK((mixed->solve(b) - x).norm() < 10 * reached + 1e-13 * x.norm());
        A.multiply(mixed->solve(b), r);
        CHECK((r - b).norm() < 1e-13 * b.norm());
        // Whose square overflows: no iteration may take it for solved.
        CHECK((1e-200 * mixed->solve(1e200 * b) - x).norm() < 10 * reached + 1e-13 * x.norm());
    }
}

TEST_CASE("conjugate gradients on a single-precision factor need a handful of iterations") {
    constexpr int n = 30;
    const std::vector<Triangle> faces = grid_faces(n);
    const BlockPattern p(n * n, faces, {}, fill_order(n * n, faces));
    const BlockMatrix A = spring_matrix(p, faces, 1e-2);
    const auto single = make_linear_solver(SolverKind::single);
    single->factorize(A);
    const VectorXd b = random_vector(3 * n * n);
    VectorXd x;
    FactorPcg pcg;
    const PcgOutcome out =
        pcg.solve([&](const VectorXd& v, VectorXd& y) { A.multiply(v, y); }, *single, b, 1e-13, 20, x);
    REQUIRE(out.status == PcgStatus::converged);
    REQUIRE(out.iterations <= 5);
}

TEST_CASE("GMRES on a factor of the symmetric half solves with the whole matrix, and says when it has not") {
    const int n = 20;
    const auto faces = grid_faces(n);
    const BlockPattern p(n * n, faces);
    const BlockMatrix A = random_matrix(p, faces, BlockMatrix::Kind::general);
    const auto half = make_linear_solver(SolverKind::single), whole = make_linear_solver(SolverKind::umfpack);
    half->factorize(A);
    whole->factorize(A);
    const VectorXd b = random_vector(3 * n * n);
    const auto multiply = [&](const VectorXd& v, VectorXd& y) { A.multiply(v, y); };
    VectorXd x, Ax;
    FactorGmres gmres;
    const GmresOutcome out = gmres.solve(multiply, *half, b, 1e-5, 60, x);
    REQUIRE(out.converged);
    REQUIRE((x - whole->solve(b)).norm() < 1e-4 * x.norm());
    const GmresOutcome early = gmres.solve(multiply, *half, b, 1e-10, 3, x);
    REQUIRE_FALSE(early.converged);
    REQUIRE(early.iterations == 3);
    multiply(x, Ax);
    REQUIRE((b - Ax).norm() < b.norm());
    REQUIRE(gmres.solve(multiply, *half, VectorXd::Zero(3 * n * n), 1e-10, 3, x).converged);
    REQUIRE(x.norm() == 0);
}
