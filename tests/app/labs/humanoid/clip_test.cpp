// Clips: the pose at a moment, and how they loop.
#include <fstream>
#include <glm/trigonometric.hpp>
#include <map>

#include "app/labs/card.hpp"
#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "humanoid_support.hpp"
#include "tests/app/labs/humanoid/humanoid_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

using HumanoidClips = HumanoidTest;

constexpr double walk_seconds = 1.1, walk_metres = 1.1;

TEST_F(HumanoidClips, LintMarksAreExplainedInTheLegend) {
    const auto explained = [&] {
        const std::vector<LegendRow> rows = lab().legend(workspace);
        return std::ranges::find(rows, "lint finding", &LegendRow::name) != rows.end();
    };
    run("humanoid.load", {{"path", test::source_path("tests/app/golden/faulty_walk.bvh")}});
    run("humanoid.clip", {{"name", ""}});
    EXPECT_FALSE(explained()) << "no clip, no marks";
    run("humanoid.clip", {{"index", 0}});
    EXPECT_TRUE(explained());
}

TEST_F(HumanoidClips, CardsDoNotDependOnTheFiguresClips) {
    const Cards cards(labs);
    for (const Card& card : cards.of("humanoid"))
        for (const CardStep& step : card.steps)
            for (const humanoid::Clip& clip : part().loaded->clips())
                EXPECT_EQ(step.text.find(clip.name), std::string::npos) << step.text;
}

TEST_F(HumanoidClips, ShowAMomentWithoutATick) {
    run("humanoid.clip", {{"name", "walk"}, {"time", 0.5}});
    const Json clip = state().at("clip");
    EXPECT_EQ(clip.at("name"), "walk");
    EXPECT_EQ(clip.at("time"), 0.5);
    EXPECT_EQ(clip.at("duration"), walk_seconds);
    EXPECT_NEAR(bone("Hips").z, 0.5, 1e-9);
    EXPECT_FALSE(lab().moving(workspace));
    run("humanoid.clip", {{"name", ""}});
    EXPECT_TRUE(state().at("clip").is_null());
    EXPECT_EQ(bone("Hips"), glm::dvec3(0, 1, 0));
}

TEST_F(HumanoidClips, PlayByTicks) {
    run("humanoid.clip", {{"index", 0}, {"play", true}, {"speed", 0.5}});
    EXPECT_TRUE(lab().moving(workspace));
    tick(60);
    EXPECT_NEAR(state().at("clip").at("time").get<double>(), 0.5, 1e-9);
    workspace.clock.speed = 0.5f;
    tick(60);
    EXPECT_NEAR(state().at("clip").at("time").get<double>(), 0.75, 1e-9);
    run("humanoid.clip", {{"play", false}});
    EXPECT_FALSE(lab().moving(workspace));
    EXPECT_NEAR(state().at("clip").at("time").get<double>(), 0.75, 1e-9) << "it stays where it is";
}

TEST_F(HumanoidClips, LoopsContinueForwards) {
    run("humanoid.clip", {{"name", "walk"}, {"play", true}, {"loop", true}});
    double last = bone("Hips").z;
    for (int i = 0; i < 300; ++i) {
        tick();
        const double now = bone("Hips").z;
        EXPECT_NEAR(now - last, 1.0 / 60.0, 1e-6) << i;  // the walk advances at 1 m/s throughout
        last = now;
    }
    EXPECT_NEAR(last, 5.0, 1e-6);
    EXPECT_EQ(state().at("clip").at("rounds"), 4);
    EXPECT_LE(state().at("clip").at("time").get<double>(), walk_seconds);
}

TEST_F(HumanoidClips, FeetStepWhereTheyDidBeforeALoop) {
    run("humanoid.clip", {{"name", "walk"}, {"time", walk_seconds}});
    const glm::dvec3 ends = bone("LeftFoot");
    EXPECT_EQ(state().at("clip").at("time"), walk_seconds) << "the last moment is the first round's";
    run("humanoid.clip", {{"time", walk_seconds + 1e-9}});
    EXPECT_EQ(state().at("clip").at("rounds"), 1);
    EXPECT_LT(glm::distance(bone("LeftFoot"), ends), 1e-6);
    run("humanoid.clip", {{"time", 100.5 * walk_seconds}});
    EXPECT_NEAR(bone("Hips").z, 100.5 * walk_metres, 1e-6);
}

TEST_F(HumanoidClips, InPlaceStayWhereTheyBegin) {
    run("humanoid.clip", {{"name", "walk"}, {"play", true}, {"in_place", true}});
    const glm::dvec3 begin = bone("Hips");
    double lowest = begin.y, highest = begin.y;
    for (int i = 0; i < 150; ++i) {
        tick();
        EXPECT_NEAR(bone("Hips").x, begin.x, 1e-12);
        EXPECT_NEAR(bone("Hips").z, begin.z, 1e-12);
        lowest = std::min(lowest, bone("Hips").y), highest = std::max(highest, bone("Hips").y);
    }
    EXPECT_GT(highest - lowest, 0.01) << "up and down it goes as it was";
}

TEST_F(HumanoidClips, WithoutLoopStopAtTheirEnd) {
    run("humanoid.clip", {{"name", "punch"}, {"play", true}, {"loop", false}});
    tick(200);
    EXPECT_EQ(state().at("clip").at("time"), state().at("clip").at("duration"));
    EXPECT_FALSE(lab().moving(workspace));
    run("humanoid.clip", {{"play", true}});
    EXPECT_EQ(state().at("clip").at("time"), 0.0) << "played again, it begins anew";
    run("humanoid.clip", {{"time", 99.0}});
    EXPECT_EQ(state().at("clip").at("time"), state().at("clip").at("duration"));
}

TEST_F(HumanoidClips, PlayAndPauseAreNoUndoSteps) {
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    tick(10);
    const std::size_t steps = workspace.history.size();
    for (const bool on : {false, true, false}) {
        run("humanoid.play", {{"on", on}});
        EXPECT_EQ(part().playback.playing, on);
        EXPECT_EQ(lab().moving(workspace), on);
    }
    EXPECT_EQ(workspace.history.size(), steps);
    run("humanoid.clip", {{"name", ""}});
    expect_refused("humanoid.play", {{"on", true}}, {"clip"});
}

TEST_F(HumanoidClips, WalksInPlaceCanTravel) {
    run("humanoid.load", {{"path", treadmill_figure(folder_.path())}});
    run("humanoid.clip", {{"index", 0}, {"play", true}});
    EXPECT_TRUE(
        test::says(test::PanelReader().panel(lab(), workspace), "recorded in place Travel at 1.0 m/s"));
    run("humanoid.clip", {{"travel", true}});
    EXPECT_NEAR(part().playback.pace.z, 1.0, 0.05) << "the speed of the standing foot";
    // It continues from round to round without a jump, and up the stairs.
    run("humanoid.ground", {{"kind", "stairs"}, {"step_height", 0.15}, {"step_depth", 0.3}});
    const glm::dvec3 begin = bone("Hips");
    glm::dvec3 last = begin;
    for (int i = 0; i < 240; ++i) {
        tick();
        EXPECT_LT(glm::distance(bone("Hips"), last), 0.06) << i;
        last = bone("Hips");
    }
    EXPECT_NEAR(last.z - begin.z, 4.0 * part().playback.pace.z, 0.1);
    EXPECT_GT(last.y - begin.y, 1.2);
    // Lint and export use the travelling clip too, and its feet stand.
    run("humanoid.ground", {{"kind", "flat"}});
    run("humanoid.view", {{"judged", "result"}});
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const humanoid::LintReport* const result = runtime.lint.judge(part(), runtime.solvers);
    ASSERT_NE(result, nullptr);
    EXPECT_EQ(result->treadmill, glm::dvec3(0.0)) << "the ground stands still";
    EXPECT_TRUE(result->findings.empty()) << result->findings[0].text;
    run("humanoid.export", {{"path", path("out.glb")}});
    run("humanoid.load", {{"path", path("out.glb")}});
    run("humanoid.clip", {{"index", 0}, {"time", walk_seconds}});
    EXPECT_NEAR(bone("Hips").z, walk_metres, 0.06);
    // A clip that already travels is not accelerated.
    run("humanoid.load");
    run("humanoid.clip", {{"name", "walk"}, {"travel", true}, {"time", walk_seconds}});
    EXPECT_EQ(part().playback.pace, glm::dvec3(0.0));
    EXPECT_NEAR(bone("Hips").z, walk_metres, 1e-6);
}

TEST_F(HumanoidClips, TargetsTravelWithinARound) {
    for (const bool travels : {true, false}) {
        run("humanoid.load");
        run("humanoid.clip", {{"name", "walk"}, {"play", true}, {"targets_travel", travels}});
        const glm::dvec3 hand(0.35, 1.3, 0.4);
        run("humanoid.target", {{"effector", "left_hand"}, {"to", {hand.x, hand.y, hand.z}}});
        const auto target = [&] { return part().ik.target(humanoid::Effector::LeftHand)->position; };
        for (int i = 1; i <= 150; ++i) {
            tick();
            const double gone = travels ? i / 60.0 : 0.0;  // the walk advances at 1 m/s
            EXPECT_LT(glm::distance(target(), hand + glm::dvec3(0.0, 0.0, gone)), 1e-6) << i;
            if (!travels) continue;
            EXPECT_LT(glm::distance(bone("LeftHand"), target()), 0.03) << i;
        }
    }
    // At another time they are near the figure there, and an export has them there from its start.
    run("humanoid.clip", {{"time", 0.0}, {"targets_travel", true}});
    const glm::dvec3 start = part().ik.target(humanoid::Effector::LeftHand)->position;
    run("humanoid.clip", {{"time", 0.5 * walk_seconds}});
    EXPECT_NEAR(part().ik.target(humanoid::Effector::LeftHand)->position.z, start.z + 0.5 * walk_metres,
                1e-9);
    run("humanoid.clip", {{"time", 0.0}});
    EXPECT_LT(glm::distance(part().ik.target(humanoid::Effector::LeftHand)->position, start), 1e-9);
}

TEST_F(HumanoidClips, TurningClipsContinueInTheirDirection) {
    // Half a metre ahead and a quarter turn to the left: after four rounds it is back.
    std::string text = bvh_figure();
    const std::size_t last = text.rfind("0 0 50 0 0 0");
    text.replace(last, 12, "0 0 50 0 0 90");
    run("humanoid.load", {{"path", write("turn.bvh", text)}});
    run("humanoid.clip", {{"index", 0}});
    const glm::dvec3 begin = bone("Hips");
    run("humanoid.clip", {{"time", 0.5}});
    EXPECT_LT(glm::distance(bone("Hips"), begin + glm::dvec3(0, 0, 0.5)), 1e-9);
    run("humanoid.clip", {{"time", 1.0}});
    EXPECT_LT(glm::distance(bone("Hips"), begin + glm::dvec3(0.5, 0, 0.5)), 1e-9);
    run("humanoid.clip", {{"time", 2.0}});
    EXPECT_LT(glm::distance(bone("Hips"), begin), 1e-9);
}

TEST_F(HumanoidClips, RefuseNamesThatDoNotExist) {
    expect_refused("humanoid.clip", {{"name", "run"}}, {"no clip \"run\""});
    expect_refused("humanoid.clip", {{"index", 2}}, {"index must be 0 to 1, got 2"});
    expect_refused("humanoid.clip", {{"name", "walk"}, {"index", 0}}, {"either"});
    expect_refused("humanoid.clip", {{"play", true}}, {"no clip is chosen"});
    expect_refused("humanoid.clip", {{"time", 0.1}}, {"no clip is chosen"});
    run("humanoid.clip", {{"play", false}});
}

TEST_F(HumanoidClips, TheCameraFollowsThem) {
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    const glm::vec3 before = workspace.camera.target;
    tick(60);
    EXPECT_NEAR(workspace.camera.target.z, before.z + 1.0f, 1e-3f);
    EXPECT_EQ(workspace.camera.target.y, before.y);
    run("humanoid.view", {{"follow", false}});
    tick(60);
    EXPECT_NEAR(workspace.camera.target.z, before.z + 1.0f, 1e-3f);
    EXPECT_FALSE(part().view.follow);
}

/// Captured figures rest at the origin and begin elsewhere.
TEST_F(HumanoidClips, AreFramedWhereTheyBegin) {
    std::string text = bvh_figure();
    text.replace(text.find("\n0 0 0 "), 7, "\n400 0 0 ");
    run("humanoid.load", {{"path", write("aside.bvh", text)}});
    EXPECT_NEAR(workspace.camera.target.x, 4.0f, 0.5f);
    run("humanoid.load");
    const float before = workspace.camera.target.x;
    run("humanoid.motion.load", {{"path", path("aside.bvh")}});
    EXPECT_NEAR(workspace.camera.target.x - before, bone("Hips").x, 0.01) << "the view goes along";
}

/// *Home*: the head with its skin, and the way that a clip goes if the camera does not follow.
TEST_F(HumanoidClips, HomeFramesHeadsAndWalkers) {
    const auto frames = [&](const glm::dvec3& point) {
        const Bounds all = lab().bounds(workspace, false);
        return glm::distance(glm::dvec3(all.centre), point) < static_cast<double>(all.radius) + 1e-3;
    };
    run("humanoid.clip", {{"name", "walk"}, {"time", 1.1}});
    const glm::dvec3 top = bone("Head") + glm::dvec3(0.0, 0.15, 0.0);
    run("humanoid.clip", {{"time", 0.0}});
    EXPECT_FALSE(frames(top));
    run("humanoid.view", {{"follow", false}});
    EXPECT_TRUE(frames(top));
    const auto robot = test::characters_folder() / "robot.glb";
    if (!std::filesystem::exists(robot)) return;
    run("humanoid.load", {{"path", robot.string()}});
    EXPECT_TRUE(frames(part().loaded->bounds.low) && frames(part().loaded->bounds.high));
    // Its root and pole targets stay where the walk began.
    run("humanoid.view", {{"follow", true}});
    const float standing = lab().bounds(workspace, false).radius;
    run("humanoid.motion.load", {{"path", test::source_path("tests/app/golden/faulty_walk.bvh")}});
    run("humanoid.clip", {{"time", 30.0}});
    EXPECT_LT(lab().bounds(workspace, false).radius, 1.2f * standing);
}

// A joint's rotation and an effector's distance to its target at each remembered moment, compared with the
// lab's display after seeking there.

using humanoid::Bone;

class HumanoidPast : public HumanoidTest {
  protected:
    /// Walks and reaches for `count` remembered ticks.
    void walk(int count) {
        run("humanoid.clip", {{"name", "walk"}, {"play", true}});
        run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.6, 1.5, 0.9}}});
        run("humanoid.target", {{"effector", "head"}, {"to", {0.1, 1.5, 0.6}}});
        for (int i = 0; i < count; ++i) {
            remember();
            tick();
        }
    }
    void plot(const std::string& what, const std::string& node) {
        run("view.humanoid_plot", {{"of", what}});
        run("humanoid.select", {{"node", node}});
    }
    std::map<std::uint64_t, double> values() const {
        std::map<std::uint64_t, double> by_tick;
        for (const PastValue& each :
             past_values(workspace, humanoid_past(), *humanoid_past().curve(workspace)))
            by_tick[each.tick] = static_cast<double>(each.value);
        return by_tick;
    }
    /// The value after seeking to a tick in a copy of the workspace, which makes its own solvers.
    template <class Read>
    double back_at(std::uint64_t tick, const Read& read) const {
        Workspace there = workspace;
        there.go_to_moment(there.moment - tick);  // remember the present first
        return read(humanoid_part(there), humanoid_runtime(there).solvers, shown_pose(there));
    }
};

TEST_F(HumanoidPast, AnglesEqualTheInspectorsThere) {
    walk(40);
    plot("twist", "LeftUpperArm");
    const auto twists = values();
    plot("swing", "LeftLowerLeg");
    const auto bends = values();
    ASSERT_EQ(twists.size(), 41u);
    ASSERT_EQ(bends.size(), 41u);
    for (std::uint64_t tick = 0; tick < 40; tick += 3) {
        const auto angles = [](Bone bone) {
            return [bone](const HumanoidPart& part, Solvers& solvers, const ShownPose& shown) {
                const ik::JointAngles now = joint_now(part, solvers, shown, bone)->angles;
                return static_cast<double>(glm::degrees(bone == Bone::LeftUpperArm ? now.twist : now.up));
            };
        };
        EXPECT_NEAR(twists.at(tick), back_at(tick, angles(Bone::LeftUpperArm)), 0.01) << tick;
        EXPECT_NEAR(bends.at(tick), std::abs(back_at(tick, angles(Bone::LeftLowerLeg))), 1.5) << tick;
    }
}

TEST_F(HumanoidPast, ErrorsAreTheSelectedEffectorsOrTheFarthest) {
    using humanoid::Effector;
    walk(30);
    const auto residual = [](Effector effector) {
        return [effector](const HumanoidPart&, Solvers&, const ShownPose& shown) {
            return shown.residual(effector).value_or(-1.0);
        };
    };
    plot("error", "LeftHand");
    EXPECT_EQ(humanoid_past().curve(workspace)->name, "left hand to target");
    const auto hand = values();
    plot("error", "LeftFoot");
    EXPECT_EQ(humanoid_past().curve(workspace)->name, "worst effector to target");
    const auto farthest = values();
    for (std::uint64_t tick = 0; tick < 30; tick += 4) {
        const double left = back_at(tick, residual(Effector::LeftHand)),
                     head = back_at(tick, residual(Effector::Head));
        EXPECT_NEAR(hand.at(tick), left, 1e-6) << tick;
        EXPECT_NEAR(farthest.at(tick), std::max(left, head), 1e-6) << tick;
    }
}

TEST_F(HumanoidPast, AFewMomentsAreComputedAtATimeNewestFirst) {
    walk(100);
    plot("swing", "LeftLowerLeg");
    const auto some = [&] {
        return past_values(workspace, humanoid_past(), *humanoid_past().curve(workspace), 16);
    };
    for (std::size_t frame = 1; frame <= 6; ++frame) {
        const auto known = some();
        ASSERT_EQ(known.size(), 16 * frame);
        EXPECT_EQ(known.back().tick, 100u);
        EXPECT_EQ(known.front().tick, 101u - 16 * frame);
        EXPECT_TRUE(past_plot_waits(workspace, humanoid_past()));
        EXPECT_TRUE(lab().working(workspace));
    }
    EXPECT_EQ(some().size(), 101u);
    EXPECT_FALSE(lab().working(workspace));
    const std::uint64_t moment = workspace.moment;
    lab().work(workspace);
    EXPECT_EQ(workspace.moment, moment);
    plot("twist", "LeftUpperArm");
    EXPECT_EQ(some().size(), 101u) << "no pose is solved again for another number";
}

TEST_F(HumanoidPast, ResultsAreDroppedOnceNothingIsPlotted) {
    walk(20);
    plot("swing", "LeftLowerLeg");
    static_cast<void>(values());
    forget_past_poses(workspace);
    EXPECT_EQ(humanoid_runtime(workspace).past.size(), 21u) << "it is still plotted";
    run("view.humanoid_plot", {{"of", "nothing"}});
    run("view.humanoid_ghosts", {{"of", "past"}});
    forget_past_poses(workspace);
    EXPECT_EQ(humanoid_runtime(workspace).past.size(), 21u) << "there are ghosts";
    run("view.humanoid_ghosts", {{"of", "nothing"}});
    forget_past_poses(workspace);
    EXPECT_EQ(humanoid_runtime(workspace).past.size(), 0u);
}

TEST_F(HumanoidPast, WithoutATargetThereIsNoError) {
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    run("view.humanoid_plot", {{"of", "error"}});
    workspace.remember_moment();
    EXPECT_TRUE(values().empty());
    EXPECT_TRUE(test::says(humanoid_past().curve(workspace)->missing, "effector target"));
}

}  // namespace
}  // namespace tendril::app
