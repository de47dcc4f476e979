// Ropes that collide, in the Rope lab: the command, the buttons, files, undo, code, the scene with a knot.
#include "app/labs/rope/code.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeCollisionTest : public RopeTest {
  protected:
    /// A rope that falls across another one, which hangs between two pins.
    void crossed() {
        run("rope.clear");
        run("rope.add", {{"name", "line"},
                         {"from", {-0.5, 2, 0}},
                         {"to", {0.5, 2, 0}},
                         {"length", 1.05},
                         {"pin_start", true},
                         {"pin_end", true}});
        run("rope.add", {{"name", "other"}, {"from", {0, 2.1, -0.4}}, {"to", {0, 2.1, 0.4}}});
    }
    void add_sail() {
        run("rope.cloth.add", {{"name", "sail"},
                               {"corner", {2, 1, 0}},
                               {"along", {1, 0, 0}},
                               {"down", {0, -1, 0}},
                               {"columns", 3},
                               {"rows", 3}});
    }
    void collide(const char* a, const char* b, bool on = true) {
        run("rope.collide", {{"a", a}, {"b", b}, {"on", on}});
    }
    double lowest(const char* rope) const {
        const rope::Body& body = *world().find(rope);
        double y = 1e9;
        for (std::size_t i = body.first; i < body.first + body.count; ++i)
            y = std::min(y, world().state().position[i].y);
        return y;
    }
};

TEST_F(RopeCollisionTest, OneRopeStaysOnAnotherUntilSwitchedOff) {
    crossed();
    collide("line", "other");
    wait(30);
    EXPECT_EQ(state()["collisions"], Json::array({{"line", "other"}}));
    EXPECT_GT(state()["contacts"], 0);
    EXPECT_GT(lowest("other"), 1.3) << "it hangs on the other one";
    collide("other", "line", false);
    EXPECT_EQ(state()["collisions"], Json::array());
    wait(90);
    EXPECT_LT(lowest("other"), 0.0) << "it has fallen";
}

TEST_F(RopeCollisionTest, AllIsEveryRopeAndClothAndUndoneInOneStep) {
    crossed();
    add_sail();
    collide("all", "all");
    EXPECT_EQ(state()["collisions"], Json::array({{"line", "line"},
                                                  {"line", "other"},
                                                  {"line", "sail"},
                                                  {"other", "other"},
                                                  {"other", "sail"},
                                                  {"sail", "sail"}}));
    run("undo");
    EXPECT_EQ(state()["collisions"], Json::array());
    collide("other", "all");
    EXPECT_EQ(state()["collisions"], Json::array({{"line", "other"}, {"other", "other"}, {"other", "sail"}}));
}

TEST_F(RopeCollisionTest, TheInspectorHasAButtonForItselfAndOneForAll) {
    crossed();
    add_sail();
    for (const char* body : {"line", "sail"}) {
        run("rope.select", {{"rope", body}, {"particle", 3}});
        EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "Hits itself Hits all"));
    }
}

TEST_F(RopeCollisionTest, IsInTheCode) {
    crossed();
    collide("all", "all");
    wait(40);
    ASSERT_GT(state()["contacts"], 0);
    EXPECT_TRUE(test::says(rope_code(part()),
                           "rope::number_slots state.collisions.push_back({state.bodies[0].id, "
                           "state.bodies[0].id}) state.contacts.push_back .force"));
}

TEST_F(RopeCollisionTest, Refusals) {
    crossed();
    run("rope.hair.add", {{"name", "beard"}, {"centre", {0, 1, 0}}, {"radius", 0.1}});
    expect_refused("rope.collide", {{"a", "line"}, {"b", "beard"}, {"on", true}}, {"hair"});
    expect_refused("rope.collide", {{"a", "line"}, {"b", "none"}, {"on", true}}, {"none"});
    expect_refused("rope.collide", {{"a", "line"}, {"b", "other"}}, {"on"});
}

TEST_F(RopeCollisionTest, AFoldedClothLiesInLayersUntilSwitchedOff) {
    run("rope.preset", {{"name", "folded"}});
    const rope::Body cloth = *world().find("cloth");
    // Four particles that lie above each other, far from the creases.
    const auto height = [&](std::size_t layer) {
        return world().position(cloth.first + 2 * cloth.row + 10 * layer + 5).y / (2.0f * cloth.radius);
    };
    EXPECT_EQ(state()["verdict"], "Lengths hold");
    wait(120);
    EXPECT_EQ(state()["verdict"], "Lengths hold");
    const std::vector<glm::dvec3> were = world().state().position;
    wait(60);
    for (std::size_t layer = 0; layer < 4; ++layer)
        EXPECT_NEAR(height(layer), 0.5 + static_cast<double>(layer), 0.05) << layer;
    for (std::size_t i = 0; i < were.size(); ++i) {
        EXPECT_LT(world().state().position[i].y, 4.0f * 2.0f * cloth.radius) << "no part of it lifts";
        EXPECT_LT(glm::distance(world().state().position[i], were[i]), 5e-4) << "it lies still";
    }
    run("rope.collide", {{"a", "cloth"}, {"b", "cloth"}, {"on", false}});
    wait(180);
    EXPECT_LT(height(1), 1.2) << "a layer has sunk into the one below it";
}

TEST_F(RopeCollisionTest, AKnotIsPulledTightByItsWeight) {
    run("rope.preset", {{"name", "knot"}});
    const double before = lowest("rope");
    wait(900);
    EXPECT_LT(lowest("rope"), before - 0.3) << "it has become longer";
    EXPECT_GT(lowest("rope"), 0.05) << "it hangs clear of the ground";
    EXPECT_GT(state()["contacts"], 5);
    EXPECT_LT(world().length_error(), 1e-3);
    // Without the knot it would hang straight, at its length.
    const rope::Body& rope = *world().find("rope");
    EXPECT_GT(lowest("rope"), world().position(rope.first).y - world().length(rope) + 0.15);
    EXPECT_EQ(state()["verdict"], "Lengths hold");
    run("rope.collide", {{"a", "rope"}, {"b", "rope"}, {"on", false}});
    wait(300);
    EXPECT_LT(lowest("rope"), world().position(rope.first).y - world().length(rope) + 0.05)
        << "it has come undone";
}

}  // namespace
}  // namespace tendril::app
