#include "formwork/segment/developability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "formwork/segment/angle_transport.hpp"

namespace formwork {
namespace {

constexpr double eta_per_curvature = 1.16;   // of a finely meshed sphere; 14.6 / 4 pi

}  // namespace

std::vector<double> covariance_eta(const Surface& s, const Topology& t) {
    std::vector<arcsim::Matrix3d> covariance(s.x.size(), arcsim::Matrix3d::Zero());
    for (int f = 0; f < s.n_faces(); ++f) {
        const arcsim::Vector3d n = arcsim::face_normal(s, f);
        for (int k = 0; k < 3; ++k) covariance[s.faces[f][k]] += corner_angle(s, f, k) * n * n.transpose();
    }
    std::vector<double> eta(s.x.size(), 0.0);
    for (int v = 0; v < s.n_nodes(); ++v) {
        if (t.node_faces[v].empty() || t.is_boundary_node(v)) continue;
        const Eigen::SelfAdjointEigenSolver<arcsim::Matrix3d> eigen(covariance[v], Eigen::EigenvaluesOnly);
        eta[v] = std::max(0.0, eigen.eigenvalues()[0]);
    }
    return eta;
}

std::vector<double> panel_energies(const Topology& t, const std::vector<double>& eta, const std::vector<int>& panel,
                                   int n_panels) {
    std::vector<double> energy(n_panels, 0.0);
    for (std::size_t v = 0; v < eta.size(); ++v) {
        const std::vector<int>& faces = t.node_faces[v];
        if (faces.empty()) continue;
        const int first = panel[faces[0]];
        if (first >= 0 && std::all_of(faces.begin(), faces.end(), [&](int f) { return panel[f] == first; }))
            energy[first] += eta[v];
    }
    return energy;
}

double patch_energy(const Topology& t, const std::vector<double>& eta, const std::vector<int>& faces) {
    std::vector<int> panel(t.face_edges.size(), -1);
    for (int f : faces) panel[f] = 0;
    return panel_energies(t, eta, panel, 1)[0];
}

double energy_for_stretch(double stretch) { return eta_per_curvature * 8 * std::numbers::pi * stretch; }
double stretch_for_energy(double energy) { return energy / (eta_per_curvature * 8 * std::numbers::pi); }

}  // namespace formwork
