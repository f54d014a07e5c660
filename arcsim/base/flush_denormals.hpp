#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace arcsim {

/// Within its scope numbers too small for a normal float or double count as zero on this thread. Entries of a factor decay
/// fast away from their row's place; as denormals each would cost a hundred times a normal number.
class FlushDenormals {
public:
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;
#if defined(__SSE__)
    FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }   // flush to zero, denormals are zero
    ~FlushDenormals() { _mm_setcsr(before_); }

private:
    unsigned before_;
#else
    FlushDenormals() {}
#endif
};

}  // namespace arcsim
