#include <catch2/catch.hpp>
#include <Eigen/Eigenvalues>
#include <random>

#include "arcsim/base/error.hpp"
#include "check_force.hpp"
#include "formwork/equilibrium/equilibrium.hpp"
#include "formwork/fabric/membrane_force.hpp"
#include "formwork/fabric/tensor_law.hpp"
#include "shapes.hpp"

using namespace formwork;
using arcsim::State;

namespace {

std::vector<std::pair<std::string, std::shared_ptr<MembraneLaw>>> laws() {
    std::vector<std::pair<std::string, std::shared_ptr<MembraneLaw>>> list;
    for (Compression c : {Compression::full, Compression::tension_field}) {
        const std::string name = c == Compression::full ? ", full" : ", tension field";
        for (IsotropicLaw law : {IsotropicLaw::secant, IsotropicLaw::separable}) {
            MaterialParams p;
            p.law = law;
            p.compression = c;
            list.emplace_back((law == IsotropicLaw::secant ? "secant" : "separable") + name, make_membrane_law(p));
        }
        arcsim::StretchingRows rows, constant;
        rows[0] = {36000, 1000, 64000, 1000};
        for (int i = 1; i < 6; ++i) rows[i] = {360000. - 20000 * i, 10000. + 500 * i, 640000. + 10000 * i, 10000. + i};
        constant.fill({450000, 25, 500000, 10800});
        list.emplace_back("table" + name,
                          std::make_shared<TensorMembrane>(rows, arcsim::Sampling::exact, 0.5, c));
        list.emplace_back("constant tensor" + name,
                          std::make_shared<TensorMembrane>(constant, arcsim::Sampling::exact, 0.5, c));
    }
    return list;
}

shapes::Bag bag_of(int state) {   // 0 rest, 1 stretched and bent, 2 crumpled
    shapes::Bag bag = shapes::disk(0.1, 3);
    if (state == 1)
        for (auto& p : bag.surface.x) p = {1.15 * p[0], 1.05 * p[1] + 0.1 * p[0], 4 * (p[0] * p[0] - p[1] * p[0])};
    if (state == 2) shapes::jiggle(bag.surface.x, {}, 0.01, 5);
    return bag;
}

}  // namespace

TEST_CASE("membrane forces are the derivative of their energy, and tangents of the forces") {
    const Surface rest = bag_of(0).surface;
    for (auto& [name, law] : laws())
        for (Regulariser r : {Regulariser{}, Regulariser{0.01, 2.0}})
            for (int shape : {1, 2}) {
                law->set_regulariser(r);
                MembraneForce force(rest.faces, rest_in_own_planes(rest), law);
                State s;
                s.x = shapes::flatten(bag_of(shape).surface.x);
                const DerivativeErrors e = check_derivatives(force, rest.faces, s, 1e-7);
                INFO(name << ", shape " << shape << ", r " << r.r);
                CHECK(e.gradient < 1e-7);
                CHECK(e.hessian < 2e-6);
                CHECK(e.lowest > -1e-12);
                if (law->has_potential()) CHECK(e.asymmetry < 1e-12);
                if (law->has_potential() && law->is_tension_field() && r.r == 0) {
                    // convex in the positions: the exact tangent itself is positive semidefinite
                    const arcsim::BlockPattern pattern(rest.n_nodes(), rest.faces);
                    force.bind(pattern);
                    arcsim::BlockMatrix H(pattern);
                    force.add_hessian(s, arcsim::Tangent::exact, H);
                    const arcsim::VectorXd spectrum = H.dense().selfadjointView<Eigen::Lower>().eigenvalues();
                    CHECK(spectrum[0] > -1e-12 * spectrum.maxCoeff());
                }
            }
}

TEST_CASE("a resting membrane has no force, and no law divides by zero there") {
    const Surface rest = bag_of(0).surface;
    for (auto& [name, law] : laws()) {
        INFO(name);
        MembraneForce force(rest.faces, rest_in_own_planes(rest), law);
        State s;
        s.x = shapes::flatten(rest.x);
        arcsim::VectorXd g = arcsim::VectorXd::Zero(s.x.size());
        const arcsim::BlockPattern pattern(rest.n_nodes(), rest.faces);
        force.bind(pattern);
        arcsim::BlockMatrix H(pattern);
        force.add_gradient_and_hessian(s, arcsim::Tangent::exact, g, H);
        REQUIRE(g.norm() < 1e-13 * law->rest_stiffness());
        REQUIRE(H.dense().allFinite());
        REQUIRE(force.energy(s).value_or(0) == Approx(0).margin(1e-12));
    }
}

TEST_CASE("membrane forces carry no net force or torque, and turning the shape turns them") {
    const Surface rest = bag_of(0).surface;
    for (auto& [name, law] : laws()) {
        INFO(name);
        MembraneForce force(rest.faces, rest_in_own_planes(rest), law);
        State s;
        s.x = shapes::flatten(bag_of(1).surface.x);
        arcsim::VectorXd g = arcsim::VectorXd::Zero(s.x.size());
        force.add_gradient(s, g);
        Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
        for (int i = 0; i < rest.n_nodes(); ++i) {
            sum += g.segment<3>(3 * i);
            torque += Vector3d(s.x.segment<3>(3 * i)).cross(Vector3d(g.segment<3>(3 * i)));
        }
        REQUIRE(sum.norm() < 1e-13 * g.lpNorm<1>());
        REQUIRE(torque.norm() < 1e-14 * g.lpNorm<1>());
        const arcsim::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
        State turned = s;
        for (int i = 0; i < rest.n_nodes(); ++i) turned.x.segment<3>(3 * i) = R * s.x.segment<3>(3 * i);
        arcsim::VectorXd gt = arcsim::VectorXd::Zero(s.x.size());
        force.add_gradient(turned, gt);
        for (int i = 0; i < rest.n_nodes(); ++i) gt.segment<3>(3 * i) = R.transpose() * gt.segment<3>(3 * i);
        REQUIRE((gt - g).norm() < 1e-11 * g.norm());
    }
}

TEST_CASE("turning every face's material frame at random does not change an isotropic fabric") {
    const Surface rest = bag_of(0).surface;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(0, 6.3);
    std::vector<FlatTriangle> flat = rest_in_own_planes(rest), turned = flat;
    for (auto& face : turned) {
        const Eigen::Rotation2Dd R(angle(random));
        for (auto& p : face) p = R * p;
    }
    for (auto& [name, law] : laws()) {
        if (name.find("secant") == std::string::npos && name.find("separable") == std::string::npos) continue;
        law->set_regulariser({0.01, 1});
        MembraneForce a(rest.faces, flat, law), b(rest.faces, turned, law);
        State s;
        s.x = shapes::flatten(bag_of(2).surface.x);
        arcsim::VectorXd ga = arcsim::VectorXd::Zero(s.x.size()), gb = ga;
        a.add_gradient(s, ga);
        b.add_gradient(s, gb);
        INFO(name);
        REQUIRE((ga - gb).norm() < 1e-10 * ga.norm());
    }
}

TEST_CASE("rest faces without area or inside out are refused by number") {
    Surface s = bag_of(0).surface;
    auto flat = rest_in_own_planes(s);
    auto law = std::shared_ptr<MembraneLaw>(make_membrane_law({}));
    std::swap(flat[4][1], flat[4][2]);
    REQUIRE_THROWS_WITH(MembraneForce(s.faces, flat, law), Catch::Contains("face 4") && Catch::Contains("inside out"));
    flat[4][2] = flat[4][1];
    REQUIRE_THROWS_WITH(MembraneForce(s.faces, flat, law), Catch::Contains("no area"));
}
