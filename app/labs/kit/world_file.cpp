#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <tendril/magnitude.hpp>
#include <type_traits>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/kit/race.hpp"
#include "app/view/surfaces.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

// Rows of the file: the library's elements with the user's names.

struct ColliderRow {
    rope::Collider collider;
    std::string name;
};
struct BodyRow {
    rope::Body body;
    std::string name;
    BodyColour colour = BodyColour::ByKind;
};
constexpr auto no_collider = static_cast<std::size_t>(-1);
struct PinRow {
    rope::Pin pin;
    std::size_t collider = no_collider;
};
struct TieRow {
    rope::Tie tie;
    std::string name;
};
struct CollisionRow {
    std::array<std::size_t, 2> bodies{};
};

/// A world without the lists that files store as rows of numbers.
struct WorldRows {
    rope::Settings settings;
    double remainder = 0.0, moved_in = 0.0;
    std::uint64_t substeps = 0, dropped = 0;
    glm::dvec3 drift{0.0};
    std::vector<ColliderRow> colliders{};
    std::vector<BodyRow> bodies{};
    std::vector<PinRow> pins{};
    std::vector<TieRow> ties{};
    std::vector<CollisionRow> collisions{};
};

/// A row's own fields and those of its first member, which has the same address.
template <class Row, class First>
std::vector<Field> with_fields_of(First Row::*, std::initializer_list<Field> own) {
    static_assert(std::is_standard_layout_v<Row>);
    std::vector<Field> all(own);
    const std::span<const Field> first = fields<First>();
    all.insert(all.end(), first.begin(), first.end());
    return all;
}

constexpr std::size_t max_lab_collisions = max_lab_particles * (max_lab_particles + 1) / 2;
constexpr FieldRange times{0.0, 10.0}, counts{0.0, 9007199254740992.0};

}  // namespace
}  // namespace tendril::app

namespace tendril {

template <>
std::span<const Field> fields<app::ColliderRow>() noexcept {
    using Row = app::ColliderRow;
    static const auto rows = app::with_fields_of(&Row::collider, {field<&Row::name>("name").needed()});
    return rows;
}

template <>
std::span<const Field> fields<app::BodyRow>() noexcept {
    using Row = app::BodyRow;
    static constexpr auto colours = app::body_colours.name_array();
    static const auto rows = app::with_fields_of(
        &Row::body, {field<&Row::name>("name").needed(), field<&Row::colour>("colour", colours)});
    return rows;
}

template <>
std::span<const Field> fields<app::PinRow>() noexcept {
    using Row = app::PinRow;
    static const auto rows =
        app::with_fields_of(&Row::pin, {index<&Row::collider>("collider", "colliders", true)});
    return rows;
}

template <>
std::span<const Field> fields<app::TieRow>() noexcept {
    using Row = app::TieRow;
    static const auto rows = app::with_fields_of(&Row::tie, {field<&Row::name>("name").needed()});
    return rows;
}

template <>
std::span<const Field> fields<app::CollisionRow>() noexcept {
    static constexpr Field rows[] = {index<&app::CollisionRow::bodies>("", "bodies")};
    return rows;
}

template <>
std::span<const Field> fields<app::WorldRows>() noexcept {
    using app::WorldRows;
    static constexpr Field rows[] = {
        nested<&WorldRows::settings>("settings").needed(),
        field<&WorldRows::remainder>("remainder", app::times, "s").needed(),
        field<&WorldRows::moved_in>("moved_in", app::times, "s").needed(),
        field<&WorldRows::substeps>("substeps", app::counts).needed(),
        field<&WorldRows::dropped>("dropped", app::counts).needed(),
        field<&WorldRows::drift>("drift", {-max_magnitude, max_magnitude}, "m"),
        list<&WorldRows::colliders>("colliders").sparsely().up_to(app::max_lab_colliders).needed(),
        list<&WorldRows::bodies>("bodies").sparsely().up_to(app::max_lab_particles).needed(),
        list<&WorldRows::pins>("pins").sparsely().up_to(app::max_lab_particles).needed(),
        list<&WorldRows::ties>("ties").sparsely().up_to(app::max_lab_ties),
        list<&WorldRows::collisions>("collisions").up_to(app::max_lab_collisions)};
    return rows;
}

}  // namespace tendril

namespace tendril::app {
namespace {

constexpr const char* link_kinds[] = {"stretch", "shear", "bend"};

bool is_zero(const glm::dvec3& v) {
    const auto plus_zero = [](double x) { return x == 0.0 && !std::signbit(x); };
    return plus_zero(v.x) && plus_zero(v.y) && plus_zero(v.z);
}

/// [x, y, z, mass]; with the displacement of the last substep before the mass if it is not zero.
Json save_particle(const rope::State& state, std::size_t i) {
    Json row = dpoint(state.position[i]);
    if (const glm::dvec3& moved = state.displacement[i]; !is_zero(moved))
        for (int axis = 0; axis < 3; ++axis) row.push_back(moved[axis]);
    row.push_back(state.mass[i]);
    return row;
}

/// Older files have three more numbers, the displacement of the substep before; they are ignored.
void load_particle(rope::State& state, const JsonPlace& place) {
    const Json& row = place.json();
    if (!row.is_array() || (row.size() != 4 && row.size() != 7 && row.size() != 10))
        place.fail("expected a row of 4 or 7 numbers, found " + json_summary(row));
    const auto point_at = [&](std::size_t i) {
        return glm::dvec3(json_real(row[i], place.where()), json_real(row[i + 1], place.where()),
                          json_real(row[i + 2], place.where()));
    };
    state.position.push_back(point_at(0));
    state.displacement.push_back(row.size() > 4 ? point_at(3) : glm::dvec3(0.0));
    if (row.size() == 10) static_cast<void>(point_at(6));
    state.mass.push_back(json_real(row.back(), place.where(), 0.0, 1e30));
}

/// [a, b, rest, "stretch", compliance, tension]; trailing zeros are omitted.
Json save_link(const rope::Link& link) {
    Json row =
        Json::array({link.a, link.b, number(link.rest), link_kinds[static_cast<std::size_t>(link.kind)]});
    const bool tension = link.tension != 0.0f || std::signbit(link.tension);
    if (tension || link.compliance != 0.0f) row.push_back(number(link.compliance));
    if (tension) row.push_back(number(link.tension));
    return row;
}

rope::Link load_link(const JsonPlace& place, std::size_t particles) {
    const Json& row = place.json();
    if (!row.is_array() || row.size() < 4 || row.size() > 6)
        place.fail("expected [a, b, rest, kind, compliance, tension], found " + json_summary(row));
    const auto at = [&](std::size_t i) { return JsonPlace(row[i], place.where()); };
    const std::size_t last = particles == 0 ? 0 : particles - 1;
    rope::Link link;
    link.a = static_cast<std::uint32_t>(at(0).index(last));
    link.b = static_cast<std::uint32_t>(at(1).index(last));
    link.rest = at(2).number();
    const auto kind = std::ranges::find(link_kinds, at(3).text());
    if (kind == std::end(link_kinds)) place.fail("unknown kind " + json_summary(row[3]));
    link.kind = static_cast<rope::Link::Kind>(kind - link_kinds);
    if (row.size() > 4) link.compliance = at(4).number();
    // Newtons. Not limited to the usual range: stopping a heavy body at once can need more.
    if (row.size() > 5) link.tension = row[5].is_number() ? row[5].get<float>() : std::nanf("");
    if (!std::isfinite(link.tension)) place.fail("expected a finite number, found " + json_summary(row[5]));
    return link;
}

/// [a, b, x, y, z]
rope::BodyContact load_contact(const JsonPlace& place, std::size_t particles) {
    const Json& row = place.json();
    if (!row.is_array() || row.size() != 5)
        place.fail("expected [a, b, x, y, z], found " + json_summary(row));
    const auto at = [&](std::size_t i) { return JsonPlace(row[i], place.where()); };
    const std::size_t last = particles == 0 ? 0 : particles - 1;
    rope::BodyContact contact;
    contact.a = static_cast<std::uint32_t>(at(0).index(last));
    contact.b = static_cast<std::uint32_t>(at(1).index(last));
    for (int i = 0; i < 3; ++i)
        contact.force[i] = json_real(row[static_cast<std::size_t>(i) + 2], place.where());
    return contact;
}

}  // namespace

FieldsOf shape_fields(const rope::Collider& collider) {
    const Field& row = fields<rope::Collider>().front();
    return {row.kind(&collider).table(), row.address(&collider, 0)};
}

Json save_world(const NamedWorld& world) {
    const rope::State& state = world.state();
    WorldRows rows{.settings = state.settings,
                   .remainder = state.remainder,
                   .moved_in = state.displaced_in,
                   .substeps = state.substeps,
                   .dropped = state.dropped,
                   .drift = state.drift};
    for (const rope::Collider& each : state.colliders) rows.colliders.push_back({each, world.name(each)});
    for (const rope::Body& each : state.bodies)
        rows.bodies.push_back({each, world.name(each), world.colour(each)});
    for (const rope::Pin& each : state.pins) {
        const rope::Collider* const holder = world.holder(each);
        rows.pins.push_back({each, holder == nullptr
                                       ? no_collider
                                       : static_cast<std::size_t>(holder - state.colliders.data())});
    }
    for (const rope::Tie& each : state.ties) rows.ties.push_back({each, world.name(each)});
    const auto place_of = [&](rope::BodyId id) {
        return static_cast<std::size_t>(world.world().find(id) - state.bodies.data());
    };
    for (const rope::Collision& each : state.collisions) {
        const auto [a, b] = std::minmax({place_of(each.a), place_of(each.b)});
        rows.collisions.push_back({{a, b}});
    }
    std::ranges::sort(rows.collisions, {}, &CollisionRow::bodies);
    Json json = save_sparse_fields(rows), links = Json::array(), particles = Json::array();
    for (const rope::Link& link : state.links) links.push_back(save_link(link));
    for (std::size_t i = 0; i < state.position.size(); ++i) particles.push_back(save_particle(state, i));
    json["particles"] = std::move(particles);
    json["links"] = std::move(links);
    if (state.collisions.empty()) return json;
    Json& contacts = json["contacts"] = Json::array();
    for (const rope::BodyContact& each : state.contacts)
        contacts.push_back({each.a, each.b, each.force.x, each.force.y, each.force.z});
    return json;
}

NamedWorld load_world(const JsonPlace& place, std::span<const std::string_view> besides) {
    constexpr std::size_t max_links = 8 * max_lab_particles;  // a cloth has six for each particle
    std::vector<std::string_view> others{"particles", "links", "contacts"};
    others.insert(others.end(), besides.begin(), besides.end());
    rope::State state;
    // Sizes first: oversized lists are refused before they are read.
    place["particles"].for_each("particles", max_lab_particles,
                                [&](const JsonPlace& row) { load_particle(state, row); });
    const std::size_t size = state.position.size();
    WorldRows rows;
    load_known_fields(place, rows, others);
    state.settings = rows.settings;
    state.remainder = rows.remainder, state.displaced_in = rows.moved_in, state.drift = rows.drift;
    state.substeps = rows.substeps, state.dropped = rows.dropped;
    for (const ColliderRow& each : rows.colliders) state.colliders.push_back(each.collider);
    for (const BodyRow& each : rows.bodies) state.bodies.push_back(each.body);
    for (const TieRow& each : rows.ties) state.ties.push_back(each.tie);
    const auto numbered = [](std::size_t slot) { return static_cast<std::uint32_t>(slot); };
    for (const PinRow& each : rows.pins) {
        state.pins.push_back(each.pin);
        if (each.collider != no_collider) state.pins.back().collider = {numbered(each.collider), 1};
    }
    for (const auto& [pair] : rows.collisions)
        state.collisions.push_back({{numbered(pair[0]), 1}, {numbered(pair[1]), 1}});
    place["links"].for_each("links", max_links,
                            [&](const JsonPlace& row) { state.links.push_back(load_link(row, size)); });
    const auto names_of = [](const auto& list) {
        return names(list, [](const auto& row) { return row.name; });
    };
    if (place.has("collisions"))
        place["contacts"].for_each("contacts", 8 * max_lab_particles, [&](const JsonPlace& row) {
            state.contacts.push_back(load_contact(row, size));
        });
    NamedWorld world(std::move(state), names_of(rows.bodies), names_of(rows.colliders), names_of(rows.ties));
    for (const BodyRow& each : rows.bodies) world.set_colour(each.name, each.colour);
    return world;
}

// Drawing.

namespace {

constexpr float min_strain = 1e-4f, full_strain = 0.1f;
constexpr int strand_sides = 6;  // more make no visible difference on a hair

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
    const auto doublings = [](float above) {
        return math::logarithm(static_cast<double>(above / min_strain));
    };
    const auto share = static_cast<float>(doublings(std::max(size, min_strain)) / doublings(full_strain));
    // Start from a grey lighter than both, in either theme.
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
    // The worst strain of each particle's links.
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
