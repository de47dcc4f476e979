// Mouse input in the Rig lab: handles, drags, clicks, selection and the gizmo.
#include <algorithm>
#include <glm/common.hpp>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rig/controls.hpp"
#include "app/labs/rig/draw.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/rig_part.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/values.hpp"

namespace tendril::app {
namespace {

/// With more elements than this, only controls are handles.
constexpr std::size_t max_elements_with_handles = 400;

/// Adds the selected unit, so that selecting elements keeps it selected.
ArgumentList and_the_unit(const RigPart& part, ArgumentList arguments) {
    if (!part.selected.unit.empty()) arguments.push_back({"unit", part.selected.unit});
    return arguments;
}

const char* what_dragging_does(rig::ControlKind kind) {
    constexpr const char* words[] = {"drag moves it; when selected, it has arrows, rings and boxes",
                                     "drag moves it; when selected, it has arrows and planes",
                                     "drag a ring to turn it",
                                     "drag its knob along the rail",
                                     "click turns it on or off",
                                     "drag its knob within the rectangle"};
    return words[static_cast<std::size_t>(kind)];
}

/// The hierarchy as drawn, with nothing pending.
const rig::Hierarchy& elements_of(const Workspace& workspace) {
    return workspace.runtimes.of<RigRuntime>(rig_lab).resolved(workspace);
}

/// True if the rig still has the element.
bool is_there(const RigPart& part, PickId pick) {
    return pick >= 0 && picked_element(pick) < part.state->controls.size();
}

/// The handle at the element's drawing: a knob, a joint.
Handle element_handle(const Workspace& workspace, std::size_t i) {
    const RigPart& part = rig_part(workspace);
    const rig::Hierarchy& elements = elements_of(workspace);
    const rig::Element& element = part.rig.definition().elements[i];
    if (const auto shape = ControlShape::of(part, elements, i))
        return {element.name, element_pick(i), frame_of(shape->pose()), shape->drag(), shape->part()};
    const rig::Transform pose = *elements.known(part.rig.id(i), rig::Space::Global);
    return {element.name, element_pick(i), frame_of(pose), Drag::Nothing};
}

/// The gizmo's effect: none for float, bool and vector2d controls, which are dragged or clicked directly.
Drag gizmo_drag(const rig::Element& element) {
    const Drag turn = Drag::Position | Drag::Rotation;
    if (!element.control) return element.kind == rig::ElementKind::Null ? turn | Drag::Scale : turn;
    const Drag drags[] = {turn | Drag::Scale, Drag::Position, Drag::Rotation};
    const auto kind = static_cast<std::size_t>(element.control->kind);
    return kind < std::size(drags) ? drags[kind] : Drag::Nothing;
}

/// For a bone or a null: its pose before any unit has moved it, which a drag sets.
Handle input_handle(const Workspace& workspace, std::size_t i) {
    const RigPart& part = rig_part(workspace);
    const rig::Element& element = part.rig.definition().elements[i];
    const rig::Transform pose = part.rig.start_pose(part.state, i);
    return {element.name, element_pick(i), frame_of(pose), gizmo_drag(element)};
}

Bounds closely_around(const RigPart& part, const rig::Hierarchy& elements, std::size_t i) {
    const rig::ElementId id = part.rig.id(i);
    const auto at = glm::vec3(elements.known(id, rig::Space::Global)->translation);
    return {at, std::max(2.0f * static_cast<float>(bone_size(elements, id)), 0.4f)};
}

}  // namespace

std::vector<Handle> RigLab::handles(const Workspace& workspace) const {
    const RigPart& part = rig_part(workspace);
    const std::size_t count = part.state->controls.size();
    std::vector<Handle> handles;
    for (std::size_t i = 0; i < count; ++i)
        if (count <= max_elements_with_handles || part.rig.definition().elements[i].control)
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

/// A drag also solves while the simulation is paused, when no tick does.
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
    const bool on = std::get<bool>(part.state->controls[picked_element(pick)]);
    emit("rig.control.set", {{"name", element.name}, {"value", SharedJson(Json(!on))}});
    if (!workspace.clock.playing) emit("rig.solve");
}

void RigLab::click_more(const Workspace& workspace, PickId pick, Emit& emit) const {
    const RigPart& part = rig_part(workspace);
    if (!is_there(part, pick)) return;
    const rig::Element& element = part.rig.definition().elements[picked_element(pick)];
    emit("rig.select", {{"element", element.name}, {"add", true}});
}

/// Every element, even those without a handle.
std::vector<Handle> RigLab::selectable(const Workspace& workspace, std::size_t) const {
    std::vector<Handle> all;
    for (std::size_t i = 0; i < rig_part(workspace).state->controls.size(); ++i)
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
            {"Drag an arrow, a square, a ring or a box",
             "moves, turns or scales the selection; several are moved, or turned about the gizmo"}};
}

Bounds RigLab::bounds(const Workspace& workspace, bool selection_only) const {
    const RigPart& part = rig_part(workspace);
    const rig::Hierarchy& elements = elements_of(workspace);
    if (selection_only && part.selected.only_element())
        return closely_around(part, elements, *part.selected.only_element());
    if (part.state->controls.empty()) return {{0.0f, 1.0f, 0.0f}, 1.5f};
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
    for (std::size_t i = 0; i < part.state->controls.size(); ++i) {
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

// The gizmo of the selection, and dragging several elements with it.

namespace {

Drag drag_at(const RigPart& part, std::size_t i) {
    return gizmo_drag(part.rig.definition().elements[i]);
}

Handle gizmo_handle(const Workspace& workspace, std::size_t i) {
    const bool control = rig_part(workspace).rig.definition().elements[i].control.has_value();
    return control ? element_handle(workspace, i) : input_handle(workspace, i);
}

/// The element that shows the gizmo: the active one, or the last selected one that a gizmo can change.
std::optional<std::size_t> gizmo_element(const RigPart& part) {
    const Selection& selected = part.selected.elements;
    const auto held = [&](std::size_t i) { return drag_at(part, i) != Drag::Nothing; };
    if (!selected.active() || held(*selected.active())) return selected.active();
    const auto last = std::find_if(selected.all().rbegin(), selected.all().rend(), held);
    return last != selected.all().rend() ? std::optional(*last) : std::nullopt;
}

bool can(const RigPart& part, std::size_t i, Drag what) {
    const Drag changes = drag_at(part, i);
    // Rotation about another element moves along a circle.
    return has(changes, what) || (what == Drag::Rotation && has(changes, Drag::Position));
}

/// Marks the selected elements that have a dragged ancestor and move with it.
std::vector<bool> carried(const RigPart& part, Drag what) {
    const Selection& selected = part.selected.elements;
    const rig::Hierarchy& tree = part.state->elements;
    std::vector<bool> goes(tree.size()), below(tree.size());
    std::vector<std::size_t> at(tree.size());
    for (std::size_t i = 0; i < at.size(); ++i) at[part.rig.id(i).index] = i;
    for (const std::size_t i : from_the_roots(part.rig, tree)) {
        if (const rig::ElementId parent = tree.parent(part.rig.id(i))) below[i] = goes[at[parent.index]];
        goes[i] = below[i] || (selected.has(i) && can(part, i, what));
    }
    return below;
}

}  // namespace

std::optional<Handle> RigLab::gizmo(const Workspace& workspace) const {
    const RigPart& part = rig_part(workspace);
    const auto shown = gizmo_element(part);
    if (!shown || drag_at(part, *shown) == Drag::Nothing) return std::nullopt;
    Handle handle = gizmo_handle(workspace, *shown);
    if (!part.selected.elements.several()) return handle;
    handle.drag = Drag::Nothing;
    for (const std::size_t i : part.selected.elements.all())
        for (const Drag what : {Drag::Position, Drag::Rotation})
            if (can(part, i, what)) handle.drag = handle.drag | what;
    return handle;
}

Together RigLab::together(const Workspace& workspace, Drag what) const {
    const RigPart& part = rig_part(workspace);
    if (!part.selected.elements.several()) return {};
    Together together;
    std::vector<std::string> staying;
    const std::vector<bool> below = carried(part, what);
    for (const std::size_t i : part.selected.elements.all()) {
        if (below[i]) continue;
        if (can(part, i, what))
            together.handles.push_back(gizmo_handle(workspace, i));
        else
            staying.push_back(part.rig.definition().elements[i].name);
    }
    if (!staying.empty())
        together.staying = std::string(what == Drag::Rotation ? "Not turned" : "Not moved") +
                           " by it: " + name_list_text(staying) + ".";
    return together;
}

void RigLab::drag_together(const Workspace& workspace, const std::vector<Handle>& handles, Emit& emit) const {
    const RigPart& part = rig_part(workspace);
    Json controls = Json::array(), values = Json::array(), others = Json::array(), transforms = Json::array();
    for (const Handle& each : handles) {
        const std::size_t i = picked_element(each.pick);
        // The element may be gone: undo works during a drag.
        if (!is_there(part, each.pick) || part.rig.definition().elements[i].name != each.name) continue;
        const Handle now = gizmo_handle(workspace, i);
        HandleFrame to = now.frame;
        if (has(each.drag, Drag::Position)) to.position = each.frame.position;
        if (has(each.drag, Drag::Rotation)) to.rotation = each.frame.rotation;
        if (to == now.frame) continue;
        if (const auto shape = ControlShape::of(part, elements_of(workspace), i)) {
            controls.push_back(now.name);
            values.push_back(shape->value_at(now.frame, to));
        } else {
            others.push_back(now.name);
            transforms.push_back(changed_transform(transform_of(to), now.frame, to));
        }
    }
    if (!others.empty())
        emit.continuously("rig.element.set", {{"names", SharedJson(std::move(others))},
                                              {"space", "global"},
                                              {"transforms", SharedJson(std::move(transforms))}});
    if (!controls.empty())
        emit.continuously("rig.control.set", {{"names", SharedJson(std::move(controls))},
                                              {"values", SharedJson(std::move(values))}});
    if (!workspace.clock.playing) emit.continuously("rig.solve", {});
}

/// Also deselects a unit that is selected alone; a click on empty space does not.
void RigLab::deselect(const Workspace& workspace, Emit& emit) const {
    const RigSelection& selected = rig_part(workspace).selected;
    if (!selected.elements.empty() || !selected.unit.empty()) emit("rig.select");
}

}  // namespace tendril::app
