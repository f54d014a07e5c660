#pragma once

#include "arcsim/material/material_data.hpp"

namespace arcsim {

/// Bending stiffness of a fold from the data rows, N m.
class BendingTable {
public:
    /// @param multiplier  of every entry (bending_mult * thicken)
    explicit BendingTable(const BendingRows& rows, double multiplier = 1);

    /// Bilinear in direction and curvature.
    ///
    ///   curvature coordinate b = 0.1 c, at most 4; below 0 the first two columns are extrapolated and a
    ///   negative result is cut at 0 (needed for agreement with ArcSim where the columns differ)
    ///
    /// @param direction  coordinate of the edge's direction in material space, see `direction()`, 0..2
    /// @param c          curvature measure theta l / (A0 + A1), 1/m, signed
    double k(double direction, double c) const { return sample(direction, c).k; }

    struct Sample {
        double k;       // N m
        double slope;   // dk/dc, N m²; from the right at a column
    };
    Sample sample(double direction, double c) const;

    /// No fold resists: such hinges are left out of the model.
    bool is_zero() const;

    /// 4 |angle of e| / pi folded to 0..2, so that 0, 1, 2 are edges at 0, 45, 90 degrees to u.
    static double direction(const Vector2d& e);

private:
    BendingRows rows_;
};

}  // namespace arcsim
