#include "arcsim/solve/full_matrix.hpp"

namespace arcsim {

Eigen::SparseMatrix<double> full_matrix(const BlockMatrix& A, bool with_skew) {
    const BlockPattern& p = A.pattern();
    const double* skew = with_skew ? A.skew_values() : nullptr;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(2 * static_cast<std::size_t>(p.n_values()));
    for (int c = 0; c < p.n_dofs(); ++c)
        for (int k = p.col_ptr()[c]; k < p.col_ptr()[c + 1]; ++k) {
            const int r = p.row_index()[k];
            if (r < c) continue;
            const double s = A.values()[k], t = skew && r > c ? skew[k] : 0;
            entries.emplace_back(r, c, s + t);
            if (r > c) entries.emplace_back(c, r, s - t);
        }
    Eigen::SparseMatrix<double> M(p.n_dofs(), p.n_dofs());
    M.setFromTriplets(entries.begin(), entries.end());
    return M;
}

VectorXd to_places(const BlockPattern& p, const VectorXd& b) {
    VectorXd out(b.size());
    for (int k = 0; k < p.n_nodes(); ++k) out.segment<3>(3 * k) = b.segment<3>(3 * p.node_at()[k]);
    return out;
}

VectorXd to_nodes(const BlockPattern& p, const VectorXd& b) {
    VectorXd out(b.size());
    for (int k = 0; k < p.n_nodes(); ++k) out.segment<3>(3 * p.node_at()[k]) = b.segment<3>(3 * k);
    return out;
}

}  // namespace arcsim
