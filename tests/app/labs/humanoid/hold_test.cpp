// Hands that hold an object, by the lab's commands and --state.
#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/humanoid/hold/hold.hpp"
#include "humanoid_support.hpp"

namespace tendril::app {
namespace {

class HumanoidHold : public HumanoidTest {
  protected:
    Json hold() const { return state().at("hold"); }
    double number(const char* name) const { return hold().at(name).get<double>(); }
    std::string text() const { return hold().at("text").get<std::string>(); }
    void ask(double x, double y, double z) { run("humanoid.hold_move", {{"to", {x, y, z}}}); }
};

TEST_F(HumanoidHold, PutsBothHandsOnEachObject) {
    for (const char* kind : {"wheel", "rifle", "box"}) {
        run("humanoid.hold", {{"kind", kind}});
        EXPECT_EQ(hold().at("kind"), kind);
        EXPECT_TRUE(hold().at("closed").get<bool>()) << kind;
        EXPECT_LT(number("moved"), 0.002) << kind;
        EXPECT_LT(number("turned_deg"), 1.0) << kind;
        EXPECT_EQ(state().at("verdict"), std::string("Holds the ") + kind);
    }
}

TEST_F(HumanoidHold, GivesWayOutOfReachAndSaysWhy) {
    run("humanoid.hold");
    const glm::dvec3 start = vector(hold().at("position"));
    ask(start.x, start.y, start.z + 2.0);
    EXPECT_TRUE(hold().at("closed").get<bool>());
    EXPECT_GT(number("moved"), 0.5);
    EXPECT_NE(text().find("The wheel gives way by"), std::string::npos) << text();
    EXPECT_NE(hold().at("why").get<std::string>().find("straight"), std::string::npos) << hold();
    EXPECT_EQ(state().at("verdict"), text());
    const Json held = hold();
    run("undo");
    EXPECT_LT(number("moved"), 0.002);
    run("redo");
    EXPECT_EQ(hold(), held);
}

TEST_F(HumanoidHold, HandsFollowTheTurnedWheel) {
    run("humanoid.hold");
    const glm::dvec3 left = bone("LeftHand");
    const glm::dquat turn = glm::angleAxis(glm::radians(60.0), glm::dvec3(0, 0, 1));
    run("humanoid.hold_move", {{"rotation", {turn.x, turn.y, turn.z, turn.w}}});
    EXPECT_TRUE(hold().at("closed").get<bool>());
    EXPECT_LT(number("turned_deg"), 5.0);
    EXPECT_GT(bone("LeftHand").y, left.y + 0.1);
}

TEST_F(HumanoidHold, ReleasesAndRefusesByName) {
    run("humanoid.target", {{"effector", "left_hand"}});
    run("humanoid.hold", {{"hands", "left"}});
    EXPECT_FALSE(part().ik.target(humanoid::Effector::LeftHand)) << "the grip takes its place";
    EXPECT_EQ(hold().at("grips").size(), 1u);
    EXPECT_NE(refused("humanoid.target", {{"effector", "left_hand"}}).find("left_hand holds the wheel"),
              std::string::npos);
    run("humanoid.target", {{"effector", "right_hand"}});
    run("humanoid.hold", {{"hands", "right"}});
    run("humanoid.target", {{"effector", "left_hand"}});
    run("humanoid.release");
    EXPECT_TRUE(hold().is_null());
    EXPECT_NE(refused("humanoid.release").find("hold nothing"), std::string::npos);
    EXPECT_NE(refused("humanoid.hold_move", {{"to", {0, 1, 1}}}).find("humanoid.hold"), std::string::npos);
    EXPECT_NE(refused("humanoid.hold", {{"kind", "sword"}}).find("sword"), std::string::npos);
    EXPECT_NE(refused("humanoid.hold", {{"size", 0.0}}).find("size"), std::string::npos);
}

TEST_F(HumanoidHold, IsSavedWithWhatItRemembers) {
    run("humanoid.hold", {{"kind", "box"}, {"size", 1.3}});
    ask(0.3, 1.1, 0.8);
    const Workspace other = reopened();
    EXPECT_EQ(lab().state(other).at("hold"), hold());
    EXPECT_EQ(humanoid_part(other), part());
    Json scene = save_scene(workspace);
    scene["labs"]["humanoid"]["ik"]["hold"]["size"] = -1;
    Workspace bad = make_blank_workspace(labs);
    try {
        load_scene(bad, scene);
        ADD_FAILURE() << "a negative size was read";
    } catch (const std::exception& error) {
        EXPECT_NE(std::string(error.what()).find("hold.size"), std::string::npos) << error.what();
    }
}

/// The object goes on with a character that walks away, and the feet walk.
TEST_F(HumanoidHold, GoesAlongWhileWalking) {
    run("humanoid.hold", {{"kind", "box"}});
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    const double start = bone("Hips").z, foot = bone("LeftFoot").z, object = vector(hold().at("position")).z;
    for (int i = 0; i < 90; ++i) {
        tick();
        ASSERT_TRUE(hold().at("closed").get<bool>()) << i;
        EXPECT_FALSE(hold().at("jumped").get<bool>()) << i;
    }
    const double way = bone("Hips").z - start;
    EXPECT_GT(way, 0.8);
    EXPECT_NE(bone("LeftFoot").z, foot);
    EXPECT_NEAR(vector(hold().at("position")).z - object, way, 0.25);
}

TEST_F(HumanoidHold, IsDraggedByItsHandle) {
    run("humanoid.hold");
    const auto handles = lab().handles(workspace);
    const auto found =
        std::ranges::find_if(handles, [](const Handle& each) { return each.pick == hold_pick; });
    ASSERT_NE(found, handles.end());
    EXPECT_EQ(lab().gizmo(workspace)->pick, hold_pick);
    EXPECT_EQ(std::ranges::count_if(handles, [](const Handle& each) { return each.name == "left_hand"; }), 0);
}

}  // namespace
}  // namespace tendril::app
