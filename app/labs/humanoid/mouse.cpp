// What the mouse takes hold of in the Humanoid lab, and what comes of it.
#include <algorithm>
#include <glm/common.hpp>

#include "app/labs/humanoid/character/figure.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"

namespace tendril::app {
namespace {

using humanoid::Effector;

bool has_body(const Workspace& workspace) {
    return humanoid_runtime(workspace).solvers.body(humanoid_part(workspace)) != nullptr;
}

/// At its target, or where it has none at its bone.
Handle effector_handle(const Workspace& workspace, Effector effector) {
    const HumanoidPart& part = humanoid_part(workspace);
    const humanoid::Placement& bone =
        shown_pose(workspace).placed[*part.node_of(humanoid::bone_of(effector))];
    Handle handle{humanoid::name(effector),
                  effector_pick(effector),
                  {glm::vec3(bone.position), glm::quat(bone.rotation())},
                  Drag::Position | Drag::Rotation};
    if (const auto& target = part.ik.target(effector)) {
        handle.frame.position = glm::vec3(target->position);
        if (target->rotation) handle.frame.rotation = glm::quat(*target->rotation);
    }
    return handle;
}

/// The effector whose bone is selected.
std::optional<Effector> selected_effector(const HumanoidPart& part) {
    const auto node = part.skeleton().find(part.selected);
    for (const Effector effector : all_effectors)
        if (node && part.node_of(humanoid::bone_of(effector)) == *node) return effector;
    return std::nullopt;
}

std::string effector_hint(const HumanoidPart& part, Effector effector) {
    const bool has_target = part.ik.target(effector).has_value();
    return title(effector) + (has_target ? ", which has a target: drag moves it. Double click lets it go."
                                         : ": drag gives it a target.");
}

}  // namespace

std::vector<Handle> HumanoidLab::handles(const Workspace& workspace) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const ShownPose& shown = shown_pose(workspace);
    std::vector<Handle> handles;
    if (has_body(workspace))
        for (const Effector effector : all_effectors) handles.push_back(effector_handle(workspace, effector));
    if (part.ik.look_at.on) handles.push_back({"look_at", look_pick, {glm::vec3(part.ik.look_at.target)}});
    for (std::size_t i = 0; i < part.skeleton().size(); ++i)
        handles.push_back({"node." + part.skeleton()[i].name,
                           node_pick(i),
                           {shown.point(i), glm::quat(shown.placed[i].rotation())},
                           Drag::Nothing});
    return handles;
}

std::optional<Handle> HumanoidLab::gizmo(const Workspace& workspace) const {
    const auto effector = selected_effector(humanoid_part(workspace));
    if (!effector || !has_body(workspace)) return std::nullopt;
    return effector_handle(workspace, *effector);
}

void HumanoidLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& to, Emit& emit) const {
    if (pick == look_pick) return emit.continuously("humanoid.look_at", {{"to", to.position}});
    const auto effector = picked_effector(pick);
    if (!effector || !has_body(workspace)) return;
    const Handle::Frame from = effector_handle(workspace, *effector).frame;
    ArgumentList arguments{{"effector", humanoid::name(*effector)}};
    if (to.position != from.position) arguments.push_back({"to", to.position});
    if (to.rotation != from.rotation) arguments.push_back({"rotation", to.rotation});
    emit.continuously("humanoid.target", arguments);
}

/// While a row of the bone map waits for a node, a click says which one it is.
void HumanoidLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const HumanoidPart& part = humanoid_part(workspace);
    auto& waiting = humanoid_runtime(workspace).panel.bone;
    const auto effector = picked_effector(pick);
    const auto node = effector ? part.node_of(humanoid::bone_of(*effector)) : picked_node(part, pick);
    if (pick == look_pick) return;
    if (!node) {
        waiting.reset();
        if (!part.selected.empty()) emit("humanoid.select");
        return;
    }
    const std::string& name = part.skeleton()[*node].name;
    if (waiting) {
        if (part.node_of(*waiting) != *node)
            emit("humanoid.map", {{"bone", humanoid::name(*waiting)}, {"node", name}});
        waiting.reset();
    }
    if (part.selected != name) emit("humanoid.select", {{"node", name}});
}

void HumanoidLab::double_click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const auto effector = picked_effector(pick);
    if (!effector || !humanoid_part(workspace).ik.target(*effector)) return click(workspace, pick, emit);
    emit("humanoid.target", {{"effector", humanoid::name(*effector)}, {"weight", 0}});
}

std::string HumanoidLab::hint(const Workspace& workspace, PickId pick) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const auto waiting = humanoid_runtime(workspace).panel.bone;
    const auto effector = picked_effector(pick);
    if (pick == look_pick) return "what the head looks at: drag moves it.";
    if (effector && !waiting) return effector_hint(part, *effector);
    const auto node = effector ? part.node_of(humanoid::bone_of(*effector)) : picked_node(part, pick);
    if (!node) return {};
    const std::string& name = part.skeleton()[*node].name;
    if (waiting) return name + ": click makes it the " + humanoid::name(*waiting) + ".";
    const auto bone = part.bone_of(*node);
    return name +
           (bone ? std::string(", the ") + humanoid::name(*bone) : std::string(", no bone of the body")) +
           ": click selects it.";
}

std::vector<MouseHelp> HumanoidLab::mouse_help() const {
    return {{"Drag of an orange ball", "gives hand, foot, head or hips a target"},
            {"Double click on an orange ball", "lets it go"}};
}

Bounds HumanoidLab::bounds(const Workspace& workspace, bool selection_only) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const ShownPose& shown = shown_pose(workspace);
    const float size = static_cast<float>(std::max(0.01, glm::distance(part.loaded->low, part.loaded->high)));
    if (const auto selected = part.skeleton().find(part.selected); selection_only && selected)
        return {shown.point(*selected), 0.12f * size};
    glm::vec3 low = shown.point(0), high = low;
    const auto take = [&](glm::vec3 at) {
        low = glm::min(low, at);
        high = glm::max(high, at);
    };
    for (std::size_t i = 0; i < part.skeleton().size(); ++i) take(shown.point(i));
    for (const auto& target : part.ik.targets)
        if (target) take(glm::vec3(target->position));
    if (part.ik.look_at.on) take(glm::vec3(part.ik.look_at.target));
    return bounds_of(low, high, 0.2f * size);
}

}  // namespace tendril::app
