// Tells whether the head sees a target, with easing. Not installed.
#pragma once

#include <algorithm>
#include <vector>

#include "humanoid/direction.hpp"
#include "humanoid/limb.hpp"
#include "tendril/humanoid/soles.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::humanoid::detail {

/// The head and its viewing direction.
struct Head {
    std::vector<std::int32_t> path{};   // from the root down to the head
    glm::dvec3 forward{0.0, 0.0, 1.0};  // in the head's own space

    static Head make(const Skeleton& skeleton, const BoneMap& map, const glm::dvec3& forward) {
        Head head;
        for (std::int32_t node = map[Bone::Head].node; node >= 0;
             node = skeleton[static_cast<std::size_t>(node)].parent)
            head.path.insert(head.path.begin(), node);
        std::vector<Placement> rest(skeleton.size());
        place(skeleton, rest_pose(skeleton), rest);
        head.forward = rig::detail::rotated(
            rig::detail::conjugate(rest[static_cast<std::size_t>(head.path.back())].rotation()), forward);
        return head;
    }
    Placement place_in(const Placement& root, Pose pose) const noexcept {
        Placement at = root;
        for (const std::int32_t node : path) at = at * placement(pose[static_cast<std::size_t>(node)]);
        return at;
    }
    glm::dvec3 gaze(const Placement& at) const noexcept {
        return rig::detail::rotated(at.rotation(), forward);
    }
};

/// A target in view stays in view until it is this far outside, radians, which avoids flicker at the edge.
inline constexpr double view_margin = 0.05;

/// Advances `view` towards 1 if the target is in the cone, otherwise towards 0; at once on the first step.
inline double step_view(bool& in_view, signal::SpringState<double>& view, double angle, double cone,
                        double half_life, double dt) noexcept {
    in_view = angle <= cone + (in_view ? view_margin : 0.0);
    const double goal = in_view ? 1.0 : 0.0;
    if (!view.started) {
        view = {.value = goal, .velocity = 0.0, .previous_target = goal, .started = true};
    } else {
        const double strength = math::ln2 / (math::pi * half_life);
        signal::step({.strength = strength, .critical_damping = 1.0}, view, goal, dt);
        if (std::abs(view.value - goal) < 1e-6) view.value = goal, view.velocity = 0.0;
    }
    return std::clamp(view.value, 0.0, 1.0);
}

}  // namespace tendril::humanoid::detail
