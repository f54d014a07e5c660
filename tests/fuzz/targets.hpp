#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace formwork {

/// A reader of files that strangers write. `run` may throw InputError and nothing else; whatever it accepts must
/// survive what every program does with it next.
struct FuzzTarget {
    std::string name;                    // also the folder of its corpus, tests/fuzz/corpus/NAME
    void (*run)(std::string_view bytes);
};
const std::vector<FuzzTarget>& fuzz_targets();

}  // namespace formwork
