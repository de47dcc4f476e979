// Caches of the Humanoid lab: the displayed pose of its part, solvers, and the state of its panels.
#pragma once

#include <optional>
#include <tendril/rope/workspace.hpp>

#include "app/document/runtime.hpp"
#include "app/io/character/skin.hpp"
#include "app/labs/humanoid/character/character_commands.hpp"
#include "app/labs/humanoid/character/loaded_character.hpp"
#include "app/labs/humanoid/clip/clip_lint.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/past/flips.hpp"

namespace tendril::app {

class HumanoidRuntime final : public Runtime {
  public:
    const ShownPose& shown(const Workspace& workspace);
    /// For the part's skin; kept until character or map change.
    const TwistSpread& twist(const HumanoidPart& part);

    Loading loading;  ///< background work
    Solvers solvers;
    ClipLint lint;
    KeptMaps kept_maps;
    rope::Workspace ropes;
    PastPoses past;
    struct Reviewed {
        std::shared_ptr<const Part> part;
        ShownPose shown;
    } reviewed;  ///< the end of the last review, where the next begins

    /// State of the panels only; nothing else depends on it.
    struct Panel {
        std::optional<humanoid::Bone> bone;   ///< the row that waits for a node to be picked
        bool bones_first = false;             ///< shows the bone map before the other sections
        SharedCharacter bones_of{};           ///< the character for which bones_first was decided
        int attach_kind = 0;                  ///< kind of attachment that Add makes
        std::string attach_to = "Hips";       ///< bone or node to attach it to
        bool past = false;                    ///< the strip shows the last ten seconds instead of the clip
        std::string export_to{}, map_file{};  ///< paths typed by the user
    } panel;

  private:
    std::shared_ptr<const Part> part_;  ///< parts never change in place
    ShownPose shown_;
    SharedCharacter twist_of_;
    std::shared_ptr<const humanoid::BoneMap> twist_map_;
    TwistSpread twist_;
};

inline HumanoidRuntime& humanoid_runtime(const Workspace& workspace) {
    return workspace.runtimes.of<HumanoidRuntime>(humanoid_lab);
}

}  // namespace tendril::app
