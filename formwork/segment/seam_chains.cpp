#include "formwork/segment/seam_chains.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace formwork {
namespace {

struct Border {
    int a, b;                     // directed
    std::array<int, 2> panel;     // left, right
    Border reversed() const { return {b, a, {panel[1], panel[0]}}; }
};

}  // namespace

std::vector<Seam> collect_seams(const CutMesh& cut, const std::vector<int>& panel) {
    const Surface& s = cut.surface();
    std::map<int, std::vector<Border>> out;   // every border edge twice, once from each end
    std::vector<Border> all;
    for (int f = 0; f < s.n_faces(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = s.faces[f][k], b = s.faces[f][(k + 1) % 3], g = cut.across(f, k);
            if (g >= 0 && (a > b || !cut.is_seam_at(f, k))) continue;
            all.push_back({a, b, {panel[f], g < 0 ? -1 : panel[g]}});
            out[a].push_back(all.back());
            out[b].push_back(all.back().reversed());
        }
    const auto passes = [&](int v) {   // two borders that are one
        const auto& o = out[v];
        return o.size() == 2 && o[0].panel[0] == o[1].panel[1] && o[0].panel[1] == o[1].panel[0];
    };
    std::set<std::pair<int, int>> done;
    const auto follow = [&](Border at) {   // from at.a on, to the next layout node or round
        Seam seam;
        seam.panel = at.panel;
        seam.nodes = {at.a, at.b};
        done.emplace(std::minmax(at.a, at.b));
        while (passes(at.b) && at.b != seam.nodes.front()) {
            const auto& o = out[at.b];
            const Border next = o[0].b == at.a ? o[1] : o[0];
            if (!done.emplace(std::minmax(next.a, next.b)).second) break;
            seam.nodes.push_back(next.b);
            at = next;
        }
        return seam;
    };
    std::vector<Seam> seams;
    for (int round = 0; round < 2; ++round)   // chains between nodes first, closed ones after
        for (const Border& border : all) {
            for (const Border& b : {border, border.reversed()}) {
                if (done.count(std::minmax(b.a, b.b)) || (round == 0 && passes(b.a))) continue;
                Seam seam = follow(b);
                if (seam.panel[0] < 0) {   // a rim runs with its faces
                    std::reverse(seam.nodes.begin(), seam.nodes.end());
                    std::swap(seam.panel[0], seam.panel[1]);
                }
                seams.push_back(std::move(seam));
            }
        }
    return seams;
}

}  // namespace formwork
