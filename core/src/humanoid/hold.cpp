#include "tendril/humanoid/hold.hpp"

#include <algorithm>

#include "humanoid/hold_solve.hpp"
#include "humanoid/input.hpp"
#include "rig/checks.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {

using namespace rig::detail;

namespace {

/// Maximum errors of a closed grip, metres and radians.
constexpr double closed_gap = 1e-5, closed_off = 5e-4;

Result check_hand(std::string_view operation, const Argument& argument, Effector hand) noexcept {
    if (hand == Effector::LeftHand || hand == Effector::RightHand) return {};
    return refused(operation, argument, "left_hand or right_hand",
                   static_cast<std::size_t>(hand) < effector_count ? name(hand) : "no effector");
}

/// The grip's position in the character's space.
glm::dvec3 place_of(const Grip& grip, const ObjectPose& object) noexcept {
    return plus(object.position, rotated(rig::normalised(object.rotation), grip.position));
}

Result check_held_object(const HeldObject& object) noexcept {
    if (object.grips.empty() || object.grips.size() > 2)
        return refused("hold", "object.grips", "one or two", static_cast<int>(object.grips.size()));
    for (std::size_t i = 0; i < object.grips.size(); ++i) {
        const Grip& grip = object.grips[i];
        const auto argument = [i](std::string_view member) { return Argument("object.grips", i, member); };
        if (const Result bad = check_hand("hold", argument("hand"), grip.hand); !bad) return bad;
        if (i > 0 && grip.hand == object.grips[0].hand)
            return refused("hold", argument("hand"), "not the hand of another grip", name(grip.hand));
        if (const Result bad = check_vector("hold", argument("position"), grip.position); !bad) return bad;
        if (const Result bad = check_vector("hold", argument("axis"), grip.axis); !bad) return bad;
        if (!grip.rotation) continue;
        if (const Result bad = detail::check_rotation("hold", argument("rotation"), *grip.rotation); !bad)
            return bad;
    }
    if (const Result bad = check_vector("hold", "object.asked.position", object.asked.position); !bad)
        return bad;
    if (const Result bad = detail::check_rotation("hold", "object.asked.rotation", object.asked.rotation);
        !bad)
        return bad;
    for (std::size_t i = 0; i < object.grips.size(); ++i) {
        const glm::dvec3 at = place_of(object.grips[i], object.asked);
        for (int axis = 0; axis < 3; ++axis)
            if (!check_number("hold", "object", at[axis]))
                return refused("hold", Argument("object.grips", i, "position"),
                               "within 1e9 m of the character's origin with the object at its requested pose",
                               at[axis]);
    }
    return {};
}

}  // namespace

bool HoldReport::closed() const noexcept {
    return std::all_of(grips.begin(), grips.end(), [](const GripReport& each) {
        return each.gap <= closed_gap && each.off <= closed_off;
    });
}

Expected<HoldReport> hold(Body& body, std::span<rig::Transform> pose, std::span<const BodyTarget> targets,
                          const HeldObject& object, BodyState& body_state, HoldState& state,
                          const HoldOptions& options) {
    if (const Result bad = check_held_object(object); !bad) return bad;
    if (const Result bad = check_fields("hold", options, "options"); !bad) return bad;
    if (const Result bad = check_fields("hold", state, "state"); !bad) return bad;
    std::array<BodyTarget, effector_count> all{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        for (const Grip& grip : object.grips)
            if (grip.hand == targets[i].effector)
                return refused("hold", Argument("targets", i, "effector"), "no hand that holds the object",
                               name(grip.hand));
        if (count + object.grips.size() >= effector_count)
            return refused("hold", "targets", "one for each effector at most",
                           static_cast<int>(targets.size()));
        all[count++] = targets[i];
    }
    for (const Grip& grip : object.grips)
        all[count++] = {.effector = grip.hand, .position = place_of(grip, object.asked)};
    Expected<BodyReport> reached =
        body.solve(pose, std::span<const BodyTarget>(all.data(), count), body_state, options.body);
    if (!reached) return reached.error();
    HoldReport report{.body = *reached};
    detail::HoldSolve(body, object, options).run(pose, report, state);
    return report;
}

Expected<Grip> grip_of(const Body& body, const Palm& palm, double reach) {
    if (const Result bad = check_hand("grip_of", "palm.hand", palm.hand); !bad) return bad;
    for (const auto& [argument, vector] : {std::pair("palm.middle", palm.middle),
                                           {"palm.fingers", palm.fingers},
                                           {"palm.faces", palm.faces},
                                           {"palm.axis", palm.axis}})
        if (const Result bad = check_vector("grip_of", argument, vector); !bad) return bad;
    if (const Result bad = check_number("grip_of", "reach", reach); !bad) return bad;
    const auto fingers = direction_of(palm.fingers, 1e-9);
    if (!fingers) return refused("grip_of", "palm.fingers", "a direction", length(palm.fingers));
    const auto facing = direction_of(palm.faces, 1e-9);
    if (!facing) return refused("grip_of", "palm.faces", "a direction", length(palm.faces));
    const auto faces = direction_of(across(*facing, *fingers), 1e-6);
    if (!faces) return refused("grip_of", "palm.faces", "a direction across the fingers", "one along them");
    const Bone bone = bone_of(palm.hand);
    const auto own_fingers = direction_of(body.joints().direction(bone), 1e-9);
    const auto own_faces =
        own_fingers ? direction_of(across(glm::dvec3(0.0, -1.0, 0.0), *own_fingers), 1e-9) : std::nullopt;
    if (!own_faces) return refused("grip_of", name(bone), "level in the T-pose", "one that is not");
    // Turns the fingers into place, then the palm about them.
    const glm::dquat first = minimal_rotation(*own_fingers, *fingers);
    const glm::dvec3 faced = rotated(first, *own_faces);
    const double angle = arctangent(dot(*fingers, cross(faced, *faces)), dot(faced, *faces));
    const glm::dquat turn = math::compose(rotation_about(*fingers, angle), first);
    return Grip{.hand = palm.hand,
                .position = minus(palm.middle, times(*fingers, reach)),
                .rotation = rig::normalised(math::compose(turn, body.joints().rest_rotation(bone))),
                .axis = palm.axis};
}

}  // namespace tendril::humanoid
