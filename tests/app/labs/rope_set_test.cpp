// Editing the material of ropes, cloth and hair while they hang.
#include "app/labs/rope/rope_fields.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeSet : public LabTest {
  protected:
    RopeSet() : LabTest(rope_lab) {
        run("rope.clear");
        run("rope.add", {{"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"segments", 16}, {"pin_start", true}});
        run("rope.cloth.add", {{"corner", {3, 2, 0}},
                               {"along", {1, 0, 0}},
                               {"down", {0, -1, 0}},
                               {"columns", 8},
                               {"rows", 8},
                               {"pins", "corners"}});
        run("rope.hair.add", {{"centre", {6, 2, 0}}, {"strands", 3}, {"segments", 8}});
        tick(120);
    }
    const NamedWorld& world() const { return *rope_part(workspace).world; }
    BodySettings made_of(const char* body) const { return settings_of(world(), *world().find(body)); }
    double lowest() const {
        double low = 10.0;
        for (const glm::dvec3& each : world().state().position) low = std::min(low, each.y);
        return low;
    }
    void tick(int count) {
        for (int i = 0; i < count; ++i) lab().step(workspace);
    }
};

TEST_F(RopeSet, ChangesWhatABodyIsMadeOf) {
    run("rope.set", {{"rope", "rope"}, {"length", 1.5}, {"mass", 4}, {"radius", 0.1}, {"stretch", 1e-4}});
    BodySettings rope = made_of("rope");
    EXPECT_NEAR(rope.length, 1.5f, 1e-6f);
    EXPECT_NEAR(rope.mass, 4.0, 1e-12);
    EXPECT_EQ(rope.radius, 0.1f);
    EXPECT_EQ(rope.stretch, 1e-4f);
    run("rope.set", {{"rope", "cloth"}, {"shear", 0.5}, {"bend", 0.25}, {"tear", 2}});
    EXPECT_EQ(made_of("cloth").shear, 0.5f);
    EXPECT_EQ(made_of("cloth").bend, 0.25f);
    EXPECT_EQ(made_of("cloth").tear, 2.0f);
    run("rope.set", {{"rope", "hair"}, {"bend", 2}});
    EXPECT_EQ(made_of("hair").bend, 2.0f);
    for (int i = 0; i < 3; ++i) run("undo");
    EXPECT_NEAR(made_of("rope").length, 1.0f, 1e-6f);
    EXPECT_EQ(made_of("hair").bend, rope::HairShape().bend);
}

/// It continues from its pose, no particle moves further than its share of the change, and none is thrown.
TEST_F(RopeSet, ALongerRopeSinksToItsNewLength) {
    const double before = lowest();
    const std::vector<glm::dvec3> was = world().state().position;
    run("rope.set", {{"rope", "rope"}, {"length", 1.3}});
    EXPECT_EQ(world().state().position, was);
    tick(1);
    for (std::size_t i = 0; i <= 16; ++i) {
        EXPECT_LT(glm::distance(world().state().position[i], was[i]),
                  0.3 * static_cast<double>(i) / 16 + 0.01);
        EXPECT_LT(glm::length(world().velocity(i)), 2.5f) << i;
    }
    tick(600);
    EXPECT_NEAR(lowest(), before - 0.3, 0.02);
    EXPECT_LT(world().length_error(), 0.02);
}

TEST_F(RopeSet, RefusesWhatABodyDoesNotHave) {
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"bend", 1}}), "rope.set rope bend"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "hair"}, {"tear", 1}}), "rope.set hair tear"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "hair"}, {"shear", 1}}), "rope.set hair shear"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "line"}, {"mass", 1}}), "rope.set line"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"mass", 0}}), "rope.set mass 0"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"radius", -1}}), "rope.set radius -1"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"mass", 1}}), "rope.set rope missing"));
}

}  // namespace
}  // namespace tendril::app
