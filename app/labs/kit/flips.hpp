// What counts as a flip: a bone that turned far in a tick while what it follows hardly moved.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/json_place.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

inline constexpr float min_flip_degrees = 1.0f, max_flip_degrees = 180.0f;

/// A bone turned by more than `degrees`, while the target (of a rig: each control that was moved), as the
/// bone's root sees it, turned by less than a share of that, or moved by less than a share of the reach.
struct FlipRule {
    float degrees = 30.0f;      ///< min_flip_degrees to max_flip_degrees
    float angle_share = 0.2f;   ///< 0 to 1
    float reach_share = 0.02f;  ///< 0 to 1

    bool operator==(const FlipRule&) const = default;
};

Json save_flip_rule(const FlipRule& rule);
FlipRule load_flip_rule(const JsonPlace& place);

/// What the rule is about, in the words of a lab.
struct FlipWords {
    const char* command;  ///< that sets the rule
    const char* mover;    ///< "target": what a bone follows
    const char* seen;     ///< "the target, as the root sees it,"
    const char* size;     ///< "reach"
    const char* whole;    ///< "the chain's reach"
};
/// Each of them may be left out.
std::vector<Argument> flip_arguments(const FlipWords& words);
void set_flip_rule(FlipRule& rule, const Arguments& given);
/// Fields that set it.
void flip_rows(const FlipRule& rule, const FlipWords& words, Emit& emit);

// What can make a chain of bones flip that reaches for a target: as much as the places of its joints show.

/// Radians, 0 to pi; 0 where one of them has no length.
float angle_between(glm::vec3 a, glm::vec3 b);
/// Between two rotations, 0 to pi.
double turn_between(const glm::dquat& a, const glm::dquat& b);
/// Metres from `point` to the line from `a` to `b`, no further than its ends.
float distance_to(glm::vec3 point, glm::vec3 a, glm::vec3 b);

/// A chain just before a flip, or just after it; one joint at least.
struct ReachPose {
    std::vector<glm::vec3> joints{};  ///< from the root on
    glm::vec3 target{0.0f};
    std::optional<glm::vec3> pole{};  ///< the pole target

    glm::vec3 root() const { return joints.front(); }
};

/// `reach`: metres, here and below. Closer than a fiftieth of it.
bool went_through_root(const ReachPose& before, const ReachPose& after, float reach);

/// Where the line from root to target passes the pole target, on either side of the root, the plane that the
/// chain bends in has no direction.
struct PolePassage {
    bool passed = false;  ///< between the two
    bool close = false;   ///< it is near the pole at one of them
};
PolePassage pole_passage(const ReachPose& before, const ReachPose& after);

/// One of the two was.
bool was_straight(const ReachPose& before, const ReachPose& after, float reach);

}  // namespace tendril::app
