// Maps the nodes of a skeleton to the bones of a human body.
//
// Two independent readers examine a skeleton. One knows common names: Mixamo, Unreal's mannequin, VRM, Unity,
// Rigify, 3ds Max's Biped, Acclaim, Motive and other captures. The other ignores names: it looks for a node
// from which two equal limbs go down and a column goes up, for two equal limbs at the top of the column, and
// for a head above them. If both agree, the match is nearly certain; if they differ, or only one finds the
// bone, the confidence is lower. If the left and right limbs have equally many nodes, their bones are at the
// same nodes. Reasons are given in words.
//
//     const BoneMap map = match_bones(skeleton);
//     if (!map.is_usable()) ...  // map.missing lists the missing bones, or the map is not upright
//     map[Bone::LeftHand].node, .confidence, .reasons
//
// A figure that is not upright in its rest pose, such as a quadruped, keeps the bones that were found but is
// not usable: solvers refuse it until the user confirms that it is a body.
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
/// True for the fifteen bones without which a body cannot be solved.
bool is_needed(Bone bone) noexcept;
/// Swaps left and right: LeftHand becomes RightHand. A bone without a side is returned unchanged.
Bone mirrored(Bone bone) noexcept;

struct BoneMatch {
    std::int32_t node = -1;   ///< -1: none
    double confidence = 0.0;  ///< 0 to 1: ranks the evidence; not a probability
    std::string reasons{};    ///< "named mixamorig:LeftArm"
    bool operator==(const BoneMatch&) const = default;
};

/// Position of the arms at rest. T: within 22.5 degrees of level. A: 22.5 to 67.5 degrees below level.
enum class RestPose : std::uint8_t { T, A, Other };
const char* name(RestPose pose) noexcept;

struct BoneMap {
    std::array<BoneMatch, bone_count> bones{};
    std::vector<Bone> missing{};  ///< needed bones without a node at the last review(), in enum order
    bool upright = true;          ///< the rise from hips to head exceeds the horizontal distance
    RestPose rest = RestPose::Other;

    /// True if a body can be solved with it: upright, with a node for each needed bone, reviewed or not.
    bool is_usable() const noexcept;
    BoneMatch& operator[](Bone bone) noexcept { return bones[static_cast<std::size_t>(bone)]; }
    const BoneMatch& operator[](Bone bone) const noexcept { return bones[static_cast<std::size_t>(bone)]; }
    bool operator==(const BoneMap&) const = default;
};

/// Finds the bones of a skeleton; Y is up.
BoneMap match_bones(const Skeleton& skeleton);
/// Updates `missing`, `upright` and `rest` after `bones` has been edited.
void review(BoneMap& map, const Skeleton& skeleton);

/// Checks that the map fits the skeleton. Refuses a node that is not in the skeleton, a node that is two
/// bones, and a bone whose node is above the node of one of its parent bones: "bone map: LeftHand must be a
/// node of the skeleton, got 77". Functions that take a map refuse whatever this refuses; those that cannot
/// fail treat such a map as empty.
Result check(const BoneMap& map, const Skeleton& skeleton) noexcept;

}  // namespace tendril::humanoid
