#pragma once

#include <memory>
#include <vector>

#include "formwork/segment/panel_patch.hpp"

namespace formwork {

/// What flattening would do to a panel, before it is flattened.
struct StretchEstimate {
    double energy = 0;      // integral of (phi - mean)² over the area, m²
    double area = 0;        // m²
    double p95 = 0;         // 95 % of the area has |phi - mean| below this
    double smallest_piece = 0;   // area of the smaller part of a panel that a curve divides, m²
};

/// Estimates the stretch of a panel's flat pattern from the scale factor of its conformal map.
///
/// Flattening with free boundary lengths solves  Laplace phi = K,  phi = 0 on the border  [Springborn et al.
/// 2008; Ben-Chen et al. 2008]; exp(phi) is the scale. For a long strip of half width w on a surface of
/// curvature K its spread is K w²/2, which is also the spread of the isometric flattening's stretch along
/// the strip, so that phi minus its mean is the stretch to be expected; for round caps the isometric map is
/// up to a third better. The panel is coarsened to about `max_cells` cells, each cell one unknown; one
/// factorisation pattern serves all trial curves.
class StretchModel {
public:
    StretchModel(const PanelPatch& patch, int max_cells);
    ~StretchModel();
    StretchModel(const StretchModel&) = delete;
    StretchModel& operator=(const StretchModel&) = delete;

    StretchEstimate whole() const { return with_cut({}); }
    /// The panel after cutting along a curve: sums over the pieces; p95 of the worst piece.
    StretchEstimate with_cut(const Curve& curve) const;
    /// The node where phi is furthest from the border's value, and its cell's neighbours' representative nodes:
    /// good places to cut through. Sorted by |phi|, largest first.
    std::vector<int> nodes_by_stretch() const;
    int n_cells() const;
    /// A node near the middle of every cell.
    const std::vector<int>& cell_nodes() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace formwork
