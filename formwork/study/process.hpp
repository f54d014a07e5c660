#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace formwork {

/// This program's own file, for starting it again.
std::filesystem::path own_program();

/// Starts a program whose output goes to a file. It gets one BLAS and one OpenMP thread, since several run at
/// once, and dies with its parent: nothing goes on unseen when the parent is killed.
/// @throws NumericalError when the system refuses a process
pid_t start_process(const std::vector<std::string>& arguments, const std::filesystem::path& log);

/// Ended children: process number and exit code (128 + signal for a killed one).
struct EndedProcess {
    pid_t pid = 0;
    int exit_code = 0;
};
/// The next child that ends within `seconds`; pid 0: none did.
EndedProcess wait_for_process(double seconds);

}  // namespace formwork
