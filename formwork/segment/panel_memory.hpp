#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "formwork/segment/flat_outline.hpp"
#include "formwork/segment/panel_patch.hpp"

namespace formwork {

/// A group of neighbouring panels, as it is known again after its seams have moved a little.
struct GroupTrace {
    int members = 0;
    int spare = 0;   // panels that may be added to the layout
    Vector3d centre = Vector3d::Zero();
    double area = 0;   // m²
    double cost = 0;   // of its panels, in panels
};

/// What was found out about panels, by their shape: a search comes back to many of them, and laying flat is most of its work.
class PanelMemory {
public:
    struct Flat {
        double p95 = 0, solidity = 1;
        bool overlaps = false;
        OutlineGaps gaps{std::numeric_limits<double>::infinity(), 1};
        bool failed = false;   // cannot be laid flat without folds
    };
    using Key = std::uint64_t;

    /// A number that two panels share only if their faces lie in the same places, whatever they are called.
    static Key key_of(const Surface& s);

    std::unordered_map<Key, double> estimate;
    /// Whether a group was laid out anew in vain when it was about where it is now, and no better.
    bool is_hopeless(const GroupTrace& group) const;

    std::vector<GroupTrace> hopeless;     // groups that were laid out anew in vain
    std::unordered_set<Key> settled;      // pairs of panels whose border was left where it is
    std::unordered_map<Key, Flat> flat;   // the key and the flattening's limit of steps together
};

}  // namespace formwork
