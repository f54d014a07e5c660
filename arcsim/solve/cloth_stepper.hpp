#pragma once

#include <functional>
#include <memory>

#include "arcsim/solve/cloth_system.hpp"
#include "arcsim/solve/limit_projection.hpp"
#include "arcsim/solve/step_params.hpp"

namespace arcsim {

struct StepResult {
    int iterations = 1;
    double residual = 0;     // relative; of the converged methods
    int halvings = 0;        // the finest division of the step
};

/// Advances one cloth in time. A stepper keeps its matrix and analysis, and what its method remembers of
/// earlier steps.
class ClothStepper {
public:
    virtual ~ClothStepper() = default;
    /// From s.time - h to s.time: the caller has advanced s.time and put the handles where they are then.
    /// @throws NumericalError: the numbers refused; s is as it was
    virtual StepResult step(State& s, double h) = 0;
    /// Forgets earlier steps: the next one stands alone.
    virtual void restart();
    /// What is remembered beside the State, for files: the strain limits' multipliers, then the method's own.
    std::vector<double> memory() const;
    void set_memory(const std::vector<double>& memory);
    /// Puts the handles where they are at a time, for methods that divide a step.
    std::function<void(double time)> place_handles = [](double) {};
    const StepCost& cost() const { return cost_; }
    ClothSystem& system() { return system_; }

protected:
    ClothStepper(ClothModel& model, const StepParams& params, FillOrder order)
        : params_(params), system_(model, order, params.linear_solver) {}
    virtual std::vector<double> own_memory() const { return {}; }
    virtual void set_own_memory(const std::vector<double>&) {}
    /// Throws when a position is not finite or a face is beyond the limit; names the face.
    void check_state(const VectorXd& x, double max_stretch);
    /// For messages: a node and the first face at it.
    std::string place_of(int node) const;

    StepParams params_;
    ClothSystem system_;
    StepCost cost_;
};

std::unique_ptr<ClothStepper> make_stepper(ClothModel& model, const StepParams& params,
                                           FillOrder order = FillOrder::automatic);

/// ArcSim's step: backward Euler linearised once from the current state,
///
///   (M + sum h (h + beta) H) v' = M v + h f,   x' = x + h v'
///
/// the same as A dv = b with b = h f - h (h + beta) H v. H: the definite tangents.
class LinearizedEuler final : public ClothStepper {
public:
    LinearizedEuler(ClothModel& model, const StepParams& params, FillOrder order)
        : ClothStepper(model, params, order) {
        if (model.limits) projection_ = std::make_unique<LimitProjection>(system_);
    }
    StepResult step(State& s, double h) override;
    void restart() override;

private:
    std::vector<double> own_memory() const override { return {previous_v_.begin(), previous_v_.end()}; }
    void set_own_memory(const std::vector<double>& memory) override;

    VectorXd f_, b_, v_, x_;
    VectorXd previous_v_;   // at the start of the step before: only the solver's guess depends on it
    std::vector<Vector3d> held_velocity_;
    std::unique_ptr<LimitProjection> projection_;   // made when the model has limits
};

}  // namespace arcsim
