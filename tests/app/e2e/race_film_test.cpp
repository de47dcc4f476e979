// A race as a picture with its labels, and as a film.
#include "app/labs/chain/study.hpp"
#include "tests/app/support/apng.hpp"
#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Image;
using app::Json;

ScriptText opened_race() {
    ScriptText script = ScriptText().command("chain.mode", {{"mode", "reach"}});
    script.command("race.open", {{"start", "straight"}});
    return script.command("chain.target", {{"to", {3, 3, 1}}});
}

Json sized(const std::filesystem::path& path, Json more = Json::object()) {
    more.update({{"path", path.string()}, {"width", 800}, {"height", 600}});
    return more;
}

/// Whether each pixel differs.
std::vector<bool> differing(const Image& a, const Image& b) {
    EXPECT_EQ(a.size, b.size);
    std::vector<bool> pixels(a.rgba.size() / 4);
    for (std::size_t i = 0; i < a.rgba.size() && a.size == b.size; ++i)
        if (a.rgba[i] != b.rgba[i]) pixels[i / 4] = true;
    return pixels;
}

int count_in(const std::vector<bool>& pixels, int width, glm::ivec2 from, glm::ivec2 to) {
    int count = 0;
    for (int y = from.y; y < to.y; ++y)
        for (int x = from.x; x < to.x; ++x) count += pixels[static_cast<std::size_t>(y * width + x)];
    return count;
}

TEST(RacePicture, HasItsLegendAndPlotUnlessSwitchedOff) {
    const TempFolder folder;
    ScriptText script = opened_race();
    script.command("view.picture", sized(folder / "default.png"));
    script.command("view.picture", sized(folder / "with.png", {{"labels", true}}));
    script.command("view.picture", sized(folder / "without.png", {{"labels", false}}));
    for (const bool on : {true, false}) {
        Json small = sized(folder / (on ? "small.png" : "bare.png"), {{"labels", on}});
        small.update({{"width", 400}, {"height", 300}});
        script.command("view.picture", small);
    }
    script.command("race.close").command("view.picture", sized(folder / "closed.png"));
    script.command("view.picture", sized(folder / "closed_without.png", {{"labels", false}}));
    play(script);
    const auto picture = [&](const char* name) { return app::read_png(folder / name); };
    EXPECT_EQ(picture("default.png").rgba, picture("with.png").rgba) << "on while a race is open";
    EXPECT_EQ(picture("closed.png").rgba, picture("closed_without.png").rgba) << "else off";
    const std::vector<bool> pixels = differing(picture("with.png"), picture("without.png"));
    const int legend = count_in(pixels, 800, {0, 360}, {500, 600});
    const int plot = count_in(pixels, 800, {500, 0}, {800, 210});
    EXPECT_GT(legend, 1000) << "in its corner";
    EXPECT_GT(plot, 1000) << "in the opposite one";
    EXPECT_LT(legend + plot, count_in(pixels, 800, {0, 0}, {800, 600})) << "and the names at the tips";
    const std::vector<bool> small = differing(picture("small.png"), picture("bare.png"));
    EXPECT_LT(count_in(small, 400, {200, 0}, {400, 150}), 10000) << "a plot would hide the scene";
}

TEST(RacePicture, HasItsLegendWhereItCoversNoChain) {
    const TempFolder folder;
    ScriptText script = opened_race();
    for (const char* solver : {"jacobian_transpose", "dls", "svd_dls"})
        script.command("race.solver", {{"name", solver}, {"on", true}});
    script.command("camera.frame", {{"what", "all"}}).command("race.show", {{"iteration", 2}});
    Json wide = sized(folder / "with.png");
    wide.update({{"width", 1280}, {"height", 720}});
    script.command("view.picture", wide);
    wide.update({{"path", (folder / "without.png").string()}, {"labels", false}});
    play(script.command("view.picture", wide));
    const std::vector<bool> pixels =
        differing(app::read_png(folder / "with.png"), app::read_png(folder / "without.png"));
    EXPECT_EQ(count_in(pixels, 1280, {0, 450}, {500, 720}), 0) << "the root is there";
    EXPECT_GT(count_in(pixels, 1280, {0, 0}, {500, 300}), 2000);
}

TEST(RacePicture, HasTheTitlesOfItsPanes) {
    const TempFolder folder;
    ScriptText script = opened_race();
    script.command("race.side_by_side", {{"on", true}}).command("camera.frame", {{"what", "all"}});
    script.command("view.picture", sized(folder / "with.png"));
    script.command("view.picture", sized(folder / "without.png", {{"labels", false}}));
    play(script);
    const std::vector<bool> pixels =
        differing(app::read_png(folder / "with.png"), app::read_png(folder / "without.png"));
    for (const glm::ivec2 corner : {glm::ivec2(0, 0), {401, 0}, {0, 301}, {401, 301}}) {
        EXPECT_GT(count_in(pixels, 800, corner + 4, corner + glm::ivec2(395, 60)), 1500);
        EXPECT_EQ(count_in(pixels, 800, corner + glm::ivec2(150, 70), corner + glm::ivec2(395, 295)), 0);
    }
}

TEST(RacePicture, OtherScenesHaveLabelsOnRequest) {
    const TempFolder folder;
    ScriptText script = ScriptText().command("chain.select", {{"index", 2}});
    script.command("view.picture", sized(folder / "without.png"));
    script.command("view.picture", sized(folder / "with.png", {{"labels", true}}));
    script.command("view.picture", sized(folder / "clear.png", {{"labels", true}, {"transparent", true}}));
    script.command("view.labels", {{"show", "always"}});
    script.command("view.picture", sized(folder / "always.png", {{"labels", true}}));
    play(script);
    const Image with = app::read_png(folder / "with.png");
    EXPECT_NE(with.rgba, app::read_png(folder / "without.png").rgba);
    EXPECT_NE(with.rgba, app::read_png(folder / "always.png").rgba) << "the window's own labels";
    const Image clear = app::read_png(folder / "clear.png");
    EXPECT_EQ(clear.rgba[3], 0);
}

/// The dialog's switch is on in a race, too.
TEST(RacePicture, IsLabelledInAVideoOfThePast) {
    const TempFolder folder;
    ScriptText script = opened_race();
    const glm::vec2 target = handle(state_after(script), "target");
    script.drag({target, target - glm::vec2(40.0f, 0.0f), target - glm::vec2(60.0f, 30.0f)});
    const Json view{{"path", (folder / "with.png").string()}, {"labels", true}};
    Json bare = view;
    bare.update({{"path", (folder / "without.png").string()}, {"labels", false}});
    script.command("view.video", view).command("view.video", bare);
    script.key("ctrl+shift+p").wait(4).key("enter").wait(60);
    EXPECT_TRUE(succeeded(run_script(script, {}, folder.path())));
    const auto first = [&](const char* name) {
        return read_apng(read(folder / name)).frames.front().image.rgba;
    };
    EXPECT_EQ(first("tendril-1.png"), first("with.png"));
    EXPECT_NE(first("tendril-1.png"), first("without.png"));
}

TEST(RaceFilm, ShowsTheRaceFromItsStartToItsEnd) {
    const TempFolder folder;
    ScriptText script = opened_race();
    const int last = state_after(script)["race_shown"]["iterations"].get<int>();
    ASSERT_GT(last, 2);
    script.command("race.show", {{"iteration", 1}});
    script.command("race.record", sized(folder / "film.png", {{"pace", 10}}));
    script.command("view.picture", sized(folder / "kept.png"));
    for (const int k : {0, 2, last})
        script.command("race.show", {{"iteration", k}})
            .command("view.picture", sized(folder / (std::to_string(k) + ".png")));
    script.command("race.show", {{"iteration", 1}}).command("view.picture", sized(folder / "1.png"));
    play(script);
    const auto pixels = [&](const std::string& name) { return app::read_png(folder / name).rgba; };
    const Apng film = read_apng(read(folder / "film.png"));
    ASSERT_EQ(film.frames.size(), static_cast<std::size_t>(3 * last + 1 + 30)) << "and a second at the end";
    EXPECT_EQ(film.frames.front().image.rgba, pixels("0.png"));
    EXPECT_EQ(film.frames[3].image.rgba, pixels("1.png"));
    EXPECT_EQ(film.frames[5].image.rgba, pixels("1.png"));
    EXPECT_EQ(film.frames[6].image.rgba, pixels("2.png"));
    EXPECT_EQ(film.frames.back().image.rgba, pixels(std::to_string(last) + ".png"));
    EXPECT_EQ(pixels("kept.png"), pixels("1.png")) << "the window stays where it was";
}

TEST(RaceFilm, IsTheSameEveryTimeAndTakesItsLook) {
    const TempFolder folder;
    ScriptText script = opened_race();
    script.command("race.show", {{"iteration", 2}});
    script.command("race.record", {{"path", (folder / "a.png").string()}, {"width", 200}, {"height", 150}});
    script.command("race.side_by_side", {{"on", false}});
    script.command("race.record", {{"path", (folder / "b.png").string()}, {"width", 200}, {"height", 150}});
    play(script);
    EXPECT_EQ(read(folder / "a.png"), read(folder / "b.png"));
    EXPECT_EQ(read_apng(read(folder / "a.png")).size, glm::ivec2(200, 150));
}

TEST(RaceFilm, LastsFourToTwelveSecondsForAnyIterations) {
    using app::race_film_seconds;
    for (const std::size_t few : {1u, 2u, 4u, 11u}) EXPECT_NEAR(race_film_seconds(few), 4.0, 1e-4) << few;
    EXPECT_NEAR(race_film_seconds(20), 6.0, 1e-4) << "four iterations a second";
    for (const std::size_t many : {44u, 100u, 5000u}) EXPECT_NEAR(race_film_seconds(many), 12.0, 1e-4);
    const TempFolder folder;
    ScriptText script = opened_race();
    script.command("race.record", {{"path", (folder / "a.png").string()}, {"width", 64}, {"height", 48}});
    const int last = state_after(script)["race_shown"]["iterations"].get<int>();
    play(script, {.more = {"--force"}});
    EXPECT_NEAR(static_cast<double>(read_apng(read(folder / "a.png")).frames.size()) / 30.0,
                race_film_seconds(static_cast<std::size_t>(last)), 0.1);
}

TEST(RaceFilm, IsRefusedInWords) {
    const TempFolder folder;
    const auto recorded = [&](ScriptText script, const Json& arguments) {
        write(folder / "script.jsonl", script.command("race.record", arguments).text());
        return run_here({"--headless", "--script", (folder / "script.jsonl").string()});
    };
    const auto refused = [&](const ScriptText& script, const Json& arguments, const std::string& words) {
        const Outcome outcome = recorded(script, arguments);
        EXPECT_EQ(outcome.exit_code, 1) << words;
        EXPECT_TRUE(says(outcome.err, "race.record: " + words));
        EXPECT_EQ(folder.names(), std::vector<std::string>{"script.jsonl"}) << words;
    };
    refused(ScriptText(), sized(folder / "a.png"), "no race is open");
    refused(opened_race(), Json::object(), "path is missing");
    refused(opened_race(), sized(folder / "a.tiff"), "path must end in .png .gif or .mp4 got a.tiff");
    refused(opened_race(), sized("/nowhere/a.png"), "cannot write /nowhere/a.png No such file");
    ScriptText elsewhere = opened_race();
    elsewhere.command("lab.open", {{"name", "rope"}});
    refused(elsewhere, sized(folder / "a.png"), "race not in view open the lab chain");
    ScriptText back = elsewhere;
    back.command("lab.open", {{"name", "chain"}});
    EXPECT_EQ(recorded(back, sized(folder / "a.png")).exit_code, 0) << "it is the view that was in the way";
    EXPECT_EQ(folder.names().size(), 2u);
}

TEST(RaceStrip, ScrubsPlaysAndStepsByMouseAndKeys) {
    const auto shown = [](const ScriptText& script) {
        return state_after(script)["race_shown"]["iteration"].get<int>();
    };
    const Json state = state_after(opened_race());
    const int last = state["race_shown"]["iterations"].get<int>();
    EXPECT_EQ(state["race_shown"]["iteration"], last);
    EXPECT_EQ(shown(opened_race().key("left")), last - 1);
    EXPECT_EQ(shown(opened_race().key("left").key("left").key("right")), last - 1);
    const Json& strip = state["layout"]["strip"];
    const float left = strip["min"][0].get<float>(), right = strip["max"][0].get<float>(),
                middle = 0.5f * (strip["min"][1].get<float>() + strip["max"][1].get<float>());
    EXPECT_EQ(shown(opened_race().click({right - 24.0f, middle + 8.0f})), last);
    const int half = shown(opened_race().click({0.5f * (left + right) + 80.0f, middle + 8.0f}));
    EXPECT_GT(half, 0);
    EXPECT_LT(half, last);
    const double pace = static_cast<double>(app::race_pace(static_cast<std::size_t>(last)));
    EXPECT_EQ(shown(opened_race().command("race.play").wait(static_cast<int>(60.0 / pace) + 2)), 1);
}

/// An idle window draws nothing, so the end of the race must be drawn before it idles.
TEST(RaceStrip, ShowsItsEndWithoutAMoveOfTheMouse) {
    const std::unique_ptr<app::Window> window = app::open_offscreen({1280, 720});
    app::App app(*window);
    app.run({"chain.preset", Json{{"name", "start"}}});
    app.run({"chain.mode", Json{{"mode", "reach"}}});
    app.run({"chain.target", Json{{"to", {2, 3, 1}}}});
    app.run({"race.open", Json{{"start", "straight"}}});
    app.run({"race.play", Json{{"pace", 30}}});
    FrameRecorder recorder;
    for (int i = 0; i < 4000 && app.needs_ticks(); ++i) app.tick(nullptr);
    ASSERT_FALSE(app.needs_ticks());
    const auto texts = [&] {
        std::vector<std::string> all;
        for (const DrawnText& each : recorder.frame().texts) all.push_back(each.text);
        return all;
    };
    const std::vector<std::string> last = texts();
    app.settle();
    EXPECT_EQ(last, texts());
}

/// In a narrow view numbers are left to the inspector: the legend would cover the chains.
TEST(RaceStrip, LegendHasItsNumbersWhereThereIsRoom) {
    for (const bool narrow : {false, true}) {
        const FrameRecorder recorder;
        const PlayOptions options{.picture = true, .more = {"--size", narrow ? "1024x640" : "1280x720"}};
        play(opened_race(), options);
        int errors = 0;
        for (const DrawnText& text : recorder.frame().texts)
            errors += text.window == nullptr && text.text.starts_with("error ");
        EXPECT_EQ(errors, narrow ? 0 : 4);
    }
}

/// Of 3000 iterations those with round numbers.
TEST(RaceStrip, NumbersARoundShareOfManyIterations) {
    ScriptText script = opened_race();
    script.command("chain.solver", {{"iterations", 3000}, {"tolerance", 1e-7}});
    script.command("chain.target", {{"to", {6.5, 2.598, 0}}});
    const FrameRecorder recorder;
    const Json state = play(script, {.picture = true}).state;
    ASSERT_GT(state["race_shown"]["iterations"].get<int>(), 2000);
    const float top = state["layout"]["strip"]["min"][1].get<float>();
    int numbered = 0;
    for (const DrawnText& text : recorder.frame().texts) {
        if (text.box.min.y < top || !text.text.starts_with("iteration ")) continue;
        EXPECT_EQ(std::stoi(text.text.substr(10)) % 500, 0) << text.text;
        ++numbered;
    }
    EXPECT_GE(numbered, 4);
}

// The race side by side: one pane for each solver, a common camera, and the mouse in each.

ScriptText race() {
    ScriptText script = ScriptText().command("chain.mode", {{"mode", "reach"}});
    script.command("race.open", {{"start", "straight"}});
    script.command("chain.target", {{"to", {3, 3, 1}}});
    script.command("race.side_by_side", {{"on", true}});
    script.command("camera.frame", {{"what", "all"}});
    return script;
}

glm::vec2 corner(const Json& state, std::size_t pane, const char* which) {
    const Json& at = state.at("panes").at(pane).at(which);
    return {at[0].get<float>(), at[1].get<float>()};
}

/// From a point in the first pane to the same point in another.
glm::vec2 across(const Json& state, std::size_t pane) {
    return corner(state, pane, "min") - corner(state, 0, "min");
}

TEST(RacePanes, EachSolverHasOneWithItsName) {
    const Json state = state_after(race());
    ASSERT_EQ(state.at("panes").size(), 4u);
    std::set<std::string> titles;
    for (const Json& pane : state["panes"]) titles.insert(pane.at("title"));
    EXPECT_EQ(titles.size(), 4u);
    EXPECT_TRUE(titles.contains("CCD: finished after 4")) << state["panes"].dump();
    EXPECT_EQ(state_after(race().command("race.solver", {{"name", "ccd"}, {"on", false}})).at("panes").size(),
              3u);
    EXPECT_FALSE(state_after(race().command("race.side_by_side", {{"on", false}})).contains("panes"));
    EXPECT_FALSE(state_after(race().command("race.close")).contains("panes"));
}

TEST(RacePanes, TheTargetIsSharedAndCanBeDraggedInEach) {
    const Json before = state_after(race());
    const glm::vec2 target = handle(before, "target"), by(-40.0f, 25.0f);
    const Json first = state_after(race().drag({target, target + by}));
    for (std::size_t pane = 0; pane < 4; ++pane) {
        const glm::vec2 at = target + across(before, pane);
        const Json after = state_after(race().drag({at, at + 0.3f * by, at + by}));
        EXPECT_LT(glm::distance(handle(after, "target"), target + by), 0.05f) << pane;
        EXPECT_LT(glm::distance(point_of(after["target"]), point_of(first["target"])), 1e-3f) << pane;
    }
}

TEST(RacePanes, ADragStaysInThePaneWhereItBegan) {
    const Json before = state_after(race());
    // Down from the second pane into the fourth, and left into the third.
    const glm::vec2 from = handle(before, "target") + across(before, 1), by(-300.0f, 260.0f);
    const Json after = state_after(race().drag({from, from + 0.5f * by, from + by}));
    EXPECT_LT(glm::distance(handle(after, "target"), handle(before, "target") + by), 0.2f);
}

TEST(RacePanes, ARopeDraggedInOnePaneFollowsInAll) {
    ScriptText script;
    script.command("lab.open", {{"name", "rope"}})
        .command("rope.preset", {{"name", "line"}})
        .command("rope.race")
        .command("camera.frame", {{"what", "all"}})
        .wait(30);
    const Json before = state_after(script);
    ASSERT_EQ(before.at("panes").size(), 3u);
    for (std::size_t pane = 0; pane < 3; ++pane) {
        ScriptText drags = script;
        const glm::vec2 at = handle(before, "line.8") + across(before, pane);
        const Json after = state_after(drags.move(at).down().move(at - glm::vec2(0, 20)).wait(5));
        EXPECT_EQ(after["held"]["rope"], "line") << pane;
        EXPECT_GT(point_of(after["ropes"][0]["particles"][8]["position"]).y,
                  point_of(before["ropes"][0]["particles"][8]["position"]).y + 0.02f)
            << pane;
    }
}

TEST(RacePanes, TheyShareACameraThatEachCanTurnAndZoom) {
    const Json before = state_after(race());
    for (const std::size_t pane : {0u, 3u}) {
        const glm::vec2 free = corner(before, pane, "min") + glm::vec2(30.0f, 200.0f);
        const Json turned = state_after(race().drag({free, free + glm::vec2(60.0f, 0.0f)}));
        EXPECT_NE(turned["camera"]["yaw_deg"], before["camera"]["yaw_deg"]) << pane;
        EXPECT_EQ(turned["target"], before["target"]) << pane;
        // The point under the pointer stays.
        const glm::vec2 target = handle(before, "target") + across(before, pane);
        const Json nearer = state_after(race().move(target).wheel(3.0f));
        EXPECT_LT(nearer["camera"]["distance"], before["camera"]["distance"]) << pane;
        EXPECT_LT(glm::distance(handle(nearer, "target"), handle(before, "target")), 1.0f) << pane;
    }
}

TEST(RacePanes, APictureHasThemAll) {
    const TempFolder folder;
    const std::string path = (folder / "race.png").string();
    state_after(
        race().command("view.picture", {{"path", path}, {"width", 802}, {"height", 602}, {"labels", false}}));
    const app::Image picture = app::read_png(path);
    ASSERT_EQ(picture.size, glm::ivec2(802, 602));
    // The target's ball is at the same position in each quarter.
    const auto orange = [&](glm::ivec2 from, glm::ivec2 to) {
        glm::dvec2 sum(0.0);
        int count = 0;
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x) {
                const auto* p = &picture.rgba[static_cast<std::size_t>(4 * (y * picture.size.x + x))];
                if (p[0] < 190 || p[1] < 110 || p[1] > 190 || p[2] > 60) continue;
                sum += glm::dvec2(x - from.x, y - from.y);
                ++count;
            }
        EXPECT_GT(count, 50);
        return sum / std::max(1.0, static_cast<double>(count));
    };
    const glm::dvec2 first = orange({0, 0}, {400, 300});
    for (const glm::ivec2 corner : {glm::ivec2(402, 0), glm::ivec2(0, 302), glm::ivec2(402, 302)})
        EXPECT_LT(glm::distance(orange(corner, corner + glm::ivec2(400, 300)), first), 1.0);
}

}  // namespace
}  // namespace tendril::test
