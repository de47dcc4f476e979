#include "app/shell/gizmo_view.hpp"

#include <imgui.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "app/io/text.hpp"
#include "app/shell/pointer.hpp"
#include "app/shell/ui.hpp"
#include "app/view/camera.hpp"
#include "app/view/picking.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

/// The dragged handle in its current state: the gizmo's, or one drawn by the lab.
std::optional<Handle> dragged_handle(const Lab& lab, const Workspace& workspace, const Pointer& pointer) {
    return pointer.drags_gizmo() ? lab.shown_gizmo(workspace) : lab.handle(workspace, pointer.dragged());
}

/// Whether to report the drag: labs report moves of their own handles, but not rotations.
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

struct Axis {
    glm::vec3 direction;
    const char* letter;  ///< empty for negative axes
    const char* view;    ///< argument of camera.view for the view from there
    const char* title;
};

constexpr std::array axes{Axis{{1, 0, 0}, "X", "side", "Right"},    Axis{{0, 1, 0}, "Y", "top", "Top"},
                          Axis{{0, 0, 1}, "Z", "front", "Front"},   Axis{{-1, 0, 0}, "", "left", "Left"},
                          Axis{{0, -1, 0}, "", "bottom", "Bottom"}, Axis{{0, 0, -1}, "", "back", "Back"}};

/// One of the six ends: its position on the screen, and its depth.
struct End {
    std::size_t axis = 0;
    ImVec2 at{};
    float depth = 0.0f;  ///< -1 to 1, far to near
};

glm::vec3 colour_of_axis(const Palette& colours, std::size_t axis) {
    const glm::vec3 all[] = {colours.axis_x, colours.axis_y, colours.axis_z};
    return all[axis % 3];
}

/// Uses a small window of its own, so that the mouse around it still reaches the view.
bool end_button(const End& end, float radius, bool& hovered) {
    const Axis& axis = axes[end.axis];
    ImGui::SetNextWindowPos({end.at.x - radius, end.at.y - radius});
    ImGui::SetNextWindowSize({2.0f * radius, 2.0f * radius});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin((std::string("axis ") + axis.view).c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    ImGui::PopStyleVar(2);
    const bool clicked = ImGui::InvisibleButton(axis.view, {2.0f * radius, 2.0f * radius});
    hovered = ImGui::IsItemHovered();
    ImGui::End();
    return clicked;
}

/// "Front" if the view is straight along an axis, else the projection's name.
std::string view_name(const CameraPose& pose, const std::array<End, 6>& ends) {
    if (ends.back().depth > 0.99999f) return axes[ends.back().axis].title;
    return pose.orthographic ? "Orthographic" : "Perspective";
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

float axis_gizmo_width(glm::vec2 pane, float scale) {
    if (pane.x < 330.0f * scale || pane.y < 220.0f * scale) return 0.0f;
    return 100.0f * scale;
}

Rect show_axis_gizmo(const ShellFrame& frame, Emit& emit) {
    const Rect& view = frame.layout.view;
    const float scale = frame.layout.scale, reach = 27.0f * scale, radius = 8.5f * scale;
    if (axis_gizmo_width(frame.workspace.ui.view_size, scale) <= 0.0f) return {view.min, view.min};
    const glm::vec2 centre{view.max.x - reach - 2.0f * radius, view.min.y + reach + 2.0f * radius};
    const Camera camera(frame.workspace.camera, view);
    std::array<End, 6> ends;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const glm::vec3 to = axes[i].direction;
        ends[i] = {
            i,
            {centre.x + reach * glm::dot(to, camera.right()), centre.y - reach * glm::dot(to, camera.up())},
            -glm::dot(to, camera.forward())};
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.depth < b.depth; });
    const Palette& colours = frame.colours();
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    ImGui::PushFont(small_font());
    const char* hovered_axis = nullptr;
    for (const End& end : ends) {
        const Axis& axis = axes[end.axis];
        bool hovered = false;
        // The nearer end takes the click.
        const bool hidden = std::any_of(ends.begin(), ends.end(), [&](const End& other) {
            return other.depth > end.depth &&
                   glm::distance(glm::vec2(other.at.x, other.at.y), glm::vec2(end.at.x, end.at.y)) < radius;
        });
        if (!hidden && end_button(end, radius, hovered)) emit("camera.view", {{"name", axis.view}});
        if (hovered) {
            list->AddCircleFilled({centre.x, centre.y}, reach + 1.7f * radius, imgui_u32(colours.text, 0.05f),
                                  48);
            hovered_axis = axis.title;
        }
        const bool positive = axis.letter[0] != '\0';
        // Ends at the back are fainter.
        const glm::vec3 colour =
            glm::mix(colours.background_top, colour_of_axis(colours, end.axis), 0.75f + 0.25f * end.depth);
        if (positive) {
            list->AddLine({centre.x, centre.y}, end.at, imgui_u32(colour), 2.0f * scale);
            list->AddCircleFilled(end.at, radius, imgui_u32(hovered ? colours.text : colour), 24);
            const ImVec2 size = ImGui::CalcTextSize(axis.letter);
            list->AddText({end.at.x - 0.5f * size.x, end.at.y - 0.5f * size.y}, imgui_u32(colours.bar),
                          axis.letter);
        } else {
            list->AddCircleFilled(end.at, 0.75f * radius,
                                  imgui_u32(glm::mix(colours.background_top, colour, 0.35f)), 24);
            list->AddCircle(end.at, 0.75f * radius, imgui_u32(hovered ? colours.text : colour), 24,
                            1.3f * scale);
        }
    }
    const std::string name = view_name(frame.workspace.camera, ends);
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    list->AddText({centre.x - 0.5f * size.x, centre.y + reach + 1.6f * radius}, imgui_u32(colours.text_dim),
                  name.c_str());
    const float around = reach + radius;
    const Rect whole{centre - around, {centre.x + around, centre.y + reach + 1.6f * radius + size.y}};
    if (hovered_axis != nullptr) {
        const Tooltip opened(whole);
        ImGui::Text("%s view", hovered_axis);
    }
    ImGui::PopFont();
    return whole;
}

}  // namespace tendril::app
