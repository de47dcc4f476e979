// What a person takes hold of to change a frame: arrows and planes move it, rings turn it, boxes scale it,
// each in the frame's own axes. x is red, y green, z blue, and all of it has the same size on the screen
// wherever it stands. Drawn over the scene; its parts are picked like everything else, by ids of their own.
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

/// What a drag may change of a frame: a set.
enum class Drag : std::uint8_t { Nothing = 0, Position = 1, Rotation = 2, Scale = 4 };
constexpr Drag operator|(Drag a, Drag b) {
    return static_cast<Drag>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool has(Drag set, Drag one) {
    return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

/// The planes in the order of the axes that stand upright on them.
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
/// What dragging it changes.
Drag changed_by(GizmoPart part);
bool is_plane(GizmoPart part);
/// 0 to 2: along it, about it, or of a plane the one that stands upright on it.
int axis_of(GizmoPart part);

/// Labs number what they draw below these.
inline constexpr PickId first_gizmo_pick = 0x7f000000;
constexpr PickId gizmo_pick(GizmoPart part) {
    return first_gizmo_pick + static_cast<PickId>(part);
}
std::optional<GizmoPart> picked_part(PickId pick);

struct Gizmo {
    HandleFrame frame;
    Drag what = Drag::Nothing;
    float scale = 1.0f;       ///< of what is measured in pixels
    PickId middle = no_pick;  ///< whose middle it is: that stays free, whatever part runs across it

    /// Metres from its middle to where a ring is, a box, an arrow's tip; as this camera sees it.
    float reach(Drag of, const Camera& camera) const;
    /// Those that can be taken hold of from there: no arrow that points at the eye, no plane that is seen
    /// edge on.
    std::vector<GizmoPart> parts(const Camera& camera) const;
    /// Where a part can be taken hold of, the best first.
    std::vector<glm::vec3> grips(GizmoPart part, const Camera& camera) const;
};

class GizmoDrag;

/// With `drag`, what it drags alone: its axes drawn out, or how far its ring has been turned. `lit` stands
/// out.
void draw_gizmo(DrawList& list, const Gizmo& gizmo, const Camera& camera, const Palette& palette,
                std::optional<GizmoPart> lit, const GizmoDrag* drag = nullptr);

}  // namespace tendril::app
