#include "formwork/sew/recut.hpp"

namespace formwork {

PanelSet recut_panels(Segmentation& s, const PanelParams& params, const SewParams& sew,
                      const std::function<SewInput(const Segmentation&, const std::vector<FlatPanel>&)>& input,
                      const std::function<void(int round, const IterationReport&)>& on_iteration) {
    SewParams plain = sew;   // the bag alone, on nodes that both panels share
    plain.compare.clear();
    plain.seams = SeamModel::shared;
    PanelSet set = make_panels(s, params);
    for (int round = 1; round <= params.recut; ++round) {
        const auto report = [&](const std::string&, const IterationReport& r) {
            if (on_iteration) on_iteration(round, r);
        };
        s.mesh.x = sew_bag(input(s, set.panels), plain, report).equilibrium.x;
        set = make_panels(s, params);
    }
    return set;
}

}  // namespace formwork
