#include "app/labs/humanoid/hold/hold_setting.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <tendril/magnitude.hpp>

#include "tendril/elementary.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::HoldSetting>() noexcept {
    using namespace app;
    static constexpr auto kinds = held_kinds.name_array();
    static constexpr auto hands = holding_hands.name_array();
    constexpr FieldRange anywhere{-max_magnitude, max_magnitude};
    static constexpr Field rows[] = {field<&HoldSetting::kind>("kind", kinds),
                                     field<&HoldSetting::size>("size", {0.1, 10.0}),
                                     field<&HoldSetting::hands>("hands", hands),
                                     field<&HoldSetting::with_body>("with_body"),
                                     field<&HoldSetting::position>("position", anywhere, "m"),
                                     field<&HoldSetting::rotation>("rotation", unit_length)};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<HoldSetting>() {
    static constexpr FieldText texts[] = {
        {.name = "kind",
         .label = "object",
         .help = "The object that the hands hold.",
         .listed = true,
         .choices = held_kinds.rows},
        {.name = "size",
         .label = "size",
         .help =
             "1: usual for the character's height. If it is longer than both arms, the hands stay short of "
             "their grips."},
        {.name = "hands",
         .label = "hands",
         .help = "Which hands hold it.",
         .listed = true,
         .choices = holding_hands.rows},
        {.name = "with_body",
         .label = "Goes with the body",
         .help = "The object moves with the hips. Off: it stays in place."}};
    return texts;
}

humanoid::ObjectPose HoldSetting::asked(const humanoid::ObjectPose& hips) const {
    if (!with_body) return {position, rotation};
    return {hips.position + hips.rotation * position, rig::normalised(hips.rotation * rotation)};
}

void HoldSetting::ask(const humanoid::ObjectPose& there, const humanoid::ObjectPose& hips) {
    const glm::dquat back = with_body ? glm::conjugate(hips.rotation) : glm::dquat(1.0, 0.0, 0.0, 0.0);
    position = with_body ? back * (there.position - hips.position) : there.position;
    rotation = with_body ? rig::normalised(back * there.rotation) : there.rotation;
}

bool HoldSetting::holds(humanoid::Effector effector) const {
    return (effector == humanoid::Effector::LeftHand && hands != HoldingHands::Right) ||
           (effector == humanoid::Effector::RightHand && hands != HoldingHands::Left);
}

namespace {

// For a character of 1 m, at size 1; metres.
constexpr double wheel_radius = 0.11, rifle_length = 0.5, box_width = 0.2, box_depth = 0.15, bar = 0.008;
constexpr double palm_reach = 0.045;                    // from the wrist to the middle of the palm
constexpr double rifle_rear = -0.3, rifle_fore = 0.16;  // fractions of its length, from its middle

std::vector<HeldBar> wheel_shape(double size) {
    constexpr int parts = 24;
    std::vector<HeldBar> bars;
    const double radius = wheel_radius * size;
    const auto at = [&](double part) {
        const double angle = glm::two_pi<double>() * part / parts;
        return radius * glm::dvec3(math::cosine(angle), math::sine(angle), 0.0);
    };
    for (int i = 0; i < parts; ++i) bars.push_back({at(i), at(i + 1), bar * size});
    for (const int spoke : {0, 12, 18}) bars.push_back({glm::dvec3(0.0), at(spoke), 0.6 * bar * size});
    return bars;
}

std::vector<HeldBar> rifle_shape(double size) {
    const auto along = [&](double part, double down = 0.0) {
        return size * glm::dvec3(0.0, -down, part * rifle_length);
    };
    return {{along(-0.5, 0.035), along(-0.22, 0.005), 1.6 * bar * size},
            {along(-0.22), along(0.2), 1.5 * bar * size},
            {along(0.2), along(0.5), 0.7 * bar * size},
            {along(rifle_rear + 0.1), along(rifle_rear + 0.04, 0.05), 1.2 * bar * size}};
}

std::vector<HeldBar> box_shape(double size) {
    std::vector<HeldBar> bars;
    const glm::dvec3 half = 0.5 * size * glm::dvec3(box_width, box_depth, box_depth);
    for (int axis = 0; axis < 3; ++axis)
        for (const double a : {-1.0, 1.0})
            for (const double b : {-1.0, 1.0}) {
                glm::dvec3 from(0.0);
                from[axis] = -half[axis];
                from[(axis + 1) % 3] = a * half[(axis + 1) % 3];
                from[(axis + 2) % 3] = b * half[(axis + 2) % 3];
                glm::dvec3 to = from;
                to[axis] = half[axis];
                bars.push_back({from, to, 0.7 * bar * size});
            }
    return bars;
}

/// `side`: 1 left hand, -1 right. `size`: the object's size times the character's height, metres.
humanoid::Palm palm_on(HeldKind kind, double side, double size) {
    const humanoid::Effector hand = side > 0.0 ? humanoid::Effector::LeftHand : humanoid::Effector::RightHand;
    switch (kind) {
        case HeldKind::Wheel:
            return {hand, {side * wheel_radius * size, 0, 0}, {0, 0, 1}, {-side, 0, 0}, {0, 1, 0}};
        case HeldKind::Box:
            return {hand, {0.5 * side * box_width * size, 0, 0}, {0, 0, 1}, {-side, 0, 0}, {1, 0, 0}};
        case HeldKind::Rifle:
            break;
    }
    if (side > 0.0)
        return {hand, {0, -0.02 * size, rifle_fore * rifle_length * size}, {-1, 0, 1}, {0, 1, 0}, {0, 0, 1}};
    // The palm is on the grip's side, and the wrist is behind and below it, clear of the stock: by 28 mm for
    // a forearm of 38 mm at 1.8 m. With fingers straight ahead the stock was 37 mm inside it.
    return {hand,
            {-0.018 * size, -0.03 * size, (rifle_rear + 0.07) * rifle_length * size},
            {0.3, 0.5, 0.8},
            {1, 0, 0},
            {0, 1, 0.2}};
}

}  // namespace

std::vector<HeldBar> held_shape(const HoldSetting& setting, double height) {
    const double size = height * setting.size;
    return setting.kind == HeldKind::Wheel   ? wheel_shape(size)
           : setting.kind == HeldKind::Rifle ? rifle_shape(size)
                                             : box_shape(size);
}

std::vector<humanoid::Grip> held_grips(const HoldSetting& setting, const humanoid::Body& body,
                                       double height) {
    std::vector<humanoid::Grip> grips;
    for (const double side : {1.0, -1.0}) {
        const humanoid::Palm palm = palm_on(setting.kind, side, height * setting.size);
        if (!setting.holds(palm.hand)) continue;
        const auto grip = humanoid::grip_of(body, palm, palm_reach * height);
        if (!grip) return {};
        grips.push_back(*grip);
    }
    return grips;
}

}  // namespace tendril::app
