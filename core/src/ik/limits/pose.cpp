#include "ik/limits/pose.hpp"

#include "ik/tunables.hpp"
#include "math/checks.hpp"
#include "tendril/elementary.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {

glm::vec3 rotation_vector(const glm::quat& rotation) noexcept {
    const glm::vec3 vector{rotation.x, rotation.y, rotation.z};
    const float sine = length(vector);
    if (sine < 1e-6f) return times(vector, rotation.w < 0.0f ? -2.0f : 2.0f);
    const float angle = rotation.w < 0.0f ? -2.0f * math::arctangent(sine, -rotation.w)
                                          : 2.0f * math::arctangent(sine, rotation.w);
    return times(vector, angle / sine);
}

std::optional<glm::quat> requested_orientation(const Problem& problem) noexcept {
    if (!problem.options.tip_orientation) return std::nullopt;
    return unit(*problem.options.tip_orientation);
}

std::optional<glm::vec3> orientation_error(const Problem& problem, const LimitedPose& pose) noexcept {
    const std::optional<glm::quat> requested = requested_orientation(problem);
    if (!requested) return std::nullopt;
    const glm::quat& last = pose.rotations[problem.bones() - 1];
    const glm::quat left = compose(*requested, conjugate(last));
    return times(rotation_vector(left), tune::limits::orientation_arm * problem.scratch.reach);
}

float error_of(const Problem& problem, const LimitedPose& pose) noexcept {
    const float squared = squared_distance(pose.joints[problem.bones()], problem.target);
    const std::optional<glm::vec3> rotation = orientation_error(problem, pose);
    return std::sqrt(rotation ? squared + dot(*rotation, *rotation) : squared);
}

float furthest_moved(const Problem& problem, const LimitedPose& from, const LimitedPose& to) noexcept {
    float maximum = 0.0f;
    for (std::size_t i = 1; i <= problem.bones(); ++i) {
        maximum = std::max(maximum, squared_distance(from.joints[i], to.joints[i]));
    }
    return std::sqrt(maximum);
}

void forward_kinematics(const Problem& problem, LimitedPose& pose) noexcept {
    pose.joints[0] = problem.root();
    for (std::size_t i = 0; i < problem.bones(); ++i) place_bone(problem, pose, i);
}

/// Only differences in stiffness count: the most mobile joint of a chain has mobility 1.
static void set_mobilities(LimitedScratch& scratch, std::span<const Limit> limits) noexcept {
    float most = 0.0f;
    for (const Limit& limit : limits) most = std::max(most, 1.0f - limit.stiffness);
    for (std::size_t i = 0; i < limits.size(); ++i)
        scratch.limits[i].mobility = (1.0f - limits[i].stiffness) / most;
}

Result load_limits(Workspace& scratch, std::span<const Limit> limits, bool planar) noexcept {
    bool changed = false;
    if (planar != scratch.limited.planar) scratch.limited.made = false;  // made for other rest directions
    scratch.limited.planar = planar;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        if (scratch.limited.made && limits[i] == scratch.limited.source[i]) continue;
        if (const char* const wrong = fault(limits[i], scratch.rest_directions[i]))
            return tendril::detail::refused("solve", {"limits", i}, "a valid limit", wrong);
        scratch.limited.source[i] = limits[i];
        LimitedJoint& joint = scratch.limited.limits[i];
        const bool from_base = planar && joint.from_base;
        joint = solvable_joint(limits[i], scratch.rest_directions[i]);
        joint.from_base = from_base;
        changed = true;
    }
    if (changed) set_mobilities(scratch.limited, limits);
    scratch.limited.made = !limits.empty() || scratch.limited.made;
    return {};
}

template <class Watch>
bool load_pose(Problem& problem, Watch watch) noexcept {
    Workspace& scratch = problem.scratch;
    LimitedPose& pose = scratch.limited.pose;
    scratch.limited.linearized = false;
    pose.joints[0] = problem.root();
    bool same = true;  // no joint clamped so far
    float furthest = 0.0f;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        glm::quat rotation = problem.state.rotations[i];
        glm::vec3 bone = bone_direction(problem, rotation, i);
        if (problem.joints[i + 1] != moved(problem.joints[i], bone, problem.lengths()[i])) {
            const glm::vec3 along = math::direction(problem.joints[i], problem.joints[i + 1], bone);
            // A rotation that agrees to rounding is kept; otherwise each solve would change it a little.
            const float off = squared_distance(bone, along);
            furthest = std::max(furthest, off);
            if (off > 1e-10f) rotation = transported(rotation, bone, along), bone = along;
        }
        const glm::quat parent = parent_of(scratch.limited, pose.rotations, i);
        glm::quat local = compose(conjugate(parent), rotation);
        // The slack exceeds the error of a solve, so that the next one does not begin by moving its result.
        if (clamp(scratch.limited.limits[i], local, 5.0f * at_bound)) {
            rotation = unit(compose(parent, local));
            bone = bone_direction(problem, rotation, i);
            same = false;
        }
        pose.local[i] = local;
        pose.rotations[i] = rotation;
        pose.directions[i] = bone;
        pose.joints[i + 1] = same ? problem.joints[i + 1] : moved(pose.joints[i], bone, problem.lengths()[i]);
        if (pose.joints[i + 1] == problem.joints[i + 1]) continue;
        watch.moved(problem.iteration, Phase::Limit, i + 1, i, problem.joints[i + 1], pose.joints[i + 1]);
    }
    watch.next_step();
    return same && furthest < 1e-4f;
}

void commit(Problem& problem) noexcept {
    const LimitedPose& pose = problem.scratch.limited.pose;
    std::copy_n(pose.joints.begin(), problem.joints.size(), problem.joints.begin());
    std::copy_n(pose.rotations.begin(), problem.bones(), problem.state.rotations.begin());
}

template bool load_pose(Problem&, Unwatched) noexcept;
template bool load_pose(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
