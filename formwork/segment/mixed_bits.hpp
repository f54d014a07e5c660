#pragma once

#include <cstdint>

namespace formwork {

/// Mixes the bits of a number, for keys of hashed containers [Steele et al. 2014, SplitMix64].
inline std::uint64_t mixed_bits(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

}  // namespace formwork
