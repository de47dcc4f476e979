// Mouse input in the Humanoid lab: handles, drags, clicks and selection.
#include <algorithm>
#include <glm/common.hpp>

#include "app/io/json_complete.hpp"
#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

using humanoid::Effector;

bool has_body(const Workspace& workspace) {
    return humanoid_runtime(workspace).solvers.body(humanoid_part(workspace)) != nullptr;
}

/// At the target or, without one, at the bone.
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

std::optional<Effector> effector_at(const HumanoidPart& part, std::size_t node) {
    for (const Effector effector : all_effectors)
        if (part.node_of(humanoid::bone_of(effector)) == node && !holds(part, effector)) return effector;
    return std::nullopt;
}

/// The effector with the gizmo: the active node's or, if it has none, that of the last node with one.
std::optional<Effector> gizmo_effector(const HumanoidPart& part) {
    const auto active = part.selection.active();
    if (!active) return std::nullopt;
    if (const auto effector = effector_at(part, *active)) return effector;
    std::optional<Effector> last;
    for (const std::size_t node : part.selection.all())
        if (const auto effector = effector_at(part, node)) last = effector;
    return last;
}

/// The clicked node, or the node of the clicked effector.
std::optional<std::size_t> clicked_node(const HumanoidPart& part, PickId pick) {
    const auto effector = picked_effector(pick);
    return effector ? part.node_of(humanoid::bone_of(*effector)) : picked_node(part, pick);
}

std::string effector_hint(const HumanoidPart& part, Effector effector) {
    const bool has_target = part.ik.target(effector).has_value();
    return title(effector) + (has_target ? ", which has a target: drag moves it, double click removes it."
                                         : ": drag gives it a target.");
}

}  // namespace

std::vector<Handle> HumanoidLab::handles(const Workspace& workspace) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const ShownPose& shown = shown_pose(workspace);
    std::vector<Handle> handles;
    if (has_body(workspace))
        for (const Effector effector : all_effectors)
            if (!holds(part, effector)) handles.push_back(effector_handle(workspace, effector));
    if (part.ik.hold) handles.push_back(hold_handle(*part.ik.hold, shown));
    if (part.ik.look_at.on)
        handles.push_back({"look_at", look_pick, {glm::vec3(part.ik.look_at.options.target)}});
    for (std::size_t i = 0; i < part.skeleton().size(); ++i)
        handles.push_back({"node." + part.skeleton()[i].name,
                           node_pick(i),
                           {shown.point(i), glm::quat(shown.placed[i].rotation())},
                           Drag::Nothing});
    for (Handle& each : curve_handles(part, humanoid_runtime(workspace).solvers, shown))
        handles.push_back(std::move(each));
    return handles;
}

/// Curves are not in handles(), but can be clicked.
std::optional<Handle> HumanoidLab::handle(const Workspace& workspace, PickId pick) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const auto curve = picked_curve(part, pick);
    if (!curve || curve->control) return Lab::handle(workspace, pick);
    const std::vector<glm::vec3> points =
        shown_curve(part, humanoid_runtime(workspace).solvers, shown_pose(workspace), curve->curve);
    const glm::vec3 at = ik::curve_point(points, part.curves[curve->curve].shape.options.kind, curve->at);
    return Handle{"curve", pick, {at}, Drag::Nothing};
}

std::optional<Handle> HumanoidLab::gizmo(const Workspace& workspace) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const auto effector = gizmo_effector(part);
    if (!has_body(workspace)) return std::nullopt;
    if (!effector)
        return part.ik.hold ? std::optional(hold_handle(*part.ik.hold, shown_pose(workspace))) : std::nullopt;
    return effector_handle(workspace, *effector);
}

Together HumanoidLab::together(const Workspace& workspace, Drag) const {
    const HumanoidPart& part = humanoid_part(workspace);
    if (!part.selection.several() || !has_body(workspace)) return {};
    Together together;
    std::vector<std::string> staying;
    for (const std::size_t node : part.selection.all()) {
        if (const auto effector = effector_at(part, node))
            together.handles.push_back(effector_handle(workspace, *effector));
        else
            staying.push_back(part.skeleton()[node].name);
    }
    if (!staying.empty())
        together.staying = "Not effectors, so they cannot have targets: " + name_list_text(staying) + ".";
    return together;
}

void HumanoidLab::drag_together(const Workspace& workspace, const std::vector<Handle>& handles,
                                Emit& emit) const {
    if (!has_body(workspace)) return;
    Json effectors = Json::array(), points = Json::array(), rotations = Json::array();
    bool turned = false;
    for (const Handle& each : handles) {
        const Effector effector = *picked_effector(each.pick);
        effectors.push_back(humanoid::name(effector));
        points.push_back(point(each.frame.position));
        rotations.push_back(dquaternion(glm::dquat(each.frame.rotation)));
        turned |= has(each.drag, Drag::Rotation);
    }
    ArgumentList arguments{{"effectors", SharedJson(std::move(effectors))},
                           {"points", SharedJson(std::move(points))}};
    if (turned) arguments.push_back({"rotations", SharedJson(std::move(rotations))});
    emit.continuously("humanoid.target", arguments);
}

void HumanoidLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& to, Emit& emit) const {
    if (pick == look_pick) return emit.continuously("humanoid.look_at", {{"to", to.position}});
    if (const auto curve = picked_curve(humanoid_part(workspace), pick))
        return drag_control(humanoid_part(workspace), humanoid_runtime(workspace).solvers,
                            shown_pose(workspace), *curve, to.position, emit);
    const auto& hold = humanoid_part(workspace).ik.hold;
    if (pick == hold_pick) return hold ? drag_hold(*hold, shown_pose(workspace), to, emit) : void();
    const auto effector = picked_effector(pick);
    if (!effector || !has_body(workspace)) return;
    const Handle::Frame from = effector_handle(workspace, *effector).frame;
    ArgumentList arguments{{"effector", humanoid::name(*effector)}};
    if (to.position != from.position) arguments.push_back({"to", to.position});
    if (to.rotation != from.rotation) arguments.push_back({"rotation", to.rotation});
    emit.continuously("humanoid.target", arguments);
}

/// While a row of the bone map waits for a node, a click picks that node.
void HumanoidLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const HumanoidPart& part = humanoid_part(workspace);
    auto& waiting = humanoid_runtime(workspace).panel.bone;
    const auto node = clicked_node(part, pick);
    if (pick == look_pick || pick == hold_pick) return;
    if (const auto curve = picked_curve(part, pick))
        return click_curve(part, humanoid_runtime(workspace).solvers, shown_pose(workspace), *curve, emit);
    if (!node) {
        waiting.reset();
        if (!part.selection.empty()) emit("humanoid.select");
        return;
    }
    if (waiting) return map_waiting_bone(part, waiting, static_cast<std::int32_t>(*node), emit);
    const std::string& name = part.skeleton()[*node].name;
    if (part.selection.active() != node || part.selection.several())
        emit("humanoid.select", {{"node", name}});
}

/// If a row waits for a node, only stops waiting; the selection stays.
void HumanoidLab::deselect(const Workspace& workspace, Emit& emit) const {
    auto& waiting = humanoid_runtime(workspace).panel.bone;
    if (!waiting) return click(workspace, no_pick, emit);
    waiting.reset();
}

void HumanoidLab::click_more(const Workspace& workspace, PickId pick, Emit& emit) const {
    const HumanoidPart& part = humanoid_part(workspace);
    if (const auto node = clicked_node(part, pick))
        emit("humanoid.select", {{"node", part.skeleton()[*node].name}, {"add", true}});
}

/// The visible nodes.
std::vector<Handle> HumanoidLab::selectable(const Workspace& workspace, std::size_t) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const bool helpers = helpers_setting().chosen(workspace.settings) == 0;
    const std::vector<bool> body = body_nodes(part),
                            springs = swinging_nodes(part, humanoid_runtime(workspace).solvers);
    std::vector<Handle> nodes = handles(workspace);
    std::erase_if(nodes, [&](const Handle& each) {
        const auto node = picked_node(part, each.pick);
        return !node || !(body[*node] || springs[*node] || helpers);
    });
    return nodes;
}

void HumanoidLab::select(const Workspace& workspace, const std::vector<PickId>& picks, bool add,
                         Emit& emit) const {
    const HumanoidPart& part = humanoid_part(workspace);
    Json nodes = Json::array();
    for (const PickId pick : picks)
        if (const auto node = picked_node(part, pick)) nodes.push_back(part.skeleton()[*node].name);
    if (!nodes.empty())
        emit("humanoid.select", {{"nodes", SharedJson(std::move(nodes))}, {"add", add}});
    else if (!add)
        click(workspace, no_pick, emit);
}

void HumanoidLab::double_click(const Workspace& workspace, PickId pick, Emit& emit) const {
    if (const auto curve = picked_curve(humanoid_part(workspace), pick))
        return remove_control(humanoid_part(workspace), *curve, emit);
    if (pick == hold_pick) return emit("humanoid.release");
    const auto effector = picked_effector(pick);
    if (!effector || !humanoid_part(workspace).ik.target(*effector)) return click(workspace, pick, emit);
    emit("humanoid.target", {{"effector", humanoid::name(*effector)}, {"weight", 0}});
}

std::string HumanoidLab::hint(const Workspace& workspace, PickId pick) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const auto waiting = humanoid_runtime(workspace).panel.bone;
    const auto effector = picked_effector(pick);
    if (pick == look_pick) return "The point that the head looks at. Drag to move it.";
    if (const auto curve = picked_curve(part, pick)) return curve_hint(part, *curve);
    if (pick == hold_pick && part.ik.hold)
        return std::string("The ") + held_kinds.title(part.ik.hold->kind) +
               ": drag moves it, double click releases it.";
    if (effector && !waiting) return effector_hint(part, *effector);
    const auto node = clicked_node(part, pick);
    if (!node) return {};
    if (waiting)
        return part.skeleton()[*node].name + ": click makes it the " + humanoid::name(*waiting) + ".";
    return part.titled(*node) + ": click selects it.";
}

std::vector<MouseHelp> HumanoidLab::mouse_help() const {
    return {{"Drag an orange ball", "gives hand, foot, head or hips a target"},
            {"Double click on an orange ball", "removes the target, or releases the object"},
            {"Curve: drag, click, double click", "moves, adds, removes a control point"},
            {"Drag an arrow, a square or a ring",
             "moves or turns the selected hands, feet, head and hips, or the held object"},
            {"Shift+click on a bone", "adds it to the selection, or takes it out"},
            {"Ctrl+drag on nothing", "draws a box that selects the nodes in it; with Shift it adds them"}};
}

namespace {

struct Box {
    glm::vec3 low, high;
    explicit Box(glm::vec3 at) : low(at), high(at) {}
    void take(const glm::vec3& at) { low = glm::min(low, at), high = glm::max(high, at); }
};

/// The figure's size at rest, metres.
float size_of(const HumanoidPart& part) {
    const RestBounds& rest = part.loaded->bounds;
    return static_cast<float>(std::max(0.01, glm::distance(rest.low, rest.high)));
}

/// Encloses its nodes, with its skin's margin at rest; not those that a walk leaves behind, such as its root.
Box figure_box(const HumanoidPart& part, const ShownPose& shown) {
    const LoadedCharacter& loaded = *part.loaded;
    const glm::vec3 hips = shown.point(part.node_of(humanoid::Bone::Hips).value_or(0));
    Box now(hips), rest(glm::vec3(loaded.rest[0].position));
    for (std::size_t i = 0; i < part.skeleton().size(); ++i) {
        if (glm::distance(shown.point(i), hips) < size_of(part)) now.take(shown.point(i));
        rest.take(glm::vec3(loaded.rest[i].position));
    }
    now.low -= glm::max(rest.low - glm::vec3(loaded.bounds.low), 0.0f);
    now.high += glm::max(glm::vec3(loaded.bounds.high) - rest.high, 0.0f);
    return now;
}

}  // namespace

Bounds figure_bounds(const Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    const Box box = figure_box(part, shown_pose(workspace));
    return bounds_of(box.low, box.high, 0.2f * size_of(part));
}

Bounds HumanoidLab::bounds(const Workspace& workspace, bool selection_only) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const ShownPose& shown = shown_pose(workspace);
    const std::vector<std::size_t>& selected = part.selection.all();
    if (selection_only && !selected.empty()) {
        Box box(shown.point(selected.front()));
        for (const std::size_t node : selected) box.take(shown.point(node));
        return bounds_of(box.low, box.high, 0.12f * size_of(part));
    }
    Box box = figure_box(part, shown);
    for (const auto& target : part.ik.targets)
        if (target) box.take(glm::vec3(target->position));
    if (part.ik.look_at.on) box.take(glm::vec3(part.ik.look_at.options.target));
    for (std::size_t i = 0; i < part.curves.size(); ++i)
        for (const glm::vec3& each : shown_curve(part, humanoid_runtime(workspace).solvers, shown, i))
            box.take(each);
    if (part.ik.hold) box.take(glm::vec3(part.ik.hold->asked(shown.hips).position));
    for (const glm::vec3& each : part.attachments.world->positions()) box.take(each);
    // A fixed view also shows where a clip leads, unless that would make the figure tiny.
    const auto hips = part.node_of(humanoid::Bone::Hips);
    if (hips && part.clip() != nullptr && !part.view.follow) {
        Playback end = part.playback;
        end.rounds = 0;
        const glm::vec3 stands = shown.point(*hips);
        for (const double time : {0.0, part.clip()->duration}) {
            end.time = time;
            std::vector<humanoid::Placement> placed(part.skeleton().size());
            humanoid::place(part.skeleton(), animated_pose(end, *part.loaded, hips), placed);
            const glm::vec3 way = glm::vec3(placed[*hips].position) - stands;
            const float farthest = 3.0f * size_of(part), far = glm::length(way);
            const glm::vec3 shown_way = way * (far > farthest ? farthest / far : 1.0f);
            box.take(box.low + shown_way), box.take(box.high + shown_way);
        }
    }
    return bounds_of(box.low, box.high, 0.2f * size_of(part));
}

}  // namespace tendril::app
