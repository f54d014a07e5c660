#include "formwork/panels/compensation.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace formwork {

void relax_stretch(const Segmentation& s, const FlatPanel& panel, std::vector<Matrix2d>& shapes) {
    for (std::size_t f = 0; f < shapes.size(); ++f) {
        const DirectionData& d = s.direction[panel.face[f]];
        const Matrix2d turn = Eigen::Rotation2Dd(d.theta).toRotationMatrix();
        shapes[f] = turn * Vector2d(1 / d.s1, 1 / d.s2).asDiagonal() * turn.transpose() * shapes[f];
    }
}

void shrink_to_weave(const std::array<double, 2>& percent, FlatPanel& panel, std::vector<Matrix2d>& shapes) {
    const Vector2d keep(1 - percent[0] / 100, 1 - percent[1] / 100);
    for (std::size_t f = 0; f < shapes.size(); ++f) {
        const Triangle& t = panel.faces[f];
        Matrix2d flat;
        flat << panel.u[t[1]] - panel.u[t[0]], panel.u[t[2]] - panel.u[t[0]];
        const Matrix2d map = flat * shapes[f].inverse();   // face plane -> flat; its nearest rotation:
        const double angle = std::atan2(map(1, 0) - map(0, 1), map(0, 0) + map(1, 1));
        shapes[f] = keep.asDiagonal() * Eigen::Rotation2Dd(angle).toRotationMatrix() * shapes[f];
    }
    for (Vector2d& p : panel.u) p = p.cwiseProduct(keep);
}

}  // namespace formwork
