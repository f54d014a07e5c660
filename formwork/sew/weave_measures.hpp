#pragma once

#include <optional>
#include <vector>

#include "formwork/equilibrium/equilibrium.hpp"
#include "formwork/sew/sewn_bag.hpp"

namespace formwork {

/// What the weave of one face does.
struct FaceWeave {
    double stretch_warp = 1, stretch_weft = 1;   // of the yarns
    double cos_angle = 0;                        // between deformed warp and weft (corollary 1)
    double tension_warp = 0, tension_weft = 0;   // N per rest metre along warp and weft (first Piola-Kirchhoff)
    double tension_max = 0;                      // largest principal one, N per rest metre
};

/// Mean, 95 % quantile and extremes over the area of the cut surface.
struct Spread {
    double mean = 0, p95 = 0, min = 0, max = 0;
};
Spread spread(const std::vector<double>& value, const std::vector<double>& weight);

/// How the weave fares in the filled bag.
struct WeaveMeasures {
    std::vector<FaceWeave> face;
    Spread abs_shear;                  // |eps_uv| in the weave frame
    double taut_mean_abs_shear = 0;    // the same over the taut faces alone: in a wrinkled face eps is geometry
    Spread eps_warp, eps_weft;         // Green strain eps_uu, eps_vv
    Spread cos_angle;
    Spread tension;                    // N per rest metre
    std::optional<double> utilisation; // largest tension over the fabric's strength
    std::vector<double> angle_histogram_deg;   // share of the area per 5° of |90° - angle|, up to 45° and beyond
};

/// @param area  per face: weight of the means, m²
WeaveMeasures measure_weave(const EquilibriumResult& result, const MaterialParams& material, const std::vector<double>& area,
                            const std::optional<double>& strength);

/// What one seam carries.
struct SeamLoad {
    int seam = 0;
    double length = 0;              // m, on the surface that was cut
    double thread_force_max = 0;    // tension of the seam springs, N; 0 when they are all slack
    double thread_force_mean = 0;   // by length, N
    double line_load_max = 0;       // tension that passes from panel to panel across the seam, N per rest metre
    double gap_max = 0;             // m, with stitches
};
std::vector<SeamLoad> measure_seams(const SewnBag& bag, const SewParams& params, const EquilibriumResult& result, int n_seams);

}  // namespace formwork
