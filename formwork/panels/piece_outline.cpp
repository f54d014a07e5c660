#include <map>
#include <string>

#include "arcsim/base/error.hpp"
#include "formwork/panels/allowance.hpp"
#include "formwork/panels/marks.hpp"

namespace formwork {
namespace {

constexpr double mm = 1000;   // per metre

}  // namespace

void check_allowances(const PanelSet& set) {
    for (const SeamAllowance& a : set.params.allowances)
        if (a.seam > static_cast<int>(set.seams.size()))
            throw arcsim::InputError("/formwork/panels/allowances: there is no seam " + std::to_string(a.seam) + "; this bag has " +
                                     std::to_string(set.seams.size()) + ". See panels/seams.csv for their numbers.");
}

double allowance_mm(const PanelSet& set, int seam) {
    for (const SeamAllowance& a : set.params.allowances)
        if (a.seam == seam + 1) return a.allowance_mm;
    return set.seams[seam].is_rim() ? set.params.hem_mm : set.params.seam_allowance_mm;
}

PatternPiece outline_piece(const PanelSet& set, int panel) {
    const FlatPanel& p = set.panels[panel];
    PatternPiece piece;
    piece.panel = panel;
    piece.name = panel_name(panel);
    std::map<std::pair<int, int>, SewEdge> seam_of;   // outline edge, in the outline's direction
    for (std::size_t i = 0; i < set.seams.size(); ++i)
        for (int side : {0, 1}) {
            const SeamSide& chain = set.seams[i].side[side];
            if (chain.panel != panel) continue;
            for (std::size_t k = 0; k + 1 < chain.vertex.size(); ++k)
                seam_of[side == 0 ? std::pair{chain.vertex[k], chain.vertex[k + 1]} : std::pair{chain.vertex[k + 1], chain.vertex[k]}] =
                    {static_cast<int>(i), side, set.seams[i].is_rim()};
        }
    std::vector<double> allowance;
    std::vector<char> folded;
    for (std::size_t i = 0; i < p.boundary.size(); ++i) {
        const SewEdge edge = seam_of.at({p.boundary[i], p.boundary[(i + 1) % p.boundary.size()]});
        piece.sew.push_back(mm * p.u[p.boundary[i]]);
        piece.sew_seam.push_back(edge);
        allowance.push_back(allowance_mm(set, edge.seam));
        folded.push_back(edge.rim);
    }
    piece.cut = cut_line(piece.sew, allowance, set.params.corners, set.params.mitre_limit, folded);
    piece.cut_area = signed_area(piece.cut);
    for (const PanelSeam& seam : set.seams)
        if (seam.is_rim() && seam.side[0].panel == panel) {
            Line fold;
            for (const Vector2d& u : flat_chain(set, seam.side[0])) fold.push_back(mm * u);
            piece.folds.push_back(std::move(fold));
        }
    return piece;
}

ChainPoint chain_point(const Line& chain, double share) {
    double total = 0;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) total += (chain[k + 1] - chain[k]).norm();
    double left = share * total;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        const Vector2d d = chain[k + 1] - chain[k];
        const double length = d.norm();
        if (left <= length || k + 2 == chain.size()) return {chain[k] + d * std::min(1.0, left / length), d / length};
        left -= length;
    }
    return {chain.front(), Vector2d::UnitX()};
}

}  // namespace formwork
