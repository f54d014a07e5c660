#pragma once

#include <string_view>
#include <vector>

#include "arcsim/base/types.hpp"

namespace formwork {

using arcsim::Vector3d;

/// Whether a face carries tension both ways, one way (wrinkled across it) or not at all.
enum class FaceState { taut, wrinkled, slack };

std::string_view to_string(FaceState s);

/// The strain of one face between its rest shape and its deformed shape.
struct FaceStrain {
    double lambda1 = 1, lambda2 = 1;   // principal stretches, lambda1 >= lambda2
    Vector3d dir{1, 0, 0};             // unit direction of lambda1 on the REST surface (right singular vector of F)
    Vector3d dir_deformed{1, 0, 0};    // the same direction on the deformed surface (left singular vector)
    double eps_uu = 0, eps_vv = 0, eps_uv = 0;   // Green strain in the weave frame (u warp, v weft), tensor shear
    double tension1 = 0, tension2 = 0;           // principal second Piola-Kirchhoff tensions, N/m, >= 0
    FaceState state = FaceState::taut;
};

using StrainField = std::vector<FaceStrain>;   // one entry per face

}  // namespace formwork
