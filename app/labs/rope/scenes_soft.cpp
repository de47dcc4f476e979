// Scenes of cloth and hair: the same particles and links as a rope.
#include <tendril/rope/hair_roots.hpp>
#include <utility>

#include "app/labs/kit/require.hpp"
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
    rope::Settings settings = world.settings();
    settings.damping = 0.6f;
    world.set_settings(settings);
    return scene;
}

/// A ball swings into a curtain that hangs by two corners. Pull it about by any point, and let go: it hangs
/// again.
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
    rope::Settings settings = world.settings();
    settings.damping = 0.6f;
    world.set_settings(settings);
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
    // Up and back, so that the face stays free.
    const rope::HairPatch patch{.direction = glm::vec3(0, 0.8f, -0.6f), .strands = 140, .radius = 0.3f};
    hair.roots = require_value(roots_on(head, patch, hair.radius));
    world.add_hair("hair", std::move(hair), "head");
    scene.swings.push_back({"head", centre, {0.16f, 0.0f, 0.0f}, 2.6f});
    rope::Settings settings = world.settings();
    settings.damping = 1.0f;
    settings.friction = 0.3f;
    world.set_settings(settings);
    return scene;
}

}  // namespace tendril::app
