#include "app/labs/kit/flips.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tendril/elementary.hpp"

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<FlipRule>() {
    static constexpr FieldText texts[] = {
        {.name = "degrees",
         .label = "flip over",
         .help =
             "A bone that turns by more than this in a tick, while its target or control hardly moves, is "
             "marked as a flip.",
         .step = 0.5f,
         .decimals = 0,
         .more = true},
        {.name = "angle_share",
         .label = "target under",
         .help = "The target or control hardly moves if its direction, seen from the root or the bone, "
                 "turns by less than this share of the bone's turn.",
         .step = 0.005f,
         .unit = "of it",
         .more = true},
        {.name = "reach_share",
         .label = "or under",
         .help = "Or if it moves by less than this share of the chain's reach, of the skeleton's size or of "
                 "the character's height.",
         .step = 0.001f,
         .decimals = 3,
         .unit = "of reach",
         .more = true}};
    return texts;
}

double turn_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat between = glm::conjugate(a) * b;
    return 2.0 *
           math::arctangent(glm::length(glm::dvec3(between.x, between.y, between.z)), std::abs(between.w));
}

float distance_to(glm::vec3 point, glm::vec3 a, glm::vec3 b) {
    const glm::vec3 along = b - a;
    const float square = glm::dot(along, along);
    const float t = square > 0.0f ? std::clamp(glm::dot(point - a, along) / square, 0.0f, 1.0f) : 0.0f;
    return glm::distance(point, a + t * along);
}

FlipAdvice flip_advice(ik::FlipCause cause, bool poled) {
    using enum ik::FlipCause;
    switch (cause) {
        case TargetJump:
            return {"Lead the target there over some frames, or blend into the new pose."};
        case ThroughRoot:
            return {"Lead the target around the root: there, every direction is equally near."};
        case PassedPole:
        case ClosePole:
            return {
                "Move the pole out of the plane in which the target moves: towards you, if you drag in "
                "the view.",
                FlipCure::MovePole};
        case Straight:
            if (poled) return {"Keep the target within reach, where the chain stays bent."};
            return {"Add a pole target on the side to which it should bend, or keep the target within reach.",
                    FlipCure::AddPole};
        case Folded:
            if (poled) return {"Keep the target within reach, where the chain stays bent."};
            return {"Add a pole target on the side to which it should bend.", FlipCure::AddPole};
        case PassedAxis:
            return {"Add a pole target off that axis, or bend towards another one there.", FlipCure::AddPole};
        case Rolled:
            return {"Check how the bone's up axis is chosen: positions do not define its roll."};
        case Unexplained:
            break;
    }
    if (poled) return {"Narrow the joint limits, or drag the target more slowly."};
    return {"Add a pole target, or limits: they leave it fewer poses.", FlipCure::AddPole};
}

}  // namespace tendril::app
