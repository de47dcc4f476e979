// Time in the Rope lab: independent of frames, at any speed, until everything is at rest.
#include "app/labs/rope/rope_time.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeTime : public RopeTest {
  protected:
    double farthest(const NamedWorld& a, const NamedWorld& b) const {
        EXPECT_EQ(a.size(), b.size());
        double most = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i)
            most = std::max(most, glm::distance(a.state().position[i], b.state().position[i]));
        return most;
    }
};

TEST_F(RopeTime, FramesOfAnyRateLeadToTheSameWorld) {
    for (const char* scene : {"drape", "hair", "pendulum"}) {
        run("rope.preset", {{"name", scene}});
        std::vector<std::shared_ptr<const NamedWorld>> even{part().world};
        for (int i = 0; i < 200; ++i) {
            wait(1);
            even.push_back(part().world);
        }
        for (const auto& [rate, dial, most] : {std::tuple{60, 1, 200}, {15, 0, 50}, {144, 0, 200}}) {
            SCOPED_TRACE(std::string(scene) + " at " + std::to_string(rate) + " Hz");
            run("rope.preset", {{"name", scene}});
            run("rope.jitter", {{"rate", rate}, {"dial", dial}});
            int compared = 0, frames = 0;
            for (int i = 0; i < 200; ++i) {
                const auto before = world().state().substeps;
                wait(1);
                frames += world().state().substeps != before;
                for (const auto& world_then : even) {
                    if (world_then->state().substeps != world().state().substeps) continue;
                    EXPECT_LT(farthest(*world_then, world()), 1e-6) << "tick " << i;
                    ++compared;
                }
            }
            EXPECT_GT(compared, 30);
            EXPECT_LE(frames, most);
            EXPECT_EQ(world().state().dropped, 0u);
        }
        run("rope.jitter", {{"rate", 60}, {"dial", 0}});
    }
}

/// A tick's work is bounded, however fine the substeps; time beyond the bound is counted as dropped.
TEST_F(RopeTime, ATicksWorkIsBounded) {
    single_rope(50);
    run("rope.settings", {{"substep", 1e-5}, {"iterations", 10'000}, {"solver", "relaxation"}});
    wait(1);
    EXPECT_EQ(world().state().substeps, max_lab_work / work_of_substep(world()));
    EXPECT_NEAR(static_cast<double>(world().state().substeps + world().state().dropped), 1e5 / 60.0, 1.0);
}

/// So that a large cloth follows the mouse; a small one takes all of its substeps.
TEST_F(RopeTime, ADraggedClothOfTenThousandTakesFewerSubstepsAndSaysSo) {
    for (const int side : {10, 100}) {
        run("rope.clear");
        add_cloth("cloth", {0, 2, 0}, {1, 0, 0}, {0, -1, 0}, side, side, "corners");
        for (const bool held : {true, false}) {
            const auto before = world().state().substeps;
            const Json at = point(world().position(static_cast<std::size_t>(side + 3)));
            if (held) run("rope.hold", {{"rope", "cloth"}, {"particle", side + 3}, {"at", at}});
            if (!held) run("rope.let_go");
            wait(1);
            EXPECT_EQ(world().state().substeps - before, held && side == 100 ? 1u : 4u) << side;
            if (held && side == 100) {
                EXPECT_TRUE(test::says(state().at("verdict"), "25 % of real time"));
                EXPECT_TRUE(test::says(state().at("why"), "drag fewer substeps"));
            }
        }
    }
}

TEST_F(RopeTime, FramesAreFrom1To250Milliseconds) {
    double shortest = 1.0, longest = 0.0;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        EXPECT_EQ(jitter_frame({.dial = 0.0f}, i), tick_seconds);
        EXPECT_NEAR(jitter_frame({.dial = 0.5f}, i), tick_seconds, 0.06);
        shortest = std::min(shortest, jitter_frame({.dial = 1.0f}, i));
        longest = std::max(longest, jitter_frame({.dial = 1.0f}, i));
    }
    EXPECT_GE(shortest, 0.001);
    EXPECT_LT(shortest, 0.0012);
    EXPECT_LE(longest, 0.25);
    EXPECT_GT(longest, 0.24);
}

/// With a step that does not divide a tick, the picture shows the tick's own time.
TEST_F(RopeTime, ASwingingBallIsDrawnAtTheTicksTime) {
    run("rope.clear");
    run("rope.add", {{"from", {0, 2, 0}}, {"to", {0, 1, 0}}, {"segments", 8}, {"pin_start", true}});
    run("rope.collider.add", {{"name", "ball"}, {"kind", "sphere"}, {"centre", {3, 1, 0}}, {"radius", 0.2}});
    run("rope.collider.swing", {{"name", "ball"}, {"by", {1, 0, 0}}, {"period", 1}});
    run("rope.settings", {{"substep", 0.007}});
    for (int i = 0; i < 60; ++i) {
        wait(1);
        const glm::vec3 shown = rope::centre(world().shape(*world().find_collider("ball")));
        EXPECT_LT(glm::distance(shown, swing_point(part().swings[0], part().time)), 1e-4f) << i;
    }
}

/// The plot of frame times shows the actual frames.
TEST_F(RopeTime, ThePlotShowsTheActualFrames) {
    wait(3);
    EXPECT_NEAR(part().samples.back().frame, 1e3 * tick_seconds, 1e-4);
    run("rope.jitter", {{"dial", 1}});
    float shortest = 1e3f, longest = 0.0f;
    for (int i = 0; i < 300; ++i) {
        wait(1);
        const float frame = part().samples.back().frame;
        EXPECT_NEAR(frame, 1e3 * jitter_frame(part().jitter, part().jitter.frames), 1e-3);
        EXPECT_NEAR(state().at("frame_ms").get<float>(), frame, 1e-3f);
        shortest = std::min(shortest, frame), longest = std::max(longest, frame);
    }
    EXPECT_LT(shortest, 10.0f);
    EXPECT_GT(longest, 200.0f);
    run("rope.jitter", {{"dial", 0}});
    wait(1);
    EXPECT_NEAR(part().samples.back().frame, 1e3 * tick_seconds, 1e-4);
}

TEST_F(RopeTime, ResettingTheDialLeavesNoTimeOwed) {
    run("rope.jitter", {{"dial", 1}});
    wait(33);
    run("rope.jitter", {{"dial", 0}});
    wait(1);
    EXPECT_EQ(part().jitter.owed, 0.0);
    EXPECT_NEAR(part().time, 34 * tick_seconds, 1e-9);
    EXPECT_EQ(world().state().substeps + world().state().dropped, 34u * 4u);
}

TEST_F(RopeTime, AtRestTheWindowIdlesUntilACommand) {
    run("rope.clear");
    run("rope.collider.add",
        {{"name", "ground"}, {"kind", "plane"}, {"point", {0, 0, 0}}, {"normal", {0, 1, 0}}});
    run("rope.add", {{"from", {0, 0.1, 0}}, {"to", {1, 0.1, 0}}});
    int ticks = 0;
    for (; lab().moving(workspace) && ticks < 1200; ++ticks) wait(1);
    EXPECT_LT(ticks, 600);
    EXPECT_GT(ticks, 60);
    run("rope.view", {{"strain", true}});
    run("rope.select", {{"rope", "rope"}, {"particle", 3}});
    EXPECT_FALSE(lab().moving(workspace)) << "to look at it does not wake it";
    run("rope.pin", {{"rope", "rope"}, {"particle", 3}, {"at", {0, 1, 0}}});
    EXPECT_TRUE(lab().moving(workspace));
    wait(200);
    run("rope.collider.swing", {{"name", "ground"}, {"by", {0, 0.1, 0}}});
    wait(300);
    EXPECT_TRUE(lab().moving(workspace)) << "what swings never rests";
}

TEST_F(RopeTime, PassingNeedsNoSave) {
    wait(10);
    EXPECT_FALSE(workspace.modified());
    run("rope.jitter", {{"dial", 0.5}});
    wait(10);
    EXPECT_TRUE(workspace.modified());
}

TEST_F(RopeTime, IsMeasuredOnlyInALiveWindow) {
    wait(3);
    EXPECT_EQ(part().samples.back().cost, 0.0f);
    workspace.clock.measured = true;
    wait(3);
    EXPECT_GT(part().samples.back().cost, 0.0f);
    EXPECT_EQ(part().save().dump().find("cost"), std::string::npos);
    EXPECT_EQ(state().dump().find("cost"), std::string::npos);
}

TEST_F(RopeTime, FallingOffTheWorldStopsTime) {
    single_rope();
    run("rope.settings", {{"gravity", 10000}, {"gravity_scale", 1000}, {"damping", 0}});
    for (int i = 0; i < 3000 && workspace.clock.playing; ++i) wait(1);
    EXPECT_FALSE(workspace.clock.playing);
    tells("paused 1e9 m");
    EXPECT_NO_THROW(part().load(part().save(), ""));
}

TEST_F(RopeTime, TheChainTakesATickOnlyWhenOneHasPassed) {
    run("lab.open", {{"name", "chain"}});
    run("chain.motion", {{"path", "circle"}});
    const Lab& chain = *labs.find("chain");
    const auto ticks_in = [&](float speed, int ticks) {
        run("time.speed", {{"factor", speed}});
        int passed = 0;
        for (int i = 0; i < ticks; ++i) {
            passed += workspace.clock.whole_ticks();
            chain.step(workspace);
            workspace.clock.passed += static_cast<double>(workspace.clock.speed);
        }
        return passed;
    };
    EXPECT_EQ(ticks_in(1.0f, 60), 60);
    EXPECT_EQ(ticks_in(0.1f, 60), 6);
    EXPECT_EQ(ticks_in(2.0f, 60), 120);
    EXPECT_EQ(ticks_in(0.05f, 100), 5);
    EXPECT_EQ(workspace.document.parts().at("chain")->save()["motion"]["ticks"], (60 + 6 + 120 + 5) % 240);
}

}  // namespace
}  // namespace tendril::app
