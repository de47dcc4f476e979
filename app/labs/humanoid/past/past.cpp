// The Humanoid lab's last ten seconds: plots of joint rotations or effector errors, poses, incidents.
#include "app/labs/humanoid/draw.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/io/text.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "app/labs/humanoid/past/flips.hpp"
#include "app/labs/kit/limit_shape.hpp"
#include "app/labs/kit/past.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using humanoid::Effector;

const PastPose& pose_of(const Workspace& workspace, const SharedPart& part) {
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    runtime.past.trim(workspace.rewind);
    return runtime.past.of(part, [&] {
        const HumanoidPart& then = part_as<HumanoidPart>(part);
        const bool present = part == workspace.document.parts().at(humanoid_lab);
        IkState state = then.ik_state;
        const ShownPose shown =
            present ? runtime.shown(workspace) : solve_pose(then, runtime.solvers, 0.0, state);
        PastPose pose;
        pose.nodes.reserve(shown.placed.size());
        for (const humanoid::Placement& each : shown.placed)
            pose.nodes.push_back({glm::vec3(each.position), glm::quat(each.rotation())});
        for (const Effector each : all_effectors) {
            const auto left = then.ik.target(each) ? shown.residual(each) : std::nullopt;
            pose.left[static_cast<std::size_t>(each)] = static_cast<float>(left.value_or(no_value));
        }
        return pose;
    });
}

/// The selected effector, if it has a target.
std::optional<Effector> selected_effector(const HumanoidPart& part) {
    for (const Effector each : all_effectors)
        if (part.ik.target(each) && part.node_of(humanoid::bone_of(each)) == part.selection.active())
            return each;
    return std::nullopt;
}

/// The error of an effector, or the largest one if none is given.
double error_of(const PastPose& pose, std::optional<Effector> effector) {
    if (effector) return static_cast<double>(pose.left[static_cast<std::size_t>(*effector)]);
    float farthest = -1.0f;
    for (const float each : pose.left)
        if (each > farthest) farthest = each;  // false for NaN
    return farthest >= 0.0f ? static_cast<double>(farthest) : no_value;
}

/// The placements of two nodes, in a list of all nodes.
std::vector<humanoid::Placement> placed(const PastPose& pose, std::size_t node,
                                        std::optional<std::size_t> other) {
    std::vector<humanoid::Placement> all(pose.nodes.size());
    for (const std::optional<std::size_t> each : {std::optional(node), other})
        if (each)
            all[*each] = {glm::mat3_cast(glm::normalize(glm::dquat(pose.nodes[*each].rotation))),
                          glm::dvec3(pose.nodes[*each].position)};
    return all;
}

/// A bone turns relative to the previous bone of the body, from the T-pose; any other node relative to its
/// parent, from the rest pose.
JointTurn turn_of(const HumanoidPart& part, Solvers& solvers, const PastPose& pose, std::size_t node) {
    const auto bone = part.bone_of(node);
    const humanoid::BodyJoints* const joints = bone ? solvers.limits(part).joints() : nullptr;
    if (joints != nullptr) {
        const auto parent = joints->parent(*bone);
        const auto then = placed(pose, node, parent ? part.node_of(*parent) : std::nullopt);
        return joint_turn(joints->turn(*bone, then), joints->direction(*bone));
    }
    const humanoid::Skeleton& skeleton = part.skeleton();
    const std::int32_t parent = skeleton[node].parent;
    const auto above = parent < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(parent));
    const auto local = [&](const std::vector<humanoid::Placement>& all) {
        const glm::dquat own = all[node].rotation();
        return above ? glm::conjugate(all[*above].rotation()) * own : own;
    };
    const std::vector<humanoid::Placement>& rest = part.loaded->rest;
    glm::dvec3 along(0.0);
    for (const std::int32_t child : skeleton.children(node))
        along += rest[static_cast<std::size_t>(child)].position - rest[node].position;
    along = glm::conjugate(rest[node].rotation()) * along;
    return joint_turn(glm::conjugate(local(rest)) * local(placed(pose, node, above)),
                      glm::length(along) > 1e-9 ? along : glm::dvec3(0.0, 1.0, 0.0));
}

std::size_t plotted_node(const HumanoidPart& part) {
    if (part.selection.active()) return *part.selection.active();
    return part.node_of(Bone::LeftLowerArm).value_or(0);
}

std::function<bool(const SharedPart&)> known_to(const Workspace& workspace) {
    return [&past = humanoid_runtime(workspace).past](const SharedPart& part) { return past.has(part); };
}

/// The error of the selected effector or, without one, the one farthest from its target.
PastCurve error_curve(const Workspace& workspace) {
    const HumanoidPart& now = humanoid_part(workspace);
    const auto effector = selected_effector(now);
    return {.name = effector ? title(*effector) + " to target" : "worst effector to target",
            .unit = "m",
            .lowest_range = 0.01f * static_cast<float>(now.loaded->height()),
            .missing = "No effector had a target: drag an orange ball.",
            .value = [&workspace, effector](
                         const SharedPart& part) { return error_of(pose_of(workspace, part), effector); },
            .at_hand = known_to(workspace)};
}

/// The rotation of the active node or, if there is none, the left elbow.
PastCurve turn_curve(const Workspace& workspace, const char* what, double JointTurn::*number) {
    const HumanoidPart& now = humanoid_part(workspace);
    const std::string node = now.skeleton()[plotted_node(now)].name;
    const std::string called = now.called(plotted_node(now));
    return {.name = what + called,
            .missing = "The character had no " + called + " then.",
            .value =
                [&workspace, number, node](const SharedPart& part) {
                    const auto& then = part_as<HumanoidPart>(part);
                    const auto at = then.skeleton().find(node);
                    if (!at) return no_value;
                    return turn_of(then, humanoid_runtime(workspace).solvers, pose_of(workspace, part), *at).*
                           number;
                },
            .at_hand = known_to(workspace)};
}

bool same_character(const Part& then, const Part& now) {
    return part_as<HumanoidPart>(then).loaded == part_as<HumanoidPart>(now).loaded;
}

/// A line for each bone of the body, as displayed at that moment.
PoseLines lines_of(const Workspace& workspace, const SharedPart& part) {
    const HumanoidPart& then = part_as<HumanoidPart>(part);
    const PastPose& pose = pose_of(workspace, part);
    const std::vector<bool> body = body_nodes(then),
                            springs = swinging_nodes(then, humanoid_runtime(workspace).solvers);
    const auto at = [&](std::size_t node) { return pose.nodes[node].position; };
    PoseLines lines;
    for (std::size_t i = 0; i < then.skeleton().size(); ++i) {
        if (!body[i] && !springs[i]) continue;
        for (const std::int32_t each : then.skeleton().children(i))
            if (const auto child = static_cast<std::size_t>(each);
                (body[child] || springs[i]) && glm::distance(at(i), at(child)) > 1e-5f)
                lines.emplace_back(at(i), at(child));
    }
    return lines;
}

// Incidents: flipped bones, joints at their limits, effectors that fell short of their targets.

/// The settings without the poses of targets and of the held object.
IkSettings without_places(IkSettings settings) {
    for (auto& target : settings.targets)
        if (target) target = humanoid::BodyTarget{.effector = target->effector, .weight = target->weight};
    settings.look_at.options.target = glm::dvec3(0.0);
    if (settings.hold) settings.hold->position = {}, settings.hold->rotation = {1.0, 0.0, 0.0, 0.0};
    return settings;
}

/// True if both are the same character under the same settings: only time passed and targets moved.
bool comparable(const HumanoidPart& was, const HumanoidPart& is) {
    const Playback &before = was.playback, &after = is.playback;
    const bool plays = before.playing || (before.time == after.time && before.rounds == after.rounds);
    return was.loaded == is.loaded && (was.map == is.map || *was.map == *is.map) &&
           before.clip == after.clip && before.in_place == after.in_place && before.pace == after.pace &&
           plays && was.t_pose == is.t_pose && was.springs == is.springs && was.curves == is.curves &&
           without_places(was.ik) == without_places(is.ik);
}

void add_flips(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers,
               std::vector<Incident>& incidents) {
    for (const BodyFlip& flip : body_flips(was, is, solvers))
        incidents.push_back({.kind = Incident::Kind::Flip,
                             .joint = flip.node,
                             .name = humanoid::name(flip.bone),
                             .degrees = static_cast<float>(glm::degrees(flip.radians)),
                             .cause = flip.cause});
}

void add_limits(const HumanoidMoment& was, const HumanoidMoment& is, std::vector<Incident>& incidents) {
    if (!was.shown.body || !is.shown.body) return;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        if (was.shown.body->at_limit[i] || !is.shown.body->at_limit[i]) continue;
        const auto bone = static_cast<humanoid::Bone>(i);
        const std::string name = humanoid::name(bone);
        incidents.push_back({.kind = Incident::Kind::Limit,
                             .joint = *is.part.node_of(bone),
                             .name = name,
                             .cause = name + " reached its limit: the joint turns no further that way"});
    }
}

/// Metres between an effector and its target; empty if it need not get there, as while a hand is blended.
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
                             .cause = name + " fell short of its target: " + length_text(*after) + " left"});
    }
}

/// Reports an arm that jumped while holding the object, if no bone counts as flipped.
void add_hold_jump(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers,
                   std::vector<Incident>& incidents) {
    if (!was.shown.hold || !is.shown.hold || !incidents.empty()) return;
    IkState state = is.part.ik_state;
    state.hold = was.part.ik_state.hold;  // to compare with
    const ShownPose again = solve_pose(is.part, solvers, 0.0, state);
    if (!again.hold || !again.hold->jumped) return;
    const auto way = [&](humanoid::Bone bone) {
        const std::size_t node = *is.part.node_of(bone);
        return glm::distance(was.shown.placed[node].position, is.shown.placed[node].position);
    };
    const bool left = way(humanoid::Bone::LeftLowerArm) > way(humanoid::Bone::RightLowerArm);
    const humanoid::Bone elbow = left ? humanoid::Bone::LeftLowerArm : humanoid::Bone::RightLowerArm;
    incidents.push_back({.kind = Incident::Kind::Jump,
                         .joint = *is.part.node_of(elbow),
                         .name = humanoid::name(elbow),
                         .cause = std::string("the ") + (left ? "left" : "right") +
                                  " arm jumped to another pose that holds the object"});
}

/// Reports joints that jump to another crossing when a curve's points change.
void add_curve_jumps(const HumanoidPart& was, const HumanoidPart& is, Solvers& solvers,
                     std::vector<Incident>& incidents) {
    if (was.loaded != is.loaded || was.curves == is.curves) return;
    const BentChains& chains = solvers.curves(is);
    for (std::size_t i = 0; i < is.curves.size(); ++i) {
        const BoneCurve& each = is.curves[i];
        const auto same = std::ranges::find(was.curves, each.first, &BoneCurve::first);
        if (!each.jumped || !chains[i] || same == was.curves.end() || same->shape.points == each.shape.points)
            continue;
        const std::size_t node = chains[i]->nodes()[*each.jumped];
        const std::string& name = is.skeleton()[node].name;
        incidents.push_back({.kind = Incident::Kind::Jump,
                             .joint = node,
                             .name = name,
                             .cause = name + " jumped to another crossing of its curve",
                             .cure = "Open that bend."});
    }
}

std::vector<Incident> incidents_of(const Workspace& workspace, const Part& before, const Part& after) {
    const auto &was_part = part_as<HumanoidPart>(before), &is_part = part_as<HumanoidPart>(after);
    std::vector<Incident> incidents;
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    add_curve_jumps(was_part, is_part, runtime.solvers, incidents);
    if (!comparable(was_part, is_part)) return incidents;
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
    add_flips(was, is, runtime.solvers, incidents);
    add_hold_jump(was, is, runtime.solvers, incidents);
    add_limits(was, is, incidents);
    add_short_effectors(was, is, incidents);
    runtime.reviewed = std::move(second);
    return incidents;
}

}  // namespace

const Past& humanoid_past() {
    static const Past past{
        .lab = humanoid_lab,
        .what = "character",
        .probes = {{"error", "effector to target", error_curve},
                   {"swing", "swing of a joint",
                    [](const Workspace& w) { return turn_curve(w, "swing of ", &JointTurn::swing); }},
                   {"twist", "twist of a joint",
                    [](const Workspace& w) { return turn_curve(w, "twist of ", &JointTurn::twist); }}},
        .plot_help =
            "Plotted below the scene over the last ten seconds: how far the selected "
            "effector is from its target, or how far the selected joint is turned from the T-pose",
        .ghosts_help = "Shows the body's pose at every half second",
        .pose = lines_of,
        .same_joints = same_character,
        .incidents = incidents_of};
    return past;
}

void forget_past_poses(const Workspace& workspace) {
    const Past& past = humanoid_past();
    const bool shown = past.plot().chosen(workspace.settings) > 0 || past.shows_ghosts(workspace.settings);
    if (!shown && !workspace.ui.incident) humanoid_runtime(workspace).past.clear();
}

// The body before an incident, over the current one.

void draw_humanoid_incident(const View& view, const ShownPose& shown, DrawList& list) {
    const auto& incident = view.workspace.ui.incident;
    if (!incident) return;
    const HumanoidPart& part = humanoid_part(view.workspace);
    const std::shared_ptr<const Part> before = view.workspace.around(*incident).before;
    const auto was = std::dynamic_pointer_cast<const HumanoidPart>(before);
    if (!was || was->loaded != part.loaded || incident->joint >= part.skeleton().size()) return;
    const PoseLines lines = lines_of(view.workspace, before);
    const glm::vec4 ghost = faded(view.palette, view.palette.ghost, 0.9f);
    if (lines.size() <= max_ghost_lines)
        for (const auto& [from, to] : lines)
            list.line(from, to, 2.5f * view.scale, ghost).layer = Layer::Overlay;
    const glm::vec3 at = shown.point(incident->joint);
    if (incident->kind == Incident::Kind::Flip) {
        IkState state = was->ik_state;
        const ShownPose first = solve_pose(*was, humanoid_runtime(view.workspace).solvers, 0.0, state);
        for (const std::int32_t each : part.skeleton().children(incident->joint))
            if (const auto child = static_cast<std::size_t>(each); part.bone_of(child))
                draw_turn(view, first.point(child), shown.point(child), at, list);
    }
    draw_incident_mark(view, *incident, at, list);
}

}  // namespace tendril::app
