// How a joint is turned, or how far an effector is from its target, over the last ten seconds; and the poses
// of them.
#include "app/labs/humanoid/past/past.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "app/labs/humanoid/character/figure.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "app/labs/kit/joint_turn.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using humanoid::Effector;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

enum class Number { Error, Swing, Twist };  // in the order of humanoid_past()

const HumanoidPart& humanoid_of(const SharedPart& part) {
    return dynamic_cast<const HumanoidPart&>(*part);
}

const PastPose& pose_of(const Workspace& workspace, const SharedPart& part) {
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    runtime.past.trim(workspace.rewind);
    return runtime.past.of(part, [&] {
        const HumanoidPart& then = humanoid_of(part);
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
            pose.left[static_cast<std::size_t>(each)] = static_cast<float>(left.value_or(nothing));
        }
        return pose;
    });
}

/// The one that is selected and has a target; nothing where that is none.
std::optional<Effector> selected_effector(const HumanoidPart& part) {
    for (const Effector each : all_effectors)
        if (part.ik.target(each) && part.node_of(humanoid::bone_of(each)) == part.selection.active())
            return each;
    return std::nullopt;
}

/// Without one of the farthest of all.
double error_of(const PastPose& pose, std::optional<Effector> effector) {
    if (effector) return static_cast<double>(pose.left[static_cast<std::size_t>(*effector)]);
    float farthest = -1.0f;
    for (const float each : pose.left)
        if (each > farthest) farthest = each;  // not where it is NaN
    return farthest >= 0.0f ? static_cast<double>(farthest) : nothing;
}

/// Of two nodes, as a list of all has them.
std::vector<humanoid::Placement> placed(const PastPose& pose, std::size_t node,
                                        std::optional<std::size_t> other) {
    std::vector<humanoid::Placement> all(pose.nodes.size());
    for (const std::optional<std::size_t> each : {std::optional(node), other})
        if (each)
            all[*each] = {glm::mat3_cast(glm::normalize(glm::dquat(pose.nodes[*each].rotation))),
                          glm::dvec3(pose.nodes[*each].position)};
    return all;
}

/// Of a bone from the T-pose, against the bone before it in the body; of any other node within its parent,
/// from the rest pose.
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

PastCurve error_curve(const Workspace& workspace) {
    const HumanoidPart& now = humanoid_part(workspace);
    const auto effector = selected_effector(now);
    const std::string name = effector ? title(*effector) + " to target" : "farthest effector to target";
    return {.name = name,
            .of = name,
            .unit = "m",
            .lowest_range = 0.01f * static_cast<float>(now.loaded->height()),
            .missing = "No effector had a target: drag an orange ball.",
            .value = [&workspace, effector](
                         const SharedPart& part) { return error_of(pose_of(workspace, part), effector); },
            .at_hand = known_to(workspace)};
}

}  // namespace

PastView humanoid_past() {
    return past_view(
        humanoid_lab, "character",
        {{"error", "effector to target"}, {"swing", "swing of a joint"}, {"twist", "twist of a joint"}},
        [](const Part& then, const Part& now) {
            return dynamic_cast<const HumanoidPart&>(then).loaded ==
                   dynamic_cast<const HumanoidPart&>(now).loaded;
        });
}

std::optional<PastCurve> humanoid_past_curve(const Workspace& workspace) {
    const PastView view = humanoid_past();
    if (!view.plots(workspace.settings)) return std::nullopt;
    const auto what = static_cast<Number>(view.chosen(workspace.settings));
    if (what == Number::Error) return error_curve(workspace);
    const HumanoidPart& now = humanoid_part(workspace);
    const std::string& node = now.skeleton()[plotted_node(now)].name;
    const std::string name = (what == Number::Swing ? "swing of " : "twist of ") + node;
    return PastCurve{.name = name,
                     .of = name,
                     .missing = "The character had no " + node + " then.",
                     .value =
                         [&workspace, what, node](const SharedPart& part) {
                             const HumanoidPart& then = humanoid_of(part);
                             const auto at = then.skeleton().find(node);
                             if (!at) return nothing;
                             const JointTurn turn = turn_of(then, humanoid_runtime(workspace).solvers,
                                                            pose_of(workspace, part), *at);
                             return what == Number::Swing ? turn.swing : turn.twist;
                         },
                     .at_hand = known_to(workspace)};
}

void forget_past_poses(const Workspace& workspace) {
    const PastView view = humanoid_past();
    const bool shown = view.plots(workspace.settings) || view.shows_ghosts(workspace.settings);
    if (!shown && !workspace.ui.incident) humanoid_runtime(workspace).past.clear();
}

PoseLines humanoid_lines(const Workspace& workspace, const SharedPart& part) {
    const HumanoidPart& then = humanoid_of(part);
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

}  // namespace tendril::app
