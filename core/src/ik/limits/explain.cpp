// Which joint limit stops the tip. From the best pose within all limits the few joints whose limits stop
// most of the descent towards the target are freed in turn. For the one that helps most, the range that it
// needs is then found by halving.
#include <algorithm>
#include <array>
#include <cmath>

#include "ik/limits/loop.hpp"
#include "ik/limits/pose.hpp"
#include "ik/solve/parts.hpp"
#include "ik/solve/validate.hpp"
#include "ik/tunables.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik {

using namespace detail;
using namespace detail::tune::explain;

namespace {

/// How a joint stands after the solve with some limits, and how far the tip is then.
struct Outcome {
    float error = 0.0f;
    JointAngles angles;
};

/// All the freedom that a joint can have on the side on which it stands at its limit. Both sides at once
/// would let it turn the other way round to the same place.
Limit opened(Limit limit, const JointAngles& angles) noexcept {
    const bool hinge = limit.kind == JointKind::Hinge;
    float& maximum = hinge ? limit.max : limit.twist_max;
    float& minimum = hinge ? limit.min : limit.twist_min;
    const float angle = hinge ? angles.up : angles.twist;
    const bool upper = angle >= maximum - 2.0f * at_bound, lower = angle <= minimum + 2.0f * at_bound;
    if (upper) maximum = pi;
    if (lower && !upper) minimum = -pi;
    limit.up = limit.down = limit.left = limit.right = pi;
    return limit;
}

/// For a joint without any freedom, the other side.
Limit mirrored(Limit limit) noexcept {
    const bool hinge = limit.kind == JointKind::Hinge;
    (hinge ? limit.max : limit.twist_max) = hinge ? limit.min : limit.twist_min;
    (hinge ? limit.min : limit.twist_min) = -pi;
    limit.up = limit.down = limit.left = limit.right = pi;
    return limit;
}

/// Range for these angles: all of it for `part` = 1, none beyond the limit's own for 0.
Limit widened(Limit limit, const JointAngles& angles, float part) noexcept {
    const auto up_to = [part](float& bound, float angle) {
        bound += part * std::max(std::min(angle, pi) - bound, 0.0f);
    };
    const auto down_to = [part](float& bound, float angle) {
        bound += part * std::min(std::max(angle, -pi) - bound, 0.0f);
    };
    if (limit.kind == JointKind::Hinge) {
        up_to(limit.max, angles.up);
        down_to(limit.min, angles.up);
        return limit;
    }
    constexpr float diagonal = 1.42f;  // an ellipse with these half-axes has the angles inside
    up_to(limit.up, diagonal * angles.up);
    up_to(limit.down, -diagonal * angles.up);
    up_to(limit.left, diagonal * angles.left);
    up_to(limit.right, -diagonal * angles.left);
    up_to(limit.twist_max, angles.twist);
    down_to(limit.twist_min, angles.twist);
    return limit;
}

/// Solves on from the pose that is to be explained, with one limit replaced.
Outcome outcome(Workspace& scratch, std::span<glm::vec3> joints, glm::vec3 target, const Options& options,
                std::size_t joint, const Limit& limit) noexcept {
    LimitedScratch& limited = scratch.limited;
    std::copy(limited.saved.joints.begin(), limited.saved.joints.end(), joints.begin());
    std::copy(limited.saved.rotations.begin(), limited.saved.rotations.end(),
              scratch.saved.rotations.begin());
    std::copy(options.limits.begin(), options.limits.end(), limited.freed.begin());
    limited.freed[joint] = limit;
    load_limits(scratch, limited.freed);
    Options freed;
    freed.max_iterations = iterations;
    freed.limits = limited.freed;
    freed.tip_orientation = options.tip_orientation;
    scratch.saved.limits = {};
    Problem problem{joints, target, fine * scratch.reach, freed, scratch, scratch.saved};
    run_limited(Method::Fabrik, problem, Unwatched());
    const glm::quat rotation = limited.pose.local[joint];
    return {error_of(problem, limited.pose), angles_of(limited.limits[joint], rotation)};
}

ActiveLimit active_hinge(const Limit& limit, float angle) noexcept {
    ActiveLimit hold;
    hold.bound = angle > limit.max ? Bound::Max : Bound::Min;
    hold.limit = angle > limit.max ? limit.max : limit.min;
    hold.needed = angle;
    return hold;
}

/// The one of a cone's numbers that these angles exceed most.
ActiveLimit active_cone(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    const JointAngles inside = within(joint, angles);
    const float up = std::abs(angles.up - inside.up), left = std::abs(angles.left - inside.left);
    const float twist = std::abs(angles.twist - inside.twist);
    ActiveLimit hold;
    if (twist >= up && twist >= left) {
        hold.bound = angles.twist > inside.twist ? Bound::TwistMax : Bound::TwistMin;
        hold.limit = inside.twist, hold.needed = angles.twist;
    } else if (up >= left) {
        hold.bound = angles.up > inside.up ? Bound::Up : Bound::Down;
        hold.limit = std::abs(inside.up), hold.needed = std::abs(angles.up);
    } else {
        hold.bound = angles.left > inside.left ? Bound::Left : Bound::Right;
        hold.limit = std::abs(inside.left), hold.needed = std::abs(angles.left);
    }
    return hold;
}

/// The smallest range with which the tip still comes as near as with all of it: halving.
Outcome minimum(Workspace& scratch, std::span<glm::vec3> joints, glm::vec3 target, const Options& options,
                std::size_t joint, Outcome maximum) noexcept {
    float low = 0.0f, high = 1.0f;
    const JointAngles all = maximum.angles;
    const LimitedJoint own = limited_joint(options.limits[joint], scratch.rest_directions[joint]);
    for (int i = 0; i < halvings; ++i) {
        const float part = 0.5f * (low + high);
        const Outcome some =
            outcome(scratch, joints, target, options, joint, widened(options.limits[joint], all, part));
        // Another start may arrive within the joint's own limit: that says nothing of the range it needs.
        const bool over = excess_of(own, some.angles) > 2.0f * at_bound;
        if (over && some.error <= std::max(maximum.error, 2.0f * fine * scratch.reach)) {
            high = part;
            maximum.angles = some.angles;
        } else {
            low = part;
        }
    }
    return maximum;
}

struct Candidate {
    std::size_t joint = no_joint;
    Outcome outcome;
    float over = 0.0f;  ///< by how much it leaves its limit
};

/// The outcome of freeing a joint; of its two sides, where it stands at both.
Outcome freed(Workspace& scratch, std::span<glm::vec3> joints, glm::vec3 target, const Options& options,
              std::size_t i, const JointAngles& angles) noexcept {
    const Limit& limit = options.limits[i];
    const Outcome one = outcome(scratch, joints, target, options, i, opened(limit, angles));
    const bool hinge = limit.kind == JointKind::Hinge;
    const float width = hinge ? limit.max - limit.min : limit.twist_max - limit.twist_min;
    if (width > 4.0f * at_bound) return one;
    const Outcome other = outcome(scratch, joints, target, options, i, mirrored(limit));
    return other.error < one.error ? other : one;
}

/// How much of a joint's part in the descent its limit stops: the fall of half the error's square for a turn
/// of this joint alone, as far as that turn leaves the limit. 0 within the limit.
float stopped(const Workspace& scratch, const glm::vec3& target, const Options& options,
              std::size_t i) noexcept {
    constexpr float small_turn = 1e-2f;  // radians: well over what counts as at the limit
    const LimitedJoint joint = limited_joint(options.limits[i], scratch.rest_directions[i]);
    const LimitedPose& pose = scratch.limited.saved;
    const glm::quat rotation = pose.local[i];
    if (!is_at_limit(joint, angles_of(joint, rotation))) return 0.0f;
    const glm::vec3 tip = pose.joints.back();
    glm::vec3 torque = cross(minus(tip, pose.joints[i]), minus(target, tip));
    if (options.tip_orientation) {  // as error_of has it
        const float arm = tune::limits::orientation_arm * scratch.reach;
        const glm::quat missing = compose(unit(*options.tip_orientation), conjugate(pose.rotations.back()));
        torque = plus(torque, times(rotation_vector(missing), arm * arm));
    }
    const float size = length(torque);
    if (!(size > 0.0f)) return 0.0f;
    const glm::vec3 axis = rotated(conjugate(parent_of(pose.rotations, i)), times(torque, 1.0f / size));
    const glm::quat turned = compose(rotation_about(axis, small_turn), rotation);
    return size * excess_of(joint, angles_of(joint, turned)) / small_turn;
}

/// The joint whose freeing brings the tip nearest; where several bring it there, the one that needs least.
class Candidates {
  public:
    Candidates(Workspace& scratch, std::span<glm::vec3> joints, glm::vec3 target, const Options& options,
               float start) noexcept
        : scratch_(scratch), joints_(joints), target_(target), options_(options), start_(start) {}

    Candidate best() noexcept {
        for (std::size_t i = 0; i < options_.limits.size(); ++i) enter(i);
        Candidate best;
        for (std::size_t k = 0; k < count_; ++k) consider(best, list_[k].joint);
        return best;
    }

  private:
    struct Entry {
        std::size_t joint = 0;
        float stopped = 0.0f;
    };

    /// Keeps the ones that stop most, the most first; of equals the one nearer to the root.
    void enter(std::size_t i) noexcept {
        const Entry entry{i, stopped(scratch_, target_, options_, i)};
        if (!(entry.stopped > 0.0f)) return;
        std::size_t k = count_ < max_candidates ? count_++ : max_candidates;
        for (; k > 0 && list_[k - 1].stopped < entry.stopped; --k) {
            if (k < max_candidates) list_[k] = list_[k - 1];
        }
        if (k < max_candidates) list_[k] = entry;
    }

    void consider(Candidate& best, std::size_t i) noexcept {
        const float there = fine * scratch_.reach;
        const LimitedJoint joint = limited_joint(options_.limits[i], scratch_.rest_directions[i]);
        const JointAngles angles = angles_of(joint, scratch_.limited.saved.local[i]);
        const Outcome result = freed(scratch_, joints_, target_, options_, i, angles);
        const float over = excess_of(joint, result.angles);
        if (over <= 2.0f * at_bound || result.error >= start_ * (1.0f - noticeable)) return;
        const bool nearer = std::max(result.error, there) < std::max(best.outcome.error, there);
        const bool as_near = result.error <= there && best.outcome.error <= there && over < best.over;
        if (best.joint == no_joint || nearer || as_near) best = {i, result, over};
    }

    Workspace& scratch_;
    std::span<glm::vec3> joints_;
    glm::vec3 target_;
    const Options& options_;
    float start_;
    std::size_t count_ = 0;
    std::array<Entry, max_candidates> list_{};
};

/// A method that gave up early may stand at limits that stop nothing. So the default one goes on first, as
/// far as the limits let it; from there on they are freed. The error that is left.
float best_within_limits(Workspace& scratch, std::span<glm::vec3> joints, glm::vec3 target,
                         const Options& options) noexcept {
    Options all;
    all.max_iterations = iterations;
    all.limits = options.limits;
    all.tip_orientation = options.tip_orientation;
    scratch.saved.limits = {};
    Problem problem{joints, target, fine * scratch.reach, all, scratch, scratch.saved};
    run_limited(Method::Fabrik, problem, Unwatched());
    scratch.limited.saved = scratch.limited.pose;
    return error_of(problem, scratch.limited.pose);
}

}  // namespace

std::optional<ActiveLimit> Solver::explain(std::span<const glm::vec3> joints, const State& state,
                                           glm::vec3 target, const Options& options) noexcept {
    Workspace& scratch = parts_->scratch;
    if (options.limits.empty() || bones() == 0 || joints.size() != bones() + 1) return std::nullopt;
    if (!are_points(joints) || !are_points({&target, 1}) || !is_valid(state, bones())) return std::nullopt;
    if (!are_valid(options, bones()) || !load_limits(scratch, options.limits)) return std::nullopt;

    scratch.saved = state;
    const std::span<glm::vec3> work = scratch.joints;
    std::copy(joints.begin(), joints.end(), work.begin());
    const float start = best_within_limits(scratch, work, target, options);
    const Candidate found = Candidates(scratch, work, target, options, start).best();
    std::optional<ActiveLimit> hold;
    if (found.joint != no_joint) {
        const std::size_t i = found.joint;
        const LimitedJoint joint = limited_joint(options.limits[i], scratch.rest_directions[i]);
        const JointAngles angles = minimum(scratch, work, target, options, i, found.outcome).angles;
        hold = joint.hinge() ? active_hinge(options.limits[i], angles.up) : active_cone(joint, angles);
        hold->joint = i;
        hold->kind = joint.kind;
        hold->enough = found.outcome.error <=
                       std::max(options.tolerance.value_or(1e-3f * reach()), 2.0f * fine * reach());
    }
    return hold;
}

}  // namespace tendril::ik
