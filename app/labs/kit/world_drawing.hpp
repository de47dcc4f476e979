// Draws the bodies of a rope world: ropes and hair as tubes, cloth as a surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/labs/kit/named_world.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

/// The colour of a relative strain (negative: compressed): neutral up to 0.01 %, full from 10 % on.
glm::vec3 strain_colour(float strain, const Palette& palette);

/// The colour of a cloth's front, unless the body has its own.
glm::vec3 cloth_front(const Palette& palette);
/// Of bodies without a colour of their own, by kind; ByKind: the palette's.
struct KindColours {
    BodyColour rope = BodyColour::ByKind, hair = BodyColour::ByKind, cloth = BodyColour::ByKind;
};
BodyColour colour_of(const NamedWorld& world, const rope::Body& body, const KindColours& kinds);
/// The body's colour; for a cloth, its front's.
glm::vec3 body_colour(BodyColour colour, rope::Body::Kind kind, const Palette& palette);
glm::vec3 body_colour(const NamedWorld& world, const rope::Body& body, const Palette& palette,
                      const KindColours& kinds = {});
/// One for each particle: its body's, or by the worst strain of its links.
std::vector<glm::vec3> particle_colours(const NamedWorld& world, const Palette& palette, bool by_strain,
                                        const KindColours& kinds = {});

/// Whether each cell of a cloth's grid still has its link to the next in its row (`along`) and column
/// (`down`).
struct GridLinks {
    std::vector<std::uint8_t> along, down;
};
GridLinks grid_links(const NamedWorld& world, const rope::Body& cloth);
/// The remaining triangles of each cell, as in ClothGrid: a triangle needs both of its links.
std::vector<std::uint8_t> whole_cells(const NamedWorld& world, const rope::Body& cloth);

// `positions` and `colours` cover all particles of the world.

/// Tubes with `sides` sides (3 to 64); hair always has six.
void draw_strands(DrawList& list, const Camera& camera, const rope::Body& body,
                  std::span<const glm::vec3> positions, std::span<const glm::vec3> colours, int sides);
/// Without colours, in the body's colour; its back is paler than its front.
void draw_cloth(DrawList& list, const Camera& camera, const NamedWorld& world, const rope::Body& body,
                std::span<const glm::vec3> positions, std::span<const glm::vec3> colours,
                const Palette& palette, const KindColours& kinds = {});

}  // namespace tendril::app
