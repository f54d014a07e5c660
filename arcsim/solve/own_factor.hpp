#pragma once

namespace arcsim {

/// Whether our own single-precision factor beats CHOLMOD in this build. Its kernels are as wide as the instructions
/// that the compiler may use, while CHOLMOD's BLAS chooses its own when it starts: without fused multiply-add, in builds
/// for any x86-64 machine, CHOLMOD is the quicker one (docs/time_steps/README.md has the numbers).
#ifdef __FMA__
inline constexpr bool own_factor_is_quick = true;
#else
inline constexpr bool own_factor_is_quick = false;
#endif

}  // namespace arcsim
