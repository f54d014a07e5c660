#pragma once

namespace formwork {

/// Reads the arguments, runs the command. @returns the exit code
/// @throws InputError, NumericalError, Interrupted
int run_command_line(int argc, char** argv);

}  // namespace formwork
