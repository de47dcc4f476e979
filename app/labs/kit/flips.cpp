#include "app/labs/kit/flips.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <string>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

Json save_flip_rule(const FlipRule& rule) {
    return {{"degrees", number(rule.degrees)},
            {"angle_share", number(rule.angle_share)},
            {"reach_share", number(rule.reach_share)}};
}

FlipRule load_flip_rule(const JsonPlace& place) {
    return {.degrees = place["degrees"].number(min_flip_degrees, max_flip_degrees),
            .angle_share = place["angle_share"].number(0.0f, 1.0f),
            .reach_share = place["reach_share"].number(0.0f, 1.0f)};
}

std::vector<Argument> flip_arguments(const FlipWords& words) {
    const std::string turns = std::string("while ") + words.seen + " turns by less than this share of it";
    const std::string moves = std::string("or moves by less than this share of ") + words.whole;
    return {number_argument("degrees", "a bone turns by more than this", min_flip_degrees, max_flip_degrees),
            number_argument("angle_share", turns.c_str(), 0, 1),
            number_argument("reach_share", moves.c_str(), 0, 1)};
}

void set_flip_rule(FlipRule& rule, const Arguments& given) {
    if (given.has("degrees")) rule.degrees = given.number("degrees");
    if (given.has("angle_share")) rule.angle_share = given.number("angle_share");
    if (given.has("reach_share")) rule.reach_share = given.number("reach_share");
}

void flip_rows(const FlipRule& rule, const FlipWords& words, MoreRows& more, Emit& emit) {
    struct Row {
        std::string title;
        const char* name;
        float value, usual, speed, low, high;
        std::string format, help;
    };
    const std::string mover = words.mover;
    const FlipRule usual;
    const Row rows[] = {{"flip over", "degrees", rule.degrees, usual.degrees, 0.5f, min_flip_degrees,
                         max_flip_degrees, "%.0f\u00b0",
                         "A bone that turns by more than this in a tick, while the " + mover +
                             " hardly moves, is marked as a flip."},
                        {mover + " turns", "angle_share", rule.angle_share, usual.angle_share, 0.005f, 0.0f,
                         1.0f, "< %.2f of it",
                         "The " + mover + " hardly moves if " + words.seen +
                             " turns by less than this share of the bone's turn."},
                        {"or moves", "reach_share", rule.reach_share, usual.reach_share, 0.001f, 0.0f, 1.0f,
                         std::string("< %.3f of ") + words.size,
                         std::string("Or if it moves by less than this share of ") + words.whole + "."}};
    for (const Row& row : rows)
        more.add(row.title, {words.command, {row.name}}, row.value != row.usual, [row, &words, &emit] {
            float value = row.value;
            if (number_field(row.title.c_str(), value, row.speed, row.low, row.high, row.format.c_str()))
                emit.continuously(words.command, {{row.name, value}});
            explain(row.help.c_str());
        });
}

double turn_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat between = glm::conjugate(a) * b;
    return 2.0 * std::atan2(glm::length(glm::dvec3(between.x, between.y, between.z)), std::abs(between.w));
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
            return {"Look at how the bone's up axis is chosen: positions leave its roll open."};
        case Unexplained:
            break;
    }
    if (poled) return {"Narrow the joint limits, or drag the target more slowly."};
    return {"Add a pole target, or limits: they leave it fewer poses.", FlipCure::AddPole};
}

}  // namespace tendril::app
