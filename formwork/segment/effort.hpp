#pragma once

#include <limits>

namespace formwork {

/// Work that a search may do, counted in faces: one for a face of a panel that is laid flat or searched for curves. Counts,
/// not seconds, end a search, so that its result depends neither on the machine nor on what else runs there.
struct Effort {
    double limit = std::numeric_limits<double>::infinity();
    double spent = 0;
    /// Whether less than a share of the limit is spent.
    bool is_left(double share = 1) const { return spent < share * limit; }
};

}  // namespace formwork
