// Two bones in closed form: an arm or a leg, without a solver object. Method::TwoBone is this.
//
// Law of cosines in the plane of root, target and bend: the middle joint lies (D^2 + a^2 - b^2) / 2D along
// the line to the target and, off it, at the height of the triangle with the sides a, b and D. Worked out in
// double, so the numbers are right to the last bits of a float.
//
// Stretch, as game engines have it: the limb is left alone until the target is further away than
// start_stretch_ratio of its reach. From there on both bones grow by one factor, D / (start_stretch_ratio *
// reach), so that the elbow keeps its angle, up to max_stretch_scale; from there on the elbow opens. With a
// ratio of 1 the limb is straight before it stretches. Nothing jumps on the way.
//
// Cost: O(1), some twenty nanoseconds. Allocates nothing, throws nothing; same input, same bits.
#pragma once

#include <optional>

#include "tendril/ik/report.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// Where the limb is, metres. The lengths are those of the unstretched bones; 0 to max_magnitude.
struct TwoBone {
    glm::vec3 root{0.0f}, mid{0.0f}, tip{0.0f};
    float upper = 0.0f;  ///< root to mid
    float lower = 0.0f;  ///< mid to tip
};

struct TwoBoneOptions {
    /// Pole target: the middle joint points at this, metres. Without it, or where it is on the line from root
    /// to target, the limb keeps the side that it bends to, transported by the minimal rotation of its
    /// root-tip line. A limb that is straight has no side; then it is some fixed one at right angles to the
    /// line.
    std::optional<glm::vec3> pole = std::nullopt;
    /// The part of the reach from which on the bones lengthen, over 0 to 1, and up to how many times their
    /// length, 1 to 100. With 1 they never do.
    float start_stretch_ratio = 1.0f;
    float max_stretch_scale = 1.0f;
    /// The bend is turned by this about the line from root to target, right-handed, radians: away from the
    /// pole, or, where there is none, from where it is (so again with every solve).
    float twist = 0.0f;
};

struct TwoBoneResult {
    Status status = Status::Converged;  ///< or Stretched, TooClose, InvalidInput (the limb as it was given)
    glm::vec3 mid{0.0f}, tip{0.0f};
    float scale = 1.0f;     ///< how many times its length each bone has
    float residual = 0.0f;  ///< metres from the tip to the target
};

TwoBoneResult two_bone(const TwoBone& limb, glm::vec3 target, const TwoBoneOptions& options = {}) noexcept;

}  // namespace tendril::ik
