// The cards of things to try: every step of every lab's is played, and ticks itself off.
#include "app/app.hpp"
#include "app/document/command.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/card.hpp"
#include "app/view/assets.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using namespace app;

std::vector<std::string> lab_names() {
    std::vector<std::string> names;
    const Labs labs;
    for (const auto& lab : labs.all()) names.push_back(lab->name());
    return names;
}

/// A lab with its card shown, on the scene that the card is about.
class CardOnScene {
  public:
    explicit CardOnScene(const std::string& lab, glm::ivec2 size = {1280, 720})
        : window_(open_offscreen(size)) {
        run("lab.open", {{"name", lab}});
        card_ = read_card(card_source(lab));
        for (const Card::Line& line : card_.scene) run(line.command, line.arguments);
        run("view.card", {{"open", true}});
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
        wait(60);  // of a large part it looks less often
    }
    std::vector<bool> done() { return app_->state().at("card").at("done").get<std::vector<bool>>(); }
    bool knows_events() { return app_->state().contains("events"); }
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

bool waits_for_an_event(const CardStep& step) {
    for (const CardCondition& condition : step.when)
        if (condition.kind == CardCondition::Kind::Noted) return true;
    return false;
}

class LabCard : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Labs, LabCard, testing::ValuesIn(lab_names()),
                         [](const auto& lab) { return lab.param; });

TEST_P(LabCard, every_step_ticks_itself_off_when_it_is_played) {
    CardOnScene scene(GetParam());
    const std::size_t steps = scene.card().steps.size();
    ASSERT_EQ(scene.done(), std::vector<bool>(steps, false)) << "nothing has happened yet";
    scene.wait(120);
    EXPECT_EQ(scene.done(), std::vector<bool>(steps, false)) << "and time alone does nothing";
    for (std::size_t i = 0; i < steps; ++i) {
        const CardStep& step = scene.card().steps[i];
        EXPECT_FALSE(scene.done()[i]) << step.text << " was done before it was played";
        scene.play(step);
        if (waits_for_an_event(step) && !scene.knows_events()) continue;
        EXPECT_TRUE(scene.done()[i]) << step.text;
    }
}

TEST_P(LabCard, handles_that_light_up_are_in_view) {
    CardOnScene scene(GetParam());
    for (const CardStep& step : scene.card().steps) {
        const bool lights_up = step.place != CardStep::Place::Handle || scene.has_handle(step.place_name);
        EXPECT_TRUE(lights_up) << step.place_name;
        scene.play(step);
    }
}

TEST_P(LabCard, sections_that_light_up_are_there) {
    PanelReader reader;
    const Labs labs;
    const CommandTable table = make_command_table(labs);
    Workspace workspace = make_blank_workspace(labs);
    const auto run = [&](const std::string& command, Json arguments) {
        if (command.starts_with("time.")) return;  // none passes here
        arguments.erase("command");
        table.run(workspace, command, arguments);
    };
    const Lab& lab = *labs.find(GetParam());
    workspace.open_lab(GetParam());
    const Card card = read_card(card_source(GetParam()));
    for (const Card::Line& line : card.scene) run(line.command, line.arguments);
    for (const CardStep& step : card.steps) {
        for (const SharedJson& line : step.script)
            if (line->contains("command")) run((*line)["command"], line);
        if (step.place == CardStep::Place::Handle) continue;
        const std::string text = step.place == CardStep::Place::Panel ? reader.panel(lab, workspace)
                                                                      : reader.inspector(lab, workspace);
        EXPECT_NE(text.find(step.place_name), std::string::npos) << step.text << " is done in:\n" << text;
    }
}

TEST_P(LabCard, is_as_long_as_its_title_says) {
    const Card card = read_card(card_source(GetParam()));
    EXPECT_EQ(card.title, "Five things to try");
    EXPECT_EQ(card.steps.size(), 5u);
    for (const CardStep& step : card.steps) EXPECT_LE(step.text.size(), 110u) << step.text;
}

TEST_P(LabCard, that_was_put_away_comes_back_anew) {
    CardOnScene scene(GetParam());
    scene.play(scene.card().steps.front());
    ASSERT_TRUE(scene.done().front());
    scene.run("view.card", {{"open", false}});
    EXPECT_FALSE(scene.app().state().contains("card"));
    const Settings kept = scene.app().workspace().settings;
    std::vector<std::string> complaints;
    EXPECT_EQ(load_settings(save_settings(kept), complaints), kept) << "for good";
    EXPECT_TRUE(complaints.empty());
    for (const Card::Line& line : scene.card().scene) scene.run(line.command, line.arguments);
    scene.run("view.card", Json::object());
    scene.wait(60);
    EXPECT_FALSE(scene.done().front());
}

TEST(CardsTest, are_hidden_without_a_window) {
    const auto window = open_offscreen({1280, 720});
    App app(*window);
    app.tick(nullptr);
    EXPECT_FALSE(app.state().contains("card"));
}

}  // namespace
}  // namespace tendril::test
