#include "app/labs/humanoid/clip/clip_lint.hpp"

#include <algorithm>
#include <stdexcept>

namespace tendril::app {
namespace {

using humanoid::BodyLimits;
using humanoid::Clip;
using humanoid::Finding;
using humanoid::LintReport;

/// Frames times nodes that are judged within a tick or two.
constexpr double soon_judged = 60'000.0;

std::optional<BodyLimits> limits_for(const HumanoidPart& part) {
    if (part.ik.limits == LimitsFrom::Defaults || !part.map->is_usable()) return std::nullopt;
    if (part.ik.limits == LimitsFrom::None) return humanoid::no_limits();
    return humanoid::learned_limits(part.skeleton(), *part.map, part.loaded->clips(),
                                    humanoid::default_limits(part.skeleton(), *part.map));
}

LintReport lint_of(const HumanoidPart& part, const Clip& clip) {
    const std::optional<BodyLimits> limits = limits_for(part);
    return lint(part.skeleton(), *part.map, clip, {.limits = limits ? &*limits : nullptr});
}

bool is_meant(const Finding& finding, const ClipCure& cure, const humanoid::Skeleton& skeleton) {
    if (!finding.has_cure || finding.fault != cure.fault) return false;
    if (cure.frame && !(finding.first <= *cure.frame && *cure.frame <= finding.last)) return false;
    if (cure.node.empty()) return true;
    return finding.node >= 0 && skeleton[static_cast<std::size_t>(finding.node)].name == cure.node;
}

}  // namespace

const LintReport* ClipLint::report(const HumanoidPart& part) {
    const Clip* const clip = part.clip();
    if (!clip) return nullptr;
    if (report_ && judged_ == Judged{part.loaded, part.map, part.playback.clip, part.ik.limits})
        return &*report_;
    const double frames = clip->duration * humanoid::frame_rate(*clip);
    if (frames * static_cast<double>(part.skeleton().size()) > soon_judged) return nullptr;
    return judge(part);
}

const LintReport* ClipLint::judge(const HumanoidPart& part) {
    const Clip* const clip = part.clip();
    if (!clip) return nullptr;
    const Judged wanted{part.loaded, part.map, part.playback.clip, part.ik.limits};
    if (!report_ || !(judged_ == wanted)) {
        report_ = lint_of(part, *clip);
        judged_ = wanted;
    }
    return &*report_;
}

SharedCharacter cured(const HumanoidPart& part, const ClipCure& cure) {
    const std::vector<Clip>& clips = part.loaded->clips();
    const auto place = std::ranges::find(clips, cure.clip, &Clip::name);
    if (place == clips.end()) throw std::invalid_argument("the character has no clip \"" + cure.clip + "\"");
    Clip clip = *place;
    // What is found first is cured first; what a cure does not help is not tried again.
    std::size_t left = lint_of(part, clip).findings.size() + 1, done = 0;
    while (true) {
        const LintReport report = lint_of(part, clip);
        const auto found = std::ranges::find_if(
            report.findings, [&](const Finding& each) { return is_meant(each, cure, part.skeleton()); });
        if (found == report.findings.end() || report.findings.size() >= left) break;
        left = report.findings.size();
        const Expected<Clip> mended = humanoid::cure(part.skeleton(), *part.map, clip, *found);
        if (!mended) throw std::invalid_argument(mended.message());
        clip = *mended;
        ++done;
    }
    if (done == 0) throw std::invalid_argument("clip " + cure.clip + " has no such fault that has a cure");
    auto loaded = std::make_shared<LoadedCharacter>(*part.loaded);
    loaded->character.clips[static_cast<std::size_t>(place - clips.begin())] = std::move(clip);
    loaded->cures.push_back(cure);
    return loaded;
}

}  // namespace tendril::app
