// A monkey test: random events and commands, many of them hostile, in a running program.
#pragma once

#include <glm/common.hpp>
#include <limits>
#include <random>

#include "tests/app/support/play.hpp"

namespace tendril::test {

using namespace app;

/// The names of all commands of a lab.
std::vector<std::string> lab_commands(const App& app);

class Monkey {
  public:
    /// Runs commands of these names; text arguments are taken from `words`.
    Monkey(App& app, unsigned seed, std::vector<std::string> names, std::vector<std::string> words)
        : app_(app), random_(seed), names_(std::move(names)), words_(std::move(words)) {}

    void act() {
        if (below(3) == 0) {
            command();
        } else {
            const app::Event event = this->event();
            app_.tick(&event);
        }
    }

    /// Runs a random command; it may be refused.
    void command();
    /// Runs one with arguments in their ranges and names that exist now; it may still be refused.
    void edit() {
        careful_ = true;
        command();
        careful_ = false;
    }

  private:
    /// A number in the argument's range and near 0, if there is one.
    double number_in(const Argument& argument) {
        const double low = std::max(argument.low, -3.0), high = std::min(argument.high, 3.0);
        return low <= high ? std::uniform_real_distribution<double>(low, high)(random_)
                           : std::clamp(0.0, argument.low, argument.high);
    }
    /// An existing name or, without any, one of the words.
    std::string name_for(const Argument& argument) {
        const std::vector<std::string> known =
            argument.known ? argument.known(app_.workspace()) : std::vector<std::string>();
        return one_of(!argument.choices.empty() ? argument.choices : !known.empty() ? known : words_);
    }
    int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }
    const std::string& one_of(const std::vector<std::string>& list) {
        return list[static_cast<std::size_t>(below(static_cast<int>(list.size())))];
    }
    bool coin() { return below(2) == 0; }
    float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    /// A plausible number, sometimes a hostile one.
    Json any_number() {
        if (careful_) return number(between(0.0f, 3.0f));
        static const Json hostile = [] {
            Json all = Json::parse(R"([0.0,-1.0,1e9,-1e9,1e10,1e-40,1e300,-0.0,"one",null,true,[]])");
            all.push_back(std::numeric_limits<double>::quiet_NaN());
            all.push_back(std::numeric_limits<double>::infinity());
            return all;
        }();
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

    Json any_list() {
        if (below(8) == 0) return any_number();
        Json list = Json::array();
        if (!words_.empty() && below(3) == 0) {  // names of several things
            for (int i = below(4); i >= 0; --i) list.push_back(one_of(words_));
            return list;
        }
        for (int i = below(12); i > 0; --i) list.push_back(any_number());
        return list;
    }

    /// Often a name, since most arguments of any type are names.
    Json any_json() {
        const int kind = words_.empty() ? below(4) : below(6);
        if (kind == 0) return any_number();
        if (kind == 1) return any_point();
        if (kind == 2) return below(2) == 0;
        if (kind == 3) return any_list();
        const std::string word = one_of(words_);
        return kind == 4 ? Json{{word, any_number()}} : Json(word);
    }

    glm::vec2 any_place() {
        if (below(4) == 0) return {between(-3000.0f, 5000.0f), between(-3000.0f, 5000.0f)};
        const Json state = app_.state();
        const Json& handles = state.at("handles");
        if (handles.empty()) return {between(280.0f, 1000.0f), between(50.0f, 690.0f)};
        const Json& chosen = handles.at(static_cast<std::size_t>(below(static_cast<int>(handles.size()))));
        if (!chosen.at("pixel").is_array() || coin())
            return {between(280.0f, 1000.0f), between(50.0f, 690.0f)};
        // As far as a mouse can go, however far the handle is.
        return glm::clamp(handle(state, chosen.at("name").get<std::string>()), -5000.0f, 5000.0f);
    }

    Event event() {
        const auto key = [&] { return static_cast<Key>(1 + below(static_cast<int>(Key::Count) - 1)); };
        const auto turn = [&] { return below(10) == 0 ? between(-1e9f, 1e9f) : between(-3.0f, 3.0f); };
        const int kind = below(16);
        if (kind < 6) return MouseMove{any_place()};
        if (kind < 9) return MousePress{MouseButton::Left, coin()};
        if (kind == 9) return MousePress{static_cast<MouseButton>(below(3)), coin()};
        if (kind == 10) return MouseWheel{turn(), turn()};
        if (kind == 11) return KeyChange{key(), coin()};
        if (kind == 12) return harmless(KeyTap{{key(), below(4) == 0, below(4) == 0, below(4) == 0}});
        if (kind == 13) return TextInput{coin() ? "1.5" : "\xC3\xA4\xFF"};
        if (kind == 15) return Drop{{"/no/such/scene.json"}};
        if (below(5) == 0) return Resize{{1 + below(1600), 1 + below(1000)}};
        return Focus{coin()};
    }
    /// Keys that open or save files do nothing, so that no file is overwritten.
    Event harmless(const KeyTap& tap) {
        const Key key = tap.chord.key;
        if (key == Key::S || key == Key::O || key == Key::N || key == Key::Q || key == Key::Enter)
            return Focus{true};
        return tap;
    }

    App& app_;
    std::mt19937 random_;
    bool careful_ = false;
    std::vector<std::string> names_, words_;
};

inline void expect_finite(const Json& json, const std::string& where) {
    if (json.is_structured()) {
        for (const auto& [key, value] : json.items()) expect_finite(value, where + "." + key);
    } else if (json.is_number()) {
        EXPECT_TRUE(std::isfinite(json.get<double>())) << where;
    }
}

/// Replays in another program what `act` did, and expects the same state. `labs` makes their labs.
template <class Act>
void expect_replay_ends_the_same(
    Act act, Labs (*labs)() = [] { return Labs(); }) {
    const auto window = open_offscreen({1280, 720});
    std::string recording;
    Json recorded;
    {
        App app(*window, false, labs());
        act(app);
        recorded = app.state();
        recording = app.recording();
    }
    window->resize({1280, 720});
    App app(*window, false, labs());
    app.workspace().outputs.force = true;  // the recorded session has written the same files
    Script script = parse_script(recording, app.commands());
    app.start_from(*script.start);
    Player player(std::move(script));
    while (!player.done()) player.advance(app);
    EXPECT_EQ(app.state(), recorded);
}

}  // namespace tendril::test
