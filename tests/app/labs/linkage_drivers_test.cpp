// Drivers, motors, ranges and drags of a linkage: its goals, through edits, undo and files.
#include <glm/geometric.hpp>

#include "tests/app/labs/linkage_support.hpp"

namespace tendril::app {
namespace {

class LinkageDrivers : public LinkageTest {};

TEST_F(LinkageDrivers, AFarValueIsReachedInTime) {
    four_bar();
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 100000}});
    wait_while_moving(60);
    EXPECT_FALSE(lab().moving(workspace));
    EXPECT_NEAR(driver("crank"), 100000.0, 1e-3);
    EXPECT_EQ(state().at("status"), "Reached");
}

TEST_F(LinkageDrivers, ADriverHeldAtADeadPointContinuesOnceLengthsAllow) {
    four_bar();
    run("linkage.set", {{"crank", 2.2}});
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 170}});
    EXPECT_EQ(state().at("status"), "DeadPoint");
    const auto loaded = part().load(part().save(), "labs.linkage");
    EXPECT_EQ(loaded->save(), part().save());
    run("linkage.set", {{"crank", 1.0}});
    EXPECT_NEAR(driver("crank"), 170.0, 1e-6);
}

TEST_F(LinkageDrivers, AHingesMotorTakesDegrees) {
    four_bar();
    expect_refused("linkage.motor", {{"joint", "crank"}, {"per_s", 1.0}}, {"crank", "hinge", "deg_per_s"});
    run("linkage.motor", {{"joint", "crank"}, {"deg_per_s", 3600}});
    EXPECT_EQ(opened_with("", saved()), "");
    expect_scene_refused("/drivers/0/rate", 63.0, "labs.linkage.drivers.0.rate");
    expect_scene_refused("/result/report/freedom", -1, "labs.linkage.result.report.freedom");
    const Json before = state().at("gruebler");
    Json scene = save_scene(workspace);
    scene["labs"]["linkage"]["result"]["freedom"]["counted"] = -7;
    load_scene(workspace, scene);
    EXPECT_EQ(state().at("gruebler"), before) << "it is counted again";
}

TEST_F(LinkageDrivers, ADriverEndsADrag) {
    four_bar();
    run("linkage.drag", {{"point", "B"}, {"to", {0, 5, 0}}}, 1);
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 30}});
    EXPECT_NEAR(driver("crank"), 30.0, 1e-6);
    EXPECT_FALSE(part().drag);
}

TEST_F(LinkageDrivers, ARangeStopsAHingeAndASlider) {
    four_bar();
    run("linkage.range", {{"joint", "crank"}, {"min", -10}, {"max", 60}});
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 100}});
    EXPECT_NEAR(driver("crank"), 60.0, 1e-6);
    EXPECT_EQ(state().at("status"), "Limited");
    EXPECT_EQ(part().load(part().save(), "labs.linkage")->save(), part().save());
    run("linkage.set", {{"rocker", 2.1}});
    EXPECT_NEAR(driver("crank"), 60.0, 1e-6) << "a length keeps the range";
    run("linkage.range", {{"joint", "crank"}, {"off", true}});
    EXPECT_NEAR(driver("crank"), 100.0, 1e-6) << "and goes on to where it was driven";
    expect_refused("linkage.range", {{"joint", "crank"}, {"min", 20}, {"max", 10}}, {"20", "10"});
    run("linkage.preset", {{"name", "slider_crank"}});
    const double slid = at("S").x;
    run("linkage.range", {{"joint", "S"}, {"min", slid - 0.1}});
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 180}});
    EXPECT_NEAR(at("S").x, slid - 0.1, 1e-6);
    EXPECT_EQ(state().at("status"), "Limited");
}

TEST_F(LinkageDrivers, AWalkerIsDrivenByItsMotorWhateverElseAFileDrives) {
    run("linkage.preset", {{"name", "walker"}});
    run("linkage.drive", {{"joint", "motor"}, {"angle_deg", 40}});
    Json file = part().save();
    std::string other;
    for (const ik::Link& each : part().linkage().links)
        if (each.name != "motor" && each.joint == ik::LinkJoint::Hinge) other = each.name;
    const Json extra{{"joint", other}, {"value", 0.0}, {"rate", 0.0}, {"held", false}};
    file["drivers"].insert(file["drivers"].begin(), extra);
    const auto loaded = part().load(file, "labs.linkage");
    LinkagePart solved = dynamic_cast<const LinkagePart&>(*loaded);
    LinkageRuntime runtime;
    solve_linkage(solved, runtime);
    const std::size_t foot = *solved.linkage().find_point("foot");
    for (std::size_t i = 0; i < solved.copies.size(); ++i)
        EXPECT_LT(glm::distance(solved.at(foot, solved.copies[i]), part().at(foot, part().copies[i])), 1e-6)
            << i;
    for (const Json& drivers : {Json::array({extra}), Json::array()})
        EXPECT_TRUE(test::says(opened_with("/drivers", drivers), "labs.linkage.drivers walker motor"));
}

TEST_F(LinkageDrivers, AJointDrivenWithoutAMotorStaysSo) {
    four_bar();
    run("linkage.release", {{"joint", "crank"}});
    run("linkage.drive", {{"joint", "rocker"}, {"angle_deg", driver("crank") + 100.0}});
    const double held = driver("rocker");
    run("linkage.range", {{"joint", "crank"}, {"min", -300}});
    ASSERT_EQ(state().at("drivers").size(), 2u);
    EXPECT_NEAR(driver("rocker"), held, 1e-6);
    EXPECT_TRUE(part().find_drive("rocker")->held);
    run("linkage.motor.remove", {{"joint", "crank"}});
    EXPECT_EQ(part().find_drive("crank"), nullptr) << "its driver goes with the motor";
    EXPECT_NE(part().find_drive("rocker"), nullptr);
    run("linkage.preset", {{"name", "four_bar"}});
    EXPECT_EQ(part().find_drive("rocker"), nullptr) << "another linkage";
}

TEST_F(LinkageDrivers, AnEndedDragLeavesNoReport) {
    four_bar();
    run("linkage.target", {{"point", "C"}, {"to", {2, 2, 0}}});
    run("linkage.drag", {{"point", "B"}, {"to", {0, 5, 0}}}, 1);
    LinkagePart pulled = part();
    pulled.result.report.jumped = 0;
    ASSERT_EQ(pulled.result.report.status, ik::LinkageStatus::TargetMissed);
    pulled.targets.clear();
    for (const auto& then : {pulled.after_undo(), pulled.at_moment(pulled.clone())}) {
        const auto& is = dynamic_cast<const LinkagePart&>(*then);
        EXPECT_FALSE(is.drag);
        EXPECT_EQ(is.state, pulled.state) << "the pose stays";
        EXPECT_EQ(is.result.report.status, ik::LinkageStatus::Reached);
        EXPECT_FALSE(is.result.report.jumped);
    }
}

}  // namespace
}  // namespace tendril::app
