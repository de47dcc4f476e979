// The volume of a body, bone by bone: what its hands must not pass through, and what ropes and cloth hang on.
//
//     const std::vector<BodyCapsule> capsules = default_capsules(skeleton, map);
//     Expected<Body> body = Body::make(skeleton, map, limits, capsules);  // keeps them apart
//     const PlacedCapsule there = place(capsules[0], map, placements);    // for a collider, or a picture
//
// Sizes of the defaults are those of an adult of ordinary build, scaled by the lengths of the legs and the
// spine. Where the character has a skin, the capsules are fitted to it instead:
//
//     std::vector<SkinPoint> points;  // corners of the mesh at rest, each with the node that it follows most
//     const std::vector<BodyCapsule> capsules = fitted_capsules(skeleton, map, points);
#pragma once

#include <span>

#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid {

/// All points within `radius` of the line from `from` to `to`.
struct BodyCapsule {
    Bone bone = Bone::Hips;
    glm::dvec3 from{0.0}, to{0.0};  ///< in the space of the bone's node
    double radius = 0.05;           ///< metres, in the character's space
    bool operator==(const BodyCapsule&) const = default;
};

/// Trunk, head, arms with hands, and legs, of the bones that are mapped.
std::vector<BodyCapsule> default_capsules(const Skeleton& skeleton, const BoneMap& map);

/// A corner of a character's mesh.
struct SkinPoint {
    glm::dvec3 position{0.0};  ///< metres, in the character's space, at rest
    std::size_t node = 0;      ///< that it follows most
};
/// The default capsules with lines and radii that fit the points of their bones. What hangs below a bone and
/// is none of the body, fingers say, counts as the bone's. Between two joints the line runs along the bone,
/// through the middle of the points across it; those of head and hands reach as far as the points do. The
/// radius is the one that four fifths of the points are within: a quantile, so that what stands off, a cloak
/// or a thumb, does not count as long as it is less than a fifth. A capsule with under 16 points, or that
/// comes out under 0.4 or over 3 times as thick as the default, stays the default. A point that is not
/// finite, or of a node that is not there, is left out. O(points).
std::vector<BodyCapsule> fitted_capsules(const Skeleton& skeleton, const BoneMap& map,
                                         std::span<const SkinPoint> points);

/// In the character's space.
struct PlacedCapsule {
    glm::dvec3 from{0.0}, to{0.0};
    double radius = 0.0;
};
/// The bone is mapped; `placements` of all nodes.
PlacedCapsule place(const BodyCapsule& capsule, const BoneMap& map,
                    std::span<const Placement> placements) noexcept;

/// Where two lines with ends come nearest.
struct Nearest {
    glm::dvec3 first{0.0}, second{0.0};
};
/// C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.9; lines may have no length.
Nearest nearest(const PlacedCapsule& first, const PlacedCapsule& second) noexcept;
/// From surface to surface, metres; negative: how deep they are in each other.
double gap(const PlacedCapsule& first, const PlacedCapsule& second) noexcept;

}  // namespace tendril::humanoid
