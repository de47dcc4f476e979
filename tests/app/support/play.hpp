// Plays a script offscreen in this process, and returns its results.
#pragma once

#include <glm/geometric.hpp>

#include "app/app.hpp"
#include "app/document/command.hpp"
#include "app/io/image.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {

/// Writes scripts line by line.
class ScriptText {
  public:
    using Json = app::Json;

    ScriptText& line(const Json& json) {
        text_ += json.dump() + "\n";
        return *this;
    }
    ScriptText& lines(const ScriptText& other) {
        text_ += other.text_;
        return *this;
    }
    ScriptText& command(const std::string& name, Json arguments = Json::object(), bool refused = false) {
        arguments["command"] = name;
        if (refused) arguments["refused"] = true;
        return line(arguments);
    }
    ScriptText& move(glm::vec2 at) { return line({{"mouse", "move"}, {"at", app::pixel(at)}}); }
    ScriptText& down(const char* button = "left") { return line({{"mouse", "down"}, {"button", button}}); }
    ScriptText& up(const char* button = "left") { return line({{"mouse", "up"}, {"button", button}}); }
    ScriptText& wheel(float by) { return line({{"mouse", "wheel"}, {"by", app::number(by)}}); }
    ScriptText& key(const char* name) { return line({{"key", name}}); }
    ScriptText& hold(const char* name) { return line({{"key", name}, {"action", "down"}}); }
    ScriptText& release(const char* name) { return line({{"key", name}, {"action", "up"}}); }
    ScriptText& text(const char* utf8) { return line({{"text", utf8}}); }
    ScriptText& wait(int ticks) { return line({{"wait", ticks}}); }
    ScriptText& click(glm::vec2 at) { return move(at).down().up(); }
    /// Button down at the first point, moved through the others, and up at the last.
    ScriptText& drag(const std::vector<glm::vec2>& points, const char* button = "left") {
        move(points.front()).down(button);
        for (std::size_t i = 1; i < points.size(); ++i) move(points[i]);
        return up(button);
    }

    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

struct Played {
    Outcome outcome;
    app::Json state;
    app::Image picture;  ///< empty unless requested
};

struct PlayOptions {
    bool picture = false;
    std::vector<std::string> more{};  ///< additional arguments
};

/// Fails the test if the program fails.
inline Played play(const ScriptText& script, const PlayOptions& options = {}) {
    const TempFolder folder;
    write(folder / "script.jsonl", script.text());
    std::vector<std::string> arguments{"--headless", "--script", (folder / "script.jsonl").string(),
                                       "--state", (folder / "state.json").string()};
    if (options.picture)
        arguments.insert(arguments.end(), {"--screenshot", (folder / "picture.png").string()});
    arguments.insert(arguments.end(), options.more.begin(), options.more.end());

    Played played;
    played.outcome = run_here(arguments);
    EXPECT_TRUE(succeeded(played.outcome)) << script.text();
    played.state = app::parse_json(read(folder / "state.json"));
    if (options.picture) played.picture = app::read_png(folder / "picture.png");
    return played;
}

/// The pixel position of a handle in --state; fails the test if no such handle is in view.
inline glm::vec2 handle(const app::Json& state, const std::string& name) {
    for (const auto& each : state.at("handles")) {
        if (each.at("name") == name && each.at("pixel").is_array())
            return {each["pixel"][0].get<float>(), each["pixel"][1].get<float>()};
    }
    ADD_FAILURE() << "the state has no pixel for " << name;
    return {};
}

inline glm::vec3 point_of(const app::Json& json) {
    return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

/// The state after a script.
inline app::Json state_after(const ScriptText& script) {
    return play(script).state;
}
/// The state before the first event, offscreen or in a window.
inline const app::Json& first_state() {
    static const app::Json state = state_after(ScriptText().wait(1));
    return state;
}

/// The scene after a script, as it is saved.
inline app::Json scene_after(ScriptText script) {
    const TempFolder folder;
    play(script.command("scene.save", {{"path", (folder / "scene.json").string()}}));
    return app::parse_json(read(folder / "scene.json"));
}

/// Runs a script in a separate process, whatever the outcome.
inline Outcome run_script(const ScriptText& script, const Environment& changes = {},
                          const std::filesystem::path& in = {}) {
    const TempFolder folder;
    write(folder / "script.jsonl", script.text());
    return run_program({"--headless", "--script", (folder / "script.jsonl").string()}, changes, in);
}

/// Plays a script in a separate process; refusals in a panel do not end it.
inline Played play_refused(const ScriptText& script) {
    const TempFolder folder;
    const std::string path = (folder / "script.jsonl").string(), state = (folder / "state.json").string();
    write(path, script.text());
    Played played;
    played.outcome = run_program({"--headless", "--script", path, "--state", state});
    EXPECT_EQ(played.outcome.exit_code, 0) << played.outcome.err;
    played.state = app::parse_json(read(state));
    return played;
}

}  // namespace tendril::test
