#include "humanoid/hold_solve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "humanoid/input.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

namespace {

// Tuned with tests/core/humanoid_hold_test.cpp. Costs are relative to displacing the object by a metre.

/// Cost of a radian of an upper arm in one step. If larger, the object takes more steps to its requested
/// pose.
constexpr double joint_damping = 0.02;
/// After each step the damping falls to this fraction of the step's size: large steps are cautious, small
/// ones exact.
constexpr double damping_part = 0.1, min_joint_damping = 1e-6;
/// A grip's compliance in one step, before its force has grown. If larger, grips take more steps to close.
constexpr double grip_compliance = 0.01;
/// Maximum force of a grip at the start of a step, and its increase per metre that the object has given way.
constexpr double max_grip_force = 2.0;
/// Weight of the grips' second derivatives along their forces, like BodySolve's residual_stiffness.
constexpr double force_stiffness = 2.0;
/// Fraction of a step by which the step may pass a limit.
constexpr double limit_tolerance = 0.01;
/// Further steps that only close the grips, if the solve has not settled.
constexpr int closing_steps = 20;
constexpr int max_hold_changes = 6;  ///< maximum changes of the set of limits, per step
/// Maximum size of one step, radians and metres.
constexpr double max_hold_step = 0.4;
/// A step smaller than this ends the solve if the grips are as closed as possible.
constexpr double hold_tolerance = 1e-7;
/// Maximum move of an elbow or hand: metres per metre of the requested grips and shoulders, plus metres.
constexpr double jump_per_metre = 20.0, jump_slack = 1e-3;
/// A joint counts as at its limit if it cannot turn although a force over the first constant would turn it by
/// more than the second, radians.
constexpr double min_reported_force = 1e-5, min_reported_turn = 1e-3;
/// An arm is straight if its bend exceeds its minimum by at most this, radians.
constexpr double straight_slack = 0.03;

}  // namespace

void HoldSolve::find_arms() noexcept {
    // The order of the grips does not matter.
    for (const Effector hand : {Effector::LeftHand, Effector::RightHand}) {
        const auto found = std::ranges::find(object_.grips, hand, &Grip::hand);
        if (found == object_.grips.end()) continue;
        const Grip& grip = *found;
        Arm& arm = arms_[arm_count_];
        arm.grip = &grip;
        arm.end = static_cast<std::size_t>(work_.ends[static_cast<std::size_t>(grip.hand)]);
        int at = static_cast<int>(arm.end);
        if (!grip.rotation) at = link(arm.end).parent;  // the hand turns with the forearm
        for (; at >= 0; at = link(static_cast<std::size_t>(at)).parent) {
            const Bone bone = link(static_cast<std::size_t>(at)).bone;
            if (bone < Bone::LeftShoulder || bone > Bone::RightHand || joint_count_ == joints_.size()) break;
            joints_[joint_count_++] = {.link = static_cast<std::size_t>(at), .arm = arm_count_};
        }
        for (const BodyLimb& limb : work_.limbs)
            if (limb.end == static_cast<int>(arm.end)) arm.limb = &limb;
        if (arm.limb && arm.limb->quadratic > 0.0) {
            glm::dvec3 about;
            arm.min_bend =
                std::min(arm.limb->linear / (2.0 * arm.limb->quadratic), std::max(bend(arm, about), 0.0));
        } else {
            arm.limb = nullptr;
        }
        arm.forearm = direction_of(link(arm.end).offset, 1e-9).value_or(glm::dvec3(0.0));
        ++arm_count_;
    }
}

double HoldSolve::bend(const Arm& arm, glm::dvec3& about) const noexcept {
    const Link& upper = link(static_cast<std::size_t>(arm.limb->upper));
    const Link& lower = link(static_cast<std::size_t>(arm.limb->lower));
    const glm::dvec3 first = minus(lower.position, upper.position),
                     second = minus(link(arm.end).position, lower.position);
    const glm::dvec3 axis = cross(first, second);
    const double sine = length(axis);
    about = sine > 1e-9 * length(first) * length(second) ? times(axis, 1.0 / sine)
                                                         : rotated(upper.rotation, arm.limb->axis);
    return arctangent(sine, dot(first, second));
}

/// The rotation of the hand's link that puts the hand on its grip.
glm::dquat HoldSolve::grip_rotation(const Arm& arm) const noexcept {
    return math::compose(math::compose(pose_.rotation, rig::normalised(*arm.grip->rotation)),
                         conjugate(link(arm.end).rest));
}

/// Turns the hands to their grips, within their limits, before anything else moves.
void HoldSolve::align_hands() noexcept {
    for (std::size_t i = 0; i < arm_count_; ++i) {
        const Arm& arm = arms_[i];
        if (!arm.grip->rotation) continue;
        Link& hand = link(arm.end);
        hand.turn = math::compose(conjugate(before(hand)), grip_rotation(arm));
        clamp_hand(arm);
    }
}

double HoldSolve::shared_twist(const Arm& arm) const noexcept {
    const Link& hand = link(arm.end);
    return options_.body.twist_share *
           (hinge_angle(arm.forearm, hand.turn) - hinge_angle(arm.forearm, hand.clip_turn));
}

bool HoldSolve::clamp(const Joint& joint) noexcept {
    const Arm& arm = arms_[joint.arm];
    return joint.link == arm.end ? clamp_hand(arm) : clamp_turn(link(joint.link), 0.0f);
}

bool HoldSolve::clamp_hand(const Arm& arm) noexcept {
    Link& hand = link(arm.end);
    double twist = shared_twist(arm);
    hand.turn = math::compose(rotation_about(arm.forearm, -twist), hand.turn);
    const bool clamped = clamp_turn(hand, 0.0f);
    if (const double share = options_.body.twist_share; clamped && share < 1.0) {
        const double left = hinge_angle(arm.forearm, hand.turn) - hinge_angle(arm.forearm, hand.clip_turn);
        twist = left * share / (1.0 - share);
    }
    hand.turn = rig::normalised(math::compose(rotation_about(arm.forearm, twist), hand.turn));
    return clamped;
}

void HoldSolve::measure() noexcept {
    work_.place_links(glm::dvec3(0.0));
    row_count_ = 0;
    const auto add = [&](std::size_t arm, bool angular, const glm::dvec3& along) {
        rows_[row_count_++] = {arm, angular, along};
    };
    for (std::size_t i = 0; i < arm_count_; ++i) {
        Arm& arm = arms_[i];
        const Link& hand = link(arm.end);
        arm.from = rotated(pose_.rotation, arm.grip->position);
        arm.gap = minus(plus(pose_.position, arm.from), hand.position);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 along{0.0};
            along[axis] = 1.0;
            add(i, false, along);
        }
        if (!arm.grip->rotation) continue;
        const glm::dquat error = math::compose(grip_rotation(arm), conjugate(hand.rotation));
        const auto axis = direction_of(arm.grip->axis, 1e-9);
        if (!axis) {
            arm.turn_gap = logarithm(error);
            for (int each = 0; each < 3; ++each) {
                glm::dvec3 along{0.0};
                along[each] = 1.0;
                add(i, true, along);
            }
            continue;
        }
        // Only the axes must align.
        arm.axis = rotated(pose_.rotation, *axis);
        const glm::dvec3 held = rotated(conjugate(error), arm.axis), about = cross(held, arm.axis);
        const double sine = length(about), angle = arctangent(sine, dot(held, arm.axis));
        arm.turn_gap = sine > 1e-9 ? times(about, angle / sine) : times(perpendicular(arm.axis), angle);
        const glm::dvec3 first = perpendicular(arm.axis);
        add(i, true, first);
        add(i, true, cross(arm.axis, first));
    }
}

double HoldSolve::max_gap() const noexcept {
    double largest = 0.0;
    for (std::size_t i = 0; i < arm_count_; ++i)
        largest = std::max({largest, length(arms_[i].gap), turn_length_ * length(arms_[i].turn_gap)});
    return largest / work_.size;
}

glm::dvec3 HoldSolve::column(const Row& row, const Joint& joint) const noexcept {
    if (joint.arm != row.arm) return glm::dvec3(0.0);
    if (row.angular) return times(row.along, turn_length_);
    return cross(minus(link(arms_[row.arm].end).position, link(joint.link).position), row.along);
}

glm::dvec3 HoldSolve::object_column(const Row& row) const noexcept {
    if (row.angular) return times(row.along, -turn_length_);
    return cross(row.along, arms_[row.arm].from);
}

/// Finds a step that closes the grips and moves the object towards its requested pose. Returns the step's
/// size, radians and metres. Sets `failed_` if there is none.
double HoldSolve::find_step() noexcept {
    double object_stiffness = turn_length_ * turn_length_;
    for (std::size_t i = 0; i < arm_count_; ++i)
        object_stiffness += force_stiffness * std::max(-dot(arms_[i].force, arms_[i].from), 0.0);
    object_compliance_ = 1.0 / object_stiffness;
    for (std::size_t i = 0; i < joint_count_; ++i) {
        Joint& joint = joints_[i];
        const Link& at = link(joint.link);
        const Arm& arm = arms_[joint.arm];
        joint.freedom.begin(at, before(at));
        joint.held = glm::dvec3(0.0);
        const double outward = dot(arm.force, minus(link(arm.end).position, at.position));
        joint.compliance = 1.0 / (damping_ * work_.size * work_.size / at.mobility +
                                  force_stiffness * std::max(outward, 0.0));
    }
    failed_ = !solve_rows();
    for (int i = 0; i < max_hold_changes && !failed_ && block(); ++i) failed_ = !solve_rows();
    double size = std::max(length(shift_) / work_.size, length(turn_));
    for (std::size_t i = 0; i < joint_count_; ++i) size = std::max(size, length(joints_[i].turn));
    return size;
}

/// False if the equations have no finite solution.
bool HoldSolve::solve_rows() noexcept {
    RowEquations& e = equations_;
    e.count = row_count_;
    const glm::dvec3 move = times(minus(target_.position, pose_.position), pull_);
    const glm::dvec3 turn = times(logarithm(math::compose(target_.rotation, conjugate(pose_.rotation))),
                                  pull_ * turn_length_ * turn_length_ * object_compliance_);
    // If the grips cannot close, forces kept in full would grow without bound.
    const double max_force = max_grip_force * (work_.size + length(move));
    const auto clamped = [](const glm::dvec3& value, double largest) {
        const double size = length(value);
        return size > largest ? times(value, largest / size) : value;
    };
    for (std::size_t r = 0; r < row_count_; ++r) {
        const Row& row = rows_[r];
        const Arm& arm = arms_[row.arm];
        const double size = row_length(row);
        const glm::dvec3 force =
            row.angular ? clamped(arm.torque, turn_length_ * max_force) : clamped(arm.force, max_force);
        const glm::dvec3 turned = object_column(row);
        e.b[r] = size * dot(row.along, row.angular ? arm.turn_gap : arm.gap) - dot(turned, turn) +
                 grip_compliance * dot(row.along, force) / size;
        if (!row.angular) e.b[r] += dot(row.along, move);
        for (std::size_t q = 0; q <= r; ++q) {
            const Row& other = rows_[q];
            double sum = object_compliance_ * dot(turned, object_column(other));
            if (!row.angular && !other.angular) sum += dot(row.along, other.along);
            e.a[r][q] = sum;
        }
        e.a[r][r] += grip_compliance;
    }
    for (std::size_t i = 0; i < joint_count_; ++i) {
        const Joint& joint = joints_[i];
        for (std::size_t r = 0; r < row_count_; ++r) {
            if (rows_[r].arm != joint.arm) continue;
            e.b[r] -= dot(column(rows_[r], joint), joint.held);
            const glm::dvec3 moved =
                times(joint.freedom.allowed(link(joint.link), column(rows_[r], joint)), joint.compliance);
            for (std::size_t q = 0; q <= r; ++q) e.a[r][q] += dot(column(rows_[q], joint), moved);
        }
    }
    if (!e.factorise()) return false;
    e.solve();
    shift_ = move;
    turn_ = turn;
    for (std::size_t r = 0; r < row_count_; ++r) {
        if (!rows_[r].angular) shift_ = minus(shift_, times(rows_[r].along, e.b[r]));
        turn_ = plus(turn_, times(object_column(rows_[r]), object_compliance_ * e.b[r]));
    }
    for (std::size_t i = 0; i < joint_count_; ++i) {
        Joint& joint = joints_[i];
        glm::dvec3 torque{0.0};
        for (std::size_t r = 0; r < row_count_; ++r)
            if (rows_[r].arm == joint.arm) torque = plus(torque, times(column(rows_[r], joint), e.b[r]));
        joint.turn =
            plus(joint.held, joint.freedom.allowed(link(joint.link), times(torque, joint.compliance)));
    }
    return true;
}

/// The part of a turn that is beyond the joint's limit, in the character's space; `there` receives the turn
/// at which the joint stops.
glm::dvec3 HoldSolve::excess(const Joint& joint, const glm::dvec3& turn, glm::dquat& there) noexcept {
    Link& at = link(joint.link);
    const glm::dquat was = at.turn, parent = before(at);
    const glm::dquat tried = math::compose(exponential(rotated(conjugate(parent), turn)), was);
    at.turn = tried;
    const bool beyond = clamp(joint);
    there = at.turn;
    at.turn = was;
    return beyond ? rotated(parent, logarithm(math::compose(tried, conjugate(there)))) : glm::dvec3(0.0);
}

/// Blocks the bounds that `turn` is at and that `step` would pass.
bool HoldSolve::block_bounds(Joint& joint, const glm::dquat& turn, const glm::dvec3& step) noexcept {
    Link& at = link(joint.link);
    const Arm& arm = arms_[joint.arm];
    if (joint.link != arm.end) return joint.freedom.block_limit(at, turn, before(at), step);
    // The lower arm's share of the twist is not the hand's.
    const glm::dquat was = std::exchange(at.turn, turn);
    const glm::dquat share = rotation_about(arm.forearm, shared_twist(arm));
    at.turn = was;
    return joint.freedom.block_limit(at, math::compose(conjugate(share), turn),
                                     math::compose(before(at), share), step);
}

/// Stops the joints at the limits that the step would pass. False if nothing changed.
bool HoldSolve::block() noexcept {
    bool changed = false;
    for (std::size_t i = 0; i < joint_count_; ++i) {
        Joint& joint = joints_[i];
        const Arm& arm = arms_[joint.arm];
        if (block_bounds(joint, link(joint.link).turn, joint.turn)) {
            changed = true;
        } else {
            glm::dquat there;
            const glm::dvec3 beyond = excess(joint, joint.turn, there);
            const int known = joint.freedom.blocked;
            if (known == 0 && length(beyond) > limit_tolerance * length(joint.turn))
                block_bounds(joint, there, beyond);
            for (int k = known; k < joint.freedom.blocked; ++k) {
                const glm::dvec3& out = joint.freedom.outward[static_cast<std::size_t>(k)];
                joint.held = plus(joint.held, times(out, dot(out, minus(joint.turn, beyond))));
                changed = true;
            }
        }
        if (!arm.limb || static_cast<std::size_t>(arm.limb->lower) != joint.link) continue;
        glm::dvec3 about;
        const double left = arm.min_bend - bend(arm, about);
        if (!(dot(about, joint.turn) < left - 1e-12)) continue;
        glm::dvec3 direction = about;
        if (link(joint.link).limit.hinge())
            direction = times(joint.freedom.hinge, dot(joint.freedom.hinge, about) < 0.0 ? -1.0 : 1.0);
        if (!joint.freedom.block(direction)) continue;
        const glm::dvec3& out = joint.freedom.outward[static_cast<std::size_t>(joint.freedom.blocked - 1)];
        joint.held = plus(joint.held, times(out, left));
        changed = true;
    }
    return changed;
}

void HoldSolve::apply(double part) noexcept {
    pose_.position = plus(pose_.position, times(shift_, part));
    pose_.rotation = rig::normalised(math::compose(exponential(times(turn_, part)), pose_.rotation));
    for (std::size_t i = 0; i < arm_count_; ++i) {
        Arm& arm = arms_[i];
        glm::dvec3 force{0.0}, torque{0.0};
        for (std::size_t r = 0; r < row_count_; ++r) {
            if (rows_[r].arm != i) continue;
            glm::dvec3& sum = rows_[r].angular ? torque : force;
            sum = plus(sum, times(rows_[r].along, row_length(rows_[r]) * equations_.b[r]));
        }
        arm.force = mix(arm.force, force, part), arm.torque = mix(arm.torque, torque, part);
    }
    for (std::size_t i = 0; i < joint_count_; ++i) {
        const Joint& joint = joints_[i];
        Link& at = link(joint.link);
        const glm::dvec3 turn = rotated(conjugate(before(at)), times(joint.turn, part));
        at.turn = math::compose(exponential(turn), at.turn);
        clamp(joint);
    }
    work_.place_links(glm::dvec3(0.0));
    for (std::size_t i = 0; i < arm_count_; ++i) {
        if (!arms_[i].limb) continue;
        glm::dvec3 about;
        const double short_of = arms_[i].min_bend - bend(arms_[i], about);
        if (!(short_of > 0.0)) continue;
        Link& lower = link(static_cast<std::size_t>(arms_[i].limb->lower));
        lower.turn =
            math::compose(rotation_about(rotated(conjugate(before(lower)), about), short_of), lower.turn);
    }
}

/// True once nothing changes.
bool HoldSolve::step() noexcept {
    const double size = find_step(), open = max_gap();
    if (failed_) return false;
    ++iterations_;
    apply(std::min(1.0, max_hold_step / size));
    damping_ = std::clamp(damping_part * size, min_joint_damping, joint_damping);
    measure();
    return size < hold_tolerance && std::abs(max_gap() - open) < hold_tolerance;
}

void HoldSolve::run(std::span<rig::Transform> pose, HoldReport& report, HoldState& state) noexcept {
    work_.read_pose(pose);
    for (Link& each : work_.links) each.turn = each.clip_turn;
    work_.place_links(glm::dvec3(0.0));
    find_arms();
    align_hands();
    measure();
    damping_ = joint_damping;
    report.settled = false;
    while (iterations_ < options_.max_iterations && !report.settled && !failed_) report.settled = step();
    for (Arm& arm : arms_) arm.pull_force = arm.force, arm.pull_torque = arm.torque;
    // If limits keep the solve from settling, closes the grips from their current pose, if possible.
    if (!report.settled && !failed_ && max_gap() > hold_tolerance) {
        pull_ = 0.0;
        for (Arm& arm : arms_) arm.force = arm.torque = glm::dvec3(0.0);
        damping_ = joint_damping;
        for (int i = 0; i < closing_steps && !step() && !failed_;) ++i;
    }
    report.iterations = iterations_;
    if (!is_finite()) {  // overflow: restore the previous pose
        for (Link& each : work_.links) each.turn = each.clip_turn;
        pose_ = target_;
        report.settled = false;
        measure();
    }
    write_report(report, state);
    for (std::size_t i = 0; i < arm_count_; ++i) {
        const Arm& arm = arms_[i];
        Link& hand = link(arm.end);
        if (!arm.grip->rotation || hand.parent < 0) continue;
        // Like BodySolve::turn_end(): the lower arm takes part of the twist, which moves no joint.
        Link& lower = link(static_cast<std::size_t>(hand.parent));
        const double twist = shared_twist(arm);
        lower.turn = math::compose(lower.turn, rotation_about(arm.forearm, twist));
        hand.turn = math::compose(rotation_about(arm.forearm, -twist), hand.turn);
    }
    work_.place_links(glm::dvec3(0.0));
    const TwistNodes::ArmTurns turns = work_.twist.turns(pose);
    work_.write_pose(pose, glm::dvec3(0.0));
    work_.twist.follow(turns, pose);
}

bool HoldSolve::is_finite() const noexcept {
    bool valid = is_within(pose_.position) && std::abs(dot(pose_.rotation, pose_.rotation) - 1.0) < 1e-6;
    for (const Link& each : work_.links)
        valid = valid && is_within(each.position) && std::abs(dot(each.rotation, each.rotation) - 1.0) < 1e-6;
    return valid;
}

void HoldSolve::write_report(HoldReport& report, HoldState& state) noexcept {
    report.object = pose_;
    report.moved = length(minus(target_.position, pose_.position));
    report.turned = length(logarithm(math::compose(target_.rotation, conjugate(pose_.rotation))));
    for (std::size_t i = 0; i < joint_count_; ++i) {
        const Joint& joint = joints_[i];
        const Arm& arm = arms_[joint.arm];
        const glm::dvec3 lever = minus(link(arm.end).position, link(joint.link).position);
        const glm::dvec3 torque = plus(cross(lever, arm.pull_force), arm.pull_torque);
        const auto direction = direction_of(torque, min_reported_force * work_.size * work_.size);
        glm::dquat there;
        report.body.at_limit[static_cast<std::size_t>(link(joint.link).bone)] =
            direction &&
            length(excess(joint, times(*direction, min_reported_turn), there)) > 0.1 * min_reported_turn;
    }
    double cause = 0.0, travel = 0.0;
    HoldState now;
    for (std::size_t i = 0; i < arm_count_; ++i) {
        const Arm& arm = arms_[i];
        const std::size_t hand = arm.grip->hand == Effector::LeftHand ? 0 : 1;
        GripReport& grip = report.grips[hand];
        grip = {.holds = true, .gap = length(arm.gap), .off = length(arm.turn_gap)};
        if (arm.limb) {
            glm::dvec3 about;
            const Link& upper = link(static_cast<std::size_t>(arm.limb->upper));
            const glm::dvec3 way = minus(link(arm.end).position, upper.position);
            grip.straight = bend(arm, about) < arm.min_bend + straight_slack &&
                            dot(arm.pull_force, way) > min_reported_force * work_.size * length(way);
            now.shoulders[hand] = upper.position;
            now.elbows[hand] = link(static_cast<std::size_t>(arm.limb->lower)).position;
        }
        now.hands[hand] = link(arm.end).position;
        now.grips[hand] = plus(target_.position, rotated(target_.rotation, arm.grip->position));
        if (!state.grips[hand]) continue;
        cause = std::max({cause, length(minus(*now.grips[hand], *state.grips[hand])),
                          length(minus(now.shoulders[hand], state.shoulders[hand]))});
        travel = std::max({travel, length(minus(now.elbows[hand], state.elbows[hand])),
                           length(minus(now.hands[hand], state.hands[hand]))});
    }
    report.jumped = travel > jump_per_metre * cause + jump_slack * work_.size;
    state = now;
}

}  // namespace tendril::humanoid::detail
