#include "tendril/ik/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ik/incident/thresholds.hpp"
#include "ik/math.hpp"
#include "tendril/elementary.hpp"

namespace tendril::ik {
namespace {

constexpr float near_root = 0.02f;  ///< fraction of the reach
/// Bend, share of the reach: two equal bones at 99.5 % of their reach turn by 11 degrees to change sides.
constexpr float nearly_straight = 0.05f;
constexpr float close_to_pole = 0.17f;  ///< radians, ten degrees
constexpr float on_axis = 1e-4f;  ///< radians: float coordinates of 500 times the reach are off by as much

float distance_to_segment(glm::vec3 point, glm::vec3 a, glm::vec3 b) noexcept {
    const glm::vec3 along = b - a;
    const float square = math::dot(along, along);
    const float t = square > 0.0f ? std::clamp(math::dot(point - a, along) / square, 0.0f, 1.0f) : 0.0f;
    return math::distance(point, a + t * along);
}

/// Radians between two lines, 0 to pi/2.
float line_angle(glm::vec3 a, glm::vec3 b) noexcept {
    const float angle = angle_between(a, b);
    return std::min(angle, static_cast<float>(math::pi) - angle);
}

/// Movement of the target, or of the pole target about the line from root to target: the larger of each.
InputMove input_move(const ReachPose& before, const ReachPose& after) noexcept {
    if (!before.target || !after.target) return {};
    const glm::vec3 from = *before.target - before.root(), to = *after.target - after.root();
    InputMove move = move_between(glm::dvec3(from), glm::dvec3(to));
    if (!before.pole || !after.pole) return move;
    const glm::vec3 pole_from = *before.pole - before.root(), pole_to = *after.pole - after.root();
    if (pole_from == pole_to) return move;
    const float turned = angle_between(math::cross(to, pole_from), math::cross(to, pole_to));
    move.distance = std::max<double>(move.distance, math::distance(pole_from, pole_to));
    move.angle = std::max<double>(move.angle, turned);
    return move;
}

}  // namespace

const char* text(FlipCause cause) noexcept {
    static constexpr std::array texts{
        "the target jumped",
        "the target went through the root",
        "the target's line passed the pole",
        "the chain was straight (collinear)",
        "the chain was folded onto one line (collinear)",
        "the target's line came close to the pole",
        "the target's line passed a reference axis (up, or another of the world's), "
        "where a bend towards it has no side",
        "the bone rolled about itself, while its ends hardly moved",
        "nothing in the input explains it: look at the solver's own state"};
    return texts[static_cast<std::size_t>(cause)];
}

float angle_between(glm::vec3 a, glm::vec3 b) noexcept {
    return math::arctangent(math::length(math::cross(a, b)), math::dot(a, b));
}

BoneTurn furthest_turn(const ReachPose& before, const ReachPose& after) noexcept {
    constexpr float equal = 1e-3f;  // radians
    const auto& was = before.joints;
    const auto& is = after.joints;
    const glm::vec3 root_move = after.root() - before.root();
    BoneTurn furthest;
    for (std::size_t i = 1; i < was.size(); ++i) {
        const float angle = angle_between(was[i] - was[i - 1], is[i] - is[i - 1]);
        if (angle <= furthest.radians + equal) continue;
        const auto moved = [&](std::size_t joint) {
            return math::distance(was[joint] + root_move, is[joint]);
        };
        furthest = {moved(i - 1) > moved(i) ? i - 1 : i, angle};
    }
    return furthest;
}

InputMove move_between(const glm::dvec3& from, const glm::dvec3& to) noexcept {
    return {.distance = math::length(math::minus(to, from)),
            .angle = math::arctangent(math::length(math::cross(from, to)), math::dot(from, to))};
}

bool explains(const InputMove& move, double radians, double reach, const FlipRule& rule) noexcept {
    constexpr double rounding = 1e-9;  // rounding of a rotation, or of a share
    const double angle = rule.angle_share * radians, share = rule.reach_share;
    return move.turn >= std::max(angle, rounding) || move.share >= std::max(share, rounding) ||
           (move.distance > 0.0 && move.angle >= angle && move.distance >= share * reach);
}

std::optional<BoneTurn> find_flip(const ReachPose& before, const ReachPose& after,
                                  const FlipRule& rule) noexcept {
    const BoneTurn turn = furthest_turn(before, after);
    if (in_degrees(turn.radians) <= rule.degrees) return std::nullopt;
    if (explains(input_move(before, after), turn.radians, reach_of(after), rule)) return std::nullopt;
    return turn;
}

FlipCause flip_cause(const ReachPose& before, const ReachPose& after) noexcept {
    if (went_through_root(before, after)) return FlipCause::ThroughRoot;
    const PolePassage pole = pole_passage(before, after);
    if (pole.passed) return FlipCause::PassedPole;
    if (was_straight(before, after)) return collinear_cause(before, after);
    return pole.close ? FlipCause::ClosePole : FlipCause::Unexplained;
}

float reach_of(const ReachPose& pose) noexcept {
    float reach = 0.0f;
    for (std::size_t i = 1; i < pose.joints.size(); ++i)
        reach += math::distance(pose.joints[i - 1], pose.joints[i]);
    return reach;
}

bool went_through_root(const ReachPose& before, const ReachPose& after) noexcept {
    if (!before.target || !after.target) return false;
    const glm::vec3 from = *before.target - before.root(), to = *after.target - after.root();
    return distance_to_segment(glm::vec3(0.0f), from, to) < near_root * reach_of(after);
}

PolePassage pole_passage(const ReachPose& before, const ReachPose& after) noexcept {
    if (!before.target || !after.target || !before.pole || !after.pole) return {};
    const glm::vec3 from = *before.target - before.root(), to = *after.target - after.root(),
                    pole_from = *before.pole - before.root(), pole_to = *after.pole - after.root();
    return {math::dot(math::cross(from, pole_from), math::cross(to, pole_to)) < 0.0f,
            std::min(line_angle(from, pole_from), line_angle(to, pole_to)) < close_to_pole};
}

bool passed_axis(const ReachPose& before, const ReachPose& after) noexcept {
    if (!before.target || !after.target || before.pole || after.pole) return false;
    const glm::vec3 from = *before.target - before.root(), to = *after.target - after.root();
    for (int i = 0; i < 3; ++i) {
        glm::vec3 axis(0.0f);
        axis[i] = 1.0f;
        const float turned = angle_between(math::cross(from, axis), math::cross(to, axis));
        const float off = std::min(line_angle(from, axis), line_angle(to, axis));
        const float passes = off < close_to_pole ? FlipRule{}.degrees : 90.0f;
        if (off < on_axis || in_degrees(turned) > passes) return true;
    }
    return false;
}

float bend_of(std::span<const glm::vec3> joints) noexcept {
    const glm::vec3 line = joints.back() - joints.front();
    const float length = math::length(line);
    float furthest = 0.0f;
    for (const glm::vec3 joint : joints) {
        const glm::vec3 from_root = joint - joints.front();
        const float off =
            length > 0.0f ? math::length(math::cross(from_root, line)) / length : math::length(from_root);
        furthest = std::max(furthest, off);
    }
    return furthest;
}

bool was_straight(const ReachPose& before, const ReachPose& after) noexcept {
    return std::min(bend_of(before.joints), bend_of(after.joints)) < nearly_straight * reach_of(after);
}

FlipCause collinear_cause(const ReachPose& before, const ReachPose& after) noexcept {
    const ReachPose& flat = bend_of(before.joints) <= bend_of(after.joints) ? before : after;
    return math::distance(flat.root(), flat.joints.back()) < 0.5f * reach_of(after) ? FlipCause::Folded
                                                                                    : FlipCause::Straight;
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::FlipRule>() noexcept {
    using ik::FlipRule;
    static constexpr Field rows[] = {field<&FlipRule::degrees>("degrees", {1.0, 180.0}, "deg"),
                                     field<&FlipRule::angle_share>("angle_share"),
                                     field<&FlipRule::reach_share>("reach_share")};
    return rows;
}
