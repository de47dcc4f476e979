// A character's IK settings, and what IK and springs remember between ticks. All values.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <tendril/humanoid/body.hpp>
#include <tendril/humanoid/feet.hpp>
#include <tendril/humanoid/footsteps.hpp>
#include <tendril/humanoid/hands.hpp>
#include <tendril/humanoid/look_at.hpp>
#include <tendril/humanoid/spring_chain.hpp>
#include <vector>

#include "app/document/names.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/humanoid/hold/hold_setting.hpp"
#include "app/labs/humanoid/ik/ground.hpp"

namespace tendril::app {

enum class LimitsFrom : std::uint8_t { Defaults, Motion, None };
inline constexpr EnumNames<LimitsFrom, 3> limits_from{
    "source of limits",
    {{"defaults", "of an adult", "Each joint turns as far as an adult's does."},
     {"motion", "as in the clips", "Each joint turns as far as the character's clips turn it."},
     {"none", "none", "Joints turn as far as they are asked to."}}};

// The library's options, plus the lab's own. Files, commands and panels have the options that the tables
// list; the others keep their defaults, or follow from clip and character.

/// `options.floor` and `options.root_velocity` follow from the clip.
struct FootIkSetting {
    bool on = false;
    humanoid::FeetOptions options{};
    bool operator==(const FootIkSetting&) const = default;
};

/// A hand's weight over the clip's time: 0 until `begin`, 1 from `full` to `until`, 0 from `end`; seconds.
struct HandCurve {
    double begin = 0.3, full = 0.55, until = 0.62, end = 0.85;
    bool operator==(const HandCurve&) const = default;
};

/// Hand IK: the clip moves the hands, and each arm alone blends its hand to the target.
struct HandIkSetting {
    bool on = false;
    humanoid::HandsOptions options{};
    std::array<std::optional<HandCurve>, 2> curves{};  ///< left, right; none: weight 1 throughout
    bool operator==(const HandIkSetting&) const = default;
};

struct LookAtSetting {
    bool on = false;
    bool placed = false;  ///< a position was set or found
    humanoid::LookAtOptions options{.target = {0.0, 1.6, 2.0}};
    bool operator==(const LookAtSetting&) const = default;
};

/// Balance of a body that reaches: `body.balance` switches it on.
struct BalanceSetting {
    humanoid::BodyOptions body{};
    bool steps = true;  ///< a foot steps when shifting the hips is not enough; needs running time
    humanoid::FootstepOptions footsteps{};
    bool operator==(const BalanceSetting&) const = default;
};

struct IkSettings {
    std::array<std::optional<humanoid::BodyTarget>, humanoid::effector_count> targets{};
    LimitsFrom limits = LimitsFrom::Defaults;
    std::map<humanoid::Bone, LimitsFrom> joint_limits{};  ///< joints with a source of their own
    bool self_collision = false;                          ///< keeps hands and lower arms out of the body
    BalanceSetting balance;
    GroundSetting ground;
    FootIkSetting foot_ik;
    HandIkSetting hand_ik;
    LookAtSetting look_at;
    std::optional<HoldSetting> hold{};  ///< the hands that hold it have no targets
    bool operator==(const IkSettings&) const = default;

    std::optional<humanoid::BodyTarget>& target(humanoid::Effector effector) {
        return targets[static_cast<std::size_t>(effector)];
    }
    const std::optional<humanoid::BodyTarget>& target(humanoid::Effector effector) const {
        return targets[static_cast<std::size_t>(effector)];
    }
    bool has_targets() const;
    /// The source of that joint's limit.
    LimitsFrom limits_of(humanoid::Bone bone) const;
    /// Hand 0 is left, 1 right. Null if the hand has no target, or hand IK is off.
    const humanoid::BodyTarget* hand_target(std::size_t hand) const;
};

/// The difference that still fades out after a target was released; see release_between().
struct Release {
    double left = 0.0;  ///< seconds until it ends
    /// By node, relative to its local rotation.
    std::map<std::size_t, glm::dquat> turns{};
    glm::dvec3 shift{0.0};  ///< of the hips, in their parent's space, metres
    bool operator==(const Release&) const = default;
};

struct IkState {
    humanoid::BodyState body{};
    humanoid::FootstepsState steps{};
    humanoid::HandsState hands{};
    humanoid::LookAtState look{};
    humanoid::HoldState hold{};
    std::vector<humanoid::SpringChainState> springs{};  ///< in the order of the part's springs
    Release release{};
    bool operator==(const IkState&) const = default;
};

inline constexpr std::array<humanoid::Effector, humanoid::effector_count> all_effectors{
    humanoid::Effector::Hips,      humanoid::Effector::Head,     humanoid::Effector::LeftHand,
    humanoid::Effector::RightHand, humanoid::Effector::LeftFoot, humanoid::Effector::RightFoot};
inline const char* side_name(std::size_t hand) {
    return hand == 0 ? "left" : "right";
}
inline constexpr std::array<humanoid::Effector, 2> both_hands{humanoid::Effector::LeftHand,
                                                              humanoid::Effector::RightHand};
/// "left hand", as in panels.
std::string title(humanoid::Effector effector);

}  // namespace tendril::app

namespace tendril {

template <>
std::span<const Field> fields<app::GroundSetting>() noexcept;  ///< except for its mesh
template <>
std::span<const Field> fields<app::BalanceSetting>() noexcept;
template <>
std::span<const Field> fields<app::FootIkSetting>() noexcept;
template <>
std::span<const Field> fields<app::HandCurve>() noexcept;
template <>
std::span<const Field> fields<app::HandIkSetting>() noexcept;  ///< except for its curves
template <>
std::span<const Field> fields<app::LookAtSetting>() noexcept;
/// Except for targets, joints' own limits, ground and hand IK.
template <>
std::span<const Field> fields<app::IkSettings>() noexcept;
/// Except for springs and release.
template <>
std::span<const Field> fields<app::IkState>() noexcept;

namespace app {

template <>
std::span<const FieldText> field_texts<GroundSetting>();
template <>
std::span<const FieldText> field_texts<BalanceSetting>();
template <>
std::span<const FieldText> field_texts<FootIkSetting>();
template <>
std::span<const FieldText> field_texts<HandCurve>();
template <>
std::span<const FieldText> field_texts<HandIkSetting>();
template <>
std::span<const FieldText> field_texts<LookAtSetting>();

}  // namespace app
}  // namespace tendril
