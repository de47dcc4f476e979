// Which node of a skeleton is which bone of a human body.
//
// Two readers look at a skeleton apart from each other. One knows the names that people give: Mixamo's,
// Unreal's mannequin, VRM's, Unity's, Rigify's, 3ds Max's Biped, those of CMU's and of other captures. The
// other knows no names: it looks for a node from which two equal limbs go down and a column goes up, for two
// equal limbs at the top of that and a head above them. Where both say the same, the match is nearly certain;
// where only one finds a bone, or they differ, the confidence says so, and the reasons say why in words.
//
//     const BoneMap map = match_bones(skeleton);
//     if (!map.is_usable()) ...                 // map.missing lists the bones that are wanted, or it is not
//     upright map[Bone::LeftHand].node, .confidence, .reasons
//
// What does not stand upright in its rest pose, a quadruped say, keeps the bones that were found, but is not
// usable: nothing is solved for it before a person has said that it is a body after all.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/humanoid/skeleton.hpp"

namespace tendril::humanoid {

enum class Bone : std::uint8_t {
    Hips,
    Spine,
    Chest,
    UpperChest,
    Neck,
    Head,
    LeftShoulder,
    LeftUpperArm,
    LeftLowerArm,
    LeftHand,
    RightShoulder,
    RightUpperArm,
    RightLowerArm,
    RightHand,
    LeftUpperLeg,
    LeftLowerLeg,
    LeftFoot,
    LeftToes,
    RightUpperLeg,
    RightLowerLeg,
    RightFoot,
    RightToes
};
inline constexpr std::size_t bone_count = 22;
/// "LeftUpperArm"
const char* name(Bone bone) noexcept;
std::optional<Bone> bone_named(std::string_view name) noexcept;
/// Whether a body cannot be solved without it: fifteen are.
bool is_needed(Bone bone) noexcept;
/// LeftHand for RightHand and the other way round; what has no side is itself.
Bone mirrored(Bone bone) noexcept;

struct BoneMatch {
    std::int32_t node = -1;   ///< -1: none
    double confidence = 0.0;  ///< 0 to 1
    std::string reasons{};    ///< "named mixamorig:LeftArm; second of the four of the left arm"
    bool operator==(const BoneMatch&) const = default;
};

/// How the arms are held at rest: level, down by a quarter to three quarters of a right angle, or otherwise.
enum class RestPose : std::uint8_t { T, A, Other };
const char* name(RestPose pose) noexcept;

struct BoneMap {
    std::array<BoneMatch, bone_count> bones{};
    std::vector<Bone> missing{};  ///< of the fifteen, in their order
    bool upright = true;          ///< from the hips to the head it goes up more than aside
    RestPose rest = RestPose::Other;

    /// A body can be solved with it.
    bool is_usable() const noexcept { return missing.empty() && upright; }
    BoneMatch& operator[](Bone bone) noexcept { return bones[static_cast<std::size_t>(bone)]; }
    const BoneMatch& operator[](Bone bone) const noexcept { return bones[static_cast<std::size_t>(bone)]; }
    bool operator==(const BoneMap&) const = default;
};

/// Y is up.
BoneMap match_bones(const Skeleton& skeleton);
/// After a person has changed `bones`: what is missing, and how it rests.
void review(BoneMap& map, const Skeleton& skeleton);

/// Whether the map is of that skeleton. Refuses a bone whose node the skeleton does not have, a node that is
/// two bones, and a bone above one that it hangs on in a body: "bone map: LeftHand must be a node of the
/// skeleton, got 77". What needs a map refuses what this refuses; what cannot refuse takes such a map for one
/// without bones.
Result check(const BoneMap& map, const Skeleton& skeleton) noexcept;

}  // namespace tendril::humanoid
