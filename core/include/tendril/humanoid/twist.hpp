// Twist spread along the bones of the arms, as the flesh of an arm spreads it: skin that all turns with one
// bone, and next to it with another one that is twisted against it, shrinks to a thread between the two (the
// candy-wrapper artefact of linear blending; L. Kavan, S. Collins, J. Zara, C. O'Sullivan, "Geometric
// skinning with approximate dual quaternion blending", ACM Transactions on Graphics 27(4), 2008).
//
//     for (const TwistBone& bone : twist_bones(skeleton, map)) ...  // upper and lower arms that are mapped
//     const BoneTwist twist = bone_twist(bone, turn, end_turn);     // from how the joints at its ends turn
//     twist.at(0.5)                                                 // about bone.way, half way along it
//
// Method: swing and twist of each joint, and the twist in even shares from one end of a bone to the other (A.
// Jacobson, O. Sorkine, "Stretchable and twistable bones for skeletal shape deformation", ACM Transactions on
// Graphics 30(6), 2011). The twist between upper and lower arm, and that between lower arm and hand, is
// spread along the lower arm; that of the upper arm in the shoulder is spread along the upper arm.
//
// Where a character has nodes of its own for that (Unreal's lowerarm_twist_01_l), TwistNodes turns them, and
// Body and Hands call it. Where it has none, the skin has to do it: the program's skinning does.
#pragma once

#include <span>

#include "tendril/humanoid/bone_map.hpp"

namespace tendril::humanoid {

/// The part of a turn that is about a unit axis, radians, -pi to pi: the twist of turn = swing * twist. The
/// short way: where it passes half a turn it jumps from one end of the range to the other. A swing by half a
/// turn leaves no twist to be told; from 160 degrees on it is told as less and less, down to 0.
double twist_about(const glm::dvec3& axis, const glm::dquat& turn) noexcept;

/// A bone of an arm, the joint that it begins with and the one that it ends with.
struct TwistBone {
    Bone bone = Bone::LeftLowerArm;
    std::size_t above = 0, node = 0, end = 0;  ///< nodes: of the bone before it, its own, of the one after
    glm::dvec3 way{0.0};  ///< from its joint to the next at rest, in the space of its node; not zero

    /// How far along the bone a point in the space of its node is: 0 at its joint, 1 at the next. Not beyond.
    double part(const glm::dvec3& point) const noexcept;
};
/// The upper and lower arms that hang between mapped bones.
std::vector<TwistBone> twist_bones(const Skeleton& skeleton, const BoneMap& map);

/// By how much what lies along a bone is turned about it, against the bone; radians.
struct BoneTwist {
    double near = 0.0, far = 0.0;  ///< at its joint, where it undoes the bone's own twist; at the next
    double at(double part) const noexcept { return near + (far - near) * part; }
};
/// `turn` is the bone's against the bone before, seen from the bone itself; `end_turn` that of the bone
/// after, seen from the bone too. Both unit, and 1 where nothing is twisted.
BoneTwist bone_twist(const TwistBone& bone, const glm::dquat& turn, const glm::dquat& end_turn) noexcept;

/// The nodes beside an arm's bones that are there to take a share of its twist, by their names: twist and
/// roll bones. A value.
class TwistNodes {
  public:
    /// How the bones turn, local to the bones before.
    struct Turns {
        glm::dquat bone{1.0, 0.0, 0.0, 0.0}, end{1.0, 0.0, 0.0, 0.0};
    };
    using ArmTurns = std::array<Turns, 4>;

    static TwistNodes find(const Skeleton& skeleton, const BoneMap& map);
    bool empty() const noexcept { return nodes_.empty(); }
    /// Those of that bone.
    std::vector<std::size_t> along(Bone bone) const;

    /// `pose`: of all nodes, local to their parents.
    ArmTurns turns(std::span<const rig::Transform> pose) const noexcept;
    /// Turns them in `pose` by their share of what its bones are twisted by since they turned as in `before`:
    /// each by how far along its bone it is. Without a change it keeps its bits. Allocates nothing.
    void follow(const ArmTurns& before, std::span<rig::Transform> pose) const noexcept;

  private:
    struct Arm {
        TwistBone bone{};
        std::vector<std::size_t> to_bone{}, to_end{};  // nodes below the bone before, and below it, downwards
    };
    struct Helper {
        std::size_t arm, node;
        double part, part_above;  // along the bone; of the twist node that it hangs on
        bool hangs_on_twist;
        glm::dquat above;  // rotation at rest of what it hangs on, seen from the bone
    };
    std::vector<Arm> arms_{};      // four at most
    std::vector<Helper> nodes_{};  // each after the one that it hangs on
};

}  // namespace tendril::humanoid
