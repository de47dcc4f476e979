// The real window: the built program on a display of its own, with that display's mouse and keys.
#include <glm/common.hpp>

#include "tests/app/support/panel_places.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

namespace fs = std::filesystem;
using app::Json;

void sleep(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

/// Waits until the condition is true; false if it never is.
template <class Condition>
bool eventually(const Condition& condition, int seconds = 300) {
    for (int i = 0; i < seconds * 50 * sanitizer_factor; ++i) {
        if (condition()) return true;
        sleep(20);
    }
    return false;
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    return names;
}

bool installed(const char* program) {
    return std::system((std::string("command -v ") + program + " > /dev/null 2>&1").c_str()) == 0;
}

class RealWindow : public testing::Test {
  protected:
    void SetUp() override {
        for (const char* program : {"Xvfb", "xdotool"}) {
            if (!installed(program))
                GTEST_SKIP() << program << " is not installed (third_party/packages-debian.txt)";
        }
        // It chooses a free display itself and prints it. It must not restart when a client leaves.
        server_ = std::make_unique<Process>(std::vector<std::string>{
            "Xvfb", "-displayfd", "1", "-screen", "0", screen_, "-nolisten", "tcp", "-noreset"});
        ASSERT_TRUE(eventually([&] { return server_->out().ends_with('\n') || !server_->running(); }));
        ASSERT_TRUE(server_->running()) << server_->err();
        display_ = ':';
        display_ += server_->out();
        display_.pop_back();
    }
    void TearDown() override {
        program_.reset();
        server_.reset();
    }

    Environment environment() const {
        return {{"DISPLAY", display_},
                {"WAYLAND_DISPLAY", {}},
                {"XDG_CONFIG_HOME", (folder_ / "config").string()},
                {"LIBGL_ALWAYS_SOFTWARE", "1"},
                // The display driver leaks in libraries that are unloaded by then.
                {"LSAN_OPTIONS", "detect_leaks=0"}};
    }
    void start(std::vector<std::string> more = {}) {
        more.insert(more.end(), {"--lab", "chain"});
        start_as_it_comes(more);
    }
    /// Starts with the scene that it opens by default.
    void start_as_it_comes(const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--state", state_path()};
        if (!size_.empty()) arguments.insert(arguments.end(), {"--size", size_});
        arguments.insert(arguments.end(), more.begin(), more.end());
        program_ = std::make_unique<Process>(program_command(arguments), environment());
        ASSERT_TRUE(eventually([&] { return !program_->running() || find_window(); })) << "no window came up";
        ASSERT_TRUE(program_->running()) << program_->err();
        // There is no window manager to focus or position it.
        xdotool({"windowmove", window_, "0", "0"});
        xdotool({"windowfocus", window_});
        sleep(300);
    }
    bool find_window() {
        const Outcome found = xdotool({"search", "--onlyvisible", "--name", "^Tendril$"});
        window_ = found.out.substr(0, found.out.find('\n'));
        return !window_.empty();
    }
    Outcome xdotool(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "xdotool");
        return Process(arguments, environment()).wait();
    }
    void move(glm::vec2 at) {
        xdotool(
            {"mousemove", "--sync", std::to_string(std::lround(at.x)), std::to_string(std::lround(at.y))});
        sleep(50);
    }
    void click(glm::vec2 at) {
        move(at);
        xdotool({"click", "1"});
        sleep(150);
    }
    void key(const char* name) {
        xdotool({"key", "--clearmodifiers", name});
        sleep(150);
    }
    /// Quits and discards unsaved changes.
    void quit_discarding() {
        key("ctrl+q");
        sleep(200);
        click({640, 381});
    }
    /// The state that it wrote, after it has ended cleanly.
    Json ended() {
        const Outcome outcome = program_->wait();
        EXPECT_TRUE(succeeded(outcome));
        return app::parse_json(read(folder_ / "state.json"));
    }
    std::string state_path() const { return (folder_ / "state.json").string(); }
    fs::path settings_path() const { return folder_ / "config/tendril/settings.json"; }

    TempFolder folder_;
    std::unique_ptr<Process> server_, program_;
    std::string screen_ = "1600x1000x24", size_ = "1280x720", display_, window_;
};

/// Smaller than the window that the program would like.
class SmallScreen : public RealWindow {
  protected:
    SmallScreen() { screen_ = "1024x640x24", size_.clear(); }
};

LABEL(window, "RealWindow.*");

TEST_F(RealWindow, TheTargetIsDraggedAndAnotherModeIsClicked) {
    start({"--no-config"});
    const glm::vec2 target = handle(first_state(), "target"), to(600, 250);
    move(target);
    xdotool({"mousedown", "1"});
    sleep(50);
    for (int i = 1; i <= 8; ++i) move(glm::mix(target, to, static_cast<float>(i) / 8.0f));
    xdotool({"mouseup", "1"});
    sleep(100);
    click(chain_panel::forward);  // Forward, in the panel
    quit_discarding();

    const Json state = ended();
    EXPECT_EQ(state["mode"], "forward");
    const glm::vec2 found = handle(state, "segment.7");
    EXPECT_NEAR(found.x, to.x, 1.5f) << "the tail was dragged in the mode before";
    EXPECT_NEAR(found.y, to.y, 1.5f);
    const glm::vec2 head = handle(state, "segment.0"), now = handle(state, "target");
    EXPECT_LT(glm::distance(head, now), 1.5f) << "the target waits at the joint that the mode leads";
}

TEST_F(RealWindow, WhatItRecordedGivesTheSameOffScreen) {
    start({"--no-config", "--record", (folder_ / "record.jsonl").string()});
    const glm::vec2 target = handle(first_state(), "target");
    move(target);
    xdotool({"mousedown", "1"});
    for (const glm::vec2 at : {glm::vec2(750, 300), glm::vec2(700, 260), glm::vec2(640, 280)}) move(at);
    xdotool({"mouseup", "1"});
    xdotool({"keydown", "ctrl", "key", "k", "keyup", "ctrl"});
    sleep(200);
    xdotool({"type", "--delay", "30", "chain.add length=0.5"});
    sleep(200);
    key("Return");
    move({640, 600});
    xdotool({"click", "4"});
    xdotool({"click", "5"});
    key("b");
    sleep(300);
    quit_discarding();
    const Json state = ended();
    EXPECT_EQ(state["segments"].size(), 9u);
    const Outcome replay = run_program({"--headless", "--script", (folder_ / "record.jsonl").string(),
                                        "--state", (folder_ / "replay.json").string()});
    EXPECT_TRUE(succeeded(replay));
    EXPECT_EQ(app::parse_json(read(folder_ / "replay.json")), state);
}

TEST_F(RealWindow, ThePictureFollowsItsSize) {
    start({"--no-config", "--screenshot", (folder_ / "window.png").string()});
    xdotool({"windowsize", "--sync", window_, "1000", "640"});
    sleep(400);
    key("ctrl+q");
    const Json state = ended();
    const Played off_screen = play(ScriptText().wait(1), {.more = {"--size", "1000x640"}});
    EXPECT_EQ(state["handles"], off_screen.state["handles"]);
    EXPECT_EQ(app::read_png(folder_ / "window.png").size, glm::ivec2(1000, 640));
}

TEST_F(SmallScreen, TheWindowFitsIt) {
    start({"--no-config", "--screenshot", (folder_ / "window.png").string()});
    key("ctrl+q");
    ended();
    EXPECT_EQ(app::read_png(folder_ / "window.png").size, glm::ivec2(1024, 640));
}

TEST_F(RealWindow, OpensOnAnArmThatReachesAndHasNothingToSave) {
    start_as_it_comes({"--no-config"});
    key("ctrl+q");
    const Json state = ended();  // it did not ask
    EXPECT_EQ(state["mode"], "reach");
    EXPECT_EQ(state["solve"]["report"]["status"], "Converged");
    EXPECT_EQ(state["card"]["done"], Json(std::vector<bool>(5, false)));
}

TEST_F(RealWindow, KeepsACardThatWasPutAway) {
    start_as_it_comes({});
    key("F2");
    sleep(300);
    key("ctrl+q");
    EXPECT_FALSE(ended().contains("card"));
    EXPECT_EQ(app::parse_json(read(settings_path()))["card_chain"], "put_away");
    start_as_it_comes({});
    key("ctrl+q");
    EXPECT_FALSE(ended().contains("card"));
}

TEST_F(RealWindow, ItsCloseButtonEndsItCleanly) {
    start({"--no-config"});
    if (xdotool({"windowquit", window_}).exit_code != 0) GTEST_SKIP() << "this xdotool has no windowquit";
    EXPECT_EQ(ended()["segments"].size(), 8u);
}

TEST_F(RealWindow, IdleItTakesNoProcessorTime) {
    start({"--no-config"});
    sleep(1500);
    const double before = program_->cpu_seconds();
    sleep(2000);
    EXPECT_LT(program_->cpu_seconds() - before, 0.3);
    program_->signal(SIGTERM);
    ended();
}

TEST_F(RealWindow, SettingsAreKeptByName) {
    start();
    key("t");
    sleep(500);
    key("ctrl+q");
    ended();
    const Json settings = app::parse_json(read(settings_path()));
    EXPECT_EQ(settings["theme"], "light");

    // The next start reads the settings, and leaves them unchanged.
    start({"--screenshot", (folder_ / "light.png").string()});
    program_->signal(SIGINT);
    ended();
    const app::Image picture = app::read_png(folder_ / "light.png");
    EXPECT_GT(picture.rgba[4 * 5], 150) << "the bar is light";
    EXPECT_EQ(app::parse_json(read(settings_path())), settings);
    EXPECT_EQ(names_in(settings_path().parent_path()), std::vector<std::string>{"settings.json"})
        << "a clean end leaves no autosave";
}

TEST_F(RealWindow, WithoutConfigSettingsAreNeitherReadNorWritten) {
    fs::create_directories(settings_path().parent_path());
    write(settings_path(), R"({"theme": "light"})");
    start({"--no-config", "--screenshot", (folder_ / "dark.png").string()});
    key("l");
    sleep(500);
    program_->signal(SIGTERM);
    ended();
    EXPECT_LT(app::read_png(folder_ / "dark.png").rgba[4 * 5], 100);
    EXPECT_EQ(read(settings_path()), R"({"theme": "light"})");
}

TEST_F(RealWindow, BrokenSettingsStopNothing) {
    fs::create_directories(settings_path().parent_path());
    write(settings_path(), "{\"theme\": \"li");
    start();
    key("ctrl+q");
    ended();
}

/// The terminal or session is closed, or the display goes away: no question, and nothing is lost.
TEST_F(RealWindow, KeepsUnsavedWorkWhateverEndsIt) {
    const fs::path config = settings_path().parent_path();
    for (const char* way : {"SIGTERM", "SIGHUP", "the display"}) {
        fs::remove_all(config);
        start();
        move(handle(first_state(), "target"));
        xdotool({"mousedown", "1"});
        move(handle(first_state(), "target") + glm::vec2(-60, -40));
        xdotool({"mouseup", "1"});
        sleep(300);
        const std::string ends = way;
        if (ends == "SIGTERM") program_->signal(SIGTERM);
        if (ends == "SIGHUP") program_->signal(SIGHUP);
        if (ends == "the display") server_->signal(SIGKILL);
        program_->wait();
        std::size_t kept = 0;
        for (const auto& entry : fs::directory_iterator(config))
            kept += entry.path().filename().string().starts_with("autosave-") &&
                    entry.path().extension() == ".json";
        EXPECT_EQ(kept, 1u) << way;
    }
}

TEST_F(RealWindow, OffersWhatACrashLeft) {
    // Autosaves take half a minute: make one by hand, as if left by a program that has ended.
    ScriptText script;
    script.command("chain.preset", {{"name", "arm"}})
        .command("scene.save", {{"path", (folder_ / "arm.json").string()}});
    play(script);
    fs::create_directories(settings_path().parent_path());
    fs::copy_file(folder_ / "arm.json", settings_path().parent_path() / "autosave-999999.json");
    start({"--screenshot", (folder_ / "offer.png").string()});
    program_->signal(SIGTERM);
    const Json state = ended();
    EXPECT_EQ(state["segments"].size(), 8u) << "offered, not taken unasked";
    EXPECT_TRUE(fs::exists(settings_path().parent_path() / "autosave-999999.json"))
        << "and kept until it is answered";
}

}  // namespace
}  // namespace tendril::test
