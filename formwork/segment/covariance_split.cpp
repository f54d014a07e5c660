#include "formwork/segment/covariance_split.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "formwork/segment/developability.hpp"
#include "formwork/segment/seam_chains.hpp"

namespace formwork {
namespace {

/// V - E + F of a connected set of faces is 1.
bool is_disk(const Surface& s, const std::vector<int>& faces) {
    std::set<int> nodes;
    std::set<std::pair<int, int>> edges;
    for (int f : faces)
        for (int k = 0; k < 3; ++k) {
            nodes.insert(s.faces[f][k]);
            edges.insert(std::minmax(s.faces[f][k], s.faces[f][(k + 1) % 3]));
        }
    return static_cast<int>(nodes.size()) - static_cast<int>(edges.size()) + static_cast<int>(faces.size()) == 1;
}

}  // namespace

int split_by_covariance(CutMesh& cut, std::vector<int>& panel, int& n_panels, double max_energy, int max_panels,
                        const SplitParams& params) {
    const Surface& s = cut.surface();
    const Topology t = arcsim::build_topology(s);
    const std::vector<double> eta = covariance_eta(s, t);
    std::vector<char> whole;   // panels that could not be split
    int splits = 0;
    while (n_panels < max_panels) {
        whole.resize(n_panels, 0);
        const std::vector<double> energy = panel_energies(t, eta, panel, n_panels);
        int worst = -1;
        for (int p = 0; p < n_panels; ++p)
            if (!whole[p] && energy[p] > max_energy && (worst < 0 || energy[p] > energy[worst])) worst = p;
        if (worst < 0) break;
        std::vector<int> faces;
        for (int f = 0; f < s.n_faces(); ++f)
            if (panel[f] == worst) faces.push_back(f);
        const std::vector<int> part = split_faces(s, t, faces, eta, params);
        const int n = *std::max_element(part.begin(), part.end()) + 1;
        std::vector<std::vector<int>> members(n);
        for (std::size_t i = 0; i < faces.size(); ++i) members[part[i]].push_back(faces[i]);
        const bool disks = std::all_of(members.begin(), members.end(), [&](const auto& m) { return is_disk(s, m); });
        if (n < 2 || n_panels + n - 1 > max_panels || !disks) {
            whole[worst] = 1;
            continue;
        }
        for (int c = 1; c < n; ++c)
            for (int f : members[c]) panel[f] = n_panels + c - 1;
        n_panels += n - 1;
        ++splits;
        for (int f : faces)
            for (int k = 0; k < 3; ++k) {
                const int g = t.neighbour(f, k);
                if (g >= 0 && panel[g] != panel[f]) cut.mark_seam(s.faces[f][(k + 1) % 3], s.faces[f][(k + 2) % 3]);
            }
    }
    return splits;
}

std::vector<double> panel_energies(const Segmentation& s) {
    const Topology t = arcsim::build_topology(s.mesh);
    return panel_energies(t, covariance_eta(s.mesh, t), s.panel, s.n_panels);
}

int split_by_covariance(Segmentation& s, double max_energy, int max_panels, const SplitParams& params) {
    CutMesh cut(s.mesh);
    for (const Seam& seam : s.seams)
        for (std::size_t i = 0; !seam.is_rim() && i + 1 < seam.nodes.size(); ++i) cut.mark_seam(seam.nodes[i], seam.nodes[i + 1]);
    const int splits = split_by_covariance(cut, s.panel, s.n_panels, max_energy, max_panels, params);
    if (splits > 0) s.seams = collect_seams(cut, s.panel);
    const std::vector<double> energy = panel_energies(s);
    for (int p = 0; p < s.n_panels; ++p)
        if (energy[p] > max_energy) {
            char text[160];
            std::snprintf(text, sizeof text, "panel %d: covariance energy %.3g is above max_covariance_energy %.3g and it could not be split further",
                          p, energy[p], max_energy);
            s.violations.push_back(text);
        }
    return splits;
}

}  // namespace formwork
