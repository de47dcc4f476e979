// The Humanoid lab's part of --state.
#include <glm/trigonometric.hpp>

#include "app/fields/solver_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "app/labs/humanoid/panel.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

Json nodes_state(const HumanoidPart& part, const ShownPose& shown) {
    Json list = Json::array();
    const humanoid::Skeleton& skeleton = part.skeleton();
    for (std::size_t i = 0; i < skeleton.size(); ++i) {
        const std::int32_t parent = skeleton[i].parent;
        list.push_back(
            {{"name", skeleton[i].name},
             {"parent", parent < 0 ? Json(nullptr) : Json(skeleton[static_cast<std::size_t>(parent)].name)},
             {"position", dpoint(shown.placed[i].position)},
             {"rotation", dquaternion(shown.placed[i].rotation())}});
    }
    return list;
}

Json bones_state(const HumanoidPart& part, const ShownPose& shown) {
    Json bones = Json::object();
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const humanoid::BoneMatch& match = part.map->bones[i];
        if (match.node < 0) continue;
        const auto node = static_cast<std::size_t>(match.node);
        bones[humanoid::name(static_cast<Bone>(i))] = {
            {"node", part.skeleton()[node].name},
            {"confidence", match.confidence},
            {"position", dpoint(shown.placed[node].position)},
            {"rotation", dquaternion(shown.placed[node].rotation())}};
    }
    return bones;
}

/// The kept map's changes, or why it was ignored; null if there is none, or it is in use.
Json kept_map_state(const Workspace& workspace) {
    KeptMaps& maps = humanoid_runtime(workspace).kept_maps;
    if (const std::string& why = maps.refused(workspace); !why.empty()) return {{"refused", why}};
    const SavedMap* const map = maps.offered(workspace);
    if (map == nullptr) return nullptr;
    Json changes = Json::object();
    for (const Bone bone : bones_that_differ(*map, humanoid_part(workspace))) {
        const std::string& node = map->bones[static_cast<std::size_t>(bone)];
        changes[humanoid::name(bone)] = node.empty() ? Json(nullptr) : Json(node);
    }
    return {{"changes", std::move(changes)}};
}

Json notes_state(const HumanoidPart& part) {
    Json notes = part.loaded->character.sentences();
    if (const auto doubt = part.loaded->doubted_unit(*part.map)) notes.push_back(text(*doubt));
    if (part.playback.clip)
        if (const LoadedMotion* motion = motion_of(*part.loaded, *part.playback.clip))
            for (const std::string& each : motion->notes) notes.push_back(each);
    return notes;
}

Json character_state(const Workspace& workspace, const ShownPose& shown) {
    const HumanoidPart& part = humanoid_part(workspace);
    const Character& character = part.loaded->character;
    const auto root =
        root_positions.name(character.space.positions);  // without an OFFSET, there is no choice
    return Json{{"file", part.loaded->file},
                {"scale", character.scale},
                {"up", up_axes.name(character.space.up)},
                {"root_positions", character.root_offsets.empty() ? Json(nullptr) : Json(root)},
                {"nodes", nodes_state(part, shown)},
                {"bones", bones_state(part, shown)},
                {"unmatched", part.unmapped()},
                {"rest", humanoid::name(part.map->rest)},
                {"kept_map", kept_map_state(workspace)},
                {"t_pose", part.t_pose},
                {"notes", notes_state(part)}};
}

/// Metres between the end of a chain and its target; 0 if it has none.
double residual(const ShownPose& shown, Bone end) {
    for (const humanoid::Effector effector : all_effectors)
        if (humanoid::bone_of(effector) == end) return shown.residual(effector).value_or(0.0);
    return 0.0;
}

Json chains_state(const HumanoidPart& part, const ShownPose& shown) {
    Json list = Json::array();
    for (const BodyChain& chain : body_chains(*part.map)) {
        Json bones = Json::array(), active = Json::array();
        for (const Bone bone : chain.bones) {
            bones.push_back(humanoid::name(bone));
            if (shown.body && shown.body->at_limit[static_cast<std::size_t>(bone)])
                active.push_back(humanoid::name(bone));
        }
        list.push_back({{"layer", chain.layer},
                        {"bones", std::move(bones)},
                        {"end", humanoid::name(chain.end)},
                        {"residual", residual(shown, chain.end)},
                        {"active_limits", std::move(active)}});
    }
    return list;
}

Json targets_state(const HumanoidPart& part, const ShownPose& shown) {
    Json targets = Json::object();
    for (const humanoid::Effector effector : all_effectors) {
        const auto& target = part.ik.target(effector);
        if (!target) continue;
        Json& json = targets[humanoid::name(effector)] = save_fields(*target);
        json["residual"] = residual(shown, humanoid::bone_of(effector));
    }
    return targets;
}

Json range_json(const ik::Limit* limit) {
    return limit == nullptr ? Json(nullptr) : limit_json(*limit);
}

/// Rotation and range of the joint that the inspector shows; null if there is none.
Json joint_state(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown) {
    const SelectedJoints selected = selected_joints(part, solvers);
    const auto joint = selected.shown ? joint_now(part, solvers, shown, *selected.shown) : std::nullopt;
    if (!joint) return nullptr;
    return {{"bone", humanoid::name(*selected.shown)},
            {"limits", limits_from.name(joint->from)},
            {"up_deg", glm::degrees(joint->angles.up)},
            {"left_deg", glm::degrees(joint->angles.left)},
            {"twist_deg", glm::degrees(joint->angles.twist)},
            {"excess_deg", glm::degrees(joint->excess)},
            {"held", joint->held},
            {"adult", range_json(joint->adult)},
            {"clips", range_json(joint->clips)}};
}

Json balance_state(const HumanoidPart& part, const ShownPose& shown, Solvers& solvers) {
    Json json = save_fields(part.ik.balance);
    if (!shown.balance) return json;
    const humanoid::Support& support = shown.balance->support;
    json["stepping"] = part.ik_state.steps.stepping();
    json["centre"] = dpoint(shown.balance->centre);
    json["margin"] = support.count > 0 ? Json(shown.balance->margin) : Json(nullptr);
    json["text"] = balance_text(part, shown, solvers);
    if (const std::string why = why_no_balance(part, shown, solvers); !why.empty()) json["note"] = why;
    json["support"] = Json::array();
    for (std::size_t i = 0; i < support.count; ++i) json["support"].push_back(dpoint(support.corners[i]));
    return json;
}

Json body_state(const Workspace& workspace, const ShownPose& shown) {
    const HumanoidPart& part = humanoid_part(workspace);
    Solvers& solvers = humanoid_runtime(workspace).solvers;
    Json json{{"usable", solvers.body(part) != nullptr},    {"why_not", solvers.why_no_body(part)},
              {"limits", limits_from.name(part.ik.limits)}, {"joint", joint_state(part, solvers, shown)},
              {"self_collision", part.ik.self_collision},   {"targets", targets_state(part, shown)}};
    json["balance"] = balance_state(part, shown, solvers);
    for (const auto& [bone, from] : part.ik.joint_limits)
        json["joint_limits"][humanoid::name(bone)] = limits_from.name(from);
    if (shown.body) json["iterations"] = shown.body->iterations;
    if (shown.body && part.ik.self_collision) json["penetration"] = shown.body->penetration;
    return json;
}

Json feet_state(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown) {
    Json feet = Json::array();
    if (!shown.has_soles) return feet;
    for (std::size_t side = 0; side < 2; ++side) {
        Json foot{{"side", side == 0 ? "left" : "right"},
                  {"planted", shown.feet && shown.feet->feet[side].planted},
                  {"heel", dpoint(shown.soles[side].heel)},
                  {"toe", dpoint(shown.soles[side].toe)}};
        if (part.ik.foot_ik.on) {
            foot["left_alone"] = why_alone(part, shown, side);
            foot["why_in_air"] = why_in_air(part, shown, solvers, side);
        }
        feet.push_back(std::move(foot));
    }
    return feet;
}

Json ground_state(const GroundSetting& ground) {
    Json json = save_fields(ground);
    if (ground.kind == humanoid::GroundKind::Mesh) json["path"] = ground.mesh->path;
    return json;
}

Json hands_state(const HumanoidPart& part, const ShownPose& shown) {
    Json json = save_fields(part.ik.hand_ik);
    if (!shown.hands) return json;
    for (std::size_t hand = 0; hand < 2; ++hand)
        json[hand == 0 ? "left" : "right"] = {{"weight", shown.hands->hands[hand].weight},
                                              {"in_view", shown.hands->hands[hand].in_view}};
    return json;
}

Json look_state(const HumanoidPart& part, const ShownPose& shown) {
    Json json = save_fields(part.ik.look_at);
    if (!shown.look) return json;
    json["in_view"] = shown.look->in_view;
    json["left_deg"] = glm::degrees(shown.look->left);
    return json;
}

Json attachments_state(const HumanoidPart& part) {
    const NamedWorld& world = *part.attachments.world;
    Json list = Json::array();
    for (const Attachment& each : part.attachments.list) {
        const rope::Body& body = *world.find(each.name);
        Json positions = Json::array();
        for (std::size_t i = body.first; i < body.first + body.count; ++i)
            positions.push_back(dpoint(world.state().position[i]));
        const auto bone = part.bone_of(*part.skeleton().find(each.node));
        list.push_back({{"name", each.name},
                        {"kind", attachment_kinds.name(each.kind)},
                        {"bone", bone ? Json(humanoid::name(*bone)) : Json(nullptr)},
                        {"node", each.node},
                        {"row", body.row},
                        {"positions", std::move(positions)},
                        {"torn_edges", torn_edges(part.attachments, each)},
                        {"length_error", world.length_error(body)}});
    }
    return list;
}

Json springs_state(const Workspace& workspace, const ShownPose& shown) {
    const HumanoidPart& part = humanoid_part(workspace);
    const SpringChains& chains = humanoid_runtime(workspace).solvers.springs(part);
    Json list = Json::array();
    for (std::size_t i = 0; i < part.springs.size(); ++i) {
        const SpringSetting& each = part.springs[i];
        Json bones = Json::array();
        if (chains[i] != nullptr)
            for (const std::size_t node : chains[i]->bones()) bones.push_back(part.skeleton()[node].name);
        list.push_back(save_fields(each.options));
        list.back().update({{"node", each.node},
                            {"bones", std::move(bones)},
                            {"angle_deg", glm::degrees(shown.springs[i].angle)}});
        if (const NamedSpring* file = colliding(part, each))
            list.back()["colliders"] = file->colliders.size();
    }
    return list;
}

Json clip_state(const HumanoidPart& part) {
    const humanoid::Clip* clip = part.clip();
    if (clip == nullptr) return nullptr;
    Json json = save_fields(part.playback);
    json.update({{"name", clip->name}, {"duration", clip->duration}, {"pace", dpoint(part.playback.pace)}});
    return json;
}

}  // namespace

Json HumanoidLab::state(const Workspace& workspace) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const ShownPose& shown = shown_pose(workspace);
    return Json{{"lab", humanoid_lab},
                {"verdict", humanoid_verdict(workspace).text},
                {"character", character_state(workspace, shown)},
                {"body", body_state(workspace, shown)},
                {"chains", chains_state(part, shown)},
                {"clip", clip_state(part)},
                {"clips", names(part.loaded->clips(), [](const humanoid::Clip& clip) { return clip.name; })},
                {"feet", feet_state(part, humanoid_runtime(workspace).solvers, shown)},
                {"foot_ik", save_fields(part.ik.foot_ik)},
                {"hand_ik", hands_state(part, shown)},
                {"hold", hold_state(part, shown)},
                {"view", save_fields(part.view)},
                {"look_at", look_state(part, shown)},
                {"ground", ground_state(part.ik.ground)},
                {"springs", springs_state(workspace, shown)},
                {"curves", curves_state(part, humanoid_runtime(workspace).solvers, shown)},
                {"attachments", attachments_state(part)},
                {"wind", save_fields({wind_fields(), &part.attachments.world->settings()})},
                {"order", {"clip", "curves", "IK", "rig", "springs", "ropes"}},
                {"past", past_state(workspace, humanoid_past())},
                {"selected", active_name(part.selection, part.skeleton())},
                {"selection", names_of(part.selection, part.skeleton())}};
}

}  // namespace tendril::app
