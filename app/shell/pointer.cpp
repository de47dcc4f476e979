#include "app/shell/pointer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/view/picking.hpp"

namespace tendril::app {
namespace {

constexpr float drag_threshold = 4.0f;  ///< pixels; less is a click
constexpr float pick_margin = 4.0f;     ///< pixels beyond a handle's edge that still catch it
constexpr int double_click_ticks = 20;
constexpr float pixels_per_notch = 20.0f;   ///< for a drag that zooms
constexpr float pixels_per_scroll = 15.0f;  ///< shift of the view per notch: about the fingers' own movement

/// The axis of the first axis key held.
std::optional<glm::vec3> held_axis(const Input& input) {
    if (input.held_alone(Key::X)) return glm::vec3(1, 0, 0);
    if (input.held_alone(Key::Y)) return glm::vec3(0, 1, 0);
    if (input.held_alone(Key::Z)) return glm::vec3(0, 0, 1);
    return std::nullopt;
}

/// The point of the line `through + t axis` nearest to a ray; none if they are parallel.
std::optional<glm::vec3> on_line(const Ray& ray, glm::vec3 through, glm::vec3 axis) {
    const glm::vec3 between = through - ray.origin;
    const float b = glm::dot(axis, ray.direction);
    const float denominator = 1.0f - b * b;
    if (denominator < 1e-5f) return std::nullopt;
    const float t = (b * glm::dot(ray.direction, between) - glm::dot(axis, between)) / denominator;
    return through + t * axis;
}

/// Emits the camera's change.
void emit_camera(Emit& emit, const CameraPose& from, const CameraPose& to) {
    ArgumentList arguments;
    if (to.target != from.target) arguments.push_back({"target", to.target});
    if (to.yaw != from.yaw) arguments.push_back({"yaw_deg", glm::degrees(to.yaw)});
    if (to.pitch != from.pitch)
        arguments.push_back({"pitch_deg", std::clamp(glm::degrees(to.pitch), -90.0f, 90.0f)});
    if (to.distance != from.distance) arguments.push_back({"distance", to.distance});
    if (!arguments.empty()) emit.continuously("camera.set", arguments);
}

/// True if the view is 2D: without perspective, and square on to a plane that has all handles.
bool is_drawing(const Pointer::Scene& scene) {
    const CameraPose& pose = scene.camera.pose();
    constexpr float flat = 1e-3f;  // fraction of the camera's distance
    return pose.orthographic &&
           std::ranges::all_of(scene.lab.handles(scene.workspace), [&](const Handle& each) {
               return std::abs(glm::dot(each.frame.position - pose.target, scene.camera.forward())) <
                      flat * pose.distance;
           });
}

/// Fingers never move exactly vertically: if the two directions have different effects, only the larger one
/// is used.
CameraPose scrolled(const MouseWheel& wheel, const Input& input, const Pointer::Scene& scene) {
    const auto pan = [&](glm::vec2 notches) {
        return panned(scene.camera, pixels_per_scroll * glm::clamp(notches, -100.0f, 100.0f));
    };
    const bool pans = scroll_action(scene.workspace.settings) == Scroll::Pan;
    if (pans && !input.ctrl()) return pan({wheel.sideways, wheel.by});
    if (!pans && std::abs(wheel.sideways) > std::abs(wheel.by)) return pan({wheel.sideways, 0.0f});
    return zoomed(scene.camera, input.mouse(), wheel.by);
}

}  // namespace

void Pointer::take(const Event* event, const Input& input, const Scene& scene, Emit& emit) {
    since_click_ = std::min(since_click_ + 1, 1000);
    // An object grabbed in another lab is meaningless in this one.
    if (caught_ != no_pick && caught_in_ != &scene.lab) release(scene, emit);
    if (event != nullptr) {
        if (const auto* button = std::get_if<MousePress>(event)) {
            if (button->down && gesture_ == Gesture::Nothing && !scene.over_panel)
                press(*button, input, scene);
            if (!button->down && button->button == button_) release_button(input, scene, emit);
        } else if (std::holds_alternative<MouseMove>(*event)) {
            move(input, scene, emit);
        } else if (const auto* wheel = std::get_if<MouseWheel>(event)) {
            // A gizmo's drag is measured from the eye at its start, so the camera must not move.
            if (!scene.over_panel && !by_ && scene.camera.viewport().contains(input.mouse()))
                emit_camera(emit, scene.workspace.camera, scrolled(*wheel, input, scene));
        } else if (const auto* focus = std::get_if<Focus>(event); focus != nullptr && !focus->focused) {
            release(scene, emit);
        } else if (std::holds_alternative<KeyChange>(*event) && gesture_ == Gesture::Drag) {
            // An axis key applies at once; for any other key, such as Ctrl+Z, do not drag until the mouse
            // moves.
            if (constraint(input) != constrained_) drag(input, scene, emit);
        }
    }
    last_ = input.mouse();
    if (gesture_ == Gesture::Nothing) {
        const bool inside = !scene.over_panel && scene.camera.viewport().contains(input.mouse());
        hovered_ =
            inside ? pick(scene.drawn, scene.camera, input.mouse(), pick_margin * scene.scale) : no_pick;
    }
}

void Pointer::forget_missing(const Workspace& workspace, const Lab& lab) {
    const auto is_there = [&](PickId pick) {
        if (pick == no_pick || lab.handle(workspace, pick)) return true;
        const auto gizmo = lab.shown_gizmo(workspace);
        return gizmo && (gizmo->pick == pick || picked_part(pick));
    };
    if (!is_there(hovered_)) hovered_ = no_pick;
    if (!is_there(clicked_)) clicked_ = no_pick;
    if (caught_in_ != &lab || (is_there(caught_) && is_there(caught_handle_))) return;
    let_go();
}

void Pointer::release(const Scene& scene, Emit& emit) {
    if (gesture_ == Gesture::Drag) caught_in_->drop(scene.workspace, caught_handle_, emit);
    let_go();
}

void Pointer::let_go() {
    gesture_ = Gesture::Nothing;
    caught_ = caught_handle_ = no_pick;
    by_.reset();
    together_.clear();
}

void Pointer::press(const MousePress& press, const Input& input, const Scene& scene) {
    if (!scene.camera.viewport().contains(input.mouse())) return;
    button_ = press.button;
    caught_at_ = input.mouse();
    caught_ = no_pick;
    const HeldKeys held{.shift = input.shift(), .ctrl = input.ctrl(), .alt = input.alt()};
    if (const auto action = mouse_action(mouse_preset(scene.workspace.settings), press.button, held)) {
        gesture_ = *action == MouseAction::Orbit ? Gesture::Orbit
                   : *action == MouseAction::Pan ? Gesture::Pan
                                                 : Gesture::Zoom;
        return;
    }
    if (press.button != MouseButton::Left) return;
    gesture_ = Gesture::Press;
    caught_ = hovered_ = pick(scene.drawn, scene.camera, input.mouse(), pick_margin * scene.scale);
    caught_in_ = &scene.lab;
    draggable_ = false;
    boxing_ = caught_ == no_pick && input.ctrl() && scene.lab.selects_by_box();
    const auto part = picked_part(caught_);
    stroking_ = !part && !input.ctrl() && scene.lab.takes_strokes(scene.workspace);
    const auto handle =
        part ? scene.lab.shown_gizmo(scene.workspace) : scene.lab.handle(scene.workspace, caught_);
    if (handle) begin_drag(*handle, part ? part : handle->part, scene);
}

void Pointer::begin_drag(const Handle& handle, std::optional<GizmoPart> part, const Scene& scene) {
    caught_handle_ = handle.pick;
    caught_frame_ = handle.frame;
    draggable_ = part.has_value() || has(handle.drag, Drag::Position);
    const auto pixel = scene.camera.project(caught_frame_.position);
    offset_ = pixel ? *pixel - caught_at_ : glm::vec2(0.0f);
    if (!part) return;
    const Gizmo gizmo{handle.frame, handle.drag, scene.scale};
    by_.emplace(*part, handle.frame, scene.camera.ray(caught_at_),
                gizmo.reach(changed_by(*part), scene.camera), scene.camera.pose().orthographic);
    if (picked_part(caught_)) together_ = scene.lab.together(scene.workspace, changed_by(*part)).handles;
}

bool Pointer::clicked_before(const Input& input, const Scene& scene) const {
    return since_click_ < double_click_ticks && clicked_ == caught_ && caught_ != no_pick &&
           glm::distance(input.mouse(), clicked_at_) < drag_threshold * scene.scale;
}

void Pointer::release_button(const Input& input, const Scene& scene, Emit& emit) {
    if (gesture_ == Gesture::Press && !picked_part(caught_)) {
        const bool twice = clicked_before(input, scene);
        if (input.shift() || input.ctrl()) {
            scene.lab.click_more(scene.workspace, caught_, emit);
        } else if (twice) {
            scene.lab.double_click(scene.workspace, caught_, emit);
        } else {
            scene.lab.click(scene.workspace, caught_, emit);
        }
        if (stroking_ && caught_ == no_pick)
            scene.lab.stroke(scene.workspace, scene.pane, scene.camera, caught_at_, caught_at_, emit);
        clicked_ = twice ? no_pick : caught_;  // a third click starts again
        clicked_at_ = input.mouse();
        since_click_ = 0;
    }
    if (gesture_ == Gesture::Box) select_in_box(input.shift(), scene, emit);
    if (gesture_ == Gesture::Stroke)
        scene.lab.stroke(scene.workspace, scene.pane, scene.camera, caught_at_, input.mouse(), emit);
    release(scene, emit);
}

void Pointer::move(const Input& input, const Scene& scene, Emit& emit) {
    const glm::vec2 by = input.mouse() - last_;
    switch (gesture_) {
        case Gesture::Nothing:
        case Gesture::Stray:
        case Gesture::Box:
        case Gesture::Stroke:
            break;
        case Gesture::Orbit:
            emit_camera(emit, scene.workspace.camera, orbited(scene.workspace.camera, by));
            break;
        case Gesture::Pan:
            emit_camera(emit, scene.workspace.camera, panned(scene.camera, by));
            break;
        case Gesture::Zoom:
            emit_camera(emit, scene.workspace.camera,
                        zoomed(scene.camera, caught_at_, -by.y / pixels_per_notch));
            break;
        case Gesture::Press:
            if (glm::distance(input.mouse(), caught_at_) < drag_threshold * scene.scale) break;
            gesture_ = stroking_            ? Gesture::Stroke
                       : draggable_         ? Gesture::Drag
                       : boxing_            ? Gesture::Box
                       : caught_ != no_pick ? Gesture::Stray
                       : is_drawing(scene)  ? Gesture::Pan
                                            : Gesture::Orbit;
            if (gesture_ == Gesture::Stroke) caught_ = caught_handle_ = no_pick;
            if (gesture_ == Gesture::Drag) drag(input, scene, emit);
            if (gesture_ == Gesture::Orbit)
                emit_camera(emit, scene.workspace.camera,
                            orbited(scene.workspace.camera, input.mouse() - caught_at_));
            if (gesture_ == Gesture::Pan)
                emit_camera(emit, scene.workspace.camera, panned(scene.camera, input.mouse() - caught_at_));
            break;
        case Gesture::Drag:
            drag(input, scene, emit);
            break;
    }
}

std::optional<Rect> Pointer::box() const {
    if (gesture_ != Gesture::Box) return std::nullopt;
    return Rect{glm::min(caught_at_, last_), glm::max(caught_at_, last_)};
}

std::optional<std::pair<glm::vec2, glm::vec2>> Pointer::stroke() const {
    if (gesture_ != Gesture::Stroke) return std::nullopt;
    return std::pair(caught_at_, last_);
}

/// Includes hidden handles, so that a box can also select within a coil.
void Pointer::select_in_box(bool add, const Scene& scene, Emit& emit) const {
    const Rect inside = *box();
    std::vector<PickId> picks;
    for (const Handle& handle : scene.lab.selectable(scene.workspace, scene.pane)) {
        const auto pixel = scene.camera.project(handle.frame.position);
        if (pixel && inside.contains(*pixel)) picks.push_back(handle.pick);
    }
    scene.lab.select(scene.workspace, picks, add, emit);
}

void Pointer::drag(const Input& input, const Scene& scene, Emit& emit) {
    constrained_ = constraint(input);
    const bool bound = !constrained_.empty();
    const auto handle = picked_part(caught_) ? scene.lab.shown_gizmo(scene.workspace)
                                             : scene.lab.handle(scene.workspace, caught_);
    // The handle's parent may have moved since the start: only the dragged property follows the pointer.
    HandleFrame frame = handle && together_.empty() ? handle->frame : caught_frame_;
    if (by_ && !(bound && changed_by(by_->part()) == Drag::Position)) {
        frame = by_->changed(frame, by_->to(scene.camera.ray(input.mouse())));
    } else if (const auto to = dragged_to(input, scene.camera)) {
        frame.position = *to;
    } else {
        return;
    }
    if (!together_.empty()) return drag_together(frame, scene, emit);
    scene.lab.drag(scene.workspace, caught_handle_, frame, emit);
}

/// Relative to the grab positions: a handle stopped by a limit catches up when the others return.
void Pointer::drag_together(const HandleFrame& to, const Scene& scene, Emit& emit) const {
    const HandleFrame& from = caught_frame_;
    const bool turns = changed_by(by_->part()) == Drag::Rotation;
    const glm::quat turn = to.rotation * glm::inverse(by_->from().rotation);
    std::vector<Handle> handles = together_;
    for (Handle& each : handles) {
        const glm::vec3 arm = each.frame.position - from.position;
        if (has(each.drag, Drag::Position)) each.frame.position = to.position + (turns ? turn * arm : arm);
        if (turns && has(each.drag, Drag::Rotation))
            each.frame.rotation = glm::normalize(turn * each.frame.rotation);
        else
            each.drag = Drag::Position;
    }
    scene.lab.drag_together(scene.workspace, handles, emit);
}

std::optional<glm::vec3> Pointer::dragged_to(const Input& input, const Camera& camera) const {
    const glm::vec2 pixel = input.mouse() + offset_;  // the handle's own target pixel
    std::optional<glm::vec3> to;
    if (const auto axis = held_axis(input)) {
        to = on_line(camera.ray(pixel), caught_frame_.position, *axis);
    } else if (input.held_alone(Key::Shift)) {
        to = camera.on_plane(pixel, caught_frame_.position, {0, 1, 0});
        if (to) to->y = caught_frame_.position.y;  // exactly, without rounding
    } else {
        to = camera.on_plane(pixel, caught_frame_.position, camera.forward());
    }
    // Near the horizon of a plane, or along an axis seen end-on, one pixel spans kilometres: ignore such
    // moves.
    const float farthest =
        50.0f * (camera.pose().distance + glm::distance(caught_frame_.position, camera.eye()));
    if (to && glm::distance(*to, caught_frame_.position) > farthest) return std::nullopt;
    return to;
}

std::string Pointer::constraint(const Input& input) const {
    if (input.held_alone(Key::X)) return "along X";
    if (input.held_alone(Key::Y)) return "along Y";
    if (input.held_alone(Key::Z)) return "along Z";
    if (input.held_alone(Key::Shift)) return "in the ground plane";
    return {};
}

Cursor Pointer::cursor() const {
    if (gesture_ == Gesture::Drag || gesture_ == Gesture::Orbit || gesture_ == Gesture::Pan ||
        gesture_ == Gesture::Zoom)
        return Cursor::Grab;
    return hovered_ != no_pick ? Cursor::Hand : Cursor::Arrow;
}

}  // namespace tendril::app
