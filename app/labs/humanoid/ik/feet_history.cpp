#include "app/labs/humanoid/ik/feet_history.hpp"

#include <algorithm>
#include <cmath>

#include "app/document/workspace.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"

namespace tendril::app {
namespace {

/// Maximum number of blocks remembered, for a clip that is scrubbed from end to end.
constexpr std::size_t most_pasts = 32;

/// Steps through a clip's ticks.
class FeetWalk {
  public:
    FeetWalk(const HumanoidPart& part, Solvers& solvers)
        : part_(part),
          feet_(*solvers.feet(part)),
          ground_(solvers.ground(part)),
          options_(feet_options(part, solvers)),
          hips_(part.node_of(humanoid::Bone::Hips)),
          playback_(part.playback) {
        playback_.loop = true;
    }
    humanoid::FeetReport step(std::int64_t tick, double dt, humanoid::FeetState& state) {
        go_to(playback_, *part_.loaded, static_cast<double>(tick) * tick_seconds);
        options_.root_velocity = missing_velocity(playback_, *part_.loaded, hips_);
        std::vector<rig::Transform> pose = animated_pose(playback_, *part_.loaded, hips_);
        return feet_.step(pose, ground_, dt, state, options_);
    }

  private:
    const HumanoidPart& part_;
    const humanoid::Feet& feet_;
    const humanoid::Ground& ground_;
    humanoid::FeetOptions options_;
    std::optional<std::size_t> hips_;
    Playback playback_;
};

}  // namespace

FeetHistory::Deepest FeetHistory::deepest_of(const humanoid::FeetReport& report) {
    const auto of = [&](std::size_t side) {
        return Deepest{side, report.feet[side].depth, report.feet[side].late};
    };
    return std::ranges::max(of(0), of(1), {}, &Deepest::depth);
}

FeetHistory::Before FeetHistory::before(const HumanoidPart& part, Solvers& solvers) {
    const humanoid::Clip* const clip = part.clip();
    if (clip == nullptr) return {};
    Of of{part.loaded,        part.map,       part.playback.clip, part.playback.in_place,
          part.playback.pace, part.ik.ground, part.ik.foot_ik};
    if (!(of_ == of)) {
        of_ = std::move(of);
        pasts_.clear();
    }
    const double seconds = static_cast<double>(part.playback.rounds) * clip->duration + part.playback.time;
    // The last tick before the moment; a moment on a tick is reached by a whole step.
    const auto tick = static_cast<std::int64_t>(std::ceil(seconds / tick_seconds - 1e-6)) - 1;
    if (tick < 0) return {};
    const std::int64_t block = tick / block_ticks;
    const std::int64_t begin = std::max<std::int64_t>(block - 1, 0) * block_ticks;
    Before found{.state = at(tick, begin, part, solvers),
                 .dt = seconds - static_cast<double>(tick) * tick_seconds};
    const std::vector<Deepest>& deepest = pasts_[begin].deepest;
    for (std::int64_t i = std::max<std::int64_t>(tick - begin - lately, 0); i <= tick - begin; ++i)
        found.deepest =
            std::ranges::max(found.deepest, deepest[static_cast<std::size_t>(i)], {}, &Deepest::depth);
    // While the clip plays, the past of the next block is computed along, so that no frame has to catch up.
    if (block > 0) {
        const std::int64_t next = block * block_ticks, known = pasts_.contains(next) ? pasts_[next].tick : -1;
        at(std::min(tick, next + known + 2), next, part, solvers);
    }
    if (pasts_.size() > most_pasts)
        std::erase_if(pasts_, [&](const auto& each) { return each.first < begin; });
    return found;
}

humanoid::FeetState FeetHistory::at(std::int64_t tick, std::int64_t begin, const HumanoidPart& part,
                                    Solvers& solvers) {
    Past& past = pasts_[begin];
    const std::int64_t wanted = tick - begin;
    if (wanted == past.tick) return past.last;
    FeetWalk walk(part, solvers);
    if (wanted < past.tick) {
        const std::int64_t kept = wanted / ticks_apart;
        humanoid::FeetState state = past.kept[static_cast<std::size_t>(kept)];
        for (std::int64_t i = kept * ticks_apart + 1; i <= wanted; ++i)
            walk.step(begin + i, tick_seconds, state);
        return state;
    }
    while (past.tick < wanted) {
        ++past.tick;
        past.deepest.push_back(
            deepest_of(walk.step(begin + past.tick, past.tick == 0 ? 0.0 : tick_seconds, past.last)));
        if (past.tick % ticks_apart == 0) past.kept.push_back(past.last);
    }
    return past.last;
}

}  // namespace tendril::app
