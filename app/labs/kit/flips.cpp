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

namespace {

constexpr float near_root = 0.02f, straight = 0.02f;  ///< of the reach

/// The maximum distance of a joint from the line through root and tip, in metres.
float bend(const std::vector<glm::vec3>& joints) {
    const glm::vec3 root = joints.front(), line = joints.back() - root;
    const float length = glm::length(line);
    float furthest = 0.0f;
    for (const glm::vec3 joint : joints) {
        const glm::vec3 from_root = joint - root;
        const float off =
            length > 0.0f ? glm::length(glm::cross(from_root, line)) / length : glm::length(from_root);
        furthest = std::max(furthest, off);
    }
    return furthest;
}

}  // namespace

float angle_between(glm::vec3 a, glm::vec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
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

bool went_through_root(const ReachPose& before, const ReachPose& after, float reach) {
    return distance_to(after.root(), before.target, after.target) < near_root * reach;
}

PolePassage pole_passage(const ReachPose& before, const ReachPose& after) {
    if (!before.pole || !after.pole) return {};
    constexpr float close = 0.17f;  // radians, ten degrees
    const glm::vec3 root = after.root();
    const glm::vec3 was = glm::cross(before.target - root, *before.pole - root);
    const glm::vec3 is = glm::cross(after.target - root, *after.pole - root);
    const auto off = [&](const ReachPose& pose) {
        const float angle = angle_between(pose.target - root, *pose.pole - root);
        return std::min(angle, glm::pi<float>() - angle);
    };
    return {glm::dot(was, is) < 0.0f, std::min(off(before), off(after)) < close};
}

bool was_straight(const ReachPose& before, const ReachPose& after, float reach) {
    return std::min(bend(before.joints), bend(after.joints)) < straight * reach;
}

const FlipReason& collinear_reason(const ReachPose& before, const ReachPose& after, float reach) {
    const ReachPose& flat = bend(before.joints) <= bend(after.joints) ? before : after;
    return glm::distance(flat.root(), flat.joints.back()) < 0.5f * reach ? folded_chain : straight_chain;
}

}  // namespace tendril::app
