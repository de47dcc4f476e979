// The object that a character's hands hold: its kind, size and requested pose. A value.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <tendril/humanoid/hold.hpp>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/io/names.hpp"

namespace tendril::app {

enum class HeldKind : std::uint8_t { Wheel, Rifle, Box };
inline constexpr EnumNames<HeldKind, 3> held_kinds{
    "object",
    {{"wheel", "wheel", "A steering wheel: both hands on its rim, free to turn about it."},
     {"rifle", "rifle", "The right hand on its grip, the left under its barrel."},
     {"box", "box", "The palms on its sides."}}};

enum class HoldingHands : std::uint8_t { Both, Left, Right };
inline constexpr EnumNames<HoldingHands, 3> holding_hands{
    "hands", {{"both", "both"}, {"left", "left"}, {"right", "right"}}};

/// Before rotation, the object's X is the character's left, Y up, Z forward.
struct HoldSetting {
    HeldKind kind = HeldKind::Wheel;
    HoldingHands hands = HoldingHands::Both;
    double size = 1.0;      ///< 1: usual for the character's height
    bool with_body = true;  ///< moves with the hips as clip and ground place them
    /// Requested position of its middle, metres: from the hips and turned with them if it moves with the
    /// body, else in the character's space.
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    bool operator==(const HoldSetting&) const = default;

    /// The requested pose in the character's space. `hips`: before IK of the body, turned from rest.
    humanoid::ObjectPose asked(const humanoid::ObjectPose& hips) const;
    void ask(const humanoid::ObjectPose& there, const humanoid::ObjectPose& hips);
    bool holds(humanoid::Effector effector) const;
};

/// A bar of the object's shape, in its frame; metres.
struct HeldBar {
    glm::dvec3 from{0.0}, to{0.0};
    double radius = 0.0;
};
/// `height`: the character's, metres.
std::vector<HeldBar> held_shape(const HoldSetting& setting, double height);
/// Empty if the body's hands cannot lay their palms on an object: see humanoid::grip_of().
std::vector<humanoid::Grip> held_grips(const HoldSetting& setting, const humanoid::Body& body, double height);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::HoldSetting>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::HoldSetting>();
