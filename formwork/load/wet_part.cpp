#include "formwork/load/wet_part.hpp"

namespace formwork {
namespace {

/// The same integrals over the corner triangle that the line q = 0 cuts off at corner a.
arcsim::Matrix3d corner_part(const arcsim::Vector3d& q, int a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const double tb = q[a] / (q[a] - q[b]), tc = q[a] / (q[a] - q[c]);   // where the line meets the two edges
    arcsim::Matrix3d phi;                                                // rows: functions; columns: cut corners
    phi.row(a) << 1, 1 - tb, 1 - tc;
    phi.row(b) << 0, tb, 0;
    phi.row(c) << 0, 0, tc;
    const arcsim::Vector3d sum = phi.rowwise().sum();
    return tb * tc / 12 * (phi * phi.transpose() + sum * sum.transpose());
}

}  // namespace

arcsim::Matrix3d wet_part(const arcsim::Vector3d& q) {
    const arcsim::Matrix3d whole = (arcsim::Matrix3d::Ones() + arcsim::Matrix3d::Identity()) / 12;
    const int n_wet = (q[0] > 0) + (q[1] > 0) + (q[2] > 0);
    if (n_wet == 3) return whole;
    if (n_wet == 0) return arcsim::Matrix3d::Zero();
    for (int a = 0; a < 3; ++a)
        if ((q[a] > 0) == (n_wet == 1)) return n_wet == 1 ? corner_part(q, a) : whole - corner_part(q, a);
    return whole;
}

}  // namespace formwork
