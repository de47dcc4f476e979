// Plays a script offscreen in this process, and returns its results.
#pragma once

#include "app/io/image.hpp"
#include "tests/app/support/program.hpp"
#include "tests/app/support/script_text.hpp"

namespace tendril::test {

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
        if (each.at("name") == name && each.at("pixel").is_array()) {
            return {each["pixel"][0].get<float>(), each["pixel"][1].get<float>()};
        }
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

}  // namespace tendril::test
