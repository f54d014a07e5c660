#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>

#include "arcsim/base/error.hpp"
#include "arcsim/base/interrupt.hpp"
#include "formwork/cli/command_line.hpp"

int main(int argc, char** argv) {
    const auto fail = [](const char* what, int code) {
        std::fprintf(stderr, "formwork: %s\n", what);
        return code;
    };
    arcsim::catch_interrupts();
    try {
        const int code = formwork::run_command_line(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            throw arcsim::InputError(std::string("standard output cannot be written (") + std::strerror(errno) + ").");
        return code;
    } catch (const arcsim::InputError& e) {
        return fail(e.what(), 2);
    } catch (const arcsim::NumericalError& e) {
        return fail(e.what(), 3);
    } catch (const arcsim::Interrupted&) {
        return fail("interrupted; finished stages are kept, --resume goes on after them.", 130);
    } catch (const std::bad_alloc&) {
        return fail("out of memory. Use a coarser mesh.", 3);
    } catch (const std::exception& e) {
        return fail((std::string("internal error: ") + e.what() + ". Please report it with the scene.").c_str(), 3);
    }
}
