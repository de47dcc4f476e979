// What a person may ask about that came of a tick or a change: bones that flipped, joints at their limits,
// effectors that fell short of their targets.
#include <algorithm>
#include <glm/trigonometric.hpp>

#include "app/document/units.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/past/flips.hpp"

namespace tendril::app {
namespace {

/// Targets without their places.
IkSettings without_places(IkSettings settings) {
    for (auto& target : settings.targets)
        if (target) target = TargetSetting{.position = glm::dvec3(0.0), .weight = target->weight};
    settings.look_at.target = glm::dvec3(0.0);
    return settings;
}

/// The same character under the same settings: what changed came of time and of where targets are.
bool comparable(const HumanoidPart& was, const HumanoidPart& is) {
    const Playback &before = was.playback, &after = is.playback;
    const bool plays = before.playing || (before.time == after.time && before.rounds == after.rounds);
    return was.loaded == is.loaded && (was.map == is.map || *was.map == *is.map) &&
           before.clip == after.clip && before.in_place == after.in_place && plays &&
           was.t_pose == is.t_pose && was.springs == is.springs &&
           without_places(was.ik) == without_places(is.ik);
}

std::string node_name(const HumanoidPart& part, humanoid::Bone bone) {
    return part.skeleton()[*part.node_of(bone)].name;
}

void add_flips(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers,
               std::vector<Incident>& incidents) {
    for (const BodyFlip& flip : body_flips(was, is, solvers))
        incidents.push_back({.kind = Incident::Kind::Flip,
                             .joint = *is.part.node_of(flip.bone),
                             .name = node_name(is.part, flip.bone),
                             .degrees = static_cast<float>(glm::degrees(flip.radians)),
                             .cause = flip_cause(was, is, flip.bone)});
}

void add_limits(const HumanoidMoment& was, const HumanoidMoment& is, std::vector<Incident>& incidents) {
    if (!was.shown.body || !is.shown.body) return;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        if (was.shown.body->at_limit[i] || !is.shown.body->at_limit[i]) continue;
        const auto bone = static_cast<humanoid::Bone>(i);
        const std::string name = node_name(is.part, bone);
        incidents.push_back({.kind = Incident::Kind::Limit,
                             .joint = *is.part.node_of(bone),
                             .name = name,
                             .cause = name + " reached its limit: the joint turns no further that way"});
    }
}

/// Metres between an effector and its target; nothing where it is not to get there: a hand that is blended.
std::optional<double> left_of(const HumanoidMoment& moment, humanoid::Effector effector) {
    for (std::size_t hand = 0; hand < 2; ++hand)
        if (both_hands[hand] == effector && moment.shown.hand_goes[hand] &&
            (!moment.shown.hands || moment.shown.hands->hands[hand].weight < 0.999))
            return std::nullopt;
    if (!moment.part.ik.target(effector)) return std::nullopt;
    return moment.shown.residual(effector);
}

void add_short_effectors(const HumanoidMoment& was, const HumanoidMoment& is,
                         std::vector<Incident>& incidents) {
    const double far = std::max(1e-3, 0.005 * is.part.loaded->height());
    for (const humanoid::Effector each : all_effectors) {
        const auto before = left_of(was, each), after = left_of(is, each);
        if (!before || !after || *before >= far || *after < far) continue;
        const std::string name = title(each);
        incidents.push_back({.kind = Incident::Kind::Status,
                             .joint = *is.part.node_of(humanoid::bone_of(each)),
                             .name = name,
                             .cause = name + " fell short of its target: " + fixed_text(1000.0 * *after, 1) +
                                      " mm are left"});
    }
}

}  // namespace

std::vector<Incident> HumanoidLab::review(const Workspace& workspace, const Part& before,
                                          const Part& after) const {
    const auto& was_part = dynamic_cast<const HumanoidPart&>(before);
    const auto& is_part = dynamic_cast<const HumanoidPart&>(after);
    if (!comparable(was_part, is_part)) return {};
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const auto pose_of = [&](const HumanoidPart& part) {
        IkState state = part.ik_state;
        return solve_pose(part, runtime.solvers, 0.0, state);
    };
    const bool known = runtime.reviewed.part.get() == &before;
    const ShownPose first = known ? std::move(runtime.reviewed.shown) : pose_of(was_part);
    const auto& present = workspace.document.parts().at(humanoid_lab);
    const bool now = present.get() == &after;
    HumanoidRuntime::Reviewed second{now ? present : nullptr,
                                     now ? runtime.shown(workspace) : pose_of(is_part)};
    const HumanoidMoment was{was_part, first}, is{is_part, second.shown};
    std::vector<Incident> incidents;
    add_flips(was, is, runtime.solvers, incidents);
    add_limits(was, is, incidents);
    add_short_effectors(was, is, incidents);
    runtime.reviewed = std::move(second);
    return incidents;
}

}  // namespace tendril::app
