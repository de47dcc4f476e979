// The mouse in the 3D view: hover, click, drag a handle, select by a box, turn and shift the camera. It
// changes nothing itself: it emits commands.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/labs/lab.hpp"
#include "app/shell/input.hpp"
#include "app/shell/shortcuts.hpp"
#include "app/view/gizmo_drag.hpp"
#include "app/window/window.hpp"

namespace tendril::app {

class Pointer {
  public:
    struct Scene {
        const Workspace& workspace;
        const Lab& lab;
        const Camera& camera;
        const DrawList& drawn;    ///< the last picture: what one sees is what one picks
        bool over_panel = false;  ///< the mouse is meant for a panel
        float scale = 1.0f;       ///< of what is measured in pixels
    };

    /// Takes this tick's event. Emits camera.set, the lab's drag and click commands, and a document is
    /// changed by them afterwards.
    void take(const Event* event, const Input& input, const Scene& scene, Emit& emit);
    /// Before anything is drawn, or after what may have changed the scene: what is hovered, pressed or
    /// dragged and is no longer there is forgotten, so that nothing is drawn, said or dragged of it.
    void forget_missing(const Workspace& workspace, const Lab& lab);
    /// Ends whatever is going on, without a click; what was dragged is dropped.
    void release(const Scene& scene, Emit& emit);

    /// What the lab has drawn; nothing where it is a gizmo.
    PickId hovered() const { return hovered_part() ? no_pick : hovered_; }
    /// The lab's handle, by its gizmo too.
    PickId dragged() const { return doing_ == Doing::Drag ? caught_handle_ : no_pick; }
    std::optional<GizmoPart> hovered_part() const { return picked_part(hovered_); }
    /// The part that is dragged; null where the handle goes freely.
    const GizmoDrag* dragged_part() const { return doing_ == Doing::Drag && by_ ? &*by_ : nullptr; }
    /// Whether it is a gizmo's, and not one that the lab has drawn.
    bool drags_gizmo() const { return dragged_part() != nullptr && picked_part(caught_).has_value(); }
    /// How many handles are dragged; 0 where none is.
    std::size_t dragged_count() const {
        return doing_ == Doing::Drag ? std::max<std::size_t>(1, together_.size()) : 0;
    }
    bool busy() const { return doing_ != Doing::Nothing; }
    /// The axis or plane that a held key binds the drag to; empty for the view plane.
    std::string constraint(const Input& input) const;
    /// The box that is being drawn to select what is in it, window coordinates.
    std::optional<Rect> box() const;
    /// Where the handle was when it was caught.
    glm::vec3 caught_position() const { return caught_frame_.position; }
    Cursor cursor() const;

  private:
    /// Stray: a drag of what stays.
    enum class Doing { Nothing, Press, Stray, Drag, Orbit, Pan, Zoom, Box };

    void press(const MousePress& press, const Input& input, const Scene& scene);
    void let_go(const Input& input, const Scene& scene, Emit& emit);
    void move(const Input& input, const Scene& scene, Emit& emit);
    void drag(const Input& input, const Scene& scene, Emit& emit);
    void drag_together(const HandleFrame& to, const Scene& scene, Emit& emit) const;
    void select_in_box(bool add, const Scene& scene, Emit& emit) const;
    std::optional<glm::vec3> dragged_to(const Input& input, const Camera& camera) const;
    void take_hold(const Handle& handle, std::optional<GizmoPart> part, const Scene& scene);
    bool clicked_before(const Input& input, const Scene& scene) const;

    Doing doing_ = Doing::Nothing;
    MouseButton button_ = MouseButton::Left;
    PickId hovered_ = no_pick;
    PickId caught_ = no_pick;         ///< what is drawn there
    PickId caught_handle_ = no_pick;  ///< whose it is, where it is a part of a gizmo
    const Lab* caught_in_ = nullptr;  ///< what it means there
    glm::vec2 caught_at_{0.0f};       ///< where the button went down
    glm::vec2 last_{0.0f};            ///< the mouse a tick ago
    std::string constrained_;         ///< constraint() of the last drag()
    glm::vec2 offset_{0.0f};          ///< from the mouse to the handle's pixel when caught
    Handle::Frame caught_frame_;      ///< the handle's when caught
    bool draggable_ = false;          ///< what is caught can be dragged
    bool boxing_ = false;             ///< nothing is caught, and a drag draws a box
    std::optional<GizmoDrag> by_;     ///< by a part
    std::vector<Handle> together_;    ///< what the gizmo takes along, as it was when caught
    int since_click_ = 1000;          ///< ticks
    PickId clicked_ = no_pick;        ///< last
    glm::vec2 clicked_at_{0.0f};
};

}  // namespace tendril::app
