// Reads a body part and a side from a node's name. Not installed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tendril/humanoid/skeleton.hpp"

namespace tendril::humanoid::detail {

enum class Part : std::uint8_t {
    None,
    Hips,
    Spine,  // any bone between hips and neck: its position decides which
    Neck,
    Head,
    // One on each side from here on, in the order of the limb.
    Shoulder,
    UpperArm,
    LowerArm,
    Hand,
    UpperLeg,
    LowerLeg,
    Foot,
    Toes,
    // Ambiguous words, resolved by the names around them.
    Arm,          // the upper arm; or the lower one, if the upper one has another name
    ShoulderArm,  // the collar bone; or the upper arm, if the collar bone has a name of its own
    Leg
};
enum class Side : std::uint8_t { None, Left, Right };

struct NameReading {
    Part part = Part::None;
    Side side = Side::None;
    bool is_plain = false;  ///< exactly "hips", not "pelvis" or "hip"
};

/// Ignores prefixes of programs and characters, case and separators. Part::None for nodes that are not bones
/// of the body: twist and roll bones, IK targets, end joints, fingers, faces, hair. Skips the word `ignored`.
NameReading read_name(std::string_view name, std::string_view ignored = {});
/// The first word of more than half of the names, a character's or an asset's; "" if there is none.
std::string common_word(const Skeleton& skeleton);

enum class Finger : std::uint8_t { Thumb, Index, Middle, Ring, Little };
/// "LeftHandIndex2", "thumb_01_l", "Bip01 L Finger21" (the middle finger's second bone). nullopt for palm
/// bones and end joints.
std::optional<Finger> finger_named(std::string_view name);
/// "upperarm01.L" and "upperarm02.L"
bool is_same_but_for_numbers(std::string_view a, std::string_view b);
/// "palm.01.L", "index_metacarpal_l"
bool is_palm_name(std::string_view name);

/// True if the node takes a share of a limb's twist: "lowerarm_twist_01_l", "LeftForeArmRoll".
bool is_twist_name(std::string_view name);

}  // namespace tendril::humanoid::detail
