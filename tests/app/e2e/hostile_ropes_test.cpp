// The same for the Rope lab: nothing becomes infinite or NaN, no rope loses particles without a command, and
// undo restores the initial state.
#include "app/document/command.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "tests/app/e2e/monkey.hpp"

namespace tendril::test {
namespace {

using namespace app;

Monkey rope_monkey(App& app, unsigned seed) {
    std::vector<std::string> names{"time.step",  "time.seek", "time.play",  "time.pause",
                                   "time.speed", "undo",      "redo",       "camera.frame",
                                   "lab.open",   "chain.add", "chain.pull", "scene.new"};
    for (const Command& command : app.commands().all())
        if (command.name.starts_with("rope.")) names.push_back(command.name);
    return Monkey(
        app, seed, std::move(names),
        {"rope", "rope 2", "short 1", "cloth", "hair", "ball", "bar", "ground", "chain", "", "\xFF"});
}

void expect_finite_world(const NamedWorld& world) {
    const rope::State& state = world.state();
    for (std::size_t i = 0; i < world.size(); ++i)
        for (const glm::dvec3& v : {state.position[i], state.displacement[i]})
            for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(std::isfinite(v[axis])) << i;
    std::size_t particles = 0;
    for (const rope::Body& body : state.bodies) particles += body.count;
    ASSERT_EQ(particles, world.size());
}

/// What time does not change: names, sizes, settings.
Json lasting(App& app) {
    const NamedWorld& world = *rope_part(app.workspace()).world;
    const rope::State& state = world.state();
    Json bodies = Json::array(), colliders = Json::array();
    for (const rope::Body& body : state.bodies) bodies.push_back({world.name(body), body.count, body.row});
    for (const rope::Collider& collider : state.colliders) colliders.push_back(world.name(collider));
    return {bodies, colliders, state.settings.iterations, state.settings.substep, state.settings.friction};
}

class HostileRopes : public testing::TestWithParam<unsigned> {};

TEST_P(HostileRopes, events_and_commands_break_nothing) {
    const auto window = open_offscreen({1280, 720});
    App app(*window);
    app.run({"lab.open", Json{{"name", "rope"}}});
    app.start_recording();
    const Json start = lasting(app);
    Monkey monkey = rope_monkey(app, GetParam());
    for (int i = 0; i < 400 && !HasFatalFailure(); ++i) {
        monkey.act();
        expect_finite_world(*rope_part(app.workspace()).world);
        if (i % 25 == 0) expect_finite(app.state(), "state");
        if (i % 100 == 0) app.draw();
        ASSERT_FALSE(app.quit());
    }
    app.run({"time.pause", Json::object()});
    int steps = 0;
    while (app.workspace().history.can_undo() && steps++ < 2000) app.run({"undo", Json::object()});
    EXPECT_GT(steps, 10);
    EXPECT_EQ(lasting(app), start);
    EXPECT_NO_THROW(parse_script(app.recording(), app.commands()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, HostileRopes, testing::Values(1u, 2u, 3u, 4u));

TEST(HostileRopesReplay, ends_where_the_recording_did) {
    expect_replay_ends_the_same([](App& app) {
        app.run({"lab.open", Json{{"name", "rope"}}});
        app.start_recording();
        Monkey monkey = rope_monkey(app, 7);
        for (int i = 0; i < 300; ++i) monkey.act();
    });
}

}  // namespace
}  // namespace tendril::test
