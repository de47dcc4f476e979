#include "app/labs/rig/element_handle.hpp"

#include "app/labs/rig/control_shape.hpp"
#include "app/labs/rig/figure.hpp"
#include "app/labs/rig/rig_part.hpp"
#include "app/labs/rig/rig_runtime.hpp"

namespace tendril::app {

const rig::Hierarchy& elements_of(const Workspace& workspace) {
    return workspace.runtimes.of<RigRuntime>(rig_lab).resolved(workspace);
}

bool is_there(const RigPart& part, PickId pick) {
    return pick >= 0 && picked_element(pick) < part.state.controls.size();
}

Handle element_handle(const Workspace& workspace, std::size_t i) {
    const RigPart& part = rig_part(workspace);
    const rig::Hierarchy& elements = elements_of(workspace);
    const rig::Element& element = part.rig.definition().elements[i];
    if (const auto shape = ControlShape::of(part, elements, i))
        return {element.name, element_pick(i), frame_of(shape->pose()), shape->drag(), shape->part()};
    const rig::Transform pose = *elements.known(part.rig.id(i), rig::Space::Global);
    return {element.name, element_pick(i), frame_of(pose), Drag::Nothing};
}

Drag gizmo_drag(const rig::Element& element) {
    const Drag turn = Drag::Position | Drag::Rotation;
    if (!element.control) return element.kind == rig::ElementKind::Null ? turn | Drag::Scale : turn;
    switch (element.control->kind) {
        case rig::ControlKind::Transform:
            return turn | Drag::Scale;
        case rig::ControlKind::Position:
            return Drag::Position;
        case rig::ControlKind::Rotation:
            return Drag::Rotation;
        default:
            return Drag::Nothing;
    }
}

Handle input_handle(const Workspace& workspace, std::size_t i) {
    const RigPart& part = rig_part(workspace);
    const rig::Element& element = part.rig.definition().elements[i];
    const rig::Transform pose = part.rig.start_pose(part.state, i);
    return {element.name, element_pick(i), frame_of(pose), gizmo_drag(element)};
}

}  // namespace tendril::app
