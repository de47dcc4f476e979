// Values: a character's IK settings, its ground, and the state of IK and springs between ticks.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/body.hpp>
#include <tendril/humanoid/feet.hpp>
#include <tendril/humanoid/footsteps.hpp>
#include <tendril/humanoid/ground.hpp>
#include <tendril/humanoid/hands.hpp>
#include <tendril/humanoid/look_at.hpp>
#include <tendril/humanoid/spring_chain.hpp>
#include <vector>

#include "app/document/outside_file.hpp"
#include "app/fields/fields.hpp"
#include "app/io/character/gltf_skin.hpp"
#include "app/io/names.hpp"
#include "app/labs/humanoid/hold/hold_setting.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

// The user's setting of the ground, and its drawing.

inline constexpr EnumNames<humanoid::GroundKind, 6> ground_kinds{
    "kind of ground",
    {{"none", "none", "No ground: feet follow the clip."},
     {"flat", "flat", "Level at 0."},
     {"slope", "slope", "Rises along +Z."},
     {"stairs", "stairs", "Rise along +Z, the first step at 0."},
     {"terrain", "hills", "Low hills, generated."},
     {"mesh", "mesh from a file", "The triangles of a .gltf or .glb file."}}};

inline constexpr double steepest_deg = 80.0, highest_step = 2.0, shortest_step = 0.05, longest_step = 10.0;

/// The triangles of a file. Immutable; copies share it.
struct GroundMesh : OutsideFile {
    TriangleMesh triangles;
    humanoid::Ground ground;
};
/// `file`: the user's name for it, if not its path. Throws std::runtime_error that begins with that name.
std::shared_ptr<const GroundMesh> read_ground_mesh(const std::string& path, const std::string& file = {});

/// Keeps the values of other kinds.
struct GroundSetting {
    humanoid::GroundKind kind = humanoid::GroundKind::None;
    double angle_deg = 20.0;                      ///< of the slope, -steepest_deg to steepest_deg
    double step_height = 0.15, step_depth = 0.3;  ///< of the stairs, metres
    std::shared_ptr<const GroundMesh> mesh{};     ///< never null if the kind is Mesh
    bool operator==(const GroundSetting&) const = default;
};

/// The hills: 20 m in each direction from the start of the character, where they are level.
humanoid::HeightField hills();

/// Throws std::invalid_argument with the library's message.
humanoid::Ground make_ground(const GroundSetting& setting);

// Drawing of the ground, except the level ground that every scene shows.

/// Draws the part around a point, whose height is ignored.
void draw_ground(const View& view, DrawList& list, const GroundSetting& ground, glm::vec3 around);

enum class LimitsFrom : std::uint8_t { Defaults, Motion, None };
inline constexpr EnumNames<LimitsFrom, 3> limits_from{
    "source of limits",
    {{"defaults", "of an adult", "Each joint turns as far as an adult's does."},
     {"motion", "as in the clips", "Each joint turns as far as the character's clips turn it."},
     {"none", "none", "Joints are not limited."}}};

// The library's options, plus the lab's own. Files, commands and panels have the options in the tables; the
// others keep their defaults, or follow from clip and character.

/// `options.floor` and `options.root_velocity` come from the clip.
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

/// Hand IK: the clip moves the hands, and each arm alone blends its hand towards the target.
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
    bool steps = true;  ///< a foot steps when shifting the hips is not enough; only while time passes
    humanoid::FootstepOptions footsteps{};
    bool operator==(const BalanceSetting&) const = default;
};

struct IkSettings {
    std::array<std::optional<humanoid::BodyTarget>, humanoid::effector_count> targets{};
    LimitsFrom limits = LimitsFrom::Defaults;
    std::map<humanoid::Bone, LimitsFrom> joint_limits{};  ///< joints whose limits have a source of their own
    bool self_collision = false;                          ///< keeps hands and lower arms out of the body
    BalanceSetting balance;
    GroundSetting ground;
    FootIkSetting foot_ik;
    HandIkSetting hand_ik;
    LookAtSetting look_at;
    std::optional<HoldSetting> hold{};  ///< the holding hands have no targets
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

/// The fading difference after a target was released; see release_between().
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
/// Excludes targets, joints' own limits, ground and hand IK.
template <>
std::span<const Field> fields<app::IkSettings>() noexcept;
/// Excludes springs and release.
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
