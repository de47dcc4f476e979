// Scenes with cloth and hair, which use the same particles and links as ropes.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <tendril/rope/hair_roots.hpp>
#include <utility>
#include <vector>

#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/scenes.hpp"

namespace tendril::app {

/// A cloth falls over a ball.
RopeScene cloth_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    world.add_collider("ball", rope::Sphere{{0.0f, 0.62f, 0.0f}, 0.45f});
    world.add_cloth("cloth", {.corner = {-0.85f, 1.25f, -0.85f},
                              .along = {1.7f, 0, 0},
                              .down = {0, 0, 1.7f},
                              .columns = 32,
                              .rows = 32,
                              .radius = 0.012f,
                              .density = 0.3f,
                              .tear = 0.3f});
    world.set_settings({.damping = 0.6f});
    return scene;
}

/// A ball swings into a curtain that hangs by two corners. Dragged by any point and released, it hangs again.
RopeScene curtain_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr int side = 28;
    constexpr float rail = 1.85f, half = 0.65f, length = 1.3f;
    for (const float x : {-half, half})
        world.add_collider(x < 0 ? "left hook" : "right hook", rope::Sphere{{x, rail + 0.03f, 0}, 0.03f});
    world.add_cloth("curtain", {.corner = {-half, rail - 0.02f, 0},
                                .along = {2.0f * half, 0, 0},
                                .down = {0, -length, 0},
                                .columns = side,
                                .rows = side,
                                .density = 0.3f,
                                .pins = rope::ClothShape::Pins::Corners});
    const glm::vec3 middle(0.1f, 1.0f, 0.6f);
    world.add_collider("ball", rope::Sphere{middle, 0.22f});
    scene.swings.push_back({"ball", middle, {-0.15f, 0.0f, -0.75f}, 4.0f});
    world.set_settings({.damping = 0.6f});
    return scene;
}

/// A flag on a pole.
RopeScene flag_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr float top = 2.0f, pole = 0.025f, at = -0.8f, length = 1.5f, height = 0.9f;
    world.add_collider("pole", rope::Capsule{{at, 0, 0}, {at, top, 0}, pole});
    world.add_cloth("flag", {.corner = {at + pole + 0.015f, top - 0.05f, 0},
                             .along = {0, -height, 0},
                             .down = {length, 0, 0},
                             .columns = 18,
                             .rows = 30,
                             .density = 0.2f,
                             .shear = 0.03f,
                             .bend = 0.002f,  // canvas: softer cloth crumples at its free edge
                             .pins = rope::ClothShape::Pins::Corners});
    world.set_settings({.wind = {7.0f, 0, 0.5f}, .gusts = 0.5f});
    return scene;
}

/// A washing line: a cloth hangs by ties on a slack rope between two posts.
RopeScene line_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr float end = 1.1f, height = 1.8f, post = 0.05f, half = 0.5f, tie = 0.04f;
    constexpr int columns = 13, segments = 48, apart = 2;
    for (const float x : {-end, end})
        world.add_collider(x < 0 ? "left post" : "right post",
                           rope::Capsule{{x, 0, 0}, {x, height + 0.05f, 0}, post});
    const float from = end - post - 0.02f;
    world.add_rope("line", {.from = {-from, height, 0},
                            .to = {from, height, 0},
                            .segments = segments,
                            .length = 2.0f * from * 1.04f,
                            .radius = 0.015f,
                            .density = 0.3f,
                            .pin_start = true,
                            .pin_end = true});
    world.add_cloth("cloth", {.corner = {-half, height - 0.34f, 0},
                              .along = {2.0f * half, 0, 0},
                              .down = {0, -0.8f, 0},
                              .columns = columns,
                              .rows = 11});
    // Tie each to the particle of the rope above it.
    for (int column = 0; column < columns; column += apart) {
        const float part =
            0.5f + half * (2.0f * static_cast<float>(column) / (columns - 1) - 1.0f) / (2.0f * from);
        world.tie({}, world.particle("line", static_cast<std::size_t>(std::lround(part * segments))),
                  world.particle("cloth", static_cast<std::size_t>(column)), {.length = tie});
    }
    world.set_settings({.damping = 0.4f, .wind = {0.4f, 0, 2.2f}});
    return scene;
}

/// A curtain on rings: each a rope tied to a loop about a rail, and to the hem. A hand draws it to and fro.
RopeScene rings_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr float rail = 1.9f, end = 1.15f, thick = 0.02f, loop = 0.05f, half = 0.6f, length = 1.3f;
    constexpr int columns = 13, rows = 13, apart = 2, segments = 10;
    for (const float x : {-end, end})
        world.add_collider(x < 0 ? "left post" : "right post",
                           rope::Capsule{{x, 0, 0}, {x, rail, 0}, 2.0f * thick});
    world.add_collider("rail", rope::Capsule{{-end, rail, 0}, {end, rail, 0}, thick});
    const float middle = rail + thick + 0.01f - loop, hem = middle - loop - 0.02f;
    world.add_cloth("curtain", {.corner = {-half, hem, 0},
                                .along = {2.0f * half, 0, 0},
                                .down = {0, -length, 0},
                                .columns = columns,
                                .rows = rows,
                                .density = 0.25f});
    for (int column = 0; column < columns; column += apart) {
        const float x = half * (2.0f * static_cast<float>(column) / (columns - 1) - 1.0f);
        std::vector<glm::vec3> line;
        for (int k = 0; k <= segments; ++k) {
            const float angle = glm::two_pi<float>() * static_cast<float>(k) / segments;
            line.push_back({x, middle - loop * std::cos(angle), loop * std::sin(angle)});
        }
        const std::string ring = "ring " + std::to_string(column / apart + 1);
        world.add_rope(
            ring,
            {.from = line.front(), .to = line[1], .segments = segments, .radius = 0.006f, .density = 0.5f});
        lay(world, ring, line);
        world.tie({}, world.particle(ring, 0), world.particle(ring, segments));
        world.tie({}, world.particle(ring, 0), world.particle("curtain", static_cast<std::size_t>(column)),
                  {.length = middle - loop - hem});
    }
    const glm::vec3 hand(-half - 0.06f, hem, 0.0f);
    world.add_collider("hand", rope::Sphere{hand, 0.03f});
    world.attach(world.particle("curtain", 0), "hand");
    scene.swings.push_back({"hand", hand, {0.28f, 0.0f, 0.0f}, 8.0f});
    world.set_settings({.damping = 0.6f, .friction = 0.05f});
    return scene;
}

/// Hair on a head that turns to and fro, over shoulders that do not.
RopeScene hair_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    const glm::vec3 centre(0.0f, 1.45f, 0.0f);
    const rope::Sphere head{centre, 0.2f};
    world.add_collider("head", head);
    world.add_collider("neck", rope::Capsule{{0, 1.05f, 0}, {0, 1.3f, 0}, 0.07f});
    world.add_collider("shoulders", rope::Capsule{{-0.26f, 0.98f, 0}, {0.26f, 0.98f, 0}, 0.11f});
    rope::HairShape hair{.length = 0.48f, .segments = 14, .radius = 0.004f, .density = 0.02f, .bend = 0.5f};
    // Directed up and back, to leave the face free.
    const rope::HairPatch patch{.direction = glm::vec3(0, 0.8f, -0.6f), .strands = 140, .spread = 0.3f};
    hair.roots = require_value(roots_on(head, patch, hair.radius));
    world.add_hair("hair", std::move(hair), "head");
    scene.swings.push_back({"head", centre, {0.16f, 0.0f, 0.0f}, 2.6f});
    world.set_settings({.damping = 1.0f, .friction = 0.3f});
    return scene;
}

}  // namespace tendril::app
