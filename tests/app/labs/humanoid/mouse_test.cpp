// The mouse in the Humanoid lab, in the running program: real events, with picking.
#include <fstream>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/app/labs/app_support.hpp"
#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::test {
namespace {

using namespace app;

class HumanoidMouse : public LabAppTest {
  protected:
    HumanoidMouse() : LabAppTest(humanoid_lab, true, {1280, 800}) {}
    Json bones() { return app_.state().at("character").at("bones"); }
    Json targets() { return app_.state().at("body").at("targets"); }
};

TEST_F(HumanoidMouse, ClicksMapOneUnmappedBoneAfterAnother) {
    for (const char* bone : {"LeftHand", "RightHand", "LeftToes"}) run("humanoid.map", {{"bone", bone}});
    auto& waiting = humanoid_runtime(app_.workspace()).panel.bone;
    waiting = humanoid::Bone::LeftHand;
    click(at("node.LeftHand"));
    EXPECT_EQ(waiting, humanoid::Bone::RightHand) << "the next one in the list";
    click(at("node.RightHand"));
    EXPECT_EQ(waiting, humanoid::Bone::LeftToes);
    click(at("node.LeftToes"));
    EXPECT_FALSE(waiting) << "nothing is unmapped any more";
    EXPECT_EQ(bones().at("RightHand").at("node"), "RightHand");
    EXPECT_EQ(bones().at("LeftToes").at("node"), "LeftToes");
    EXPECT_EQ(app_.state().at("selected"), "LeftToes");
}

TEST_F(HumanoidMouse, DragsAnEffectorToATarget) {
    const glm::vec2 from = at("left_hand");
    drag_by(from, {-80, -60});
    const Json state = app_.state();
    EXPECT_LT(glm::distance(handle(state, "left_hand"), from + glm::vec2(-80, -60)), 2.0f);
    EXPECT_LT(glm::distance(handle(state, "node.LeftHand"), from + glm::vec2(-80, -60)), 2.0f) << "reached";
    EXPECT_TRUE(state.at("body").at("targets").at("left_hand").at("rotation").is_null());
    run("undo");
    EXPECT_TRUE(targets().empty()) << "a drag is one step";
    run("redo");
    click(at("left_hand"));
    press(true), press(false);
    EXPECT_TRUE(targets().empty()) << "a double click releases it";
}

TEST_F(HumanoidMouse, TurnsASelectedEffectorByItsGizmo) {
    run("humanoid.select", {{"node", "Head"}});
    drag_by(at("head.rotate_z"), {0, 60});
    const Json target = targets().at("head");
    ASSERT_FALSE(target.at("rotation").is_null());
    EXPECT_GT(std::abs(target.at("rotation")[2].get<double>()), 0.05);
}

TEST_F(HumanoidMouse, DragsSeveralEffectorsByOneGizmo) {
    run("humanoid.select", {{"nodes", {"LeftHand", "Spine", "RightHand"}}});
    const Json before = bones();
    const std::size_t history = steps();
    drag_by(at("right_hand.move_y"), {0, -30});
    const auto target = [&](const char* name) { return targets().at(name); };
    const auto moved = [&](const char* name, const char* bone, std::size_t axis) {
        return target(name).at("position")[axis].get<double>() -
               before.at(bone).at("position")[axis].get<double>();
    };
    const double along = moved("right_hand", "RightHand", 0), up = moved("right_hand", "RightHand", 1);
    EXPECT_GT(std::hypot(along, up), 0.03);
    EXPECT_NEAR(moved("left_hand", "LeftHand", 0), along, 1e-5) << "the same way";
    EXPECT_NEAR(moved("left_hand", "LeftHand", 1), up, 1e-5);
    EXPECT_TRUE(target("left_hand").at("rotation").is_null());
    EXPECT_EQ(targets().size(), 2u);
    EXPECT_EQ(steps(), history + 1);
    const Lab& lab = *app_.labs().find(humanoid_lab);
    EXPECT_TRUE(test::says(lab.together(app_.workspace(), Drag::Position).staying, "effectors Spine"));
    const Json right = target("right_hand").at("position"), left = target("left_hand").at("position");
    drag_by(at("right_hand.rotate_z"), {0, 40});
    EXPECT_FALSE(target("left_hand").at("rotation").is_null());
    EXPECT_EQ(target("right_hand").at("position"), right) << "it stands on the one selected last";
    EXPECT_NE(target("left_hand").at("position"), left) << "which the other goes round";
    run("undo");
    run("undo");
    EXPECT_TRUE(targets().empty());
}

/// Panel sections keep their height while the mouse is over them, but not for another character.
TEST_F(HumanoidMouse, OverThePanelDoesNotKeepTheOldCharactersRows) {
    const TempFolder folder;
    const std::string path = (folder / "figure.bvh").string();
    std::ofstream(path) << bvh_figure("RightArm");
    FrameRecorder recorder;
    const auto height = [&](const char* section) {
        app_.tick(nullptr);
        for (const DrawnText& each : recorder.frame().texts)
            if (each.text == section && each.box.min.x < 100.0f) return each.box.min.y;
        ADD_FAILURE() << "there is no section " << section;
        return 0.0f;
    };
    send(MouseMove{{130.0f, 300.0f}});
    EXPECT_GT(height("Bones"), height("Clip"));
    send(Drop{{path}});
    app_.tick(nullptr);
    EXPECT_LT(height("Bones"), 100.0f) << "it comes first";
}

class HumanoidPanels : public HumanoidTest {
  protected:
    test::PanelReader reader_;
};

TEST_F(HumanoidPanels, SayWhatIsMissing) {
    run("humanoid.map", {{"bone", "LeftHand"}});
    run("humanoid.map", {{"bone", "RightHand"}});
    const std::string text = reader_.panel(lab(), workspace);
    EXPECT_TRUE(test::says(text, "off LeftHand RightHand"));
    run("humanoid.select", {{"node", "LeftHand"}});
    const std::string inspector = reader_.inspector(lab(), workspace);
    for (const char* says : {"Incomplete body", "LeftHand", "none", "LeftLowerArm"})
        EXPECT_TRUE(has(inspector, says));
}

}  // namespace
}  // namespace tendril::test
