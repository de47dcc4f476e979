// Handles for editing a frame: arrows and planes move it, rings rotate it, boxes scale it, each along the
// frame's own axes. x is red, y green, z blue; the size on the screen is constant. Drawn over the scene; each
// part has its own pick id.
#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
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

}  // namespace tendril::app
