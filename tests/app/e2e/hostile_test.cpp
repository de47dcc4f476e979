// Three thousand random events and commands, many of them hostile, into one running program: it neither
// crashes nor lets anything that is not finite in, its chain stays whole, and undo leads all the way back.
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "app/app.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using namespace app;

class Monkey {
  public:
    Monkey(App& app, unsigned seed) : app_(app), random_(seed) {}

    void act() {
        if (below(3) == 0) {
            command();
        } else {
            const Event event = this->event();
            app_.tick(&event);
        }
    }

  private:
    int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }
    bool coin() { return below(2) == 0; }
    float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    /// A number as people type them, and now and then one that nobody should.
    Json any_number() {
        static const std::vector<Json> hostile{0.0,
                                               -1.0,
                                               1e9,
                                               -1e9,
                                               1e10,
                                               1e-40,
                                               1e300,
                                               -0.0,
                                               "one",
                                               nullptr,
                                               true,
                                               Json::array(),
                                               std::numeric_limits<double>::quiet_NaN(),
                                               std::numeric_limits<double>::infinity()};
        if (below(8) == 0) return hostile[static_cast<std::size_t>(below(static_cast<int>(hostile.size())))];
        return number(between(0.0f, 3.0f));
    }
    Json any_index() { return below(8) == 0 ? any_number() : Json(below(10)); }
    Json any_point() {
        if (below(12) == 0) return any_number();
        Json point = Json::array();
        for (int i = 0; i < 3; ++i)
            point.push_back(below(15) == 0 ? any_number() : Json(number(between(-9.0f, 9.0f))));
        return point;
    }

    void command() {
        static const std::vector<std::string> names{
            "chain.add",    "chain.insert", "chain.remove", "chain.set_length",
            "chain.mode",   "chain.target", "chain.pull",   "chain.select",
            "chain.clear",  "chain.motion", "chain.seek",   "camera.set",
            "camera.frame", "time.step",    "undo",         "redo"};
        static const std::vector<std::string> words{
            "forward", "backward", "fixed", "with_index", "circle", "still", "all", "selection", "", "\xFF"};
        const std::string& name = names[static_cast<std::size_t>(below(static_cast<int>(names.size())))];
        if (name == "chain.clear" && below(6) != 0) return;
        Json arguments = Json::object();
        for (const Argument& argument : app_.commands().find(name)->arguments) {
            if (!argument.required && coin()) continue;
            if (below(20) == 0) continue;
            switch (argument.type) {
                case ArgumentType::Number:
                    arguments[argument.name] = any_number();
                    break;
                case ArgumentType::Integer:
                    arguments[argument.name] = any_index();
                    break;
                case ArgumentType::Boolean:
                    arguments[argument.name] = coin();
                    break;
                case ArgumentType::NumberOrPoint:
                    arguments[argument.name] = coin() ? any_number() : any_point();
                    break;
                case ArgumentType::Rotation:
                case ArgumentType::Point:
                    arguments[argument.name] = any_point();
                    break;
                case ArgumentType::Text:
                    arguments[argument.name] =
                        words[static_cast<std::size_t>(below(static_cast<int>(words.size())))];
                    break;
            }
        }
        try {
            app_.run({name, arguments});
        } catch (const Refused& refusal) {
            EXPECT_STRNE(refusal.what(), "");
        }
    }

    glm::vec2 any_place() {
        if (below(4) == 0) return {between(-3000.0f, 5000.0f), between(-3000.0f, 5000.0f)};
        const Json state = app_.state();
        const Json& handles = state.at("handles");
        const Json& chosen = handles.at(static_cast<std::size_t>(below(static_cast<int>(handles.size()))));
        if (!chosen.at("pixel").is_array() || coin())
            return {between(280.0f, 1000.0f), between(50.0f, 690.0f)};
        // As far as a mouse can go, however far the handle is.
        return glm::clamp(handle(state, chosen.at("name").get<std::string>()), -5000.0f, 5000.0f);
    }

    Event event() {
        const auto key = [&] { return static_cast<Key>(1 + below(static_cast<int>(Key::Count) - 1)); };
        switch (below(16)) {
            case 0:
            case 1:
            case 2:
            case 3:
            case 4:
            case 5:
                return MouseMove{any_place()};
            case 6:
            case 7:
            case 8:
                return MousePress{MouseButton::Left, coin()};
            case 9:
                return MousePress{static_cast<MouseButton>(below(3)), coin()};
            case 10:
                return MouseWheel{below(10) == 0 ? between(-1e9f, 1e9f) : between(-3.0f, 3.0f)};
            case 11:
                return KeyChange{key(), coin()};
            case 12:
                return harmless(KeyTap{{key(), below(4) == 0, below(4) == 0, below(4) == 0}});
            case 13:
                return TextInput{coin() ? "1.5" : "\xC3\xA4\xFF"};
            case 14:
                return below(5) == 0 ? Event(Resize{{1 + below(1600), 1 + below(1000)}})
                                     : Event(Focus{coin()});
            default:
                return Drop{{"/no/such/scene.json"}};
        }
    }
    /// Files are not the monkey's: what it would save it would save among ours.
    Event harmless(const KeyTap& tap) {
        const Key key = tap.chord.key;
        if (key == Key::S || key == Key::O || key == Key::N || key == Key::Q || key == Key::Enter)
            return Focus{true};
        return tap;
    }

    App& app_;
    std::mt19937 random_;
};

void expect_finite(const Json& json, const std::string& where) {
    if (json.is_structured()) {
        for (const auto& [key, value] : json.items()) expect_finite(value, where + "." + key);
    } else if (json.is_number()) {
        EXPECT_TRUE(std::isfinite(json.get<double>())) << where;
    }
}

/// The chain's invariant: each length is kept, and every coordinate finite.
void expect_whole(const Chain& chain) {
    const auto segments = chain.segments();
    for (std::size_t i = 1; i < segments.size(); ++i) {
        const glm::vec3 a = segments[i - 1].position, b = segments[i].position;
        for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(std::isfinite(b[axis])) << i;
        if (std::max(glm::length(a), glm::length(b)) > 1e3f) continue;
        ASSERT_LE(length_error(chain, i), 1e-4f * std::max(1.0f, segments[i].length)) << i;
    }
}

std::string document_text(App& app) {
    return app.workspace().document.get<ChainPart>(chain_lab).save().dump();
}

class Hostile : public testing::TestWithParam<unsigned> {};

TEST_P(Hostile, events_and_commands_break_nothing) {
    const auto window = open_offscreen({1280, 720});
    App app(*window);
    app.start_recording();
    const std::string start = document_text(app);
    Monkey monkey(app, GetParam());
    for (int i = 0; i < 1000 && !HasFailure(); ++i) {
        monkey.act();
        expect_whole(chain_part(app.workspace()).chain);
        if (i % 25 == 0) expect_finite(app.state(), "state");
        if (i % 100 == 0) app.draw();
        ASSERT_FALSE(app.quit());
    }

    // Motion runs on by itself and belongs to no step: the chain is held still to look at what undo brings
    // back.
    app.run({"time.pause", Json::object()});
    int steps = 0;
    while (app.workspace().history.can_undo() && steps++ < 2000) app.run({"undo", Json::object()});
    EXPECT_GT(steps, 20);
    EXPECT_FALSE(app.workspace().history.can_undo());
    const Json first = parse_json(start), back = parse_json(document_text(app));
    for (const char* member : {"segments", "target", "mode", "iterations", "default_direction"}) {
        EXPECT_EQ(back[member], first[member]) << member;
    }

    // All of it was recorded, and none of the recording is beyond the player.
    EXPECT_NO_THROW(parse_script(app.recording(), app.commands()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Hostile, testing::Values(1u, 2u, 3u));

TEST(HostileReplay, ends_where_the_recording_did) {
    const auto window = open_offscreen({1280, 720});
    std::string recording;
    Json recorded;
    {
        App app(*window);
        app.start_recording();
        Monkey monkey(app, 7);
        for (int i = 0; i < 1000; ++i) monkey.act();
        recorded = app.state();
        recording = app.recording();
    }
    window->resize({1280, 720});
    App app(*window);
    Script script = parse_script(recording, app.commands());
    app.start_from(*script.start);
    Player player(std::move(script));
    while (!player.done()) player.advance(app);
    EXPECT_EQ(app.state(), recorded);
}

}  // namespace
}  // namespace tendril::test
