#pragma once

#include "formwork/equilibrium/equilibrium.hpp"
#include "shapes.hpp"

/// A bag of the default fabric, without weight of its own, filled with plaster to a level.
inline formwork::EquilibriumProblem filled_bag(const shapes::Bag& bag, double level) {
    formwork::EquilibriumProblem p;
    p.rest = bag.surface;
    p.fixed = bag.held;
    p.plaster.density = 1500;
    p.plaster.fill = formwork::FillParams{};
    p.plaster.fill->level = level;
    p.self_weight = false;
    return p;
}

inline double largest_difference(const formwork::EquilibriumResult& a, const formwork::EquilibriumResult& b) {
    double d = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i) d = std::max(d, (a.x[i] - b.x[i]).norm());
    return d;
}
