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
    /// The particle that each particle of the body has become, or the nearest to it; both numbered in the
    /// body.
    std::vector<std::size_t> becomes;
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

/// Cuts a cloth along a line through points of its own grid, each {column, row}: removes the links that cross
/// it. What is on the line belongs to its left. A piece that comes apart stays a part of the same body, as if
/// torn off. Refuses a line that crosses no link.
Expected<World> cut_cloth(const World& world, BodyId cloth, std::span<const glm::vec2> line);

}  // namespace tendril::rope
