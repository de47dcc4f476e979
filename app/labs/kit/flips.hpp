// Flips: a bone turned far in one tick while its target hardly moved. Their rule and likely causes.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <tendril/ik/flip.hpp>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/json_place.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/more.hpp"

namespace tendril::app {

inline constexpr float min_flip_degrees = 1.0f, max_flip_degrees = 180.0f;

using FlipRule = ik::FlipRule;

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

/// The angle between two rotations, radians, 0 to pi.
double turn_between(const glm::dquat& a, const glm::dquat& b);
/// Metres from `point` to the segment from `a` to `b`.
float distance_to(glm::vec3 point, glm::vec3 a, glm::vec3 b);

/// The remedy that a button can apply against such flips, in a lab that has the command.
enum class FlipCure { ByHand, AddPole, MovePole, NoRestarts };

/// A way to prevent such flips: a sentence for display, and its button. `poled`: the chain has a pole target.
struct FlipAdvice {
    const char* cure;
    FlipCure button = FlipCure::ByHand;
};
FlipAdvice flip_advice(ik::FlipCause cause, bool poled);

}  // namespace tendril::app
