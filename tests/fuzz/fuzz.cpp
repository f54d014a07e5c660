#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "arcsim/base/error.hpp"
#include "tests/fuzz/targets.hpp"

/// Entry of libFuzzer: FUZZ_TARGET=obj build/fuzz/fuzz CORPUS. Anything but an InputError is a find.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const formwork::FuzzTarget* const target = [] {
        const char* name = std::getenv("FUZZ_TARGET");
        for (const formwork::FuzzTarget& t : formwork::fuzz_targets())
            if (name && t.name == name) return &t;
        std::fputs("fuzz: set FUZZ_TARGET to one of:", stderr);
        for (const formwork::FuzzTarget& t : formwork::fuzz_targets()) std::fprintf(stderr, " %s", t.name.c_str());
        std::fputc('\n', stderr);
        std::exit(2);
    }();
    try {
        target->run({reinterpret_cast<const char*>(data), size});
    } catch (const arcsim::InputError&) {
    }
    return 0;
}
