#include "tests/formwork/sew/sewn_sock.hpp"

#include <numbers>

#include "formwork/panels/panel_set.hpp"
#include "tests/paths.hpp"

using namespace formwork;

namespace {

/// Four quarters of the wall and the bottom.
std::vector<int> sock_labels(const shapes::Bag& bag, double height) {
    std::vector<int> label;
    for (int f = 0; f < bag.surface.n_faces(); ++f) {
        const Vector3d c = arcsim::face_centroid(bag.surface, f);
        const bool is_bottom = c[2] < -height + 1e-9;
        const double turn = (std::atan2(c[1], c[0]) + std::numbers::pi) / (2 * std::numbers::pi);
        label.push_back(is_bottom ? 4 : std::min(3, static_cast<int>(4 * turn)));
    }
    return label;
}

}  // namespace

SewnSock::SewnSock(double radius, double height, int rings)
    : SewnSock(shapes::sock(radius, height, rings), sock_labels(shapes::sock(radius, height, rings), height)) {}

SewnSock::SewnSock(shapes::Bag of, const std::vector<int>& label) : bag(std::move(of)) {
    cut = cut_surfaces::cut_by_labels(bag.surface, label);
    for (int f = 0; f < cut.mesh.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            cut.source[cut.mesh.faces[f][k]] = {f, {0, 0, 0}};
            cut.source[cut.mesh.faces[f][k]].barycentric[k] = 1;
        }
    constexpr double faces_down = 1 - 1e-9;   // cosine
    for (int f = 0; f < cut.mesh.n_faces(); ++f) {
        const arcsim::FaceFrame frame = arcsim::face_frame(cut.mesh, f);
        const Vector3d along = std::abs(arcsim::face_normal(cut.mesh, f).z()) > faces_down ? Vector3d::UnitX() : Vector3d::UnitZ();
        cut.direction[f] = {frame.angle(along), 1.1, 1.0, 1.0};
        cut.field_theta[f] = cut.direction[f].theta;
    }
    panels = make_panels(cut, PanelParams{}).panels;
}

SewInput SewnSock::input(double level) const {
    SewInput in{cut, panels, bag.surface.faces, bag.surface.x, bag.held, {0, 0, 1}, {}, {}, {}, {}};
    in.plaster.density = 1500;
    in.plaster.fill = FillParams{};
    in.plaster.fill->level = level;
    return in;
}

SewParams SewnSock::params() {
    SewParams p;
    p.material.data = {"woven_table3.json", project_dir() + "/conf/materials/woven_table3.json"};
    return p;
}
