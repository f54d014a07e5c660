#include "formwork/segment/covariance_split.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "formwork/segment/developability.hpp"
#include "formwork/segment/lay_out.hpp"
#include "formwork/segment/panel_patch.hpp"

namespace formwork {
namespace {

constexpr double longest_detour = 1.3;   // of a border along the field, over the border that it replaces
constexpr double least_agreement = 0.8;  // share of the area that both borders give to the same part

double border_length(const PanelPatch& patch, const std::vector<int>& part) {
    double length = 0;
    for (const arcsim::Edge& e : patch.topology.edges)
        if (!e.is_boundary() && part[e.face[0]] != part[e.face[1]]) length += (patch.surface.x[e.node[0]] - patch.surface.x[e.node[1]]).norm();
    return length;
}

/// Share of the patch's area that lies in the same part whether the parts or the curve divide it.
double agreement(const PanelPatch& patch, const std::vector<int>& part, const Curve& curve) {
    CutMesh cut(patch.surface);
    if (cut.insert_seam(curve).empty()) return 0;
    int n = 0;
    const std::vector<int> side = label_panels(cut, n);
    if (n != 2) return 0;
    double same = 0, all = 0;
    for (int f = 0; f < cut.surface().n_faces(); ++f) {
        const double area = arcsim::face_area(cut.surface(), f);
        all += area;
        if (side[f] == part[cut.source_face()[f]]) same += area;
    }
    return std::max(same, all - same) / all;
}

/// The curve along the field that parts a panel most like the given parts do.
std::optional<Curve> border_along_field(const Layout& layout, const SplitRules& rules, const CutMesh& cut, const std::vector<int>& faces,
                                        const std::vector<int>& part) {
    const PanelPatch patch = extract_patch(cut, faces);
    if (!patch.is_disk()) return {};
    std::vector<int> source;
    for (int f : faces) source.push_back(cut.source_face()[f]);
    const double longest = longest_detour * border_length(patch, part);
    std::optional<Curve> best;
    double most = least_agreement;
    for (const Split& split : best_splits(patch, layout.field_on(patch.surface, source), rules, 24)) {
        if (split.length > longest) continue;
        const double share = agreement(patch, part, split.curve);
        if (share <= most) continue;
        most = share;
        best = split.curve;
    }
    if (best)
        for (CurvePoint& p : *best) {
            p.a = patch.node[p.a];
            if (p.b >= 0) p.b = patch.node[p.b];
        }
    return best;
}

void mark_borders(CutMesh& cut, const Topology& t, const std::vector<int>& faces, const std::vector<int>& part) {
    std::vector<int> part_of(cut.surface().faces.size(), -1);
    for (std::size_t i = 0; i < faces.size(); ++i) part_of[faces[i]] = part[i];
    for (int f : faces)
        for (int k = 0; k < 3; ++k) {
            const int g = t.neighbour(f, k);
            if (g >= 0 && part_of[g] >= 0 && part_of[g] != part_of[f])
                cut.mark_seam(cut.surface().faces[f][(k + 1) % 3], cut.surface().faces[f][(k + 2) % 3]);
        }
}

}  // namespace

int split_by_covariance(CutMesh& cut, double max_energy, int max_panels, const SplitParams& params, const BetterBorder& better) {
    std::set<int> whole;   // lowest faces of panels that could not be split: a panel's lowest face stays when others are split
    for (int splits = 0;; ++splits) {
        const Topology t = arcsim::build_topology(cut.surface());
        const std::vector<double> eta = covariance_eta(cut.surface(), t);
        int n_panels = 0;
        const std::vector<int> panel = label_panels(cut, n_panels);
        const std::vector<double> energy = panel_energies(t, eta, panel, n_panels);
        const auto faces = panel_faces(panel, n_panels);
        for (bool done = false; !done;) {
            int worst = -1;
            for (int p = 0; p < n_panels; ++p)
                if (!whole.count(faces[p].front()) && energy[p] > max_energy && (worst < 0 || energy[p] > energy[worst])) worst = p;
            if (worst < 0 || n_panels >= max_panels) return splits;
            const std::vector<int> part = split_faces(cut.surface(), t, faces[worst], eta, params);
            const int n = *std::max_element(part.begin(), part.end()) + 1;
            std::vector<std::vector<int>> members(n);
            for (std::size_t i = 0; i < part.size(); ++i) members[part[i]].push_back(faces[worst][i]);
            done = n > 1 && n_panels + n - 1 <= max_panels &&
                   std::all_of(members.begin(), members.end(), [&](const auto& m) { return extract_patch(cut, m).is_disk(); });
            if (!done) {
                whole.insert(faces[worst].front());
                continue;
            }
            const auto curve = n == 2 && better ? better(cut, faces[worst], part) : std::nullopt;
            if (!curve || cut.insert_seam(*curve).empty()) mark_borders(cut, t, faces[worst], part);
        }
    }
}

std::vector<double> panel_energies(const Segmentation& s) {
    const Topology t = arcsim::build_topology(s.mesh);
    return panel_energies(t, covariance_eta(s.mesh, t), s.panel, s.n_panels);
}

Segmentation split_by_covariance(const Segmentation& layout, const Surface& input, const std::vector<DirectionData>& data,
                                 const SegmentParams& params, double max_energy, const SplitParams& split) {
    const Topology topology = arcsim::build_topology(input, "segment");
    const LayoutJob job{input, topology, data, params, layout.field, find_singularities(input, topology, layout.field), {}, split_rules(params)};
    CutMesh cut(input, layout.mesh, layout.source, layout.source_face);
    for (const Seam& seam : layout.seams)
        for (std::size_t i = 0; !seam.is_rim() && i + 1 < seam.nodes.size(); ++i) cut.mark_seam(seam.nodes[i], seam.nodes[i + 1]);
    const Layout field(input, layout.field.theta, data, job.rules, {}, cut);
    BetterBorder better;
    if (split.method == SplitMethod::spectral_stable)
        better = [&](const CutMesh& c, const std::vector<int>& faces, const std::vector<int>& part) {
            return border_along_field(field, job.rules, c, faces, part);
        };
    Segmentation s = layout;
    if (split_by_covariance(cut, max_energy, params.max_panels, split, better) > 0) s = mend_and_hand_over(job, cut, layout.candidates);
    const std::vector<double> energy = panel_energies(s);
    for (int p = 0; p < s.n_panels; ++p)
        if (energy[p] > max_energy) {
            char text[160];
            std::snprintf(text, sizeof text, "panel %d: covariance energy %.3g is above max_covariance_energy %.3g and it could not be split further",
                          p + 1, energy[p], max_energy);
            s.violations.push_back(text);
        }
    return s;
}

}  // namespace formwork
