// Targets that are released, or change weight or rotation: nothing else jumps.
#include <random>

#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"

namespace tendril::app {
namespace {

using Places = std::vector<glm::dvec3>;

class HumanoidRelease : public HumanoidTest {
  protected:
    void begin_anew(bool walking) {
        workspace = make_blank_workspace(labs);
        if (!walking) return;
        run("humanoid.clip", {{"name", "walk"}, {"play", true}});
        tick(static_cast<int>(any(10.0, 60.0)));
    }
    void target(const char* effector, const Json& to) {
        run("humanoid.target", {{"effector", effector}, {"to", to}});
    }
    void let_go(const char* effector) { run("humanoid.target", {{"effector", effector}, {"weight", 0}}); }
    /// A random point within `size` of the clip's hips plus `from`.
    Json near(const glm::dvec3& from, double size) {
        const glm::dvec3 at = bone("Hips") + from;
        const double x = any(-size, size), y = any(-size, size), z = any(-size, size);
        return {at.x + x, at.y + y, at.z + z};
    }
    void reach_with_both_hands() {
        target("left_hand", near({0.35, 0.3, 0.4}, 0.25));
        target("right_hand", near({-0.35, 0.1, 0.5}, 0.45));
        tick(10);
    }
    Places places() const {
        Places all;
        for (const humanoid::Placement& each : shown_pose(workspace).placed) all.push_back(each.position);
        return all;
    }
    Places clip_places() const {
        const ShownPose& shown = shown_pose(workspace);
        Places all;
        for (const humanoid::Placement& each : shown.before.empty() ? shown.placed : shown.before)
            all.push_back(each.position);
        return all;
    }
    double leap(const Places& before, const Places& now, const char* without = nullptr) const {
        const std::size_t limb = without ? node_named(part(), without) : before.size();
        double most = 0.0;
        for (std::size_t i = 0; i < now.size(); ++i)
            if (i != limb && !(without && part().skeleton().is_below(i, limb)))
                most = std::max(most, glm::distance(before[i], now[i]));
        return most;
    }
    double left(const char* effector) const {
        return state().at("body").at("targets").at(effector).at("residual").get<double>();
    }
    double any(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }

    std::mt19937 engine{11};
};

TEST_F(HumanoidRelease, WhilePausedMovesOnlyTheReleasedLimb) {
    for (int i = 0; i < 25; ++i) {
        begin_anew(false);
        if (i % 2) run("humanoid.clip", {{"name", "walk"}, {"time", any(0.0, 1.0)}});
        reach_with_both_hands();
        if (left("left_hand") > 1e-4 || left("right_hand") > 1e-4) continue;
        const Places before = places();
        let_go("right_hand");
        EXPECT_FALSE(state().at("body").at("targets").contains("right_hand"));
        EXPECT_LT(leap(before, places(), "RightUpperArm"), 5e-3) << i;
        EXPECT_GT(leap(before, places()), 0.05) << "the arm is the clip's at once";
        EXPECT_LT(left("left_hand"), 1e-3);
    }
}

TEST_F(HumanoidRelease, TheRestOfTheBodyReturnsWhileTimeRuns) {
    target("left_hand", {0.3, 1.2, 0.4});
    const glm::dvec3 alone = bone("Head");
    target("right_hand", {-0.2, 0.8, 0.9});
    let_go("right_hand");
    EXPECT_GT(glm::distance(bone("Head"), alone), 0.2) << "still bent down";
    Places before = places();
    int ticks = 0;
    for (; lab().moving(workspace) && ticks < 200; ++ticks) {
        tick();
        ASSERT_LT(leap(before, places()), 0.05) << ticks;
        ASSERT_LT(left("left_hand"), 1e-3) << ticks;
        before = places();
    }
    EXPECT_LT(ticks, 70) << "then nothing moves any more";
    EXPECT_LT(glm::distance(bone("Head"), alone), 0.06);
}

TEST_F(HumanoidRelease, EasesBackIntoAPlayingClip) {
    for (int i = 0; i < 25; ++i) {
        begin_anew(true);
        reach_with_both_hands();
        const bool both = i % 3 == 0;
        const Places held = places();
        if (both) let_go("left_hand");
        let_go("right_hand");
        EXPECT_LT(leap(held, places()), 1e-9) << "not in the moment itself";
        double way = leap(clip_places(), held);
        // Metres that the other hand moves when the walk takes its target along to the next round.
        constexpr double along = 1.3;
        bool goes_along = false;
        Places before = held, clip = clip_places();
        double walked = 0.0;
        for (int k = 0; k < 70; ++k) {
            const std::int64_t rounds = part().playback.rounds;
            tick();
            if (part().playback.rounds > rounds && !both) way = std::max(way, along), goes_along = true;
            const Places now = places(), now_clip = clip_places();
            walked = leap(clip, now_clip);
            ASSERT_LT(leap(before, now), walked + 0.16 * way + 0.01) << i << ' ' << k;
            before = now, clip = now_clip;
        }
        if (!goes_along) {
            EXPECT_EQ(part().ik_state.release, Release());
        }
        if (both) {
            EXPECT_EQ(leap(places(), clip_places()), 0.0) << "the clip's to the bit";
        } else {
            EXPECT_LT(left("left_hand"), 0.4);
        }
    }
}

TEST_F(HumanoidRelease, OfAHandMovedByHandIkEasesToo) {
    begin_anew(true);
    run("humanoid.hand_ik", {{"on", true}});
    target("right_hand", near({-0.35, 0.1, 0.45}, 0.05));
    tick(3);
    Places before = places();
    let_go("right_hand");
    EXPECT_LT(leap(before, places()), 1e-9);
    for (int k = 0; k < 70; ++k) {
        before = places();
        tick();
        ASSERT_LT(leap(before, places()), 0.15) << k;
    }
    EXPECT_EQ(leap(places(), clip_places()), 0.0);
}

TEST_F(HumanoidRelease, ANewTargetOfTheSameHandIsReachedAtOnce) {
    begin_anew(true);
    reach_with_both_hands();
    let_go("right_hand");
    tick(2);
    const glm::dvec3 wanted = bone("RightHand") + glm::dvec3(0.05, 0.05, 0.05);
    target("right_hand", {wanted.x, wanted.y, wanted.z});
    EXPECT_LT(glm::distance(bone("RightHand"), wanted), 1e-3);
}

TEST_F(HumanoidRelease, IsSavedUndoneAndContinuesTheSame) {
    begin_anew(true);
    reach_with_both_hands();
    const Json held = state();
    let_go("right_hand");
    let_go("left_hand");
    tick(5);
    EXPECT_NE(part().ik_state.release, Release());
    expect_goes_on_the_same();
    run("undo");
    run("undo");
    EXPECT_EQ(state(), held);
}

}  // namespace
}  // namespace tendril::app
