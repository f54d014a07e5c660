#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace formwork {

std::string base64(std::string_view bytes);

/// The bytes of an array in the machine's order, which on all machines we build for is the
/// browser's: little-endian.
template <class T>
std::string base64(const std::vector<T>& values) {
    return base64(
        std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
}

}  // namespace formwork
