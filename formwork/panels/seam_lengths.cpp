#include <algorithm>
#include <cmath>

#include "formwork/panels/seam_match.hpp"

namespace formwork {
namespace {

/// One stretch of a seam between two notches; edges at its ends count in part.
struct Stretch {
    int seam = 0;
    double rest_length = 0;
    std::vector<std::pair<int, double>> edge;   // index along the chain, share of the edge
};

std::vector<Stretch> stretches(const PanelSet& set, const std::vector<std::vector<double>>& edge_lengths) {
    std::vector<Stretch> all;
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        const PanelSeam& seam = set.seams[i];
        if (seam.is_rim()) continue;
        std::vector<double> cuts{0};
        for (double f : seam.notch_rest) cuts.push_back(f * seam.rest_length);
        cuts.push_back(seam.rest_length);
        for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
            Stretch stretch;
            stretch.seam = static_cast<int>(i);
            stretch.rest_length = cuts[c + 1] - cuts[c];
            double from = 0;
            for (std::size_t k = 0; k < edge_lengths[i].size(); ++k) {
                const double to = from + edge_lengths[i][k];
                const double share = (std::min(to, cuts[c + 1]) - std::max(from, cuts[c])) / (to - from);
                if (share > 0) stretch.edge.emplace_back(static_cast<int>(k), share);
                from = to;
            }
            all.push_back(std::move(stretch));
        }
    }
    return all;
}

/// Nothing but lengths along the chain on the surface, to share out edges that a notch divides.
std::vector<std::vector<double>> rest_edge_lengths(const PanelSet& set, const Segmentation& s) {
    std::vector<std::vector<double>> lengths(set.seams.size());
    for (std::size_t i = 0; i < set.seams.size(); ++i) {
        const std::vector<int>& nodes = s.seams[i].nodes;
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
            lengths[i].push_back((s.mesh.x[nodes[k + 1]] - s.mesh.x[nodes[k]]).norm());
    }
    return lengths;
}

double stretch_length(const Stretch& stretch, const SeamSide& side, const std::vector<Vector2d>& u) {
    double sum = 0;
    for (const auto& [k, share] : stretch.edge) sum += share * (u[side.vertex[k + 1]] - u[side.vertex[k]]).norm();
    return sum;
}

}  // namespace

void measure_seams(PanelSet& set, const Segmentation& s) {
    for (PanelSeam& seam : set.seams) {
        seam.mismatch = seam.local_mismatch = 0;
        seam.notch.clear();
        for (SeamSide& side : seam.side) {
            side.length = 0;
            for (std::size_t k = 0; k + 1 < side.vertex.size(); ++k)
                side.length += (set.panels[side.panel].u[side.vertex[k + 1]] - set.panels[side.panel].u[side.vertex[k]]).norm();
        }
        if (!seam.is_rim())
            seam.mismatch = std::abs(seam.side[0].length - seam.side[1].length) / std::max(seam.side[0].length, seam.side[1].length);
    }
    std::vector<double> reached(set.seams.size(), 0);   // flat length of side 0 up to the end of the stretch
    for (const Stretch& stretch : stretches(set, rest_edge_lengths(set, s))) {
        PanelSeam& seam = set.seams[stretch.seam];
        const double a = stretch_length(stretch, seam.side[0], set.panels[seam.side[0].panel].u);
        const double b = stretch_length(stretch, seam.side[1], set.panels[seam.side[1].panel].u);
        seam.local_mismatch = std::max(seam.local_mismatch, std::abs(a - b) / std::max(a, b));
        reached[stretch.seam] += a;
        if (seam.notch.size() < seam.notch_rest.size()) seam.notch.push_back(reached[stretch.seam] / seam.side[0].length);
    }
}

}  // namespace formwork
