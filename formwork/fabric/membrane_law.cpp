#include "formwork/fabric/membrane_law.hpp"

#include "formwork/fabric/isotropic_law.hpp"
#include "formwork/fabric/tensor_law.hpp"

namespace formwork {

std::unique_ptr<MembraneLaw> make_membrane_law(const MaterialParams& p) {
    if (p.model == FabricModel::isotropic) return std::make_unique<IsotropicMembrane>(p);
    const auto sampling = p.sampling == TableSampling::arcsim ? arcsim::Sampling::arcsim : arcsim::Sampling::exact;
    return std::make_unique<TensorMembrane>(arcsim::read_material(p.data.path).stretching, sampling,
                                            p.stretching_mult, p.compression);
}

FaceStress evaluate_one(const MembraneLaw& law, const Vector3d& eps, Want want) {
    const StrainLanes e{arcsim::all_lanes(eps[0]), arcsim::all_lanes(eps[1]), arcsim::all_lanes(eps[2])};
    StressLanes s{};
    law.evaluate(e, want, s);
    FaceStress out;
    out.S = {s.uu[0], s.vv[0], s.uv[0]};
    const auto c = [&](int k) { return s.C[k][0]; };
    const auto w = [&](int k) { return s.skew[k][0]; };
    out.C << c(0), c(1) + w(0), c(2) + w(1),   //
        c(1) - w(0), c(3), c(4) + w(2),        //
        c(2) - w(1), c(4) - w(2), c(5);
    out.psi = s.psi[0];
    return out;
}

}  // namespace formwork
