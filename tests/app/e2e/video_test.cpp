// The last seconds as a video: every frame is the picture of its moment, and nothing else changes.
#include "tests/app/support/apng.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

/// A chain whose target is dragged in the view.
ScriptText dragged_chain() {
    ScriptText script;
    script.command("lab.open", {{"name", "chain"}}).command("chain.mode", {{"mode", "reach"}});
    const glm::vec2 at = handle(state_after(script), "target");
    std::vector<glm::vec2> points{at};
    for (int i = 1; i <= 30; ++i)
        points.push_back(at - glm::vec2(6.0f * static_cast<float>(i), 3.0f * static_cast<float>(i % 7)));
    return script.drag(points).wait(5);
}

ScriptText swinging_rope() {
    ScriptText script;
    return script.command("lab.open", {{"name", "rope"}})
        .command("rope.preset", {{"name", "pendulum"}})
        .wait(40);
}

Json video(const std::filesystem::path& path, const Json& more = Json::object()) {
    Json arguments{{"path", path.string()}, {"width", 160}, {"height", 120}};
    arguments.update(more);
    return arguments;
}

/// The message that refuses the command, in a script after `before`.
std::string refusal(const ScriptText& before, const Json& arguments, const Environment& changes = {}) {
    const TempFolder folder;
    ScriptText script = before;
    write(folder / "script.jsonl", script.command("view.video", arguments).text());
    const std::vector<std::string> played{"--headless", "--script", (folder / "script.jsonl").string()};
    const Outcome outcome = changes.empty() ? run_here(played) : run_program(played, changes);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    return outcome.err;
}

/// Puts a program of that name first on PATH.
Environment with_program(const TempFolder& folder, const std::string& name, const std::string& script) {
    write(folder / name, "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
    return {{"PATH", folder.path().string() + ":" + std::getenv("PATH")}};
}

void expect_frames_are_pictures(const ScriptText& scene, const Json& more, int from, int to, int every) {
    const TempFolder folder;
    Json look{{"width", 160}, {"height", 120}};
    if (more.contains("transparent")) look["transparent"] = true;
    ScriptText script = scene;
    script.command("view.video", video(folder / "video.png", more));
    std::vector<std::filesystem::path> pictures;
    for (int back = from; back >= to; back -= every) {
        pictures.push_back(folder / (std::to_string(back) + ".png"));
        look["path"] = pictures.back().string();
        script.command("time.seek", {{"ticks_back", back}}).command("view.picture", look);
    }
    play(script);
    const Apng read_back = read_apng(read(folder / "video.png"));
    EXPECT_EQ(read_back.size, glm::ivec2(160, 120));
    ASSERT_EQ(read_back.frames.size(), pictures.size());
    int different = 0;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        EXPECT_EQ(read_back.frames[i].image.rgba, app::read_png(pictures[i]).rgba) << pictures[i];
        different += i > 0 && read_back.frames[i].image.rgba != read_back.frames[i - 1].image.rgba;
    }
    EXPECT_GT(different, static_cast<int>(pictures.size()) / 2) << "something moves in it";
}

TEST(Video, ShowsADragAWalkAndARopeAsTheyWere) {
    const ScriptText walk = ScriptText()
                                .command("lab.open", {{"name", "humanoid"}})
                                .command("humanoid.clip", {{"name", "walk"}, {"play", true}})
                                .wait(60);
    expect_frames_are_pictures(dragged_chain(), {{"from", 0.5}, {"to", 0.1}}, 30, 6, 2);
    expect_frames_are_pictures(walk, {{"from", 0.5}, {"to", 0.1}, {"every", 6}}, 30, 6, 6);
    expect_frames_are_pictures(swinging_rope(), {{"from", 0.6}, {"every", 3}}, 36, 0, 3);
}

TEST(Video, HasATransparentBackground) {
    expect_frames_are_pictures(swinging_rope(), {{"from", 0.2}, {"every", 4}, {"transparent", true}}, 12, 0,
                               4);
}

/// Again after seeking: the video does not end at the displayed moment.
TEST(Video, ShowsAllRememberedMomentsAfterSeeking) {
    const TempFolder folder;
    ScriptText script = swinging_rope();
    const Json now = state_after(script);
    const int remembered = now["time"]["remembered"].get<int>();
    ASSERT_GE(remembered, 30);
    script.command("view.video", video(folder / "a.png"))
        .command("time.seek", {{"ticks_back", 20}})
        .command("view.video", video(folder / "b.png"));
    play(script);
    const Apng at_the_end = read_apng(read(folder / "a.png")),
               in_the_past = read_apng(read(folder / "b.png"));
    EXPECT_EQ(at_the_end.frames.size(), static_cast<std::size_t>(remembered / 2 + 1));
    ASSERT_EQ(in_the_past.frames.size(), at_the_end.frames.size());
    for (std::size_t i = 0; i < at_the_end.frames.size(); ++i)
        EXPECT_EQ(in_the_past.frames[i].image.rgba, at_the_end.frames[i].image.rgba) << i;
}

TEST(Video, ChangesNothingElse) {
    for (const ScriptText& scene : {dragged_chain(), swinging_rope()}) {
        const TempFolder folder;
        ScriptText plain = scene, filmed = scene;
        plain.wait(400);
        filmed.command("view.video", video(folder / "a.png")).wait(400);
        const Played before = play(plain, {.picture = true}), after = play(filmed, {.picture = true});
        EXPECT_EQ(before.state, after.state);
        EXPECT_EQ(before.picture.rgba, after.picture.rgba);
    }
    // Redo still works.
    const TempFolder folder;
    ScriptText undone = dragged_chain();
    undone.command("undo").command("view.video", video(folder / "a.png")).command("redo");
    EXPECT_EQ(state_after(undone)["segments"], state_after(dragged_chain())["segments"]);
}

TEST(Video, IsRefusedInWords) {
    const TempFolder folder;
    const ScriptText scene = swinging_rope(), nothing = ScriptText().command("time.pause");
    const auto refused = [&](const Json& more) { return refusal(scene, video(folder / "a.png", more)); };
    EXPECT_TRUE(has(refusal(nothing, video(folder / "a.png")), "nothing has moved yet"));
    EXPECT_TRUE(has(refused({{"from", 0.1}, {"to", 0.2}}),
                    "from must be further back than to, which is 0.20 s, got 0.10 s"));
    EXPECT_TRUE(has(refused({{"from", 0.2}, {"to", 0.2}}), "from must be further back"));
    EXPECT_TRUE(has(refused({{"from", 5}}), "remembered, got 5.00 s"));
    EXPECT_TRUE(has(refused({{"speed", 2}, {"every", 1}}), "must be at most 1.00, got 2.00"));
    for (const char* name : {"a.webm", "a", "a.PNGX", ""})
        EXPECT_TRUE(has(refused({{"path", name}}), "path must end in .png, .gif or .mp4, got")) << name;
    EXPECT_TRUE(has(refused({{"path", "/nowhere/a.png"}}), "/nowhere/a.png"));
    EXPECT_TRUE(has(refused({{"path", folder.path().string() + "/"}}), "path must end in"));
    const TempFolder tools;
    const Environment fake = with_program(tools, "ffmpeg", "cat > /dev/null\n"), none{{"PATH", "/nowhere"}};
    const auto mp4 = [&](const Json& more) { return refusal(scene, video(folder / "a.mp4", more), fake); };
    EXPECT_TRUE(has(refusal(scene, video(folder / "a.mp4"), none), "to write MP4, install ffmpeg"));
    EXPECT_TRUE(has(refusal(scene, video(folder / "a.gif"), none), "to write GIF, install ffmpeg"));
    EXPECT_TRUE(has(refusal(scene, video(folder / "a.gif", {{"every", 1}}), fake),
                    "must be at most 0.83, got 1.00: viewers of GIF slow down above 50 frames a second"));
    EXPECT_TRUE(has(mp4({{"transparent", true}}), "MP4 has no transparency"));
    EXPECT_TRUE(has(mp4({{"width", 161}}), "width of an MP4 must be even, got 161"));
    EXPECT_TRUE(has(mp4({{"height", 121}}), "height of an MP4 must be even, got 121"));
    ScriptText plots = scene;
    plots.command("lab.open", {{"name", "signal"}}).wait(30);
    EXPECT_TRUE(has(refusal(plots, video(folder / "a.png")), "more than a view of a scene"));
    EXPECT_EQ(folder.names(), std::vector<std::string>{}) << "nothing is left of any of these";
}

/// Opens the dialog with its key and accepts the suggested name with Enter.
ScriptText recorded_by_hand() {
    ScriptText script = swinging_rope();
    return script.key("ctrl+shift+p").wait(4).key("enter").wait(3);
}

TEST(Video, IsWrittenInTheBackground) {
    const TempFolder folder;
    ScriptText script = recorded_by_hand();
    EXPECT_TRUE(succeeded(run_script(script.wait(60), {}, folder.path())));
    ASSERT_EQ(folder.names(), std::vector<std::string>{"tendril-1.png"});
    EXPECT_GE(read_apng(read(folder / "tendril-1.png")).frames.size(), 20u);
    // It does not contain later changes.
    ScriptText meanwhile = recorded_by_hand();
    meanwhile.command("rope.clear").command("lab.open", {{"name", "chain"}}).wait(60);
    const std::string alone = read(folder / "tendril-1.png");
    std::filesystem::remove(folder / "tendril-1.png");
    EXPECT_TRUE(succeeded(run_script(meanwhile, {}, folder.path())));
    EXPECT_EQ(read(folder / "tendril-1.png"), alone);
}

/// Every frame is the picture with the camera turned by its share; the simulation stands still.
TEST(Turntable, TurnsTheCameraOnce) {
    const TempFolder folder;
    ScriptText script = swinging_rope();
    script.command("view.turntable", video(folder / "turn.png", {{"frames", 4}}));
    const double yaw = state_after(script)["camera"]["yaw_deg"];
    for (int i = 0; i < 4; ++i)
        script.command("camera.set", {{"yaw_deg", yaw + 90.0 * i}})
            .command("view.picture", video(folder / (std::to_string(i) + ".png")));
    play(script, {.more = {"--force"}});
    const Apng turn = read_apng(read(folder / "turn.png"));
    ASSERT_EQ(turn.frames.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const app::Image still = app::read_png(folder / (std::to_string(i) + ".png"));
        int off = 0;
        for (std::size_t at = 0; at < still.rgba.size(); ++at)
            off += std::abs(turn.frames[i].image.rgba[at] - still.rgba[at]) > 8;
        EXPECT_LT(off, 100) << i;
        EXPECT_NE(turn.frames[i].image.rgba, turn.frames[(i + 1) % 4].image.rgba);
    }
}

TEST(Video, IsCancelledByEscapeAndLeavesNoFile) {
    const TempFolder folder;
    ScriptText script = recorded_by_hand();
    ScriptText escaped = script, commanded = script;
    EXPECT_TRUE(succeeded(run_script(escaped.key("escape").wait(80), {}, folder.path())));
    EXPECT_TRUE(succeeded(run_script(commanded.command("view.end_video").wait(80), {}, folder.path())));
    EXPECT_TRUE(succeeded(run_script(script, {}, folder.path()))) << "the program ends before the video does";
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
    EXPECT_TRUE(has(run_script(swinging_rope().command("view.end_video")).err, "no video is being written"));
    ScriptText twice = recorded_by_hand();
    EXPECT_TRUE(has(run_script(twice.command("view.video", video("b.png")), {}, folder.path()).err,
                    "tendril-1.png is still being written"));
}

TEST(Video, ContinuesWhenEscapeHasAnotherMeaningOrTheUserQuits) {
    const TempFolder folder;
    ScriptText menu = recorded_by_hand();
    EXPECT_TRUE(succeeded(run_script(menu.click({22, 20}).key("escape").wait(80), {}, folder.path())));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"tendril-1.png"}) << "the menu was closed";
    ScriptText quits = recorded_by_hand();
    EXPECT_TRUE(has(run_script(quits.key("ctrl+q").wait(80), {}, folder.path()).err,
                    "tendril-2.png is still being written"));
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"tendril-1.png", "tendril-2.png"}));
}

/// A stand-in for ffmpeg counts the bytes that it is given.
TEST(Mp4Video, GoesThroughAPipe) {
    const TempFolder folder, tools;
    const Environment fake =
        with_program(tools, "ffmpeg",
                     "echo \"$@\" >> '" + (tools / "arguments").string() +
                         "'\nfor last; do :; done\n[ \"$last\" = - ] || wc -c > \"${last#file:}\"\n");
    ScriptText script = swinging_rope();
    script.command("view.video", video(folder / "a b;c.mp4", {{"from", 0.5}, {"every", 3}}));
    EXPECT_TRUE(succeeded(run_script(script, fake)));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a b;c.mp4"});
    EXPECT_EQ(std::stol(read(folder / "a b;c.mp4")), 11L * 160 * 120 * 4);
    const std::string arguments = read(tools / "arguments");
    EXPECT_TRUE(has(arguments, "-video_size 160x120 -framerate 60/3"));
    EXPECT_TRUE(has(arguments, "yuv420p"));
    ScriptText own_size = swinging_rope();
    own_size.command("view.video", {{"path", (folder / "own.mp4").string()}, {"from", 0.1}});
    EXPECT_TRUE(succeeded(run_script(own_size, fake))) << "of the view, made even";
}

TEST(Mp4Video, ReportsFfmpegsMessage) {
    const TempFolder folder, tools;
    for (const char* end : {"echo 'Unknown encoder libx264' >&2; exit 1\n",
                            "cat > /dev/null; echo 'Unknown encoder libx264' >&2; exit 1\n"}) {
        const Environment fake = with_program(tools, "ffmpeg", end);
        EXPECT_TRUE(has(refusal(swinging_rope(), video(folder / "a.mp4"), fake),
                        "view.video: ffmpeg failed: Unknown encoder libx264"));
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(Mp4Video, HasAllFrames) {
    if (std::system("ffmpeg -version > /dev/null 2>&1 && ffprobe -version > /dev/null 2>&1") != 0)
        GTEST_SKIP() << "ffmpeg is not installed";
    const TempFolder folder;
    for (const auto& [name, said] :
         {std::pair("a.mp4", "h264,160,120,11\n"), {"a.gif", "gif,160,120,11\n"}}) {
        ScriptText script = swinging_rope();
        script.command("view.video", video(folder / name, {{"from", 0.5}, {"every", 3}}));
        EXPECT_TRUE(succeeded(run_script(script)));
        const std::string probe =
            "ffprobe -v error -count_frames -show_entries stream=nb_read_frames,width,height,codec_name "
            "-of csv=p=0 '" +
            (folder / name).string() + "' > '" + (folder / "said").string() + "'";
        ASSERT_EQ(std::system(probe.c_str()), 0);
        EXPECT_EQ(read(folder / "said"), said);
    }
}

TEST(CopiedPicture, GoesToTheClipboardProgram) {
    const TempFolder folder, tools;
    Environment fake = with_program(tools, "xclip",
                                    "echo \"$@\" > '" + (tools / "arguments").string() + "'\ncat > '" +
                                        (tools / "clipboard").string() + "'\n");
    fake.push_back({"WAYLAND_DISPLAY", std::nullopt});
    const Json look{{"width", 200}, {"height", 100}, {"transparent", true}};
    Json to_file = look;
    to_file["path"] = (folder / "a.png").string();
    ScriptText script = swinging_rope();
    script.command("view.copy_picture", look).command("view.picture", to_file);
    EXPECT_TRUE(succeeded(run_script(script, fake)));
    EXPECT_EQ(read(tools / "clipboard"), read(folder / "a.png"));
    EXPECT_EQ(read(tools / "arguments"), "-selection clipboard -t image/png\n");
}

TEST(CopiedPicture, SaysWhatToInstall) {
    const ScriptText copy = ScriptText().command("view.copy_picture");
    const auto said = [&](const std::optional<std::string>& wayland) {
        return run_script(copy, {{"PATH", "/nowhere"}, {"WAYLAND_DISPLAY", wayland}}).err;
    };
    EXPECT_TRUE(has(said(std::nullopt), "view.copy_picture: to copy a picture, install xclip"));
    EXPECT_TRUE(has(said("wayland-0"), "view.copy_picture: to copy a picture, install wl-clipboard"));
    const TempFolder tools;
    const Environment fake =
        with_program(tools, "xclip", "echo \"Error: Can't open display: (null)\" >&2; exit 1\n");
    EXPECT_TRUE(has(run_script(copy, fake).err, "xclip failed: Error: Can't open display: (null)"));
}

TEST(VideoDialog, PausesOnlyUntilItIsClosed) {
    const auto window = app::open_offscreen({1280, 720});
    app::App program(*window);
    const auto run = [&](const char* name, const Json& arguments = Json::object()) {
        program.run({name, arguments});
    };
    run("chain.motion", {{"path", "circle"}});
    for (int i = 0; i < 20; ++i) program.tick(nullptr);
    const app::Clock& clock = program.workspace().clock;
    ASSERT_TRUE(clock.playing);
    run("view.video_dialog");
    EXPECT_FALSE(clock.playing);
    run("view.close");
    EXPECT_TRUE(clock.playing);
    const TempFolder folder;
    run("view.video_dialog");
    run("view.video", video(folder / "last.png"));
    EXPECT_TRUE(clock.playing) << "recording it goes on as well";
    run("time.pause");
    run("view.video_dialog");
    run("view.close");
    EXPECT_FALSE(clock.playing) << "it was paused before";
}

}  // namespace
}  // namespace tendril::test
