// How finely a body is divided, and in which direction it runs: edits of a body that renumber its particles,
// while it moves.
//
//     Expected<rope::Edited> finer = rope::resample(world, line, {.columns = 65});
//     if (finer) world = std::move(finer->world);
//
// The world is a value, and so is the edited one: nothing changes if an edit is refused. All handles stay.
#pragma once

#include <cstddef>
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

}  // namespace tendril::rope
