#include "arcsim/base/interrupt.hpp"

#include <csignal>

#include "arcsim/base/error.hpp"

namespace arcsim {

namespace {

volatile std::sig_atomic_t requested = 0;   // the one global: a signal handler can reach nothing else

void on_signal(int signal) {
    requested = 1;
    std::signal(signal, SIG_DFL);   // the next one kills
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}
bool interrupt_requested() { return requested != 0; }
void throw_if_interrupted() {
    if (requested) throw Interrupted();
}

}  // namespace arcsim
