#include "formwork/sew/recut.hpp"

#include <algorithm>

#include "formwork/sew/tension_directions.hpp"

namespace formwork {

PanelSet recut_panels(Segmentation& s, const PanelParams& params, const SewParams& sew,
                      const std::function<SewInput(const Segmentation&, const std::vector<FlatPanel>&)>& input,
                      const std::function<void(int round, const IterationReport&)>& on_iteration) {
    SewParams plain = sew;   // the bag alone, on nodes that both panels share
    plain.compare.clear();
    plain.seams = SeamModel::shared;
    PanelSet set = make_panels(s, params);
    const bool turns = params.grain == GrainTarget::sewn;
    for (int round = 1; round <= std::max(params.recut, turns ? 1 : 0); ++round) {
        const auto report = [&](const std::string&, const IterationReport& r) {
            if (on_iteration) on_iteration(round, r);
        };
        const SewResult sewn = sew_bag(input(s, set.panels), plain, report);
        if (params.recut > 0) s.mesh.x = sewn.equilibrium.x;
        if (turns) s.direction = tension_directions(s.mesh, sewn, plain.material);
        set = make_panels(s, params);
    }
    return set;
}

}  // namespace formwork
