#pragma once

#include <string>
#include <vector>

#include "arcsim/base/json_value.hpp"

namespace formwork {

/// One kind of `formwork mesh`: its keys, and how the OBJ is made of them.
struct MeshRecipe {
    const char* name;
    const char* what;
    arcsim::JsonValue (*schema)();
    /// @throws InputError: unknown keys, sizes out of range or not fitting each other
    std::string (*make_obj)(const arcsim::JsonDocument& keys, const std::string& comment);
};
const std::vector<MeshRecipe>& mesh_recipes();

}  // namespace formwork
