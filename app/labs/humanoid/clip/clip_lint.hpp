// What is wrong with the chosen clip, worked out once, and its cures.
#pragma once

#include <optional>
#include <string>
#include <tendril/humanoid/lint.hpp>

#include "app/labs/humanoid/humanoid_part.hpp"

namespace tendril::app {

/// The report on the part's clip: kept until character, bones, clip or limits are others.
class ClipLint {
  public:
    /// Null without a clip, and for one so long that a frame would wait for it: that is judged when asked
    /// for.
    const humanoid::LintReport* report(const HumanoidPart& part);
    /// Judges it however long it is.
    const humanoid::LintReport* judge(const HumanoidPart& part);

  private:
    struct Judged {
        SharedCharacter loaded;
        std::shared_ptr<const humanoid::BoneMap> map;
        std::optional<std::size_t> clip;
        LimitsFrom limits = LimitsFrom::Defaults;
        bool operator==(const Judged&) const = default;
    };
    Judged judged_{};
    std::optional<humanoid::LintReport> report_;
};

/// Cures faults of a clip: all of that kind, or those of one node, or the one at a frame. Throws
/// std::invalid_argument where there is none that has a cure.
SharedCharacter cured(const HumanoidPart& part, const ClipCure& cure);

}  // namespace tendril::app
