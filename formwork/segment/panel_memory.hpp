#pragma once

#include <cstdint>
#include <unordered_map>

#include "formwork/segment/panel_patch.hpp"

namespace formwork {

/// What was found out about panels, by their shape: a search comes back to many of them, and laying flat is most of its work.
class PanelMemory {
public:
    struct Flat {
        double p95 = 0, solidity = 1;
        bool overlaps = false;
        bool failed = false;   // cannot be laid flat without folds
    };
    using Key = std::uint64_t;

    /// A number that two panels share only if their faces lie in the same places, whatever they are called.
    static Key key_of(const Surface& s);

    std::unordered_map<Key, double> estimate;
    std::unordered_map<Key, Flat> flat;   // the key and the flattening's limit of steps together
};

}  // namespace formwork
