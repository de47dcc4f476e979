#include "app/labs/kit/world_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "app/labs/kit/race.hpp"
#include "app/view/surfaces.hpp"

namespace tendril::app {
namespace {

constexpr float min_strain = 1e-4f, full_strain = 0.1f;
constexpr int strand_sides = 6;  // indistinguishable from more on a hair

}  // namespace

glm::vec3 cloth_front(const Palette& palette) {
    return glm::mix(palette.accent, palette.joint, 0.35f);
}

glm::vec3 body_colour(BodyColour colour, rope::Body::Kind kind, const Palette& palette) {
    if (colour != BodyColour::ByKind) return racer_colour(palette, static_cast<std::size_t>(colour));
    return kind == rope::Body::Kind::Cloth  ? cloth_front(palette)
           : kind == rope::Body::Kind::Hair ? glm::mix(palette.target, palette.ghost, 0.55f)
                                            : palette.joint;
}

BodyColour colour_of(const NamedWorld& world, const rope::Body& body, const KindColours& kinds) {
    const BodyColour own = world.colour(body);
    if (own != BodyColour::ByKind) return own;
    return body.kind == rope::Body::Kind::Cloth  ? kinds.cloth
           : body.kind == rope::Body::Kind::Hair ? kinds.hair
                                                 : kinds.rope;
}

glm::vec3 body_colour(const NamedWorld& world, const rope::Body& body, const Palette& palette,
                      const KindColours& kinds) {
    return body_colour(colour_of(world, body, kinds), body.kind, palette);
}

glm::vec3 strain_colour(float strain, const Palette& palette) {
    const float size = std::abs(strain);
    const float share =
        std::log(std::max(size, min_strain) / min_strain) / std::log(full_strain / min_strain);
    // Start from a grey that is lighter than both, in either theme.
    const glm::vec3 none = glm::mix(palette.ghost, glm::vec3(1.0f), 0.35f);
    return glm::mix(none, strain > 0.0f ? palette.limit : palette.head, std::min(share, 1.0f));
}

std::vector<glm::vec3> particle_colours(const NamedWorld& world, const Palette& palette, bool by_strain,
                                        const KindColours& kinds) {
    const rope::State& state = world.state();
    if (!by_strain) {
        std::vector<glm::vec3> colours(world.size());
        for (const rope::Body& body : state.bodies)
            std::fill_n(colours.begin() + static_cast<std::ptrdiff_t>(body.first), body.count,
                        body_colour(world, body, palette, kinds));
        return colours;
    }
    // The worst strain of the links at each particle.
    std::vector<float> worst(world.size(), 0.0f);
    for (const rope::Link& link : state.links) {
        if (link.kind != rope::Link::Kind::Stretch || link.rest <= 0.0f) continue;
        const double length = glm::distance(state.position[link.a], state.position[link.b]);
        const float strain = static_cast<float>(length / static_cast<double>(link.rest) - 1.0);
        for (const std::uint32_t end : {link.a, link.b}) {
            if (std::abs(strain) > std::abs(worst[end])) worst[end] = strain;
        }
    }
    std::vector<glm::vec3> colours(world.size());
    std::transform(worst.begin(), worst.end(), colours.begin(),
                   [&](float strain) { return strain_colour(strain, palette); });
    return colours;
}

GridLinks grid_links(const NamedWorld& world, const rope::Body& cloth) {
    const std::size_t cells = cloth.row * cloth.rows();
    GridLinks links{std::vector<std::uint8_t>(cells, 0), std::vector<std::uint8_t>(cells, 0)};
    for (const rope::Link& link : world.state().links) {
        if (link.kind != rope::Link::Kind::Stretch) continue;
        if (link.a - cloth.first >= cloth.count || link.b - cloth.first >= cloth.count) continue;
        const std::size_t from = cloth.cell(link.a - cloth.first), to = cloth.cell(link.b - cloth.first);
        (to == from + cloth.row ? links.down : links.along)[from] = 1;
    }
    return links;
}

std::vector<std::uint8_t> whole_cells(const NamedWorld& world, const rope::Body& cloth) {
    const std::size_t columns = cloth.row, rows = cloth.rows();
    const auto [along, down] = grid_links(world, cloth);
    std::vector<std::uint8_t> cells((columns - 1) * (rows - 1), 0);
    for (std::size_t r = 0; r + 1 < rows; ++r) {
        for (std::size_t c = 0; c + 1 < columns; ++c) {
            const std::size_t i = r * columns + c;
            std::uint8_t& cell = cells[r * (columns - 1) + c];
            if (along[i] != 0 && down[i] != 0) cell |= ClothGrid::upper;
            if (along[i + columns] != 0 && down[i + 1] != 0) cell |= ClothGrid::lower;
        }
    }
    return cells;
}

void draw_strands(DrawList& list, const Camera& camera, const rope::Body& body,
                  std::span<const glm::vec3> positions, std::span<const glm::vec3> colours, int sides) {
    if (body.kind == rope::Body::Kind::Hair) sides = strand_sides;
    for (std::size_t at = body.first; at < body.first + body.count; at += body.row)
        tube(list, camera, positions.subspan(at, body.row), body.radius, sides,
             colours.subspan(at, body.row));
}

void draw_cloth(DrawList& list, const Camera& camera, const NamedWorld& world, const rope::Body& body,
                std::span<const glm::vec3> positions, std::span<const glm::vec3> colours,
                const Palette& palette, const KindColours& kinds) {
    const bool plain = colours.empty();
    const glm::vec3 front = body_colour(world, body, palette, kinds);
    // A single thread has no surface.
    if (body.count > 1 && (body.row == 1 || body.rows() == 1)) {
        const std::vector<glm::vec3> thread(body.count, front);
        return tube(list, camera, positions.subspan(body.first, body.count), body.radius, strand_sides,
                    plain ? thread : colours.subspan(body.first, body.count));
    }
    const std::size_t size = body.row * body.rows();
    std::vector<glm::vec3> points(size, glm::vec3(std::numeric_limits<float>::quiet_NaN())), own;
    if (!plain) own.assign(size, palette.head);
    for (std::size_t i = 0; i < body.count; ++i) {
        points[body.cell(i)] = positions[body.first + i];
        if (!plain) own[body.cell(i)] = colours[body.first + i];
    }
    const std::vector<std::uint8_t> cells = whole_cells(world, body);
    const ClothGrid grid{static_cast<int>(body.row), static_cast<int>(body.rows()), points, cells};
    const bool by_kind = colour_of(world, body, kinds) == BodyColour::ByKind;
    const glm::vec3 back = by_kind ? palette.neutral : glm::mix(front, palette.neutral, 0.5f);
    cloth_surface(list, camera, grid, plain ? front : palette.head, back, own);
}

}  // namespace tendril::app
