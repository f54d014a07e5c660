#include "arcsim/scene/simulation.hpp"

#include "arcsim/base/error.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/solve/start_relaxation.hpp"

namespace arcsim {

namespace {

void check_targets(const Morph& morph, size_t number, int n_nodes) {
    for (size_t t = 0; t < morph.targets.size(); ++t)
        if (morph.targets[t].size() != 3 * n_nodes)
            throw InputError("/morphs/" + std::to_string(number) + ": target " + std::to_string(t) + " has " +
                             std::to_string(morph.targets[t].size() / 3) + " nodes, the cloth " + std::to_string(n_nodes) + ".");
}

}  // namespace

ClothMesh RunningCloth::frame() const {
    ClothMesh m = mesh;
    for (int i = 0; i < m.n_nodes(); ++i) {
        m.x[i] = state.x.segment<3>(3 * i);
        m.v[i] = state.v.segment<3>(3 * i);
    }
    return m;
}

void RunningCloth::set_frame(const ClothMesh& frame) {
    for (int i = 0; i < frame.n_nodes(); ++i) {
        state.x.segment<3>(3 * i) = frame.x[i];
        state.v.segment<3>(3 * i) = frame.v[i];
    }
}

Simulation::Simulation(const SceneParams& scene, const std::vector<Motion>& motions, std::vector<Morph> morphs)
    : scene_(scene), morphs_(std::move(morphs)) {
    for (size_t m = 0; m < morphs_.size(); ++m)
        if (morphs_[m].cloth >= static_cast<int>(scene.cloths.size()))
            throw InputError("/morphs/" + std::to_string(m) + ": cloth " + std::to_string(morphs_[m].cloth) + " does not exist; there are " +
                             std::to_string(scene.cloths.size()) + ", counted from 0.");
    cloths_.resize(scene.cloths.size());   // never resized again: handles and steppers keep references
    for (size_t c = 0; c < cloths_.size(); ++c) {
        RunningCloth& cloth = cloths_[c];
        cloth.mesh = place_mesh(scene.cloths[c]);
        cloth.model = build_model(cloth.mesh, scene.cloths[c], scene);
        cloth.handles = std::make_unique<Handles>(scene, static_cast<int>(c), cloth.mesh, motions);
        cloth.model.springs.reserve_pairs(cloth.handles->glued_pairs());
        cloth.stepper = make_stepper(cloth.model, scene.solver);
        std::vector<const Morph*> own;
        for (size_t m = 0; m < morphs_.size(); ++m) {
            if (morphs_[m].cloth != static_cast<int>(c)) continue;
            check_targets(morphs_[m], m, cloth.mesh.n_nodes());
            own.push_back(&morphs_[m]);
        }
        cloth.stepper->place_handles = [&cloth, own](double time) {
            cloth.handles->update(time, cloth.state.x, cloth.model);
            for (const Morph* m : own) m->add_springs(time, cloth.model.springs.targets());
        };
        State& s = cloth.state;
        s.x.resize(3 * cloth.mesh.n_nodes());
        s.v = s.x;
        cloth.set_frame(cloth.mesh);

        ClothSystem& system = cloth.stepper->system();
        if (relax_start(system, s.x) > 0) cloth.model.refresh(s.x);
        cloth.handles->update(0, s.x, cloth.model);
        if (relax_start(system, s.x) > 0) cloth.model.refresh(s.x);
        cloth.lagged_x = s.x;
    }
}

void Simulation::step() {
    const double h = scene_.step();
    const double new_time = time_ + h;
    for (size_t c = 0; c < cloths_.size() && !scene_.disables("physics"); ++c) {
        RunningCloth& cloth = cloths_[c];
        cloth.stepper->place_handles(new_time);
        cloth.state.time = new_time;
        cloth.start_x = cloth.state.x;
        try {
            cloth.stepper->step(cloth.state, h);
        } catch (const NumericalError& e) {
            throw NumericalError("step " + std::to_string(steps_ + 1) + ", t = " + format_short(new_time, 6) + " s, cloth " +
                                 std::to_string(c) + ": " + e.what() + ". Take smaller steps (/frame_steps), or " +
                                 (scene_.solver.method == StepMethod::backward_euler
                                      ? "/solver/method \"newton_euler\"."
                                      : "raise /solver/max_halvings or /solver/max_iterations."));
        }
        cloth.lagged_x.swap(cloth.start_x);
        constexpr double unlikely_stretch = 2;   // no cloth: the linearised step has overshot
        if (!has_warned_) {
            const auto [face, stretch] = cloth.model.stretch->largest_stretch(cloth.state.x);
            if (!(stretch <= unlikely_stretch)) {
                warning_ = "step " + std::to_string(steps_ + 1) + ", t = " + format_short(new_time, 6) + " s: face " +
                           std::to_string(face) + " of cloth " + std::to_string(c) + " is stretched " + format_short(stretch) +
                           (scene_.solver.method == StepMethod::backward_euler
                                ? " times. Unless handles ask for it, the step is too large for the linearised solve: raise /frame_steps, or "
                                  "use /solver/method \"newton_euler\"."
                                : " times, and the step has converged: handles or loads ask for it. A lower /solver/max_stretch stops such runs.");
                has_warned_ = true;
            }
        }
    }
    time_ = new_time;
    ++steps_;
}

std::string Simulation::take_warning() { return std::exchange(warning_, {}); }

}  // namespace arcsim
