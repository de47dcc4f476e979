// The volume of a body, one capsule per bone: obstacles for its hands, and colliders for ropes and cloth.
//
//     const std::vector<BodyCapsule> capsules = default_capsules(skeleton, map);
//     Expected<Body> body = Body::make(skeleton, map, limits, capsules);  // keeps them apart
//     const PlacedCapsule there = place(capsules[0], map, placements);    // as a collider, or to draw it
//
// The default sizes fit an adult of average build, scaled by the lengths of legs and spine. If the character
// has a skin, the capsules can be fitted to it:
//
//     std::vector<SkinPoint> points;  // vertices of the mesh at rest, each with its most influential node
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

/// One for each mapped bone of trunk, head, arms, hands and legs.
std::vector<BodyCapsule> default_capsules(const Skeleton& skeleton, const BoneMap& map);

/// A vertex of a character's mesh.
struct SkinPoint {
    glm::dvec3 position{0.0};  ///< metres, in the character's space, at rest
    std::size_t node = 0;      ///< the node with the largest weight
};
/// The default capsules, with axes and radii fitted to the points of their bones. Points of unmapped nodes
/// below a bone, such as fingers, count as the bone's. Between two joints the axis runs along the bone,
/// through the middle of the points' cross-section; the axes of head and hands extend as far as the points.
/// The radius contains four fifths of the points: a quantile ignores a cloak or a thumb that has less than a
/// fifth of them. A capsule with fewer than 16 points, or a fitted radius under 0.4 or over 3 times the
/// default, stays the default. Ignores points that are not finite or name an invalid node. O(points).
std::vector<BodyCapsule> fitted_capsules(const Skeleton& skeleton, const BoneMap& map,
                                         std::span<const SkinPoint> points);

/// A capsule in the character's space.
struct PlacedCapsule {
    glm::dvec3 from{0.0}, to{0.0};
    double radius = 0.0;
};
/// The capsule's bone must be mapped. `placements` has one for every node.
PlacedCapsule place(const BodyCapsule& capsule, const BoneMap& map,
                    std::span<const Placement> placements) noexcept;

/// The nearest points of two line segments.
struct Nearest {
    glm::dvec3 first{0.0}, second{0.0};
};
/// C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.9; segments may have no length.
Nearest nearest(const PlacedCapsule& first, const PlacedCapsule& second) noexcept;
/// From surface to surface, metres; negative: the depth of the overlap.
double gap(const PlacedCapsule& first, const PlacedCapsule& second) noexcept;

}  // namespace tendril::humanoid
