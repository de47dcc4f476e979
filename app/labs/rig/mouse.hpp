// Handles by which the mouse drags elements of a rig.
#pragma once

#include <cstddef>
#include <tendril/rig/rig.hpp>

#include "app/labs/lab.hpp"

namespace tendril::app {

struct RigPart;

/// Whether the rig still has the element.
bool is_there(const RigPart& part, PickId pick);
/// The elements as drawn, nothing pending.
const rig::Hierarchy& elements_of(const Workspace& workspace);

/// The handle at what is drawn of the element: a knob, a joint.
Handle element_handle(const Workspace& workspace, std::size_t i);
/// What the gizmo changes: nothing for float, bool and vector2d controls, which are dragged or clicked
/// directly.
Drag gizmo_drag(const rig::Element& element);
/// For a bone or a null: its pose before any unit has moved it, which is what a drag sets.
Handle input_handle(const Workspace& workspace, std::size_t i);

}  // namespace tendril::app
