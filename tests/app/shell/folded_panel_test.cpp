// A folded side panel and the strip that remains of it.
#include <imgui_internal.h>  // the item under the mouse, and the windows
#include <cstdio>

#include "tests/app/support/driven_app.hpp"

namespace tendril::app {
namespace {

TEST(FoldedPanel, OneFoldsAutomaticallyIfTwoDoNotFit) {
    Settings settings;
    EXPECT_TRUE(lay_out({900, 640}, 1.0f, settings, 0.0f).right_open);
    const Layout narrow = lay_out({899, 640}, 1.0f, settings, 0.0f);
    EXPECT_TRUE(narrow.left_open);
    EXPECT_FALSE(narrow.right_open);
    EXPECT_EQ(narrow.right.size().x, 12.0f) << "the strip that brings it back";
    settings.left_open = false;
    EXPECT_TRUE(lay_out({899, 640}, 1.0f, settings, 0.0f).right_open);
    EXPECT_EQ(lay_out({390, 844}, 1.0f, settings, 0.0f).view.max, glm::vec2(390, 430)) << "above the panel";
    settings.right_open = false;
    EXPECT_EQ(lay_out({390, 844}, 1.0f, settings, 0.0f).right.size(), glm::vec2(366, 116)) << "the verdict";
}

TEST(FoldedPanel, OneFoldsAutomaticallyIfTextIsLarge) {
    Settings settings;
    EXPECT_FALSE(lay_out({1280, 720}, 1.5f, settings, 0.0f).one_panel);
    const Layout large = lay_out({1280, 720}, 2.0f, settings, 0.0f);
    EXPECT_TRUE(large.one_panel);
    EXPECT_EQ(large.left.size().x, 2.0f * settings.left_width)
        << "labels have the room that they have at scale 1";
    EXPECT_EQ(large.right.size().x, 24.0f) << "the strip that brings it back";
    settings.left_width = 520.0f;
    EXPECT_GE(lay_out({1280, 720}, 2.0f, settings, 0.0f).view.size().x, 0.339f * 1280.0f);
}

}  // namespace
}  // namespace tendril::app

namespace tendril::test {
namespace {

// A drag along an axis shows its length, which the picture does not show along the view.

using namespace app;

class HeldAxis : public testing::Test, protected DrivenApp {
  protected:
    HeldAxis() : DrivenApp({1280, 800}) {}

    void catch_handle(const char* name) {
        wait(3);
        at_ = handle(app_.state(), name);
        take(MouseMove{at_});
        take(MousePress{MouseButton::Left, true});
    }
    void move(glm::vec2 by) { take(MouseMove{at_ += by}); }
    std::vector<std::string> texts_with(const std::string& what) {
        app_.tick(nullptr);
        std::vector<std::string> found;
        for (const DrawnText& each : recorder_.frame().texts)
            if (each.text.find(what) != std::string::npos) found.push_back(each.text);
        return found;
    }

    glm::vec2 at_{0.0f};
};

TEST_F(HeldAxis, ShowsTheDistanceAndHowMuchNearer) {
    run("chain.preset", {{"name", "reaching_arm"}});
    run("camera.set", {{"target", {0.85, 1.05, 0.2}}, {"yaw_deg", -8}, {"pitch_deg", 15}, {"distance", 7}});
    run("time.pause");
    const auto z = [&] { return app_.state().at("solve").at("pole").at(2).get<double>(); };
    const double before = z();
    catch_handle("pole");
    take(KeyChange{.key = Key::Z, .down = true});
    move({-6, 16});
    move({-6, 16});
    const double by = z() - before;
    ASSERT_GT(std::abs(by), 0.2);
    char said[32];
    std::snprintf(said, sizeof said, "%.2f m along Z", std::abs(by));
    const auto texts = texts_with(said);
    ASSERT_EQ(texts.size(), 2u) << "at the ball and in the status line: " << said;
    for (const std::string& text : texts) EXPECT_TRUE(says(text, by > 0 ? "m nearer" : "m farther")) << text;
    // Once released, the drag continues in the plane of the view.
    take(KeyChange{.key = Key::Z, .down = false});
    EXPECT_TRUE(texts_with("along Z").empty());
}

TEST_F(HeldAxis, AcrossTheViewShowsOnlyTheDistance) {
    run("chain.preset", {{"name", "start"}});
    run("camera.set", {{"yaw_deg", 0}, {"pitch_deg", 10}});
    catch_handle("target");
    take(KeyChange{.key = Key::X, .down = true});
    move({-40, 0});
    move({-40, 0});
    const auto texts = texts_with("m along X");
    ASSERT_EQ(texts.size(), 2u);
    for (const std::string& text : texts) EXPECT_EQ(text.find("nearer"), text.npos) << text;
}

// A tooltip hides nothing that the mouse goes to next: it is beside its panel, bar or sheet.

Rect rect_of(const ImGuiWindow& window) {
    return {{window.Pos.x, window.Pos.y}, {window.Pos.x + window.Size.x, window.Pos.y + window.Size.y}};
}

bool meet(const Rect& a, const Rect& b) {
    constexpr float slack = 1.5f;
    return std::min(a.max.x, b.max.x) - std::max(a.min.x, b.min.x) > slack &&
           std::min(a.max.y, b.max.y) - std::max(a.min.y, b.min.y) > slack;
}

const ImGuiWindow* shown_tooltip() {
    const ImGuiWindow* found = nullptr;
    for (const ImGuiWindow* const each : ImGui::GetCurrentContext()->Windows)
        if (each->Active && !each->Hidden && (each->Flags & ImGuiWindowFlags_Tooltip) != 0) found = each;
    return found;
}

class TooltipPlaces : public testing::TestWithParam<const char*> {
  protected:
    void open(glm::ivec2 size, double text_scale) {
        window_ = open_offscreen(size);
        app_ = std::make_unique<App>(*window_);
        size_ = size;
        app_->run({"lab.open", Json{{"name", GetParam()}}});
        app_->run({"view.text_scale", Json{{"scale", text_scale}}});
        app_->run({"view.fold", Json{{"section", GetParam()}, {"folded", false}}});  // all of its sections
        for (int i = 0; i < 60; ++i) app_->tick(nullptr);
        app_->run({"time.pause", Json::object()});
        app_->settle();
    }
    /// Moves the mouse to each item that is shown.
    void look() {
        std::vector<glm::vec2> places;
        for (const DrawnItem& item : recorder_.frame().items) {
            const ImRect& seen = item.window->InnerClipRect;
            const Rect part{{std::max(item.box.min.x, seen.Min.x), std::max(item.box.min.y, seen.Min.y)},
                            {std::min(item.box.max.x, seen.Max.x), std::min(item.box.max.y, seen.Max.y)}};
            if (part.size().x < 1.0f || part.size().y < 1.0f) continue;
            for (const float share : {0.3f, 0.7f})  // the halves of a plot
                places.push_back({part.min.x + share * part.size().x, part.centre().y});
        }
        for (const glm::vec2 place : places) {
            const Event move = MouseMove{place};
            app_->tick(&move);
            for (int i = 0; i < 2; ++i) app_->tick(nullptr);
            if (const ImGuiWindow* const told = shown_tooltip()) check(rect_of(*told), place);
        }
    }
    void check(const Rect& tooltip, glm::vec2 mouse) {
        const ImGuiContext& context = *ImGui::GetCurrentContext();
        ASSERT_NE(context.HoveredWindow, nullptr);
        const ImGuiWindow& root = *context.HoveredWindow->RootWindow;
        const std::string where = std::string(GetParam()) + ", " + root.Name + " at " +
                                  std::to_string(mouse.x) + ", " + std::to_string(mouse.y) + " of " +
                                  std::to_string(size_.x);
        ++seen_;
        const glm::vec2 size(size_);
        EXPECT_TRUE(tooltip.min.x >= 0.0f && tooltip.min.y >= 0.0f && tooltip.max.x <= size.x &&
                    tooltip.max.y <= size.y)
            << "is beyond the window: " << where;
        const std::string name = root.Name;
        if (name != "canvas" && !name.starts_with("axis ")) {
            EXPECT_FALSE(meet(tooltip, rect_of(root))) << "lies on its panel: " << where;
            return;
        }
        EXPECT_FALSE(tooltip.contains(mouse)) << "lies under the mouse: " << where;
        const float plot = 6.0f * ImGui::GetFontSize();  // its tooltip is in its corner
        for (const DrawnItem& item : recorder_.frame().items)
            if (item.id == context.HoveredId && item.box.size().y < plot) {
                EXPECT_FALSE(meet(tooltip, item.box)) << "lies on its item: " << where;
            }
    }

    FrameRecorder recorder_;
    std::unique_ptr<Window> window_;
    std::unique_ptr<App> app_;
    glm::ivec2 size_{0};
    int seen_ = 0;
};

TEST_P(TooltipPlaces, HideNothingOfTheirPanel) {
    open({1280, 720}, 1.0);
    look();
    app_->run({"view.settings", Json{{"open", true}}});
    app_->settle();
    look();
    EXPECT_GT(seen_, 60);
}

TEST_P(TooltipPlaces, HideNothingBesideLargeText) {
    open({1024, 640}, 1.5);
    look();
    EXPECT_GT(seen_, 20);
}

INSTANTIATE_TEST_SUITE_P(Labs, TooltipPlaces,
                         testing::Values("chain", "rope", "signal", "rig", "humanoid", "linkage"),
                         [](const auto& lab) { return std::string(lab.param); });

// The button beside an explanation that names a cure runs it, as one step to undo.

class CureButton : public testing::Test, protected DrivenApp {
  protected:
    CureButton() : DrivenApp({1280, 720}) {}

    std::string verdict() { return app_.state().at("verdict"); }
};

TEST_F(CureButton, BendsAStraightChain) {
    run("chain.preset", {{"name", "straight"}});
    EXPECT_EQ(verdict(), "Stalled: 0.75 m short");
    click(at("Add a pole target"));
    EXPECT_EQ(verdict(), "Reached");
    EXPECT_FALSE(seen("Add a pole target"));
    run("undo");
    EXPECT_EQ(verdict(), "Stalled: 0.75 m short");
    // Two commands, one step.
    run("chain.target", {{"to", {2.5, 1.5, 0}}});
    run("chain.solver", {{"name", "jacobian_transpose"}, {"iterations", 1}});
    run("chain.target", {{"to", {0.5, 2.5, 1}}});
    const std::string before = verdict();
    EXPECT_EQ(before.find("Did not converge"), 0u) << before;
    click(at("More iterations"));
    EXPECT_NE(verdict(), before);
    run("undo");
    EXPECT_EQ(verdict(), before);
}

TEST_F(CureButton, HalvesTheSubstepOfARopeThatStretches) {
    run("lab.open", {{"name", "rope"}});
    run("rope.preset", {{"name", "bridge"}});
    const auto still = seen("Selection");
    ASSERT_TRUE(still);
    run("rope.settings", {{"solver", "relaxation"}, {"iterations", 1}});
    run("time.play");
    wait(90);
    run("time.pause");
    const auto heading = seen("Selection");
    ASSERT_TRUE(heading);
    EXPECT_EQ(heading->y, still->y) << "the rows below keep still";
    const auto substep = [&] { return app_.state().at("settings").at("substep").get<double>(); };
    const double before = substep();
    click(at("Halve the substep"));
    EXPECT_NEAR(substep(), 0.5 * before, 1e-12);
}

/// An engine's log: the target passes over the shoulder; the elbow is bent towards up, which has no side
/// there.
TEST_F(CureButton, EachOfSeveralShowsASolveWithoutAFlip) {
    run("file.open", {{"path", source_path("tests/app/data/over_the_shoulder.csv")}});
    take(app::MouseMove{{1200.0f, 300.0f}});
    take(app::MouseWheel{-30.0f});
    ASSERT_TRUE(seen("Show"));
    std::vector<glm::vec2> buttons;
    for (const DrawnText& each : recorder_.frame().texts)
        if (each.text == "Show") buttons.push_back(each.box.centre());
    ASSERT_EQ(buttons.size(), 2u);
    for (const auto& [button, solver] : {std::pair(buttons[0], "FABRIK"), {buttons[1], "Two-bone"}}) {
        click(button);
        const std::string& text = workspace().ui.toasts.back().text;
        EXPECT_TRUE(says(text, solver) && says(text, "no flip")) << text;
    }
}

TEST_F(CureButton, IsNotNeededForALongerRope) {
    run("lab.open", {{"name", "rope"}});
    run("rope.clear");
    run("time.pause");
    run("rope.add",
        {{"name", "line"}, {"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"length", 1.7}, {"segments", 8}});
    for (const int particle : {0, 8}) run("rope.pin", {{"rope", "line"}, {"particle", particle}});
    run("rope.select", {{"rope", "line"}});
    click(at("1.700 m"));
    take(app::TextInput{"3"});
    take(app::KeyTap{*app::chord_from_name("enter")});
    EXPECT_TRUE(seen("3.000 m"));
    EXPECT_EQ(verdict(), "Lengths hold");
}

TEST_F(CureButton, RestartsARopeThatADragTore) {
    run("lab.open", {{"name", "rope"}});
    run("rope.clear");
    run("rope.add",
        {{"name", "line"}, {"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"length", 1.2}, {"segments", 8}});
    for (const int particle : {0, 8}) run("rope.pin", {{"rope", "line"}, {"particle", particle}});
    run("rope.set", {{"rope", "line"}, {"tear", 0.1}});
    const glm::vec2 still = at("Selection");
    run("time.play");
    wait(5);
    for (const double y : {1.6, 1.0}) {
        run("rope.hold", {{"rope", "line"}, {"particle", 4}, {"at", {0.5, y, 0}}});
        wait(5);
    }
    run("rope.let_go");
    wait(20);
    run("time.pause");
    ASSERT_EQ(verdict(), "Torn");
    EXPECT_EQ(at("Selection").y, still.y) << "the rows below keep still";
    click(at("Restart"));
    EXPECT_EQ(app_.state().at("ropes").size(), 1u);
    EXPECT_NE(verdict(), "Torn");
    EXPECT_THROW(run("rope.restart"), app::Refused) << "nothing has moved since";
    run("undo");
    EXPECT_EQ(verdict(), "Torn");
}

/// As a person expects of a chain that reaches, though the command alone leaves the tip where it is.
TEST_F(CureButton, IsNotNeededForAJointMore) {
    run("chain.reset");
    run("chain.mode", {{"mode", "reach"}});
    run("chain.target", {{"to", {3, 3, 1}}});
    run("view.fold", {{"section", "chain: Joints"}, {"folded", false}});
    const std::size_t joints = app_.state().at("segments").size();
    click(at("Add"));
    EXPECT_EQ(app_.state().at("segments").size(), joints + 1);
    EXPECT_EQ(verdict(), "Reached");
    run("undo");
    EXPECT_EQ(app_.state().at("segments").size(), joints);
}

TEST_F(CureButton, HasNoTooltipUnderThePalette) {
    run("lab.open", {{"name", "chain"}});
    take(app::MouseMove{at("Arm")});
    const auto told = [&] { return seen("7 joints").has_value(); };
    wait(30);
    EXPECT_TRUE(told());
    key("ctrl+k");
    EXPECT_FALSE(told());
}

/// Also with a joint selected, whose rows would push it out of a small window.
TEST_F(CureButton, OfAFlipIsVisibleOnceItsMarkIsClicked) {
    run("chain.preset", {{"name", "reaching_arm"}});
    run("chain.select", {{"index", 1}});
    for (int i = 0; i <= 60; ++i) {
        const double x = 1.6 - 2.6 * i / 60.0;
        run("chain.target", {{"to", {x, 2.95 - 0.3 * std::abs(x - 0.3), -0.605}}});
        wait(1);
    }
    wait(60);
    const Json events = app_.state().at("events");
    std::size_t flip = 0;
    while (flip < events.size() && events[flip].at("kind") != "flip") ++flip;
    ASSERT_LT(flip, events.size());
    EXPECT_FALSE(seen("Move the pole"));
    run("time.incident", {{"number", flip}});
    EXPECT_TRUE(seen("Move the pole"));
    click(at("Move the pole"));
    EXPECT_NE(app_.state().at("solve").at("pole").at(2).get<double>(), -0.5);
    run("undo");
    EXPECT_GT(workspace().later_ticks(), 20u) << "what came after is back";
}

}  // namespace
}  // namespace tendril::test
