// What the mouse takes hold of in the Rig lab, and what comes of it.
#include <algorithm>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/control_shape.hpp"
#include "app/labs/rig/element_handle.hpp"
#include "app/labs/rig/figure.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/value_json.hpp"
#include "app/labs/rig/value_text.hpp"

namespace tendril::app {
namespace {

/// Bones and nulls have names among the handles where they are no more than this.
constexpr std::size_t max_named = 400;

/// Who selects elements leaves the unit selected that is.
ArgumentList and_the_unit(const RigPart& part, ArgumentList arguments) {
    if (!part.selected.unit.empty()) arguments.push_back({"unit", part.selected.unit});
    return arguments;
}

const char* what_dragging_does(rig::ControlKind kind) {
    switch (kind) {
        case rig::ControlKind::Transform:
            return "drag moves it; selected, it has arrows, rings and boxes";
        case rig::ControlKind::Position:
            return "drag moves it; selected, it has arrows and planes";
        case rig::ControlKind::Rotation:
            return "drag a ring to turn it";
        case rig::ControlKind::Float:
            return "drag its knob along the rail";
        case rig::ControlKind::Bool:
            return "click turns it on or off";
        case rig::ControlKind::Vector2d:
            break;
    }
    return "drag its knob within the rectangle";
}

Bounds closely_around(const RigPart& part, const rig::Hierarchy& elements, std::size_t i) {
    const rig::ElementId id = part.rig.id(i);
    const auto at = glm::vec3(elements.known(id, rig::Space::Global)->translation);
    return {at, std::max(2.0f * static_cast<float>(bone_size(elements, id)), 0.4f)};
}

}  // namespace

std::vector<Handle> RigLab::handles(const Workspace& workspace) const {
    const RigPart& part = rig_part(workspace);
    const std::size_t count = part.state.controls.size();
    std::vector<Handle> handles;
    for (std::size_t i = 0; i < count; ++i)
        if (count <= max_named || part.rig.definition().elements[i].control)
            handles.push_back(element_handle(workspace, i));
    return handles;
}

std::optional<Handle> RigLab::handle(const Workspace& workspace, PickId pick) const {
    if (!is_there(rig_part(workspace), pick)) return std::nullopt;
    Handle handle = element_handle(workspace, picked_element(pick));
    handle.pick = pick;
    if (const int ring = picked_ring(pick); ring >= 0)
        handle.part = static_cast<GizmoPart>(static_cast<int>(GizmoPart::RotateX) + ring);
    return handle;
}

/// While the simulation is paused no tick solves, so a drag does.
void RigLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& to, Emit& emit) const {
    const RigPart& part = rig_part(workspace);
    if (!is_there(part, pick)) return;
    const std::size_t i = picked_element(pick);
    const std::string& name = part.rig.definition().elements[i].name;
    if (const auto shape = ControlShape::of(part, elements_of(workspace), i)) {
        Json value = shape->value_at(frame_of(shape->pose()), to);
        if (value.empty() && value.is_object()) return;
        emit.continuously("rig.control.set", {{"name", name}, {"value", SharedJson(std::move(value))}});
    } else {
        Json changed = changed_transform(transform_of(to), input_handle(workspace, i).frame, to);
        if (changed.empty()) return;
        emit.continuously(
            "rig.element.set",
            {{"name", name}, {"space", "global"}, {"transform", SharedJson(std::move(changed))}});
    }
    if (!workspace.clock.playing) emit.continuously("rig.solve", {});
}

void RigLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const RigPart& part = rig_part(workspace);
    if (!is_there(part, pick)) {
        if (!part.selected.elements.empty()) emit("rig.select", and_the_unit(part, {}));
        return;
    }
    const rig::Element& element = part.rig.definition().elements[picked_element(pick)];
    if (part.selected.only_element() != picked_element(pick) || part.selected.unit_last)
        emit("rig.select", and_the_unit(part, {{"element", element.name}}));
    if (!element.control || element.control->kind != rig::ControlKind::Bool) return;
    const bool on = std::get<bool>(part.state.controls[picked_element(pick)]);
    emit("rig.control.set", {{"name", element.name}, {"value", SharedJson(Json(!on))}});
    if (!workspace.clock.playing) emit("rig.solve");
}

void RigLab::click_more(const Workspace& workspace, PickId pick, Emit& emit) const {
    const RigPart& part = rig_part(workspace);
    if (!is_there(part, pick)) return;
    const rig::Element& element = part.rig.definition().elements[picked_element(pick)];
    emit("rig.select", {{"element", element.name}, {"add", true}});
}

/// Every element, not only those that have a handle.
std::vector<Handle> RigLab::selectable(const Workspace& workspace) const {
    std::vector<Handle> all;
    for (std::size_t i = 0; i < rig_part(workspace).state.controls.size(); ++i)
        all.push_back(element_handle(workspace, i));
    return all;
}

void RigLab::select(const Workspace& workspace, const std::vector<PickId>& picks, bool add,
                    Emit& emit) const {
    const RigPart& part = rig_part(workspace);
    if (picks.empty()) {
        if (!add) click(workspace, no_pick, emit);
        return;
    }
    std::vector<std::size_t> inside;
    for (const PickId pick : picks) inside.push_back(picked_element(pick));
    emit("rig.select",
         and_the_unit(part, {{"elements", SharedJson(Json(names_of(part, inside)))}, {"add", add}}));
}

void RigLab::double_click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const RigPart& part = rig_part(workspace);
    if (!is_there(part, pick)) return click(workspace, pick, emit);
    const rig::Element& element = part.rig.definition().elements[picked_element(pick)];
    if (!element.control) return click(workspace, pick, emit);
    emit("rig.control.reset", {{"name", element.name}});
    if (!workspace.clock.playing) emit("rig.solve");
}

std::string RigLab::hint(const Workspace& workspace, PickId pick) const {
    const RigPart& part = rig_part(workspace);
    if (!is_there(part, pick)) return {};
    const std::size_t i = picked_element(pick);
    const rig::Element& element = part.rig.definition().elements[i];
    const auto shape = ControlShape::of(part, elements_of(workspace), i);
    if (!shape) {
        const bool selected = part.selected.only_element() == i;
        return element.name + " (" + rig::name(element.kind) + "): " +
               (selected ? "its gizmo sets the pose that every solve begins with."
                         : "click selects it and shows the gizmo of its pose.");
    }
    std::string text = element.name + " (" + control_title(shape->kind());
    if (const std::string value = shape->text(); !value.empty()) text += ", " + value;
    if (shape->at_limit()) text += ", at its limit";
    return text + "): " + what_dragging_does(shape->kind()) + ". Double click resets it.";
}

std::vector<Shortcut> RigLab::shortcuts() const {
    return {delete_shortcut("rig.remove_selected")};
}

std::vector<MouseHelp> RigLab::mouse_help() const {
    return {{"Shift+click on an element", "adds it to the selection, or takes it out"},
            {"Ctrl+drag on nothing", "draws a box that selects the elements in it; with Shift it adds them"},
            {"Double click on a control", "resets it to its initial value"},
            {"Drag of an arrow, a square, a ring or a box",
             "moves, turns or scales what is selected; several are moved, or turned about the gizmo"}};
}

Bounds RigLab::bounds(const Workspace& workspace, bool selection_only) const {
    const RigPart& part = rig_part(workspace);
    const rig::Hierarchy& elements = elements_of(workspace);
    if (selection_only && part.selected.only_element())
        return closely_around(part, elements, *part.selected.only_element());
    if (part.state.controls.empty()) return {{0.0f, 1.0f, 0.0f}, 1.5f};
    glm::vec3 low(1e30f), high(-1e30f);
    const auto take = [&](glm::vec3 at, float radius) {
        low = glm::min(low, at - radius);
        high = glm::max(high, at + radius);
    };
    if (selection_only && part.selected.elements.several()) {
        for (const std::size_t each : part.selected.elements.all()) {
            const Bounds around = closely_around(part, elements, each);
            take(around.centre, around.radius);
        }
        return bounds_of(low, high);
    }
    for (std::size_t i = 0; i < part.state.controls.size(); ++i) {
        const Bounds figure = figure_bounds(part, elements, i);
        take(figure.centre, std::max(figure.radius, 0.1f));
        const auto shape = ControlShape::of(part, elements, i);
        if (!shape || !shape->control().minimum || !shape->control().maximum) continue;
        const bool placed =
            shape->kind() != rig::ControlKind::Float && shape->kind() != rig::ControlKind::Bool;
        for (const glm::dvec3& end : {*shape->control().minimum, *shape->control().maximum})
            if (placed) take(glm::vec3(shape->placed(end)), 0.0f);
    }
    return bounds_of(low, high);
}

}  // namespace tendril::app
