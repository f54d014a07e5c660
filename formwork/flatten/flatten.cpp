#include "formwork/flatten/flatten.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/topology.hpp"
#include "formwork/flatten/isometry_energy.hpp"
#include "formwork/flatten/start_map.hpp"

namespace formwork {
namespace {

constexpr double min_area_ratio = 1e-12;   // of the mean face area: below it a face has no shape to keep
constexpr double isometric = 1e-14;        // E - 4 of a developable disk in double precision
constexpr double relative_shift = 1e-9;    // keeps the Hessian definite along the three rigid motions

/// The boundary of a disk. @throws InputError when the surface is none
std::vector<int> disk_outline(const Surface& disk) {
    const arcsim::Topology topology = arcsim::build_topology(disk, "panel");
    const std::size_t loops = topology.boundary_loops.size();
    if (topology.n_components == 1 && loops == 1 && topology.euler_characteristic() == 1)
        return topology.boundary_loops.front();
    throw arcsim::InputError("flatten: the surface is no disk: " + std::to_string(topology.n_components) +
                             " components, " + std::to_string(loops) + " boundary loops, Euler characteristic " +
                             std::to_string(topology.euler_characteristic()) + ". Cut it into disks first.");
}

void check_areas(const std::vector<Matrix2d>& shapes) {
    double total = 0;
    for (const Matrix2d& d : shapes) total += d.determinant() / 2;
    for (std::size_t f = 0; f < shapes.size(); ++f)
        if (!(shapes[f].determinant() / 2 > min_area_ratio * total / static_cast<double>(shapes.size())))
            throw arcsim::InputError("flatten: face " + std::to_string(f) +
                                     " has no area. Remove degenerate faces from the mesh.");
}

/// The flip-free start of lowest energy, scaled to its best size.
VectorXd best_start(const std::vector<Triangle>& faces, const std::vector<Matrix2d>& shapes,
                    const std::vector<int>& outline, int n, const IsometryEnergy& energy, FlatteningSolver& solver) {
    VectorXd best;
    double lowest = std::numeric_limits<double>::infinity();
    const auto offer = [&](VectorXd u) {
        if (!u.allFinite() || !std::isfinite(energy.value(u))) return;
        u *= energy.best_scale(u);
        const double e = energy.value(u);
        if (e < lowest) lowest = e, best = std::move(u);
    };
    offer(conformal_map(faces, shapes, outline, n, energy, solver));
    if (!std::isfinite(lowest)) offer(circle_map(faces, shapes, outline, n, TutteWeights::mean_value));
    if (!std::isfinite(lowest)) offer(circle_map(faces, shapes, outline, n, TutteWeights::uniform));
    if (!std::isfinite(lowest))
        throw arcsim::NumericalError("flatten: no start without flips among " + std::to_string(faces.size()) +
                                     " faces. The mesh has slivers, or the panel is long and narrow: remesh it or cut it.");
    return best;
}

}  // namespace

std::vector<Matrix2d> rest_shapes(const Surface& s) {
    std::vector<Matrix2d> shapes;
    shapes.reserve(s.faces.size());
    for (const Triangle& t : s.faces) {
        const arcsim::Vector3d a = s.x[t[1]] - s.x[t[0]], b = s.x[t[2]] - s.x[t[0]];
        const double length = a.norm();
        Matrix2d shape;
        shape << length, a.dot(b) / length, 0, a.cross(b).norm() / length;
        shapes.push_back(shape);
    }
    return shapes;
}

FlattenResult flatten_disk(const Surface& disk, const FlattenParams& params) { return flatten_disk(disk, disk_outline(disk), params); }

FlattenResult flatten_disk(const Surface& disk, const std::vector<int>& outline, const FlattenParams& params) {
    const std::vector<Matrix2d> shapes = rest_shapes(disk);
    check_areas(shapes);
    const int n = disk.n_nodes();
    const IsometryEnergy energy(disk.faces, shapes, n);
    FlatteningSolver solver;
    solver.cholmod().print = 0;   // what fails is told by the exception
    VectorXd u = best_start(disk.faces, shapes, outline, n, energy, solver);

    FlattenResult result;
    Eigen::SparseMatrix<double> hessian;
    VectorXd gradient;
    while (result.iterations < params.max_iterations && !result.converged) {
        const double e = energy.assemble(u, relative_shift * energy.diagonal_scale(), gradient, hessian);
        if (e < isometric) {
            result.converged = true;
            break;
        }
        solver.factorize(hessian);
        if (solver.info() != Eigen::Success)
            throw arcsim::NumericalError("flatten: the Hessian cannot be factorised at step " + std::to_string(result.iterations));
        const VectorXd du = -solver.solve(gradient);
        const double slope = gradient.dot(du);
        double step = energy.largest_step(u, du), lower = energy.value(u + step * du);
        constexpr double armijo = 1e-4, smallest_step = 1e-12;
        while (!(lower <= e + armijo * step * slope) && step > smallest_step) {
            step /= 2;
            lower = energy.value(u + step * du);
        }
        ++result.iterations;
        if (!(lower < e)) {   // nothing left to gain in double precision
            result.converged = true;
            break;
        }
        u += step * du;
        result.converged = e - lower < params.tolerance * lower;
    }

    result.u.resize(n);
    for (int i = 0; i < n; ++i) result.u[i] = u.segment<2>(2 * i);
    result.stretch = measure_stretch(disk.faces, shapes, result.u);
    return result;
}

}  // namespace formwork
