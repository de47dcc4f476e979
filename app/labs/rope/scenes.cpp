#include "app/labs/rope/body_commands.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tendril/magnitude.hpp>
#include <tendril/rope/hair_roots.hpp>
#include <variant>

#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/view/assets.hpp"

namespace tendril::app {
namespace {

struct SceneCollider {
    std::string name;
    rope::Shape shape;
};

struct SceneBody {
    std::string name;
    std::variant<rope::RopeShape, rope::ClothShape, rope::HairShape> shape;
    std::vector<glm::vec3> path;   ///< a rope lies evenly along it; empty: straight
    double end_mass = 0.0;         ///< kg, mass of a rope's last particle; 0: by its density
    std::vector<glm::dvec3> fold;  ///< for a cloth: offsets of a row's particles from the first, unfolded one
    rope::HairPatch patch;         ///< where hair grows, on `attach` if given
    std::string attach;
    bool hits_itself = false;
};

struct ScenePin {
    std::string body;
    int particle = 0;
    std::optional<glm::vec3> at;  ///< empty: moves with the collider
    double seconds = 0.0;         ///< to reach `at`
    std::string collider;
};

struct SceneTie {
    std::string a, b;
    int a_particle = 0, b_particle = 0;
    rope::TieShape shape;
    std::string name;
};

struct SceneFile {
    rope::Settings settings;
    std::vector<SceneCollider> colliders;
    std::vector<SceneBody> bodies;
    std::vector<ScenePin> pins;
    std::vector<SceneTie> ties;
    std::vector<Swing> swings;
};

constexpr FieldRange anywhere{-max_magnitude, max_magnitude}, any_index{0.0, max_lab_particles};

}  // namespace
}  // namespace tendril::app

namespace tendril {

template <>
std::span<const Field> fields<app::SceneCollider>() noexcept {
    using app::SceneCollider;
    static constexpr Field rows[] = {field<&SceneCollider::name>("name"),
                                     kinds<&SceneCollider::shape>("kind", rope::shape_kinds)};
    return rows;
}

template <>
std::span<const Field> fields<app::SceneBody>() noexcept {
    using app::SceneBody;
    static constexpr Field rows[] = {field<&SceneBody::name>("name"),
                                     kinds<&SceneBody::shape>("kind", rope::body_kinds),
                                     list<&SceneBody::path>("path", app::anywhere, "m").up_to(1000),
                                     field<&SceneBody::end_mass>("end_mass", {0.0, max_magnitude}, "kg"),
                                     list<&SceneBody::fold>("fold", app::anywhere, "m").up_to(1000),
                                     nested<&SceneBody::patch>("patch"),
                                     field<&SceneBody::attach>("attach"),
                                     field<&SceneBody::hits_itself>("hits_itself")};
    return rows;
}

template <>
std::span<const Field> fields<app::ScenePin>() noexcept {
    using app::ScenePin;
    static constexpr Field rows[] = {
        field<&ScenePin::body>("body").omissible(), field<&ScenePin::particle>("particle", app::any_index),
        field<&ScenePin::at>("at", app::anywhere, "m"), field<&ScenePin::seconds>("seconds", {0.0, 1e9}, "s"),
        field<&ScenePin::collider>("collider")};
    return rows;
}

template <>
std::span<const Field> fields<app::SceneTie>() noexcept {
    using app::SceneTie;
    static constexpr Field rows[] = {field<&SceneTie::a>("a").omissible(),
                                     field<&SceneTie::a_particle>("a_particle", app::any_index),
                                     field<&SceneTie::b>("b"),
                                     field<&SceneTie::b_particle>("b_particle", app::any_index),
                                     nested<&SceneTie::shape>("shape"),
                                     field<&SceneTie::name>("name")};
    return rows;
}

template <>
std::span<const Field> fields<app::SceneFile>() noexcept {
    using app::SceneFile;
    static constexpr Field rows[] = {nested<&SceneFile::settings>("settings"),
                                     list<&SceneFile::colliders>("colliders").up_to(app::max_lab_colliders),
                                     list<&SceneFile::bodies>("bodies").up_to(app::max_lab_particles),
                                     list<&SceneFile::pins>("pins").up_to(app::max_lab_particles),
                                     list<&SceneFile::ties>("ties").up_to(app::max_lab_ties),
                                     list<&SceneFile::swings>("swings").up_to(app::max_lab_colliders)};
    return rows;
}

}  // namespace tendril

namespace tendril::app {
namespace {

/// The point at a distance along a polyline.
glm::dvec3 along(const std::vector<glm::vec3>& line, double distance) {
    for (std::size_t i = 1; i < line.size(); ++i) {
        const glm::dvec3 a(line[i - 1]), b(line[i]);
        const double length = glm::distance(a, b);
        if (distance <= length || i + 1 == line.size())
            return length > 0.0 ? glm::mix(a, b, std::min(distance / length, 1.0)) : b;
        distance -= length;
    }
    return glm::dvec3(line.back());
}

/// Places a rope along its path at rest, and sets the mass of its end.
void shape_rope(const SceneBody& given, const rope::Body& body, rope::State& state) {
    double length = 0.0;
    for (std::size_t i = 1; i < given.path.size(); ++i)
        length += glm::distance(glm::dvec3(given.path[i - 1]), glm::dvec3(given.path[i]));
    const double step = length / static_cast<double>(body.count - 1);
    for (std::size_t i = 0; i < body.count && !given.path.empty(); ++i)
        state.position[body.first + i] = along(given.path, step * static_cast<double>(i));
    const auto inside = [&](std::size_t particle) { return particle - body.first < body.count; };
    for (rope::Link& link : state.links)
        if (inside(link.a) && !given.path.empty())
            link.rest = static_cast<float>(glm::distance(state.position[link.a], state.position[link.b]));
    for (rope::Pin& pin : state.pins)
        if (inside(pin.particle)) pin.goal = state.position[pin.particle];
    if (given.end_mass > 0.0) state.mass[body.first + body.count - 1] = given.end_mass;
}

/// Folds a cloth, with pressed creases: its shear and bend links rest at their folded lengths.
void fold_cloth(const std::vector<glm::dvec3>& fold, const rope::Body& body, rope::State& state) {
    for (std::size_t row = body.first; row < body.first + body.count; row += body.row)
        for (std::size_t i = body.row; i-- > 0;) state.position[row + i] = state.position[row] + fold[i];
    for (rope::Link& link : state.links)
        if (link.a - body.first < body.count && link.kind != rope::Link::Kind::Stretch)
            link.rest = static_cast<float>(glm::distance(state.position[link.a], state.position[link.b]));
}

void add(NamedWorld& world, const SceneBody& given) {
    if (const auto* cloth = std::get_if<rope::ClothShape>(&given.shape)) {
        world.add_cloth(given.name, *cloth);
    } else if (const auto* hair = std::get_if<rope::HairShape>(&given.shape)) {
        const rope::Collider* const head = world.find_collider(given.attach);
        rope::HairShape rooted = *hair;
        rooted.roots = require_value(head != nullptr ? roots_on(head->shape, given.patch, hair->radius)
                                                     : roots_around(given.patch));
        world.add_hair(given.name, std::move(rooted), given.attach);
    } else {
        world.add_rope(given.name, std::get<rope::RopeShape>(given.shape));
    }
    const rope::Body& body = *world.find(given.name);
    rope::State state = world.state();
    if (!given.path.empty() || given.end_mass > 0.0)
        shape_rope(given, body, state);
    else if (given.fold.size() == body.row)
        fold_cloth(given.fold, body, state);
    else
        return;
    world.put(std::move(state));
}

}  // namespace

const std::vector<RopeSceneEntry>& rope_scenes() {
    static const std::vector<RopeSceneEntry> list = [] {
        std::vector<RopeSceneEntry> all;
        for (const Json& each : parse_json(presets_source(rope_lab)))
            all.push_back({each.at("name"), each.at("title"), each.at("help"),
                           load_camera(each.at("camera"), "camera"), each.at("world")});
        return all;
    }();
    return list;
}

RopePart make_rope_scene(const RopeSceneEntry& entry) {
    SceneFile file;
    load_known_fields({entry.world, entry.name}, file);
    NamedWorld world;
    for (const SceneCollider& each : file.colliders) world.add_collider(each.name, each.shape);
    for (const SceneBody& each : file.bodies) add(world, each);
    const auto particle = [&](const std::string& body, int index) {
        return world.particle(body, static_cast<std::size_t>(index));
    };
    for (const ScenePin& each : file.pins)
        if (each.at)
            world.pin(particle(each.body, each.particle), glm::dvec3(*each.at), each.seconds);
        else
            world.attach(particle(each.body, each.particle), each.collider);
    for (const SceneTie& each : file.ties)
        world.tie(each.name, particle(each.a, each.a_particle), particle(each.b, each.b_particle),
                  each.shape);
    for (const SceneBody& each : file.bodies)
        if (each.hits_itself) world.set_collides(each.name, each.name, true);
    world.set_settings(file.settings);
    RopePart part;
    part.world = std::make_shared<const NamedWorld>(std::move(world));
    part.usual = file.settings;
    part.swings = std::move(file.swings);
    return part;
}

}  // namespace tendril::app
