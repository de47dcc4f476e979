// A body in the reference pose for retargeting: the T-pose, with hands, fingers and feet straightened as
// well. Not installed.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "rig/math.hpp"
#include "tendril/humanoid/retarget.hpp"
#include "tendril/humanoid/soles.hpp"
#include "tendril/humanoid/t_pose.hpp"

namespace tendril::humanoid::detail {

/// Nodes of one finger, from its base.
using FingerNodes = std::array<std::int32_t, 3>;

/// Heel in the foot's axes; ball and toe tip in the toes' axes.
using SoleTriple = std::array<glm::dvec3, 3>;

/// A body in its reference pose.
struct RetargetBody {
    explicit RetargetBody(const MappedSkeleton& given);

    MappedSkeleton body;
    Facing at;
    glm::dquat frame{1.0, 0.0, 0.0, 0.0};  // takes x, y, z to left, up, forward
    glm::dvec3 hips{0.0};                  // at rest, on straight legs
    double leg = 0.0;                      // thigh plus shin, or the hips' height over the feet; 0: no legs
    bool has_legs = false;                 // thighs, shins and feet
    std::vector<Placement> placed{};       // all nodes, in the T-pose
    std::vector<glm::dquat> rotations{};   // the same nodes, straightened
    std::optional<Soles> soles{};          // if it has legs; their floor is below the hips at rest
    double ground = 0.0;  // height of the ground: the floor at rest, or 0 if the rest pose is far from it
    std::array<std::optional<glm::dvec3>, 2> tips{};  // below the tip of the toes, in the toes' space
    /// The nodes that turn the fingers, left and right: the hand, or the last node at the wrist (CMU's
    /// LeftFingerBase).
    std::array<std::size_t, 2> hands{};
    std::array<std::array<FingerNodes, 5>, 2> fingers{};  // by name: thumb to little, left and right

    std::size_t node(Bone bone) const noexcept { return static_cast<std::size_t>(body.map[bone].node); }
    bool has(Bone bone) const noexcept { return body.map[bone].node >= 0; }
    /// The sole of a foot whose ankle is `above` the ground.
    SoleTriple sole(bool left, double above) const;
    /// Turns the node so that `up`, a direction in its own space, points up.
    void level(std::size_t node, const glm::dvec3& up);
    /// Points the foot forward: in many rest poses the toes are turned out.
    void straighten_foot(bool left);
    /// The rotation about the hand's axis that brings the index finger in front of the little one; nullopt if
    /// either is unknown.
    std::optional<glm::dquat> palm_down(bool left) const;
    void turn(std::size_t node, const glm::dquat& by);

  private:
    /// Nodes closer together than this, metres, are in one place.
    double shortest() const noexcept { return 1e-4 * leg + 1e-9; }
    std::optional<glm::dvec3> hand_axis(bool left) const;
    void find_fingers(bool left);
    void straighten_hand(bool left);
    bool point_toes();
    void find_feet(bool toes_are_turned);
    void level_soles(const std::vector<Placement>& standing, bool shows_thickness);
    glm::dvec3 offset(std::size_t from, std::size_t to) const noexcept;
};

}  // namespace tendril::humanoid::detail
