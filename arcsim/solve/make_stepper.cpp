#include "arcsim/solve/converged_stepper.hpp"

namespace arcsim {

std::unique_ptr<ClothStepper> make_stepper(ClothModel& model, const StepParams& params, FillOrder order) {
    if (params.method == StepMethod::backward_euler) return std::make_unique<LinearizedEuler>(model, params, order);
    return std::make_unique<ConvergedStepper>(model, params, order);
}

}  // namespace arcsim
