#include "formwork/fabric/block_lanes.hpp"

namespace formwork {

using arcsim::BlockSlot;
using arcsim::n_lanes;

namespace {

/// sign: +1 symmetric, -1 antisymmetric.
template <int sign>
void scatter(const BlockLanes& K, const int node[3][n_lanes], int first_face, int n, const BlockPattern& pattern,
             double* values) {
    // The derived blocks, still eight faces at a time.
    Lanes b01[9], b20[9], b00[9];
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) {
            const int k = r + 3 * c, kt = c + 3 * r;
            const Lanes b21 = sign * K.b12[kt];
            b01[k] = -(K.b11[k] + b21);              // K_01 = -(K_11 + K_21)
            b20[k] = -(b21 + K.b22[k]);              // K_20 = -(K_21 + K_22)
        }
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) {
            const int k = r + 3 * c, kt = c + 3 * r;
            b00[k] = -(b01[k] + sign * b20[kt]);     // K_00 = -(K_01 + K_02), K_02 = sign K_20ᵀ
        }
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
        add(b01, l, slots[0]);
        add(K.b12, l, slots[1]);
        add(b20, l, slots[2]);
        add(b00, l, pattern.diagonal(node[0][l]));
        add(K.b11, l, pattern.diagonal(node[1][l]));
        add(K.b22, l, pattern.diagonal(node[2][l]));
    }
}

}  // namespace

void scatter_symmetric(const BlockLanes& K, const int node[3][n_lanes], int first_face, int n,
                       const BlockPattern& pattern, double* values) {
    scatter<1>(K, node, first_face, n, pattern, values);
}
void scatter_skew(const BlockLanes& K, const int node[3][n_lanes], int first_face, int n, const BlockPattern& pattern,
                  double* values) {
    scatter<-1>(K, node, first_face, n, pattern, values);
}

}  // namespace formwork
