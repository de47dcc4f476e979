// Balance of a character: its centre of mass, the polygon that its feet stand on, and the distance between
// the two. It tells whether the character would fall.
//
//     Expected<Masses> masses = find_masses(skeleton, map);
//     Expected<Soles> soles = find_soles(skeleton, map);
//     const Support support = find_support(*soles, placements);
//     const double margin = support.margin(masses->centre(placements));  // metres; negative: it would fall
//
// Masses: 16 segments, with the mass fractions and centres of P. de Leva, "Adjustments to Zatsiorsky-
// Seluyanov's segment inertia parameters", Journal of Biomechanics 29(9), 1996, table 4, males. The trunk
// counts as three segments on the line from the middle of the hips to the neck, each moved by the bone at its
// height; the head's centre is above the neck by a fifth of that line.
//
// Support: each foot has six corners, two each at the heel, at the ball (both from Soles) and at the tip of
// the toes, which is 0.07 of the leg's length ahead of the ball. The ball is 0.11 of that length wide, heel
// and tip are 0.08 (R. Drillis and R. Contini, "Body segment parameters", 1966: a foot is 0.152 of the height
// long and 0.055 wide, thigh and shin together are 0.491). A sole pitched by more than 60 degrees narrows,
// down to a point when vertical, because then it has no direction seen from above.
//
// It judges a pose, not a motion: walkers and runners are out of balance for half of each step.
//
// Cost: half a microsecond for both.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tendril/humanoid/ground.hpp"
#include "tendril/humanoid/soles.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::humanoid {

/// A part of the body's mass.
struct MassPoint {
    std::size_t node = 0;  ///< the node that moves it
    glm::dvec3 at{0.0};    ///< position in the node's space
    double share = 0.0;    ///< fraction of the body's mass; they sum to 1
    bool operator==(const MassPoint&) const = default;
};

struct Masses {
    std::vector<MassPoint> points{};
    /// The centre of mass in the character's space. `placements` has one for every node.
    glm::dvec3 centre(std::span<const Placement> placements) const noexcept;
    bool operator==(const Masses&) const = default;
};

/// Needs the bones that Body needs. Refuses a map that is not usable, is not upright or fails check(), and
/// legs that find_soles() refuses.
Expected<Masses> find_masses(const Skeleton& skeleton, const BoneMap& map);

/// The convex hull of the soles that stand, seen from above.
struct Support {
    static constexpr std::size_t max_corners = 12;
    std::array<glm::dvec3, max_corners> corners{};  ///< in order round the hull; y is the sole's height
    std::size_t count = 0;                          ///< 0: nothing stands
    std::array<double, 2> standing{};               ///< left, right: 0 in the air, 1 standing
    glm::dvec3 middle{0.0};                         ///< mean of the soles' points, inside the hull

    /// Horizontal distance of a point from the hull's edge, metres: positive inside; -max_magnitude if no
    /// foot stands. Continuous in the point and in the soles.
    double margin(const glm::dvec3& point) const noexcept;
    /// The hull's point nearest to `point`, at `point`'s height; `point` itself if inside.
    glm::dvec3 nearest(const glm::dvec3& point) const noexcept;
    /// Shrinks the hull towards `middle`. `part`: 0 leaves it as it is, 1 leaves a point.
    Support shrunk(double part) const noexcept;
};

/// Heel and ball stand if at most 0.02 of the leg's length above the ground, and are in the air from 0.08 on.
/// In between, their part of the hull shrinks towards the points that still stand, so that nothing jumps.
/// Without a ground, the lowest point counts as on it.
Support find_support(const Soles& soles, const std::array<SolePoints, 2>& at,
                     const Ground* ground = nullptr) noexcept;
Support find_support(const Soles& soles, std::span<const Placement> placements,
                     const Ground* ground = nullptr) noexcept;

}  // namespace tendril::humanoid
