#pragma once

#include <vector>

#include "formwork/panels/flat_panel.hpp"
#include "formwork/segment/segmentation.hpp"
#include "formwork/strain/strain_field.hpp"

/// A twisted column bag with made-up fields: what pictures, viewer files and the report are tried
/// on without running a simulation. Four sides and a bottom are its panels.
struct SyntheticBag {
    formwork::Segmentation segmentation;  // mesh: rest shape; nodes shared along the seams
    formwork::Surface inflated, sewn;
    formwork::StrainField strain, sewn_strain;
    std::vector<formwork::FlatPanel> panels;
    std::vector<double> deviation;  // per node, m
};

/// @param around   nodes around, a multiple of 4      @param up   rows of the wall
SyntheticBag make_synthetic_bag(int around, int up);
