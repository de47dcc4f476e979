// How the bodies of a rope world are drawn: ropes and hair as tubes, cloth as a surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/labs/kit/named_world.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

/// Of something that is by this part of its length too long (or, below zero, too short): neutral up to 0.01
/// %, full from 10 % on.
glm::vec3 strain_colour(float strain, const Palette& palette);

/// The side of a cloth that is seen from its front.
glm::vec3 cloth_front(const Palette& palette);
/// One for each particle of a world: what its body is, or how its links are strained.
std::vector<glm::vec3> particle_colours(const NamedWorld& world, const Palette& palette, bool by_strain);

/// Which particles of a cloth have a link to the next one in their row, and in their column.
struct GridLinks {
    std::vector<std::uint8_t> along, down;
};
GridLinks grid_links(const NamedWorld& world, const rope::Body& cloth);
/// What is left of each cell of a cloth, as ClothGrid has it: a triangle goes with either of its links.
std::vector<std::uint8_t> whole_cells(const NamedWorld& world, const rope::Body& cloth);

// `positions` and `colours` are those of all particles of the world.

/// Tubes with so many sides (3 to 64), or fewer where they are hair.
void draw_strands(DrawList& list, const Camera& camera, const rope::Body& body,
                  std::span<const glm::vec3> positions, std::span<const glm::vec3> colours, int sides);
/// Without colours a cloth has two: its front's and its back's.
void draw_cloth(DrawList& list, const Camera& camera, const NamedWorld& world, const rope::Body& body,
                std::span<const glm::vec3> positions, std::span<const glm::vec3> colours,
                const Palette& palette);

}  // namespace tendril::app
