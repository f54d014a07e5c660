#pragma once

#include <string>
#include <vector>

#include "formwork/report/paint.hpp"
#include "formwork/report/pictures.hpp"
#include "formwork/report/report.hpp"

namespace formwork {

/// One position of all nodes that the 3-D view can show.
struct ReportShape {
    std::string key, name;
    std::vector<Vector3d> x;
};

/// All shapes on one triangulation, so that the view can change from one into the other and carry
/// any field: the cut mesh where there is one, else the input mesh.
struct ReportMesh {
    Surface rest;
    std::vector<ReportShape> shapes;
};

/// @throws std::invalid_argument when a shape or a field does not fit its mesh (our own error)
ReportMesh report_mesh(const ReportInput& in);

/// One number per face or node of that mesh, with its legend.
struct ReportField {
    std::string key;
    std::string of;  // key of the shape that it was measured on
    ColourScale scale;
    bool per_node = false;
    std::vector<std::string> classes;  // names when the values are 0, 1, 2, …
    std::vector<double> values;
};
std::vector<ReportField> report_fields(const ReportInput& in);

}  // namespace formwork
