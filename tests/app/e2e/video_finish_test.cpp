// ffmpeg's work after the last frame does not block the window: it can be cancelled, and is reported.
#include "app/app.hpp"
#include "app/live_loop.hpp"
#include "app/window/offscreen_window.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using namespace app;
using Time = std::chrono::steady_clock;

class VideoFinish : public testing::Test {
  protected:
    VideoFinish() {
        app_.workspace().clock.measured = true;
        app_.run({"lab.open", Json{{"name", "rope"}}});
        for (int i = 0; i < 30; ++i) app_.tick(nullptr);
    }
    ~VideoFinish() override { ::setenv("PATH", path_.c_str(), 1); }

    /// Films with a stand-in for ffmpeg that runs `end` after it has read all frames.
    void film_with(const std::string& end, bool reads_back = true) {
        install(end, reads_back);
        VideoRequest wanted;
        wanted.path = folder_ / "a.mp4";
        wanted.size = {64, 64};
        wanted.from = 20;
        app_.workspace().ui.video = wanted;
        tick(KeyTap{*chord_from_name("l")});
    }
    void install(const std::string& end, bool reads_back = true) {
        const std::string program = (tools_ / "ffmpeg").string();
        // The last argument is the file, and "-" when it reads that back.
        write(program, "#!/bin/sh\nfor last; do :; done\n[ \"$last\" = - ] && exit " +
                           std::string(reads_back ? "0" : "1") + "\ncat > \"${last#file:}\"\n" + end);
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        ::setenv("PATH", (tools_.path().string() + ":" + path_).c_str(), 1);
    }
    void tick(std::optional<Event> event = {}) {
        const auto begin = Time::now();
        loop_.turn(event ? std::vector<Event>{*event} : std::vector<Event>{}, tick_seconds, player_);
        longest_ = std::max(longest_, std::chrono::duration<double>(Time::now() - begin).count());
    }
    /// Runs until the last frame is written.
    void write_frames() {
        for (int i = 0; i < 200 && filming() && filming()->done < filming()->frames; ++i) tick();
    }
    void finish() {
        for (int i = 0; i < 3000 && filming(); ++i) tick();
        EXPECT_FALSE(filming());
    }
    const std::optional<VideoProgress>& filming() { return app_.workspace().ui.filming; }
    std::string toast() {
        const auto& all = app_.workspace().ui.toasts;
        return all.empty() ? "" : all.back().text;
    }

    const TempFolder folder_, tools_;
    const std::string path_ = std::getenv("PATH");
    double longest_ = 0.0;  ///< seconds, of any tick
    std::unique_ptr<Window> window_ = open_offscreen({800, 600});
    App app_{*window_, false};
    std::atomic<bool> ending_{false};
    LiveLoop loop_{app_, *window_, {.config = false, .ending = ending_}};
    Player player_{Script{}};
};

TEST_F(VideoFinish, DoesNotBlockTheWindow) {
    film_with("sleep 1.5\n");
    write_frames();
    ASSERT_TRUE(filming());
    EXPECT_EQ(filming()->done, filming()->frames);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4"));
    finish();
    EXPECT_LT(longest_, 1.0) << "no tick waits for it";
    EXPECT_NE(toast().find("Written: "), std::string::npos) << toast();
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.mp4"});
    EXPECT_EQ(read(folder_ / "a.mp4").size(), 11u * 64 * 64 * 4);
}

TEST_F(VideoFinish, TakesAnotherNameIfAnotherProgramHasWrittenItsFileMeanwhile) {
    film_with("sleep 0.3\n");
    write_frames();
    write(folder_ / "a.mp4", "another program's");
    finish();
    EXPECT_TRUE(says(toast(), "a.mp4 is not replaced The video is a-1.mp4"));
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a-1.mp4", "a.mp4"}));
    EXPECT_EQ(read(folder_ / "a.mp4"), "another program's");
    EXPECT_EQ(read(folder_ / "a-1.mp4").size(), 11u * 64 * 64 * 4);
}

TEST_F(VideoFinish, IsCancelledByEscapeAndLeavesNoFile) {
    film_with("exec sleep 30\n");
    write_frames();
    for (int i = 0; i < 3; ++i) tick();
    ASSERT_TRUE(filming());
    EXPECT_FALSE(folder_.names().empty()) << "a part of it is there";
    tick(KeyTap{*chord_from_name("escape")});
    EXPECT_FALSE(filming());
    EXPECT_TRUE(says(toast(), "Cancelled a.mp4"));
    EXPECT_EQ(folder_.names(), std::vector<std::string>{});
    EXPECT_LT(longest_, 1.0);
}

/// Replays a session with an ffmpeg that is faster or slower than it was.
class VideoReplay : public VideoFinish {
  protected:
    void press(const char* chord) { tick(KeyTap{*chord_from_name(chord)}); }
    void begin(const std::string& end) {
        install(end);
        app_.run({"lab.open", Json{{"name", "chain"}}});
        app_.run({"chain.select", Json{{"index", 2}}});
        app_.workspace().clock.tick = 0;  // a player counts from there
        app_.start_recording(true);
        app_.run({"chain.motion", Json{{"path", "circle"}}});
        for (int i = 0; i < 30; ++i) tick();
        press("ctrl+k");
        tick();
        tick(TextInput{"view.video path=" + (folder_ / "a.mp4").string() +
                       " width=64 height=64 from=0.3 every=1"});
        press("enter");
        ASSERT_TRUE(filming());
        write_frames();
    }
    /// Plays the recording of the session with another ffmpeg and expects the same state and files.
    void expect_same_again(const std::string& end) {
        for (int i = 0; i < 5; ++i) tick();
        write(folder_ / "r.jsonl", app_.recording());
        app_.write_state((folder_ / "was.json").string());
        const auto files = folder_.names();
        std::filesystem::remove(folder_ / "a.mp4");
        install(end);
        ASSERT_TRUE(succeeded(run_program({"--headless", "--script", (folder_ / "r.jsonl").string(),
                                           "--state", (folder_ / "again.json").string()})));
        EXPECT_EQ(parse_json(read(folder_ / "again.json")), parse_json(read(folder_ / "was.json")));
        std::filesystem::remove(folder_ / "again.json");
        EXPECT_EQ(folder_.names(), files);
    }
};

LABEL(slow, "VideoReplay.*");

TEST_F(VideoReplay, IsCancelledAgainEvenIfFfmpegIsDoneAtOnce) {
    begin("exec sleep 30\n");
    for (int i = 0; i < 40; ++i) tick();
    press("escape");
    EXPECT_EQ(app_.state()["selected"], 2) << "Esc was for the video";
    expect_same_again("");
}

TEST_F(VideoReplay, IsWrittenAgainEvenIfFfmpegTakesLonger) {
    begin("");
    finish();
    for (int i = 0; i < 3; ++i) tick();
    press("escape");
    EXPECT_TRUE(app_.state()["selected"].is_null()) << "there is no video that Esc could be for";
    expect_same_again("sleep 1\n");
}

TEST_F(VideoReplay, IsNotWrittenIfTheSessionEndedEarlier) {
    begin("exec sleep 30\n");
    for (int i = 0; i < 10; ++i) tick();
    EXPECT_TRUE(filming());
    write(folder_ / "r.jsonl", app_.recording());
    install("");
    ASSERT_TRUE(succeeded(run_program({"--headless", "--script", (folder_ / "r.jsonl").string()})));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4"));
}

/// A script does not wait for a user: there is no window.
TEST_F(VideoReplay, OfAHeadlessRecordingFindsTheFileAfterTheLastFrame) {
    install("sleep 0.2\n");
    const std::string recording = (folder_ / "r.jsonl").string();
    const std::string typed =
        "view.video path=" + (folder_ / "a.mp4").string() + " width=64 height=64 from=0.3";
    ScriptText script = ScriptText().command("chain.motion", {{"path", "circle"}}).wait(30);
    script.key("ctrl+k").text(typed.c_str()).key("enter").wait(40);
    write(folder_ / "s.jsonl", script.text());
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--headless", "--script", (folder_ / "s.jsonl").string(), "--record",
                                   recording},
          {"--headless", "--script", recording}}) {
        ASSERT_TRUE(succeeded(run_program(arguments)));
        EXPECT_TRUE(std::filesystem::remove(folder_ / "a.mp4"));
    }
}

/// Holds for every exit code, and even if ffmpeg prints nothing when its file cannot be read back.
TEST_F(VideoFinish, ReportsTheFailureAndLeavesTheOldFile) {
    const std::string old = std::string("\0\0\0\x20", 4) + "ftypisom, the old video";
    write(folder_ / "a.mp4", old);
    for (const auto& [end, reads_back, told] :
         {std::tuple{"sleep 0.2; echo 'disk full' >&2; exit 1\n", true, "ffmpeg disk full"},
          {"echo 'disk full' >&2\n", true, "ffmpeg disk full"},
          {": > \"${last#file:}\"\n", false, "ffmpeg exit code 1"}}) {
        film_with(end, reads_back);
        finish();
        EXPECT_TRUE(says(toast(), told)) << end;
        EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.mp4"});
        EXPECT_EQ(read(folder_ / "a.mp4"), old);
    }
}

}  // namespace
}  // namespace tendril::test
