// The command palette in the running program: typing, Tab, Enter and the mouse, and the commands that ran.
#include <imgui.h>

#include <random>

#include "app/labs/chain/chain_lab.hpp"
#include "tests/app/support/driven_app.hpp"

namespace tendril::test {
namespace {

using namespace app;

class PaletteTest : public testing::Test, protected DrivenApp {
  public:
    PaletteTest() : DrivenApp({1280, 720}) {}

    PaletteTest& key(const char* name) {
        DrivenApp::key(name);
        return *this;
    }
    PaletteTest& type(const std::string& text) {
        DrivenApp::type(text);
        return *this;
    }
    PaletteTest& open() {
        key("ctrl+k");
        app_.tick(nullptr);
        return *this;
    }
    bool is_open() { return workspace().ui.palette; }
    const ChainPart& chain() { return chain_part(workspace()); }
};

LABEL(slow, "PaletteTest.[!H]*");

TEST_F(PaletteTest, PlainWordsFindACommandAndEnterAsksForItsArguments) {
    const std::size_t before = chain().chain.size();
    open().type("joint at the tip").key("enter");
    EXPECT_TRUE(is_open()) << "it needs a length";
    app_.tick(nullptr);
    type("1.5").key("enter");
    EXPECT_FALSE(is_open());
    ASSERT_EQ(chain().chain.size(), before + 1);
    EXPECT_FLOAT_EQ(chain().chain.segments().back().length, 1.5f);
}

TEST_F(PaletteTest, ACommandOfAnotherLabOpensThatLab) {
    run("lab.open", {{"name", "rope"}});
    open().type("chain.clear");
    app_.tick(nullptr);
    EXPECT_TRUE(std::ranges::any_of(recorder_.frame().texts, [](const DrawnText& each) {
        return each.text.starts_with("Opens the Chain lab.");
    })) << "before it runs";
    key("enter");
    EXPECT_EQ(workspace().lab, "chain");
    EXPECT_TRUE(chain().chain.empty());
    open().type("rope.preset name=flag").key("enter");
    EXPECT_EQ(workspace().lab, "rope");
    open().type("undo").key("enter");
    EXPECT_EQ(workspace().lab, "rope") << "the program's own commands stay";
}

/// Ctrl+Z never changes what is not in view.
TEST_F(PaletteTest, UndoOfAnotherLabFirstShowsIt) {
    const auto told = [&] { return workspace().ui.toasts.empty() ? "" : workspace().ui.toasts.back().text; };
    const auto kind = [&] { return workspace().ui.toasts.back().kind; };
    key("ctrl+z");
    EXPECT_EQ(told(), "Nothing to undo.");
    EXPECT_EQ(kind(), ToastKind::Info);
    const std::size_t before = chain().chain.size();
    app_.run({"chain.clear"});
    run("lab.open", {{"name", "rope"}});
    for (const auto& [chord, after] : {std::pair("ctrl+z", before), {"ctrl+y", std::size_t{0}}}) {
        run("lab.open", {{"name", "rope"}});
        const std::size_t now = chain().chain.size();
        key(chord);
        EXPECT_EQ(workspace().lab, "chain");
        EXPECT_TRUE(has(told(), "is in the Chain lab, now open")) << told();
        EXPECT_EQ(chain().chain.size(), now) << chord;
        key(chord);
        EXPECT_EQ(chain().chain.size(), after) << chord;
    }
}

TEST_F(PaletteTest, TabCompletesNameArgumentAndValueWithTheCaretBehind) {
    open().type("chain.mod").key("tab").type("re").key("tab").key("enter");
    EXPECT_FALSE(is_open());
    EXPECT_EQ(app_.state()["mode"], "reach");
    // The common prefix of several commands, then the rest as typed.
    const std::size_t before = chain().chain.size();
    open().type("chain.remo").key("tab").key("tab").type("1").key("enter");
    EXPECT_FALSE(is_open());
    EXPECT_EQ(chain().chain.size(), before - 1);
}

TEST_F(PaletteTest, EnterTakesAValueThatIsChosenOrBegunAndThenRuns) {
    const auto enter_runs = [&](const char* mode) {
        key("enter");
        EXPECT_TRUE(is_open()) << "it stands in the line now";
        EXPECT_NE(app_.state()["mode"], mode);
        app_.tick(nullptr);
        key("enter");
        EXPECT_FALSE(is_open());
        EXPECT_EQ(app_.state()["mode"], mode);
    };
    open().type("chain.mode mode=").key("down").key("down");
    enter_runs("fixed");
    open().type("chain.mode mode=re");
    enter_runs("reach");
}

TEST_F(PaletteTest, AMistakeRunsNothingAndCanBeFixed) {
    const std::size_t before = chain().chain.size();
    for (const char* line : {"chain.add length=-1", "chain.add lenght=1", "chain.add length=abc",
                             "chain.add 1", "nothing like=that", "chain.add position=[0,1,0]"}) {
        open().type(line).key("enter");
        EXPECT_TRUE(is_open()) << line;
        EXPECT_TRUE(workspace().ui.toasts.empty()) << "told in the palette, not by a refusal";
        key("escape");
        ASSERT_EQ(chain().chain.size(), before) << line;
    }
    open().type("chain.add length=-").key("enter");
    ASSERT_TRUE(is_open());
    app_.tick(nullptr);
    key("backspace").type("2").key("enter");
    EXPECT_FALSE(is_open());
    EXPECT_EQ(chain().chain.size(), before + 1);
}

TEST_F(PaletteTest, OpensOnTheLastCommandAndRunsNothingUnasked) {
    const Settings fresh = workspace().settings;
    const auto undone = workspace().history.can_undo();
    open().key("enter");
    EXPECT_TRUE(is_open());
    EXPECT_EQ(workspace().history.can_undo(), undone);
    key("escape");
    open().type("light and dark").key("enter");
    EXPECT_NE(workspace().settings.theme, fresh.theme);
    open().key("enter");
    EXPECT_FALSE(is_open());
    EXPECT_EQ(workspace().settings.theme, fresh.theme) << "once more, by Enter alone";
}

TEST_F(PaletteTest, AClickOnARowChoosesIt) {
    const Theme theme = workspace().settings.theme;
    open().type("theme");
    wait(2);
    const glm::vec2 first(420, 127);
    click(first);
    EXPECT_FALSE(is_open());
    EXPECT_NE(workspace().settings.theme, theme);
    // A command that needs an argument continues in the line, which keeps the keyboard.
    open().type("simulation's speed");
    wait(2);
    take(MousePress{MouseButton::Left, true});
    take(MousePress{MouseButton::Left, false});
    EXPECT_TRUE(is_open());
    wait(3);
    type("0.25").key("enter");
    EXPECT_FALSE(is_open());
    EXPECT_FLOAT_EQ(workspace().clock.speed, 0.25f);
}

TEST_F(PaletteTest, NamesOfTheSceneComplete) {
    run("rope.add", {{"from", {0, 1, 0}}, {"to", {1, 1, 0}}, {"name", "blue line"}});
    open().type("rope.remove name=blu").key("tab").key("enter");
    EXPECT_FALSE(is_open());
    EXPECT_TRUE(workspace().ui.toasts.empty()) << workspace().ui.toasts.front().text;
    const auto& known = app_.commands().find("rope.remove")->arguments.front().known;
    const auto left = known(workspace());
    EXPECT_EQ(std::count(left.begin(), left.end(), "blue line"), 0);
}

/// It shows Ctrl+Q beside it, and does the same.
TEST_F(PaletteTest, QuitAsksAboutUnsavedWorkAsItsKeyDoes) {
    run("chain.add", {{"length", 1}});
    open().type("quit").key("enter");
    EXPECT_FALSE(app_.quit());
    EXPECT_TRUE(workspace().ui.asks_to_quit);
}

TEST_F(PaletteTest, OpensInWindowsOfAnySize) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {90, 60}, {320, 240}, {1024, 640}, {3000, 200}})
        for (const double scale : {0.5, 1.0, 3.0}) {
            take(Resize{size});
            run("view.text_scale", {{"scale", scale}});
            for (const char* line :
                 {"", "add", "chain.solver ", "chain.mode mode=", "xyzzy", "rope.add x=1"}) {
                open().type(line).key("down").key("up");
                app_.draw();
                ASSERT_TRUE(is_open());
                key("escape");
            }
        }
}

TEST_F(PaletteTest, HostileLinesCrashNothing) {
    const TempFolder folder;
    const WorkingIn working(folder);
    std::mt19937 random(5);
    const auto below = [&](std::size_t end) { return random() % end; };
    const char* bits[] = {" ",    "=",     "\"",      "[",      "]",    "{",
                          "}",    "\\",    "1e999",   "-1",     "\xFF", "\xC3\xA4",
                          "name", "mode=", "length=", "index=", "%s%n", "999999999999999999"};
    const char* keys[] = {"tab", "enter", "up", "down", "backspace", "left", "home", "end"};
    const auto& all = app_.commands().all();
    for (int i = 0; i < rounds(600); ++i) {
        if (!is_open()) open();
        std::string line = below(2) == 0 ? all[below(all.size())].name + " " : "";
        for (std::size_t n = below(8); n > 0; --n) line += bits[below(std::size(bits))];
        if (below(50) == 0) line += std::string(600, '[');
        type(line);
        for (std::size_t n = below(4); n > 0; --n) key(keys[below(std::size(keys))]);
        if (below(2) == 0) key("escape");
    }
}

// Panels receive the sideways scrolling of two fingers.
TEST(Wheel, SidewaysReachesThePanels) {
    const auto window = open_offscreen({640, 480});
    Ui ui;
    const Event event = MouseWheel{0.5f, -2.0f};
    ui.begin({window->size(), window->framebuffer_size(), 1.0f}, Theme::Dark, Input(), &event, true);
    EXPECT_EQ(ImGui::GetIO().MouseWheel, 0.5f);
    EXPECT_EQ(ImGui::GetIO().MouseWheelH, -2.0f);
    ui.end();
}

}  // namespace
}  // namespace tendril::test
