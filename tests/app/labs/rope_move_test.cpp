// Moving a rope, cloth or hair as a whole, and the placement of new ones.
#include <glm/geometric.hpp>

#include "app/labs/rope/panel.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeMove : public RopeTest {
  protected:
    RopeMove() {
        run("rope.clear");
        add_cloth("sheet", {0, 2, 0}, {1, 0, 0}, {0, -0.8, 0.6}, 6, 6, "corners");
        wait(20);
    }
    const rope::Body& body(const char* name) const { return *world().find(name); }
    /// Drags the gizmo by this offset.
    void drag(glm::vec3 by, Gesture gesture) {
        Handle handle = *lab().gizmo(workspace);
        handle.frame.position += by;
        emit([&](Emit& to) { lab().drag(workspace, handle.pick, handle.frame, to); }, gesture);
    }
};

TEST_F(RopeMove, ADoubleClickSelectsAllOfItAndItsArrowsMoveIt) {
    EXPECT_FALSE(lab().gizmo(workspace));
    const PickId pick = particle_pick(body("sheet").first + 14);
    emit([&](Emit& to) { lab().click(workspace, pick, to); });
    emit([&](Emit& to) { lab().double_click(workspace, pick, to); });
    EXPECT_EQ(state()["selected"]["particles"].size(), 36u);
    const auto gizmo = lab().gizmo(workspace);
    ASSERT_TRUE(gizmo);
    EXPECT_EQ(gizmo->name, "sheet");
    EXPECT_LT(glm::distance(gizmo->frame.position, glm::vec3(0.5f, 2, 0)), 1e-6f) << "between its pins";
    EXPECT_TRUE(lab().together(workspace, Drag::Position).handles.empty());
    EXPECT_EQ(lab().together(workspace, Drag::Rotation).handles.size(), 36u);
    const rope::State was = world().state();
    for (int i = 0; i < 10; ++i) drag({0.1f, 0, 0}, 7);
    emit([&](Emit& to) { lab().drop(workspace, gizmo->pick, to); }, 7);
    EXPECT_LT(glm::distance(world().state().position[20], was.position[20] + glm::dvec3(1, 0, 0)), 1e-5);
    EXPECT_EQ(world().state().displacement, was.displacement);
    run("undo");
    EXPECT_EQ(world().state().position, was.position) << "one step";
}

TEST_F(RopeMove, WithoutPinsItIsHeldUntilItIsDropped) {
    run("rope.add", {{"name", "line"}, {"from", {0, 1, 0}}, {"to", {1, 1, 0}}, {"segments", 4}});
    run("rope.select", {{"rope", "line"}});
    const PickId pick = lab().gizmo(workspace)->pick;
    drag({0, 0.5f, 0}, 7);
    wait(30);
    EXPECT_NEAR(world().position(body("line").first).y, 1.5f, 1e-5f);
    emit([&](Emit& to) { lab().drop(workspace, pick, to); }, 7);
    EXPECT_EQ(world().state().pins.size(), 2u);
    wait(10);
    EXPECT_LT(world().position(body("line").first).y, 1.49f);
}

TEST_F(RopeMove, TiesPullItBack) {
    run("rope.add", {{"name", "line"}, {"from", {0.5, 1, 0}}, {"to", {0.5, 0.5, 0}}, {"segments", 4}});
    run("rope.tie", {{"a", "sheet"}, {"a_particle", 33}, {"b", "line"}, {"b_particle", 0}});
    wait(120);
    const auto gap = [&] {
        const rope::Tie& tie = world().state().ties.at(0);
        return static_cast<double>(glm::distance(world().position(tie.a), world().position(tie.b)));
    };
    EXPECT_LT(gap(), 1e-5);
    run("rope.move", {{"rope", "line"}, {"by", {0.4, 0, 0}}});
    EXPECT_NEAR(gap(), 0.4, 1e-5);
    wait(3);
    EXPECT_NEAR(gap(), 0.3, 0.01) << "at 2 m/s";
}

TEST_F(RopeMove, IsInThePanel) {
    run("rope.select", {{"rope", "sheet"}});
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "particles 36 of 36 at x"));
    run("rope.select", {{"rope", "sheet"}, {"particle", 3}});
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "Select all"));
}

TEST_F(RopeMove, Refusals) {
    expect_refused("rope.move", {{"rope", "none"}, {"by", {1, 0, 0}}}, {"none"});
    expect_refused("rope.move", {{"rope", "sheet"}, {"by", {2e9, 0, 0}}}, {"1e9"});
    run("rope.preset", {{"name", "hair"}});
    expect_refused("rope.move", {{"rope", "hair"}, {"by", {1, 0, 0}}}, {"attached", "collider"});
}

/// Every kind that the panel adds, in every preset: it must neither overlap other things nor hide them.
TEST_F(RopeMove, ThereIsSpaceForAddedThings) {
    for (const char* preset : {"drape", "bridge", "curtain", "line"}) {
        run("rope.preset", {{"name", preset}});
        wait(30);
        const Space cloth{{-0.5f, -0.2f, -0.3f}, {0.5f, 0.8f, 0.3f}};
        const glm::vec3 at = free_place(workspace, cloth);
        const Space here = cloth.moved(at);
        for (std::size_t i = 0; i < world().size(); ++i) {
            const glm::vec3 particle = world().position(i);
            const bool inside =
                glm::all(glm::lessThan(here.low, particle)) && glm::all(glm::lessThan(particle, here.high));
            ASSERT_FALSE(inside) << preset << ", particle " << i;
        }
        EXPECT_LE(at.z, workspace.camera.target.z + 1e-4f) << preset;
        EXPECT_GT(glm::distance(at, workspace.camera.target), 0.3f) << preset;
    }
}

}  // namespace
}  // namespace tendril::app
