#pragma once

namespace formwork {

/// A seam's thread between two neighbouring nodes of one seam, or (L = 0) a stitch between two nodes.
struct SeamSpring {
    int i = 0, j = 0;     // nodes
    double L = 0;         // rest length, m
    double kappa = 0;     // N/m; EA / L for a seam of stiffness EA
    bool goes_slack = false;   // no force when shorter than L: thread and taped seams cannot push
};

}  // namespace formwork
