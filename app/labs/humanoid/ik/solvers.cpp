#include "app/labs/humanoid/ik/solvers.hpp"

#include <algorithm>
#include <cmath>

#include "app/document/workspace.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"

namespace tendril::app {
namespace {

/// Fitted to the skin at rest, if there is one.
std::vector<humanoid::BodyCapsule> capsules_of(const HumanoidPart& part) {
    const Skin& skin = part.loaded->character.skin;
    if (!skin.mesh) return humanoid::default_capsules(part.skeleton(), *part.map);
    return humanoid::fitted_capsules(part.skeleton(), *part.map, skin_points(skin, part.loaded->rest));
}

/// Maximum number of blocks kept, for a clip that is scrubbed from end to end.
constexpr std::size_t max_pasts = 32;

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

/// Why the map cannot be solved; empty if it can. "LeftHand and RightHand are missing"
std::string why_unusable(const humanoid::BoneMap& map) {
    std::string names;
    for (std::size_t i = 0; i < map.missing.size(); ++i) {
        if (i > 0) names += i + 1 == map.missing.size() ? " and " : ", ";
        names += humanoid::name(map.missing[i]);
    }
    if (!names.empty()) return names + (map.missing.size() == 1 ? " is missing" : " are missing");
    return map.upright ? "" : "from hips to head it runs more sideways than up";
}

}  // namespace

Solvers::Solvers() = default;
Solvers::~Solvers() = default;

void Solvers::make(const HumanoidPart& part) {
    const Made wanted{part.loaded, part.map, part.ik.limits, part.ik.joint_limits, part.ik.self_collision};
    if (made_ == wanted) return;
    made_ = wanted;
    body_.reset();
    capsules_.clear();
    volume_.reset();
    feet_.reset();
    clip_feet_.clear();
    masses_.reset();
    hands_.reset();
    look_at_.reset();
    spring_nodes_.clear();
    springs_.clear();
    floors_.clear();
    gaits_.clear();
    why_not_ = why_no_feet_ = why_unusable(*part.map);
    if (!why_not_.empty()) return;
    if (part.ik.self_collision) capsules_ = *(volume_ = capsules_of(part));
    Expected<humanoid::Body> body =
        humanoid::Body::make(part.skeleton(), *part.map, limits(part).in_force(part.ik), capsules_);
    if (body)
        body_ = std::move(body).value();
    else
        why_not_ = body.message();
    if (auto hands = humanoid::Hands::make(part.skeleton(), *part.map)) hands_ = std::move(hands).value();
    if (auto look = humanoid::LookAt::make(part.skeleton(), *part.map)) look_at_ = std::move(look).value();
    if (auto masses = humanoid::find_masses(part.skeleton(), *part.map)) masses_ = std::move(masses).value();
    Expected<humanoid::Feet> feet = humanoid::Feet::make(part.skeleton(), *part.map);
    if (feet)
        feet_ = std::move(feet).value();
    else
        why_no_feet_ = feet.message();
}

humanoid::Body* Solvers::body(const HumanoidPart& part) {
    make(part);
    return body_ ? &*body_ : nullptr;
}

const std::string& Solvers::why_no_body(const HumanoidPart& part) {
    make(part);
    return why_not_;
}

const humanoid::Feet* Solvers::feet(const HumanoidPart& part) {
    make(part);
    if (!feet_ || !part.playback.clip) return feet_ ? &*feet_ : nullptr;
    const auto [found, added] = clip_feet_.try_emplace(*part.playback.clip);
    if (added) {
        const humanoid::Soles& rest = feet_->soles();
        const humanoid::Soles soles = humanoid::clip_soles(part.skeleton(), *part.map, rest, *part.clip());
        if (!(soles == rest)) found->second = humanoid::Feet::make(part.skeleton(), *part.map, soles).value();
    }
    return found->second ? &*found->second : &*feet_;
}

const humanoid::Hands* Solvers::hands(const HumanoidPart& part) {
    make(part);
    return hands_ ? &*hands_ : nullptr;
}

const humanoid::LookAt* Solvers::look_at(const HumanoidPart& part) {
    make(part);
    return look_at_ ? &*look_at_ : nullptr;
}

const SpringChains& Solvers::springs(const HumanoidPart& part) {
    make(part);
    const auto same = [](const SpringSetting& setting, const std::string& node) {
        return setting.node == node;
    };
    if (std::ranges::equal(part.springs, spring_nodes_, same)) return springs_;
    spring_nodes_.clear();
    springs_.clear();
    for (const SpringSetting& each : part.springs) {
        spring_nodes_.push_back(each.node);
        springs_.emplace_back();
        const auto node = part.skeleton().find(each.node);
        if (!node) continue;
        if (auto chain = humanoid::SpringChain::make(part.skeleton(), *part.map, *node))
            springs_.back() = std::make_unique<humanoid::SpringChain>(std::move(chain).value());
    }
    return springs_;
}

const BentChains& Solvers::curves(const HumanoidPart& part) {
    const auto same = [](const BoneCurve& curve, const std::pair<std::string, std::string>& ends) {
        return curve.first == ends.first && curve.last == ends.second;
    };
    if (curves_of_ == part.loaded && std::ranges::equal(part.curves, curve_ends_, same)) return curves_;
    curves_of_ = part.loaded;
    curve_ends_.clear();
    curves_.clear();
    for (const BoneCurve& each : part.curves) {
        curve_ends_.emplace_back(each.first, each.last);
        curves_.emplace_back();
        const auto ends = chain_of(part, each);
        if (!ends) continue;
        if (auto chain = humanoid::BentChain::make(part.skeleton(), ends->first, ends->last))
            curves_.back() = std::make_unique<humanoid::BentChain>(std::move(chain).value());
    }
    return curves_;
}

const humanoid::Masses* Solvers::masses(const HumanoidPart& part) {
    make(part);
    return body_ && feet_ && masses_ ? &*masses_ : nullptr;
}

const std::string& Solvers::why_no_feet(const HumanoidPart& part) {
    make(part);
    return why_no_feet_;
}

std::optional<double> Solvers::floor(const HumanoidPart& part) {
    make(part);
    if (!feet_ || !part.playback.clip) return std::nullopt;
    const auto [found, added] = floors_.try_emplace(*part.playback.clip, 0.0);
    if (added) found->second = humanoid::clip_floor(part.skeleton(), feet(part)->soles(), *part.clip());
    return found->second;
}

const Solvers::Gait* Solvers::gait(const HumanoidPart& part) {
    const std::optional<double> ground = floor(part);
    if (!ground) return nullptr;
    const auto [found, added] = gaits_.try_emplace(*part.playback.clip);
    Gait& gait = found->second;
    if (!added) return &gait;
    gait.pace = pace_of(part, *part.playback.clip);
    const humanoid::Clip& clip = *part.clip();
    const humanoid::Skeleton& skeleton = part.skeleton();
    const double steps = std::clamp(std::ceil(60.0 * clip.duration), 1.0, 10'000.0);
    const double dt = clip.duration / steps;
    if (!(dt > 0.0)) return &gait;
    const std::size_t hips = part.node_of(humanoid::Bone::Hips).value_or(0);
    std::vector<rig::Transform> pose(skeleton.size());
    std::vector<humanoid::Placement> placed(skeleton.size());
    const double low_under = humanoid::FeetOptions{}.low;
    std::array<humanoid::SolePoints, 2> before{};
    std::array<std::vector<double>, 2> speeds;
    glm::dvec3 start(0.0);
    for (int i = 0; i <= static_cast<int>(steps); ++i) {
        humanoid::sample(clip, skeleton, i * dt, pose);
        humanoid::place(skeleton, pose, placed);
        const auto soles = humanoid::sole_points(feet(part)->soles(), placed);
        if (i == 0) start = placed[hips].position;
        for (std::size_t side = 0; side < 2; ++side) {
            const bool low = std::min(soles[side].heel.y, soles[side].toe.y) < *ground + low_under;
            const glm::dvec3 moved = soles[side].toe - before[side].toe;
            if (i > 0 && low) speeds[side].push_back(std::sqrt(moved.x * moved.x + moved.z * moved.z) / dt);
        }
        before = soles;
    }
    for (std::size_t side = 0; side < 2; ++side) {
        if (speeds[side].empty()) continue;
        const auto middle = speeds[side].begin() + static_cast<std::ptrdiff_t>(speeds[side].size() / 2);
        std::nth_element(speeds[side].begin(), middle, speeds[side].end());
        gait.slide[side] = *middle;
    }
    const glm::dvec3 way = placed[hips].position - start;
    gait.travel = std::sqrt(way.x * way.x + way.z * way.z) / clip.duration;
    return &gait;
}

const std::vector<humanoid::BodyCapsule>& Solvers::capsules(const HumanoidPart& part) {
    make(part);
    return capsules_;
}

const LimitRanges& Solvers::limits(const HumanoidPart& part) {
    if (!ranges_ || !ranges_->is_of(part)) ranges_ = std::make_unique<LimitRanges>(part.loaded, part.map);
    return *ranges_;
}

const std::vector<humanoid::BodyCapsule>& Solvers::volume(const HumanoidPart& part) {
    make(part);
    if (!volume_) volume_ = capsules_of(part);
    return *volume_;
}

const humanoid::Ground& Solvers::ground(const HumanoidPart& part) {
    if (ground_of_ != part.ik.ground) {
        ground_ = make_ground(part.ik.ground);
        ground_of_ = part.ik.ground;
    }
    return ground_;
}

using humanoid::Bone;

std::vector<BodyChain> body_chains(const humanoid::BoneMap& map) {
    if (!map.is_usable()) return {};
    std::vector<BodyChain> all{
        {0, {Bone::Hips}},
        {1, {Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot}},
        {1, {Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot}},
        {1, {Bone::Spine, Bone::Chest, Bone::UpperChest}},
        {2, {Bone::LeftShoulder, Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand}},
        {2, {Bone::RightShoulder, Bone::RightUpperArm, Bone::RightLowerArm, Bone::RightHand}},
        {2, {Bone::Neck, Bone::Head}}};
    for (BodyChain& chain : all) {
        std::erase_if(chain.bones, [&](Bone bone) { return map[bone].node < 0; });
        chain.end = chain.bones.back();
    }
    return all;
}

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
    // The last tick before the moment. A moment on a tick is reached by a whole step.
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
    // While the clip plays, the past of the next block is computed too, so that no frame has to catch up.
    if (block > 0) {
        const std::int64_t next = block * block_ticks, known = pasts_.contains(next) ? pasts_[next].tick : -1;
        at(std::min(tick, next + known + 2), next, part, solvers);
    }
    if (pasts_.size() > max_pasts)
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
