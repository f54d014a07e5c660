#include "formwork/study/compare_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "arcsim/base/error.hpp"
#include "arcsim/mesh/obj_io.hpp"
#include "formwork/segment/nearest_surface.hpp"

namespace formwork {

using arcsim::InputError;
using arcsim::Surface;
using arcsim::Vector3d;
namespace fs = std::filesystem;

namespace {

/// Boxes in a binary tree over the faces: the exact nearest point of a surface.
class BoxTree {
public:
    explicit BoxTree(const Surface& s) : s_(s), faces_(s.n_faces()) {
        std::iota(faces_.begin(), faces_.end(), 0);
        if (!faces_.empty()) build(0, s.n_faces());
    }
    double distance(const Vector3d& p) const {
        double best = std::numeric_limits<double>::infinity();
        if (!nodes_.empty()) descend(0, p, best);
        return std::sqrt(best);
    }

private:
    struct Node {
        Eigen::AlignedBox3d box;
        int begin, end, left = -1, right = -1;
    };
    int build(int begin, int end) {
        const int index = static_cast<int>(nodes_.size());
        nodes_.push_back({{}, begin, end});
        for (int i = begin; i < end; ++i)
            for (const int v : s_.faces[faces_[i]]) nodes_[index].box.extend(s_.x[v]);
        constexpr int leaf = 8;
        if (end - begin <= leaf) return index;
        int axis = 0;
        nodes_[index].box.sizes().maxCoeff(&axis);
        const int middle = (begin + end) / 2;
        std::nth_element(faces_.begin() + begin, faces_.begin() + middle, faces_.begin() + end, [&](int f, int g) {
            return arcsim::face_centroid(s_, f)[axis] < arcsim::face_centroid(s_, g)[axis];
        });
        const int left = build(begin, middle), right = build(middle, end);
        nodes_[index].left = left, nodes_[index].right = right;
        return index;
    }
    void descend(int index, const Vector3d& p, double& best) const {
        const Node& n = nodes_[index];
        if (n.box.squaredExteriorDistance(p) >= best) return;
        if (n.left < 0) {
            for (int i = n.begin; i < n.end; ++i) {
                const arcsim::Triangle& t = s_.faces[faces_[i]];
                best = std::min(best, (nearest_in_triangle(p, s_.x[t[0]], s_.x[t[1]], s_.x[t[2]]) - p).squaredNorm());
            }
            return;
        }
        const bool left_first = nodes_[n.left].box.squaredExteriorDistance(p) < nodes_[n.right].box.squaredExteriorDistance(p);
        descend(left_first ? n.left : n.right, p, best);
        descend(left_first ? n.right : n.left, p, best);
    }

    const Surface& s_;
    std::vector<int> faces_;
    std::vector<Node> nodes_;
};

/// Root mean square and largest of some distances.
void measure(const std::vector<double>& d, double& rms, double& max) {
    double sum = 0;
    for (const double v : d) sum += v * v, max = std::max(max, v);
    rms = d.empty() ? 0 : std::sqrt(sum / static_cast<double>(d.size()));
}

std::vector<double> one_sided(const Surface& from, const Surface& to) {
    const BoxTree tree(to);
    std::vector<double> d;
    for (const Vector3d& p : from.x) d.push_back(tree.distance(p));
    return d;
}

std::set<std::string> obj_files(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().extension() == ".obj") names.insert(fs::relative(entry.path(), folder).generic_string());
    return names;
}

}  // namespace

FileComparison compare_surfaces(const Surface& a, const Surface& b) {
    if (a.faces.empty() || b.faces.empty()) throw InputError("compare: one of the meshes has no faces.");
    FileComparison c;
    c.same_mesh = a.n_nodes() == b.n_nodes() && a.faces == b.faces;
    const std::vector<double> ab = one_sided(a, b), ba = one_sided(b, a);
    c.hausdorff = std::max(*std::max_element(ab.begin(), ab.end()), *std::max_element(ba.begin(), ba.end()));
    std::vector<double> d = ab;
    if (c.same_mesh)
        for (int i = 0; i < a.n_nodes(); ++i) d[i] = (a.x[i] - b.x[i]).norm();
    measure(d, c.rms, c.max);
    if (!c.same_mesh) c.max = c.hausdorff;
    return c;
}

std::vector<FileComparison> compare_results(const fs::path& a, const fs::path& b) {
    const auto compare = [](const fs::path& p, const fs::path& q, const std::string& name) {
        FileComparison c = compare_surfaces(arcsim::read_obj(p).surface(), arcsim::read_obj(q).surface());
        c.name = name;
        return c;
    };
    for (const fs::path& p : {a, b})
        if (!fs::exists(p)) throw InputError(p.string() + ": does not exist. Give two OBJ files or two output folders.");
    if (fs::is_directory(a) != fs::is_directory(b))
        throw InputError(a.string() + " and " + b.string() + ": one is a folder, the other a file. Give two of a kind.");
    if (!fs::is_directory(a)) return {compare(a, b, a.filename().string())};
    std::vector<FileComparison> out;
    const std::set<std::string> in_b = obj_files(b);
    for (const std::string& name : obj_files(a))
        if (in_b.count(name)) out.push_back(compare(a / name, b / name, name));
    if (out.empty()) throw InputError(a.string() + " and " + b.string() + ": no OBJ file of the same name in both.");
    return out;
}

}  // namespace formwork
