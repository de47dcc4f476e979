// The gizmo of what is selected in a rig, and what of several it drags at once.
#include <algorithm>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/name_list.hpp"
#include "app/labs/rig/control_shape.hpp"
#include "app/labs/rig/element_handle.hpp"
#include "app/labs/rig/figure.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_lab.hpp"

namespace tendril::app {
namespace {

Drag drag_at(const RigPart& part, std::size_t i) {
    return gizmo_drag(part.rig.definition().elements[i]);
}

Handle gizmo_handle(const Workspace& workspace, std::size_t i) {
    const bool control = rig_part(workspace).rig.definition().elements[i].control.has_value();
    return control ? element_handle(workspace, i) : input_handle(workspace, i);
}

/// Of what a gizmo can take hold of, the active one, or else the last.
std::optional<std::size_t> gizmo_element(const RigPart& part) {
    const Selection& selected = part.selected.elements;
    const auto held = [&](std::size_t i) { return drag_at(part, i) != Drag::Nothing; };
    if (!selected.active() || held(*selected.active())) return selected.active();
    const auto last = std::find_if(selected.all().rbegin(), selected.all().rend(), held);
    return last != selected.all().rend() ? std::optional(*last) : std::nullopt;
}

bool can(const RigPart& part, std::size_t i, Drag what) {
    const Drag changes = drag_at(part, i);
    // What turns about another one goes round it.
    return has(changes, what) || (what == Drag::Rotation && has(changes, Drag::Position));
}

/// Which of the selected are below another one that is dragged, and so go with it.
std::vector<bool> carried(const RigPart& part, Drag what) {
    const Selection& selected = part.selected.elements;
    const rig::Hierarchy& tree = part.state.elements;
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
        // What was caught may have gone since: a drag can be undone while it lasts.
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

/// A unit alone too, which a click on nothing leaves.
void RigLab::deselect(const Workspace& workspace, Emit& emit) const {
    const RigSelection& selected = rig_part(workspace).selected;
    if (!selected.elements.empty() || !selected.unit.empty()) emit("rig.select");
}

}  // namespace tendril::app
