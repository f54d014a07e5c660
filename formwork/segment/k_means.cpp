#include "formwork/segment/k_means.hpp"

#include <cstdint>
#include <limits>

namespace formwork {
namespace {

struct Numbers {   // xorshift: the standard's distributions differ between libraries
    std::uint64_t state = 0x2545f4914f6cdd1dull;
    double operator()() {
        state ^= state << 13, state ^= state >> 7, state ^= state << 17;
        return static_cast<double>(state >> 11) / 9007199254740992.0;
    }
};

double distance2(const double* a, const double* b, int d) {
    double sum = 0;
    for (int i = 0; i < d; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/// k-means++: each seed is drawn with a chance proportional to its squared distance to those before.
std::vector<double> choose_seeds(const std::vector<double>& points, int n, int d, int k, Numbers& random) {
    std::vector<double> centre, nearest(n, std::numeric_limits<double>::infinity());
    int chosen = static_cast<int>(random() * n);
    while (true) {
        centre.insert(centre.end(), points.begin() + chosen * d, points.begin() + (chosen + 1) * d);
        if (static_cast<int>(centre.size()) == k * d) return centre;
        double total = 0;
        for (int i = 0; i < n; ++i) {
            nearest[i] = std::min(nearest[i], distance2(&points[i * d], &centre[centre.size() - d], d));
            total += nearest[i];
        }
        double target = random() * total;
        for (chosen = 0; chosen < n - 1; ++chosen)
            if ((target -= nearest[chosen]) < 0) break;
    }
}

}  // namespace

std::vector<int> k_means(const std::vector<double>& points, int n, int d, int k) {
    constexpr int starts = 10, max_steps = 100;
    Numbers random;
    std::vector<int> best;
    double best_sum = std::numeric_limits<double>::infinity();
    for (int start = 0; start < starts; ++start) {
        std::vector<double> centre = choose_seeds(points, n, d, k, random);
        std::vector<int> label(n, -1);
        double sum = 0;
        for (int step = 0; step < max_steps; ++step) {
            bool changed = false;
            sum = 0;
            for (int i = 0; i < n; ++i) {
                int to = 0;
                double least = std::numeric_limits<double>::infinity();
                for (int c = 0; c < k; ++c)
                    if (const double r = distance2(&points[i * d], &centre[c * d], d); r < least) least = r, to = c;
                changed |= label[i] != to;
                label[i] = to;
                sum += least;
            }
            if (!changed) break;
            std::vector<double> total(k * d, 0.0);
            std::vector<int> count(k, 0);
            for (int i = 0; i < n; ++i) {
                ++count[label[i]];
                for (int j = 0; j < d; ++j) total[label[i] * d + j] += points[i * d + j];
            }
            for (int c = 0; c < k; ++c)
                for (int j = 0; count[c] > 0 && j < d; ++j) centre[c * d + j] = total[c * d + j] / count[c];
        }
        if (sum < best_sum) {
            best_sum = sum;
            best = std::move(label);
        }
    }
    return best;
}

}  // namespace formwork
