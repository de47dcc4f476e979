// Colours of ropes, and what is left of a torn cloth.
#pragma once

#include <cstdint>
#include <vector>

#include "app/labs/rope/named_world.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

/// Of something that is by this part of its length too long (or, below zero, too short): neutral up to 0.01
/// %, full from 10 % on.
glm::vec3 strain_colour(float strain, const Palette& palette);

/// One for each particle of a world: what its body is, or how its links are strained.
std::vector<glm::vec3> particle_colours(const NamedWorld& world, const Palette& palette, bool by_strain);

glm::vec3 cloth_front(const Palette& palette);

/// What is left of each cell of a cloth, as ClothGrid has it: a triangle goes with either of its links.
std::vector<std::uint8_t> whole_cells(const NamedWorld& world, const rope::Body& cloth);

}  // namespace tendril::app
