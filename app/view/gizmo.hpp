// Handles for editing a frame, and their drag: arrows and planes move it, rings rotate it, boxes scale it,
// each along the frame's own axes. x is red, y green, z blue; the size on the screen is constant. Drawn over
// the scene; each part has its own pick id.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

struct HandleFrame {
    glm::vec3 position{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    bool operator==(const HandleFrame&) const = default;
};

/// A set of the frame's properties that a drag may change.
enum class Drag : std::uint8_t { Nothing = 0, Position = 1, Rotation = 2, Scale = 4 };
constexpr Drag operator|(Drag a, Drag b) {
    return static_cast<Drag>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool has(Drag set, Drag one) {
    return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

/// Planes are in the order of their normals' axes.
enum class GizmoPart : std::uint8_t {
    MoveX,
    MoveY,
    MoveZ,
    MoveYZ,
    MoveZX,
    MoveXY,
    RotateX,
    RotateY,
    RotateZ,
    ScaleX,
    ScaleY,
    ScaleZ
};
inline constexpr int gizmo_parts = 12;

/// "move_x", "move_xy", "rotate_x", "scale_x"
const char* name(GizmoPart part);
/// The property that dragging the part changes.
Drag changed_by(GizmoPart part);
bool is_plane(GizmoPart part);
/// 0 to 2: the axis it moves or scales along or rotates about; for a plane, its normal.
int axis_of(GizmoPart part);

/// Labs use ids below this.
inline constexpr PickId first_gizmo_pick = 0x7f000000;
constexpr PickId gizmo_pick(GizmoPart part) {
    return first_gizmo_pick + static_cast<PickId>(part);
}
std::optional<GizmoPart> picked_part(PickId pick);

struct Gizmo {
    HandleFrame frame;
    Drag what = Drag::Nothing;
    float scale = 1.0f;       ///< multiplies all sizes in pixels
    PickId middle = no_pick;  ///< id of the object at the centre, which is picked before any part

    /// Metres from the centre to the ring, the box or the arrow's tip, in this camera's view.
    float reach(Drag of, const Camera& camera) const;
    /// The parts that can be dragged in this view: no arrow that points at the eye, no plane that is edge-on.
    std::vector<GizmoPart> parts(const Camera& camera) const;
    /// Points where a part can be grabbed, the best first.
    std::vector<glm::vec3> grips(GizmoPart part, const Camera& camera) const;
};

class GizmoDrag;

/// With `drag`, draws only the dragged part, with its axes extended or the angle that its ring was turned.
/// `lit` is highlighted.
void draw_gizmo(DrawList& list, const Gizmo& gizmo, const Camera& camera, const Palette& palette,
                std::optional<GizmoPart> lit, const GizmoDrag* drag = nullptr);

/// Dragging one part of a gizmo: converts lines of sight to frames, without window or drawing.
///
/// Everything is measured in the plane through the centre that faces the eye, which every line of sight meets
/// nearby. Points on an axis or plane follow from it by perspective, so the grabbed point stays under the
/// pointer. If an axis points at the eye, a plane is edge-on, or the pointer nears a plane's horizon, one
/// pixel would span kilometres; the drag then continues linearly. So a small move of the pointer is always a
/// small move of the frame.
class GizmoDrag {
  public:
    /// `caught`: the line of sight where the part was grabbed. `reach`: metres from the centre to the ring or
    /// the box; dragging a box by that much doubles the scale. `orthographic`: lines of sight are parallel.
    GizmoDrag(GizmoPart part, const HandleFrame& frame, const Ray& caught, float reach, bool orthographic);

    /// The frame for a line of sight. A ring counts its turns from call to call, at most half a turn each.
    /// Returns the last frame if the line of sight is unusable (not finite, or pointing away).
    HandleFrame to(const Ray& ray);

    /// `now` with the property that the part changes taken from `dragged`: the rotation, the scale along the
    /// axis, or the position along the arrow or in the plane.
    HandleFrame changed(const HandleFrame& now, const HandleFrame& dragged) const;

    GizmoPart part() const { return part_; }
    const HandleFrame& from() const { return from_; }
    /// For a ring: radians since it was caught, including whole turns.
    double turned() const { return turned_; }
    /// For a ring: the angle where it was grabbed, in radians about its axis.
    double caught_at() const { return caught_at_; }
    /// Describes the change so far, to `now`: "35.2° about X", "0.25 m along X", "1.50 times along X".
    std::string text(const HandleFrame& now) const;

  private:
    std::optional<glm::vec3> facing(const Ray& ray) const;
    glm::vec2 measured(glm::vec3 at) const;
    float along_axis(glm::vec3 at, glm::vec3 axis) const;
    glm::vec2 in_plane(glm::vec3 at) const;
    float about_axis(glm::vec3 at) const;

    GizmoPart part_;
    HandleFrame from_, last_;
    glm::vec3 axis_, u_, v_;  ///< the part's axis (along, about, or the plane's normal) and the other two
    glm::vec3 sight_;         ///< unit, from the eye to the centre
    float distance_ = 1.0f;   ///< from the eye to the centre
    float inverse_distance_ = 0.0f;  ///< inverse distance; 0 if lines of sight are parallel
    float reach_;
    bool edge_on_ = false;  ///< the ring is seen nearly edge-on
    glm::vec2 caught_{0.0f};
    float last_angle_ = 0.0f;
    double turned_ = 0.0, caught_at_ = 0.0;
};

}  // namespace tendril::app
