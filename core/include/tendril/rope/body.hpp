// What hangs in a rope world: ropes, cloth and hair. All are particles and links between them; a body is a
// range of particles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tendril/rope/handle.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rope {

/// Particles of one body are numbered on from `first`.
struct Body {
    enum class Kind : std::uint8_t { Rope, Cloth, Hair };
    BodyId id;
    Kind kind = Kind::Rope;
    std::size_t first = 0, count = 0;  ///< particles
    /// Particles in a row of a cloth, in a strand of hair; `count` for a rope.
    std::size_t row = 0;
    float radius = 0.02f;  ///< metres: distance of its particles from colliders: half of its thickness
    /// Strain at which a stretch link of a cloth tears, 0.1 for 10 % over its rest; 0: never. Shear and bend
    /// links tear at 0.5 more.
    float tear = 0.0f;
    /// The largest relative length error of its stretch links, |length / rest - 1| (or the length, where a
    /// rest is 0), as the solver left it last: of hair before contact. World::length_error() has it
    /// after.
    float stretch = 0.0f;
    bool operator==(const Body&) const = default;
};

/// Keeps two particles at a distance.
struct Link {
    /// Stretch links are what a rope or cloth consists of; the others only shape it.
    enum class Kind : std::uint8_t { Stretch, Shear, Bend };
    std::uint32_t a = 0, b = 0;
    float rest = 0.0f;  ///< metres
    Kind kind = Kind::Stretch;
    float compliance = 0.0f;  ///< m/N; of stretch links in addition to the settings'
    float tension = 0.0f;     ///< newtons, as last solved; below zero in compression
    bool operator==(const Link&) const = default;
};

/// A rope of equal segments.
struct RopeShape {
    glm::vec3 from{0.0f}, to{1.0f, 0.0f, 0.0f};
    int segments = 32;  ///< 1 to max_particles - 1
    /// Metres; the distance where left out. Where it is more than the distance the rope hangs on a parabola
    /// along gravity; where it is less the rope begins stretched.
    std::optional<float> length{};
    float radius = 0.02f;
    float density = 1.0f;  ///< kg/m, over 0
    bool pin_start = false, pin_end = false;
};

/// A cloth: a grid of columns x rows particles.
struct ClothShape {
    glm::vec3 corner{0.0f};
    glm::vec3 along{1.0f, 0.0f, 0.0f};  ///< from the corner to the other end of the first row
    glm::vec3 down{0.0f, -1.0f, 0.0f};  ///< from the corner to the last row
    int columns = 24, rows = 24;        ///< particles, 2 or more each
    float radius = 0.01f;
    float density = 0.2f;  ///< kg/m^2, over 0
    /// Compliance of shear and bend links, m/N. Soft, as in woven cloth: with stiff diagonals a crumpled
    /// cloth stays crumpled. Above 64 x 64 particles, 1e-4 and 1e-2 keep lengths better: 128 x 128 falling on
    /// a ball strains by 1.5 % instead of 20 %.
    float shear = 0.3f, bend = 0.3f;
    float tear = 0.0f;  ///< strain at which links tear; 0: never
    enum class Pins : std::uint8_t { None, Corners, Row } pins = Pins::None;  ///< of the first row
};

/// Presets for ClothShape. The first is its default.
struct ClothMaterial {
    std::string_view name;
    float density, shear, bend;
};
inline constexpr ClothMaterial cloth_materials[] = {{"cotton", 0.2f, 0.3f, 0.3f},
                                                    {"silk", 0.06f, 1.0f, 1.0f},
                                                    {"denim", 0.4f, 0.15f, 0.1f},
                                                    {"leather", 0.9f, 0.08f, 0.03f}};

/// Where a strand of hair grows.
struct HairRoot {
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f, -1.0f, 0.0f};  ///< of any length but 0
};

/// Hair: strands of equal length, each pinned at its root, where it keeps its direction.
struct HairShape {
    std::vector<HairRoot> roots{};
    float length = 0.5f;  ///< metres, over 0
    int segments = 16;
    float radius = 0.004f;
    float density = 0.05f;  ///< kg/m, over 0
    float bend = 1e-1f;     ///< compliance of bend links, m/N
    ColliderId attach{};    ///< a collider that the roots move with; none where it is empty
};

}  // namespace tendril::rope
