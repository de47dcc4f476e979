// Edits of a moving body: its resolution, its direction, and cuts in cloth.
//
//     Expected<rope::Edited> finer = rope::resample(world, line, {.columns = 65});
//     if (finer) world = std::move(finer->world);
//
// The world is a value, and so is the edited one: nothing changes if an edit is refused. Handles stay valid.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "tendril/result.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {

/// Particles per row of a body, and number of rows. A rope is one row. Each strand of hair is a row, and the
/// number of strands does not change.
struct Resolution {
    std::size_t columns = 2, rows = 1;
    bool operator==(const Resolution&) const = default;
};

struct Edited {
    World world;
    /// For each old particle of the body, the new one that it became, or the nearest. Both are numbered from
    /// the body's first particle; particles of the pieces that came off follow.
    std::vector<std::size_t> becomes;
    std::vector<BodyId> pieces{};  ///< bodies that came off it, in the order of particles
};

Resolution resolution(const Body& body) noexcept;

/// Changes a body's resolution. New particles lie on the same shape and take the velocities there; the total
/// momentum of free particles, the density and the compliance stay the same. Ends, ties and single pins stay
/// where they are, each on its own particle: refuses fewer particles than these need. Between them the
/// segments of a rope or strand are of equal length. New particles within a row of pins are pinned. A torn
/// cloth stays torn.
Expected<Edited> resample(const World& world, BodyId body, const Resolution& to);

/// Swaps the ends of a rope. Pins, ties and motion stay where they are.
Expected<Edited> reverse(const World& world, BodyId rope);

/// Splits a torn cloth or rope: each piece that no link joins to the others becomes a body of its own, with
/// its velocities, pins and ties. The piece with most pins (if equal, most particles) keeps the body's
/// handle. Costs as much as a copy of the world, even if nothing has come apart.
Expected<Edited> part_body(const World& world, BodyId body);

/// A polyline in a cloth's grid coordinates, {column, row}, at most one beyond the edge.
using ClothLine = std::vector<glm::vec2>;

/// Cuts a cloth along lines: removes the links that cross them, and splits off what comes apart. A particle
/// on a line counts as left of it, with columns to the right and rows upwards. Refuses lines that cross no
/// link.
Expected<Edited> cut_cloth(const World& world, BodyId cloth, std::span<const ClothLine> lines);

}  // namespace tendril::rope
