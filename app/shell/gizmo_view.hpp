// The gizmos in the view: the open lab's, drawn over its picture, with its parts listed by name in --state;
// and the axis gizmo in the corner.
#pragma once

#include "app/labs/lab.hpp"
#include "app/shell/input.hpp"
#include "app/shell/shell.hpp"

namespace tendril::app {

class Pointer;

/// Also labels the drag with its size.
void show_gizmo(DrawList& list, const Lab& lab, const View& view, const Pointer& pointer);

/// The current drag of a part, for the status line: "Turning 35.2° about X."; empty without one.
std::string gizmo_hint(const Lab& lab, const Workspace& workspace, const Pointer& pointer);

/// A part that can be grabbed, "head.rotate_x", and a pixel where it can be.
struct NamedGrip {
    std::string name;
    glm::vec2 pixel;
};
/// The grips of the gizmo in this picture, without those entirely hidden by other parts.
std::vector<NamedGrip> gizmo_grips(const DrawList& drawn, const Lab& lab, const Workspace& workspace,
                                   const Camera& camera, float scale);

/// Draws the axis or ground plane that a held key constrains the drag to, through its start, and the distance
/// that the handle has moved from there.
void show_constraint(DrawList& list, const Lab& lab, const View& view, const Pointer& pointer,
                     const Input& input);
/// The same as text for the status line: "Moving 0.42 m along Z, 0.40 m nearer."; empty without such a drag.
std::string constraint_hint(const Lab& lab, const Workspace& workspace, const Camera& camera,
                            const Pointer& pointer, const Input& input);

// The axis gizmo in the view's corner, which shows the viewing direction. A click on an axis looks along it.

/// Pixels from the right edge of the view to the left edge of the gizmo; 0 if the view is too small for it.
float axis_gizmo_width(glm::vec2 pane, float scale);
/// Draws the gizmo and returns its rectangle, which is empty if the view is too small.
Rect show_axis_gizmo(const ShellFrame& frame, Emit& emit);

}  // namespace tendril::app
