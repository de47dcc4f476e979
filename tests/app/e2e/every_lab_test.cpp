// Properties of every lab, and of one that only the tests have: random events and commands on each of its
// scenes break nothing, and replaying them gives the same result.
#include <algorithm>
#include <cstdlib>

#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "tests/app/e2e/monkey.hpp"
#include "tests/app/labs/spring/spring_lab.hpp"
#include "tests/app/support/temp_folder.hpp"

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
        for (const TestScene& scene : lab->test_scenes()) all.push_back({lab->name(), scene});
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

/// A saved scene opens and saves the same again.
Workspace opened_again(const Workspace& workspace) {
    static const Labs labs = all_labs();
    const Json saved = save_scene(workspace);
    Workspace opened = make_blank_workspace(labs);
    try {
        load_scene(opened, parse_json(json_to_text(saved)));
        EXPECT_EQ(save_scene(opened), saved);
    } catch (const std::exception& error) {
        ADD_FAILURE() << "what was saved is not opened: " << error.what();
    }
    return opened;
}

/// What a lab shows, without reports on the ticks before, which a scene does not have.
Json lasting_state(const Lab& lab, const Workspace& workspace) {
    Json state = lab.state(workspace);
    for (const char* key : {"verdict", "why", "status", "last_second", "frame_ms", "race"}) state.erase(key);
    if (state.contains("solve"))
        for (const char* key : {"report", "active_limit", "explanation"}) state["solve"].erase(key);
    return {{"state", std::move(state)}, {"saved", workspace.document.parts().at(workspace.lab)->save()}};
}

/// And the open lab shows the same, to the bit, then and five seconds later; half a second if that takes
/// long.
void expect_opens_as_it_was(App& app) {
    constexpr std::uint64_t long_work = 50'000;
    Workspace& live = app.workspace();
    Workspace opened = opened_again(live);
    const Lab& lab = *app.labs().find(live.lab);
    opened.clock = live.clock;
    const int ticks = lab.tick_work(live) > long_work ? 30 : 300;
    for (int tick = 0; tick <= ticks && !testing::Test::HasFailure(); ++tick) {
        EXPECT_EQ(lab.moving(opened), lab.moving(live)) << "after " << tick << " ticks";
        if (tick == 0 || tick == ticks) {
            EXPECT_EQ(Json::diff(lasting_state(lab, live), lasting_state(lab, opened)), Json::array())
                << "after " << tick << " ticks";
        }
        for (Workspace* each : {&live, &opened})
            if (lab.moving(*each)) lab.step(*each);
    }
}

class EveryScene : public testing::TestWithParam<LabScene> {
    TempFolder folder_;
    WorkingIn inside_{folder_};  // random commands write files
};

TEST_P(EveryScene, StandsRandomEventsAndCommandsAndReplaysThem) {
    expect_replay_ends_the_same(
        [](App& app) {
            set_up(app, GetParam());
            app.workspace().history.clear();  // a recording knows its initial scene, and nothing before it
            app.workspace().cameras.clear();
            app.start_recording();
            Monkey monkey(app, 11, vocabulary(app, GetParam().lab), words_of(GetParam().scene));
            for (int i = 0; i < 60 && !HasFailure(); ++i) {
                monkey.act();
                if (i % 20 == 0) expect_finite(app.state(), "state");
                if (i % 10 == 9) opened_again(app.workspace());
            }
            app.draw();
            expect_finite(app.state(), "state");
        },
        all_labs);
}

/// Random scenes per test scene; TENDRIL_RANDOM_SCENES overrides it.
unsigned random_scenes() {
    const char* const given = std::getenv("TENDRIL_RANDOM_SCENES");
    return given == nullptr ? 1u : static_cast<unsigned>(std::strtoul(given, nullptr, 10));
}

TEST_P(EveryScene, OpensAsItWasSavedWhateverWasDoneToIt) {
    ASSERT_GT(random_scenes(), 0u);
    const auto window = open_offscreen({1280, 720});
    App app(*window, false, all_labs());
    unsigned seed = 0;  // other edits in each scene
    for (const char letter : GetParam().scene.name) seed = 31 * seed + static_cast<unsigned char>(letter);
    for (const unsigned end = seed + random_scenes(); seed != end && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        app.run({"scene.new"});
        set_up(app, GetParam());
        std::vector<std::string> names = vocabulary(app, GetParam().lab);
        for (const char* each : {"scene.new", "rope.hold"}) std::erase(names, each);
        Monkey monkey(app, seed, std::move(names), words_of(GetParam().scene));
        for (int i = 0; i < 20; ++i) monkey.edit(), monkey.act();
        const Event release = MousePress{MouseButton::Left, false};
        app.tick(&release);
        expect_opens_as_it_was(app);
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

/// Scenes of the same lab: its own, the next two, and the one halfway through the list.
std::vector<LabScene> some_others(const LabScene& scene) {
    std::vector<LabScene> all = all_scenes();
    std::erase_if(
        all, [&](const LabScene& each) { return each.lab != scene.lab || each.scene.commands.size() > 12; });
    const auto own =
        std::ranges::find(all, scene.scene.name, [](const LabScene& each) { return each.scene.name; });
    const auto at = static_cast<std::size_t>(own - all.begin());
    std::vector<LabScene> some;
    for (const std::size_t by : {std::size_t{0}, std::size_t{1}, std::size_t{2}, all.size() / 2})
        some.push_back(all[(at + by) % all.size()]);
    return some;
}

/// The mouse rests on a handle, or holds it, while the scene is replaced by others of the lab, and back.
TEST_P(EveryScene, MayGoAwayUnderTheMouse) {
    const auto window = open_offscreen({1000, 700});
    App app(*window, false, all_labs());
    for (const LabScene& other : some_others(GetParam())) {
        for (const bool held : {false, true}) {
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
}

TEST_P(EveryScene, LooksAndMovesTheSameEachTimeAndAfterItWasSaved) {
    const auto window = open_offscreen({640, 480});
    const auto run = [&](bool through_a_file) {
        App app(*window, false, all_labs());
        set_up(app, GetParam());
        if (through_a_file)
            load_scene(app.workspace(), parse_json(json_to_text(save_scene(app.workspace()))));
        const std::uint64_t begin = app.workspace().moment;  // after the ticks of the setup
        for (int i = 0; i < GetParam().scene.ticks; ++i) app.tick(nullptr);
        Json state = app.state();
        state.erase("time");
        for (Json& event : state["events"]) event["tick"] = event["tick"].get<std::uint64_t>() - begin;
        return state;
    };
    const Json first = run(false);
    EXPECT_EQ(run(false), first);
    EXPECT_EQ(run(true), first);
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

INSTANTIATE_TEST_SUITE_P(EveryLab, EveryScene, testing::ValuesIn(all_scenes()),
                         [](const auto& each) { return each.param.lab + "_" + each.param.scene.name; });

TEST(EveryLab, BringsAScene) {
    const Labs labs = all_labs();
    for (const auto& lab : labs.all()) EXPECT_FALSE(lab->test_scenes().empty()) << lab->name();
}

}  // namespace
}  // namespace tendril::test
