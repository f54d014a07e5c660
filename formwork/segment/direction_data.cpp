#include "formwork/segment/direction_data.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "arcsim/base/error.hpp"
#include "formwork/segment/anisotropy_weight.hpp"
#include "formwork/segment/angle_transport.hpp"

namespace formwork {
namespace {

/// A symmetric 2x2 tensor: its mean eigenvalue, and half their difference times exp(2 i angle). Turning the
/// frame multiplies the second part only.
struct Tensor {
    double mean = 0;
    std::complex<double> deviator = 0;
};

/// C - I of one face in its own frame; nothing of slack faces.
Tensor strain_tensor(const arcsim::FaceFrame& frame, const FaceStrain& e) {
    if (e.state == FaceState::slack) return {};
    // Across the wrinkles the fabric only folds: that shortening is no strain.
    const double across = e.state == FaceState::wrinkled ? std::max(e.lambda2, std::min(1.0, e.lambda1)) : e.lambda2;
    const double a = e.lambda1 * e.lambda1 - 1, b = across * across - 1;
    return {(a + b) / 2, std::polar((a - b) / 2, 2 * frame.angle(e.dir))};
}

}  // namespace

std::vector<double> anisotropy_weights(const Topology& t, const std::vector<double>& anisotropy, double least_a0) {
    const int n = static_cast<int>(anisotropy.size());
    std::vector<double> noise(n);
    for (int f = 0; f < n; ++f) {
        double sum = 0;
        int count = 0;
        for (int k = 0; k < 3; ++k)
            if (const int g = t.neighbour(f, k); g >= 0) sum += anisotropy[g], ++count;
        noise[f] = count ? std::abs(anisotropy[f] - sum / count) : 0;
    }
    double a0 = least_a0;
    if (n > 0) {
        std::nth_element(noise.begin(), noise.begin() + n / 2, noise.end());
        a0 = std::max(a0, 2 * noise[n / 2]);
    }
    std::vector<double> weight(n, 0.0);
    for (int f = 0; f < n; ++f) {
        const double a2 = anisotropy[f] * anisotropy[f];
        if (a2 > 0) weight[f] = a2 / (a2 + a0 * a0);
    }
    return weight;
}

std::vector<DirectionData> directions_from_strain(const Surface& rest, const Topology& t, const StrainField& strain,
                                                  const DirectionParams& params) {
    const int n = rest.n_faces();
    if (static_cast<int>(strain.size()) != n)
        throw arcsim::InputError("strain of " + std::to_string(strain.size()) + " faces, the mesh has " +
                                 std::to_string(n) + ". Run inflate again for this mesh.");
    std::vector<Tensor> tensor(n);
    std::vector<double> area(n);
    for (int f = 0; f < n; ++f) {
        const FaceStrain& e = strain[f];
        if (!std::isfinite(e.lambda1) || !std::isfinite(e.lambda2) || !e.dir.allFinite())
            throw arcsim::InputError("strain of face " + std::to_string(f) +
                                     " is not a number. Run inflate again, or repair strain.csv.");
        tensor[f] = strain_tensor(arcsim::face_frame(rest, f), e);
        area[f] = e.state == FaceState::slack ? 0 : arcsim::face_area(rest, f);
    }
    const std::vector<double> kappa = transport_angles(rest, t);
    for (int ring = 0; ring < params.averaging_rings; ++ring) {
        std::vector<Tensor> next(n);
        for (int f = 0; f < n; ++f) {
            if (area[f] == 0) continue;
            Tensor sum{area[f] * tensor[f].mean, area[f] * tensor[f].deviator};
            double total = area[f];
            for (int k = 0; k < 3; ++k) {
                const int g = t.neighbour(f, k);
                if (g < 0) continue;
                const double turn = transport_from(t, kappa, t.face_edges[f][k], g);
                sum.mean += area[g] * tensor[g].mean;
                sum.deviator += area[g] * tensor[g].deviator * std::polar(1.0, 2 * turn);
                total += area[g];
            }
            next[f] = {sum.mean / total, sum.deviator / total};
        }
        tensor.swap(next);
    }
    std::vector<DirectionData> data(n);
    std::vector<double> anisotropy(n);
    for (int f = 0; f < n; ++f) {
        const double half = std::abs(tensor[f].deviator);
        data[f].theta = half > 0 ? std::arg(tensor[f].deviator) / 2 : 0;
        data[f].s1 = std::sqrt(std::max(0.0, 1 + tensor[f].mean + half));
        data[f].s2 = std::sqrt(std::max(0.0, 1 + tensor[f].mean - half));
        anisotropy[f] = data[f].s1 - data[f].s2;
    }
    const std::vector<double> weight = anisotropy_weights(t, anisotropy, params.anisotropy);
    for (int f = 0; f < n; ++f) data[f].weight = area[f] > 0 ? weight[f] : 0;
    return data;
}

}  // namespace formwork
