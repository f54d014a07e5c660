#pragma once

#include <memory>

#include "arcsim/scene/build_cloth.hpp"
#include "arcsim/scene/handles.hpp"
#include "arcsim/scene/morph.hpp"
#include "arcsim/solve/cloth_stepper.hpp"

namespace arcsim {

/// One cloth of a running scene.
struct RunningCloth {
    ClothMesh mesh;                           // as placed; its x and v follow the state only in `frame`
    ClothModel model;
    std::unique_ptr<Handles> handles;
    std::unique_ptr<ClothStepper> stepper;
    State state;
    VectorXd lagged_x;                        // positions one step earlier
    VectorXd start_x;                         // of the step under way

    ClothMesh frame() const;                  // the mesh with the present positions and velocities
    void set_frame(const ClothMesh& frame);   // takes positions and velocities
};

/// A scene that runs: cloths, time, and the order in which things happen in a step.
///
/// Construction does what ArcSim does before frame 0: relax, anchor the handles that are active at t = 0,
/// relax again.
class Simulation {
public:
    /// Keeps references to `scene` and `motions`. @throws InputError: the cloths cannot be built
    Simulation(const SceneParams& scene, const std::vector<Motion>& motions, std::vector<Morph> morphs = {});

    /// Time first, then handles at the new time with the old positions, wind and forces, the solve, what is
    /// lagged, positions. @throws NumericalError naming step, time, cloth and remedy
    void step();

    double time() const { return time_; }
    long steps() const { return steps_; }
    std::vector<RunningCloth>& cloths() { return cloths_; }
    const std::vector<RunningCloth>& cloths() const { return cloths_; }
    void set_time(double time, long steps) { time_ = time, steps_ = steps; }
    /// Stretch beyond which the linearised step is not to be trusted, and whether it was seen.
    std::string take_warning();

private:
    const SceneParams& scene_;
    std::vector<Morph> morphs_;
    double time_ = 0;
    long steps_ = 0;
    std::vector<RunningCloth> cloths_;
    std::string warning_;
    bool has_warned_ = false;
};

}  // namespace arcsim
