#include "app/io/character/stick_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using glm::dquat;
using glm::dvec3;
using humanoid::Node;
using humanoid::Skeleton;

constexpr double pi = 3.14159265358979323846;
constexpr double frame_rate = 60.0;

struct FigureJoint {
    const char* name;
    const char* parent;
    dvec3 at;
};
constexpr FigureJoint middle[]{{"Hips", "", {0, 1.0, 0}},           {"Spine", "Hips", {0, 1.1, 0}},
                               {"Chest", "Spine", {0, 1.2, 0}},     {"UpperChest", "Chest", {0, 1.33, 0}},
                               {"Neck", "UpperChest", {0, 1.5, 0}}, {"Head", "Neck", {0, 1.6, 0}},
                               {"HeadTop_End", "Head", {0, 1.8, 0}}};
/// The left side, at +X.
constexpr FigureJoint side[]{
    {"Shoulder", "UpperChest", {0.04, 1.45, 0}},  {"UpperArm", "Shoulder", {0.18, 1.45, 0}},
    {"LowerArm", "UpperArm", {0.46, 1.45, 0}},    {"Hand", "LowerArm", {0.72, 1.45, 0}},
    {"Hand_End", "Hand", {0.9, 1.45, 0}},         {"UpperLeg", "Hips", {0.1, 0.94, 0}},
    {"LowerLeg", "UpperLeg", {0.1, 0.52, 0.005}}, {"Foot", "LowerLeg", {0.1, 0.09, 0}},
    {"Toes", "Foot", {0.1, 0.02, 0.15}},          {"Toes_End", "Toes", {0.1, 0.02, 0.22}}};

Skeleton make_skeleton() {
    std::vector<Node> nodes;
    std::map<std::string, std::pair<std::int32_t, dvec3>> placed{{"", {-1, dvec3(0.0)}}};
    const auto add = [&](const std::string& name, const std::string& parent, const dvec3& at) {
        const auto [above, from] = placed.at(parent);
        placed[name] = {static_cast<std::int32_t>(nodes.size()), at};
        nodes.push_back({name, above, {.translation = at - from}});
    };
    for (const FigureJoint& joint : middle) add(joint.name, joint.parent, joint.at);
    for (const auto& [prefix, sign] : {std::pair("Left", 1.0), std::pair("Right", -1.0)}) {
        for (const FigureJoint& joint : side) {
            const std::string parent = joint.parent;
            const bool on_middle = parent == "UpperChest" || parent == "Hips";
            add(std::string(prefix) + joint.name, on_middle ? parent : prefix + parent,
                {sign * joint.at.x, joint.at.y, joint.at.z});
        }
    }
    return *Skeleton::make(std::move(nodes));
}

double smooth(double from, double to, double x) {
    const double u = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}
dquat about_x(double degrees) {
    return math::rotation_about(dvec3(1, 0, 0), degrees * pi / 180.0);
}
dquat about_y(double degrees) {
    return math::rotation_about(dvec3(0, 1, 0), degrees * pi / 180.0);
}
dquat about_z(double degrees) {
    return math::rotation_about(dvec3(0, 0, 1), degrees * pi / 180.0);
}
/// The minimal rotation between two directions.
dquat from_to(const dvec3& from, const dvec3& to) {
    return glm::normalize(dquat(1.0 + glm::dot(glm::normalize(from), glm::normalize(to)),
                                glm::cross(glm::normalize(from), glm::normalize(to))));
}

/// Builds a pose by setting global rotations, from the root outwards.
class Pose {
  public:
    explicit Pose(const Skeleton& skeleton)
        : skeleton_(skeleton), local_(rest_pose(skeleton)), placed_(skeleton.size()) {}

    std::size_t at(const std::string& name) const { return *skeleton_.find(name); }
    rig::Transform& local(const std::string& name) { return local_[at(name)]; }
    const humanoid::Placement& placed(const std::string& name) {
        humanoid::place(skeleton_, local_, placed_);
        return placed_[at(name)];
    }
    void turn(const std::string& name, const dquat& global) {
        const std::int32_t parent = skeleton_[at(name)].parent;
        humanoid::place(skeleton_, local_, placed_);
        local(name).rotation = glm::inverse(placed_[static_cast<std::size_t>(parent)].rotation()) * global;
    }
    /// Two-bone IK to a target, with the middle joint in direction `pole`. The end rotates with the lower
    /// bone.
    void reach(const std::string& upper, const std::string& lower, const std::string& end,
               const dvec3& target, const dvec3& pole) {
        const dvec3 root = placed(upper).position;
        const dvec3 upper_bone = skeleton_[at(lower)].rest.translation,
                    lower_bone = skeleton_[at(end)].rest.translation;
        const double a = glm::length(upper_bone), b = glm::length(lower_bone);
        const dvec3 way = target - root;
        const double far = std::min(glm::length(way), 0.9999 * (a + b));
        const dvec3 along = glm::normalize(way);
        const dvec3 across = glm::normalize(pole - along * glm::dot(pole, along));
        const double x = (far * far + a * a - b * b) / (2.0 * far),
                     y = std::sqrt(std::max(a * a - x * x, 0.0));
        const dvec3 knee = root + along * x + across * y;
        turn(upper, from_to(upper_bone, knee - root));
        turn(lower, from_to(lower_bone, root + along * far - knee));
    }
    const std::vector<rig::Transform>& locals() const { return local_; }

  private:
    const Skeleton& skeleton_;
    std::vector<rig::Transform> local_;
    std::vector<humanoid::Placement> placed_;
};

/// Records frames of all nodes' rotations and of the hips' translation as a clip.
class Recorder {
  public:
    Recorder(const Skeleton& skeleton, std::string name, double duration) {
        clip_.name = std::move(name);
        clip_.duration = duration;
        clip_.channels.resize(skeleton.size());
        for (std::size_t i = 0; i < skeleton.size(); ++i) clip_.channels[i].node = i;
    }
    void add(double time, const std::vector<rig::Transform>& pose) {
        time = std::min(time, clip_.duration);
        for (std::size_t i = 0; i < pose.size(); ++i) {
            humanoid::Channel& channel = clip_.channels[i];
            dquat rotation = pose[i].rotation;
            if (!channel.rotation.values.empty() && glm::dot(channel.rotation.values.back(), rotation) < 0.0)
                rotation = -rotation;
            channel.rotation.times.push_back(time);
            channel.rotation.values.push_back(rotation);
            if (i > 0) continue;
            channel.translation.times.push_back(time);
            channel.translation.values.push_back(pose[i].translation);
        }
    }
    humanoid::Clip clip() { return std::move(clip_); }

  private:
    humanoid::Clip clip_;
};

constexpr double walk_period = 1.1, walk_speed = 1.0;  // s, m/s

/// A foot's pose at `phase`, the fraction of the walk's period since its heel strike, when the hips were at z
/// = 0 and the ankle `ahead` of them.
struct FootPose {
    dvec3 ankle;
    double pitch;  // degrees, toes up
    double bend;   // the toes' bend against the foot, degrees
};
FootPose foot_at(double phase) {
    constexpr double flat = 0.10, heel_off = 0.36, toe_off = 0.62, ahead = 0.26;
    constexpr double strike_pitch = 16.0, off_pitch = -48.0;
    const dvec3 ankle(0.0, 0.09, 0.0);
    const auto turned = [&](const dvec3& about, double pitch) {
        return about + about_x(-pitch) * (ankle - about);
    };
    const dvec3 heel = ankle + stick_heel, ball(0.0, 0.02, 0.15);
    const auto standing = [&](double at) -> FootPose {
        if (at < flat) {
            const double pitch = strike_pitch * (1.0 - smooth(0.0, flat, at));
            return {turned(heel, pitch), pitch, 0.0};
        }
        const double lifted = std::max(at - heel_off, 0.0) / (toe_off - heel_off),
                     pitch = off_pitch * lifted * lifted;
        return {turned(ball, pitch), pitch, -pitch};
    };
    FootPose pose;
    if (phase <= toe_off) {
        pose = standing(phase);
        pose.ankle.z += ahead;
        return pose;
    }
    // In the air: a cubic that matches the velocities at lift-off and landing.
    const FootPose left = standing(toe_off), before = standing(toe_off - 1e-4), next = standing(0.0);
    const double u = (phase - toe_off) / (1.0 - toe_off), span = 1.0 - toe_off;
    const dvec3 leaving = (left.ankle - before.ankle) / 1e-4 * span;
    const dvec3 landing = (standing(1e-4).ankle - next.ankle) / 1e-4 * span;
    const dvec3 end = next.ankle + dvec3(0, 0, walk_period * walk_speed);
    const double u2 = u * u, u3 = u2 * u;
    pose.ankle = (2 * u3 - 3 * u2 + 1) * left.ankle + (u3 - 2 * u2 + u) * leaving + (3 * u2 - 2 * u3) * end +
                 (u3 - u2) * landing;
    pose.ankle.z += ahead;
    pose.pitch = left.pitch + (strike_pitch - left.pitch) * smooth(0.0, 1.0, u);
    pose.bend = left.bend * (1.0 - smooth(0.0, 0.35, u));
    return pose;
}

/// `late`: this leg's delay as a fraction of the period.
void pose_leg(Pose& pose, const std::string& prefix, double sign, double phase, double late) {
    const double step = std::floor(phase - late);
    const FootPose foot = foot_at(phase - late - step);
    const dvec3 target = foot.ankle + dvec3(sign * 0.09, 0.0, (step + late) * walk_period * walk_speed);
    pose.reach(prefix + "UpperLeg", prefix + "LowerLeg", prefix + "Foot", target, dvec3(0, 0, 1));
    pose.turn(prefix + "Foot", about_x(-foot.pitch));
    pose.local(prefix + "Toes").rotation = about_x(-foot.bend);
}

void pose_walking_arm(Pose& pose, const std::string& prefix, double sign, double swing) {
    pose.turn(prefix + "Shoulder", dquat(1, 0, 0, 0));
    const dquat down = about_x(-22.0 * swing) * about_z(-sign * 78.0);
    pose.turn(prefix + "UpperArm", down);
    pose.turn(prefix + "LowerArm", about_x(-22.0 * swing - 22.0 - 12.0 * swing) * about_z(-sign * 82.0));
    pose.local(prefix + "Hand").rotation = dquat(1, 0, 0, 0);
}

humanoid::Clip make_walk(const Skeleton& skeleton) {
    Recorder recorder(skeleton, "walk", walk_period);
    const int frames = static_cast<int>(std::lround(walk_period * frame_rate));
    for (int frame = 0; frame <= frames; ++frame) {
        const double phase = static_cast<double>(frame) / frames, turn = 2.0 * pi * phase;
        Pose pose(skeleton);
        rig::Transform& hips = pose.local("Hips");
        hips.translation = {0.018 * math::sine(turn), 0.938 - 0.012 * math::cosine(2.0 * turn),
                            walk_speed * walk_period * phase};
        const double yaw = 6.0 * math::cosine(turn);
        hips.rotation = about_y(-yaw) * about_z(2.0 * math::sine(turn));
        pose.turn("Spine", about_y(-0.3 * yaw) * about_x(3.0));
        pose.turn("Chest", about_y(0.4 * yaw) * about_x(3.0));
        pose.turn("UpperChest", about_y(yaw) * about_x(3.0));
        pose.turn("Neck", about_x(4.0));
        pose.turn("Head", dquat(1, 0, 0, 0));
        pose_leg(pose, "Left", 1.0, phase, 0.0);
        pose_leg(pose, "Right", -1.0, phase, 0.5);
        pose_walking_arm(pose, "Left", 1.0, -math::cosine(turn));
        pose_walking_arm(pose, "Right", -1.0, math::cosine(turn));
        recorder.add(frame / frame_rate, pose.locals());
    }
    return recorder.clip();
}

/// The hand's path in the punch: guard, drawn back, the hook's peak in front of the face, back to guard.
dvec3 fist_at(double t) {
    struct Key {
        double time;
        dvec3 at;
    };
    constexpr std::array<Key, 6> keys{{{0.0, {-0.14, 1.36, 0.24}},
                                       {0.25, {-0.36, 1.30, 0.06}},
                                       {0.45, {-0.32, 1.42, 0.40}},
                                       {0.58, {-0.02, 1.46, 0.52}},
                                       {0.75, {0.06, 1.42, 0.36}},
                                       {1.2, {-0.14, 1.36, 0.24}}}};
    std::size_t i = 0;
    while (i + 2 < keys.size() && t > keys[i + 1].time) ++i;
    const auto slope = [&](std::size_t k) -> dvec3 {
        if (k == 0 || k + 1 == keys.size()) return dvec3(0.0);
        return (keys[k + 1].at - keys[k - 1].at) / (keys[k + 1].time - keys[k - 1].time);
    };
    const double span = keys[i + 1].time - keys[i].time, u = std::clamp((t - keys[i].time) / span, 0.0, 1.0);
    const double u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * keys[i].at + (u3 - 2 * u2 + u) * span * slope(i) +
           (3 * u2 - 2 * u3) * keys[i + 1].at + (u3 - u2) * span * slope(i + 1);
}

humanoid::Clip make_punch(const Skeleton& skeleton) {
    constexpr double duration = 1.2;
    Recorder recorder(skeleton, "punch", duration);
    for (int frame = 0; frame <= static_cast<int>(std::lround(duration * frame_rate)); ++frame) {
        const double t = frame / frame_rate;
        const double twist =
            -14.0 * smooth(0.0, 0.25, t) + 44.0 * smooth(0.3, 0.58, t) - 30.0 * smooth(0.65, 1.15, t);
        Pose pose(skeleton);
        pose.local("Hips").translation = {0.0, 0.93, 0.0};
        pose.local("Hips").rotation = about_y(0.35 * twist);
        pose.turn("Spine", about_y(0.55 * twist) * about_x(4.0));
        pose.turn("Chest", about_y(0.8 * twist) * about_x(5.0));
        pose.turn("UpperChest", about_y(twist) * about_x(5.0));
        pose.turn("Neck", about_y(0.4 * twist));
        pose.turn("Head", about_y(0.1 * twist));
        for (const auto& [prefix, sign] : {std::pair<std::string, double>("Left", 1.0), {"Right", -1.0}}) {
            const dvec3 ankle(sign * 0.16, 0.09, sign * 0.12);
            pose.reach(prefix + "UpperLeg", prefix + "LowerLeg", prefix + "Foot", ankle,
                       dvec3(sign * 0.3, 0, 1));
            pose.turn(prefix + "Foot", about_y(sign * 12.0));
            pose.turn(prefix + "Shoulder", about_y(twist));
        }
        pose.reach("RightUpperArm", "RightLowerArm", "RightHand", fist_at(t), dvec3(-1.0, -0.5, -0.3));
        pose.reach("LeftUpperArm", "LeftLowerArm", "LeftHand", about_y(0.3 * twist) * dvec3(0.14, 1.38, 0.26),
                   dvec3(0.7, -1.0, -0.2));
        recorder.add(t, pose.locals());
    }
    return recorder.clip();
}

}  // namespace

const Character& stick_figure() {
    static const Character figure = [] {
        Character character;
        character.skeleton = make_skeleton();
        character.clips = {make_walk(character.skeleton), make_punch(character.skeleton)};
        character.skin = figure_body(character.skeleton, bone_map(character));
        return character;
    }();
    return figure;
}

}  // namespace tendril::app
