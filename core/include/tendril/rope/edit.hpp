// How finely a body is divided, in which direction it runs, and where a cloth is cut, while it moves.
//
//     Expected<rope::Edited> finer = rope::resample(world, line, {.columns = 65});
//     if (finer) world = std::move(finer->world);
//
// The world is a value, and so is the edited one: nothing changes if an edit is refused. All handles stay.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "tendril/result.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {

/// Particles in a row of a body, and its rows. A rope is one row; each strand of hair is a row, and strands
/// stay as many as they are.
struct Resolution {
    std::size_t columns = 2, rows = 1;
    bool operator==(const Resolution&) const = default;
};

struct Edited {
    World world;
    /// The particle that each particle of the body has become, or the nearest to it; both numbered from the
    /// body's first, on into what came off it.
    std::vector<std::size_t> becomes;
    std::vector<BodyId> pieces{};  ///< bodies that came off it, in the order of particles
};

Resolution resolution(const Body& body) noexcept;

/// Divides a body more or less finely. Its particles move to other points of the same shape, with the
/// velocities there; its free particles keep their total momentum, and its material its density and
/// compliance. Ends, ties and single pins stay where they are, each on a particle of its own: refuses fewer
/// particles than that takes. Between them the segments of a rope or strand are of equal length. What lies
/// within a row of pins is pinned. A torn cloth stays torn.
Expected<Edited> resample(const World& world, BodyId body, const Resolution& to);

/// Swaps the ends of a rope. Pins, ties and motion stay where they are.
Expected<Edited> reverse(const World& world, BodyId rope);

/// Makes each piece of a cloth or rope that no link joins to the others a body of its own, with its particles
/// and what belongs to them: velocities, pins and ties. The one with most pins, or else most particles, stays
/// the body that it was. Costs as much as a copy of the world, even if nothing has come apart.
Expected<Edited> part_body(const World& world, BodyId body);

/// A line through points of a cloth's own grid, each {column, row}, up to one beyond its edge.
using ClothLine = std::vector<glm::vec2>;

/// Cuts a cloth along lines: removes the links that cross them, and parts what comes apart. What is on a line
/// belongs to its left, with columns to the right and rows upwards.
/// Refuses lines that cross no link.
Expected<Edited> cut_cloth(const World& world, BodyId cloth, std::span<const ClothLine> lines);

}  // namespace tendril::rope
