// Flips: a bone turned far in one tick while its target hardly moved. The rule for them, and likely causes.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/json_place.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/more.hpp"

namespace tendril::app {

inline constexpr float min_flip_degrees = 1.0f, max_flip_degrees = 180.0f;

/// A bone turned by more than `degrees` while the target (in a rig, each moved control) turned, as seen from
/// the bone's root, by less than `angle_share` of that, or moved by less than `reach_share` of the reach.
struct FlipRule {
    float degrees = 30.0f;      ///< min_flip_degrees to max_flip_degrees
    float angle_share = 0.2f;   ///< 0 to 1
    float reach_share = 0.02f;  ///< 0 to 1

    bool operator==(const FlipRule&) const = default;
};

Json save_flip_rule(const FlipRule& rule);
FlipRule load_flip_rule(const JsonPlace& place);

/// How a lab words the rule.
struct FlipWords {
    const char* command;  ///< the command that sets the rule
    const char* mover;    ///< "target": what a bone follows
    const char* seen;     ///< "the target, as the root sees it,"
    const char* size;     ///< "reach"
    const char* whole;    ///< "the chain's reach"
};
/// All optional.
std::vector<Argument> flip_arguments(const FlipWords& words);
void set_flip_rule(FlipRule& rule, const Arguments& given);
/// Fields that edit the rule.
void flip_rows(const FlipRule& rule, const FlipWords& words, MoreRows& more, Emit& emit);

// Likely causes of a flip in a chain that reaches for a target, judged from its joint positions alone.

/// Radians, 0 to pi; 0 if either has no length.
float angle_between(glm::vec3 a, glm::vec3 b);
/// Between two rotations, 0 to pi.
double turn_between(const glm::dquat& a, const glm::dquat& b);
/// Metres from `point` to the segment from `a` to `b`.
float distance_to(glm::vec3 point, glm::vec3 a, glm::vec3 b);

/// A chain just before or just after a flip; at least one joint.
struct ReachPose {
    std::vector<glm::vec3> joints{};  ///< from the root on
    glm::vec3 target{0.0f};
    std::optional<glm::vec3> pole{};  ///< the pole target

    glm::vec3 root() const { return joints.front(); }
};

/// What a button can do against such flips, in a lab that has the command.
enum class FlipCure { ByHand, AddPole, MovePole, NoRestarts };

/// A cause, and what prevents such flips: a clause and a sentence for display.
struct FlipReason {
    const char* cause;
    const char* cure;
    FlipCure button = FlipCure::ByHand;
};
inline constexpr FlipReason through_root{
    "the target went through the root",
    "Lead the target around the root: there, every direction is equally near."};
inline constexpr FlipReason passed_pole{
    "the target's line passed the pole",
    "Move the pole out of the plane in which the target moves: towards you, if you drag in the view.",
    FlipCure::MovePole};
inline constexpr FlipReason close_to_pole{"the target's line came close to the pole", passed_pole.cure,
                                          passed_pole.button};
inline constexpr FlipReason straight_chain{
    "the chain was straight (collinear)",
    "Add a pole target on the side to which it should bend, or keep the target within reach.",
    FlipCure::AddPole};
inline constexpr FlipReason folded_chain{"the chain was folded onto one line (collinear)",
                                         "Add a pole target on the side to which it should bend.",
                                         FlipCure::AddPole};

/// Whether the target passed within a fiftieth of the reach of the root. `reach`: metres, here and below.
bool went_through_root(const ReachPose& before, const ReachPose& after, float reach);

/// The bending plane has no direction while the line through root and target contains the pole target.
struct PolePassage {
    bool passed = false;  ///< the pole target changed sides
    bool close = false;   ///< in one of the poses the line is within 10 degrees of the pole target
};
PolePassage pole_passage(const ReachPose& before, const ReachPose& after);

/// Whether the chain was straight in either pose: every joint within a fiftieth of the reach of the line from
/// root to tip.
bool was_straight(const ReachPose& before, const ReachPose& after, float reach);
/// What such a chain was: straight, or folded if its tip was within half its reach of the root.
const FlipReason& collinear_reason(const ReachPose& before, const ReachPose& after, float reach);

}  // namespace tendril::app
