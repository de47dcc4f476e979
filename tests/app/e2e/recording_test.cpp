// Playing a recording gives the same state and the same picture, byte for byte.
#include "tests/app/support/panel_places.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

/// The output of a run: the bytes of its state and picture.
struct Left {
    std::string state, picture, recording;
    bool operator==(const Left&) const = default;
};

class Recording : public testing::Test {
  protected:
    Left run(const std::string& script, const std::string& name, std::vector<std::string> more = {}) {
        const auto path = [&](const char* suffix) { return (folder_ / (name + suffix)).string(); };
        std::vector<std::string> arguments{"--headless", "--script",    script,
                                           "--state",    path(".json"), "--screenshot",
                                           path(".png"), "--record",    path(".jsonl")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_TRUE(succeeded(run_program(arguments)));
        return {read(path(".json")), read(path(".png")), read(path(".jsonl"))};
    }
    /// Records the script, plays the recording twice, and expects the same from all three.
    Left record_and_replay(const ScriptText& script, std::vector<std::string> more = {}) {
        write(folder_ / "script.jsonl", script.text());
        const Left recorded = run((folder_ / "script.jsonl").string(), "recorded", more);
        const Left first = run((folder_ / "recorded.jsonl").string(), "first");
        const Left second = run((folder_ / "first.jsonl").string(), "second");
        EXPECT_EQ(recorded.state, first.state);
        EXPECT_TRUE(recorded.picture == first.picture);
        // A replay records itself, so the second one replays a recording of a recording.
        EXPECT_EQ(first.state, second.state);
        EXPECT_TRUE(first.picture == second.picture);
        EXPECT_EQ(first.recording, second.recording);
        return recorded;
    }
    TempFolder folder_;
};

Json state_of(const Left& left) {
    return app::parse_json(left.state);
}

// Everything in the window that is not the scene: panels, palette, help, keys, wheel over a list, resizing.
TEST_F(Recording, HoldsTheUseOfPanels) {
    const glm::vec2 forward_radio = chain_panel::forward, target = handle(start_state(), "target");
    ScriptText script = ScriptText().click(forward_radio).wait(2);
    script.key("ctrl+k").text("chain.add length=0.75").key("enter").wait(2);
    script.drag({target, {700, 250}, {650, 300}});
    script.key("ctrl+k").text("theme").key("enter").wait(1);
    script.move({130, 500}).wheel(-3).wheel(1);
    script.move({1140, 400}).wheel(-2);
    script.move({640, 500}).line({{"mouse", "wheel"}, {"by", 0.5}, {"sideways", -1.5}});
    script.drag({{640, 600}, {580, 560}, {500, 580}}, "right").drag({{640, 600}, {580, 560}}, "middle");
    script.hold("shift")
        .move({640, 600})
        .release("shift")
        .key("l")
        .key("b")
        .key("?")
        .wait(1)
        .key("escape")
        .key("f9");
    script.line({{"resize", {1000, 700}}}).line({{"focus", false}}).line({{"focus", true}}).wait(5);
    const Json state = state_of(record_and_replay(script));
    EXPECT_EQ(state["mode"], "forward");
    EXPECT_EQ(state["segments"].size(), 9u);
    EXPECT_EQ(state["segments"][8]["length"], 0.75);
}

TEST_F(Recording, HoldsTextTypedIntoAField) {
    // A double click on the target's height opens the field.
    const glm::vec2 field = chain_panel::target_y;
    ScriptText script = ScriptText().command("view.fold", chain_panel::unfolded()).wait(2);
    script.click(field).click(field).wait(1).key("ctrl+a").text("1.25").key("enter").wait(3);
    const Json state = state_of(record_and_replay(script));
    EXPECT_EQ(state["target"], Json::array({7.0, 1.25, 0.0}))
        << "the target's y field has moved in the panel";
}

TEST_F(Recording, HoldsTime) {
    ScriptText script;
    script.command("chain.motion", {{"path", "figure_eight"}, {"radius", 1.7}, {"period", 2.3}}).wait(41);
    script.key("space").wait(10).key(".").key(".").key("space").wait(7);
    const Left left = record_and_replay(script);
    EXPECT_EQ(state_of(left)["motion"], "figure_eight");
    // 41 ticks, one for the key that pauses, two steps, and those after the second space.
    EXPECT_GT(state_of(left)["time"]["tick"], 45);
    EXPECT_LT(state_of(left)["time"]["tick"], 60);
}

TEST_F(Recording, StartsWithItsSceneSizeAndLab) {
    ScriptText first;
    first.command("chain.preset", {{"name", "tentacle"}})
        .command("chain.target", {{"to", {1, 2, 3}}})
        .command("camera.set", {{"yaw_deg", 33}})
        .command("scene.save", {{"path", (folder_ / "tentacle.json").string()}});
    play(first);
    ScriptText script;
    script.command("chain.mode", {{"mode", "forward"}})
        .command("chain.target", {{"to", {0.5, 1, 0}}})
        .wait(2);
    const Left left = record_and_replay(
        script, {"--size", "900x600", "--lab", "chain", (folder_ / "tentacle.json").string()});
    EXPECT_EQ(state_of(left)["segments"].size(), 24u);
    const Json start_line = app::parse_json(left.recording.substr(0, left.recording.find('\n')));
    EXPECT_EQ(start_line["size"], Json::array({900, 600}));
}

TEST_F(Recording, ExpectationsScreenshotsAndStatesWithinAScript) {
    const auto path = [&](const char* name) { return (folder_ / name).string(); };
    ScriptText script;
    script.command("chain.target", {{"to", {3, 2, 0}}})
        .line({{"state", path("after.json")}})
        .line({{"screenshot", path("after.png")}})
        .line({{"expect", "tail"}, {"near", {3, 2, 0}}, {"within", 0.001}})
        .command("chain.target", {{"to", {0, 0, 0}}});
    const Json state = play(script).state;
    EXPECT_EQ(app::parse_json(read(path("after.json")))["target"], Json::array({3.0, 2.0, 0.0}));
    EXPECT_EQ(state["target"], Json::array({0.0, 0.0, 0.0}));
    EXPECT_EQ(app::read_png(path("after.png")).size, glm::ivec2(1280, 720));
}

}  // namespace
}  // namespace tendril::test
