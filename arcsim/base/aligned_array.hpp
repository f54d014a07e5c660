#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace arcsim {

/// Frees what `aligned_array` gave.
struct AlignedDelete {
    std::align_val_t alignment{};
    void operator()(void* p) const { ::operator delete(p, alignment); }
};
template <class T>
using AlignedArray = std::unique_ptr<T[], AlignedDelete>;

/// n numbers, not set, that begin a cache line. Large arrays ask for large pages: a factor is visited all over, and with
/// pages of 4 kB much of the time would go to looking up where they are.
template <class T>
AlignedArray<T> aligned_array(std::size_t n) {
    static_assert(std::is_trivial_v<T>);
    constexpr std::size_t cache_line = 64, large_page = std::size_t{1} << 21;
    const std::size_t bytes = n * sizeof(T);
    const bool is_large = bytes >= 2 * large_page;
    const std::align_val_t alignment{is_large ? large_page : cache_line};
    void* p = ::operator new(bytes, alignment);
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (is_large) madvise(p, bytes, MADV_HUGEPAGE);   // advice: when refused, all is as without
#endif
    return AlignedArray<T>(static_cast<T*>(p), AlignedDelete{alignment});
}

}  // namespace arcsim
