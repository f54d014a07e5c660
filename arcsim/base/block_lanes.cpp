#include "arcsim/base/block_lanes.hpp"

namespace arcsim {

AllBlockLanes complete(const BlockLanes& K, Half half) {
    const double sign = half == Half::symmetric ? 1 : -1;
    AllBlockLanes B;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) {
            const int k = r + 3 * c, kt = c + 3 * r;
            const Lanes b21 = sign * K.b12[kt];
            B.pair[0][k] = -(K.b11[k] + b21);          // K_01 = -(K_11 + K_21)
            B.pair[1][k] = K.b12[k];
            B.pair[2][k] = -(b21 + K.b22[k]);          // K_20 = -(K_21 + K_22)
            B.diagonal[1][k] = K.b11[k];
            B.diagonal[2][k] = K.b22[k];
        }
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)                    // K_00 = -(K_01 + K_02)
            B.diagonal[0][r + 3 * c] = -(B.pair[0][r + 3 * c] + sign * B.pair[2][c + 3 * r]);
    return B;
}

void scatter(const AllBlockLanes& K, Half half, const int node[3][n_lanes], int first_face, int n,
             const BlockPattern& pattern, double* values) {
    const double sign = half == Half::symmetric ? 1 : -1;
    const auto add = [&](const Lanes* b, int l, const BlockSlot& s) {
        double* out = values + s.first;
        if (s.transposed) {
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) out[c * s.stride + r] += sign * b[c + 3 * r][l];
        } else {
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) out[c * s.stride + r] += b[r + 3 * c][l];
        }
    };
    for (int l = 0; l < n; ++l) {
        const auto& slots = pattern.face_slots(first_face + l);
        for (int k = 0; k < 3; ++k) add(K.pair[k], l, slots[k]);
        for (int k = 0; k < 3; ++k) add(K.diagonal[k], l, pattern.diagonal(node[k][l]));
    }
}

}  // namespace arcsim
