#include <catch2/catch.hpp>

#include "formwork/strain/strain_field.hpp"

TEST_CASE("face states are written by their names") {
    CHECK(formwork::to_string(formwork::FaceState::wrinkled) == "wrinkled");
}
