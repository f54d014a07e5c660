#pragma once

#include <nlohmann/json.hpp>

#include "formwork/equilibrium/equilibrium.hpp"
#include "shapes.hpp"

/// The shared reference solutions (tests/data/benchmarks/reference.json; ordinary differential equations and spectral
/// elements, no triangles) as problems on meshes of a wanted size.
namespace reference {

const nlohmann::json& data();

/// Stiffness rows by name: iso300, iso36k (isotropic); tab300, woven (tensor, files beside the data).
formwork::MaterialParams material(const std::string& name, const std::string& law);

/// A bag of reference b6 or disk of b4 with about n_nodes nodes.
shapes::Bag bag(const nlohmann::json& c, int n_nodes);
formwork::EquilibriumProblem bag_problem(const nlohmann::json& c, int n_nodes);
/// A trough of reference b5: n_across edges along its section, three edges long.
formwork::EquilibriumProblem trough_problem(const nlohmann::json& c, int n_across);

/// Relative errors of one solution against its reference.
struct Errors {
    int nodes = 0;
    double depth = 0, volume = 0, reaction = 0, pole = 0, meridian = 0;   // meridian: rms of both stretches along it
    formwork::EquilibriumResult result;
};
Errors solve_bag(const nlohmann::json& c, int n_nodes);
Errors solve_trough(const nlohmann::json& c, int n_across);

/// Exponent of the error in the mesh size between two solutions.
double rate(double coarse, double fine, int coarse_nodes, int fine_nodes);

}  // namespace reference
