#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "arcsim/base/json_reader.hpp"
#include "arcsim/base/types.hpp"

namespace arcsim {

struct TransformParams;
struct VelocityParams;

/// x -> translation + scale * R x, R from the normalised quaternion (w, x, y, z).
struct Pose {
    Vector3d translation = Vector3d::Zero();
    double scale = 1;
    Eigen::Vector4d quaternion{1, 0, 0, 0};

    Matrix3d rotation() const;
    Vector3d apply(const Vector3d& x) const { return translation + scale * (rotation() * x); }
    Vector3d apply_inverse(const Vector3d& x) const { return rotation().transpose() * (x - translation) / scale; }
};
Pose pose_of(const TransformParams& p);

/// A pose and its rate of change, component by component.
struct Keyframe {
    double time = 0;         // s
    Pose pose;
    Pose rate;               // 1/s; filled in by finish_motion where the file gives none
    bool has_rate = false;
};

/// Weights of a cubic Hermite: of the values and the rates of change at both ends of a span.
struct Hermite {
    double value0, value1, rate0, rate1;
};
/// At s from 0 to 1 of a span of that length.
Hermite hermite(double s, double span);

/// Poses in time: cubic Hermite between keyframes, component by component, held outside.
struct Motion {
    std::vector<Keyframe> keys;   // ascending times

    Pose pose(double time) const;
};

/// Fills in the rates that the file left out: (X_{i+1} - X_{i-1}) / (t_{i+1} - t_{i-1}) inside, zero at the
/// first and the last key.
void finish_motion(Motion& motion);

/// `motions` of a scene: an array of arrays of {time, transform, velocity}, or {motfile, fps, transform}.
/// @throws InputError: wrong types, times that do not increase, an unreadable .mot file
std::vector<Motion> read_motions(const JsonNode& node, Warnings& warnings);

/// A .mot file: one motion per body. Text of blank-separated numbers: the count of bodies, then for every
/// body the count of frames and for every frame a translation (3) and a quaternion w, x, y, z (4).
/// Successive quaternions are brought to the same half of the sphere.
std::vector<Motion> read_mot_file(const std::filesystem::path& file, double fps, const Pose& transform);

}  // namespace arcsim
