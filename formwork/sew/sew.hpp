#pragma once

#include <functional>
#include <string>
#include <vector>

#include "formwork/sew/sewn_bag.hpp"
#include "formwork/sew/surface_distance.hpp"
#include "formwork/sew/weave_measures.hpp"

namespace formwork {

/// The same panels with their grain turned: what the aligned weave is measured against.
struct GrainVariant {
    std::string name;               // "rotated_45", "random"
    std::string failure;            // empty, or why there is no equilibrium to show; then nothing below counts
    double mean_abs_shear = 0, p95_abs_shear = 0, max_abs_shear = 0;
    double fabric_mean_abs_shear = 0, taut_mean_abs_shear = 0;   // as WeaveMeasures has them
    double shape_rms_m = 0, shape_max_m = 0, depth_m = 0, max_tension_N_per_m = 0;
    double residual = 0;
    int wrinkled_faces = 0, iterations = 0, factorizations = 0;
    std::vector<double> angle_histogram;
};

/// The sewn, filled bag and what it answers.
struct SewResult {
    SewnBag bag;
    EquilibriumResult equilibrium;
    WeaveMeasures weave;
    std::vector<SeamEdgeLoad> seam_edges;   // per edge of bag.edges
    std::vector<SeamLoad> seams;         // per seam of the segmentation; rims carry zeros
    int shorter_seam_edges = 0;          // than at rest: there a slack thread does nothing
    double seam_max_force_N = 0;         // of the thread
    double seam_max_compression_N = 0;   // with thread_compression full; 0 or above
    double seam_max_line_load_N_per_m = 0;
    double seam_gap_max_m = 0;
    Deviation from_cut;                  // against the surface that was cut; SewInput::designed where there is one
    Deviation from_inflated;             // against the isotropic prediction, whose fabric is another one
    std::optional<Deviation> from_target;
    std::vector<GrainVariant> compare;
};

/// Fills the sewn bag with woven fabric: its equilibrium, its measures, and the baselines of `params.compare`.
/// @param on_iteration  progress; the first argument names what is being solved
/// @throws InputError, EquilibriumError
SewResult sew_bag(const SewInput& input, const SewParams& params,
                  const std::function<void(const std::string&, const IterationReport&)>& on_iteration = {});

/// Rest coordinates with each panel turned in its plane: "rotated_45", or by an angle of its own ("random").
std::vector<FlatTriangle> turn_grain(const std::vector<FlatTriangle>& flat, const std::vector<int>& panel_of_face, int n_panels,
                                     const std::string& variant, int seed);

}  // namespace formwork
