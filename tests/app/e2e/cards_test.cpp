// The cards of things to try: plays every step of every card, and expects it to be ticked off.
#include <imgui_internal.h>

#include "app/document/command.hpp"
#include "app/view/assets.hpp"
#include "app/widgets/row_search.hpp"
#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/app/support/play.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using namespace app;

struct CardOfLab {
    std::string lab;
    std::size_t number;  ///< from 1

    Card read() const { return read_cards(cards_source(lab)).at(number - 1); }
};

std::vector<CardOfLab> all_cards() {
    std::vector<CardOfLab> cards;
    const Labs labs;
    for (const auto& lab : labs.all())
        for (std::size_t i = 1; i <= read_cards(cards_source(lab->name())).size(); ++i)
            cards.push_back({lab->name(), i});
    return cards;
}

/// A lab with a card shown, on the card's scene.
class CardOnScene {
  public:
    explicit CardOnScene(const CardOfLab& which, glm::ivec2 size = {1280, 720})
        : window_(open_offscreen(size)), card_(which.read()) {
        run("lab.open", {{"name", which.lab}});
        for (const CardLine& line : card_.scene) run(line.command, line.arguments);
        run("view.card", {{"open", true}, {"number", which.number}});
        wait(2);
    }

    App& app() { return *app_; }
    const Card& card() const { return card_; }
    void run(const std::string& name, const Json& arguments) { app_->run({name, arguments}); }
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) app_->tick(nullptr);
    }
    void play(const CardStep& step) {
        std::string text;
        for (const SharedJson& line : step.script) text += line->dump() + "\n";
        Player player(parse_script(text, app_->commands()));
        while (!player.done()) player.advance(*app_);
        wait(60);  // large parts are checked less often
    }
    std::vector<bool> done() { return app_->state().at("card").at("done").get<std::vector<bool>>(); }
    bool has_ring() { return !app_->state().at("card").at("ring").is_null(); }
    bool has_handle(const std::string& name) {
        const Json state = app_->state();
        for (const Json& each : state.at("handles"))
            if (each.at("name") == name && each.at("pixel").is_array()) return true;
        return false;
    }

  private:
    std::unique_ptr<Window> window_;
    std::unique_ptr<App> app_ = std::make_unique<App>(*window_);
    Card card_;
};

/// A window of the last frame whose name contains `part`.
const ImGuiWindow* shown_window(const std::string& part) {
    for (const ImGuiWindow* const each : ImGui::GetCurrentContext()->Windows)
        if (each->WasActive && std::string(each->Name).find("/" + part) != std::string::npos) return each;
    return nullptr;
}

bool needs_incident(const CardStep& step) {
    return std::any_of(step.when.begin(), step.when.end(),
                       [](const CardCondition& each) { return each.kind == CardCondition::Kind::Avoided; });
}

class LabCard : public testing::TestWithParam<CardOfLab> {};
INSTANTIATE_TEST_SUITE_P(Labs, LabCard, testing::ValuesIn(all_cards()), [](const auto& card) {
    return card.param.lab + "_" + std::to_string(card.param.number);
});

/// The handle that a step highlights must be in view beforehand; undo and redo afterwards complete no step.
TEST_P(LabCard, PlayingAStepCompletesIt) {
    CardOnScene scene(GetParam());
    const std::size_t steps = scene.card().steps.size();
    const std::vector<bool> nothing(steps, false);
    ASSERT_EQ(scene.done(), nothing) << "nothing has happened yet";
    scene.wait(120);
    EXPECT_EQ(scene.done(), nothing) << "and time alone does nothing";
    std::vector<bool> expected = nothing;
    for (std::size_t i = 0; i < steps; ++i) {
        const CardStep& step = scene.card().steps[i];
        const bool handle = step.place == CardStep::Place::Handle;
        EXPECT_TRUE(!handle || scene.has_handle(step.place_name)) << step.place_name;
        EXPECT_EQ(scene.has_ring(), handle) << step.place_name;
        scene.play(step);
        expected[i] = true;
        EXPECT_EQ(scene.done(), expected) << step.text << " ticks itself off and no other";
    }
    EXPECT_FALSE(scene.has_ring()) << "all is done";
    scene.run("view.card", {{"open", true}, {"number", GetParam().number}});
    for (const char* command : {"undo", "redo"}) {
        for (std::size_t i = 0; i < 2 * steps; ++i) {
            try {
                scene.run(command, Json::object());
            } catch (const Refused&) {
                break;  // the end of the history
            }
            scene.wait(3);
            EXPECT_EQ(scene.done(), nothing) << command << " " << i;
        }
    }
}

/// Holds even if no earlier step was played, but avoiding an incident needs the incident first. A script that
/// drags a handle may complete another step that asks for the same drag. One step of each card; at night all.
TEST_P(LabCard, AStepAloneCompletesNoOther) {
    const std::size_t all = GetParam().read().steps.size();
    for (std::size_t i = 0; i < all; ++i) {
        if (i != GetParam().number % all && !is_thorough()) continue;
        CardOnScene scene(GetParam());
        const auto& steps = scene.card().steps;
        scene.play(steps[i]);
        for (std::size_t k = 0; k < steps.size(); ++k) {
            if (k != i && steps[k].by.front().command == steps[i].by.front().command) continue;
            EXPECT_EQ(scene.done()[k], k == i && !needs_incident(steps[i]))
                << steps[i].text << ": " << steps[k].text;
        }
    }
}

TEST_P(LabCard, EveryStepWaitsForACommandThatExists) {
    CardOnScene scene(GetParam());
    for (const CardStep& step : scene.card().steps)
        for (const CardLine& line : step.by) {
            const Command* const command = scene.app().commands().find(line.command);
            ASSERT_NE(command, nullptr) << line.command;
            for (const auto& [key, value] : line.arguments->items())
                EXPECT_NE(find_argument(*command, key), nullptr) << line.command << " " << key;
        }
}

/// Undo, redo and the scenes that they restore complete no step either.
TEST_P(LabCard, OtherScenesCompleteNoStep) {
    CardOnScene scene(GetParam());
    const TempFolder folder;
    const std::string file = (folder / "scene.json").string();
    scene.run("scene.save", {{"path", file}});
    const std::string lab = GetParam().lab;
    const std::vector<bool> nothing(scene.card().steps.size(), false);
    const auto run = [&](const std::string& name, const Json& arguments) {
        for (const CardStep& step : scene.card().steps)
            for (const CardLine& line : step.by)
                if (line.command == name && Json(line.arguments) == arguments) return;  // its very step
        const auto expect_nothing = [&](const char* after) {
            scene.wait(3);
            EXPECT_EQ(scene.done(), nothing) << name << " " << arguments.dump() << ": " << after;
        };
        scene.run(name, arguments);
        expect_nothing("itself");
        for (const char* command : {"undo", "redo"}) {
            if (std::string(command) == "undo" && !scene.app().workspace().history.can_undo()) return;
            scene.run(command, Json::object());
            expect_nothing(command);
        }
    };
    if (const Command* const preset = scene.app().commands().find(lab + ".preset"))
        for (const std::string& name : find_argument(*preset, "name")->choices)
            if (name != "half_a_million") run(preset->name, {{"name", name}});
    for (const std::string& name : {lab + ".clear", lab + ".reset", std::string("scene.new")})
        if (scene.app().commands().find(name) != nullptr) run(name, Json::object());
    run("scene.open", {{"path", file}});
}

TEST_P(LabCard, HighlightedSectionsExist) {
    PanelReader reader;
    const Labs labs;
    const CommandTable table = make_command_table(labs);
    Workspace workspace = make_blank_workspace(labs);
    const auto run = [&](const std::string& command, Json arguments) {
        if (command.starts_with("time.")) return;  // no time passes here
        arguments.erase("command");
        table.run(workspace, command, arguments);
    };
    const Lab& lab = *labs.find(GetParam().lab);
    workspace.open_lab(GetParam().lab);
    const Card card = GetParam().read();
    for (const CardLine& line : card.scene) run(line.command, line.arguments);
    for (const CardStep& step : card.steps) {
        for (const SharedJson& line : step.script)
            if (line->contains("command")) run((*line)["command"], line);
        if (step.place == CardStep::Place::Handle) continue;
        bool there = false;
        reader.read([&](Emit& emit) {
            step.place == CardStep::Place::Panel ? lab.panel(workspace, emit)
                                                 : lab.inspector(workspace, emit);
            there = has_section(step.place_name.c_str());
        });
        EXPECT_TRUE(there) << step.place_name;
    }
}

TEST_P(LabCard, HasTheLengthThatItsTitleStates) {
    const Card card = GetParam().read();
    EXPECT_EQ(card.title == "Five things to try", GetParam().number == 1);
    EXPECT_EQ(card.steps.size(), GetParam().number == 1 ? 5u : 3u);
    for (const CardStep& step : card.steps) EXPECT_LE(step.text.size(), 110u) << step.text;
}

TEST_P(LabCard, AHiddenCardReopensFresh) {
    CardOnScene scene(GetParam());
    scene.play(scene.card().steps.front());
    ASSERT_TRUE(scene.done().front());
    scene.run("view.card", {{"open", false}});
    EXPECT_FALSE(scene.app().state().contains("card"));
    const Settings kept = scene.app().workspace().settings;
    std::vector<std::string> complaints;
    EXPECT_EQ(load_settings(save_settings(kept), complaints), kept) << "for good";
    EXPECT_TRUE(complaints.empty());
    for (const CardLine& line : scene.card().scene) scene.run(line.command, line.arguments);
    scene.run("view.card", Json::object());
    scene.wait(20);
    EXPECT_FALSE(scene.done().front());
    EXPECT_EQ(scene.app().state().at("card").at("title"), scene.card().title);
}

TEST(ChainCard, GivesWayToARaceAndAsksForThePoleInItsFlip) {
    CardOnScene scene({"chain", 1});
    scene.run("chain.pole", {{"off", true}});
    scene.play(scene.card().steps[2]);
    EXPECT_FALSE(scene.done()[2]);
    for (const char* const study : {"race.open", "microscope.open"}) {
        scene.run(study, Json::object());
        scene.wait(2);
        EXPECT_FALSE(scene.has_ring()) << study;
    }
}

/// The button that hides the card is somewhere near the right edge, above the steps.
TEST_P(LabCard, OneClickHidesIt) {
    CardOnScene scene(GetParam());
    scene.run("time.pause", Json::object());
    App& app = scene.app();
    const auto send = [&](const Event& event) { app.tick(&event); };
    for (float y = 700.0f; y > 60.0f && card_shown(app.workspace().settings, GetParam().lab); y -= 6.0f) {
        send(MouseMove{{1261.0f, y}});
        send(MousePress{MouseButton::Left, true});
        send(MousePress{MouseButton::Left, false});
    }
    EXPECT_FALSE(card_shown(app.workspace().settings, GetParam().lab));
    EXPECT_FALSE(app.workspace().ui.quit);
}

/// However small the window and large the text, the inspector keeps at least half of the panel.
TEST_P(LabCard, LeavesRoomForTheInspector) {
    for (const glm::ivec2 size : {glm::ivec2(1024, 640), glm::ivec2(1280, 720), glm::ivec2(2560, 1440)}) {
        if (size.x > 1024 && GetParam().number > 1 && !is_thorough()) continue;
        CardOnScene scene(GetParam(), size);
        scene.run("time.pause", Json::object());
        for (const float scale : {1.0f, 1.5f, 2.0f}) {
            scene.run("view.text_scale", {{"scale", scale}});
            const bool one_panel = lay_out(size, scale, Settings{}, 0.0f).one_panel;
            if (one_panel) scene.run("view.panels", {{"left", false}, {"right", true}});
            scene.wait(2);
            EXPECT_TRUE(scene.app().state().contains("card"));
            const ImGuiWindow* const card = shown_window("card");
            ASSERT_NE(card, nullptr);
            EXPECT_GE(card->Pos.y, 0.5f * static_cast<float>(size.y) - 1.0f) << size.x << " at " << scale;
            EXPECT_LE(card->ContentSize.y, card->Size.y + 1.0f) << "all of it is seen";
            EXPECT_GE(card->Pos.x, (one_panel ? 0.33f : 0.66f) * static_cast<float>(size.x))
                << "and it is beside the scene";
        }
    }
}

TEST(CardsTest, ATracesIncidentsFoldIt) {
    CardOnScene scene({"chain", 1});
    ASSERT_TRUE(scene.has_ring());
    const float high = shown_window("card")->Size.y;
    scene.run("chain.trace", {{"text", "(0, 1, 0) (1, 1, 0)\n(0, 1, 0) (1, nan, 0)\n(0, 1, 0) (1, 1, 0)\n"}});
    scene.wait(2);
    EXPECT_LT(shown_window("card")->Size.y, 0.5f * high);
    EXPECT_FALSE(scene.has_ring());
}

LABEL(slow, "CardsTest.TheChevronShowsTheNextCardOnItsScene");

/// The chevron is left of the button that hides the card, near the right edge.
TEST(CardsTest, TheChevronShowsTheNextCardOnItsScene) {
    const std::vector<Card> cards = read_cards(cards_source("rope"));
    const std::size_t first = is_thorough() ? 1 : cards.size() - 1;
    CardOnScene scene({"rope", first});
    const auto title = [&] { return scene.app().state().at("card").at("title").get<std::string>(); };
    for (const int number : {0, static_cast<int>(cards.size()) + 1, -1})
        EXPECT_THROW(scene.run("view.card", {{"number", number}}), Refused) << number;
    const auto click_chevron = [&] {
        const std::string before = title();
        for (float y = 700.0f; y > 60.0f && title() == before; y -= 6.0f)
            for (const Event& event :
                 {Event(MouseMove{{1236.0f, y}}), Event(MousePress{MouseButton::Left, true}),
                  Event(MousePress{MouseButton::Left, false})})
                scene.app().tick(&event);
    };
    for (std::size_t i = first; i <= cards.size(); ++i) {
        click_chevron();
        EXPECT_EQ(title(), cards[i % cards.size()].title);
        scene.wait(2);
    }
    EXPECT_FALSE(scene.app().state().at("ropes").empty());
}

TEST(CardsTest, ARingIsDrawnOnlyAroundVisibleHandles) {
    CardOnScene scene({"chain", 1});
    for (std::size_t i = 0; i < 3; ++i) scene.play(scene.card().steps[i]);
    ASSERT_EQ(scene.card().steps[3].place_name, "pole");
    EXPECT_TRUE(scene.has_ring());
    scene.run("chain.mode", {{"mode", "backward"}});
    scene.wait(2);
    EXPECT_FALSE(scene.has_ring()) << "this mode has no pole target";
    scene.run("chain.mode", {{"mode", "reach"}});
    scene.wait(2);
    EXPECT_TRUE(scene.has_ring());
}

/// A simulated hand that follows the arm's card, in the window's own projection.
class HandOnTheArm {
  public:
    explicit HandOnTheArm(CardOnScene& scene) : scene_(scene) {}

    glm::vec2 pixel(const std::string& name) { return handle(scene_.app().state(), name); }
    void drag(const std::string& name, const std::vector<glm::vec2>& through, std::optional<Key> held = {}) {
        glm::vec2 at = pixel(name);
        send(MouseMove{at});
        send(MousePress{MouseButton::Left, true});
        if (held) send(KeyChange{*held, true});
        for (const glm::vec2 to : through)
            for (const glm::vec2 from = at; at != to;) {
                const float left = glm::distance(at, to);
                at = left <= 12.0f ? to : at + 12.0f * glm::normalize(to - from);
                send(MouseMove{at});
            }
        send(MousePress{MouseButton::Left, false});
        if (held) send(KeyChange{*held, false});
        scene_.wait(2);
    }
    std::size_t flips() {
        const Json state = scene_.app().state();
        return static_cast<std::size_t>(std::ranges::count_if(
            state.at("events"), [](const Json& each) { return each.at("kind") == "flip"; }));
    }
    bool done(std::size_t step) { return scene_.done().at(step - 1); }

  private:
    void send(const Event& event) { scene_.app().tick(&event); }

    CardOnScene& scene_;
};

TEST(CardsTest, TheArmFlipsAndItsCureWorksIfTheMouseFollowsTheCard) {
    for (const glm::ivec2 size : {glm::ivec2(1280, 720), glm::ivec2(1024, 640), glm::ivec2(1920, 1080)})
        for (const int opened_for : {0, 100, 300, 440}) {
            SCOPED_TRACE(std::to_string(size.x) + " wide, " + std::to_string(opened_for));
            CardOnScene scene({"chain", 1}, size);
            if (opened_for > 0) {
                for (const CommandCall& call : Labs().find("chain")->opening())
                    scene.run(call.name, to_json(call.arguments));
                scene.wait(opened_for);
                scene.run("chain.motion", {{"path", "still"}});
            }
            HandOnTheArm hand(scene);
            const glm::vec2 start = hand.pixel("target"), pole = hand.pixel("pole");
            const float unit = glm::distance(pole, hand.pixel("segment.0"));
            const glm::vec2 over = pole - glm::vec2(0.0f, 0.15f * unit),
                            beyond = pole + glm::vec2(-0.7f * unit, 0.3f * unit);
            hand.drag("target", {over, beyond});
            EXPECT_GT(hand.flips(), 0u);
            EXPECT_TRUE(hand.done(3));
            std::size_t flips = hand.flips();
            hand.drag("target", {over, start});
            EXPECT_GT(hand.flips(), flips) << "without a cure";
            flips = hand.flips();
            hand.drag("pole", {pole + glm::vec2(-0.4f * unit, 0.2f * unit)});
            EXPECT_FALSE(hand.done(4)) << "nothing was repeated";
            hand.drag("target", {over, beyond});
            EXPECT_EQ(hand.done(4), hand.flips() == flips) << "to the side it hardly ever helps";
            if (hand.done(4)) continue;
            scene.run("undo", Json::object());
            scene.run("undo", Json::object());
            hand.drag("pole", {pole + glm::vec2(-0.02f * unit, 0.1f * unit)}, Key::Z);
            EXPECT_FALSE(hand.done(4)) << "the drag is still to be repeated";
            flips = hand.flips();
            hand.drag("target", {start + glm::vec2(0.0f, -0.3f * unit)});
            EXPECT_FALSE(hand.done(4)) << "not like the one that flipped";
            hand.drag("target", {over, beyond});
            EXPECT_EQ(hand.flips(), flips);
            EXPECT_TRUE(hand.done(4));
        }
}

TEST(CardsTest, AStepAsksForItsOwnHandle) {
    CardOnScene scene({"humanoid", 1});
    for (const char* hand : {"right_hand", "left_hand"})
        scene.run("humanoid.target", {{"effector", hand}, {"to", {0.3, 3.0, 0.5}}});
    scene.wait(60);
    EXPECT_EQ(scene.done(), (std::vector<bool>{true, false, false, false, false}));
}

TEST(CardsTest, ATypedCommandCountsAndARefusedOneDoesNot) {
    CardOnScene scene({"rig", 1});
    EXPECT_THROW(scene.run("rig.control.set", {{"name", "look"}, {"value", "up"}}), Refused);
    scene.wait(2);
    EXPECT_FALSE(scene.done()[0]);
    scene.run("rig.control.set", {{"name", "look"}, {"value", {0.1, 0.2}}});
    EXPECT_TRUE(scene.done()[0]);
}

/// A number typed into the panel moves the target, but a step says to drag it.
TEST(CardsTest, ANumberInAPanelIsNotADrag) {
    CardOnScene scene({"chain", 1}, {1280, 1800});
    scene.run("chain.target", {{"to", {0.9, 1.2, 0.3}}});
    scene.run("view.card", {{"open", true}, {"number", 1}});
    scene.run("view.fold", {{"section", "chain: Target"}, {"folded", false}});
    ASSERT_EQ(scene.done(), std::vector<bool>(5, false));
    FrameRecorder recorder;
    scene.wait(2);
    std::optional<glm::vec2> at;
    for (const DrawnText& each : recorder.frame().texts)
        if (each.text == "0.900 m") at = 0.5f * (each.box.min + each.box.max);  // the target's x
    ASSERT_TRUE(at) << "the row of the target";
    for (const Event& event : {Event(MouseMove{*at}), Event(MousePress{MouseButton::Left, true}),
                               Event(MousePress{MouseButton::Left, false})})
        scene.app().tick(&event);
    scene.wait(30);
    for (const Event& event : {Event(TextInput{"0.8"}), Event(KeyTap{{.key = Key::Enter}})})
        scene.app().tick(&event);
    scene.wait(60);
    const Json state = scene.app().state();
    const Json target = state.at("target");
    EXPECT_NE(target, (Json{0.9, 1.2, 0.3})) << "the field was found";
    EXPECT_EQ(state.at("solve").at("report").at("status"), "Converged");
    EXPECT_EQ(scene.done(), std::vector<bool>(5, false));
    scene.play(scene.card().steps[0]);
    EXPECT_TRUE(scene.done()[0]) << "a drag ticks it";
}

TEST(HelpSheet, ShowsAllOfItAt1280x720) {
    const auto window = open_offscreen({1280, 720});
    App app(*window);
    for (const auto& lab : app.labs().all()) {
        app.run({"lab.open", Json{{"name", lab->name()}}});
        app.run({"view.help", Json{{"open", true}}});
        for (int i = 0; i < 3; ++i) app.tick(nullptr);
        const ImGuiWindow* const sheet = ImGui::FindWindowByName("Keys and mouse");
        ASSERT_NE(sheet, nullptr);
        EXPECT_EQ(sheet->ScrollMax.y, 0.0f) << lab->name();
        app.run({"view.help", Json{{"open", false}}});
    }
}

}  // namespace
}  // namespace tendril::test
