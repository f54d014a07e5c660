#include "reference_cases.hpp"

#include <cmath>
#include <fstream>

#include "tests/paths.hpp"

namespace reference {

using namespace formwork;
using nlohmann::json;

const json& data() {
    static const json all = json::parse(std::ifstream(test_data_dir() + "/benchmarks/reference.json"));
    return all;
}

MaterialParams material(const std::string& name, const std::string& law) {
    MaterialParams p;
    p.compression = Compression::full;
    if (name == "iso300" || name == "iso36k") {
        const bool soft = name == "iso300";
        p.rest = soft ? std::array<double, 4>{300, 2, 300, 298} : std::array<double, 4>{36000, 1000, 36000, 35000};
        p.max = p.rest;
        if (law == "secant")
            p.max = soft ? std::array<double, 4>{600, 2, 600, 598} : std::array<double, 4>{360000, 10000, 360000, 350000};
        return p;
    }
    p.model = FabricModel::tensor;
    p.data.name = name + "_" + law + ".json";
    p.data.path = test_data_dir() + "/benchmarks/" + p.data.name;
    p.stretching_mult = 0.5;
    return p;
}

shapes::Bag bag(const json& c, int n_nodes) {
    const std::string kind = c.value("kind", "disk");
    const double a = c.at("a"), h = c.value("h", 0.0);
    // disk: 3 n² nodes; sock: h/a * 6 n² more
    const double per = kind == "sock" ? 3 + 6 * h / a : 3;
    const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(n_nodes / per))));
    return kind == "sock" ? shapes::sock(a, h, n) : kind == "hemisphere" ? shapes::hemisphere(a, n) : shapes::disk(a, n);
}

EquilibriumProblem bag_problem(const json& c, int n_nodes) {
    const shapes::Bag b = bag(c, n_nodes);
    EquilibriumProblem p;
    p.rest = b.surface;
    p.fixed = b.held;
    p.self_weight = false;
    p.material = material(c.value("mat", "tab300"), c.at("law"));
    if (p.material.model == FabricModel::tensor)   // a flat disk cut from one sheet: one weave frame
        for (const auto& t : p.rest.faces) {       // seen from below, where the normals point: u = y, v = x
            FlatTriangle flat;
            for (int k = 0; k < 3; ++k) flat[k] = {p.rest.x[t[k]][1], p.rest.x[t[k]][0]};
            p.flat.push_back(flat);
        }
    if (c.value("tension_field", false)) p.material.compression = Compression::tension_field;
    if (c.contains("p")) {
        p.plaster.overpressure = c.at("p");
    } else {
        p.plaster.density = c.at("rho");
        p.plaster.fill = FillParams{};
        p.plaster.fill->level = c.value("head", 0.0);
    }
    return p;
}

namespace {

/// Stretches of the reference along the meridian, by the cubic through the four nearest of its points.
std::array<double, 2> profile_at(const json& profile, double s) {
    std::size_t i = 0;
    while (i + 4 < profile.size() && s > double(profile[i + 2][0])) ++i;
    std::array<double, 2> v{0, 0};
    for (std::size_t k = i; k < i + 4; ++k) {
        double w = 1;
        for (std::size_t m = i; m < i + 4; ++m)
            if (m != k) w *= (s - double(profile[m][0])) / (double(profile[k][0]) - double(profile[m][0]));
        v[0] += w * double(profile[k][3]);
        v[1] += w * double(profile[k][4]);
    }
    return v;
}

double meridian_error(const json& c, const EquilibriumProblem& p, const EquilibriumResult& r) {
    if (!c.contains("profile")) return 0;
    const double a = c.at("a"), h = c.value("h", 0.0);
    double sum = 0, area = 0;
    for (int f = 0; f < p.rest.n_faces(); ++f) {
        const Vector3d x = face_centroid(p.rest, f);
        const double radius = std::hypot(x[0], x[1]);
        const std::string kind = c.value("kind", "disk");
        const bool wall = kind == "sock" && x[2] > -h + 1e-9;
        const double s = kind == "hemisphere" ? a * std::atan2(radius, -x[2]) : wall ? a + x[2] + h : radius;
        // index 1 along the meridian: by the strain's direction
        const Vector3d across = Vector3d(-x[1], x[0], 0).normalized();
        const double along2 = std::pow(r.strain[f].dir.dot(across), 2);
        const double l1 = std::sqrt((1 - along2) * std::pow(r.strain[f].lambda1, 2) + along2 * std::pow(r.strain[f].lambda2, 2));
        const double l2 = std::sqrt(along2 * std::pow(r.strain[f].lambda1, 2) + (1 - along2) * std::pow(r.strain[f].lambda2, 2));
        const auto expected = profile_at(c.at("profile"), s);
        const double A = face_area(p.rest, f);
        sum += A * (std::pow(l1 - expected[0], 2) + std::pow(l2 - expected[1], 2));
        area += A;
    }
    return std::sqrt(sum / area);
}

}  // namespace

Errors solve_bag(const json& c, int n_nodes) {
    EquilibriumProblem p = bag_problem(c, n_nodes);
    Errors e;
    e.result = find_equilibrium(p);
    e.nodes = e.result.vertices;
    e.depth = e.result.depth_below_rim_m / double(c.at("depth")) - 1;
    e.volume = e.result.capacity_m3 / double(c.at("volume")) - 1;
    if (c.contains("reaction")) e.reaction = std::abs(e.result.support_force_N[2]) / double(c.at("reaction")) - 1;
    // shapes put the pole first
    if (c.contains("lam_pole")) {
        double sum = 0;
        int n = 0;
        for (int f = 0; f < p.rest.n_faces(); ++f)
            for (int k = 0; k < 3; ++k)
                if (p.rest.faces[f][k] == 0) sum += std::sqrt(e.result.strain[f].lambda1 * e.result.strain[f].lambda2), ++n;
        e.pole = sum / n / double(c.at("lam_pole")) - 1;
    }
    e.meridian = meridian_error(c, p, e.result);
    return e;
}

EquilibriumProblem trough_problem(const json& c, int n_across) {
    const double W = c.at("W"), L = c.at("L0");
    const double edge = L / n_across;
    const shapes::Bag b = shapes::trough(L, 3 * edge, n_across, 3);
    EquilibriumProblem p;
    p.rest = b.surface;
    p.fixed = b.held;
    // Start as an arc that spans W (a parabola, a little slack or stretched).
    p.start = b.surface.x;
    const double sag = L > W ? std::sqrt(3. / 8 * W * (L - W)) : 0.1 * W;
    for (auto& x : p.start) {
        const double t = x[0] / L;
        x = {W * t, x[1], -4 * sag * t * (1 - t)};
    }
    p.self_weight = false;
    p.plaster.density = 1500;
    p.plaster.fill = FillParams{};
    p.plaster.fill->level = double(c.at("head"));
    const bool inextensible = c.at("mat").is_null();
    if (inextensible) {   // stiff enough for the stretch to vanish in the errors: tension/k < 1e-6
        p.material.rest = p.material.max = {1e9, 0, 1e9, 5e8};
        p.material.compression = Compression::full;
    } else {
        p.material = material(c.at("mat"), c.at("law"));
    }
    return p;
}

Errors solve_trough(const json& c, int n_across) {
    const EquilibriumProblem p = trough_problem(c, n_across);
    Errors e;
    e.result = find_equilibrium(p);
    e.nodes = n_across;
    e.depth = e.result.depth_below_rim_m / double(c.at("bottom_below_supports")) - 1;
    e.volume = e.result.volume_m3 / (3 * double(c.at("L0")) / n_across) / double(c.at("fluid_area")) - 1;
    double tension = 0;                                  // current tension; the width does not change
    for (const FaceStrain& s : e.result.strain) tension += s.tension1 * s.lambda1 / static_cast<double>(e.result.strain.size());
    e.reaction = tension / double(c.at("tension")) - 1;
    return e;
}

double rate(double coarse, double fine, int coarse_nodes, int fine_nodes) {
    return std::log(std::abs(coarse / fine)) / (0.5 * std::log(double(fine_nodes) / coarse_nodes));
}

}  // namespace reference
