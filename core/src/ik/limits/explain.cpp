// Finds the joint limit that stops the tip. From the best pose within all limits, frees in turn the few
// joints whose limits stop most of the descent towards the target. For the one that helps most, bisects the
// range that it needs.
#include <algorithm>
#include <array>

#include "ik/limits/loop.hpp"
#include "ik/limits/pose.hpp"
#include "ik/limits/range.hpp"
#include "ik/solve/parts.hpp"
#include "ik/solve/plane.hpp"
#include "ik/solve/validate.hpp"
#include "ik/tunables.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik {

using namespace detail;
using namespace detail::tune::explain;

namespace {

/// Result of freeing a joint: the remaining error, the joint's angles, and by how much they exceed its own
/// limit.
struct Outcome {
    std::size_t joint = no_joint;
    float error = 0.0f;
    JointAngles angles;
    float over = 0.0f;
};

class Explanation {
  public:
    /// `joints` are used as scratch; scratch.saved holds the state.
    Explanation(Workspace& scratch, std::span<glm::vec3> joints, const glm::vec3& target,
                const Options& options) noexcept
        : scratch_(scratch), limited_(scratch.limited), joints_(joints), target_(target), options_(options) {}

    std::optional<ActiveLimit> find() noexcept;

  private:
    float solve_on(std::span<const Limit> limits) noexcept;
    float stopped(std::size_t joint) const noexcept;
    void find_candidates() noexcept;
    Outcome with(std::size_t joint, const Limit& limit) noexcept;
    Outcome freed(std::size_t joint) noexcept;
    Outcome best_freed() noexcept;
    JointAngles needed_angles(const Outcome& freed) noexcept;
    LimitedJoint limit_of(std::size_t joint) const noexcept {
        return limited_joint(options_.limits[joint], scratch_.rest_directions[joint]);
    }
    /// Maximum error of a tip that has arrived.
    float tolerance() const noexcept { return fine * scratch_.reach; }

    Workspace& scratch_;
    LimitedScratch& limited_;
    std::span<glm::vec3> joints_;
    glm::vec3 target_;
    const Options& options_;
    float start_ = 0.0f;  ///< the error of the best pose within all limits
    struct Candidate {
        std::size_t joint = no_joint;
        float stopped = 0.0f;
    };
    std::array<Candidate, max_candidates> candidates_{};  ///< sorted by how much they stop, descending
};

/// Solves with the default method and returns the remaining error.
float Explanation::solve_on(std::span<const Limit> limits) noexcept {
    Options options;
    options.max_iterations = iterations;
    options.limits = limits;
    options.plane = options_.plane;
    options.tip_orientation = options_.tip_orientation;
    static_cast<void>(load_limits(scratch_, limits, options_.plane.has_value()));
    scratch_.saved.limits = {};
    Problem problem{joints_, target_, tolerance(), options, scratch_, scratch_.saved};
    run_limited(Method::Fabrik, problem, Unwatched());
    return error_of(problem, limited_.pose);
}

/// Solves from the best pose within all limits, with one limit replaced.
Outcome Explanation::with(std::size_t joint, const Limit& limit) noexcept {
    std::copy(limited_.saved.joints.begin(), limited_.saved.joints.end(), joints_.begin());
    std::copy(limited_.saved.rotations.begin(), limited_.saved.rotations.end(),
              scratch_.saved.rotations.begin());
    std::copy(options_.limits.begin(), options_.limits.end(), limited_.freed.begin());
    limited_.freed[joint] = limit;
    const float error = solve_on(limited_.freed);
    const JointAngles angles = angles_of(limited_.limits[joint], limited_.pose.local[joint]);
    return {joint, error, angles, excess_of(limit_of(joint), angles)};
}

/// The outcome of freeing a joint; the better of its two sides if it is at both bounds.
Outcome Explanation::freed(std::size_t joint) noexcept {
    const Limit& limit = options_.limits[joint];
    const JointAngles angles = angles_of(limit_of(joint), limited_.saved.local[joint]);
    const Outcome one = with(joint, opened(limit, angles));
    if (!has_no_range(limit)) return one;
    const Outcome other = with(joint, mirrored(limit));
    return other.error < one.error ? other : one;
}

/// How much of a joint's descent its limit stops: half the squared error's decrease per turn of this joint
/// alone, times the fraction of that turn that leaves the limit. 0 within the limit.
float Explanation::stopped(std::size_t joint) const noexcept {
    constexpr float small_turn = 1e-2f;  // radians: well over the tolerance for being at the limit
    const LimitedJoint limit = limit_of(joint);
    const LimitedPose& pose = limited_.saved;
    const glm::quat rotation = pose.local[joint];
    if (!is_at_limit(limit, angles_of(limit, rotation))) return 0.0f;
    const glm::vec3 tip = pose.joints.back();
    const std::size_t end = end_of(limited_, joint, options_.limits.size());
    glm::vec3 torque = cross(minus(pose.joints[end], pose.joints[joint]), minus(target_, tip));
    if (options_.tip_orientation && end == options_.limits.size()) {  // as in error_of
        const float arm = tune::limits::orientation_arm * scratch_.reach;
        const glm::quat missing = compose(unit(*options_.tip_orientation), conjugate(pose.rotations.back()));
        torque = plus(torque, times(rotation_vector(missing), arm * arm));
    }
    const float size = length(torque);
    if (!(size > 0.0f)) return 0.0f;
    const glm::vec3 axis =
        rotated(conjugate(parent_of(limited_, pose.rotations, joint)), times(torque, 1.0f / size));
    const glm::quat turned = compose(rotation_about(axis, small_turn), rotation);
    return size * excess_of(limit, angles_of(limit, turned)) / small_turn;
}

/// Lists the joints whose limits stop most; among equals, the one nearer to the root first.
void Explanation::find_candidates() noexcept {
    for (std::size_t joint = 0; joint < options_.limits.size(); ++joint) {
        const Candidate next{joint, stopped(joint)};
        const auto less = [&](const Candidate& each) { return each.stopped < next.stopped; };
        const auto at = std::find_if(candidates_.begin(), candidates_.end(), less);
        if (at == candidates_.end()) continue;
        std::move_backward(at, candidates_.end() - 1, candidates_.end());
        *at = next;
    }
}

/// The joint that brings the tip nearest when freed; if several let it arrive, the one that needs the
/// smallest range.
Outcome Explanation::best_freed() noexcept {
    Outcome best;
    for (const Candidate& each : candidates_) {
        if (each.joint == no_joint) break;
        const Outcome now = freed(each.joint);
        if (now.over <= 2.0f * at_bound || now.error >= start_ * (1.0f - min_gain_part)) continue;
        const bool nearer = std::max(now.error, tolerance()) < std::max(best.error, tolerance());
        const bool as_near = now.error <= tolerance() && best.error <= tolerance() && now.over < best.over;
        if (best.joint == no_joint || nearer || as_near) best = now;
    }
    return best;
}

/// The angles of the smallest range with which the tip comes as near as with the full range.
JointAngles Explanation::needed_angles(const Outcome& freed) noexcept {
    float low = 0.0f, high = 1.0f;
    JointAngles needed = freed.angles;
    for (int i = 0; i < halvings; ++i) {
        const float part = 0.5f * (low + high);
        const Outcome some = with(freed.joint, widened(options_.limits[freed.joint], freed.angles, part));
        // From another start the tip may arrive within the joint's own limit, which tells nothing about the
        // range needed.
        const bool enough =
            some.over > 2.0f * at_bound && some.error <= std::max(freed.error, 2.0f * tolerance());
        (enough ? high : low) = part;
        if (enough) needed = some.angles;
    }
    return needed;
}

std::optional<ActiveLimit> Explanation::find() noexcept {
    // A method that gave up early may be at limits that stop nothing. So first let the default method
    // continue as far as the limits allow, then free the limits from there.
    start_ = solve_on(options_.limits);
    limited_.saved = limited_.pose;
    find_candidates();
    const Outcome found = best_freed();
    if (found.joint == no_joint) return std::nullopt;
    const LimitedJoint joint = limit_of(found.joint);
    ActiveLimit active = exceeded_bound(joint, needed_angles(found));
    active.joint = found.joint;
    active.kind = joint.kind;
    active.enough =
        found.error <= std::max(options_.tolerance.value_or(1e-3f * scratch_.reach), 2.0f * tolerance());
    return active;
}

}  // namespace

std::optional<ActiveLimit> Solver::explain(std::span<const glm::vec3> joints, const State& state,
                                           glm::vec3 target, const Options& options) noexcept {
    Workspace& scratch = parts_->scratch;
    const bool limited = !(options.plane ? options.plane->limits.empty() : options.limits.empty());
    if (!limited || bones() == 0 || joints.size() != bones() + 1) return std::nullopt;
    if (!are_points(joints) || !are_points({&target, 1}) || !is_valid(state, bones())) return std::nullopt;
    if (!check(options, bones())) return std::nullopt;
    if (options.plane) {
        std::copy(joints.begin(), joints.end(), scratch.joints.begin());
        scratch.saved = state;
        PlaneProblem plane(scratch, scratch.joints, scratch.saved, target, options);
        scratch.saved = plane.problem().state;
        return Explanation(scratch, plane.problem().joints, plane.problem().target, plane.options()).find();
    }
    if (!load_limits(scratch, options.limits)) return std::nullopt;
    scratch.saved = state;
    std::copy(joints.begin(), joints.end(), scratch.joints.begin());
    return Explanation(scratch, scratch.joints, target, options).find();
}

}  // namespace tendril::ik
