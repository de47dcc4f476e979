// Flips: a bone turned far in one tick although its target hardly moved. Their rule and likely causes.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <tendril/ik/flip.hpp>

#include "app/fields/fields.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {

using ik::FlipRule;

template <>
std::span<const FieldText> field_texts<FlipRule>();

/// The command that sets the rule of a lab's part: its member `flips`.
template <class LabPart>
Command flip_command(const char* lab, const char* name) {
    return part_command<LabPart>(
        lab, name, "Set what counts as a flip", field_arguments<FlipRule>(),
        "Sets what counts as a flip of a bone, from the next solve on",
        +[](LabPart& part, const Arguments& given) { set_fields(given, part.flips); });
}

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
