#pragma once

#include "formwork/panels/panel_set.hpp"
#include "formwork/sew/sew.hpp"

namespace formwork {

/// Panels cut again from the shape that their own sewn bag takes, `params.recut` times; with `params.grain` "sewn" their
/// grain is turned to that bag's tension each time, and at least once.
///
/// Cloth that hardly stretches cannot lie on a surface from which its flat panel differs: where the panel is too wide it
/// folds, and in folds that run askew the weave is sheared. The filled bag shows where: its surface is almost
/// developable within every panel. Laid flat again, that surface gives panels without most of the surplus. The seams
/// keep their course; the price is that the bag moves away from the designed surface a little with every round.
///
/// @param s       the layout; its nodes move to the shape from which the returned panels are cut, and its directions
///                become what the grain follows
/// @param input   what the bag of such panels is made of
/// @throws InputError, EquilibriumError as make_panels and sew_bag do
PanelSet recut_panels(Segmentation& s, const PanelParams& params, const SewParams& sew,
                      const std::function<SewInput(const Segmentation&, const std::vector<FlatPanel>&)>& input,
                      const std::function<void(int round, const IterationReport&)>& on_iteration = {});

}  // namespace formwork
