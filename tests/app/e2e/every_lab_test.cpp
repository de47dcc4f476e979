// Properties of every lab, and of one that exists only in the tests: random events and commands on each of
// its scenes break nothing, and replaying them gives the same result.
#include "app/document/scene_file.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "tests/app/e2e/monkey.hpp"
#include "tests/app/labs/spring/spring_lab.hpp"
#include "tests/app/support/full_scenes.hpp"

namespace tendril::test {
namespace {

using namespace app;

Labs all_labs() {
    Labs labs;
    labs.add(std::make_unique<SpringLab>());
    if (labs.find(rig_lab) == nullptr) labs.add(std::make_unique<RigLab>());
    return labs;
}

struct LabScene {
    std::string lab;
    TestScene scene;
};

std::vector<LabScene> all_scenes() {
    std::vector<LabScene> all;
    const Labs labs = all_labs();
    for (const auto& lab : labs.all())
        for (const TestScene& scene : test_scenes(*lab)) all.push_back({lab->name(), scene});
    return all;
}

void set_up(App& app, const LabScene& scene) {
    app.run({"lab.open", Json{{"name", scene.lab}}});
    for (const CommandCall& command : scene.scene.commands)
        app.run({command.name, to_json(command.arguments)});
}

/// The lab's own commands, and those that every lab must support.
std::vector<std::string> vocabulary(const App& app, const std::string& lab) {
    CommandTable table;
    app.labs().find(lab)->add_commands(table);
    std::vector<std::string> names{"time.step", "time.play", "time.pause",   "time.seek",
                                   "undo",      "redo",      "camera.frame", "scene.new"};
    for (const Command& command : table.all()) names.push_back(command.name);
    return names;
}

/// Text arguments: names that exist in the scene, and some that do not.
std::vector<std::string> words_of(const TestScene& scene) {
    std::vector<std::string> words = scene.words;
    words.insert(words.end(), {"", "\xFF"});
    return words;
}

/// Passes ticks like the program does in its open lab, without a window.
void pass_ticks(Workspace& workspace, const Lab& lab, int ticks) {
    Clock& clock = workspace.clock;
    for (; ticks > 0; --ticks) {
        if (clock.playing && lab.moving(workspace)) {
            lab.step(workspace);
            ++clock.tick;
            clock.passed += static_cast<double>(clock.speed);
        }
        if (lab.working(workspace)) lab.work(workspace);
    }
}

/// `opened` must show and save the same as its original, after 0 ticks and, if ticks are cheap, after 300.
void expect_goes_on_as(Workspace original, Workspace opened, const Lab& lab) {
    EXPECT_EQ(opened.clock.playing, original.clock.playing);
    EXPECT_EQ(opened.clock.speed, original.clock.speed);
    original.forget_pasts();
    opened.clock = original.clock;
    opened.ui.plays_after_dialog = original.ui.plays_after_dialog;
    opened.settings = original.settings;
    const bool slow = lab.tick_work(original) > 20'000;
    for (const int ticks : {0, slow ? 0 : 300 / sanitizer_factor}) {
        SCOPED_TRACE(std::to_string(ticks) + " ticks");
        pass_ticks(original, lab, ticks);
        pass_ticks(opened, lab, ticks);
        EXPECT_EQ(lab.state(opened), lab.state(original));
        EXPECT_EQ(save_scene(opened), save_scene(original));
    }
}

/// A saved scene opens, and saves the same again.
void expect_opens_again(const Workspace& workspace, bool goes_on = false) {
    static const Labs labs = all_labs();
    const Json saved = save_scene(workspace);
    Workspace opened = make_blank_workspace(labs);
    try {
        load_scene(opened, parse_json(json_to_text(saved)));
    } catch (const std::exception& error) {
        FAIL() << "what was saved is not opened: " << error.what();
    }
    EXPECT_EQ(save_scene(opened), saved);
    if (goes_on) expect_goes_on_as(workspace, std::move(opened), *labs.find(workspace.lab));
}

/// Lengths are kept, and all coordinates are finite.
void expect_whole(const Chain& chain) {
    const auto segments = chain.segments();
    for (std::size_t i = 1; i < segments.size(); ++i) {
        const glm::vec3 a = segments[i - 1].position, b = segments[i].position;
        for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(std::isfinite(b[axis])) << i;
        if (std::max(glm::length(a), glm::length(b)) > 1e3f) continue;
        ASSERT_LE(length_error(chain, i), 1e-4f * std::max(1.0f, segments[i].length)) << i;
    }
}

class EveryScene : public testing::TestWithParam<LabScene> {
    TempFolder folder_;
    WorkingIn inside_{folder_};  // random commands write files
};

LABEL(slow, "EveryLab/EveryScene.MayGoAwayUnderTheMouse/*");
LABEL(slow, "EveryLab/EveryScene.LooksAndMovesTheSameEachTimeAndAfterItWasSaved/*");
LABEL(slow, "EveryLab/EveryScene.OpensAsItWasSavedAndGoesOnWhateverWasDoneToIt/*");
LABEL(slow, "EveryLab/EveryScene.IsUndoneToWhereItBegan/*");

TEST_P(EveryScene, SurvivesRandomEventsAndCommandsAndReplaysThem) {
    expect_replay_ends_the_same(
        [](App& app) {
            set_up(app, GetParam());
            app.workspace().history.clear();  // a recording knows its initial scene, and nothing before it
            app.workspace().cameras.clear();
            app.workspace().clock.tick = 0;
            app.start_recording();
            Monkey monkey(app, 11, vocabulary(app, GetParam().lab), words_of(GetParam().scene));
            const int events = std::max(rounds(80), 12);
            for (int i = 0; i < events && !HasFailure(); ++i) {
                monkey.act();
                expect_whole(chain_part(app.workspace()).chain);
                if (i % 20 == 0) expect_finite(app.state(), "state");
                if (i % 10 == 9) expect_opens_again(app.workspace());
            }
            app.draw();
            expect_finite(app.state(), "state");
        },
        all_labs);
}

TEST_P(EveryScene, OpensAsItWasSavedAndGoesOnWhateverWasDoneToIt) {
    const auto window = open_offscreen({1280, 720});
    App app(*window, false, all_labs());
    unsigned seed = 0;  // other edits in each scene
    for (const char letter : GetParam().scene.name) seed = 31 * seed + static_cast<unsigned char>(letter);
    for (const unsigned end = seed + static_cast<unsigned>(rounds(1)); seed != end && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        app.run({"scene.new"});
        set_up(app, GetParam());
        std::vector<std::string> names = vocabulary(app, GetParam().lab);
        std::erase(names, "scene.new");
        Monkey monkey(app, seed, std::move(names), words_of(GetParam().scene));
        for (int i = 0; i < 20; ++i) monkey.edit(), monkey.act();
        const Event release = MousePress{MouseButton::Left, false};
        app.tick(&release);
        app.run({"time.speed", Json{{"factor", seed % 2 == 0 ? 1.0 : 0.5}}});
        expect_opens_again(app.workspace(), true);
    }
}

/// Some commands are refused in a scene that is not empty.
void try_to_set_up(App& app, const LabScene& scene) {
    for (const CommandCall& command : scene.scene.commands) {
        try {
            app.run({command.name, to_json(command.arguments)});
        } catch (const Refused&) {
        }
    }
}

/// Scenes of the same lab: the next one, and the one halfway through the list.
std::vector<LabScene> some_others(const LabScene& scene) {
    std::vector<LabScene> all = all_scenes();
    std::erase_if(
        all, [&](const LabScene& each) { return each.lab != scene.lab || each.scene.commands.size() > 12; });
    const auto own =
        std::ranges::find(all, scene.scene.name, [](const LabScene& each) { return each.scene.name; });
    const auto at = static_cast<std::size_t>(own - all.begin());
    std::vector<LabScene> some;
    for (const std::size_t by : {std::size_t{1}, all.size() / 2}) some.push_back(all[(at + by) % all.size()]);
    return some;
}

/// While the mouse hovers over or holds a handle, other scenes of the lab replace the scene, and back.
TEST_P(EveryScene, MayGoAwayUnderTheMouse) {
    const auto window = open_offscreen({1000, 700});
    App app(*window, false, all_labs());
    const std::vector<LabScene> others = some_others(GetParam());
    for (const LabScene& other : others)
        for (const bool held : {false, true}) {
            if (held != (&other == &others.back()) && !is_thorough()) continue;
            app.run({"scene.new"});
            app.run({"lab.open", Json{{"name", other.lab}}});
            app.run({"time.pause"});
            try_to_set_up(app, GetParam());
            const Json state = app.state();
            std::size_t tried = 0;
            for (const Json& handle : state.at("handles")) {
                if (!handle.at("pixel").is_array() || ++tried > 3) continue;
                const Event move =
                    MouseMove{{handle["pixel"][0].get<float>(), handle["pixel"][1].get<float>()}};
                const Event press = MousePress{MouseButton::Left, true},
                            release = MousePress{MouseButton::Left, false};
                const Event drag =
                    MouseMove{{handle["pixel"][0].get<float>() + 40.0f, handle["pixel"][1].get<float>()}};
                app.tick(&move);
                if (held) app.tick(&press), app.tick(&drag);
                try_to_set_up(app, other);
                app.tick(held ? &move : nullptr);
                app.draw();
                if (held) app.tick(&release);
                while (app.workspace().history.can_undo()) app.run({"undo"});
                app.tick(nullptr);
                try_to_set_up(app, GetParam());
            }
        }
}

TEST_P(EveryScene, LooksAndMovesTheSameEachTimeAndAfterItWasSaved) {
    const auto window = open_offscreen({640, 480});
    const auto run = [&](bool through_a_file) {
        App app(*window, false, all_labs());
        set_up(app, GetParam());
        if (through_a_file)
            load_scene(app.workspace(), parse_json(json_to_text(save_scene(app.workspace()))));
        const std::uint64_t begin = app.workspace().moment;  // after the ticks of the setup
        for (int i = 0; i < std::max(rounds(120), 30); ++i) app.tick(nullptr);
        Json state = app.state();
        state.erase("time");
        for (Json& event : state["events"]) event["tick"] = event["tick"].get<std::uint64_t>() - begin;
        return state;
    };
    EXPECT_EQ(run(true), run(false));
}

TEST_P(EveryScene, IsUndoneToWhereItBegan) {
    const auto window = open_offscreen({640, 480});
    App app(*window, false, all_labs());
    app.run({"time.pause"});
    app.run({"lab.open", Json{{"name", GetParam().lab}}});
    const Json blank = save_scene(app.workspace()).at("labs");
    for (const CommandCall& command : GetParam().scene.commands)  // commands that only look are no undo steps
        if (app.commands().find(command.name)->effect == Effect::Edit)
            app.run({command.name, to_json(command.arguments)});
    while (app.workspace().history.can_undo()) app.run({"undo"});
    EXPECT_EQ(save_scene(app.workspace()).at("labs"), blank);
}

/// The values of a saved scene by kind: their path without indices, so that a cloth's thousand coordinates
/// are chosen as seldom as its one radius.
std::vector<std::vector<std::string>> paths_by_kind(const Json& scene, const std::string& lab) {
    std::map<std::string, std::vector<std::string>> kinds;
    // Json keeps its keys in order, which makes look-ups linear; nlohmann::json does not.
    const auto flat = nlohmann::json(scene.at("labs").at(lab)).flatten();
    for (const auto& [path, value] : flat.items()) {
        std::string kind;
        for (const char letter : path)
            if (letter < '0' || letter > '9') kind += letter;
        kinds[kind].push_back("/labs/" + lab + path);
    }
    std::vector<std::vector<std::string>> all;
    for (auto& [kind, paths] : kinds) all.push_back(std::move(paths));
    return all;
}

/// Random values of a saved scene change type or size: it is refused with the value's path, or read whole.
TEST_P(EveryScene, IsRefusedWithThePathOfTheFaultOrReadCompletely) {
    const Labs labs = all_labs();
    const auto window = open_offscreen({640, 480});
    App app(*window, false, all_labs());
    set_up(app, GetParam());
    for (int i = 0; i < 3; ++i) app.tick(nullptr);
    const Json scene = save_scene(app.workspace());
    const auto kinds = paths_by_kind(scene, GetParam().lab);
    const Json others[]{nullptr, true, -1, 0, 2.5, 1e8, 3e9, 1e300, "text", Json::array(), Json::object()};
    std::mt19937 random(7);
    for (int i = 0; i < rounds(30) && !HasFailure(); ++i) {
        const std::vector<std::string>& paths = kinds[random() % kinds.size()];
        const std::string& path = paths[random() % paths.size()];
        Json changed = scene;
        changed[Json::json_pointer(path)] = others[random() % std::size(others)];
        SCOPED_TRACE(path + " as " + changed[Json::json_pointer(path)].dump());
        Workspace opened = make_blank_workspace(labs);
        try {
            load_scene(opened, changed);
        } catch (const std::exception& error) {
            EXPECT_TRUE(says(error.what(), "labs " + GetParam().lab));
            EXPECT_EQ(std::string(error.what()).find("json.exception"), std::string::npos) << error.what();
            continue;
        }
        labs.find(GetParam().lab)->step(opened);
        expect_opens_again(opened);
    }
}

INSTANTIATE_TEST_SUITE_P(EveryLab, EveryScene, testing::ValuesIn(all_scenes()),
                         [](const auto& each) { return each.param.lab + "_" + each.param.scene.name; });

TEST(EveryLab, BringsAScene) {
    const Labs labs = all_labs();
    for (const auto& lab : labs.all()) EXPECT_FALSE(test_scenes(*lab).empty()) << lab->name();
}

}  // namespace
}  // namespace tendril::test
