#include "app/labs/rope/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/document/names.hpp"

namespace tendril::app {
namespace {

CameraPose view(glm::vec3 target, float yaw, float pitch, float distance) {
    return {.target = target, .yaw = glm::radians(yaw), .pitch = glm::radians(pitch), .distance = distance};
}

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

}  // namespace

const std::vector<RopeSceneEntry>& rope_scenes() {
    static const std::vector<RopeSceneEntry> list{
        {"drape", "Drape", "Two hands bring a rope down over a ball and a bar; shorter ones fall beside it",
         drape_scene, view({0.0f, 1.05f, 0.0f}, -24.0f, 16.0f, 5.6f)},
        {"bridge", "Bridge",
         "A deck of ropes and two hand ropes between four posts, and a ball that rolls over it", bridge_scene,
         view({0.0f, 0.85f, 0.0f}, -32.0f, 18.0f, 6.4f)},
        {"pendulum", "Pendula",
         "Pendulums of different lengths: they form waves, drift apart and fall into step again",
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
         view({0.0f, 1.0f, 0.0f}, -24.0f, 10.0f, 4.2f)},
        {"flag", "Flag", "A flag flutters in a gusty wind", flag_scene,
         view({0.0f, 1.1f, 0.0f}, -32.0f, 14.0f, 4.6f)},
        {"line", "Cloth line", "A cloth tied to a rope, which bends under it, in a light wind", line_scene,
         view({0.0f, 1.15f, 0.0f}, -26.0f, 12.0f, 4.4f)},
        {"hangers", "Hangers", "A deck hangs by ropes from two main ropes, every end tied", hanger_scene,
         view({0.0f, 0.95f, 0.0f}, -30.0f, 14.0f, 6.2f)},
        {"mail", "Chain mail", "Rings of rope, tied each to the next, fall over a ball", mail_scene,
         view({0.0f, 0.65f, 0.0f}, -28.0f, 26.0f, 4.4f)},
        {"knot", "Knot", "A weight pulls a loose knot tight, in a rope that collides with itself", knot_scene,
         view({0.0f, 1.35f, 0.0f}, -24.0f, 8.0f, 3.6f)},
        {"net", "Net", "A ball sinks into a net of ropes that are tied wherever they cross", net_scene,
         view({0.0f, 0.95f, 0.0f}, -30.0f, 20.0f, 4.8f)},
        {"rings", "Rings", "A hand draws a curtain to and fro, on rings that slide along a rail", rings_scene,
         view({0.0f, 1.1f, 0.0f}, -24.0f, 10.0f, 4.2f)},
        {"crane", "Crane", "A trolley carries a load along a jib; a rope in a hand steers it", crane_scene,
         view({0.0f, 1.15f, 0.2f}, -28.0f, 12.0f, 5.2f)},
        {"folded", "Folded", "A cloth lies folded in four: its layers rest on each other", folded_scene,
         view({0.0f, 0.05f, 0.0f}, -30.0f, 22.0f, 1.1f)}};
    return list;
}

const RopeSceneEntry& rope_scene(std::string_view name) {
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

// Scenes with ropes.

/// Two hands lower a rope over a ball and a bar; shorter ropes fall over the bar beside it.
RopeScene drape_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    world.add_collider("ball", rope::Sphere{{-0.65f, 0.95f, 0.0f}, 0.4f});
    world.add_collider("bar", rope::Capsule{{0.8f, 1.1f, -0.7f}, {0.8f, 1.1f, 0.7f}, 0.14f});
    // Starts taut above everything, so that it ends up lying on top.
    const float height = 1.9f, hands = 1.55f, half = 2.1f;
    world.add_rope("rope", {.from = {-half, height, 0},
                            .to = {half, height, 0},
                            .segments = 80,
                            .pin_start = true,
                            .pin_end = true});
    world.pin(world.particle("rope", 0), {-hands, height, 0}, 1.2);
    world.pin(world.particle("rope", 80), {hands, height, 0}, 1.2);
    const float lengths[] = {1.8f, 1.4f, 2.0f};
    const float places[] = {-0.5f, 0.28f, 0.55f};
    for (int i = 0; i < 3; ++i) {
        const float length = lengths[i], shift = 0.05f * static_cast<float>(i - 1);
        world.add_rope("short " + std::to_string(i + 1),
                       {.from = {0.8f + shift - 0.5f * length, 1.45f, places[i]},
                        .to = {0.8f + shift + 0.5f * length, 1.45f, places[i]},
                        .segments = 36,
                        .radius = 0.016f});
    }
    world.set_settings({.damping = 0.8f});  // dangling ends come to rest within half a minute
    return scene;
}

/// A deck of ropes and two hand ropes between four posts, with a ball rolling to and fro.
RopeScene bridge_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    const float end = 2.0f, side = 0.36f, deck = 0.95f, hand = 1.5f, thick = 0.06f;
    add_ground(world);
    for (const float x : {-end, end}) {
        for (const float z : {-side, side}) {
            const std::string name = std::string(x < 0 ? "left" : "right") + (z < 0 ? " far" : " near");
            world.add_collider(name + " post", rope::Capsule{{x, 0, z}, {x, hand + 0.08f, z}, thick});
        }
    }
    const float from = end - thick - 0.03f;
    for (const float z : {-side, side}) {
        world.add_rope(z < 0 ? "far hand rope" : "near hand rope", {.from = {-from, hand, z},
                                                                    .to = {from, hand, z},
                                                                    .segments = 64,
                                                                    .length = 2.0f * from * 1.03f,
                                                                    .pin_start = true,
                                                                    .pin_end = true});
    }
    constexpr int strands = 6;
    const float half = side - 0.1f;
    for (int i = 0; i < strands; ++i) {
        const float z = half * (2.0f * static_cast<float>(i) / (strands - 1) - 1.0f);
        world.add_rope("deck " + std::to_string(i + 1), {.from = {-from, deck, z},
                                                         .to = {from, deck, z},
                                                         .segments = 64,
                                                         .length = 2.0f * from * 1.01f,
                                                         .radius = 0.025f,
                                                         .density = 2.0f,
                                                         .pin_start = true,
                                                         .pin_end = true});
    }
    const glm::vec3 roll(0.0f, 0.92f, 0.0f);  // low enough to press the deck down
    world.add_collider("ball", rope::Sphere{roll, 0.22f});
    scene.swings.push_back({"ball", roll, {1.1f, 0.0f, 0.0f}, 9.0f});
    world.set_settings({.damping = 0.6f, .friction = 0.2f});
    return scene;
}

/// A suspension bridge. Main ropes, hangers and deck are separate ropes, tied to each other. Each main rope
/// begins as a parabola in the plane of its hangers, close to its rest position.
RopeScene hanger_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    constexpr float end = 2.0f, thick = 0.05f, half = end - thick - 0.03f;
    constexpr float top = 1.9f, side = 0.45f, deck = 0.72f, camber = 0.08f, sag = 0.95f;
    constexpr int deck_segments = 40, main_segments = 56, apart = 4, points = 64;
    add_ground(world);
    for (const float x : {-end, end}) {
        const std::string where = x < 0 ? "left" : "right";
        for (const float z : {-side, side})
            world.add_collider(where + (z < 0 ? " far post" : " near post"),
                               rope::Capsule{{x, 0, z}, {x, top + thick, z}, thick});
        world.add_collider(where + " bank",
                           rope::Box{{1.14f * x, 0.5f * deck, 0}, {0.22f, 0.5f * deck, side - 2.0f * thick}});
    }
    const auto line = [&](auto at) {
        std::vector<glm::vec3> all;
        for (int i = 0; i <= points; ++i)
            all.push_back(at(half * (2.0f * static_cast<float>(i) / points - 1.0f)));
        return all;
    };
    const auto arch = [&](float x) { return 1.0f - (x / half) * (x / half); };
    const auto add = [&](const std::string& name, int segments, float radius, float density,
                         const std::vector<glm::vec3>& along) {
        world.add_rope(name, {.from = along.front(),
                              .to = along.back(),
                              .segments = segments,
                              .radius = radius,
                              .density = density,
                              .pin_start = true,
                              .pin_end = true});
        lay(world, name, along);
    };
    add("deck", deck_segments, 0.035f, 3.0f,
        line([&](float x) { return glm::vec3(x, deck + camber * arch(x), 0.0f); }));
    for (const float z : {-side, side}) {
        const std::string which = z < 0 ? "far" : "near", main = which + " main rope";
        const glm::vec3 down = glm::normalize(glm::vec3(0.0f, deck - top, -z));
        add(main, main_segments, 0.02f, 0.8f,
            line([&](float x) { return glm::vec3(x, top, z) + sag * arch(x) * down; }));
        std::size_t above = world.particle(main, 0);
        for (std::size_t i = apart; i < deck_segments; i += apart) {
            const std::size_t below = world.particle("deck", i);
            while (world.position(above).x < world.position(below).x) ++above;
            const std::string hanger = which + " hanger " + std::to_string(i / apart);
            world.add_rope(hanger, {.from = world.position(above),
                                    .to = world.position(below),
                                    .segments = 4,
                                    .radius = 0.01f,
                                    .density = 0.2f});
            world.tie({}, above, world.particle(hanger, 0));
            world.tie({}, world.particle(hanger, 4), below);
        }
    }
    world.set_settings({.damping = 1.0f});
    return scene;
}

/// An overhand knot in a hanging rope: a trefoil, cut open at the tip of a lobe, where its ends lead up and
/// down.
RopeScene knot_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr float top = 2.3f, middle = 1.75f, size = 0.04f, depth = 0.065f, radius = 0.014f, opened = 0.15f;
    constexpr int pieces = 240;
    const auto trefoil = [](float t) {
        // Rotated so that the lobe that is cut points along +X.
        constexpr float lobe = glm::pi<float>() / 3.0f, turn = -glm::pi<float>() / 6.0f;
        t += lobe;
        const float x = std::sin(t) + 2.0f * std::sin(2.0f * t), y = std::cos(t) - 2.0f * std::cos(2.0f * t);
        const float c = std::cos(turn), s = std::sin(turn);
        return glm::vec3(size * (c * x - s * y - 3.0f), middle + size * (s * x + c * y),
                         -depth * std::sin(3.0f * t));
    };
    std::vector<glm::vec3> line;
    for (int i = 0; i <= pieces; ++i)
        line.push_back(
            trefoil(opened + (glm::two_pi<float>() - 2.0f * opened) * static_cast<float>(i) / pieces));
    if (line[0].y < line[1].y) std::reverse(line.begin(), line.end());
    const glm::vec3 first = line.front(), last = line.back();
    line.insert(line.begin(), {first.x, top, first.z});
    line.push_back({last.x, last.y - 0.25f, last.z});
    world.add_rope("rope", {.from = line.front(),
                            .to = line.back(),
                            .segments = 160,
                            .radius = radius,
                            .density = 0.3f,
                            .pin_start = true});
    lay(world, "rope", line);
    weigh_down(world, "rope", 1, 0.5);
    world.set_collides("rope", "rope", true);
    // The impact when the knot closes needs finer steps.
    world.set_settings({.substep = 1.0 / 480.0, .damping = 0.6f, .friction = 0.15f});
    return scene;
}

/// A cloth folded in four, like a concertina. A crease is a row of particles that stand out halfway between
/// two layers, so that every thread keeps its length.
RopeScene folded_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr int layers = 4, cells = 10, rows = 6;
    constexpr float cell = 0.024f, radius = 0.008f;  // narrow, for round folds
    const float width = cell * layers * cells, depth = 0.36f;
    world.add_cloth("cloth", {.corner = {0, 0, -0.5f * depth},
                              .along = {width, 0, 0},
                              .down = {0, 0, depth},
                              .columns = layers * cells + 1,
                              .rows = rows,
                              .radius = radius});
    rope::State state = world.state();
    const double apart = 2.02 * static_cast<double>(radius), flat = cell * (cells - 2.0f);
    const double out = std::sqrt(cell * cell - 0.25 * apart * apart);
    for (std::size_t i = 0; i < state.position.size(); ++i) {
        const int column = static_cast<int>(i % (layers * cells + 1));
        const int layer = std::min(column / cells, layers - 1), along = column - layer * cells;
        const bool crease = along == 0 && layer > 0;
        const double end = crease ? -out : static_cast<double>(cell) * (along - 1);
        glm::dvec3& p = state.position[i];
        p.x = (layer % 2 == 0 ? end : flat - end) - 0.5 * flat;
        p.y = static_cast<double>(radius) + apart * (layer - (crease ? 0.5 : 0.0));
    }
    // The creases are pressed: the rest lengths of shear and bend links are those of the folded cloth.
    for (rope::Link& link : state.links)
        if (link.kind != rope::Link::Kind::Stretch)
            link.rest = static_cast<float>(glm::distance(state.position[link.a], state.position[link.b]));
    world.put(std::move(state));
    world.set_collides("cloth", "cloth", true);
    return scene;
}

/// Each pendulum swings a whole number of times in half a minute, one more than its neighbour: together they
/// form waves, drift apart and meet again.
RopeScene pendulum_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr int count = 11, slowest_swings = 18;
    constexpr float seconds = 30.0f, beam = 1.4f, apart = 0.17f, amplitude = 0.45f;
    const float half = 0.5f * apart * (count - 1) + 0.18f;
    world.add_collider("beam", rope::Capsule{{-half, beam + 0.05f, 0}, {half, beam + 0.05f, 0}, 0.04f});
    for (const float x : {-half, half})
        world.add_collider(x < 0 ? "left post" : "right post",
                           rope::Capsule{{x, 0, 0}, {x, beam + 0.05f, 0}, 0.04f});
    for (int i = 0; i < count; ++i) {
        const float period = seconds / static_cast<float>(slowest_swings + i);
        const float turn = period / glm::two_pi<float>();
        const float length = 9.81f * turn * turn;
        const glm::vec3 pivot(apart * (static_cast<float>(i) - 0.5f * (count - 1)), beam - 0.01f, 0.0f);
        const std::string name = "pendulum " + std::to_string(i + 1);
        world.add_rope(name, {.from = pivot,
                              .to = pivot + length * glm::vec3(0, -std::cos(amplitude), std::sin(amplitude)),
                              .segments = 6,
                              .radius = 0.012f,
                              .density = 0.02f,
                              .pin_start = true});
        weigh_down(world, name, 1, 0.5);
    }
    world.set_settings({.damping = 0.0f});
    return scene;
}

/// Ropes of few and many segments fall on ever thinner bars. Only contact loses energy: watch the curve.
RopeScene bars_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    const struct {
        float x, bar;
        int segments;
    } pairs[] = {{-1.1f, 0.1f, 8}, {0.0f, 0.034f, 45}, {1.1f, 0.015f, 160}};
    constexpr float height = 0.8f, fall = 0.6f, half = 0.5f;
    for (const auto& [x, bar, segments] : pairs) {
        const std::string size = std::to_string(segments);
        world.add_collider("bar " + size, rope::Capsule{{x, height, -0.6f}, {x, height, 0.6f}, bar});
        // Off centre, so that the rope slides down on one side.
        const float middle = x + 0.06f;
        world.add_rope("rope " + size, {.from = {middle - half, height + fall, 0},
                                        .to = {middle + half, height + fall, 0},
                                        .segments = segments});
    }
    world.set_settings({.damping = 0.0f, .friction = 0.2f});
    return scene;
}

/// A rope over the drum of a well, pulled by a hand at one end, with a bucket at the other.
RopeScene well_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    const float drum = 1.6f, radius = 0.16f, rope_radius = 0.018f, shaft = 0.5f;
    const float out = radius + rope_radius + 0.002f;
    for (const float z : {-0.62f, 0.62f})
        world.add_collider(z < 0 ? "far post" : "near post", rope::Capsule{{0, 0, z}, {0, drum, z}, 0.05f});
    world.add_collider("drum", rope::Capsule{{0, drum, -0.5f}, {0, drum, 0.5f}, radius});
    constexpr int stones = 10;
    for (int i = 0; i < stones; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / stones;
        const glm::vec3 centre(out + shaft * std::cos(angle), 0.2f, shaft * std::sin(angle));
        world.add_collider(
            "stone " + std::to_string(i + 1),
            rope::Box{centre, {0.05f, 0.2f, 0.155f}, glm::angleAxis(-angle, glm::vec3(0, 1, 0))});
    }
    const glm::vec3 hand(-1.15f, 0.75f, 0.0f);
    constexpr float fist = 0.06f;
    world.add_collider("hand", rope::Sphere{hand, fist});
    // From the hand up to the drum, over it, and down into the shaft.
    const glm::vec3 axis(0, drum, 0);
    const float reach = glm::distance(hand, axis);
    const float touch = std::atan2(hand.y - axis.y, hand.x - axis.x) - std::acos(out / reach);
    const glm::vec3 tangent = axis + out * glm::vec3(std::cos(touch), std::sin(touch), 0);
    const glm::vec3 pull = glm::normalize(tangent - hand);
    std::vector<glm::vec3> line{hand + (fist + rope_radius + 0.005f) * pull};
    constexpr int pieces = 24;
    const float over = touch < 0.0f ? touch + glm::two_pi<float>() : touch;
    for (int i = 0; i <= pieces; ++i) {
        const float angle = over * (1.0f - static_cast<float>(i) / pieces);
        line.push_back(axis + out * glm::vec3(std::cos(angle), std::sin(angle), 0));
    }
    line.push_back({out, 0.55f, 0.0f});
    constexpr int segments = 96;
    world.add_rope("rope", {.from = hand,
                            .to = hand + glm::vec3(0, 1, 0),
                            .segments = segments,
                            .radius = rope_radius,
                            .density = 0.4f});
    lay(world, "rope", line);
    weigh_down(world, "rope", 1, 0.6);
    world.attach(world.particle("rope", 0), "hand");
    scene.swings.push_back({"hand", hand, 0.24f * pull, 6.0f});
    // A weight over a drum needs finer steps.
    world.set_settings({.substep = 1.0 / 480.0, .damping = 0.4f, .friction = 0.15f});
    return scene;
}

/// Ropes tied wherever they cross, slung between four posts. A ball sinks into them and comes up again.
RopeScene net_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr int cells = 6, between = 4, segments = cells * between;
    constexpr float half = 0.85f, height = 1.5f, sag = 0.25f, post = 0.045f;
    // Begins close to its rest position.
    const auto at = [&](float x, float z) {
        return glm::vec3(half * x, height - sag * (2.0f - x * x - z * z), half * z);
    };
    const auto part = [](int i, int of) {
        return 2.0f * static_cast<float>(i) / static_cast<float>(of) - 1.0f;
    };
    const auto name = [](bool along, int i) {
        return std::string(along ? "along " : "across ") + std::to_string(i + 1);
    };
    for (const bool along : {true, false}) {
        for (int i = 0; i <= cells; ++i) {
            std::vector<glm::vec3> line;
            for (int k = 0; k <= segments; ++k) {
                const float x = part(k, segments), z = part(i, cells);
                line.push_back(along ? at(x, z) : at(z, x));
            }
            world.add_rope(name(along, i), {.from = line.front(),
                                            .to = line.back(),
                                            .segments = segments,
                                            .radius = 0.012f,
                                            .density = 0.2f});
            lay(world, name(along, i), line);
        }
    }
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j)
            world.tie({}, world.particle(name(true, i), static_cast<std::size_t>(j * between)),
                      world.particle(name(false, j), static_cast<std::size_t>(i * between)));
    for (const int i : {0, cells}) {
        for (const int j : {0, cells}) {
            const glm::vec3 corner = at(part(j, cells), part(i, cells));
            const glm::vec3 foot = corner * glm::vec3(1.08f, 0.0f, 1.08f);
            world.add_collider(std::string(j == 0 ? "left" : "right") + (i == 0 ? " far" : " near") + " post",
                               rope::Capsule{foot, foot + glm::vec3(0, height + 0.05f, 0), post});
            world.pin(world.particle(name(true, i), static_cast<std::size_t>(j * between)), corner);
        }
    }
    const glm::vec3 middle(0.05f, 1.65f, -0.05f);
    world.add_collider("ball", rope::Sphere{middle, 0.22f});
    scene.swings.push_back({"ball", middle, {0.0f, -0.65f, 0.0f}, 6.0f});
    world.set_settings({.damping = 0.6f});
    return scene;
}

/// A load on a rope from a trolley that runs along a jib, and a rope to steer it by, held by a hand.
RopeScene crane_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    constexpr float top = 2.3f, mast = -1.2f, jib = 0.05f;
    world.add_collider("mast", rope::Capsule{{mast, 0, 0}, {mast, top, 0}, 0.07f});
    world.add_collider("jib", rope::Capsule{{mast - 0.4f, top, 0}, {1.3f, top, 0}, jib});
    const glm::vec3 trolley(0.15f, top - jib - 0.05f, 0.0f);
    world.add_collider("trolley", rope::Box{trolley, {0.11f, 0.05f, 0.08f}});
    scene.swings.push_back({"trolley", trolley, {0.7f, 0.0f, 0.0f}, 9.0f});
    constexpr int hoist_segments = 32;
    const glm::vec3 hook = trolley - glm::vec3(0, 0.07f, 0), load = hook - glm::vec3(0, 1.3f, 0);
    world.add_rope("hoist",
                   {.from = hook, .to = load, .segments = hoist_segments, .radius = 0.012f, .density = 0.2f});
    weigh_down(world, "hoist", 1, 25.0);
    world.attach(world.particle("hoist", 0), "trolley");
    const glm::vec3 hand(0.75f, 0.25f, 0.8f);
    world.add_collider("hand", rope::Sphere{hand, 0.06f});
    constexpr int tag_segments = 32;
    world.add_rope("tag line", {.from = load,
                                .to = hand + glm::vec3(-0.04f, 0.07f, -0.04f),
                                .segments = tag_segments,
                                .length = 1.5f,
                                .radius = 0.01f,
                                .density = 0.1f});
    world.attach(world.particle("tag line", tag_segments), "hand");
    world.tie("shackle", world.particle("hoist", hoist_segments), world.particle("tag line", 0));
    world.set_settings({.damping = 0.3f});
    return scene;
}

/// Rings, each a rope whose ends are tied, and each tied to its four neighbours, fall over a ball.
RopeScene mail_scene() {
    RopeScene scene;
    NamedWorld& world = scene.world;
    add_ground(world);
    world.add_collider("ball", rope::Sphere{{0.0f, 0.62f, 0.0f}, 0.42f});
    constexpr int side = 8, segments = 8, quarter = segments / 4;
    constexpr float apart = 0.2f, radius = 0.085f, height = 1.2f;
    const auto name = [](int i, int j) {
        return "ring " + std::to_string(i + 1) + "." + std::to_string(j + 1);
    };
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const glm::vec3 middle(apart * (static_cast<float>(j) - 0.5f * (side - 1)), height,
                                   apart * (static_cast<float>(i) - 0.5f * (side - 1)));
            std::vector<glm::vec3> line;
            for (int k = 0; k <= segments; ++k) {
                const float angle = glm::two_pi<float>() * static_cast<float>(k) / segments;
                line.push_back(middle + radius * glm::vec3(std::cos(angle), 0.0f, std::sin(angle)));
            }
            const std::string ring = name(i, j);
            world.add_rope(ring, {.from = line.front(),
                                  .to = middle,
                                  .segments = segments,
                                  .radius = 0.012f,
                                  .density = 0.4f});
            lay(world, ring, line);
            world.tie({}, world.particle(ring, 0), world.particle(ring, segments));
            constexpr rope::TieShape link{.length = apart - 2.0f * radius};
            if (j > 0)
                world.tie({}, world.particle(name(i, j - 1), 0), world.particle(ring, 2 * quarter), link);
            if (i > 0)
                world.tie({}, world.particle(name(i - 1, j), quarter), world.particle(ring, 3 * quarter),
                          link);
        }
    }
    world.set_settings({.damping = 0.8f, .friction = 0.4f});
    return scene;
}

}  // namespace tendril::app
