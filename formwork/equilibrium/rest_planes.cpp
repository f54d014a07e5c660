#include "formwork/equilibrium/equilibrium.hpp"

namespace formwork {

std::vector<FlatTriangle> rest_in_own_planes(const Surface& rest) {
    std::vector<FlatTriangle> flat(rest.n_faces());
    for (int f = 0; f < rest.n_faces(); ++f) {
        const Triangle& t = rest.faces[f];
        const arcsim::FaceFrame frame = arcsim::face_frame(rest, f);
        flat[f][0].setZero();
        for (int c = 1; c < 3; ++c) flat[f][c] = frame.local(rest.x[t[c]] - rest.x[t[0]]);
    }
    return flat;
}

}  // namespace formwork
