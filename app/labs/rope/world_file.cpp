#include "app/labs/rope/world_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {
namespace {

constexpr const char* body_kinds[] = {"rope", "cloth", "hair"};
constexpr const char* body_kinds_of_version_1[] = {"rope", "sheet", "lock"};
constexpr const char* link_kinds[] = {"stretch", "shear", "bend"};

[[noreturn]] void fail(const std::string& where, const std::string& what) {
    throw std::runtime_error(where + ": " + what);
}

/// The enumerator whose name the text is.
template <class Kind, std::size_t count>
Kind kind_of(const Json& json, const std::string& where, const char* const (&kinds)[count]) {
    const std::string text = json_text(json, where);
    for (std::size_t i = 0; i < count; ++i)
        if (text == kinds[i]) return static_cast<Kind>(i);
    fail(where, "unknown kind " + json_summary(json));
}

std::size_t size_of(const Json& json, const std::string& where, std::size_t high) {
    return static_cast<std::size_t>(json_count(json, where, high));
}

/// Each element of a list of at most `most`, with the place where it stands.
template <class Take>
void for_each(const Json& json, const std::string& where, const char* what, std::size_t most, Take take) {
    if (!json.is_array()) fail(where, "expected a list, found " + json_summary(json));
    if (json.size() > most) {
        fail(where,
             "has " + std::to_string(json.size()) + " " + what + "; the most is " + std::to_string(most));
    }
    for (std::size_t i = 0; i < json.size(); ++i) take(json[i], where + "." + std::to_string(i));
}

bool is_zero(const glm::dvec3& v) {
    const auto plus_zero = [](double x) { return x == 0.0 && !std::signbit(x); };
    return plus_zero(v.x) && plus_zero(v.y) && plus_zero(v.z);
}

/// [x, y, z, mass], and before the mass what it moved in the last substep and in the one before, where it
/// did.
Json save_particle(const rope::State& state, std::size_t i) {
    Json row = dpoint(state.position[i]);
    if (!is_zero(state.displacement[i]) || !is_zero(state.earlier[i])) {
        for (const glm::dvec3& v : {state.displacement[i], state.earlier[i]})
            for (int axis = 0; axis < 3; ++axis) row.push_back(v[axis]);
    }
    row.push_back(state.mass[i]);
    return row;
}

void load_particle(rope::State& state, const Json& row, const std::string& where) {
    if (!row.is_array() || (row.size() != 4 && row.size() != 10))
        fail(where, "expected a row of 4 or 10 numbers, found " + json_summary(row));
    const auto point_at = [&](std::size_t i) {
        return glm::dvec3(json_real(row[i], where), json_real(row[i + 1], where),
                          json_real(row[i + 2], where));
    };
    const bool moved = row.size() == 10;
    state.position.push_back(point_at(0));
    state.displacement.push_back(moved ? point_at(3) : glm::dvec3(0.0));
    state.earlier.push_back(moved ? point_at(6) : glm::dvec3(0.0));
    state.mass.push_back(json_real(row.back(), where, 0.0, 1e30));
}

/// [a, b, rest, "stretch", compliance, tension]; zeros at its end are left out.
Json save_link(const rope::Link& link) {
    Json row =
        Json::array({link.a, link.b, number(link.rest), link_kinds[static_cast<std::size_t>(link.kind)]});
    const bool tension = link.tension != 0.0f || std::signbit(link.tension);
    if (tension || link.compliance != 0.0f) row.push_back(number(link.compliance));
    if (tension) row.push_back(number(link.tension));
    return row;
}

/// Newtons, which may be more than any other number: a heavy thing stops at once.
float load_tension(const Json& json, const std::string& where) {
    const float tension = json.is_number() ? json.get<float>() : std::nanf("");
    if (!std::isfinite(tension)) fail(where, "expected a finite number, found " + json_summary(json));
    return tension;
}

rope::Link load_link(const Json& row, const std::string& where, std::size_t particles) {
    if (!row.is_array() || row.size() < 4 || row.size() > 6)
        fail(where, "expected [a, b, rest, kind, compliance, tension], found " + json_summary(row));
    const std::size_t last = particles == 0 ? 0 : particles - 1;
    rope::Link link;
    link.a = static_cast<std::uint32_t>(size_of(row[0], where, last));
    link.b = static_cast<std::uint32_t>(size_of(row[1], where, last));
    link.rest = json_number(row[2], where);
    link.kind = kind_of<rope::Link::Kind>(row[3], where, link_kinds);
    if (row.size() > 4) link.compliance = json_number(row[4], where);
    if (row.size() > 5) link.tension = load_tension(row[5], where);
    return link;
}

/// Names as they stand in a file, of bodies or colliders.
using Names = std::vector<std::string>;

Json save_body(const rope::Body& body, const std::string& name) {
    Json json{{"name", name},        {"kind", body_kind_name(body.kind)},
              {"first", body.first}, {"count", body.count},
              {"row", body.row},     {"radius", number(body.radius)}};
    if (body.tear != 0.0f) json["tear"] = number(body.tear);
    if (body.stretch != 0.0f) json["stretch"] = number(body.stretch);
    return json;
}

rope::Body::Kind load_body_kind(const Json& json, const std::string& where) {
    for (std::size_t i = 0; i < std::size(body_kinds_of_version_1); ++i)
        if (json == body_kinds_of_version_1[i]) return static_cast<rope::Body::Kind>(i);
    return kind_of<rope::Body::Kind>(json, where, body_kinds);
}

rope::Body load_body(const Json& json, const std::string& where) {
    const auto read = [&](const char* key) -> const Json& { return json_member(json, key, where); };
    const auto size = [&](const char* key) {
        return size_of(read(key), where + "." + key, max_lab_particles);
    };
    rope::Body body;
    body.kind = load_body_kind(read("kind"), where + ".kind");
    body.first = size("first");
    body.count = size("count");
    body.row = size("row");
    body.radius = json_number(read("radius"), where + ".radius");
    if (json.contains("tear")) body.tear = json_number(json["tear"], where + ".tear");
    if (json.contains("stretch")) body.stretch = json_number(json["stretch"], where + ".stretch");
    return body;
}

Json save_pin(const NamedWorld& world, const rope::Pin& pin) {
    Json json{{"particle", pin.particle}, {"goal", dpoint(pin.goal)}};
    if (pin.seconds != 0.0) json["seconds"] = pin.seconds;
    if (const rope::Collider* holder = world.holder(pin)) json["collider"] = world.name(*holder);
    return json;
}

rope::Pin load_pin(const Json& json, const std::string& where, std::size_t particles,
                   const Names& colliders) {
    rope::Pin pin;
    pin.particle = size_of(json_member(json, "particle", where), where + ".particle",
                           particles == 0 ? 0 : particles - 1);
    pin.goal = json_dpoint(json_member(json, "goal", where), where + ".goal");
    if (json.contains("seconds")) pin.seconds = json_real(json["seconds"], where + ".seconds", 0.0, 1e9);
    if (json.contains("collider")) {
        const std::string name = json_text(json["collider"], where + ".collider");
        const auto found = std::find(colliders.begin(), colliders.end(), name);
        if (found == colliders.end()) fail(where, "moves with \"" + name + "\", which is no collider");
        pin.collider = {static_cast<std::uint32_t>(found - colliders.begin()), 1};  // as slots are numbered
    }
    return pin;
}

Json save_collider(const rope::Collider& collider, const std::string& name) {
    Json json{{"name", name}};
    const Json shape = save_shape(collider.shape);
    for (const auto& [key, value] : shape.items()) json[key] = value;
    json["goal"] = dpoint(collider.goal);
    if (collider.seconds != 0.0) json["seconds"] = collider.seconds;
    return json;
}

glm::quat load_rotation(const Json& json, const std::string& where) {
    if (!json.is_array() || json.size() != 4)
        fail(where, "expected a quaternion [x, y, z, w], found " + json_summary(json));
    const auto at = [&](std::size_t i) { return json_number(json[i], where); };
    return {at(3), at(0), at(1), at(2)};
}

rope::Shape load_shape(const Json& json, const std::string& where) {
    const auto point_of = [&](const char* key) {
        return json_point(json_member(json, key, where), where + "." + key);
    };
    const auto radius = [&] { return json_number(json_member(json, "radius", where), where + ".radius"); };
    const std::string kind = json_text(json_member(json, "kind", where), where + ".kind");
    if (kind == "sphere") return rope::Sphere{point_of("centre"), radius()};
    if (kind == "capsule") return rope::Capsule{point_of("a"), point_of("b"), radius()};
    if (kind == "plane") return rope::Plane{point_of("point"), point_of("normal")};
    if (kind == "box") {
        return rope::Box{point_of("centre"), point_of("half_extents"),
                         load_rotation(json_member(json, "rotation", where), where + ".rotation")};
    }
    fail(where + ".kind", "unknown kind \"" + kind + "\"");
}

rope::Collider load_collider(const Json& json, const std::string& where) {
    rope::Collider collider;
    collider.shape = load_shape(json, where);
    collider.goal = json_dpoint(json_member(json, "goal", where), where + ".goal");
    if (json.contains("seconds")) collider.seconds = json_real(json["seconds"], where + ".seconds", 0.0, 1e9);
    return collider;
}

rope::Settings load_settings(const Json& json, const std::string& where) {
    const auto place = [&](const char* key) { return where + "." + key; };
    const auto read = [&](const char* key) -> const Json& { return json_member(json, key, where); };
    const auto real = [&](const char* key) { return json_number(read(key), place(key)); };
    rope::Settings settings;
    settings.substep = json_real(read("substep"), place("substep"));
    settings.iterations = json_integer(read("iterations"), place("iterations"), 1, rope::max_iterations);
    settings.solver = solver_from_name(json_text(read("solver"), place("solver")));
    settings.damping = real("damping");
    settings.gravity = json_point(read("gravity"), place("gravity"));
    settings.gravity_scale = real("gravity_scale");
    settings.external = json_point(read("external"), place("external"));
    settings.compliance = real("compliance");
    settings.friction = real("friction");
    settings.longest_frame = real("longest_frame");
    return settings;
}

}  // namespace

const char* body_kind_name(rope::Body::Kind kind) {
    return body_kinds[static_cast<std::size_t>(kind)];
}

rope::Solver solver_from_name(const std::string& name) {
    for (const rope::Solver solver : all_solvers)
        if (name == rope::name(solver)) return solver;
    throw std::invalid_argument("unknown solver \"" + name + "\"");
}

Json save_settings(const rope::Settings& settings) {
    return Json{{"substep", settings.substep},           {"iterations", settings.iterations},
                {"solver", rope::name(settings.solver)}, {"damping", number(settings.damping)},
                {"gravity", point(settings.gravity)},    {"gravity_scale", number(settings.gravity_scale)},
                {"external", point(settings.external)},  {"compliance", number(settings.compliance)},
                {"friction", number(settings.friction)}, {"longest_frame", number(settings.longest_frame)}};
}

Json save_shape(const rope::Shape& shape) {
    Json json{{"kind", rope::kind(shape)}};
    if (const auto* sphere = std::get_if<rope::Sphere>(&shape)) {
        json["centre"] = point(sphere->centre);
        json["radius"] = number(sphere->radius);
    } else if (const auto* capsule = std::get_if<rope::Capsule>(&shape)) {
        json["a"] = point(capsule->a);
        json["b"] = point(capsule->b);
        json["radius"] = number(capsule->radius);
    } else if (const auto* plane = std::get_if<rope::Plane>(&shape)) {
        json["point"] = point(plane->point);
        json["normal"] = point(plane->normal);
    } else if (const auto* box = std::get_if<rope::Box>(&shape)) {
        const glm::quat& q = box->rotation;
        json["centre"] = point(box->centre);
        json["half_extents"] = point(box->half_extents);
        json["rotation"] = Json::array({number(q.x), number(q.y), number(q.z), number(q.w)});
    }
    return json;
}

Json save_world(const NamedWorld& world) {
    const rope::State& state = world.state();
    Json bodies = Json::array(), links = Json::array(), particles = Json::array();
    Json pins = Json::array(), colliders = Json::array();
    for (const rope::Body& body : state.bodies) bodies.push_back(save_body(body, world.name(body)));
    for (const rope::Link& link : state.links) links.push_back(save_link(link));
    for (std::size_t i = 0; i < state.position.size(); ++i) particles.push_back(save_particle(state, i));
    for (const rope::Pin& pin : state.pins) pins.push_back(save_pin(world, pin));
    for (const rope::Collider& collider : state.colliders)
        colliders.push_back(save_collider(collider, world.name(collider)));
    return Json{{"settings", save_settings(state.settings)},
                {"remainder", state.remainder},
                {"moved_in", state.displaced_in},
                {"substeps", state.substeps},
                {"dropped", state.dropped},
                {"colliders", std::move(colliders)},
                {"bodies", std::move(bodies)},
                {"pins", std::move(pins)},
                {"particles", std::move(particles)},
                {"links", std::move(links)}};
}

NamedWorld load_world(const Json& json, const std::string& where) {
    const auto place = [&](const char* key) { return where + "." + key; };
    const auto read = [&](const char* key) -> const Json& { return json_member(json, key, where); };
    constexpr std::uint64_t most = std::uint64_t{1} << 53;
    constexpr std::size_t most_links = 8 * max_lab_particles;  // a cloth has six to a particle
    rope::State state;
    Names body_names, collider_names;
    // The sizes first: what is too large is refused before anything of it is read.
    for_each(read("particles"), place("particles"), "particles", max_lab_particles,
             [&](const Json& row, const std::string& here) { load_particle(state, row, here); });
    const std::size_t size = state.position.size();
    state.settings = load_settings(read("settings"), place("settings"));
    state.remainder = json_real(read("remainder"), place("remainder"), 0.0, 10.0);
    state.displaced_in = json_real(read("moved_in"), place("moved_in"), 0.0, 10.0);
    state.substeps = json_count(read("substeps"), place("substeps"), most);
    state.dropped = json_count(read("dropped"), place("dropped"), most);
    for_each(read("colliders"), place("colliders"), "colliders", max_lab_colliders,
             [&](const Json& each, const std::string& here) {
                 state.colliders.push_back(load_collider(each, here));
                 collider_names.push_back(json_text(json_member(each, "name", here), here + ".name"));
             });
    for_each(read("bodies"), place("bodies"), "bodies", max_lab_particles,
             [&](const Json& each, const std::string& here) {
                 state.bodies.push_back(load_body(each, here));
                 body_names.push_back(json_text(json_member(each, "name", here), here + ".name"));
             });
    for_each(read("pins"), place("pins"), "pins", size, [&](const Json& each, const std::string& here) {
        state.pins.push_back(load_pin(each, here, size, collider_names));
    });
    for_each(
        read("links"), place("links"), "links", most_links,
        [&](const Json& row, const std::string& here) { state.links.push_back(load_link(row, here, size)); });
    return {std::move(state), body_names, collider_names};
}

}  // namespace tendril::app
