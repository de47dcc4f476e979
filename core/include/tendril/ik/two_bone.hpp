// Two bones in closed form: an arm or a leg, without a solver object. Method::TwoBone uses this.
//
// Law of cosines in the plane of root, target and bend: the middle joint lies (D^2 + a^2 - b^2) / 2D along
// the line to the target, and off the line at the height of the triangle with sides a, b and D. Computed in
// double, so the results are accurate to the last bits of a float.
//
// Stretch, as in game engines: nothing happens until the target is further away than start_stretch_ratio of
// the reach. From there on both bones grow by one factor, D / (start_stretch_ratio * reach), so that the
// elbow keeps its angle, up to max_stretch_scale; beyond that the elbow opens. With a ratio of 1 the limb is
// straight before it stretches. The motion is continuous throughout.
//
// Cost: O(1), about twenty nanoseconds. Does not allocate or throw; same input, same bits.
#pragma once

#include <optional>
#include <span>

#include "tendril/fields.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// The limb's current pose, metres. The lengths are unstretched, 0 to max_magnitude.
struct TwoBone {
    glm::vec3 root{0.0f}, mid{0.0f}, tip{0.0f};
    float upper = 0.0f;  ///< root to mid
    float lower = 0.0f;  ///< mid to tip
};

struct TwoBoneOptions {
    /// Pole target, metres: the point that the middle joint faces. Without it, or if it is on the line from
    /// root to target, the limb keeps its side, transported by the minimal rotation of its root-tip line. A
    /// straight limb has no side; then a fixed one perpendicular to the line is used.
    std::optional<glm::vec3> pole = std::nullopt;
    /// The fraction of the reach from which the bones lengthen, over 0 to 1, and their maximum scale, 1 to
    /// 100. With a maximum of 1 they never lengthen.
    float start_stretch_ratio = 1.0f;
    float max_stretch_scale = 1.0f;
    /// Rotates the bend about the line from root to target, right-handed, radians, starting at the pole;
    /// without a pole at the current side, so every solve rotates it further.
    float twist = 0.0f;
};

struct TwoBoneResult {
    Status status = Status::Converged;  ///< or Stretched, TooClose, InvalidInput (limb unchanged)
    glm::vec3 mid{0.0f}, tip{0.0f};
    float scale = 1.0f;     ///< scale of both bones
    float residual = 0.0f;  ///< metres from the tip to the target; infinite if the input was refused
    Result accepted{};      ///< why the status is InvalidInput
};

TwoBoneResult two_bone(const TwoBone& limb, glm::vec3 target, const TwoBoneOptions& options = {}) noexcept;

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBone>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBoneOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBoneResult>() noexcept;
