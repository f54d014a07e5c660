#include <Eigen/Core>
#include <string>

#include "formwork/cli/session.hpp"

// OpenBLAS declares these in a header that the package does not install for every variant.
extern "C" char* openblas_get_corename();
extern "C" char* openblas_get_config();

namespace formwork {

std::string version_text() {
    const auto number = [](int n) { return std::to_string(n); };
    return "formwork " FORMWORK_VERSION "\ncompiler  g++ " __VERSION__ "\nEigen     " + number(EIGEN_WORLD_VERSION) + "." + number(EIGEN_MAJOR_VERSION) +
           "." + number(EIGEN_MINOR_VERSION) + "\nBLAS      kernel " + openblas_get_corename() + "; " + openblas_get_config() +
           "\n          (set OPENBLAS_CORETYPE when the kernel does not suit the processor)";
}

}  // namespace formwork
