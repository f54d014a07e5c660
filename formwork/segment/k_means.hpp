#pragma once

#include <vector>

namespace formwork {

/// Labels 0 .. k-1 of the rows of `points` (n rows of d numbers, row after row): Lloyd's iteration from
/// k-means++ seeds, ten starts, the tightest kept. The same on every machine.
std::vector<int> k_means(const std::vector<double>& points, int n, int d, int k);

}  // namespace formwork
