#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "arcsim/base/archive.hpp"
#include "arcsim/base/json_value.hpp"
#include "arcsim/base/types.hpp"
#include "arcsim/material/stiffness_table.hpp"
#include "arcsim/solve/step_params.hpp"

/// The keys of an ArcSim scene, with ArcSim's names and defaults. One struct per object of the file.
namespace arcsim {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// x -> translate + scale * R x. The scale alone also acts on material coordinates.
struct TransformParams {
    Vector3d translate = Vector3d::Zero();               // m
    double scale = 1;
    std::array<double, 4> rotate{0, 0, 0, 0};            // angle in degrees, axis
};
void visit(Archive& a, TransformParams& p);

/// Velocity of a node: linear + angular x (x - origin).
struct VelocityParams {
    Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero(), origin = Vector3d::Zero();
};
void visit(Archive& a, VelocityParams& p);

struct ClothMaterialParams {
    InputFile data;
    double density_mult = 1, stretching_mult = 1, bending_mult = 1, thicken = 1;
    double damping = 0;                                  // beta, s
    std::optional<std::array<double, 2>> strain_limits;   // of the principal stretches
    double yield_curv = infinity;                        // 1/m
    double weakening = 0;
    Sampling sampling = Sampling::arcsim;                // ours
};
void visit(Archive& a, ClothMaterialParams& p);

struct ClothParams {
    InputFile mesh;
    TransformParams transform;
    VelocityParams velocity;
    std::vector<ClothMaterialParams> materials;
    bool has_remeshing = false;
    JsonValue remeshing;
};
void visit(Archive& a, ClothParams& p);

enum class HandleType { node, circle, glue };
struct HandleParams {
    HandleType type = HandleType::node;
    int cloth = 0;
    std::vector<int> nodes;                              // 0-based
    int label = -1;
    int motion = -1;                                     // -1: stands still
    double start_time = 0, end_time = infinity, fade_time = 0;   // s
    double circumference = 0;                            // m; circle
    Vector2d u = Vector2d::Zero();
    Vector3d center = Vector3d::Zero(), axis0 = Vector3d::Zero(), axis1 = Vector3d::Zero();
    bool hard = false;                                   // ours: a constraint instead of springs
};
void visit(Archive& a, HandleParams& p);

struct WindParams {
    double density = 1;                                  // of the air, kg/m³
    Vector3d velocity = Vector3d::Zero();                // m/s
    double drag = 0;                                     // N s/m³
};
void visit(Archive& a, WindParams& p);

struct MagicParams {
    double handle_stiffness = 1e3;                       // N/m
    bool preserve_creases = false;
};
void visit(Archive& a, MagicParams& p);

/// The root of a scene. `formwork` scenes have one key more, read elsewhere.
struct SceneParams {
    std::optional<double> frame_time, timestep;          // s
    int frame_steps = 1, save_frames = 1;
    double end_time = infinity, duration = infinity;     // s
    double end_frame = infinity;
    std::vector<ClothParams> cloths;
    JsonValue motions = JsonValue::array();              // read by read_motions
    std::vector<HandleParams> handles;
    JsonValue morphs = JsonValue::array();               // read by read_morphs
    JsonValue obstacles = JsonValue::array();
    Vector3d gravity = Vector3d::Zero();                 // m/s²
    WindParams wind;
    std::vector<std::string> disable;
    MagicParams magic;
    StepParams solver;                                   // ours

    bool disables(std::string_view module) const;
    double step() const;                                 // h, s; 0 when the scene names none
    int steps_per_frame() const;
    double last_time() const;                            // s; infinity: none
};
void visit(Archive& a, SceneParams& p);

}  // namespace arcsim
