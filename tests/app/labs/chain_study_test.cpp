// The microscope and the race.
#include <set>
#include <sstream>

#include "app/labs/chain/draw.hpp"
#include "app/system/atomic_file.hpp"
#include "app/view/camera.hpp"
#include "tests/app/labs/chain_support.hpp"

namespace tendril::app {
namespace {

class ChainStudy : public ChainTest {
  protected:
    const Study& study() const { return part().study; }
    /// Valid until the next command.
    const Trace& trace() const { return *shown_chain(workspace).trace; }
    std::shared_ptr<const Race> race() const { return shown_chain(workspace).race; }
};

TEST_F(ChainStudy, ItsStartIsBroughtIntoView) {
    reach_with(4);
    run("chain.target", {{"to", {0, -3, 0}}});
    for (const char* const command : {"microscope.open", "race.open"}) {
        workspace.camera.target = {0, -3, 0};
        workspace.camera.distance = 3.0f;
        const Rect view{{0.0f, 0.0f}, workspace.ui.view_size};
        run(command, {{"start", "straight"}});
        const Camera camera(workspace.camera, view);
        for (const glm::vec3& joint : study().start) {
            const auto at = camera.project(joint);
            ASSERT_TRUE(at && view.contains(*at)) << command;
        }
        const CameraPose framed = workspace.camera;
        run(command, {{"start", "straight"}});
        EXPECT_EQ(workspace.camera, framed) << "what is in view stays there";
    }
}

TEST_F(ChainStudy, TheMicroscopeShowsAPullWithItsNeighbour) {
    reach_with(4);
    run("chain.solver", {{"name", "fabrik_plain"}});
    run("chain.target", {{"to", {1, 2, 1}}});
    run("microscope.open", {{"start", "straight"}});
    run("microscope.seek", {{"step", 2}});
    const Json shown = state()["microscope"];
    ASSERT_EQ(shown["moves"].size(), 1u);
    const Json& move = shown["moves"][0];
    EXPECT_EQ(move["joint"], 3);
    EXPECT_EQ(move["neighbour"], 4) << "the tip, which step 1 moved";
    EXPECT_NE(move["from"], move["to"]);
    EXPECT_EQ(shown["positions"][3], move["to"]);
}

TEST_F(ChainStudy, TheLastStepOfEverySolverIsTheChainsPose) {
    for (const ik::Method method : ik::all_methods) {
        reach_with(method == ik::Method::TwoBone ? 2 : 6);
        run("chain.solver", {{"name", ik::name(method)}});
        run("chain.pole", {{"to", {0, 2, 3}}});
        run("microscope.open");
        run("chain.target", {{"to", {0.9, 1.1, 0.4}}});
        ASSERT_GT(trace().frames(), 0u) << ik::name(method);
        EXPECT_EQ(trace().pose(trace().frames()), positions(part().chain)) << ik::name(method);
        EXPECT_EQ(trace().residuals.size(), static_cast<std::size_t>(trace().report.iterations) + 1);
        run("microscope.close");
    }
}

TEST_F(ChainStudy, EverySolveBeginsAtTheSameStart) {
    run("chain.mode", {{"mode", "reach"}});
    run("microscope.open", {{"start", "here"}});
    run("chain.target", {{"to", {2, 3, 0}}});
    const Chain first = part().chain;
    run("chain.target", {{"to", {-2, 3, 1}}});
    run("chain.target", {{"to", {2, 3, 0}}});
    EXPECT_EQ(part().chain, first) << "from the same start to the same target is the same way";
    EXPECT_EQ(study().start.back(), glm::vec3(7, 0, 0));
    run("microscope.close");
    EXPECT_EQ(part().chain, first) << "closing leaves the chain as it was solved";
}

TEST_F(ChainStudy, StepsGoForwardsAndBackAndStayInRange) {
    reach_with(4);
    run("chain.solver", {{"name", "fabrik_plain"}, {"tolerance", 1e-6}, {"iterations", 3}});
    run("microscope.open");
    run("chain.target", {{"to", {1, 1.5, 1}}});
    const auto step = [&] { return study().step; };
    EXPECT_EQ(step(), 0u);
    run("study.step");
    run("study.step", {{"by", 2}});
    EXPECT_EQ(step(), 3u);
    run("study.step", {{"iterations", 1}});
    EXPECT_EQ(step(), trace().end_of_iteration(1));
    run("study.step", {{"iterations", 1}});
    EXPECT_EQ(step(), trace().end_of_iteration(2));
    run("study.step", {{"iterations", -1}});
    EXPECT_EQ(step(), trace().end_of_iteration(1));
    run("study.step", {{"by", 1000}});
    EXPECT_EQ(step(), trace().frames());
    run("study.step", {{"by", -100000}});
    EXPECT_EQ(step(), 0u);
    expect_refused("microscope.seek", {{"step", 5000}}, {"5000"});
}

TEST_F(ChainStudy, EveryStepHasItsSentence) {
    for (const ik::Method method : ik::all_methods) {
        reach_with(method == ik::Method::TwoBone ? 2 : 5);
        run("chain.solver", {{"name", ik::name(method)}});
        run("microscope.open", {{"start", "straight"}});
        run("chain.target", {{"to", {0.7, 0, 0}}});
        for (std::size_t i = 0; i <= trace().frames(); ++i)
            EXPECT_LT(describe_frame(trace(), i).size() - 1, 89u) << "one or two lines, not none";
        run("microscope.close");
    }
}

TEST_F(ChainStudy, TheRaceRunsTheChosenSolversFromTheSameStart) {
    run("chain.mode", {{"mode", "reach"}});
    run("chain.target", {{"to", {3, 3, 1}}});
    run("race.open", {{"start", "straight"}});
    run("race.solver", {{"name", "jacobian_transpose"}, {"on", true}});
    run("race.solver", {{"name", "fabrik_plain"}, {"on", false}});
    const Json race = state()["race"];
    std::set<std::string> names;
    for (const Json& racer : race) {
        names.insert(racer["solver"].get<std::string>());
        EXPECT_EQ(racer["positions"].size(), 8u);
        EXPECT_EQ(racer["positions"][0], point({0, 0, 0}));
        EXPECT_FALSE(racer.contains("microseconds")) << "a state is the same every time";
    }
    EXPECT_EQ(names, (std::set<std::string>{"fabrik", "ccd", "jacobian_transpose", "dls"}));
    EXPECT_EQ(race[0]["status"], "Converged");
}

TEST_F(ChainStudy, ARaceRowShowsItsCurvesEndAndTheSolversThatRan) {
    int restored = 0;
    for (const bool limited : {false, true}) {
        reach_with(5);
        run("race.open", {{"start", "straight"}});
        for (const ik::Method method : ik::all_methods)
            run("race.solver", {{"name", ik::name(method)}, {"on", method != ik::Method::TwoBone}});
        if (limited) {
            for (int i = 0; i < 5; ++i)
                run("chain.limit", {{"index", i}, {"kind", "hinge"}, {"min_deg", -20}, {"max_deg", 60}});
        }
        run("chain.solver", {{"iterations", 12}});
        run("chain.target", {{"to", {0.4, 1.1, 0.9}}});
        const std::vector<Racer> racers = race()->racers;
        const Json said = state()["race"];
        run("race.close");
        for (std::size_t i = 0; i < racers.size(); ++i) {
            const Racer& racer = racers[i];
            EXPECT_EQ(said[i]["ends_with"], number(racer.residuals.back()));
            EXPECT_EQ(said[i]["restored"], racer.restored);
            if (racer.restored) {
                ++restored;
                EXPECT_LT(racer.report.residual, racer.residuals.back()) << ik::name(racer.method);
                EXPECT_TRUE(test::says(end_text(racer), "best pose restored"));
            } else {
                EXPECT_NEAR(racer.report.residual, racer.residuals.back(), 1e-6f) << ik::name(racer.method);
            }
            const std::string ran = said[i]["ran"];
            EXPECT_EQ(ran.find("least squares") != ran.npos && ran.find(" + ") != ran.npos,
                      racer.report.least_squares_steps > 0)
                << ran;
            EXPECT_EQ(ran.find("restart") != ran.npos, racer.report.restarts > 0) << ran;
            // The microscope, from the same start, shows the same residuals and the same words.
            run("chain.solver", {{"name", ik::name(racer.method)}});
            run("microscope.open", {{"start", "straight"}});
            EXPECT_EQ(trace().residuals, racer.residuals) << ik::name(racer.method);
            EXPECT_EQ(state()["microscope"]["report"]["ran"], ran);
            EXPECT_EQ(state()["solve"]["report"]["ran"], ran);
            run("microscope.close");
        }
        run("chain.solver", {{"name", "fabrik"}});
    }
    EXPECT_GT(restored, 0) << "the test wants a solve that ends worse than it was";
}

TEST_F(ChainStudy, TheRaceIsWrittenAsCsvAndTheChainAsCodeAndAsAScene) {
    run("race.open", {{"start", "straight"}});
    run("chain.target", {{"to", {3, 3, 1}}});
    run("race.save", {{"path", path("race.csv")}});
    EXPECT_EQ(workspace.ui.toasts.back().text, written_text(path("race.csv")));
    run("race.copy");
    const std::string csv = test::read(path("race.csv"));
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "solver,iteration,tip_to_target_m,root_to_target_m,microseconds,status,ran,restored_m");
    std::size_t rows = 0, expected = 0;
    while (std::getline(lines, line)) rows += line.empty() ? 0 : 1;
    for (const Racer& racer : race()->racers) {
        expected += racer.residuals.size();
        // With the name that the screen shows; one of the names has a comma.
        EXPECT_NE(csv.find("\n\"" + std::string(solver_title(racer.method)) + "\",0,"), csv.npos) << csv;
    }
    EXPECT_EQ(rows, expected);
    EXPECT_EQ(workspace.ui.copied.value(), csv);
    run("chain.copy", {{"as", "cpp"}});
    EXPECT_TRUE(test::has(workspace.ui.copied.value(), "#include <tendril/"));
    run("chain.copy", {{"as", "json"}});
    EXPECT_EQ(parse_json(workspace.ui.copied.value()), save_scene(workspace));
    expect_refused("race.save", {{"path", "/nowhere/at/all.csv"}}, {"/nowhere"});
}

TEST_F(ChainStudy, ChainReportAndTraceAlwaysMatch) {
    const auto expect_one = [&](const char* after) {
        EXPECT_EQ(trace().pose(trace().frames()), positions(part().chain)) << after;
        ASSERT_TRUE(part().result) << after;
        EXPECT_EQ(part().result->report, trace().report) << after;
    };
    const auto then = [&](const char* command, const Json& arguments) {
        run(command, arguments);
        expect_one(command);
    };
    then("microscope.open", {{"start", "straight"}});
    then("chain.target", {{"to", {3, 3, 0}}});
    then("chain.mode", {{"mode", "reach"}, {"iterations", 1}});
    then("chain.solver", {{"name", "ccd"}, {"iterations", 50}});
    then("chain.pull", {{"index", 3}, {"to", {1, 5, 0}}});
    then("chain.set_length", {{"index", 3}, {"length", 0.5}});
    then("chain.limit", {{"index", 2}, {"kind", "hinge"}, {"max_deg", 30}});
    then("chain.limit", {{"index", 2}, {"kind", "free"}});
    for (const glm::quat& rotation : part().reach.state.rotations) EXPECT_EQ(rotation, glm::quat(1, 0, 0, 0));
    run("chain.motion", {{"path", "circle"}});
    wait(5);
    expect_one("motion");
}

TEST_F(ChainStudy, OpeningCanBeUndoneAndHistoryKeepsNoTrace) {
    run("chain.target", {{"to", {3, 4, 0}}});
    const Json before = save_scene(workspace);
    const std::size_t light = part().bytes();
    run("microscope.open", {{"start", "straight"}});
    EXPECT_LT(part().bytes(), light + trace().steps.size() * sizeof(ik::Step));
    run("undo");
    EXPECT_EQ(save_scene(workspace), before);
}

TEST_F(ChainStudy, ChangesWithoutEffectOnTheSolveKeepTheTrace) {
    run("race.open", {{"start", "straight"}});
    const auto before = race();
    run("chain.select", {{"index", 2}});
    run("race.side_by_side", {{"on", true}});
    EXPECT_EQ(race(), before) << "nor are its times measured anew";
}

TEST_F(ChainStudy, ChangesOfTheChainCloseItAndSoDoOtherModes) {
    for (const char* kind : {"microscope.open", "race.open"})
        for (const CommandCall& change :
             {CommandCall{"chain.add", {{"length", 1}}}, CommandCall{"chain.mode", {{"mode", "forward"}}},
              CommandCall{"chain.preset", {{"name", "arm"}}}}) {
            run(kind);
            run(change.name.c_str(), to_json(change.arguments));
            EXPECT_FALSE(study().open()) << kind << " " << change.name;
        }
}

TEST_F(ChainStudy, ChainsThatCannotBeStudiedAreRefused) {
    expect_refused("microscope.close", Json::object(), {"not open"});
    expect_refused("study.step", Json::object(), {"open"});
    expect_refused("race.close", Json::object(), {"no race"});
    expect_refused("race.save", {{"path", "a.csv"}}, {"no race"});
    expect_refused("race.copy", Json::object(), {"no race"});
    run("chain.preset", {{"name", "start"}, {"count", 1000}});
    expect_refused("microscope.open", Json::object(), {"1000"});
    run("chain.clear");
    expect_refused("race.open", Json::object(), {"no bone"});
}

}  // namespace
}  // namespace tendril::app
