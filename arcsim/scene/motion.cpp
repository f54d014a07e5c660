#include "arcsim/scene/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "arcsim/base/error.hpp"
#include "arcsim/base/files.hpp"
#include "arcsim/base/text.hpp"
#include "arcsim/scene/scene_params.hpp"

namespace arcsim {
namespace {

struct KeyframeParams {
    double time = 0;
    TransformParams transform;
    std::optional<TransformParams> velocity;
};
void visit(Archive& a, KeyframeParams& p) {
    a.required("time", p.time, "s", any_number, "When the pose is reached.");
    a.nested("transform", p.transform, "The pose.");
    a.nested("velocity", p.velocity, "Its rate of change; without it, from the neighbouring keyframes.");
}

struct MotFileParams {
    InputFile motfile;
    double fps = 0;
    TransformParams transform;
};
void visit(Archive& a, MotFileParams& p) {
    a.required("motfile", p.motfile, "File of recorded motions.");
    a.required("fps", p.fps, "1/s", positive, "Frames per second of the file.");
    a.nested("transform", p.transform, "Applied to all of its poses.");
}

/// factor_a * a + factor_b * b + ..., component by component.
void add(Pose& to, const Pose& pose, double factor) {
    to.translation += factor * pose.translation;
    to.scale += factor * pose.scale;
    to.quaternion += factor * pose.quaternion;
}

Pose zero_pose() {
    Pose p;
    p.scale = 0;
    p.quaternion.setZero();
    return p;
}

/// A rate is written like a transform, whose defaults stand for "no change".
Pose rate_of(const TransformParams& p) {
    Pose rate = pose_of(p);
    if (p.scale == 1) rate.scale = 0;
    if (p.rotate == std::array<double, 4>{0, 0, 0, 0}) rate.quaternion.setZero();
    return rate;
}

Pose combine(const Pose& outer, const Pose& inner) {
    Pose r;
    r.translation = outer.apply(inner.translation);
    r.scale = outer.scale * inner.scale;
    const Eigen::Vector4d a = outer.quaternion.normalized(), b = inner.quaternion;
    const Eigen::Quaterniond q = Eigen::Quaterniond(a[0], a[1], a[2], a[3]) * Eigen::Quaterniond(b[0], b[1], b[2], b[3]);
    r.quaternion = {q.w(), q.x(), q.y(), q.z()};
    return r;
}

Motion read_keyframes(const JsonNode& node, Warnings& warnings) {
    Motion motion;
    for (int i = 0; i < node.size(); ++i) {
        KeyframeParams p;
        read_params(node[i], p, warnings);
        if (i > 0 && p.time <= motion.keys.back().time)
            node[i].at("time").fail("expected a time after the keyframe before it (" +
                                    format_number(motion.keys.back().time) + " s), got " + format_number(p.time) + ".");
        motion.keys.push_back({p.time, pose_of(p.transform), p.velocity ? rate_of(*p.velocity) : zero_pose(),
                               p.velocity.has_value()});
    }
    if (motion.keys.empty()) node.fail("a motion needs at least one keyframe {\"time\": t, \"transform\": {...}}.");
    finish_motion(motion);
    return motion;
}

}  // namespace

Matrix3d Pose::rotation() const {
    const Eigen::Vector4d q = quaternion.normalized();
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

Pose pose_of(const TransformParams& p) {
    Pose pose;
    pose.translation = p.translate;
    pose.scale = p.scale;
    const Vector3d axis(p.rotate[1], p.rotate[2], p.rotate[3]);
    if (axis.norm() > 0) {
        const double half = p.rotate[0] * std::numbers::pi / 360;
        pose.quaternion << std::cos(half), std::sin(half) * axis.normalized();
    }
    return pose;
}

Hermite hermite(double s, double span) {
    const double s2 = s * s, s3 = s2 * s;
    return {2 * s3 - 3 * s2 + 1, -2 * s3 + 3 * s2, span * (s3 - 2 * s2 + s), span * (s3 - s2)};
}

Pose Motion::pose(double time) const {
    if (time <= keys.front().time) return keys.front().pose;
    if (time >= keys.back().time) return keys.back().pose;
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double t, const Keyframe& k) { return t < k.time; });
    const Keyframe &a = *(after - 1), &b = *after;
    const double span = b.time - a.time;
    const Hermite w = hermite((time - a.time) / span, span);
    Pose r = zero_pose();
    add(r, a.pose, w.value0);
    add(r, b.pose, w.value1);
    add(r, a.rate, w.rate0);
    add(r, b.rate, w.rate1);
    return r;
}

void finish_motion(Motion& motion) {
    auto& keys = motion.keys;
    for (size_t i = 0; i < keys.size(); ++i) {
        if (keys[i].has_rate) continue;
        keys[i].rate = zero_pose();
        if (i == 0 || i + 1 == keys.size()) continue;
        const double span = keys[i + 1].time - keys[i - 1].time;
        add(keys[i].rate, keys[i + 1].pose, 1 / span);
        add(keys[i].rate, keys[i - 1].pose, -1 / span);
    }
}

std::vector<Motion> read_motions(const JsonNode& node, Warnings& warnings) {
    if (node.kind() == JsonKind::null) return {};
    if (node.kind() == JsonKind::object) {
        MotFileParams p;
        read_params(node, p, warnings);
        return read_mot_file(p.motfile.path, p.fps, pose_of(p.transform));
    }
    std::vector<Motion> motions;
    for (int i = 0; i < node.size(); ++i) motions.push_back(read_keyframes(node[i], warnings));
    return motions;
}

std::vector<Motion> read_mot_file(const std::filesystem::path& file, double fps, const Pose& transform) {
    const std::string text = read_text_file(file);
    std::vector<double> numbers;
    size_t at = 0;
    while ((at = text.find_first_not_of(" \t\r\n", at)) != std::string::npos) {
        const size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
        double value = 0;
        if (!parse_number(std::string_view(text).substr(at, end - at), value) || !std::isfinite(value))
            throw InputError(file.string() + ": expected numbers only, got \"" + text.substr(at, end - at) + "\".");
        numbers.push_back(value);
        at = end;
    }
    size_t next = 0;
    const auto take = [&] {
        if (next >= numbers.size()) throw InputError(file.string() + ": ends too early. Expected the count of bodies, and for each the count of frames and seven numbers a frame.");
        return numbers[next++];
    };
    const auto count = [&](const char* what) {
        const double n = take();
        if (n < 1 || n != std::floor(n) || n > 1e6)
            throw InputError(file.string() + ": the count of " + what + " is " + format_number(n) + ", expected a whole number > 0.");
        return static_cast<int>(n);
    };
    std::vector<Motion> motions(count("bodies"));
    for (Motion& m : motions) {
        const int frames = count("frames");
        for (int i = 0; i < frames; ++i) {
            Pose pose;
            for (double& c : pose.translation) c = take();
            for (int k = 0; k < 4; ++k) pose.quaternion[k] = take();
            if (i > 0 && pose.quaternion.dot(m.keys.back().pose.quaternion) < 0) pose.quaternion = -pose.quaternion;
            m.keys.push_back({i / fps, pose, {}, false});
        }
        for (Keyframe& k : m.keys) k.pose = combine(transform, k.pose);
        finish_motion(m);
    }
    if (next != numbers.size()) throw InputError(file.string() + ": more numbers than its counts of bodies and frames say.");
    return motions;
}

}  // namespace arcsim
