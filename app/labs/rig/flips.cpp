#include "app/labs/rig/flips.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/rig/rig_edit.hpp"

namespace tendril::app {
namespace {

double angle_of(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// A control that is not as it was.
struct Moved {
    rig::ControlKind kind = rig::ControlKind::Transform;
    rig::Transform from{}, to{};  ///< in the scene, before any unit moved it
    double share = 0.0;           ///< of its range, for a number
};

bool has_place(rig::ControlKind kind) {
    return kind == rig::ControlKind::Transform || kind == rig::ControlKind::Position ||
           kind == rig::ControlKind::Vector2d;
}

double share_of_range(const rig::Control& control, double from, double to) {
    const double range = control.minimum && control.maximum ? control.maximum->x - control.minimum->x : 1.0;
    return range > 0.0 ? std::abs(to - from) / range : 1.0;
}

/// Controls that were set, and those that go with one that was.
std::vector<Moved> moved_controls(const rig::Rig& rig, const rig::State& was, const rig::State& is) {
    std::vector<Moved> moved;
    const auto& elements = rig.definition().elements;
    if (was.controls == is.controls) return moved;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (!elements[i].control) continue;
        Moved each{
            .kind = elements[i].control->kind, .from = rig.start_pose(was, i), .to = rig.start_pose(is, i)};
        const bool set = was.controls[i] != is.controls[i];
        if (each.kind == rig::ControlKind::Float && set)
            each.share = share_of_range(*elements[i].control, std::get<double>(was.controls[i]),
                                        std::get<double>(is.controls[i]));
        if (set || each.from != each.to) moved.push_back(each);
    }
    return moved;
}

/// A bone, before and after.
struct Bone {
    std::size_t element = 0;
    rig::Transform from{}, to{};
    double radians = 0.0;
};

/// Whether a control moved so far that it is no wonder that the bone turned.
bool far(const Moved& control, const Bone& bone, double size, const FlipRule& rule) {
    const double enough = static_cast<double>(rule.angle_share) * bone.radians;
    const auto share = static_cast<double>(rule.reach_share);
    if (control.kind == rig::ControlKind::Bool) return true;
    if (control.kind == rig::ControlKind::Float) return control.share >= share;
    if (turn_between(control.from.rotation, control.to.rotation) >= std::max(enough, 1e-9)) return true;
    if (!has_place(control.kind)) return false;
    const double distance = glm::distance(control.from.translation, control.to.translation);
    const double angle = angle_of(control.from.translation - bone.from.translation,
                                  control.to.translation - bone.to.translation);
    return distance > 0.0 && angle >= enough && distance >= share * size;
}

}  // namespace

double skeleton_size(const rig::Rig& rig, rig::State& state) {
    glm::dvec3 low(1e300), high(-1e300);
    for (std::size_t i = 0; i < state.controls.size(); ++i) {
        if (state.elements.kind(rig.id(i)) != rig::ElementKind::Bone) continue;
        const glm::dvec3 at = state.elements.get(rig.id(i), rig::Space::Global).translation;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const double size = low.x <= high.x ? glm::distance(low, high) : 0.0;
    return size > 0.0 ? size : 1.0;
}

std::vector<BoneFlip> bone_flips(const rig::Rig& rig, const rig::State& was, const rig::State& is,
                                 const FlipRule& rule) {
    rig::State before = was, after = is;  // reading works out what is pending
    std::vector<Bone> bones;
    for (const std::size_t i : from_the_roots(rig, before.elements)) {
        const rig::ElementId id = rig.id(i);
        if (before.elements.kind(id) != rig::ElementKind::Bone) continue;
        Bone bone{.element = i,
                  .from = before.elements.get(id, rig::Space::Global),
                  .to = after.elements.get(id, rig::Space::Global)};
        bone.radians = turn_between(bone.from.rotation, bone.to.rotation);
        if (bone.radians > glm::radians(static_cast<double>(rule.degrees))) bones.push_back(bone);
    }
    if (bones.empty()) return {};
    const std::vector<Moved> controls = moved_controls(rig, before, after);
    const double size = skeleton_size(rig, before);
    std::erase_if(bones, [&](const Bone& bone) {
        return std::ranges::any_of(controls, [&](const Moved& each) { return far(each, bone, size, rule); });
    });
    std::ranges::stable_sort(bones, [](const Bone& a, const Bone& b) {
        constexpr double together = 1e-3;  // radians
        return std::round(a.radians / together) > std::round(b.radians / together);
    });
    std::vector<BoneFlip> flips;
    for (const Bone& bone : bones) flips.push_back({bone.element, bone.radians});
    return flips;
}

}  // namespace tendril::app
