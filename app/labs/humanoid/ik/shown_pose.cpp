#include "app/labs/humanoid/ik/shown_pose.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

#include "app/io/text.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/springs/springs.hpp"

namespace tendril::app {
namespace {

std::vector<humanoid::Placement> placed(const HumanoidPart& part, const std::vector<rig::Transform>& local) {
    std::vector<humanoid::Placement> placements(local.size());
    humanoid::place(part.skeleton(), local, placements);
    return placements;
}

/// True if hand IK moves the effector.
bool is_hand(const IkSettings& ik, humanoid::Effector effector) {
    return ik.hand_ik.on && std::ranges::find(both_hands, effector) != both_hands.end();
}

/// Brings the feet to the ground.
void stand(const HumanoidPart& part, Solvers& solvers, ShownPose& shown) {
    const humanoid::Feet* const feet = part.ik.foot_ik.on ? solvers.feet(part) : nullptr;
    if (feet == nullptr) return;
    FeetHistory::Before before = solvers.feet_history().before(part, solvers);
    const humanoid::FeetReport report =
        feet->step(shown.local, solvers.ground(part), before.dt, before.state, feet_options(part, solvers));
    if (!report.accepted) return;
    shown.feet = report;
    shown.feet_state = before.state;
    shown.deepest = FeetHistory::deepest_of(report);
    if (before.deepest.depth > shown.deepest.depth) shown.deepest = before.deepest;
}

/// If a file was edited, the stored state may belong to another body; reset it then.
void reach(const HumanoidPart& part, humanoid::Body& body, const std::vector<humanoid::BodyTarget>& targets,
           humanoid::BodyOptions options, double dt, IkState& state, ShownPose& shown) {
    if (state.release.left > 0.0) options.settle = std::min(settle_speed * dt, 1.0);
    const auto solved = [&]() -> Expected<humanoid::BodyReport> {
        if (!part.ik.hold) return body.solve(shown.local, targets, state.body, options);
        const auto held = solve_hold(part, body, shown, targets, options, state);
        if (!held) return held.error();
        shown.hold = *held;
        return held->body;
    };
    Expected<humanoid::BodyReport> report = solved();
    if (!report && !(state.body == humanoid::BodyState() && state.hold == humanoid::HoldState())) {
        state.body = {}, state.hold = {};
        report = solved();
    }
    if (report)
        shown.body = *report;
    else
        shown.refused = report.message();
}

/// If targets hold the body, turns only neck and head.
void look(const HumanoidPart& part, Solvers& solvers, double dt, IkState& state, ShownPose& shown) {
    const humanoid::LookAt* const look_at = part.ik.look_at.on ? solvers.look_at(part) : nullptr;
    if (look_at == nullptr) {
        state.look = {};
        return;
    }
    const humanoid::LookAtReport report =
        look_at->step(shown.local, look_options(part, shown.body.has_value()), dt, state.look);
    if (report.accepted) shown.look = report;
}

std::vector<rig::Transform> clip_pose(const HumanoidPart& part, bool unfixed = false) {
    return animated_pose(part.playback, *part.loaded, part.node_of(humanoid::Bone::Hips), unfixed);
}

double weight_at(const std::optional<HandCurve>& times, double seconds) {
    if (!times) return 1.0;
    const auto curve = humanoid::weight_curve(times->begin, times->full, times->until, times->end);
    return curve ? signal::evaluate_keys(*curve, seconds) : 0.0;
}

void reach_by_hand(const HumanoidPart& part, Solvers& solvers, double dt, IkState& state, ShownPose& shown) {
    const humanoid::Hands* const hands = part.ik.hand_ik.on ? solvers.hands(part) : nullptr;
    if (hands == nullptr) {
        state.hands = {};
        return;
    }
    for (std::size_t hand = 0; hand < 2; ++hand) shown.hand_goes[hand] = part.ik.hand_target(hand) != nullptr;
    const humanoid::HandsReport report =
        hands->step(shown.local, hand_targets(part), dt, state.hands, part.ik.hand_ik.options);
    if (report.accepted) shown.hands = report;
}

}  // namespace

std::vector<humanoid::BodyTarget> body_targets(const IkSettings& ik) {
    std::vector<humanoid::BodyTarget> targets;
    for (const humanoid::Effector effector : all_effectors)
        if (const auto& target = ik.target(effector); target && !is_hand(ik, effector))
            targets.push_back(*target);
    return targets;
}

/// The ground decides which feet stand only if foot IK puts them there.
humanoid::BodyOptions body_options(const HumanoidPart& part, Solvers& solvers) {
    humanoid::BodyOptions options = part.ik.balance.body;
    if (options.balance && part.ik.foot_ik.on && part.ik.ground.kind != humanoid::GroundKind::None)
        options.ground = &solvers.ground(part);
    return options;
}

bool body_acts(const HumanoidPart& part, const IkState& state) {
    return state.steps.away() || part.ik.hold || !body_targets(part.ik).empty();
}

humanoid::FeetOptions feet_options(const HumanoidPart& part, Solvers& solvers) {
    humanoid::FeetOptions options = part.ik.foot_ik.options;
    options.floor = solvers.floor(part);
    if (part.playback.in_place)
        options.root_velocity =
            missing_velocity(part.playback, *part.loaded, part.node_of(humanoid::Bone::Hips));
    return options;
}

humanoid::LookAtOptions look_options(const HumanoidPart& part, bool body_solved) {
    humanoid::LookAtOptions options = part.ik.look_at.options;
    if (body_solved) options.spine_part = 0.0;
    if (part.ik.target(humanoid::Effector::Head)) options.neck_part = 0.0;
    return options;
}

humanoid::HandTargets hand_targets(const HumanoidPart& part) {
    humanoid::HandTargets targets{};
    for (std::size_t hand = 0; hand < 2; ++hand)
        if (const humanoid::BodyTarget* const target = part.ik.hand_target(hand))
            targets[hand] = {.position = target->position,
                             .rotation = target->rotation,
                             .weight = std::min(target->weight, 1.0) *
                                       weight_at(part.ik.hand_ik.curves[hand], part.playback.time)};
    return targets;
}

std::vector<rig::Transform> unsolved_pose(const HumanoidPart& part) {
    if (!part.playback.clip && part.t_pose) return humanoid::t_pose(part.skeleton(), *part.map);
    return clip_pose(part);
}

std::optional<double> ShownPose::residual(humanoid::Effector effector) const {
    for (std::size_t hand = 0; hand < 2; ++hand)
        if (both_hands[hand] == effector && hand_goes[hand])
            return hands ? std::optional(hands->hands[hand].residual) : std::nullopt;
    if (!body) return std::nullopt;
    return body->residuals[static_cast<std::size_t>(effector)];
}

namespace {

/// Full-body IK including stepping feet, then the next step.
void reach_and_step(const HumanoidPart& part, Solvers& solvers, humanoid::Body& body, double dt,
                    IkState& state, ShownPose& shown) {
    humanoid::BodyOptions options = body_options(part, solvers);
    const humanoid::Masses* const masses = solvers.masses(part);
    if (masses == nullptr || !part.ik.balance.body.balance || !part.ik.balance.steps) {
        state.steps = {};
        reach(part, body, body_targets(part.ik), options, dt, state, shown);
        return;
    }
    const humanoid::Soles& soles = solvers.feet(part)->soles();
    options.feet = humanoid::advance_steps(state.steps, soles, dt, part.ik.balance.footsteps);
    const std::vector<rig::Transform> clip = shown.local;
    reach(part, body, body_targets(part.ik), options, dt, state, shown);
    if (!(dt > 0.0) || !shown.body) return;
    humanoid::plan_step(state.steps, soles, masses->centre(placed(part, shown.local)), placed(part, clip),
                        state.body, options.ground);
}

/// All steps between the clip and the springs.
void solve(const HumanoidPart& part, Solvers& solvers, double dt, IkState& state, ShownPose& shown) {
    shown.curves = bend(part, solvers.curves(part), shown.local);
    stand(part, solvers, shown);
    if (const auto hips = part.node_of(humanoid::Bone::Hips)) {
        const humanoid::Placement at = placed(part, shown.local)[*hips];
        shown.hips = {at.position,
                      rig::normalised(at.rotation() * glm::conjugate(part.loaded->rest[*hips].rotation()))};
    }
    const bool acts = body_acts(part, state), moves = acts || part.ik.self_collision;
    humanoid::Body* const body = moves ? solvers.body(part) : nullptr;
    if (body == nullptr) state.body = {};
    if (body != nullptr && acts) reach_and_step(part, solvers, *body, dt, state, shown);
    look(part, solvers, dt, state, shown);
    reach_by_hand(part, solvers, dt, state, shown);
    // Resolves collisions from the clip or hand IK alone.
    if (body != nullptr && !acts) reach(part, *body, {}, body_options(part, solvers), dt, state, shown);
    pass(state.release, dt);
    apply(state.release, shown.local, part.node_of(humanoid::Bone::Hips));
}

}  // namespace

ShownPose solve_pose(const HumanoidPart& part, Solvers& solvers, double dt, IkState& state) {
    ShownPose shown;
    const std::vector<rig::Transform> before = clip_pose(part);
    shown.local = part.t_pose && !part.playback.clip ? unsolved_pose(part) : before;
    solve(part, solvers, dt, state, shown);
    shown.before_springs = shown.local;
    shown.springs = swing(part, solvers.springs(part), dt, shown.local, state.springs);
    shown.placed = placed(part, shown.local);
    if (const humanoid::Feet* const feet = solvers.feet(part)) {
        shown.soles = humanoid::sole_points(feet->soles(), shown.placed);
        shown.has_soles = true;
    }
    if (const humanoid::Masses* const masses =
            part.ik.balance.body.balance ? solvers.masses(part) : nullptr) {
        const humanoid::Support support = humanoid::find_support(solvers.feet(part)->soles(), shown.soles,
                                                                 body_options(part, solvers).ground);
        const glm::dvec3 centre = masses->centre(shown.placed);
        shown.balance = ShownPose::Balance{support, centre, support.margin(centre)};
    }
    if (shown.local != before) shown.before = placed(part, before);
    return shown;
}

void carry_springs(Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    if (part.springs.empty()) return;
    Solvers& solvers = humanoid_runtime(workspace).solvers;
    IkState state = part.ik_state;
    ShownPose shown;
    shown.local = unsolved_pose(part);
    solve(part, solvers, 0.0, state, shown);
    state.springs = part.ik_state.springs;
    carry(part.springs, solvers.springs(part), shown.local, state.springs);
    if (state.springs == part.ik_state.springs) return;
    workspace.document.edit<HumanoidPart>(humanoid_lab).ik_state.springs = std::move(state.springs);
}

std::string why_alone(const HumanoidPart& part, const ShownPose& shown, std::size_t side) {
    if (part.ik.ground.kind == humanoid::GroundKind::None) return "there is no ground";
    return shown.feet ? humanoid::name(shown.feet->feet[side].alone) : "foot IK is off";
}

std::string balance_text(const HumanoidPart& part, const ShownPose& shown, Solvers& solvers) {
    const ShownPose::Balance& balance = *shown.balance;
    if (part.ik_state.steps.stepping()) return "stepping";
    if (balance.support.count == 0) return "no foot stands";
    const std::string far = rounded_length_text(std::abs(balance.margin));
    if (balance.margin >= 0.0) return far + " inside the feet";
    const std::size_t hips = *part.node_of(humanoid::Bone::Hips);
    const glm::dquat turn =
        shown.placed[hips].rotation() * glm::conjugate(part.loaded->rest[hips].rotation());
    const glm::dvec3 ahead = turn * solvers.feet(part)->soles().forward;
    const glm::dvec3 way = balance.centre - balance.support.nearest(balance.centre);
    const double forward = way.x * ahead.x + way.z * ahead.z, left = way.x * ahead.z - way.z * ahead.x;
    const bool along = std::abs(forward) >= std::abs(left);
    return far +
           (along ? (forward > 0.0 ? " ahead of" : " behind") : (left > 0.0 ? " left of" : " right of")) +
           " the feet";
}

std::string why_no_balance(const HumanoidPart& part, const ShownPose& shown, Solvers& solvers) {
    if (!shown.balance) return {};
    if (!body_acts(part, part.ik_state)) {
        if (part.ik.hand_target(0) || part.ik.hand_target(1))
            return "Balance has no effect: hand IK moves only the arms. Turn hand IK off to let the body "
                   "reach.";
        return "Balance acts once something has a target.";
    }
    if (!shown.body) return {};
    const humanoid::Soles& soles = solvers.feet(part)->soles();
    const bool wanted = part.ik.balance.steps && shown.body->outside > 0.0 &&
                        shown.body->residual > humanoid::no_step_within * soles.leg;
    if (!wanted || part.ik_state.steps.stepping() || shown.before.empty()) return {};
    const humanoid::Support clip =
        humanoid::find_support(soles, shown.before, body_options(part, solvers).ground);
    return std::min(clip.standing[0], clip.standing[1]) > 0.0
               ? std::string()
               : "No foot steps while the clip lifts one: it waits until both stand.";
}

std::string why_in_air(const HumanoidPart& part, const ShownPose& shown, Solvers& solvers, std::size_t side) {
    if (!shown.feet || shown.feet->feet[side].planted || !why_alone(part, shown, side).empty()) return {};
    const Solvers::Gait* const gait = solvers.gait(part);
    if (gait == nullptr || part.playback.pace != glm::dvec3(0.0)) return {};
    const double slide = gait->slide[side];
    if (slide < part.ik.foot_ik.options.enter_speed) return {};
    const std::string speed = fixed_text(slide, 1) + " m/s";
    if (gait->travel < 0.35 * gait->slide[side])
        return "Feet are not planted: the clip walks in place, and they slide at " + speed +
               " while low. Turn on Travel, under Clip.";
    return "Feet are not planted: near the ground they move at " + speed + ", over \"plant below\".";
}

std::optional<FeetHistory::Deepest> foot_in_ground(const ShownPose& shown) {
    return shown.feet && shown.deepest.depth > max_depth ? std::optional(shown.deepest) : std::nullopt;
}

std::string why_in_ground(const HumanoidPart& part, const FeetHistory::Deepest& deepest) {
    const bool stairs = part.ik.ground.kind == humanoid::GroundKind::Stairs;
    if (deepest.late > 0.5 * deepest.depth)
        return stairs ? "It is too fast for the stairs. Use lower steps, or a lower speed under Clip."
                      : "It is too fast for the ground. Use a gentler ground, or a lower speed under Clip.";
    return stairs ? "It has too little room on the steps. Make them deeper."
                  : "It has too little room on the ground there.";
}

static std::vector<humanoid::Placement> ghost_of(const HumanoidPart& part, const ShownPose& shown) {
    if (part.loaded->unfixed.empty() || !part.playback.clip) return shown.before;
    const std::vector<rig::Transform> read = clip_pose(part, true);
    return read == shown.local ? std::vector<humanoid::Placement>() : placed(part, read);
}

const ShownPose& HumanoidRuntime::shown(const Workspace& workspace) {
    const std::shared_ptr<const Part>& part = workspace.document.parts().at(humanoid_lab);
    if (part_ != part) {
        part_ = part;
        IkState state = humanoid_part(workspace).ik_state;
        shown_ = solve_pose(humanoid_part(workspace), solvers, 0.0, state);
        shown_.ghost = ghost_of(humanoid_part(workspace), shown_);
    }
    return shown_;
}

const TwistSpread& HumanoidRuntime::twist(const HumanoidPart& part) {
    if (twist_of_ != part.loaded || twist_map_ != part.map) {
        twist_of_ = part.loaded, twist_map_ = part.map;
        twist_ = TwistSpread(part.loaded->character.skin, part.skeleton(), *part.map);
    }
    return twist_;
}

const ShownPose& shown_pose(const Workspace& workspace) {
    return humanoid_runtime(workspace).shown(workspace);
}

glm::vec3 HumanoidPart::stands_at(const Workspace& workspace) const {
    if (!view.follow) return glm::vec3(0.0f);
    const ShownPose& shown = shown_pose(workspace);
    const glm::vec3 at = shown.point(node_of(humanoid::Bone::Hips).value_or(0));
    return {at.x, shown.feet ? static_cast<float>(shown.feet->base) : 0.0f, at.z};
}

/// Solves until the pose has settled: a single solve covers only part of a long distance.
static ShownPose settled_pose(const HumanoidPart& part, Solvers& solvers, IkState& state) {
    constexpr int max_solves = 40;
    ShownPose shown;
    for (int i = 0; i < max_solves; ++i) {
        shown = solve_pose(part, solvers, 0.0, state);
        if (!shown.body || (shown.body->settled && shown.body->iterations <= 1)) break;
    }
    return shown;
}

void solve_now(Workspace& workspace) {
    IkState state = humanoid_part(workspace).ik_state;
    const ShownPose shown =
        settled_pose(humanoid_part(workspace), humanoid_runtime(workspace).solvers, state);
    if (!shown.refused.empty()) throw std::invalid_argument(shown.refused);
    if (!(state == humanoid_part(workspace).ik_state))
        workspace.document.edit<HumanoidPart>(humanoid_lab).ik_state = std::move(state);
}

Release release_between(const std::vector<rig::Transform>& before, const std::vector<rig::Transform>& now,
                        std::optional<std::size_t> hips) {
    Release release{.left = release_seconds};
    if (hips) release.shift = before[*hips].translation - now[*hips].translation;
    for (std::size_t node = 0; node < now.size(); ++node)
        if (before[node].rotation != now[node].rotation)
            release.turns[node] = rig::normalised(glm::conjugate(now[node].rotation) * before[node].rotation);
    return release;
}

double fading(const Release& release) {
    const double part = std::clamp(1.0 + (release.left - release_seconds) / fade_seconds, 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
}

void apply(const Release& release, std::vector<rig::Transform>& pose, std::optional<std::size_t> hips) {
    const double part = fading(release);
    if (part <= 0.0) return;
    if (hips) pose[*hips].translation += part * release.shift;
    for (const auto& [node, turn] : release.turns)
        pose[node].rotation =
            rig::normalised(pose[node].rotation * rig::blend(glm::dquat(1.0, 0.0, 0.0, 0.0), turn, part));
}

void pass(Release& release, double seconds) {
    release.left -= seconds;
    if (!(release.left > 0.0)) release = {};
}

void forget_on_the_way_to(Release& release, const humanoid::Skeleton& skeleton, std::size_t node) {
    release.shift = glm::dvec3(0.0);  // the path to every node begins at the hips
    std::erase_if(release.turns, [&](const auto& each) {
        return each.first == node || skeleton.is_below(node, each.first) ||
               skeleton.is_below(each.first, node);
    });
}

}  // namespace tendril::app
