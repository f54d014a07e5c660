#include "arcsim/scene/scene_params.hpp"

#include <algorithm>

namespace arcsim {
namespace {

constexpr std::array handle_names{EnumName{HandleType::node, "node", "holds nodes, or moves them with a motion"},
                                  EnumName{HandleType::circle, "circle", "puts labelled nodes on a circle"},
                                  EnumName{HandleType::glue, "glue", "ties two nodes"}};
constexpr std::array sampling_names{
    EnumName{Sampling::arcsim, "arcsim", "from ArcSim's grid of 30^3 points"},
    EnumName{Sampling::exact, "exact", "directly: no grid, the rest state is row 0"}};
constexpr const char* contact_only = "it belongs to contact, which is not modelled.";
constexpr const char* remeshing_only = "it belongs to remeshing, which is not modelled.";

}  // namespace

void visit(Archive& a, TransformParams& p) {
    a.optional("translate", p.translate, "m", any_number, "Shift.");
    a.optional("scale", p.scale, "", any_number, "Factor; it also acts on material coordinates.");
    a.optional("rotate", p.rotate, "degrees, -", any_number, "Angle and axis.");
}

void visit(Archive& a, VelocityParams& p) {
    a.optional("linear", p.linear, "m/s", any_number, "Velocity of the origin.");
    a.optional("angular", p.angular, "1/s", any_number, "Angular velocity.");
    a.optional("origin", p.origin, "m", any_number, "Point on the axis of rotation.");
}

void visit(Archive& a, ClothMaterialParams& p) {
    a.required("data", p.data, "File of material data: density, stretching, bending.");
    a.optional("density_mult", p.density_mult, "", positive, "Multiplies the density.");
    a.optional("stretching_mult", p.stretching_mult, "", positive, "Multiplies the stiffness table.");
    a.optional("bending_mult", p.bending_mult, "", non_negative, "Multiplies the bending stiffness.");
    a.optional("thicken", p.thicken, "", positive, "Multiplies all three.");
    a.optional("damping", p.damping, "s", non_negative, "Stiffness-proportional damping beta.");
    a.optional("strain_limits", p.strain_limits, "", any_number, "Smallest and largest principal stretch; 1: as at rest.");
    a.check(!p.strain_limits || (*p.strain_limits)[0] < (*p.strain_limits)[1], "strain_limits",
            "the first number, the smallest stretch, must be less than the second, the largest.");
    a.check(!p.strain_limits || (*p.strain_limits)[1] > 0, "strain_limits", "the largest stretch must be > 0.");
    a.optional("yield_curv", p.yield_curv, "1/m", non_negative, "Curvature at which folds stay; not modelled.");
    a.optional("weakening", p.weakening, "", non_negative, "Stiffness is divided by 1 + weakening * damage.");
    a.choice("sampling", p.sampling, sampling_names, "How the table of stiffness is evaluated.");
}

void visit(Archive& a, ClothParams& p) {
    a.required("mesh", p.mesh, "OBJ file of the cloth.");
    a.nested("transform", p.transform, "Where the mesh is put.");
    a.nested("velocity", p.velocity, "At the start.");
    a.list("materials", p.materials, "A face's label is an index into this list.");
    p.has_remeshing = a.kind("remeshing") != JsonKind::absent;
    a.raw("remeshing", p.remeshing, "ArcSim's remeshing; read only to be refused or, when disabled, ignored.");
}

void visit(Archive& a, HandleParams& p) {
    a.choice("type", p.type, handle_names, "Kind of handle.");
    a.optional("cloth", p.cloth, "", non_negative, "Index of the cloth.");
    a.optional("nodes", p.nodes, "", non_negative, "Nodes, counted from 0.");
    a.optional("label", p.label, "", at_least(-1), "Holds every node with this label, instead of nodes.");
    a.optional("motion", p.motion, "", at_least(-1), "Index of the motion; -1: stands still.");
    a.optional("start_time", p.start_time, "s", any_number, "When it takes hold.");
    a.optional("end_time", p.end_time, "s", any_number, "When it lets go.");
    a.optional("fade_time", p.fade_time, "s", non_negative, "How long letting go takes.");
    a.when(p.type == HandleType::circle, [&] {
        a.optional("circumference", p.circumference, "m", positive, "Of the circle.");
        a.optional("u", p.u, "", any_number, "Direction in material space that runs around the circle.");
        a.optional("center", p.center, "m", any_number, "Centre of the circle.");
        a.optional("axis0", p.axis0, "", any_number, "Direction of angle 0.");
        a.optional("axis1", p.axis1, "", any_number, "Direction of angle 90 degrees.");
        a.check(p.circumference > 0, "circumference", "a circle handle needs a circumference > 0 (m).");
        a.check(p.label >= 0, "label", "a circle handle needs the label of its nodes.");
    });
    a.optional("hard", p.hard, "Hold exactly instead of by springs.");
    a.check(p.type != HandleType::glue || p.nodes.size() == 2, "nodes", "a glue handle needs exactly two nodes.");
    a.check(!(p.hard && p.type == HandleType::glue), "hard", "glue ties nodes by springs only. Remove the key.");
    a.check(p.end_time >= p.start_time, "end_time", "must not come before start_time.");
}

void visit(Archive& a, WindParams& p) {
    a.optional("density", p.density, "kg/m³", non_negative, "Of the air; 0: vacuum.");
    a.optional("velocity", p.velocity, "m/s", any_number, "Of the air.");
    a.optional("drag", p.drag, "N s/m³", non_negative, "Tangential drag per area.");
}

void visit(Archive& a, MagicParams& p) {
    a.optional("handle_stiffness", p.handle_stiffness, "N/m", positive, "Springs of handles.");
    a.optional("preserve_creases", p.preserve_creases, "Take the folds of the mesh as its rest shape.");
    for (const char* key : {"collision_stiffness", "repulsion_thickness", "projection_thickness"})
        a.ignored(key, contact_only);
    for (const char* key : {"fixed_high_res_mesh", "edge_flip_threshold", "rib_stiffening", "combine_tensors"})
        a.ignored(key, remeshing_only);
}

void visit(Archive& a, SceneParams& p) {
    a.optional("frame_time", p.frame_time, "s", positive, "Time between saved frames.");
    a.optional("frame_steps", p.frame_steps, "", at_least(1), "Steps per frame.");
    a.optional("timestep", p.timestep, "s", positive, "Old style, when frame_time is absent: the step.");
    a.optional("save_frames", p.save_frames, "", at_least(1), "Old style: steps per frame.");
    a.optional("end_time", p.end_time, "s", any_number, "When the run ends.");
    a.optional("end_frame", p.end_frame, "", any_number, "The last frame.");
    if (p.frame_time && a.kind("duration") != JsonKind::absent)
        a.ignored("duration", "ArcSim reads it only without frame_time. Use end_time.");
    else
        a.optional("duration", p.duration, "s", any_number, "Old style: when the run ends.");
    a.list("cloths", p.cloths, "The cloths.");
    a.raw("motions", p.motions, "Motions of handles: arrays of keyframes, or a .mot file.");
    a.list("handles", p.handles, "What holds the cloths.");
    a.raw("obstacles", p.obstacles, "Not modelled: must be empty, or contact disabled.");
    a.raw("morphs", p.morphs, "Springs from every node to target shapes that change in time.");
    a.optional("gravity", p.gravity, "m/s²", any_number, "Acceleration.");
    a.nested("wind", p.wind, "The air; without this key it is at rest and has density 1.");
    a.ignored("friction", contact_only);
    a.ignored("obs_friction", contact_only);
    a.optional("disable", p.disable, "Modules to switch off.");
    a.nested("magic", p.magic, "ArcSim's constants.");
    a.nested("solver", p.solver, "How time steps are solved. Not known to ArcSim.");
}

bool SceneParams::disables(std::string_view module) const {
    return std::find(disable.begin(), disable.end(), module) != disable.end();
}

double SceneParams::step() const {
    if (frame_time) return *frame_time / frame_steps;
    return timestep.value_or(0);
}
int SceneParams::steps_per_frame() const { return frame_time ? frame_steps : save_frames; }
double SceneParams::last_time() const { return frame_time ? end_time : std::min(end_time, duration); }

}  // namespace arcsim
