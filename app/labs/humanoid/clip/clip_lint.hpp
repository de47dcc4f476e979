// The lint report of the chosen clip, either as read or after IK, cached; and cures for its faults.
#pragma once

#include <optional>
#include <string>
#include <tendril/humanoid/lint.hpp>
#include <tendril/rope/workspace.hpp>

#include "app/io/character/gltf_write.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"

namespace tendril::app {

/// Extra nodes and meshes for what the character wears, and scratch memory to simulate it.
struct Wardrobe {
    rope::Workspace& ropes;
    Worn worn{};
};
/// The clip as displayed, played once from its start, for an export. With a wardrobe, dresses the character
/// and animates its attachments.
humanoid::Clip clip_as_shown(HumanoidPart part, Solvers& solvers, std::size_t clip, double rate,
                             Wardrobe* wardrobe = nullptr);
/// The ground on which foot IK puts the feet; null without foot IK.
const humanoid::Ground* ground_of_feet(const HumanoidPart& part, Solvers& solvers);

/// Cached until character, bone map, clip or limits change; the result's also until IK, curves or springs do.
class ClipLint {
  public:
    /// The report on the clip or on the result, as HumanoidView::judged says. Null without a clip, or for
    /// clips so long that a frame would stall: those need judge().
    const humanoid::LintReport* report(const HumanoidPart& part, Solvers& solvers);
    /// Judges the clip, however long it is.
    const humanoid::LintReport* judge(const HumanoidPart& part, Solvers& solvers);

  private:
    struct Judged {
        SharedCharacter loaded;
        std::shared_ptr<const humanoid::BoneMap> map;
        Playback playback;  ///< the clip; for the result also whether it travels
        LimitsFrom limits = LimitsFrom::Defaults;
        std::optional<IkSettings> ik{};  ///< for the result
        std::vector<SpringSetting> springs{};
        std::vector<BoneCurve> curves{};
        bool operator==(const Judged&) const = default;
    };
    static Judged wanted(const HumanoidPart& part);
    Judged judged_{};
    std::optional<humanoid::LintReport> report_;
};

/// Throws std::invalid_argument, with the reasons, if IK causes everything in the report on the result that
/// matches `cure`: the clip itself then has nothing to cure.
void require_cure_in_clip(const HumanoidPart& part, const ClipCure& cure, const humanoid::LintReport& result);

struct CuredClip {
    SharedCharacter loaded;
    std::string text;  ///< for the user: how many faults were fixed, which remain, and why
};
/// Cures the clip's faults that match `cure`, as many as can be. Throws std::invalid_argument if none can.
CuredClip cured(const HumanoidPart& part, const ClipCure& cure, LoadProgress* progress = nullptr);
/// True if judging the chosen clip takes at most a frame.
bool judged_soon(const HumanoidPart& part);

}  // namespace tendril::app
