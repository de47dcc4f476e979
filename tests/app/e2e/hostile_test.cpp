// Three thousand random events and commands, many of them hostile, in one running program: it does not crash,
// nothing becomes infinite or NaN, the chain keeps its lengths, and undo leads all the way back.
#include "app/labs/chain/chain_lab.hpp"
#include "tests/app/e2e/monkey.hpp"

namespace tendril::test {
namespace {

using namespace app;

/// The chain's invariant: lengths are kept, and all coordinates are finite.
void expect_whole(const Chain& chain) {
    const auto segments = chain.segments();
    for (std::size_t i = 1; i < segments.size(); ++i) {
        const glm::vec3 a = segments[i - 1].position, b = segments[i].position;
        for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(std::isfinite(b[axis])) << i;
        if (std::max(glm::length(a), glm::length(b)) > 1e3f) continue;
        ASSERT_LE(length_error(chain, i), 1e-4f * std::max(1.0f, segments[i].length)) << i;
    }
}

Monkey chain_monkey(App& app, unsigned seed) {
    return Monkey(app, seed,
                  {"chain.add", "chain.insert", "chain.remove", "chain.set_length", "chain.mode",
                   "chain.target", "chain.pull", "chain.select", "chain.clear", "chain.motion", "chain.seek",
                   "camera.set", "camera.frame", "time.step", "undo", "redo"},
                  {"forward", "circle", "all", "", "\xFF"});
}

std::string document_text(App& app) {
    return app.workspace().document.get<ChainPart>(chain_lab).save().dump();
}

class Hostile : public testing::TestWithParam<unsigned> {};

TEST_P(Hostile, EventsAndCommandsBreakNothing) {
    const auto window = open_offscreen({1280, 720});
    App app(*window);
    app.start_recording();
    const std::string start = document_text(app);
    Monkey monkey = chain_monkey(app, GetParam());
    for (int i = 0; i < 1000 && !HasFailure(); ++i) {
        monkey.act();
        expect_whole(chain_part(app.workspace()).chain);
        if (i % 25 == 0) expect_finite(app.state(), "state");
        if (i % 100 == 0) app.draw();
        ASSERT_FALSE(app.quit());
    }

    // The motion runs on outside of undo steps: pause it to check what undo restores.
    app.run({"time.pause", Json::object()});
    int steps = 0;
    while (app.workspace().history.can_undo() && steps++ < 2000) app.run({"undo", Json::object()});
    EXPECT_GT(steps, 20);
    EXPECT_FALSE(app.workspace().history.can_undo());
    const Json first = parse_json(start), back = parse_json(document_text(app));
    for (const char* member : {"segments", "target", "mode", "iterations", "default_direction"})
        EXPECT_EQ(back[member], first[member]) << member;

    // Everything was recorded, and the player accepts all of it.
    EXPECT_NO_THROW(parse_script(app.recording(), app.commands()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Hostile, testing::Values(1u, 2u, 3u));

}  // namespace
}  // namespace tendril::test
