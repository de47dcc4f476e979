#include "app/labs/kit/world_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/fields/fields.hpp"

namespace tendril::app {
namespace {

constexpr const char* body_kinds[] = {"rope", "cloth", "hair"};
constexpr const char* body_kinds_of_version_1[] = {"rope", "sheet", "lock"};
constexpr const char* link_kinds[] = {"stretch", "shear", "bend"};

/// The enumerator with this name.
template <class Kind, std::size_t count>
Kind kind_of(const JsonPlace& place, const char* const (&kinds)[count]) {
    const std::string text = place.text();
    for (std::size_t i = 0; i < count; ++i)
        if (text == kinds[i]) return static_cast<Kind>(i);
    place.fail("unknown kind " + json_summary(place.json()));
}

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

/// Newtons. Not limited to the usual range: stopping a heavy body at once can need more.
float load_tension(const JsonPlace& place) {
    const float tension = place.json().is_number() ? place.json().get<float>() : std::nanf("");
    if (!std::isfinite(tension)) place.fail("expected a finite number, found " + json_summary(place.json()));
    return tension;
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
    link.kind = kind_of<rope::Link::Kind>(at(3), link_kinds);
    if (row.size() > 4) link.compliance = at(4).number();
    if (row.size() > 5) link.tension = load_tension(at(5));
    return link;
}

/// Names of bodies or colliders, in file order.
using Names = std::vector<std::string>;

Json save_body(const NamedWorld& world, const rope::Body& body) {
    Json json{{"name", world.name(body)}, {"kind", body_kind_name(body.kind)},
              {"first", body.first},      {"count", body.count},
              {"row", body.row},          {"radius", number(body.radius)}};
    if (!body.cells.empty()) json["cells"] = body.cells;
    if (body.tear != 0.0f) json["tear"] = number(body.tear);
    if (body.bending != 0.0f) json["bending"] = number(body.bending);
    if (body.friction) json["friction"] = number(*body.friction);
    if (body.stretch != 0.0f) json["stretch"] = number(body.stretch);
    if (const BodyColour colour = world.colour(body); colour != BodyColour::ByKind)
        json["colour"] = body_colours.name(colour);
    return json;
}

rope::Body::Kind load_body_kind(const JsonPlace& place) {
    for (std::size_t i = 0; i < std::size(body_kinds_of_version_1); ++i)
        if (place.json() == body_kinds_of_version_1[i]) return static_cast<rope::Body::Kind>(i);
    return kind_of<rope::Body::Kind>(place, body_kinds);
}

rope::Body load_body(const JsonPlace& place) {
    rope::Body body;
    body.kind = load_body_kind(place["kind"]);
    body.first = place["first"].index(max_lab_particles);
    body.count = place["count"].index(max_lab_particles);
    body.row = place["row"].index(max_lab_particles);
    body.radius = place["radius"].number();
    if (const auto cells = place.optional("cells"))
        cells->for_each("cells", max_lab_particles, [&](const JsonPlace& each) {
            body.cells.push_back(static_cast<std::uint32_t>(each.index(rope::max_particles - 1)));
        });
    if (const auto tear = place.optional("tear")) body.tear = tear->number();
    if (const auto bending = place.optional("bending")) body.bending = bending->number();
    if (const auto friction = place.optional("friction")) body.friction = friction->number();
    if (const auto stretch = place.optional("stretch")) body.stretch = stretch->number();
    return body;
}

Json save_pin(const NamedWorld& world, const rope::Pin& pin) {
    Json json{{"particle", pin.particle}, {"goal", dpoint(pin.goal)}};
    if (pin.seconds != 0.0) json["seconds"] = pin.seconds;
    if (const rope::Collider* holder = world.holder(pin)) json["collider"] = world.name(*holder);
    return json;
}

rope::Pin load_pin(const JsonPlace& place, std::size_t particles, const Names& colliders) {
    rope::Pin pin;
    pin.particle = place["particle"].index(particles == 0 ? 0 : particles - 1);
    pin.goal = place["goal"].dpoint();
    if (const auto seconds = place.optional("seconds")) pin.seconds = seconds->real(0.0, 1e9);
    if (const auto collider = place.optional("collider")) {
        const std::string name = collider->text();
        const auto found = std::find(colliders.begin(), colliders.end(), name);
        if (found == colliders.end()) place.fail("moves with \"" + name + "\", which is not a collider");
        pin.collider = {static_cast<std::uint32_t>(found - colliders.begin()), 1};  // as slots are numbered
    }
    return pin;
}

Json save_tie(const rope::Tie& tie, const std::string& name) {
    const rope::TieShape shape{.length = tie.length, .strength = tie.strength};
    Json json{{"name", name}, {"a", tie.a}, {"b", tie.b}, {"now", number(tie.now)}};
    json.update(save_fields(shape));
    if (tie.tension != 0.0f || std::signbit(tie.tension)) json["tension"] = number(tie.tension);
    return json;
}

rope::Tie load_tie(const JsonPlace& place, std::size_t particles) {
    const std::size_t last = particles == 0 ? 0 : particles - 1;
    rope::TieShape shape;
    load_fields(place, shape);
    rope::Tie tie;
    tie.a = static_cast<std::uint32_t>(place["a"].index(last));
    tie.b = static_cast<std::uint32_t>(place["b"].index(last));
    tie.length = shape.length, tie.strength = shape.strength;
    tie.now = place["now"].number();
    if (const auto tension = place.optional("tension")) tie.tension = load_tension(*tension);
    return tie;
}

Json save_collider(const rope::Collider& collider, const std::string& name) {
    Json json{{"name", name}};
    json.update(save_shape(collider.shape));
    json["goal"] = dpoint(collider.goal);
    if (collider.seconds != 0.0) json["seconds"] = collider.seconds;
    if (collider.half_goal) json["half_goal"] = dpoint(*collider.half_goal);
    if (collider.drive.any()) json["drive"] = save_fields(collider.drive);
    return json;
}

rope::Shape load_shape(const JsonPlace& place) {
    const JsonPlace kind = place["kind"];
    const rope::Shape* const blank = blank_shape(kind.text());
    if (blank == nullptr) kind.fail("unknown kind \"" + kind.text() + "\"");
    rope::Shape shape = *blank;
    load_all_fields(place, shape_fields_in(shape));
    return shape;
}

rope::Collider load_collider(const JsonPlace& place) {
    rope::Collider collider;
    collider.shape = load_shape(place);
    collider.goal = place["goal"].dpoint();
    if (const auto seconds = place.optional("seconds")) collider.seconds = seconds->real(0.0, 1e9);
    if (const auto half = place.optional("half_goal")) collider.half_goal = half->dpoint();
    if (const auto drive = place.optional("drive")) load_fields(*drive, collider.drive);
    return collider;
}

/// Pairs of names, in the order of bodies.
Json save_collisions(const NamedWorld& world) {
    const auto& bodies = world.state().bodies;
    Json pairs = Json::array();
    for (std::size_t a = 0; a < bodies.size(); ++a)
        for (std::size_t b = a; b < bodies.size(); ++b) {
            const std::string &first = world.name(bodies[a]), &second = world.name(bodies[b]);
            if (world.collides(first, second)) pairs.push_back({first, second});
        }
    return pairs;
}

void load_collisions(const JsonPlace& place, const Names& bodies, rope::State& state) {
    const auto body = [&](const JsonPlace& name) {
        const auto found = std::find(bodies.begin(), bodies.end(), name.text());
        if (found == bodies.end()) name.fail("there is no body " + json_summary(name.json()));
        return rope::BodyId{static_cast<std::uint32_t>(found - bodies.begin()), 1};  // as slots are numbered
    };
    place.for_each("collisions", bodies.size() * (bodies.size() + 1) / 2, [&](const JsonPlace& pair) {
        if (!pair.json().is_array() || pair.json().size() != 2)
            pair.fail("expected the names of two bodies, found " + json_summary(pair.json()));
        const auto at = [&](std::size_t i) { return JsonPlace(pair.json()[i], pair.where()); };
        state.collisions.push_back({body(at(0)), body(at(1))});
    });
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

const char* body_kind_name(rope::Body::Kind kind) {
    return body_kinds[static_cast<std::size_t>(kind)];
}

std::span<const rope::Shape> blank_shapes() {
    static const rope::Shape list[] = {rope::Sphere{}, rope::Capsule{}, rope::Plane{}, rope::Box{}};
    return list;
}

const rope::Shape* blank_shape(std::string_view kind) {
    const auto found = std::ranges::find(blank_shapes(), kind, rope::kind);
    return found == blank_shapes().end() ? nullptr : &*found;
}

FieldsOf shape_fields_of(const rope::Shape& shape) {
    return {rope::shape_fields(shape),
            std::visit([](const auto& each) -> const void* { return &each; }, shape)};
}

FieldsIn shape_fields_in(rope::Shape& shape) {
    return {rope::shape_fields(shape), std::visit([](auto& each) -> void* { return &each; }, shape)};
}

Json save_shape(const rope::Shape& shape) {
    Json json{{"kind", rope::kind(shape)}};
    json.update(save_fields(shape_fields_of(shape)));
    return json;
}

Json save_world(const NamedWorld& world) {
    const rope::State& state = world.state();
    Json bodies = Json::array(), links = Json::array(), particles = Json::array();
    Json pins = Json::array(), colliders = Json::array();
    for (const rope::Body& body : state.bodies) bodies.push_back(save_body(world, body));
    for (const rope::Link& link : state.links) links.push_back(save_link(link));
    for (std::size_t i = 0; i < state.position.size(); ++i) particles.push_back(save_particle(state, i));
    for (const rope::Pin& pin : state.pins) pins.push_back(save_pin(world, pin));
    for (const rope::Collider& collider : state.colliders)
        colliders.push_back(save_collider(collider, world.name(collider)));
    Json json{{"settings", save_fields(state.settings)},
              {"remainder", state.remainder},
              {"moved_in", state.displaced_in},
              {"substeps", state.substeps},
              {"dropped", state.dropped},
              {"drift", dpoint(state.drift)},
              {"colliders", std::move(colliders)},
              {"bodies", std::move(bodies)},
              {"pins", std::move(pins)},
              {"particles", std::move(particles)},
              {"links", std::move(links)}};
    if (!state.ties.empty()) {
        Json& ties = json["ties"] = Json::array();
        for (const rope::Tie& tie : state.ties) ties.push_back(save_tie(tie, world.name(tie)));
    }
    if (!state.collisions.empty()) {
        json["collisions"] = save_collisions(world);
        Json& contacts = json["contacts"] = Json::array();
        for (const rope::BodyContact& each : state.contacts)
            contacts.push_back({each.a, each.b, each.force.x, each.force.y, each.force.z});
    }
    return json;
}

NamedWorld load_world(const JsonPlace& place) {
    constexpr std::uint64_t most = std::uint64_t{1} << 53;
    constexpr std::size_t max_links = 8 * max_lab_particles;  // a cloth has six for each particle
    rope::State state;
    Names body_names, collider_names, tie_names;
    // Sizes first: oversized lists are refused before they are read.
    place["particles"].for_each("particles", max_lab_particles,
                                [&](const JsonPlace& row) { load_particle(state, row); });
    const std::size_t size = state.position.size();
    load_fields(place["settings"], state.settings);
    state.remainder = place["remainder"].real(0.0, 10.0);
    state.displaced_in = place["moved_in"].real(0.0, 10.0);
    state.substeps = place["substeps"].count(most);
    state.dropped = place["dropped"].count(most);
    if (const auto drift = place.optional("drift")) state.drift = drift->dpoint();  // newer than the wind
    place["colliders"].for_each("colliders", max_lab_colliders, [&](const JsonPlace& each) {
        state.colliders.push_back(load_collider(each));
        collider_names.push_back(each["name"].text());
    });
    place["bodies"].for_each("bodies", max_lab_particles, [&](const JsonPlace& each) {
        state.bodies.push_back(load_body(each));
        body_names.push_back(each["name"].text());
    });
    place["pins"].for_each("pins", size, [&](const JsonPlace& each) {
        state.pins.push_back(load_pin(each, size, collider_names));
    });
    place["links"].for_each("links", max_links,
                            [&](const JsonPlace& row) { state.links.push_back(load_link(row, size)); });
    if (const auto ties = place.optional("ties"))
        ties->for_each("ties", max_lab_ties, [&](const JsonPlace& each) {
            state.ties.push_back(load_tie(each, size));
            tie_names.push_back(each["name"].text());
        });
    if (const auto collisions = place.optional("collisions")) {
        load_collisions(*collisions, body_names, state);
        place["contacts"].for_each("contacts", 8 * max_lab_particles, [&](const JsonPlace& row) {
            state.contacts.push_back(load_contact(row, size));
        });
    }
    NamedWorld world(std::move(state), body_names, collider_names, tie_names);
    place["bodies"].for_each("bodies", max_lab_particles, [&](const JsonPlace& each) {
        if (const auto colour = each.optional("colour"))
            world.set_colour(each["name"].text(), colour->choice(body_colours));
    });
    return world;
}

}  // namespace tendril::app
