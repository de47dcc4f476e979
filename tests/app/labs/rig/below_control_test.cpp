// Bones below a control that is not at rest: a solve starts with the bones where the control has moved them,
// for commands, gizmos and ghosts alike.
#include "app/view/palette.hpp"
#include "rig_support.hpp"

namespace tendril::app {
namespace {

const glm::dvec3 arm_start(0, 2, -1), hand_start(0, 2, -2);

class RigBelowControl : public RigTest {
  protected:
    /// `mover` has moved up and turned by 90 degrees about y: its x axis is now -z. A unit moves the arm.
    RigBelowControl() {
        control("mover", "transform");
        element("arm", "mover", transform(1, 0, 0));
        element("hand", "arm", transform(1, 0, 0));
        unit({{"unit", "offset_transform"},
              {"name", "move on"},
              {"item", "arm"},
              {"offset", transform(0, 0.5, 0)}});
        const double half = std::sqrt(0.5);
        set("mover", {{"translation", {0, 2, 0}}, {"rotation", {0, half, 0, half}}});
        tick(2);
    }
    void set_global(const char* name, const Json& to) {
        run("rig.element.set", {{"name", name}, {"space", "global"}, {"transform", to}});
    }
    void switch_unit_off() {
        run("rig.unit.enable", {{"name", "move on"}, {"on", false}});
        tick();
    }
    void drag_to(const Handle& handle, glm::vec3 position) {
        HandleFrame to = handle.frame;
        to.position = position;
        Emit emit;
        lab().drag(workspace, handle.pick, to, emit);
        for (const Emitted& each : emit.take()) run(each.name.c_str(), *each.arguments);
    }
};

TEST_F(RigBelowControl, OmittedPartsOfAGlobalPoseStayWhereTheControlPutsThem) {
    set_global("arm", {{"rotation", {0, 0, 0, 1}}});
    switch_unit_off();
    expect_near(translation("arm"), arm_start);
    expect_near(translation("hand"), arm_start + glm::dvec3(1, 0, 0));
    EXPECT_NEAR(std::abs(rotation("arm").w), 1.0, 1e-12);
    set("mover", {{"translation", {0, 3, 0}}});
    tick();
    expect_near(translation("arm"), arm_start + glm::dvec3(0, 1, 0));  // it follows the control
}

TEST_F(RigBelowControl, TheGizmoIsWhereASolveStartsTheBone) {
    run("rig.select", {{"element", "arm"}});
    const auto gizmo = lab().gizmo(workspace);
    ASSERT_TRUE(gizmo);
    expect_near(glm::dvec3(gizmo->frame.position), arm_start, 1e-6);
    drag_to(*gizmo, gizmo->frame.position + glm::vec3(0, 0.25f, 0));
    switch_unit_off();
    expect_near(translation("arm"), arm_start + glm::dvec3(0, 0.25, 0), 1e-6);
}

/// A control in the space of another has its gizmo at its position, and follows the drag.
TEST_F(RigBelowControl, TheGizmoOfAControlThere) {
    control("grip", "transform", {{"space", "hand"}, {"local", transform(1, 0, 0)}});
    tick();
    run("rig.select", {{"element", "grip"}});
    const auto gizmo = lab().gizmo(workspace);
    ASSERT_TRUE(gizmo);
    const glm::dvec3 is = translation("grip");
    expect_near(is, hand_start + glm::dvec3(0, 0.5, -1), 1e-6);
    expect_near(glm::dvec3(gizmo->frame.position), is, 1e-6);
    drag_to(*gizmo, {1, 1, 1});
    tick();
    expect_near(translation("grip"), {1, 1, 1}, 1e-6);
}

TEST_F(RigBelowControl, GhostsShowThePoseThatASolveStartsWith) {
    run("rig.select", {{"element", "arm"}});
    const Camera camera({}, {{0.0f, 0.0f}, {800.0f, 600.0f}});
    const Palette& colours = palette(Theme::Dark);
    DrawList list;
    lab().draw({.workspace = workspace, .camera = camera, .palette = colours}, list);
    std::size_t arms = 0, hands = 0;
    for (const Stroke& each : list.strokes) {
        if (glm::vec3(each.colour) != colours.ghost) continue;
        const bool at_arm = glm::distance(glm::dvec3(each.a), arm_start) < 1e-5;
        const bool at_hand = glm::distance(glm::dvec3(each.b), hand_start) < 1e-5;
        EXPECT_TRUE(at_arm || at_hand) << each.a.x << ' ' << each.a.y << ' ' << each.a.z;
        arms += at_arm;
        hands += at_hand;
    }
    EXPECT_GE(arms, 2u) << "its joint, and the bone to the hand";
    EXPECT_GE(hands, 2u);
}

}  // namespace
}  // namespace tendril::app
