#include "formwork/segment/sparse_cholesky.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <string>
#include <utility>

#include "arcsim/base/error.hpp"

extern "C" {
// OpenBLAS has it; any other BLAS leaves the symbols empty.
void openblas_set_num_threads(int) __attribute__((weak));
int openblas_get_num_threads() __attribute__((weak));
}

namespace formwork {
namespace {

/// Holds BLAS to one thread while alive: sums of several threads depend on how many there are.
struct OneBlasThread {
    int before = 0;
    OneBlasThread() {
        if (openblas_get_num_threads == nullptr || openblas_set_num_threads == nullptr) return;
        before = openblas_get_num_threads();
        if (before != 1) openblas_set_num_threads(1);
    }
    ~OneBlasThread() {
        if (before > 1) openblas_set_num_threads(before);
    }
    OneBlasThread(const OneBlasThread&) = delete;
    OneBlasThread& operator=(const OneBlasThread&) = delete;
};

}  // namespace

struct SparseCholesky::Impl {
    cholmod_common common{};
    cholmod_factor* symbolic = nullptr;
    cholmod_factor* factor = nullptr;
    const LowerPattern* pattern = nullptr;
    mutable std::vector<double> work;        // for energy_norm: zero between calls
    mutable std::vector<int> path;
    std::vector<int> position;               // of an unknown in the elimination order

    Impl() {
        cholmod_start(&common);
        common.print = 0;
        common.quick_return_if_not_posdef = 1;
        common.nmethods = 1;
        common.method[0].ordering = CHOLMOD_NESDIS;   // its short elimination trees make energy_norm half as dear as AMD's
        common.postorder = 1;
    }
    ~Impl() {
        if (factor) cholmod_free_factor(&factor, &common);
        if (symbolic) cholmod_free_factor(&symbolic, &common);
        cholmod_finish(&common);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    cholmod_sparse view(const void* values, int xtype) {
        cholmod_sparse a{};
        a.nrow = a.ncol = static_cast<std::size_t>(pattern->n);
        a.nzmax = pattern->row.size();
        a.p = const_cast<int*>(pattern->column.data());
        a.i = const_cast<int*>(pattern->row.data());
        a.x = const_cast<void*>(values);
        a.stype = -1;
        a.itype = CHOLMOD_INT;
        a.xtype = xtype;
        a.dtype = CHOLMOD_DOUBLE;
        a.sorted = a.packed = 1;
        return a;
    }

    void factorize(const void* values, int xtype) {
        const OneBlasThread one;
        if (factor) cholmod_free_factor(&factor, &common);
        factor = cholmod_copy_factor(symbolic, &common);
        cholmod_sparse a = view(values, xtype);
        const bool done = factor && cholmod_factorize(&a, factor, &common) && common.status == CHOLMOD_OK &&
                          factor->minor == factor->n;
        if (!done)
            throw arcsim::NumericalError("cross field: the factorisation failed at unknown " +
                                         std::to_string(factor ? factor->minor : 0) + " of " +
                                         std::to_string(pattern->n) +
                                         ". Look for degenerate faces, or give at least one direction.");
    }

    void solve(void* b, int xtype) {
        const OneBlasThread one;
        cholmod_dense rhs{};
        rhs.nrow = rhs.d = rhs.nzmax = static_cast<std::size_t>(pattern->n);
        rhs.ncol = 1;
        rhs.x = b;
        rhs.xtype = xtype;
        rhs.dtype = CHOLMOD_DOUBLE;
        cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor, &rhs, &common);
        if (!x) throw arcsim::NumericalError("cross field: the back-substitution ran out of memory");
        const std::size_t doubles = rhs.nrow * (xtype == CHOLMOD_COMPLEX ? 2 : 1);
        std::copy_n(static_cast<const double*>(x->x), doubles, static_cast<double*>(b));
        cholmod_free_dense(&x, &common);
    }
};

SparseCholesky::SparseCholesky(const LowerPattern& pattern) : impl_(std::make_unique<Impl>()) {
    impl_->pattern = &pattern;
    const std::vector<double> ones(pattern.row.size(), 1.0);
    cholmod_sparse a = impl_->view(ones.data(), CHOLMOD_REAL);
    impl_->symbolic = cholmod_analyze(&a, &impl_->common);
    if (!impl_->symbolic && impl_->common.status == CHOLMOD_NOT_INSTALLED) {   // a CHOLMOD without METIS
        impl_->common.method[0].ordering = CHOLMOD_AMD;
        impl_->symbolic = cholmod_analyze(&a, &impl_->common);
    }
    if (!impl_->symbolic) throw arcsim::NumericalError("cross field: the ordering ran out of memory");
}

SparseCholesky::SparseCholesky(const SparseCholesky& same_pattern, int) : impl_(std::make_unique<Impl>()) {
    impl_->pattern = same_pattern.impl_->pattern;
    impl_->symbolic = cholmod_copy_factor(same_pattern.impl_->symbolic, &impl_->common);
    if (!impl_->symbolic) throw arcsim::NumericalError("cross field: the ordering ran out of memory");
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::factorize(const std::vector<double>& values) {
    Impl& m = *impl_;
    m.factorize(values.data(), CHOLMOD_REAL);
    // energy_norm walks plain columns.
    cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, m.factor, &m.common);
    m.work.assign(values.empty() ? 0 : m.factor->n, 0.0);
    m.position.resize(m.factor->n);
    for (std::size_t k = 0; k < m.factor->n; ++k) m.position[static_cast<int*>(m.factor->Perm)[k]] = static_cast<int>(k);
}

void SparseCholesky::factorize(const std::vector<std::complex<double>>& values) {
    impl_->factorize(values.data(), CHOLMOD_COMPLEX);
}

void SparseCholesky::solve(std::vector<double>& b) const { impl_->solve(b.data(), CHOLMOD_REAL); }
void SparseCholesky::solve(std::vector<std::complex<double>>& b) const { impl_->solve(b.data(), CHOLMOD_COMPLEX); }

double SparseCholesky::energy_norm(const std::vector<Entry>& b) const {
    Impl& m = *impl_;
    const cholmod_factor& f = *m.factor;
    assert(!f.is_super && !f.is_ll && f.xtype == CHOLMOD_REAL);
    const int* start = static_cast<const int*>(f.p);
    const int* count = static_cast<const int*>(f.nz);
    const int* row = static_cast<const int*>(f.i);
    const double* x = static_cast<const double*>(f.x);
    // Columns on the paths to the root, each once, in increasing order: parent(j) is the first row below j.
    m.path.clear();
    for (const Entry& e : b) {
        m.work[m.position[e.index]] += e.value;
        m.path.push_back(m.position[e.index]);
    }
    std::make_heap(m.path.begin(), m.path.end(), std::greater<>{});
    double sum = 0;
    int last = -1;
    while (!m.path.empty()) {
        std::pop_heap(m.path.begin(), m.path.end(), std::greater<>{});
        const int j = m.path.back();
        m.path.pop_back();
        if (j == last) continue;
        last = j;
        const double y = m.work[j];
        m.work[j] = 0;
        const int s = start[j], n = count[j];
        sum += y * y / x[s];                       // D_jj is stored in place of the unit diagonal
        for (int k = 1; k < n; ++k) m.work[row[s + k]] -= x[s + k] * y;
        if (n > 1) {
            m.path.push_back(row[s + 1]);
            std::push_heap(m.path.begin(), m.path.end(), std::greater<>{});
        }
    }
    return sum;
}

}  // namespace formwork
