// Spreads twist along the bones of the arms, as flesh does. Without it, skin between two bones that are
// twisted against each other collapses (the candy-wrapper artefact of linear blending; L. Kavan, S. Collins,
// J. Zara, C. O'Sullivan, "Geometric skinning with approximate dual quaternion blending", ACM Transactions on
// Graphics 27(4), 2008).
//
//     for (const TwistBone& bone : twist_bones(skeleton, map)) ...  // the mapped upper and lower arms
//     const BoneTwist twist = bone_twist(bone, turn, end_turn);     // from the turns at both its ends
//     twist.at(0.5)                                                 // about bone.way, half way along it
//
// Method: swing-twist decomposition of each joint, and linear interpolation of the twist along the bone (A.
// Jacobson, O. Sorkine, "Stretchable and twistable bones for skeletal shape deformation", ACM Transactions on
// Graphics 30(6), 2011). The twists between upper and lower arm, and between lower arm and hand, are spread
// along the lower arm; the upper arm's twist in the shoulder is spread along the upper arm.
//
// If a character has nodes for this (Unreal's lowerarm_twist_01_l), TwistNodes turns them; Body and Hands
// call it. Otherwise the skinning has to spread the twist, as the program does.
#pragma once

#include <span>

#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid {

/// The twist about a unit axis, where turn = swing * twist; radians, -pi to pi. It takes the short way, so it
/// jumps between the ends of the range at half a turn. At a swing of 180 degrees the twist is undefined: it
/// fades out from 160 degrees on and is 0 from 175.
double twist_about(const glm::dvec3& axis, const glm::dquat& turn) noexcept;

/// A bone of an arm, with the joints at its two ends.
struct TwistBone {
    Bone bone = Bone::LeftLowerArm;
    std::size_t above = 0, node = 0, end = 0;  ///< nodes of the parent bone, this bone and the next
    glm::dvec3 way{0.0};  ///< from its joint to the next at rest, in its node's space; not zero

    /// Position along the bone of a point in the node's space: 0 at its joint, 1 at the next; clamped.
    double part(const glm::dvec3& point) const noexcept;
};
/// The mapped upper and lower arms between two mapped bones.
std::vector<TwistBone> twist_bones(const Skeleton& skeleton, const BoneMap& map);

/// The twist of the flesh about the bone, relative to the bone; radians.
struct BoneTwist {
    double near = 0.0, far = 0.0;  ///< twist at its joint, cancelling the bone's own, and at the next
    double at(double part) const noexcept { return near + (far - near) * part; }
};
/// `turn` is the bone's rotation relative to its parent bone, in the bone's own frame; `end_turn` is the next
/// bone's rotation relative to this one, in this bone's frame. Both are unit, the identity if untwisted.
BoneTwist bone_twist(const TwistBone& bone, const glm::dquat& turn, const glm::dquat& end_turn) noexcept;

/// The nodes along an arm's bones that take a share of its twist, found by name: twist and roll bones.
class TwistNodes {
  public:
    /// Rotations of a bone and of the next one, each local to its parent bone.
    struct Turns {
        glm::dquat bone{1.0, 0.0, 0.0, 0.0}, end{1.0, 0.0, 0.0, 0.0};
    };
    using ArmTurns = std::array<Turns, 4>;

    static TwistNodes find(const Skeleton& skeleton, const BoneMap& map);
    bool empty() const noexcept { return nodes_.empty(); }
    std::vector<std::size_t> along(Bone bone) const;

    /// `pose` holds the local transforms of all nodes.
    ArmTurns turns(std::span<const rig::Transform> pose) const noexcept;
    /// Turns the twist nodes in `pose` by their share of the twist that the bones have gained since `before`,
    /// according to their position along the bone. Without a change the pose stays bit-identical. Allocates
    /// nothing.
    void follow(const ArmTurns& before, std::span<rig::Transform> pose) const noexcept;

  private:
    struct Arm {
        TwistBone bone{};
        std::vector<std::size_t> to_bone{}, to_end{};  // paths, parents first: above to node, node to end
    };
    struct Helper {
        std::size_t arm, node;
        double part, part_above;  // positions along the bone: its own, and of the twist node above it
        bool hangs_on_twist;
        glm::dquat above;  // rest rotation of its parent, in the bone's frame
    };
    std::vector<Arm> arms_{};      // at most four
    std::vector<Helper> nodes_{};  // parents first
};

}  // namespace tendril::humanoid
