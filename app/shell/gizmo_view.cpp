#include "app/shell/gizmo_view.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "app/document/text.hpp"
#include "app/shell/pointer.hpp"
#include "app/view/picking.hpp"

namespace tendril::app {
namespace {

/// The dragged handle in its current state: the gizmo's, or one drawn by the lab.
std::optional<Handle> dragged_handle(const Lab& lab, const Workspace& workspace, const Pointer& pointer) {
    return pointer.drags_gizmo() ? lab.shown_gizmo(workspace) : lab.handle(workspace, pointer.dragged());
}

/// Whether to report the drag: labs report moves of their own handles, but not their rotation.
bool reports_drag(const Pointer& pointer) {
    const GizmoDrag* drag = pointer.dragged_part();
    return drag != nullptr && (pointer.drags_gizmo() || changed_by(drag->part()) == Drag::Rotation);
}

/// The hint for a hovered part when several handles are selected.
std::string together_hint(const Together& together, Drag what) {
    if (together.handles.size() < 2) return together.staying;
    const std::string count = std::to_string(together.handles.size());
    const std::string text = what == Drag::Rotation ? "Drag turns all " + count + " about this point."
                                                    : "Drag moves all " + count + " by the same amount.";
    return text + (together.staying.empty() ? "" : " " + together.staying);
}

}  // namespace

void show_gizmo(DrawList& list, const Lab& lab, const View& view, const Pointer& pointer) {
    const auto handle = lab.shown_gizmo(view.workspace);
    const bool dragging = pointer.dragged() != no_pick;
    if (handle && (!dragging || pointer.drags_gizmo())) {
        draw_gizmo(list, {handle->frame, handle->drag, view.scale, handle->pick}, view.camera, view.palette,
                   pointer.hovered_part(), pointer.dragged_part());
    }
    if (!reports_drag(pointer)) return;
    if (const auto now = dragged_handle(lab, view.workspace, pointer)) {
        list.labels.push_back({.at = now->frame.position,
                               .clearance = 26.0f * view.scale,
                               .text = pointer.dragged_part()->text(now->frame),
                               .colour = view.palette.text,
                               .rank = 100});
    }
}

std::string gizmo_hint(const Lab& lab, const Workspace& workspace, const Pointer& pointer) {
    if (const auto part = pointer.hovered_part(); part && !pointer.busy())
        return together_hint(lab.together(workspace, changed_by(*part)), changed_by(*part));
    if (!reports_drag(pointer)) return {};
    const auto now = dragged_handle(lab, workspace, pointer);
    if (!now) return {};
    const GizmoDrag& drag = *pointer.dragged_part();
    const Drag what = changed_by(drag.part());
    const char* verb = what == Drag::Position ? "Moving " : what == Drag::Rotation ? "Turning " : "Scaling ";
    const std::size_t count = pointer.dragged_count();
    const std::string staying = pointer.drags_gizmo() ? lab.together(workspace, what).staying : std::string();
    return verb + (count > 1 ? std::to_string(count) + " at once: " : std::string()) + drag.text(now->frame) +
           "." + (staying.empty() ? "" : " " + staying);
}

std::vector<NamedGrip> gizmo_grips(const DrawList& drawn, const Lab& lab, const Workspace& workspace,
                                   const Camera& camera, float scale) {
    std::vector<NamedGrip> grips;
    const auto handle = lab.shown_gizmo(workspace);
    if (!handle) return grips;
    const Gizmo gizmo{handle->frame, handle->drag, scale};
    for (const GizmoPart part : gizmo.parts(camera)) {
        for (const glm::vec3 point : gizmo.grips(part, camera)) {
            const auto pixel = camera.project(point);
            if (!pixel || pick(drawn, camera, *pixel, 0.0f) != gizmo_pick(part)) continue;
            grips.push_back({handle->name + "." + name(part), *pixel});
            break;
        }
    }
    return grips;
}

namespace {

/// The handle that a held key constrains, in its current state; none for a gizmo's part or a rotation.
std::optional<Handle> constrained_handle(const Lab& lab, const Workspace& workspace, const Pointer& pointer,
                                         const Input& input) {
    if (pointer.dragged() == no_pick || pointer.drags_gizmo() || pointer.constraint(input).empty())
        return std::nullopt;
    const GizmoDrag* const part = pointer.dragged_part();
    if (part != nullptr && changed_by(part->part()) != Drag::Position) return std::nullopt;
    return lab.handle(workspace, pointer.dragged());
}

/// "0.42 m along Z, 0.40 m nearer". Depth is invisible in the picture, so a move mostly along it is reported
/// twice.
std::string moved_text(const std::string& bound, glm::vec3 from, glm::vec3 to, const Camera& camera) {
    const float moved = glm::distance(from, to), nearer = camera.depth(from) - camera.depth(to);
    const auto metres = [](float value) { return fixed_text(static_cast<double>(value), 2) + " m"; };
    std::string text = metres(moved) + " " + bound;
    if (std::abs(nearer) > 0.5f * moved)
        text += ", " + metres(std::abs(nearer)) + (nearer > 0.0f ? " nearer" : " farther");
    return text;
}

}  // namespace

void show_constraint(DrawList& list, const Lab& lab, const View& view, const Pointer& pointer,
                     const Input& input) {
    const auto now = constrained_handle(lab, view.workspace, pointer, input);
    if (!now) return;
    const std::string bound = pointer.constraint(input);
    const glm::vec3 at = pointer.caught_position();
    // Far enough to extend beyond the view.
    const float far = 20.0f * view.camera.depth(at);
    const auto line = [&](glm::vec3 axis, glm::vec3 colour) {
        list.line(at - far * axis, at + far * axis, 1.5f * view.scale, glm::vec4(colour, 0.9f)).layer =
            Layer::Overlay;
    };
    const bool ground = bound == "in the ground plane";
    if (ground || bound == "along X") line({1, 0, 0}, view.palette.axis_x);
    if (bound == "along Y") line({0, 1, 0}, view.palette.axis_y);
    if (ground || bound == "along Z") line({0, 0, 1}, view.palette.axis_z);
    const glm::vec3 to = now->frame.position;
    list.ring(at, 7.0f * view.scale, 1.5f * view.scale, glm::vec4(view.palette.text_dim, 1.0f)).layer =
        Layer::Overlay;
    list.line(at, to, 3.0f * view.scale, glm::vec4(view.palette.text, 1.0f)).layer = Layer::Overlay;
    list.labels.push_back({.at = to,
                           .clearance = 26.0f * view.scale,
                           .text = moved_text(bound, at, to, view.camera),
                           .colour = view.palette.text,
                           .rank = 100});
}

std::string constraint_hint(const Lab& lab, const Workspace& workspace, const Camera& camera,
                            const Pointer& pointer, const Input& input) {
    const auto now = constrained_handle(lab, workspace, pointer, input);
    if (!now) return {};
    return "Moving " +
           moved_text(pointer.constraint(input), pointer.caught_position(), now->frame.position, camera) +
           ".";
}

}  // namespace tendril::app
