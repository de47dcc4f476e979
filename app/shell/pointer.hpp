// The mouse in the 3D view: hovers, clicks, drags handles, selects by a box, turns and shifts the camera. It
// only emits commands.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "app/labs/lab.hpp"
#include "app/shell/input.hpp"
#include "app/shell/shortcuts.hpp"
#include "app/view/gizmo.hpp"
#include "app/window/window.hpp"

namespace tendril::app {

class Pointer {
  public:
    struct Scene {
        const Workspace& workspace;
        const Lab& lab;
        const Camera& camera;
        const DrawList& drawn;    ///< the last picture: the user picks among the visible objects
        bool over_panel = false;  ///< the mouse belongs to a panel
        float scale = 1.0f;       ///< multiplies all sizes in pixels
        std::size_t pane = 0;     ///< the pane that the mouse is in
    };

    /// Handles this tick's event. Emits camera.set and the lab's drag and click commands, which run
    /// afterwards.
    void take(const Event* event, const Input& input, const Scene& scene, Emit& emit);
    /// Drops references to hovered, grabbed and dragged objects that no longer exist. Call before drawing and
    /// after anything that may have changed the scene.
    void forget_missing(const Workspace& workspace, const Lab& lab);
    /// Ends any interaction, without a click; drops a dragged handle.
    void release(const Scene& scene, Emit& emit);
    void let_go();

    /// The hovered object of the lab; no_pick for a gizmo's part.
    PickId hovered() const { return hovered_part() ? no_pick : hovered_; }
    /// The dragged handle of the lab, also if it is dragged by its gizmo.
    PickId dragged() const { return gesture_ == Gesture::Drag ? caught_handle_ : no_pick; }
    std::optional<GizmoPart> hovered_part() const { return picked_part(hovered_); }
    /// The dragged part; null if the handle moves freely.
    const GizmoDrag* dragged_part() const { return gesture_ == Gesture::Drag && by_ ? &*by_ : nullptr; }
    /// True if that part belongs to the gizmo and was not drawn by the lab.
    bool drags_gizmo() const { return dragged_part() != nullptr && picked_part(caught_).has_value(); }
    /// The number of dragged handles.
    std::size_t dragged_count() const {
        return gesture_ == Gesture::Drag ? std::max<std::size_t>(1, together_.size()) : 0;
    }
    bool busy() const { return gesture_ != Gesture::Nothing; }
    /// The axis or plane that a held key constrains the drag to; empty for the view plane.
    std::string constraint(const Input& input) const;
    /// The selection box being drawn, in window coordinates.
    std::optional<Rect> box() const;
    /// The ends of the stroke being drawn, in window coordinates.
    std::optional<std::pair<glm::vec2, glm::vec2>> stroke() const;
    /// The handle's position when it was caught.
    glm::vec3 caught_position() const { return caught_frame_.position; }
    Cursor cursor() const;

  private:
    /// Stray: a drag that began on something that cannot be dragged.
    enum class Gesture { Nothing, Press, Stray, Drag, Orbit, Pan, Zoom, Box, Stroke };

    void press(const MousePress& press, const Input& input, const Scene& scene);
    void release_button(const Input& input, const Scene& scene, Emit& emit);
    void move(const Input& input, const Scene& scene, Emit& emit);
    void drag(const Input& input, const Scene& scene, Emit& emit);
    void drag_together(const HandleFrame& to, const Scene& scene, Emit& emit) const;
    void select_in_box(bool add, const Scene& scene, Emit& emit) const;
    std::optional<glm::vec3> dragged_to(const Input& input, const Camera& camera) const;
    void begin_drag(const Handle& handle, std::optional<GizmoPart> part, const Scene& scene);
    bool clicked_before(const Input& input, const Scene& scene) const;

    Gesture gesture_ = Gesture::Nothing;
    MouseButton button_ = MouseButton::Left;
    PickId hovered_ = no_pick;
    PickId caught_ = no_pick;         ///< the picked object
    PickId caught_handle_ = no_pick;  ///< its handle: for a gizmo's part, the handle that it moves
    const Lab* caught_in_ = nullptr;  ///< the lab that defines its meaning
    glm::vec2 caught_at_{0.0f};       ///< where the button went down
    glm::vec2 last_{0.0f};            ///< the mouse at the last tick
    std::string constrained_;         ///< constraint() of the last drag()
    glm::vec2 offset_{0.0f};          ///< from the mouse to the handle's pixel when caught
    Handle::Frame caught_frame_;      ///< the handle's frame when caught
    bool draggable_ = false;          ///< the caught object can be dragged
    bool boxing_ = false;             ///< nothing was caught, and a drag draws a box
    bool stroking_ = false;           ///< a drag draws a stroke
    std::optional<GizmoDrag> by_;     ///< the part it is dragged by, if any
    std::vector<Handle> together_;    ///< all handles that the gizmo moves, as they were when caught
    int since_click_ = 1000;          ///< ticks
    PickId clicked_ = no_pick;        ///< last clicked
    glm::vec2 clicked_at_{0.0f};
};

}  // namespace tendril::app
