#include "formwork/study/sparse_lu.hpp"

#include <umfpack.h>

#include "arcsim/base/error.hpp"

namespace formwork {

struct SparseLu::Factors {
    Eigen::SparseMatrix<double> A;
    void* symbolic = nullptr;
    void* numeric = nullptr;
    ~Factors() {
        if (numeric) umfpack_di_free_numeric(&numeric);
        if (symbolic) umfpack_di_free_symbolic(&symbolic);
    }
};

SparseLu::SparseLu() : factors_(std::make_unique<Factors>()) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;

bool SparseLu::factorize(const Eigen::SparseMatrix<double>& A) {
    Factors& f = *factors_;
    f.A = A;
    f.A.makeCompressed();
    const int n = static_cast<int>(A.rows());
    const int *p = f.A.outerIndexPtr(), *i = f.A.innerIndexPtr();
    const double* v = f.A.valuePtr();
    if (!f.symbolic && umfpack_di_symbolic(n, n, p, i, v, &f.symbolic, nullptr, nullptr) != UMFPACK_OK)
        throw arcsim::NumericalError("strip: UMFPACK could not analyse the matrix");
    if (f.numeric) umfpack_di_free_numeric(&f.numeric);
    return umfpack_di_numeric(p, i, v, f.symbolic, &f.numeric, nullptr, nullptr) == UMFPACK_OK;
}

arcsim::VectorXd SparseLu::solve(const arcsim::VectorXd& b, int system) const {
    const Factors& f = *factors_;
    arcsim::VectorXd x(b.size());
    if (umfpack_di_solve(system, f.A.outerIndexPtr(), f.A.innerIndexPtr(), f.A.valuePtr(), x.data(), b.data(),
                         f.numeric, nullptr, nullptr) != UMFPACK_OK)
        throw arcsim::NumericalError("strip: UMFPACK could not solve with its factors");
    return x;
}

arcsim::VectorXd SparseLu::solve(const arcsim::VectorXd& b) const { return solve(b, UMFPACK_A); }
arcsim::VectorXd SparseLu::solve_transposed(const arcsim::VectorXd& b) const { return solve(b, UMFPACK_At); }

}  // namespace formwork
