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
        add_rope("line", {-0.5, 2, 0}, {0.5, 2, 0},
                 {{"length", 1.05}, {"pin_start", true}, {"pin_end", true}});
        add_rope("other", {0, 2.1, -0.4}, {0, 2.1, 0.4});
    }
    void add_sail() { add_cloth("sail", {2, 1, 0}, {1, 0, 0}, {0, -1, 0}, 3, 3); }
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
    EXPECT_EQ(lab().state(reopened())["collisions"], state()["collisions"]);
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
    RopePart of_defaults;
    of_defaults.world = std::make_shared<NamedWorld>();
    EXPECT_TRUE(test::says(rope_code(of_defaults), "state.settings = {};"));
}

TEST_F(RopeCollisionTest, Refusals) {
    crossed();
    run("rope.hair.add", {{"name", "beard"}, {"centre", {0, 1, 0}}, {"radius", 0.1}});
    expect_refused("rope.collide", {{"a", "line"}, {"b", "beard"}, {"on", true}}, {"hair"});
    expect_refused("rope.collide", {{"a", "line"}, {"b", "none"}, {"on", true}}, {"none"});
    expect_refused("rope.collide", {{"a", "line"}, {"b", "other"}}, {"on"});
}

}  // namespace
}  // namespace tendril::app
