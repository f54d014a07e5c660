#pragma once

#include <vector>

#include "formwork/segment/sparse_cholesky.hpp"

namespace formwork {

/// A weighted graph of few neighbours per vertex, for cuts.
struct WeightedGraph {
    struct Link {
        int a, b;        // a < b
        double weight;
    };
    int n = 0;
    std::vector<Link> links;
};

/// Eigenvectors of the k smallest eigenvalues.
struct LowModes {
    std::vector<double> value;                 // k, increasing
    std::vector<std::vector<double>> vector;   // k of n each, of unit length
};

/// Low modes of the graph Laplacian D - A, or of I - D^-1/2 A D^-1/2 when `normalised`. Shift-inverted subspace
/// iteration with spare vectors: copes with equal eigenvalues, which symmetric shapes have.
/// @throws NumericalError   more than k eigenvalues are numerically zero (the weights fall apart), or no convergence
LowModes low_modes(const WeightedGraph& graph, int k, bool normalised);

}  // namespace formwork
