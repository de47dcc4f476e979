// What ffmpeg does after the last frame takes no time of the window: it goes on, can be cancelled, and is
// told.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "app/app.hpp"
#include "app/document/json_complete.hpp"
#include "app/window/offscreen_window.hpp"
#include "tests/app/support/temp_folder.hpp"

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

    /// Something else called ffmpeg, which does this after it has read all frames.
    void film_with(const std::string& end) {
        const std::string program = (tools_ / "ffmpeg").string();
        write(program, "#!/bin/sh\nfor last; do :; done\ncat > \"${last#file:}\"\n" + end);
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        ::setenv("PATH", (tools_.path().string() + ":" + path_).c_str(), 1);
        app_.workspace().ui.video =
            VideoRequest{.path = folder_ / "a.mp4", .size = {64, 64}, .from = 20, .to = 0};
        const Event any = KeyTap{*chord_from_name("l")};
        tick(&any);
    }
    void tick(const Event* event = nullptr) {
        const auto begin = Time::now();
        app_.tick(event);
        longest_ = std::max(longest_, std::chrono::duration<double>(Time::now() - begin).count());
    }
    /// Until the last frame is written.
    void write_frames() {
        for (int i = 0; i < 200 && filming() && filming()->done < filming()->frames; ++i) tick();
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
};

TEST_F(VideoFinish, GoesOnWhileTheWindowDoes) {
    film_with("sleep 1.5\n");
    write_frames();
    ASSERT_TRUE(filming());
    EXPECT_EQ(filming()->done, filming()->frames);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4"));
    for (int i = 0; i < 3000 && filming(); ++i) tick();
    EXPECT_FALSE(filming());
    EXPECT_LT(longest_, 1.0) << "no tick waits for it";
    EXPECT_NE(toast().find("Written: "), std::string::npos) << toast();
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.mp4"});
    EXPECT_EQ(read(folder_ / "a.mp4").size(), 11u * 64 * 64 * 4);
}

TEST_F(VideoFinish, IsCancelledByEscapeAndLeavesNoFile) {
    film_with("exec sleep 30\n");
    write_frames();
    for (int i = 0; i < 3; ++i) tick();
    ASSERT_TRUE(filming());
    EXPECT_FALSE(folder_.names().empty()) << "a part of it is there";
    const Event escape = KeyTap{*chord_from_name("escape")};
    tick(&escape);
    EXPECT_FALSE(filming());
    EXPECT_EQ(toast(), "Cancelled: a.mp4 is not written");
    EXPECT_EQ(folder_.names(), std::vector<std::string>{});
    EXPECT_LT(longest_, 1.0);
}

TEST_F(VideoFinish, TellsWhatWentWrong) {
    film_with("sleep 0.2; echo 'disk full' >&2; exit 1\n");
    for (int i = 0; i < 3000 && filming(); ++i) tick();
    EXPECT_FALSE(filming());
    EXPECT_EQ(toast(), "view.video: ffmpeg failed: disk full");
    EXPECT_EQ(folder_.names(), std::vector<std::string>{});
}

}  // namespace
}  // namespace tendril::test
