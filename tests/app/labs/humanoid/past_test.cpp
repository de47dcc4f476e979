// A joint's rotation and an effector's distance to its target at each remembered moment, compared with the
// lab's display after seeking there.
#include "app/labs/humanoid/draw.hpp"

#include <glm/trigonometric.hpp>
#include <map>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "tests/app/labs/humanoid/humanoid_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

class HumanoidPast : public HumanoidTest {
  protected:
    /// Walks and reaches for `count` remembered ticks.
    void walk(int count) {
        run("humanoid.clip", {{"name", "walk"}, {"play", true}});
        run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.6, 1.5, 0.9}}});
        run("humanoid.target", {{"effector", "head"}, {"to", {0.1, 1.5, 0.6}}});
        for (int i = 0; i < count; ++i) {
            workspace.remember_moment();
            ++workspace.moment;
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
