// The lint report of the chosen clip, cached, and cures for its faults.
#pragma once

#include <optional>
#include <string>
#include <tendril/humanoid/lint.hpp>

#include "app/labs/humanoid/humanoid_part.hpp"

namespace tendril::app {

/// The report is kept until character, bone map, clip or limits change.
class ClipLint {
  public:
    /// Null without a clip, and for clips so long that a frame would stall: those need judge().
    const humanoid::LintReport* report(const HumanoidPart& part);
    /// Judges the clip, however long it is.
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

/// Cures the faults of a clip that match `cure`. Throws std::invalid_argument if no such fault has a cure.
SharedCharacter cured(const HumanoidPart& part, const ClipCure& cure);

}  // namespace tendril::app
