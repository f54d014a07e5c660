#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formwork/equilibrium/solver_params.hpp"
#include "formwork/fabric/material_params.hpp"
#include "formwork/fabric/tensile_params.hpp"
#include "formwork/load/plaster_params.hpp"
#include "formwork/scene/bag_mesh.hpp"
#include "formwork/scene/fixed_selector.hpp"
#include "formwork/panels/panel_params.hpp"
#include "formwork/scene/segment_keys.hpp"
#include "formwork/sew/sew_params.hpp"

namespace formwork {

/// Keys of `formwork.inflate`.
struct InflateParams {
    MaterialParams material;
    double density = 0.2;               // fabric, kg/m²
    bool self_weight = true;
    PressureQuadrature pressure = PressureQuadrature::consistent;
    PressureJacobian pressure_jacobian = PressureJacobian::consistent;
    SolverParams solver;
};
template <class Archive>
void visit(Archive& a, InflateParams& p) {
    a.nested("material", p.material, "The fabric before it has panels and a weave.");
    a.optional("density", p.density, "kg/m²", arcsim::non_negative, "Of the fabric.");
    a.optional("self_weight", p.self_weight, "The fabric's own weight acts.");
    a.choice("pressure", p.pressure, pressure_quadrature_names, "How the liquid's pressure becomes forces.");
    a.choice("pressure_jacobian", p.pressure_jacobian, pressure_jacobian_names, "Derivative of the pressure in the tangent.");
    a.nested("solver", p.solver, "How the equilibrium is found.");
}

/// Keys of `formwork.report`.
struct ReportParams {
    std::string title;                  // empty: the scene's file name
};
template <class Archive>
void visit(Archive& a, ReportParams& p) {
    a.optional("title", p.title, "Heading of the report; empty: the scene's name.");
}

/// The `formwork` object of a scene: composed of what the rooms define. SI except where a name says otherwise.
struct FormworkParams {
    LengthUnit units = LengthUnit::m;
    bool any_size = false;
    bool weld = true;
    RestFrom rest = RestFrom::automatic;
    Vector3d up{0, 0, 1};
    std::vector<FixedSelector> fixed;
    std::optional<PlasterParams> plaster;
    InflateParams inflate;
    SegmentKeys segment;
    PanelParams panels;
    std::optional<SewParams> sew;
    std::optional<TensileParams> tensile;
    std::optional<FitParams> fit;
    ReportParams report;
};
template <class Archive>
void visit(Archive& a, FormworkParams& p) {
    a.choice("units", p.units, length_unit_names, "Length unit of the mesh; everything else in this file is SI.");
    a.optional("any_size", p.any_size, "Do not complain about a mesh smaller than 2 mm or larger than 60 m.");
    a.optional("weld", p.weld, "Join vertices at the same place along open edges.");
    a.choice("rest", p.rest, rest_from_names, "Where the unstretched shape comes from.");
    a.direction("up", p.up, "Against gravity: [x, y, z], or \"x\", \"y\", \"z\".");
    a.list("fixed", p.fixed, "Nodes that are held where they are.");
    a.nested("plaster", p.plaster, "The liquid.");
    a.nested("inflate", p.inflate, "First stage: the filled shape of an isotropic bag.");
    a.nested("segment", p.segment, "Second stage: seams and panels.");
    a.nested("panels", p.panels, "Third stage: flat cutting patterns.");
    a.nested("sew", p.sew, "Fourth stage: the sewn bag of woven fabric, filled again.");
    a.nested("tensile", p.tensile, "The tensile test of the fabric: formwork tensile.");
    a.nested("fit", p.fit, "A stiffness table from measured curves: formwork fit.");
    a.nested("report", p.report, "The report.");
}

}  // namespace formwork
