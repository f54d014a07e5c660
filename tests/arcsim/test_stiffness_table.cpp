#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "arcsim/material/bending_table.hpp"
#include "arcsim/material/stiffness_table.hpp"

using namespace arcsim;

namespace {

StretchingRows rows_of(Stiffness4 rest, Stiffness4 strained) {
    StretchingRows r;
    r.fill(strained);
    r[0] = rest;
    return r;
}

const StretchingRows iso = rows_of({300, 2, 300, 37.5}, {600, 2, 600, 75});

StretchingRows woven() {
    return {Stiffness4(36496.94, 17.77, 56329.3, 3171.91),
            Stiffness4(453939.78, 24.67, 499773.53, 10794.15),
            Stiffness4(321081.07, 37.87, 643526.19, 46434.4),
            Stiffness4(147439.0, 11.5, 261801.58, 13953.55),
            Stiffness4(439895.04, 52.62, 383126.43, 12605.24),
            Stiffness4(418775.97, 82.44, 488043.68, 44474.28)};
}

/// First Piola tension, N/m, of a stretch along one axis of the material without lateral strain.
double tension(const StretchingRows& rows, double stretch, double angle) {
    const StiffnessTable table(rows, Sampling::arcsim);
    const Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Matrix2d F = R * Vector2d(stretch, 1).asDiagonal() * R.transpose();
    const Matrix2d G = 0.5 * (F.transpose() * F - Matrix2d::Identity());
    const Stiffness4 k = table.k({G(0, 0), G(1, 1), G(0, 1)});
    Matrix2d S;
    S << k[0] * G(0, 0) + k[1] * G(1, 1), k[3] * G(0, 1), k[3] * G(0, 1), k[2] * G(1, 1) + k[1] * G(0, 0);
    return (R.transpose() * F * S * R)(0, 0);
}

}  // namespace

TEST_CASE("the grid's rest state lies between its points and is stiffer than twice row 0") {
    CHECK(StiffnessTable(iso, Sampling::arcsim).rest()[0] == Approx(644.63).epsilon(1e-5));
    CHECK(StiffnessTable(woven(), Sampling::arcsim).rest()[0] == Approx(133353).epsilon(1e-5));
    CHECK(StiffnessTable(woven(), Sampling::arcsim).rest()[2] == Approx(178048).epsilon(1e-5));
    CHECK(StiffnessTable(iso, Sampling::exact).rest() == Stiffness4(600, 4, 600, 75));
}

TEST_CASE("one-directional tension agrees with the values ArcSim's law gives") {
    const double half = std::numbers::pi / 4;   // columns: stretch, iso 0, iso 45, woven 0, 45, 90
    const double reference[][6] = {{0.95, -29.165, -16.489, -5136.4, -2723.8, -7254.4},
                                   {1.001, 0.64649, 0.36633, 134.90, 83.494, 179.60},
                                   {1.02, 13.842, 8.0095, 3563.2, 1966.7, 4472.3},
                                   {1.10, 110.84, 62.657, 66233, 18650, 72790},
                                   {1.1667, 251.19, 140.17, 188990, 49024, 203280},
                                   {1.30, 538.20, 303.63, 407180, 104290, 437770}};
    for (const auto& r : reference) {
        CHECK(tension(iso, r[0], 0) == Approx(r[1]).epsilon(3e-5));
        CHECK(tension(iso, r[0], half) == Approx(r[2]).epsilon(3e-5));
        CHECK(tension(woven(), r[0], 0) == Approx(r[3]).epsilon(3e-5));
        CHECK(tension(woven(), r[0], half) == Approx(r[4]).epsilon(3e-5));
        CHECK(tension(woven(), r[0], 2 * half) == Approx(r[5]).epsilon(3e-5));
    }
}

TEST_CASE("the derivative of the stiffness by the strain is the limit of its differences") {
    for (const Sampling sampling : {Sampling::exact, Sampling::arcsim}) {
        const StiffnessTable table(woven(), sampling, 1.5);
        // States off the kinks: grid lines, columns of 22.5 degrees.
        for (const Vector3d& G : {Vector3d(0.051, 0.012, 0.021), Vector3d(0.011, 0.073, -0.032), Vector3d(-0.1, 0.03, 0.004),
                                 Vector3d(-0.1, -0.07, 0.001), Vector3d(0.9, 0.11, 0.21), Vector3d(0.051, 0.047, 0.003)}) {
            const StiffnessSample s = table.sample(G);
            CHECK((s.k - table.k(G)).norm() <= 1e-9 * s.k.norm());
            for (int axis = 0; axis < 3; ++axis) {
                const Vector3d d = 1e-6 * Vector3d::Unit(axis);
                const Stiffness4 difference = (table.k(G + d) - table.k(G - d)) / 2e-6;
                INFO("G " << G.transpose() << " axis " << axis);
                CHECK((s.dk_dG.col(axis) - difference).norm() <= 1e-5 * (s.k.norm() + difference.norm()));
            }
        }
    }
}

TEST_CASE("the directly sampled stiffness is continuous where the principal stretches are equal") {
    const StiffnessTable table(woven(), Sampling::exact);
    const Stiffness4 middle = table.k({0.05, 0.05, 0});
    for (int i = 0; i < 16; ++i) {
        const double a = 2 * std::numbers::pi * i / 16, e = 1e-7;
        const Vector3d G(0.05 + e * std::cos(a), 0.05 - e * std::cos(a), e * std::sin(a));
        CHECK((table.k(G) - middle).norm() < 1e-5 * middle.norm());
    }
    // Where one direction alone is strained the rule is the plain interpolation.
    for (const Vector3d& G : {Vector3d(0.06, 0.02, 0.01), Vector3d(0.05, -0.03, 0.02)})
        CHECK(table.k(G) == interpolate_stiffness(woven(), G, StiffnessTable::full_strain, 2, EqualStretches::jump).k);
}

TEST_CASE("negative interpolated stiffness is cut at zero and the sign of the shear does not matter") {
    const StiffnessTable table(rows_of({100, -10, 100, 30}, {100, 20, 100, 30}), Sampling::exact, 2);
    CHECK(table.rest()[1] == 0);
    CHECK(table.rest()[0] == 400);
    const StiffnessTable grid(woven(), Sampling::arcsim);
    CHECK(grid.k({0.02, 0.01, 0.05}) == grid.k({0.02, 0.01, -0.05}));
}

TEST_CASE("bending is bilinear in direction and curvature and is extrapolated below the first column") {
    const BendingRows rows{{{1, 2, 3, 4, 5}, {11, 12, 13, 14, 15}, {21, 22, 23, 24, 30}}};
    const BendingTable t(rows, 2);
    CHECK(BendingTable::direction({1, 0}) == Approx(0));
    CHECK(BendingTable::direction({-1, 1}) == Approx(1));
    CHECK(BendingTable::direction({0, -1}) == Approx(2));
    CHECK(t.k(0, 0) == Approx(2));
    CHECK(t.k(0.5, 15) == Approx(2 * 7.5));
    CHECK(t.k(2, 1000) == Approx(60));
    CHECK(t.k(1, -5) == Approx(2 * 10.5));
    CHECK(t.k(0, -50) == 0);
}
