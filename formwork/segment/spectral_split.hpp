#pragma once

#include <array>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/mesh/surface.hpp"
#include "arcsim/mesh/topology.hpp"

namespace formwork {

using arcsim::Surface;
using arcsim::Topology;

enum class SplitMethod { spectral, spectral_stable };

inline constexpr std::array split_method_names{
    arcsim::EnumName{SplitMethod::spectral, "spectral", "as the source writes it: exp(-p w), plain Laplacian, k-means"},
    arcsim::EnumName{SplitMethod::spectral_stable, "spectral_stable",
                     "scale-free weights with a floor, normalised, two parts at a time by the best sweep cut"}};

/// How a panel that is too far from developable is split (source §8.2).
struct SplitParams {
    SplitMethod method = SplitMethod::spectral_stable;
    double p = 1;        // contrast; spectral: of |eta_a - eta_b|, spectral_stable: of it divided by its median
    int k = 2;           // number of parts
};

/// Keys of the `segment` block.
template <class Archive>
void visit(Archive& a, SplitParams& p) {
    a.choice("split", p.method, split_method_names, "How a panel too far from developable is split (source §8.2).");
    a.optional("split_contrast", p.p, "", arcsim::positive,
               "p of the split's weights exp(-p w); for spectral_stable w is divided by its median.");
    a.optional("split_parts", p.k, "", arcsim::between(2, 64), "k: number of parts that a panel is split into.");
}

/// Splits a connected set of faces where the developability eta changes.
///
/// `spectral`, literally: w = |eta_a - eta_b| between neighbouring faces (a face's eta: the sum over its corners),
/// A = exp(-p w), the k eigenvectors of the plain Laplacian with the smallest eigenvalues, k-means of the rows.
/// Small p makes all weights one and ignores eta; large p cuts off single faces or leaves a numerically
/// disconnected graph.
///
/// `spectral_stable`: A = max(1e-3, exp(-p w / median w)) times edge length over dual length, symmetric normalised
/// Laplacian [Ng, Jordan, Weiss 2001], Fiedler vector, the prefix of least conductance; parts below 2 % of the
/// area join their longest neighbour. k > 2: the part of largest energy (15) is split next.
///
/// @param faces   of `s`, connected
/// @param eta     per node (covariance_eta)
/// @returns part per entry of `faces`, 0 .. m-1, each part connected, in the order of their first faces.
///          m = k where the set can be split so; `spectral` may give more parts.
/// @throws NumericalError   the eigenvectors do not converge (`spectral` with large p)
std::vector<int> split_faces(const Surface& s, const Topology& t, const std::vector<int>& faces,
                             const std::vector<double>& eta, const SplitParams& params);

}  // namespace formwork
