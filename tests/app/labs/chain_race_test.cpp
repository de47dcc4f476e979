// The race iteration by iteration: every racer is where its solver is after the same number of iterations.
#include <map>
#include <tendril/ik/solver.hpp>

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/draw.hpp"
#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

using test::says;

class ChainRace : public ChainTest {
  protected:
    std::shared_ptr<const Race> race() const { return shown_chain(workspace).race; }
    std::size_t iteration() const { return shown_chain(workspace).step(); }

    /// A race of every solver that accepts the chain.
    void race_of(int bones) {
        reach_with(bones);
        run("race.open", {{"start", "straight"}});
        for (const ik::Method method : ik::all_methods)
            run("race.solver", {{"name", ik::name(method)}, {"on", takes(method, part().chain)}});
    }
    /// The library's result from the race's start with at most `most` iterations.
    std::vector<glm::vec3> solved(ik::Method method, int most, ik::Report& report) const {
        ik::Solver solver(part().chain);
        ReachSettings settings = part().reach;
        settings.state = part().study.start_state;
        ik::Options options = solver_options(settings, solver.reach());
        options.max_iterations = most;
        ik::State state = state_for(settings, solver.bones());
        std::vector<glm::vec3> joints = part().study.start;
        report = solver.solve(method, joints, state, part().target, options);
        return joints;
    }
    std::vector<glm::vec3> points(const Json& list) const {
        std::vector<glm::vec3> all;
        for (const Json& at : list) all.push_back(glm::vec3(at[0], at[1], at[2]));
        return all;
    }
    void tick(int count) {
        for (int i = 0; i < count; ++i)
            if (lab().working(workspace)) lab().work(workspace);
    }
};

/// The accelerated FABRIK bends a straight chain before its first iteration; the race still shows the start.
TEST_F(ChainRace, AllAreAtTheStartBeforeTheFirstIteration) {
    race_of(6);
    for (const Json& target : {Json{2, 0, 0}, Json{3, 3, 1}, Json{0, 9, 0}, Json{9, 0, 0}}) {
        SCOPED_TRACE(target);
        run("chain.target", {{"to", target}});
        run("race.show", {{"iteration", 0}});
        const std::vector<glm::vec3> start = part().study.start;
        const float from_target = glm::distance(start.back(), part().target);
        for (const Json& racer : state()["race"]) {
            EXPECT_EQ(points(racer["shown"]["positions"]), start) << racer;
            EXPECT_EQ(racer["shown"]["residual"], number(from_target)) << racer;
        }
        // At the end each has the error that its solver reports, also out of reach, without an iteration.
        for (const Racer& racer : race()->racers) {
            const RacerAt end = racer_at(racer, race()->iterations());
            EXPECT_TRUE(end.finished);
            EXPECT_EQ(end.error, racer.report.residual) << ik::name(racer.method);
            EXPECT_TRUE(std::ranges::equal(end.joints, racer.joints)) << ik::name(racer.method);
        }
    }
}

/// A solve that is cut off ends with its best pose, so only iterations that improve on it are compared.
TEST_F(ChainRace, AnIterationEqualsTheLibrarysWithAsManyIterations) {
    int compared = 0;
    for (const int bones : {2, 4, 9}) {
        race_of(bones);
        for (const glm::vec3 target : {glm::vec3(1, 1, 0.5f), glm::vec3(0.4f, -1.2f, 0.9f)}) {
            run("chain.target", {{"to", {target.x, target.y, target.z}}});
            for (std::size_t k = 1; k <= race()->iterations(); ++k) {
                run("race.show", {{"iteration", k}});
                const Json racers = state()["race"];
                for (std::size_t i = 0; i < racers.size(); ++i) {
                    const Racer& racer = race()->racers[i];
                    const Json& shown = racers[i]["shown"];
                    const bool finished = static_cast<int>(k) >= racer.iterations();
                    EXPECT_EQ(shown["finished"], finished);
                    EXPECT_EQ(shown["iteration"], std::min(static_cast<int>(k), racer.iterations()));
                    ik::Report report;
                    const auto expected =
                        solved(racer.method,
                               finished ? part().reach.options.max_iterations : static_cast<int>(k), report);
                    if (!finished && report.residual != racer.residuals[k]) continue;
                    EXPECT_EQ(shown["residual"], number(report.residual)) << ik::name(racer.method);
                    const auto seen = points(shown["positions"]);
                    ASSERT_EQ(seen.size(), expected.size());
                    for (std::size_t j = 0; j < seen.size(); ++j)
                        EXPECT_LT(glm::distance(seen[j], expected[j]), 1e-5f)
                            << ik::name(racer.method) << " iteration " << k << " joint " << j;
                    compared += finished ? 0 : 1;
                }
            }
        }
        run("race.close");
    }
    EXPECT_GT(compared, 60) << "iterations on the way, not only ends";
}

TEST_F(ChainRace, OfAChainThatHasArrivedStartsStraight) {
    reach_with(6);
    for (int i = 0; i < 3; ++i) run("chain.target", {{"to", {3, 3, 1}}});
    run("race.open");
    EXPECT_GT(race()->iterations(), 0u);
    run("race.close");
    run("race.open", {{"start", "here"}});
    EXPECT_EQ(race()->iterations(), 0u) << "on request";
}

TEST_F(ChainRace, OpensAtItsEndAndStaysThereAsTheTargetMoves) {
    race_of(6);
    run("chain.target", {{"to", {3, 3, 1}}});
    EXPECT_EQ(iteration(), race()->iterations());
    run("race.show", {{"iteration", 1}});
    EXPECT_EQ(iteration(), 1u);
    run("chain.target", {{"to", {2, 3, 1}}});
    EXPECT_EQ(iteration(), 1u);
    run("race.show", {{"iteration", race()->iterations()}});
    const std::size_t before = race()->iterations();
    run("chain.target", {{"to", {0.2, 0.1, 0.3}}});
    EXPECT_NE(race()->iterations(), before) << "the test wants a race of another length";
    EXPECT_EQ(iteration(), race()->iterations()) << "the end stays the end";
}

TEST_F(ChainRace, StepsAndScrubsWithinItsIterations) {
    race_of(6);
    run("chain.target", {{"to", {3, 3, 1}}});
    const std::size_t last = race()->iterations();
    run("study.step", {{"by", -1}});
    EXPECT_EQ(iteration(), last - 1);
    run("study.step");
    run("study.step", {{"iterations", 5}});
    EXPECT_EQ(iteration(), last);
    run("study.step", {{"by", -100000}});
    EXPECT_EQ(iteration(), 0u);
    refuses("race.show", {{"iteration", last + 1}},
            "iteration 0 " + std::to_string(last) + " " + std::to_string(last + 1));
    run("race.close");
    refuses("race.show", {{"iteration", 0}}, "no race is open");
    refuses("race.play", Json::object(), "no race is open");
    refuses("study.step", Json::object(), "microscope race open");
    run("microscope.open");
    refuses("race.show", {{"iteration", 0}}, "no race is open");
    run("study.step");
    EXPECT_EQ(state()["microscope"]["step"], 1);
}

TEST_F(ChainRace, OpenedFromAnotherLabItKeepsThatLabsCamera) {
    reach_with(6);
    for (const char* open : {"microscope.open", "race.open"}) {
        workspace.lab = "rope";
        workspace.camera = {.target = {50.0f, 0.0f, 0.0f}};
        workspace.cameras[chain_lab] = {.target = {100.0f, 0.0f, 0.0f}};
        run(open, {{"start", "straight"}});
        EXPECT_EQ(workspace.camera.target.x, 50.0f) << open;
        EXPECT_LT(workspace.cameras[chain_lab].target.x, 20.0f) << open << ": the chain is in view";
    }
}

TEST_F(ChainRace, PlaysToItsEndAtALegiblePace) {
    race_of(6);
    run("chain.target", {{"to", {3, 3, 1}}});
    const std::size_t last = race()->iterations();
    ASSERT_LT(last, 32u);
    run("race.play");
    EXPECT_EQ(iteration(), 0u) << "from the start, as it was at the end";
    tick(static_cast<int>(std::ceil(120.0 / static_cast<double>(race_pace(last)))) + 1);
    EXPECT_EQ(iteration(), 2u) << "at its pace";
    run("race.play", {{"on", false}});
    tick(60);
    EXPECT_EQ(iteration(), 2u);
    run("race.play", {{"pace", 60}});
    tick(static_cast<int>(last));
    EXPECT_EQ(iteration(), last);
    EXPECT_FALSE(lab().working(workspace)) << "and stops";
    EXPECT_FLOAT_EQ(race_pace(3), 1.0f) << "3 s for the whole";
    EXPECT_FLOAT_EQ(race_pace(20), 4.0f);
    EXPECT_FLOAT_EQ(race_pace(1100), 100.0f) << "11 s for the whole";
    refuses("race.play", {{"on", false}, {"pace", 3}}, "pace on false");
}

TEST_F(ChainRace, StartsFromAPoseThatWasBentByHand) {
    run("chain.preset", {{"name", "straight"}});
    run("chain.pull", {{"index", 2}, {"to", {2, 0.7, 0}}});
    const std::vector<glm::vec3> bent = positions(part().chain);
    EXPECT_GT(bent[2].y, 0.3f);
    for (const char* study : {"race.open", "microscope.open"}) {
        run(study);
        EXPECT_EQ(part().study.start, bent) << study;
        run("undo");
    }
}

TEST_F(ChainRace, ItsFilmIsNotNamedLikeItsPicture) {
    race_of(6);
    workspace.names_pictures = true;
    run("race.record");
    ASSERT_TRUE(workspace.ui.video);
    // The numbers depend on what else is in the folder.
    EXPECT_TRUE(workspace.ui.video->path.filename().string().starts_with("tendril-race-"));
    run("view.picture");
    const std::string picture = workspace.ui.picture->path.filename().string();
    EXPECT_TRUE(picture.starts_with("tendril-")) << picture;
    EXPECT_FALSE(test::has(picture, "race"));
    EXPECT_TRUE(says(test::PanelReader().inspector(lab(), workspace), "Record the race Save a picture"));
}

/// As written by versions whose races could not be scrubbed.
TEST_F(ChainRace, FromAnOlderFileIsShownAtItsEnd) {
    race_of(6);
    run("chain.target", {{"to", {3, 3, 1}}});
    run("race.show", {{"iteration", 2}});
    Workspace other = make_blank_workspace(labs);
    Json old = save_scene(workspace);
    old["labs"]["chain"]["study"].erase("iteration");
    load_scene(other, old);
    EXPECT_EQ(lab().state(other)["race_shown"]["iteration"], race()->iterations());
}

TEST_F(ChainRace, TheLegendHasEachRacersIterationAndError) {
    race_of(6);
    run("chain.target", {{"to", {3, 3, 1}}});
    run("race.show", {{"iteration", 2}});
    const auto rows = lab().legend(workspace);
    for (const Racer& racer : race()->racers) {
        const auto row = std::ranges::find(rows, solver_title(racer.method), &LegendRow::name);
        ASSERT_NE(row, rows.end()) << ik::name(racer.method);
        ASSERT_EQ(row->numbers.size(), 2u);
        const bool finished = racer.iterations() <= 2;
        EXPECT_TRUE(says(row->numbers[0], finished ? "finished after" : "iteration 2"));
        EXPECT_TRUE(says(row->numbers[1], "error"));
    }
    run("race.side_by_side", {{"on", true}});
    const auto titles = lab().panes(workspace);
    ASSERT_EQ(titles.size(), race()->racers.size());
    for (const PaneTitle& title : titles) EXPECT_TRUE(says(title.detail, "from the target"));
}

TEST_F(ChainRace, TheLegendSaysWhoStoppedShortAndKeepsItsWidths) {
    race_of(6);
    test::PanelReader reader;
    const auto lines_above_the_plot = [&] {
        const std::string text = reader.inspector(lab(), workspace);
        return std::ranges::count(text.substr(0, text.find("Against")), '\n');
    };
    run("chain.target", {{"to", {3, 3, 1}}});
    const auto lines = lines_above_the_plot();
    run("chain.target", {{"to", {30, 3, 1}}});  // out of reach
    EXPECT_EQ(lines_above_the_plot(), lines);
    const auto rows = lab().legend(workspace);
    ASSERT_NE(race()->racers[0].report.status, ik::Status::Converged);
    for (std::size_t i = 0; i < race()->racers.size(); ++i) {
        const ik::Status status = race()->racers[i].report.status;
        if (status == ik::Status::Converged) continue;
        EXPECT_TRUE(says(rows[i].numbers[0], std::string("stopped after ") + outcome_name(status)));
    }
    for (std::size_t step = 0; step <= race()->iterations(); ++step) {
        run("race.show", {{"iteration", step}});
        const auto now = lab().legend(workspace);
        for (std::size_t i = 0; i < race()->racers.size(); ++i) {
            EXPECT_EQ(now[i].widest, rows[i].widest);
            EXPECT_LE(now[i].numbers[0].size(), now[i].widest.at(0).size());
            EXPECT_LE(now[i].numbers[1].size(), now[i].widest.at(1).size());
        }
    }
}

TEST(KeptPosesTest, StayWithinTheirMemory) {
    constexpr std::size_t joints = 8, most = 800;
    KeptPoses poses(most);
    std::vector<glm::vec3> pose(joints);
    for (int i = 0; i < 5000; ++i) {
        pose.assign(joints, glm::vec3(static_cast<float>(i)));
        poses.add(pose);
        ASSERT_LE(poses.bytes(), 4 * most * sizeof(glm::vec3));
        for (const int k : {0, i / 3, i}) {
            const int kept = poses.kept(k);
            ASSERT_LE(kept, k);
            ASSERT_LE(k - kept, std::max(0, i / 40)) << "evenly: at least 40 of them";
            ASSERT_EQ(poses.at(k).front().x, static_cast<float>(kept));
            ASSERT_EQ(poses.at(k).size(), joints);
        }
    }
    for (int i = 0; i < 100; ++i) {
        KeptPoses all(most);
        for (int k = 0; k <= i; ++k) all.add(pose);
        ASSERT_EQ(all.kept(i), i) << "nothing is dropped before it is full";
    }
}

// Chains of a race that would overlap are drawn apart.

class RaceDrawingTest : public ChainRace {
  protected:
    const Camera camera_{CameraPose{.yaw = 0.4f, .pitch = 0.3f, .distance = 12.0f}, {{0, 0}, {800, 600}}};
    const Palette& colours_ = palette(Theme::Dark);

    DrawList drawing(const Camera& camera, std::size_t pane = 0) const {
        DrawList list;
        lab().draw({workspace, camera, colours_, no_pick, no_pick, 1.0f, pane}, list);
        return list;
    }
    /// The lines in a solver's colour, in order: one for each of its bones.
    std::map<ik::Method, std::vector<Stroke>> bones(std::size_t pane = 0) const {
        std::map<ik::Method, std::vector<Stroke>> found;
        for (const Stroke& stroke : drawing(camera_, pane).strokes)
            for (const Racer& racer : race()->racers)
                if (stroke.a != stroke.b && stroke.shadow &&
                    glm::vec3(stroke.colour) == solver_colour(colours_, racer.method))
                    found[racer.method].push_back(stroke);
        return found;
    }
    glm::vec2 seen(glm::vec3 at) const { return *camera_.project(at); }
    /// Lateral distance between a bone and its drawn line, at its middle, pixels.
    float aside(const Stroke& drawn, glm::vec3 from, glm::vec3 to) const {
        const glm::vec2 along = glm::normalize(seen(to) - seen(from));
        const glm::vec2 off = seen(0.5f * (drawn.a + drawn.b)) - seen(0.5f * (from + to));
        return glm::abs(along.x * off.y - along.y * off.x);
    }
};

TEST_F(RaceDrawingTest, EqualChainsRunAlongLikeStrands) {
    reach_with(6);
    // Already on the target: every solver keeps its starting pose.
    run("chain.target", {{"to", Json::array({6, 0, 0})}});
    run("race.open", {{"start", "here"}});
    for (const ik::Method method : ik::all_methods)
        if (method != ik::Method::TwoBone) run("race.solver", {{"name", ik::name(method)}, {"on", true}});
    const auto drawn = bones();
    ASSERT_EQ(drawn.size(), race()->racers.size());
    ASSERT_GE(drawn.size(), 4u);
    for (std::size_t bone = 0; bone < 6; ++bone) {
        std::vector<glm::vec2> middles;
        for (const auto& [method, lines] : drawn) {
            ASSERT_EQ(lines.size(), 6u) << ik::name(method);
            middles.push_back(seen(0.5f * (lines[bone].a + lines[bone].b)));
        }
        for (std::size_t i = 0; i < middles.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GT(glm::distance(middles[i], middles[j]), 3.0f) << bone;
    }
}

/// Solvers that share a tip share a label: all of them do before the first iteration.
TEST_F(RaceDrawingTest, EveryTipHasTheNameOfItsSolver) {
    reach_with(6);
    run("race.open", {{"start", "straight"}});
    run("chain.target", {{"to", Json::array({3, 3, 1})}});
    for (const std::size_t iteration : {0u, 2u}) {
        run("race.show", {{"iteration", iteration}});
        const DrawList list = drawing(camera_);
        std::size_t most = 0;
        for (const Racer& racer : race()->racers) {
            const std::string name = solver_title(racer.method);
            const glm::vec3 tip = racer_at(racer, iteration).joints.back();
            std::size_t named = 0;
            for (const Label& each : list.labels) {
                if (('\n' + each.text + '\n').find('\n' + name + '\n') == std::string::npos) continue;
                ++named;
                most = std::max(most, static_cast<std::size_t>(std::ranges::count(each.text, '\n')) + 1);
                EXPECT_LT(glm::distance(seen(each.at), seen(tip)), 4.0f) << name;
            }
            EXPECT_EQ(named, 1u) << name << " at iteration " << iteration;
        }
        if (iteration == 0) {
            EXPECT_EQ(most, race()->racers.size()) << "one label has all names";
        }
    }
}

TEST_F(RaceDrawingTest, StrandsMeetAtTheCorners) {
    reach_with(6);
    run("chain.target", {{"to", Json::array({2.5, 2.5, 0.5})}});  // already there: all keep the pose
    run("race.open", {{"start", "here"}});
    const auto drawn = bones();
    for (const Racer& racer : race()->racers) {
        const auto& lines = drawn.at(racer.method);
        ASSERT_EQ(lines.size(), 6u);
        for (std::size_t bone = 0; bone < 6; ++bone) {
            const glm::vec2 end = seen(lines[bone].b),
                            next = seen(lines[std::min<std::size_t>(bone + 1, 5)].a);
            EXPECT_TRUE(bone == 5 || glm::distance(end, next) < 0.6f)
                << ik::name(racer.method) << " bone " << bone;
            EXPECT_LT(aside(lines[bone], racer.joints[bone], racer.joints[bone + 1]), 9.5f);
        }
    }
    ASSERT_GE(drawn.size(), 4u);
    // Some of them are actually apart.
    const auto middle = [&](ik::Method method) {
        const Stroke& line = drawn.at(method)[3];
        return seen(0.5f * (line.a + line.b));
    };
    EXPECT_GT(glm::distance(middle(race()->racers[0].method), middle(race()->racers[1].method)), 3.0f);
}

TEST_F(RaceDrawingTest, ChainsThatAreApartAreDrawnInPlace) {
    reach_with(6);
    run("race.open", {{"start", "straight"}});
    run("chain.target", {{"to", {2, 2.5, 1}}});
    const auto drawn = bones();
    int apart = 0;
    for (const Racer& racer : race()->racers) {
        const auto& lines = drawn.at(racer.method);
        ASSERT_EQ(lines.size(), 6u);
        for (std::size_t bone = 1; bone <= 6; ++bone) {
            float nearest_pixels = 1e9f;
            for (const Racer& other : race()->racers) {
                if (other.method == racer.method) continue;
                nearest_pixels = std::min(
                    nearest_pixels,
                    std::max(glm::distance(seen(other.joints[bone]), seen(racer.joints[bone])),
                             glm::distance(seen(other.joints[bone - 1]), seen(racer.joints[bone - 1]))));
            }
            const float off = aside(lines[bone - 1], racer.joints[bone - 1], racer.joints[bone]);
            if (nearest_pixels > 3.1f) {
                EXPECT_LT(off, 0.05f) << ik::name(racer.method) << " bone " << bone;
                ++apart;
            }
            EXPECT_LT(off, 12.0f) << ik::name(racer.method) << " bone " << bone;
        }
    }
    EXPECT_GT(apart, 8);
}

TEST_F(RaceDrawingTest, SideBySideEachPaneHasOneChainInPlace) {
    reach_with(4);
    run("chain.target", {{"to", {4, 0, 0}}});
    run("race.open", {{"start", "here"}});
    run("race.side_by_side", {{"on", true}});
    ASSERT_EQ(lab().panes(workspace).size(), race()->racers.size());
    for (std::size_t pane = 0; pane < race()->racers.size(); ++pane) {
        const auto drawn = bones(pane);
        ASSERT_EQ(drawn.size(), 1u);
        const Racer& racer = race()->racers[pane];
        ASSERT_EQ(drawn.begin()->first, racer.method);
        for (std::size_t bone = 1; bone <= 4; ++bone) {
            EXPECT_EQ(drawn.begin()->second[bone - 1].a, racer.joints[bone - 1]);
            EXPECT_EQ(drawn.begin()->second[bone - 1].b, racer.joints[bone]);
        }
    }
}

TEST_F(RaceDrawingTest, ChainsSeenEndOnAreStillDrawn) {
    reach_with(3);
    run("chain.target", {{"to", {3, 0, 0}}});
    run("race.open", {{"start", "here"}});
    const Camera along({.yaw = glm::radians(90.0f), .pitch = 0.0f, .distance = 12.0f}, {{0, 0}, {800, 600}});
    for (const Stroke& stroke : drawing(along).strokes)
        for (const glm::vec3 end : {stroke.a, stroke.b}) EXPECT_TRUE(std::isfinite(end.x + end.y + end.z));
}

}  // namespace
}  // namespace tendril::app
