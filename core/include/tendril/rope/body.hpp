// The bodies of a rope world: ropes, cloth and hair. All consist of particles and links; a body is a range of
// particles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/rope/handle.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rope {

inline constexpr std::size_t max_particles = 1000000;  ///< per world
inline constexpr float min_density = 1e-9f;            ///< kg/m, kg/m^2
inline constexpr float min_hair_length = 1e-6f;        ///< metres

/// A rope, cloth or hair: `count` particles from `first` on.
struct Body {
    enum class Kind : std::uint8_t { Rope, Cloth, Hair };
    BodyId id;
    Kind kind = Kind::Rope;
    std::size_t first = 0, count = 0;  ///< particles
    /// Particles per row of a cloth or per strand of hair; `count` for a rope.
    std::size_t row = 0;
    /// For a piece of cloth whose grid has gaps: each particle's cell, row * `row` + column, ascending.
    /// Empty: the grid is full.
    std::vector<std::uint32_t> cells{};
    float radius = 0.02f;  ///< metres: half the thickness; particles keep this far from colliders
    /// Strain at which a stretch link tears, 0.1 for 10 % over its rest; 0: never. Shear and bend links tear
    /// at 0.5 more. A torn body stays one body until part_body().
    float tear = 0.0f;
    /// Bending stiffness of a rope, N m^2 (Young's modulus times the second moment of its cross-section); 0:
    /// none. A rope at rest is straight. Only the direct solver uses it.
    float bending = 0.0f;
    /// Coulomb's friction coefficient with colliders, 0 to max_friction; empty: the settings'.
    std::optional<float> friction{};
    /// Maximum relative length error of the stretch links, |length / rest - 1| (or the length if rest is 0),
    /// after the last solve; for hair before contact. World::length_error() includes contact.
    float stretch = 0.0f;

    /// The cell of a particle; both are numbered within the body.
    std::size_t cell(std::size_t particle) const noexcept {
        return cells.empty() ? particle : cells[particle];
    }
    /// The particle in a cell; `count` if the cell is a gap.
    std::size_t particle_in(std::size_t cell) const noexcept;
    std::size_t rows() const noexcept { return count == 0 ? 0 : cell(count - 1) / row + 1; }
    bool operator==(const Body&) const = default;
};
/// The names of a body's kinds, in order.
inline constexpr const char* body_kinds[] = {"rope", "cloth", "hair"};

/// Keeps two particles at a distance.
struct Link {
    /// Stretch links make up a rope or cloth; the others only shape it.
    enum class Kind : std::uint8_t { Stretch, Shear, Bend };
    std::uint32_t a = 0, b = 0;
    float rest = 0.0f;  ///< metres
    Kind kind = Kind::Stretch;
    float compliance = 0.0f;  ///< m/N; for stretch links in addition to the settings'
    float tension = 0.0f;     ///< newtons, from the last solve; negative in compression
    bool operator==(const Link&) const = default;
};

/// A rope of equal segments.
struct RopeShape {
    glm::vec3 from{0.0f}, to{1.0f, 0.0f, 0.0f};
    int segments = 32;  ///< 1 to max_particles - 1
    /// Metres; default: the distance. A longer rope hangs on a parabola along gravity; a shorter one starts
    /// stretched.
    std::optional<float> length{};
    float radius = 0.02f;
    float density = 1.0f;  ///< kg/m
    float bending = 0.0f;  ///< bending stiffness, N m^2
    bool pin_start = false, pin_end = false;
};

/// A cloth: a grid of columns x rows particles.
struct ClothShape {
    glm::vec3 corner{0.0f};
    glm::vec3 along{1.0f, 0.0f, 0.0f};  ///< from the corner to the other end of the first row
    glm::vec3 down{0.0f, -1.0f, 0.0f};  ///< from the corner to the last row
    int columns = 24, rows = 24;        ///< particles, 2 or more each
    float radius = 0.01f;
    float density = 0.2f;  ///< kg/m^2
    /// Compliance of shear and bend links, m/N. Soft, as in woven cloth: with stiff diagonals a crumpled
    /// cloth stays crumpled. Above 64 x 64 particles, 1e-4 and 1e-2 keep lengths better: 128 x 128 falling on
    /// a ball strains by 1.5 % instead of 20 %.
    float shear = 0.3f, bend = 0.3f;
    float tear = 0.0f;  ///< strain at which links tear; 0: never
    enum class Pins : std::uint8_t { None, Corners, Row } pins = Pins::None;  ///< in the first row
};

/// Presets for ClothShape. The first one is the default.
struct ClothMaterial {
    std::string_view name;
    float density, shear, bend;
};
inline constexpr ClothMaterial cloth_materials[] = {{"cotton", 0.2f, 0.3f, 0.3f},
                                                    {"silk", 0.06f, 1.0f, 1.0f},
                                                    {"denim", 0.4f, 0.15f, 0.1f},
                                                    {"leather", 0.9f, 0.08f, 0.03f}};

/// The root of a strand of hair.
struct HairRoot {
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f, -1.0f, 0.0f};  ///< any length but 0
};

/// Hair: strands of equal length, each pinned at its root, where it keeps its direction.
struct HairShape {
    std::vector<HairRoot> roots{};
    float length = 0.5f;  ///< metres
    int segments = 16;
    float radius = 0.004f;
    float density = 0.05f;  ///< kg/m
    float bend = 1e-1f;     ///< compliance of bend links, m/N
    ColliderId attach{};    ///< the collider that the roots move with; empty: none
};

}  // namespace tendril::rope

/// All fields but `id`.
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Body>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::RopeShape>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::ClothShape>() noexcept;
/// All fields but `roots` and `attach`.
template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::HairShape>() noexcept;
