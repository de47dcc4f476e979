// The points where a character's feet touch the ground: a heel and a toe each, from skeleton and bone map.
//
// No mesh is needed. In the rest pose both points lie on the floor: the toe below the joint of the toes, over
// which the foot rolls, and the heel behind the ankle by a third of the distance from ankle to toe. Without a
// toe joint, the node below the foot that is farthest from it horizontally marks the foot's end; without such
// a node, the ball is 0.18 of the leg's length in front of the ankle. The floor is y = 0 if the feet rest
// near that height, otherwise a little below the lowest joint of the feet (a BVH rests with its hips at the
// origin).
//
// Many captured figures do not stand in their rest pose: their feet point straight ahead or down at rest,
// with the toes as high as the ankle. Their clips show where the soles are.
//
//     Expected<Soles> soles = find_soles(skeleton, map);
//     const Soles walking = clip_soles(skeleton, map, *soles, walk);
//     const double floor = clip_floor(skeleton, walking, walk);
#pragma once

#include <array>

#include "tendril/humanoid/bone_map.hpp"
#include "tendril/humanoid/clip.hpp"

namespace tendril::humanoid {

struct Sole {
    std::size_t foot = 0, toes = 0;  ///< nodes; both the foot if there are no toes
    glm::dvec3 heel{0.0};            ///< in the foot's space
    glm::dvec3 toe{0.0};             ///< in the toes' space
    bool operator==(const Sole&) const = default;
};

struct Soles {
    std::array<Sole, 2> feet{};         ///< left, right
    double floor = 0.0;                 ///< height of the rest pose's floor, metres
    glm::dvec3 forward{0.0, 0.0, 1.0};  ///< direction the character faces at rest; horizontal, unit length
    double leg = 0.0;                   ///< length of thigh plus shin, metres; the mean of both legs
    bool operator==(const Soles&) const = default;
};

/// Needs only hips and two legs. Refuses a map without them, one that is not upright or fails check(), and
/// legs without length or without a distance between them.
Expected<Soles> find_soles(const Skeleton& skeleton, const BoneMap& map);

/// The soles of a clip whose feet do not stand as in the rest pose, learned from the frames in which they
/// stand still, as the lint does (lint.hpp). Returns `soles` if they do, or never stand still. `soles` must
/// be from find_soles(), and the clip must have passed check(). At most its first 10 000 frames are sampled.
Soles clip_soles(const Skeleton& skeleton, const BoneMap& map, const Soles& soles, const Clip& clip);

/// The clip's own floor: the median height of its soles while they are nearly still (toe under 0.3 m/s) and
/// within 0.1 m of the lowest sole; if they never are, the lowest. The clip must have passed check(). It is
/// sampled at 60 Hz, at most 10 000 times.
double clip_floor(const Skeleton& skeleton, const Soles& soles, const Clip& clip);

/// Positions in a pose, in the character's space.
struct SolePoints {
    glm::dvec3 heel{0.0}, toe{0.0};
};
std::array<SolePoints, 2> sole_points(const Soles& soles, std::span<const Placement> placements) noexcept;

}  // namespace tendril::humanoid
