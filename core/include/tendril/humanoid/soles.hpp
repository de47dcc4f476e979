// Where a character's feet touch the ground: a heel and a toe each, worked out from skeleton and bone map.
//
// No mesh is asked. In the rest pose both points lie on the floor: the toe below the joint of the toes, on
// which the foot rolls off, the heel behind the ankle by a third of the way from there to the toe. Where
// there is no joint for the toes, what hangs on the foot furthest forward tells where the foot ends, and
// where nothing does, the length of the leg: a foot's ball is 0.18 of it before the ankle. The floor is y = 0
// where the feet stand near that, and otherwise a little below the lowest joint of the feet (a BVH rests with
// its hips at the origin).
//
//     Expected<Soles> soles = find_soles(skeleton, map);
//     const double floor = clip_floor(skeleton, *soles, walk);
#pragma once

#include <array>

#include "tendril/humanoid/bone_map.hpp"
#include "tendril/humanoid/clip.hpp"

namespace tendril::humanoid {

struct Sole {
    std::size_t foot = 0, toes = 0;  ///< nodes; the foot twice where there are no toes
    glm::dvec3 heel{0.0};            ///< in the foot's own space
    glm::dvec3 toe{0.0};             ///< in that of the toes
    bool operator==(const Sole&) const = default;
};

struct Soles {
    std::array<Sole, 2> feet{};         ///< left, right
    double floor = 0.0;                 ///< height of the rest pose's floor, metres
    glm::dvec3 forward{0.0, 0.0, 1.0};  ///< level and of length 1: where the character faces at rest
    double leg = 0.0;                   ///< length of thigh and shin, metres; the mean of both legs
    bool operator==(const Soles&) const = default;
};

/// Hips and two legs are enough, arms and head may be missing. Refuses a map without them, one that is not
/// upright or does not belong to the skeleton, and legs without a length.
Expected<Soles> find_soles(const Skeleton& skeleton, const BoneMap& map);

/// The clip's own floor: how high its soles stand while they are nearly still (under 0.3 m/s), the median;
/// the lowest that a sole comes to where they never are. Of a clip that passed check(). Samples the clip at
/// 60 Hz, at most 10 000 times.
double clip_floor(const Skeleton& skeleton, const Soles& soles, const Clip& clip);

/// Where heel and toe are in a pose.
struct SolePoints {
    glm::dvec3 heel{0.0}, toe{0.0};
};
std::array<SolePoints, 2> sole_points(const Soles& soles, std::span<const Placement> placements) noexcept;

}  // namespace tendril::humanoid
