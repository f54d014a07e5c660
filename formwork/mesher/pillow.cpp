#include <Eigen/SparseCholesky>
#include <cmath>
#include <map>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "formwork/mesher/mesh_kinds.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::Triangle;
using arcsim::Vector2d;
using arcsim::Vector3d;
using arcsim::VectorXd;

namespace {

/// One panel on a square grid: body, and the spout on its upper edge.
struct Panel {
    std::vector<Vector2d> u;          // x from the middle, y up
    std::vector<Triangle> faces;      // counter-clockwise
    std::vector<char> sewn, rim;
};

Panel flat_panel(const PillowSize& size) {
    const double h = size.edge;
    const int half = static_cast<int>(std::lround(size.width / 2 / h)), up = static_cast<int>(std::lround(size.height / h));
    const int half_spout = static_cast<int>(std::lround(size.spout_width / 2 / h)), neck = static_cast<int>(std::lround(size.spout_height / h));
    if (half_spout < 2 || half_spout >= half || up < 4 || neck < 1)
        throw InputError("formwork mesh pillow: the spout must be at least four edges wide and narrower than the body; reduce --edge.");
    const double dx = size.width / 2 / half, dy = size.height / up, dy_neck = size.spout_height / neck;

    Panel p;
    std::map<std::pair<int, int>, int> node;   // grid position -> node
    const auto in_domain = [&](int i, int j) { return j <= up ? std::abs(i) <= half : std::abs(i) <= half_spout; };
    for (int j = 0; j <= up + neck; ++j)
        for (int i = -half; i <= half; ++i) {
            if (!in_domain(i, j)) continue;
            node[{i, j}] = static_cast<int>(p.u.size());
            p.u.push_back({i * dx, j <= up ? j * dy : size.height + (j - up) * dy_neck});
            const bool top = j == up + neck;
            p.rim.push_back(top);
            p.sewn.push_back(j == 0 || (j <= up && std::abs(i) == half) || (j == up && std::abs(i) >= half_spout) ||
                             (j > up && std::abs(i) == half_spout));
        }
    for (int j = 0; j < up + neck; ++j)
        for (int i = -half; i < half; ++i) {
            if (j >= up && (i < -half_spout || i >= half_spout)) continue;
            const int a = node[{i, j}], b = node[{i + 1, j}], c = node[{i + 1, j + 1}], d = node[{i, j + 1}];
            // A diagonal between two sewn nodes would be an edge of both panels: never across a corner cell.
            bool diagonal_ac = (i + j + half) % 2 == 0;
            if (diagonal_ac && p.sewn[a] && p.sewn[c]) diagonal_ac = false;
            if (!diagonal_ac && p.sewn[b] && p.sewn[d]) diagonal_ac = true;
            if (diagonal_ac) p.faces.insert(p.faces.end(), {{a, b, c}, {a, c, d}});
            else p.faces.insert(p.faces.end(), {{a, b, d}, {b, c, d}});
        }
    return p;
}

/// The smoothest values between given ones: the graph Laplacian's equation with source 1 per node where
/// `source` is set.
VectorXd smooth(const Panel& p, const std::map<int, double>& given, double source) {
    const int n = static_cast<int>(p.u.size());
    Eigen::SparseMatrix<double> L(n, n);
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd b = VectorXd::Constant(n, source);
    const auto couple = [&](int i, int j) {
        if (given.count(i)) return;
        entries.emplace_back(i, i, 1);
        if (const auto value = given.find(j); value != given.end()) b[i] += value->second;
        else entries.emplace_back(i, j, -1);
    };
    for (const Triangle& t : p.faces)
        for (int k = 0; k < 3; ++k) {
            couple(t[k], t[(k + 1) % 3]);
            couple(t[(k + 1) % 3], t[k]);
        }
    for (const auto& [i, value] : given) {
        entries.emplace_back(i, i, 1);
        b[i] = value;
    }
    L.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(L).solve(b);
}

}  // namespace

ClothMesh make_pillow(const PillowSize& size) {
    const Panel p = flat_panel(size);
    const int n = static_cast<int>(p.u.size());
    // The rim opens as a lens of two arcs, each as long as the spout is wide; the body bulges a little.
    constexpr double half_opening = 50 * std::numbers::pi / 180;   // a wider one would strain the neck
    const double radius = size.spout_width / (2 * half_opening);
    std::map<int, double> across, depth;
    for (int i = 0; i < n; ++i) {
        if (p.rim[i]) {
            const double angle = p.u[i][0] / radius;   // from the middle of the front
            across[i] = radius * std::sin(angle) - p.u[i][0];
            depth[i] = p.sewn[i] ? 0 : radius * (std::cos(angle) - std::cos(half_opening));
        } else {
            if (p.sewn[i]) depth[i] = 0;
            if (p.sewn[i] && p.u[i][1] <= size.height) across[i] = 0;
        }
    }
    const VectorXd dx = smooth(p, across, 0), rim_part = smooth(p, depth, 0);
    std::map<int, double> closed = depth;
    for (auto& [i, value] : closed) value = 0;
    const VectorXd bump = smooth(p, closed, 1);
    const VectorXd y = rim_part + bump * (size.bulge / bump.maxCoeff());

    ClothMesh mesh;
    mesh.groups = {"front", "back"};
    std::vector<int> front(n), back(n), front_vert(n), back_vert(n);
    const double beside = size.width * 1.25;
    for (int i = 0; i < n; ++i) {
        const double x = p.u[i][0] + dx[i], z = p.u[i][1];
        front[i] = mesh.add_node({x, -y[i], z});   // the front looks towards -y
        back[i] = p.sewn[i] ? front[i] : mesh.add_node({x, y[i], z});
        front_vert[i] = mesh.add_vert(p.u[i]);
    }
    for (int i = 0; i < n; ++i) back_vert[i] = mesh.add_vert({beside - p.u[i][0], p.u[i][1]});
    for (const Triangle& t : p.faces)
        mesh.add_face({front[t[0]], front[t[1]], front[t[2]]}, {front_vert[t[0]], front_vert[t[1]], front_vert[t[2]]}, 0);
    for (const Triangle& t : p.faces)
        mesh.add_face({back[t[0]], back[t[2]], back[t[1]]}, {back_vert[t[0]], back_vert[t[2]], back_vert[t[1]]}, 1);
    return mesh;
}

}  // namespace formwork
