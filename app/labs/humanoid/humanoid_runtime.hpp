// What the Humanoid lab works in: the shown pose of its part, worked out once, and what its panels keep.
#pragma once

#include <array>
#include <optional>
#include <tendril/rope/workspace.hpp>

#include "app/document/runtime.hpp"
#include "app/io/character/twist_spread.hpp"
#include "app/labs/humanoid/character/character_commands.hpp"
#include "app/labs/humanoid/character/loaded_character.hpp"
#include "app/labs/humanoid/clip/clip_lint.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/past/flips.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

class HumanoidRuntime final : public Runtime {
  public:
    const ShownPose& shown(const Workspace& workspace);
    /// Of the part's skin: kept until character or map are others.
    const TwistSpread& twist(const HumanoidPart& part);

    Loading loading;  ///< a file that is being read
    Solvers solvers;
    ClipLint lint;
    KeptMaps kept_maps;
    rope::Workspace ropes;
    PastPoses past;
    struct Reviewed {
        std::shared_ptr<const Part> part;
        ShownPose shown;
    } reviewed;  ///< what the last review ended with: the next one begins with it

    /// The interface's own: it follows from nothing, and nothing follows from it.
    struct Panel {
        std::optional<humanoid::Bone> bone;             ///< the row for which a node is picked
        SearchText node{}, clip{}, holder{}, spring{};  ///< what is looked for
        int attach_kind = 0;                            ///< of the attachment that Add makes
        std::string attach_to = "Hips";                 ///< bone or node that it hangs on
        bool past = false;                    ///< the strip shows the last ten seconds instead of the clip
        std::string export_to{}, map_file{};  ///< paths that are typed
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
