// Time in the Rope lab: independent of frames, at any speed, until everything is at rest.
#include "app/labs/rope/rope_time.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/rope/numbers.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/app/support/random_numbers.hpp"

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

TEST_F(RopeTime, ShowsTheForceOnACollider) {
    run("rope.clear");
    run("rope.collider.add",
        {{"name", "ground"}, {"kind", "plane"}, {"point", {0, 0, 0}}, {"normal", {0, 1, 0}}});
    run("rope.add", {{"from", {0, 0.1, 0}}, {"to", {1, 0.1, 0}}});
    wait(240);
    ASSERT_EQ(part().forces.value().size(), 1u);
    const double weight = 9.81 * world().world().mass(world().state().bodies.front());
    EXPECT_NEAR(part().forces->front().newtons.y, -weight, 0.01 * weight);
    run("rope.select", {{"collider", "ground"}});
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "force N")) << weight;
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
    EXPECT_EQ(part().jitter.pending, 0.0);
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

// The plotted numbers of ropes at each remembered moment, against the panel and --state.

class RopePast : public RopeTest, protected test::RandomNumbers {
  protected:
    RopePast() : RandomNumbers(31) {}

    void pass(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            wait(1);
            remember();
        }
    }
    std::vector<PastValue> values(const char* what) {
        run("view.rope_plot", {{"of", what}});
        return past_values(workspace, rope_past(), *rope_past().curve(workspace));
    }
    PoseLines pose() const { return rope_past().pose(workspace, now()); }
};

/// The maximum tension of links at a particle, or of all links.
float tension(const NamedWorld& world, std::optional<std::size_t> particle) {
    float strongest = 0.0f;
    for (const rope::Link& link : world.state().links) {
        const bool at = !particle || link.a == *particle || link.b == *particle;
        if (link.kind == rope::Link::Kind::Stretch && at) strongest = std::max(strongest, link.tension);
    }
    return strongest;
}

TEST_F(RopePast, ValuesEqualEachTicksInEveryScene) {
    for (const char* const scene : {"drape", "bridge", "pendulum", "cloth", "hair"}) {
        run("rope.preset", {{"name", scene}});
        workspace.rewind.clear();
        std::vector<RopeSample> samples;
        std::vector<float> tensions, speeds;
        for (int i = 0; i < 20; ++i) {
            pass(1);
            samples.push_back(part().samples.back());
            tensions.push_back(tension(world(), std::nullopt));
            float fastest = 0.0f;
            for (std::size_t p = 0; p < world().size(); ++p)
                fastest = std::max(fastest, glm::length(world().velocity(p)));
            speeds.push_back(fastest);
        }
        const auto error = values("error"), energy = values("energy"), pull = values("tension"),
                   speed = values("speed");
        ASSERT_EQ(error.size(), 21u) << "and the present";
        for (std::size_t i = 0; i < 20; ++i) {
            EXPECT_FLOAT_EQ(error[i].value, 100.0f * samples[i].error) << scene << " at " << i;
            EXPECT_EQ(energy[i].value, samples[i].energy) << scene << " at " << i;
            EXPECT_EQ(pull[i].value, tensions[i]) << scene << " at " << i;
            EXPECT_EQ(speed[i].value, speeds[i]) << scene << " at " << i;
        }
    }
}

TEST_F(RopePast, NothingIsHeldThere) {
    single_rope(12);
    run("rope.hold", {{"rope", "rope"}, {"particle", 4}, {"at", {0.5, 2.2, 0}}});
    pass(5);
    run("rope.let_go");
    pass(5);
    run("time.seek", {{"ticks_back", 8}});
    EXPECT_FALSE(part().hold || world().pinned(4));
}

TEST_F(RopePast, OfTheSelectionEqualsInspectorAndState) {
    single_rope(12);
    run("rope.add", {{"name", "other"}, {"from", {0, 3, 0}}, {"to", {2, 3, 0}}, {"segments", 20}});
    run("rope.pin", {{"rope", "other"}, {"particle", 0}});
    pass(15);
    for (int round = 0; round < 20; ++round) {
        const std::size_t particle = random() % 21;
        run("rope.select", {{"rope", "other"}, {"particle", particle}});
        const rope::Body& body = *world().find("other");
        EXPECT_EQ(values("tension").back().value, tension(world(), body.first + particle));
        EXPECT_EQ(values("speed").back().value, glm::length(world().velocity(body.first + particle)));
        const Json told = state()["ropes"][1];
        EXPECT_FLOAT_EQ(values("error").back().value, 100.0f * told["length_error"].get<float>());
        EXPECT_FLOAT_EQ(values("energy").back().value, told["energy"].get<float>());
    }
    EXPECT_EQ(rope_past().curve(workspace)->name, "energy of other");
    run("rope.select", {{"rope", "other"}, {"particle", 7}});
    values("speed");
    EXPECT_TRUE(test::says(rope_past().curve(workspace)->name, "speed other particle 7"));
    run("rope.select", {{"rope", "other"}, {"particles", {3, 4, 9}}});
    EXPECT_TRUE(test::says(rope_past().curve(workspace)->name, "speed 3 particles other"));
    float fastest = 0.0f;
    for (const std::size_t each : {3u, 4u, 9u})
        fastest = std::max(fastest, glm::length(world().velocity(world().find("other")->first + each)));
    EXPECT_EQ(values("speed").back().value, fastest);
    run("rope.collider.add", {{"name", "ball"}, {"kind", "sphere"}, {"centre", {0, 0, 0}}, {"radius", 1}});
    run("rope.select", {{"collider", "ball"}});
    EXPECT_EQ(rope_past().curve(workspace)->name, "highest speed") << "a collider is no rope: all of them";
}

TEST_F(RopePast, ARopeThatDidNotExistHasNoValue) {
    single_rope();
    pass(3);
    run("rope.add", {{"name", "late"}, {"from", {0, 3, 0}}, {"to", {1, 3, 0}}, {"segments", 4}});
    pass(2);
    run("rope.select", {{"rope", "late"}, {"particle", 4}});
    EXPECT_EQ(values("tension").size(), 3u);
    EXPECT_EQ(values("energy").size(), 3u);
    run("rope.select");
    EXPECT_EQ(values("tension").size(), 6u);
    run("rope.clear");
    EXPECT_TRUE(values("energy").empty()) << "an emptied scene shows nothing of the old one";
    EXPECT_TRUE(part().samples.empty());
    run("undo");
    EXPECT_EQ(values("energy").size(), 6u);
    run("rope.clear");
    workspace.rewind.clear();
    EXPECT_TRUE(values("tension").empty());
    EXPECT_TRUE(test::says(rope_past().curve(workspace)->missing, "no rope"));
}

TEST_F(RopePast, PosesSpanACutButNotAnotherScene) {
    single_rope();
    remember();
    workspace.moment = 30;
    run("rope.cut", {{"rope", "rope"}, {"segment", 3}});
    remember();
    EXPECT_EQ(ghost_moments(workspace, rope_past()).size(), 2u);
    run("rope.preset", {{"name", "pendulum"}});
    EXPECT_TRUE(ghost_moments(workspace, rope_past()).empty());
}

TEST_F(RopePast, APoseIsTheRopesLinks) {
    single_rope(8);
    const PoseLines lines = pose();
    ASSERT_EQ(lines.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(lines[i].first, world().position(i));
        EXPECT_EQ(lines[i].second, world().position(i + 1));
    }
    run("rope.cut", {{"rope", "rope"}, {"segment", 3}});
    EXPECT_EQ(pose().size(), 7u);
    run("rope.clear");
    EXPECT_TRUE(pose().empty());
}

TEST_F(RopePast, APoseOfManyLinksHasAFewHundredLinesFromEndToEnd) {
    run("rope.clear");
    run("rope.settings", {{"iterations", 1}});
    for (int i = 0; i < 3; ++i)
        run("rope.add", {{"from", {0, 2, i}}, {"to", {9, 2, i}}, {"segments", 5000 + 321 * i}});
    run("rope.add", {{"from", {0, 5, 0}}, {"to", {1, 5, 0}}, {"segments", 2}});
    const PoseLines lines = pose();
    EXPECT_GT(lines.size(), 250u);
    EXPECT_LE(lines.size(), 400u);
    float length = 0.0f;
    for (const auto& [from, to] : lines) length += glm::length(to - from);
    EXPECT_NEAR(length, 28.0f, 1e-3f) << "nothing is left out of ropes that are straight";
    run("rope.preset", {{"name", "hair"}});
    EXPECT_LE(pose().size(), max_ghost_lines);
    EXPECT_GT(pose().size(), 100u);
}

TEST_F(RopePast, AClothHasFiveRowsAndColumnsWithoutTornParts) {
    run("rope.clear");
    add_cloth("cloth", {0, 2, 0}, {2, 0, 0}, {0, 0, 1}, 20, 12);
    float length = 0.0f;
    for (const auto& [from, to] : pose()) length += glm::length(to - from);
    EXPECT_NEAR(length, 5.0f * 2.0f + 5.0f * 1.0f, 1e-3f);

    NamedWorld torn = world();
    rope::State state = torn.state();
    const auto gone =
        std::erase_if(state.links, [](const rope::Link& link) { return link.a == 7 && link.b == 8; });
    ASSERT_EQ(gone, 1u);
    torn.put(std::move(state));
    workspace.document.edit<RopePart>(rope_lab).world = std::make_shared<const NamedWorld>(std::move(torn));
    float left = 0.0f;
    for (const auto& [from, to] : pose()) left += glm::length(to - from);
    const float link = 2.0f / static_cast<float>(world().find("cloth")->row - 1);
    EXPECT_NEAR(left, length - link, 1e-3f);
}

}  // namespace
}  // namespace tendril::app
