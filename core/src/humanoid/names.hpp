// What the name of a node says about the part of the body that it is. Not installed.
#pragma once

#include <string>
#include <string_view>

namespace tendril::humanoid::detail {

enum class Part : std::uint8_t {
    None,
    Hips,
    Spine,  // any bone between hips and neck: which one is told by its place
    Neck,
    Head,
    // From here on there is one on each side, in the order in which they hang on each other.
    Shoulder,
    UpperArm,
    LowerArm,
    Hand,
    UpperLeg,
    LowerLeg,
    Foot,
    Toes,
    // Words that mean one or the other, as the names around them tell.
    Arm,          // upper, or lower where the upper one is called otherwise
    ShoulderArm,  // the collar bone, or the upper arm where that has a name of its own
    Leg
};
enum class Side : std::uint8_t { None, Left, Right };

struct NameReading {
    Part part = Part::None;
    Side side = Side::None;
    bool is_plain = false;  ///< the bone's own word, as in bone_map.hpp: "hips", not "pelvis"
};

/// Prefixes of programs and of characters do not count, nor do capitals and separators. None for what only
/// goes along: twist and roll bones, IK targets, end joints, fingers, faces, hair.
NameReading read_name(std::string_view name);

/// Of a node that is there to take a share of a limb's twist: "lowerarm_twist_01_l", "LeftForeArmRoll".
bool is_twist_name(std::string_view name);

}  // namespace tendril::humanoid::detail
