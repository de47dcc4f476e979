// Unreadable scripts and scenes: exit code 2 (or a refusal in a running program), a one-line message, bounded
// memory, nothing overwritten.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

constexpr long flat = 200L * sanitizer_factor;  ///< megabytes; the program alone takes about half of that

class BadFiles : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    Outcome run_script(const std::string& text) {
        write(folder_ / "script.jsonl", text);
        return run_here({"--headless", "--script", path("script.jsonl"), "--state", path("state.json")});
    }
    Outcome open_scene(const std::string& text) {
        write(folder_ / "scene.json", text);
        return run_here({"--headless", path("scene.json"), "--state", path("state.json")});
    }
    std::string good_scene() {
        EXPECT_TRUE(
            succeeded(run_script(ScriptText().command("scene.save", {{"path", path("good.json")}}).text())));
        std::filesystem::remove(folder_ / "state.json");
        return read(folder_ / "good.json");
    }
    /// Writes one megabyte after the other, so that the test itself needs little memory.
    void write_much(const std::string& name, const std::string& before, char filler, int megabytes) {
        std::ofstream out(folder_ / name, std::ios::binary);
        const std::string block(1u << 20, filler);
        out << before;
        for (int i = 0; i < megabytes; ++i) out << block;
    }
    bool left_nothing() const { return !std::filesystem::exists(folder_ / "state.json"); }
    TempFolder folder_;
};

TEST_F(BadFiles, scripts_name_the_line_and_run_nothing) {
    const std::string ran = ScriptText().line({{"state", path("ran.json")}}).text();
    for (const char* line : {
             "no JSON at all",
             "{\"command\": \"chain.add\"",
             "{'command': 'undo'}",
             "[1, 2, 3]",
             "42",
             "null",
             "{}",
             "{\"comand\": \"undo\"}",
             "{\"command\": \"chain.explode\"}",
             "{\"command\": 3}",
             "{\"mouse\": \"fly\"}",
             "{\"mouse\": \"move\"}",
             "{\"mouse\": \"move\", \"at\": [1]}",
             "{\"mouse\": \"move\", \"at\": [1, \"2\"]}",
             "{\"mouse\": \"down\"}",
             "{\"mouse\": \"down\", \"button\": \"fourth\"}",
             "{\"mouse\": \"wheel\", \"by\": null}",
             "{\"key\": \"ctrl+\"}",
             "{\"key\": \"hyper+z\"}",
             "{\"key\": \"x\", \"action\": \"hold\"}",
             "{\"text\": 5}",
             "{\"resize\": [0, 0]}",
             "{\"resize\": [-5, 100]}",
             "{\"resize\": [100000, 100]}",
             "{\"resize\": [1.5, 100]}",
             "{\"drop\": []}",
             "{\"focus\": 1}",
             "{\"wait\": -1}",
             "{\"wait\": 1e12}",
             "{\"wait\": \"long\"}",
             "{\"wait\": 1, \"then\": 2}",
             "{\"screenshot\": \"\"}",
             "{\"state\": 7}",
             "{\"expect\": \"mode\"}",
             "{\"expect\": \"mode\", \"equals\": 1, \"below\": 2}",
             "{\"recording\": 1}",
             "\x01\x02\xFF",
         }) {
        const Outcome outcome = run_script(ran + "\n" + line + "\n");
        EXPECT_TRUE(complained(outcome, 2, {path("script.jsonl"), "line 3"})) << line;
        EXPECT_TRUE(left_nothing()) << line;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "ran.json")) << line;
    }
}

TEST_F(BadFiles, recordings_that_are_broken_newer_or_half) {
    const std::string good = [&] {
        write(folder_ / "script.jsonl", "{\"wait\": 1}\n");
        EXPECT_TRUE(succeeded(
            run_program({"--headless", "--script", path("script.jsonl"), "--record", path("r.jsonl")})));
        return read(folder_ / "r.jsonl");
    }();
    const app::Json start = app::parse_json(good.substr(0, good.find('\n')));
    const auto with = [&](const char* key, const app::Json& value) {
        app::Json changed = start;
        changed[key] = value;
        return changed.dump() + "\n";
    };
    app::Json future = start["scene"];
    future["tendril_scene"] = 99;
    for (const std::string& script :
         {with("recording", 2), with("recording", "one"), with("size", {0, 0}), with("size", "large"),
          with("lab", "kitchen"), with("scene", 7), with("scene", app::Json::object()), with("scene", future),
          with("settings", {{"theme", "plaid"}}), with("settings", nullptr), with("and", "more")}) {
        EXPECT_TRUE(complained(run_script(script), 2)) << script.substr(0, 80);
        EXPECT_TRUE(left_nothing());
    }
    app::Json half = start;
    half.erase("scene");
    EXPECT_TRUE(complained(run_script(half.dump() + "\n"), 2, {"scene"}));
}

TEST_F(BadFiles, scenes_truncated_anywhere) {
    const std::string scene = good_scene();
    const std::size_t step = scene.size() / 24 + 1;
    for (std::size_t length = 0; length + 2 < scene.size(); length += step) {
        EXPECT_TRUE(complained(open_scene(scene.substr(0, length)), 2, {path("scene.json")})) << length;
        EXPECT_TRUE(left_nothing()) << length;
        EXPECT_EQ(read(folder_ / "scene.json"), scene.substr(0, length));
    }
}

TEST_F(BadFiles, scenes_newer_foreign_or_out_of_range) {
    const app::Json good = app::parse_json(good_scene());
    const auto changed = [&](const char* pointer, const app::Json& value) {
        app::Json scene = good;
        scene[app::Json::json_pointer(pointer)] = value;
        return scene.dump();
    };
    struct Case {
        std::string scene, told;
    };
    for (const Case& each :
         {Case{changed("/tendril_scene", 3), "newer"}, Case{changed("/tendril_scene", "1"), "tendril_scene"},
          Case{changed("/lab", "kitchen"), "kitchen"},
          Case{changed("/labs/kitchen", app::Json::object()), "kitchen"},
          Case{changed("/camera/distance", -1), "distance"},
          Case{changed("/labs/chain/mode", "sideways"), "sideways"},
          Case{changed("/labs/chain/index", 8), "index"},
          Case{changed("/labs/chain/target", {1, 2}), "target"},
          Case{changed("/labs/chain/target", {1e30, 2, 3}), "target"},
          Case{changed("/labs/chain/segments/3/length", -1), "length"},
          Case{changed("/labs/chain/segments/3/position", "here"), "position"},
          Case{changed("/labs/chain/segments", 7), "segments"}, Case{"{\"scene\": 1}", "scene"},
          Case{"[]", "scene.json"}}) {
        EXPECT_TRUE(complained(open_scene(each.scene), 2, {path("scene.json"), each.told})) << each.told;
        EXPECT_TRUE(left_nothing()) << each.told;
    }
}

TEST_F(BadFiles, a_hundred_megabytes_of_brackets_are_refused_in_little_time_and_memory) {
    write_much("scene.json", "", '[', 100);
    const Outcome outcome = run_program({"--headless", path("scene.json"), "--state", path("state.json")});
    EXPECT_TRUE(complained(outcome, 2, {path("scene.json")}));
    EXPECT_LT(outcome.peak_megabytes, flat);
    EXPECT_LT(outcome.cpu_seconds, 5.0 * sanitizer_factor);

    write_much("script.jsonl", "", '[', 100);
    const Outcome script =
        run_program({"--headless", "--script", path("script.jsonl"), "--state", path("state.json")});
    EXPECT_TRUE(complained(script, 2, {path("script.jsonl")}));
    EXPECT_LT(script.peak_megabytes, flat);

    write_much("small.json", "{\"tendril_scene\": ", '[', 40);
    const Outcome deep = run_program({"--headless", path("small.json"), "--state", path("state.json")});
    EXPECT_TRUE(complained(deep, 2, {path("small.json")}));
    EXPECT_LT(deep.peak_megabytes, flat + 60);
    EXPECT_TRUE(left_nothing());
}

TEST_F(BadFiles, opened_while_the_program_runs_are_refused_and_the_scene_is_kept) {
    write(folder_ / "broken.json", "{\"tendril_scene\": 1, \"lab\"");
    write_much("large.json", "", '[', 70);
    ScriptText script;
    script.command("chain.target", {{"to", {3, 2, 1}}});
    const auto before = state_after(script);
    script.command("scene.open", {{"path", path("broken.json")}}, true);
    script.command("scene.open", {{"path", path("large.json")}}, true);
    script.line({{"drop", app::Json::array({path("none.json")})}});
    const Outcome outcome = run_script(script.text());
    EXPECT_TRUE(complained(outcome, 0, {path("none.json")}))
        << "a dropped file that cannot be read is told, no more";
    EXPECT_EQ(app::parse_json(read(folder_ / "state.json")), before);
    script.command("undo");
    EXPECT_EQ(run_script(script.text()).exit_code, 0) << "the history is kept too";
}

TEST_F(BadFiles, a_scene_that_is_opened_is_what_was_saved) {
    ScriptText script;
    script.command("chain.preset", {{"name", "random"}, {"count", 31}, {"seed", 5}})
        .command("chain.mode", {{"mode", "with_index"}, {"index", 11}})
        .command("chain.target", {{"to", {0.1, 2.3, -0.7}}})
        .command("camera.set", {{"yaw_deg", 12.3}, {"pitch_deg", 4.5}})
        .command("scene.save", {{"path", path("scene.json")}});
    const auto saved = state_after(script);
    const Outcome outcome = run_program({"--headless", path("scene.json"), "--state", path("state.json")});
    EXPECT_TRUE(succeeded(outcome));
    EXPECT_EQ(app::parse_json(read(folder_ / "state.json")), saved);
    const auto dropped = state_after(ScriptText().line({{"drop", app::Json::array({path("scene.json")})}}));
    EXPECT_EQ(dropped["segments"], saved["segments"]);
}

}  // namespace
}  // namespace tendril::test
