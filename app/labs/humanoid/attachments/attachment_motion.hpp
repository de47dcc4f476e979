// Moves a character's attachments with it, and turns them into nodes for an export.
#pragma once

#include <tendril/rope/workspace.hpp>

#include "app/document/command.hpp"
#include "app/io/character/gltf_write.hpp"
#include "app/labs/humanoid/attachments/attachments.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"

namespace tendril::app {

/// Advances the attachments by `seconds` > 0. Pins and colliders move evenly to the wearer's current pose
/// while the world is simulated. A wearer that moved implausibly far is treated as a jump; see carry().
void advance(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace, double seconds);

/// For a wearer that has jumped: moves each attachment rigidly with its node, keeping its motion, and pushes
/// it out of the body. No time passes. Does nothing if no node moved.
void carry(Attachments& attachments, const Wearer& wearer, rope::Workspace& workspace);

/// True if everything moves negligibly slowly, and no gusts blow.
bool at_rest(const Attachments& attachments);

// Attachments of the lab's character, for commands and ticks.

/// Valid while `shown` exists and the part does not change.
Wearer wearer_of(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown);

/// Wraps a command so that springs and attachments move along with its change to the pose. Drags while the
/// simulation runs are left to the next tick, which swings them.
Command carrying(Command command);

/// Call after the character was scaled by `scale`.
void remake_attachments(Workspace& workspace, double scale);

/// The things that a character wears and holds, as nodes for an export: each strand, and each column of a
/// cloth, is a chain of nodes through its particles; the held object is one node.
class WornMotion {
  public:
    /// Recreates everything at the pose that the clip starts with, and lets it settle.
    WornMotion(const HumanoidPart& part, Solvers& solvers, const ShownPose& start, rope::Workspace& ropes);
    const Worn& worn() const { return worn_; }
    void advance(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown, double seconds);
    /// The local transforms of its nodes.
    void pose(const ShownPose& shown, std::span<rig::Transform> nodes) const;

  private:
    struct Chain {
        std::size_t node = 0, count = 0;  ///< its nodes, from the first of `worn_`
        std::size_t first = 0, step = 1;  ///< its particles, in the world
        std::size_t on = 0;               ///< the character's node
    };
    void add(const Attachment& attachment, const HumanoidPart& part, const Wearer& wearer);
    void add_held(const HumanoidPart& part, const ShownPose& start);

    Worn worn_;
    Attachments attachments_;
    rope::Workspace& ropes_;
    std::vector<Chain> chains_;
    std::optional<std::size_t> held_by_{};  ///< the node above the held object, which is the last of all
};

}  // namespace tendril::app
