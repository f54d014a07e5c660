#pragma once

namespace arcsim {

/// Ctrl-C (SIGINT) and SIGTERM set a flag; long loops ask for it at safe points, where their state is whole.
/// A second Ctrl-C ends the program at once.
void catch_interrupts();                 ///< called once by main
bool interrupt_requested();
void throw_if_interrupted();             ///< @throws Interrupted

}  // namespace arcsim
