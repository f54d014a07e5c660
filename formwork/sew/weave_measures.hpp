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
    double fabric_shear = 0;                     // eps_uv of the fabric itself: without wrinkles
    double tension_warp = 0, tension_weft = 0;   // N per rest metre along warp and weft (first Piola-Kirchhoff)
    double tension_max = 0;                      // largest principal one, N per rest metre
};

/// Mean, 95 % quantile and extremes over the area of the cut surface.
struct Spread {
    double mean = 0, p95 = 0, min = 0, max = 0;
};
Spread spread(const std::vector<double>& value, const std::vector<double>& weight);

inline constexpr double angle_bin_deg = 0.25;
inline constexpr int n_angle_bins = 41;   // ten degrees, and all beyond: at 10° cloth has lost its grip on its shape

/// How the weave fares in the filled bag.
struct WeaveMeasures {
    std::vector<FaceWeave> face;
    Spread abs_shear;                  // |eps_uv| of the mesh's faces in the weave frame: SYSTEM.md's measure
    Spread fabric_abs_shear;           // the same without wrinkles (MembraneLaw::fabric_strain): what the yarns feel
    double taut_mean_abs_shear = 0;    // of the taut faces alone, where the two are one
    double taut_share = 0;             // of the area
    Spread eps_warp, eps_weft;         // Green strain eps_uu, eps_vv
    Spread cos_angle;
    Spread tension;                    // N per rest metre
    std::optional<double> utilisation; // largest tension over the fabric's strength
    std::vector<double> angle_histogram;   // share of the area per angle_bin_deg of |90° - angle|; the last bin has the rest
};

/// @param area  per face: weight of the means, m²
WeaveMeasures measure_weave(const EquilibriumResult& result, const MaterialParams& material, const std::vector<double>& area,
                            const std::optional<double>& strength);

/// What one seam carries.
struct SeamLoad {
    int seam = 0;
    double length = 0;              // m, on the surface that was cut
    double thread_force_max = 0;    // tension of the seam springs, N; 0 when none is longer than at rest
    double thread_force_min = 0;    // largest compression, N, negative; 0 when nothing pushes
    double thread_force_mean = 0;   // by length, N
    double line_load_max = 0;       // tension that passes from panel to panel across the seam, N per rest metre
    double gap_max = 0;             // m, with stitches
};

/// What passes at one edge of a seam.
struct SeamEdgeLoad {
    double thread_force = 0;        // of the seam springs there, N; below 0: they push
    double line_load = 0;           // the larger of what the two panels hand across the edge, N per rest metre
};
/// Per edge of `bag.edges`.
std::vector<SeamEdgeLoad> measure_seam_edges(const SewnBag& bag, const SewParams& params, const EquilibriumResult& result);
std::vector<SeamLoad> measure_seams(const SewnBag& bag, const std::vector<SeamEdgeLoad>& edges, const EquilibriumResult& result,
                                    int n_seams);

}  // namespace formwork
