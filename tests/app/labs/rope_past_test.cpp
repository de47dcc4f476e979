// The plotted numbers of ropes at each remembered moment, against the panel and --state.
#include "app/labs/kit/past.hpp"

#include <algorithm>

#include "app/labs/rope/numbers.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/random_numbers.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

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
