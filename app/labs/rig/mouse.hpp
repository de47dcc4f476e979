// Where elements of a rig are taken hold of in the picture.
#pragma once

#include <cstddef>
#include <tendril/rig/rig.hpp>

#include "app/labs/lab.hpp"

namespace tendril::app {

struct RigPart;

/// Whether the rig still has the element.
bool is_there(const RigPart& part, PickId pick);
/// As they are in the picture, nothing pending.
const rig::Hierarchy& elements_of(const Workspace& workspace);

/// What is drawn of it: a knob, a joint.
Handle element_handle(const Workspace& workspace, std::size_t i);
/// What a gizmo changes of it. A knob on its rail, or in its rectangle, needs nothing more to be dragged by.
Drag gizmo_drag(const rig::Element& element);
/// Of a bone or a null, which is set where a solve begins with it, before any unit has moved it.
Handle input_handle(const Workspace& workspace, std::size_t i);

}  // namespace tendril::app
