#include "formwork/sew/sew.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace formwork {
namespace {

bool is_shorter(const SeamSpring& s, const std::vector<Vector3d>& x) { return s.L > 0 && (x[s.j] - x[s.i]).norm() < s.L; }

/// What two solves cost together; the second one's answer.
EquilibriumResult after(const EquilibriumResult& first, EquilibriumResult second) {
    second.iterations += first.iterations;
    second.factorizations += first.factorizations;
    second.wall_s += first.wall_s;
    second.cpu_s += first.cpu_s;
    second.history.insert(second.history.begin(), first.history.begin(), first.history.end());
    return second;
}

/// The slack bags of two starts differ by their last digits, and which way a chain buckles hangs on those: without them both
/// buckle alike. 10 micrometres are far above the digits (1e-11 m) and far below what cloth shows.
void drop_last_digits(std::vector<Vector3d>& x, const std::vector<char>& held) {
    constexpr double unit = 1e-5;   // m
    for (size_t i = 0; i < x.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (!held[3 * i + axis]) x[i][axis] = unit * std::round(x[i][axis] / unit);
}

/// Springs that push have many equilibria (SewParams). Of these the one is taken into which the bag with slack threads,
/// whose state is one, goes when its threads begin to push: it does not depend on where the search began.
EquilibriumResult find_sewn_equilibrium(EquilibriumProblem problem) {
    const std::vector<SeamSpring> literal = problem.seams;
    for (SeamSpring& s : problem.seams) s.goes_slack = s.goes_slack || s.L > 0;
    const EquilibriumResult relaxed = find_equilibrium(problem);
    const auto pushes = [&](const SeamSpring& s) { return !s.goes_slack && is_shorter(s, relaxed.x); };
    if (std::none_of(literal.begin(), literal.end(), pushes)) return relaxed;   // it is an equilibrium of both
    problem.seams = literal;
    problem.start = relaxed.x;
    drop_last_digits(problem.start, problem.fixed);
    try {
        return after(relaxed, find_equilibrium(problem));
    } catch (const EquilibriumError& e) {
        throw EquilibriumError(std::string(e.what()) + ". With threads that go slack there is an equilibrium: set "
                               "/formwork/sew/thread_compression to \"slack\"", *e.last);
    }
}

GrainVariant run_variant(const std::string& name, const SewInput& input, const SewParams& params, const SewResult& aligned,
                         const SurfaceDistance& cut, const std::vector<double>& area,
                         const std::function<void(const std::string&, const IterationReport&)>& on_iteration) {
    GrainVariant v;
    v.name = name;
    SewnBag bag = aligned.bag;
    bag.flat = turn_grain(bag.flat, input.segmentation.panel, input.segmentation.n_panels, name, params.seed);
    EquilibriumProblem problem = sewn_problem(input, params, bag);
    problem.start = aligned.equilibrium.x;   // of all known shapes the nearest
    if (on_iteration) problem.on_iteration = [&](const IterationReport& r) { on_iteration(name, r); };
    try {
        const EquilibriumResult r = find_sewn_equilibrium(std::move(problem));
        const WeaveMeasures weave = measure_weave(r, params.material, area, params.strength);
        const Deviation shape = deviation({r.x, bag.cut.faces}, cut);
        v.mean_abs_shear = weave.abs_shear.mean;
        v.p95_abs_shear = weave.abs_shear.p95;
        v.max_abs_shear = weave.abs_shear.max;
        v.fabric_mean_abs_shear = weave.fabric_abs_shear.mean;
        v.taut_mean_abs_shear = weave.taut_mean_abs_shear;
        v.angle_histogram = weave.angle_histogram;
        v.max_tension_N_per_m = weave.tension.max;
        v.shape_rms_m = shape.rms;
        v.shape_max_m = shape.max;
        v.depth_m = r.depth_m;
        v.residual = r.residual;
        v.wrinkled_faces = r.wrinkled_faces;
        v.iterations = r.iterations;
        v.factorizations = r.factorizations;
    } catch (const EquilibriumError& e) {
        v.failure = e.what();   // a baseline that has no equilibrium is an answer too; the bag itself stands
    }
    return v;
}

}  // namespace

std::vector<FlatTriangle> turn_grain(const std::vector<FlatTriangle>& flat, const std::vector<int>& panel_of_face, int n_panels,
                                     const std::string& variant, int seed) {
    std::vector<double> angle(n_panels, std::numbers::pi / 4);
    if (variant == "random") {
        std::mt19937 random(static_cast<unsigned>(seed));   // its sequence is the same on every machine
        for (double& a : angle) a = std::numbers::pi * (random() / 4294967296.0);
    }
    std::vector<FlatTriangle> turned = flat;
    for (size_t f = 0; f < flat.size(); ++f) {
        const Eigen::Rotation2Dd rotation(angle[panel_of_face[f]]);
        for (Vector2d& u : turned[f]) u = rotation * u;
    }
    return turned;
}

SewResult sew_bag(const SewInput& input, const SewParams& params,
                  const std::function<void(const std::string&, const IterationReport&)>& on_iteration) {
    const Segmentation& s = input.segmentation;
    SewResult result;
    result.bag = make_sewn_bag(input, params);
    EquilibriumProblem problem = sewn_problem(input, params, result.bag);
    if (on_iteration) problem.on_iteration = [&](const IterationReport& r) { on_iteration("sew", r); };
    result.equilibrium = find_sewn_equilibrium(std::move(problem));

    std::vector<double> area;
    for (int f = 0; f < s.mesh.n_faces(); ++f) area.push_back(arcsim::face_area(s.mesh, f));
    result.weave = measure_weave(result.equilibrium, params.material, area, params.strength);
    result.seam_edges = measure_seam_edges(result.bag, params, result.equilibrium);
    result.seams = measure_seams(result.bag, result.seam_edges, result.equilibrium, static_cast<int>(s.seams.size()));
    for (const SeamLoad& load : result.seams) {
        result.seam_max_force_N = std::max(result.seam_max_force_N, load.thread_force_max);
        result.seam_max_compression_N = std::max(result.seam_max_compression_N, -load.thread_force_min);
        result.seam_max_line_load_N_per_m = std::max(result.seam_max_line_load_N_per_m, load.line_load_max);
        result.seam_gap_max_m = std::max(result.seam_gap_max_m, load.gap_max);
    }
    // With stitches a thread runs along either side of a seam.
    const auto shorter = std::count_if(result.bag.springs.begin(), result.bag.springs.end(),
                                       [&](const SeamSpring& e) { return is_shorter(e, result.equilibrium.x); });
    result.shorter_seam_edges = static_cast<int>(shorter) / (params.seams == SeamModel::stitch ? 2 : 1);
    const Surface shape{result.equilibrium.x, result.bag.cut.faces};
    const SurfaceDistance cut(input.designed ? *input.designed : s.mesh);
    result.from_cut = deviation(shape, cut);
    result.from_inflated = deviation(shape, SurfaceDistance(Surface{result.bag.inflated, result.bag.cut.faces}));
    if (input.target) result.from_target = deviation(shape, SurfaceDistance(*input.target));
    for (const std::string& name : params.compare)
        result.compare.push_back(run_variant(name, input, params, result, cut, area, on_iteration));
    return result;
}

}  // namespace formwork
