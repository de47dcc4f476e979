#include "app/labs/rope/scenes.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/document/names.hpp"

namespace tendril::app {
namespace {

CameraPose view(glm::vec3 target, float yaw, float pitch, float distance) {
    return {.target = target, .yaw = glm::radians(yaw), .pitch = glm::radians(pitch), .distance = distance};
}

/// The point at a distance along a line of points.
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

}  // namespace

const std::vector<RopeSceneEntry>& rope_scenes() {
    static const std::vector<RopeSceneEntry> list{
        {"drape", "Drape", "Two hands bring a rope down over a ball and a bar; shorter ones fall beside it",
         drape_scene, view({0.0f, 1.05f, 0.0f}, -24.0f, 16.0f, 5.6f)},
        {"bridge", "Bridge",
         "A deck of ropes and two hand ropes between four posts, and a ball that rolls over it", bridge_scene,
         view({0.0f, 0.85f, 0.0f}, -32.0f, 18.0f, 6.4f)},
        {"pendulum", "Pendula",
         "Pendulums of different lengths: they make waves, fall apart and find together again",
         pendulum_scene, view({0.0f, 0.75f, 0.0f}, -40.0f, 12.0f, 4.2f)},
        {"well", "Well", "A rope over the drum of a well, with a bucket at one end and a hand at the other",
         well_scene, view({0.0f, 0.85f, 0.0f}, -28.0f, 16.0f, 4.6f)},
        {"cloth", "Cloth", "A cloth falls over a ball", cloth_scene,
         view({0.0f, 0.65f, 0.0f}, -28.0f, 24.0f, 4.6f)},
        {"hair", "Hair", "Hair on a head that turns to and fro, over shoulders that do not", hair_scene,
         view({0.0f, 1.2f, 0.0f}, -20.0f, 8.0f, 2.9f)},
        {"bars", "Thin bars",
         "Ropes of 8, 45 and 160 segments fall on bars that get thinner; none gains energy", bars_scene,
         view({0.0f, 0.75f, 0.0f}, -24.0f, 14.0f, 4.8f)},
        {"curtain", "Curtain",
         "A ball swings into a cloth that hangs by two corners; pull it about and let go", curtain_scene,
         view({0.0f, 1.0f, 0.0f}, -24.0f, 10.0f, 4.2f)}};
    return list;
}

const RopeSceneEntry& rope_scene(const std::string& name) {
    return named(
        rope_scenes(), [](const RopeSceneEntry& each) { return each.name; }, name, "scene");
}

RopeScene make_rope_scene(const RopeSceneEntry& entry) {
    return entry.make();
}

void add_ground(NamedWorld& world) {
    world.add_collider("ground", rope::Plane{{0, 0, 0}, {0, 1, 0}});
}

void lay(NamedWorld& world, const std::string& rope, const std::vector<glm::vec3>& line) {
    rope::State state = world.state();
    const rope::Body& body = *world.find(rope);
    double length = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += glm::distance(glm::dvec3(line[i - 1]), glm::dvec3(line[i]));
    const double step = length / static_cast<double>(body.count - 1);
    for (std::size_t i = 0; i < body.count; ++i)
        state.position[body.first + i] = along(line, step * static_cast<double>(i));
    for (rope::Link& link : state.links) {
        if (link.a < body.first || link.a >= body.first + body.count) continue;
        link.rest = static_cast<float>(glm::distance(state.position[link.a], state.position[link.b]));
    }
    for (rope::Pin& pin : state.pins) {
        if (pin.particle >= body.first && pin.particle < body.first + body.count && !pin.collider)
            pin.goal = state.position[pin.particle];
    }
    world.put(std::move(state));
}

void weigh_down(NamedWorld& world, const std::string& rope, std::size_t count, double kilograms) {
    rope::State state = world.state();
    const rope::Body& body = *world.find(rope);
    for (std::size_t i = 0; i < count; ++i)
        state.mass[body.first + body.count - 1 - i] = kilograms / static_cast<double>(count);
    world.put(std::move(state));
}

}  // namespace tendril::app
