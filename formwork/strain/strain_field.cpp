#include "formwork/strain/strain_field.hpp"

namespace formwork {

std::string_view to_string(FaceState s) {
    switch (s) {
        case FaceState::taut: return "taut";
        case FaceState::wrinkled: return "wrinkled";
        case FaceState::slack: return "slack";
    }
    return "";
}

}  // namespace formwork
