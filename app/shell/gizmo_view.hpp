// The gizmo of the lab that is open: over its picture, and by the names of its parts in --state.
#pragma once

#include "app/labs/lab.hpp"
#include "app/shell/input.hpp"

namespace tendril::app {

class Pointer;

/// With a label that says how far it has been dragged.
void show_gizmo(DrawList& list, const Lab& lab, const View& view, const Pointer& pointer);

/// What a drag by a part has come to, for the status line: "Turning 35.2° about X."; empty without one.
std::string gizmo_hint(const Lab& lab, const Workspace& workspace, const Pointer& pointer);

/// A part that can be caught, and a pixel where it can: "head.rotate_x".
struct NamedGrip {
    std::string name;
    glm::vec2 pixel;
};
/// Of the gizmo in this picture; those that are wholly hidden by other parts are left out.
std::vector<NamedGrip> gizmo_grips(const DrawList& drawn, const Lab& lab, const Workspace& workspace,
                                   const Camera& camera, float scale);

/// The axis, or the plane of the ground, that a held key binds the drag to, through where it began.
void show_constraint(DrawList& list, const View& view, const Pointer& pointer, const Input& input);

}  // namespace tendril::app
