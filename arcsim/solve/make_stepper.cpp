#include "arcsim/solve/cloth_stepper.hpp"

namespace arcsim {

std::unique_ptr<ClothStepper> make_stepper(ClothModel& model, const StepParams& params, FillOrder order) {
    return std::make_unique<LinearizedEuler>(model, params, order);
}

}  // namespace arcsim
