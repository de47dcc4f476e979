// The Linkage lab: presets, drawing by hand, drags, motors, files, refusals.
#include <glm/trigonometric.hpp>

#include "app/labs/kit/past.hpp"
#include "app/view/camera.hpp"
#include "app/widgets/emit.hpp"
#include "tests/app/labs/linkage_support.hpp"
#include "tests/app/support/random_numbers.hpp"

namespace tendril::app {
namespace {

TEST_F(LinkageTest, StateIsAsSpecified) {
    const Json now = state();
    EXPECT_EQ(now.at("lab"), "linkage");
    EXPECT_EQ(now.at("gruebler"), 1);
    EXPECT_EQ(now.at("active"), Json::array());
    EXPECT_EQ(now.at("mechanism").at("name"), "four_bar");
    draw_four_bar();
    run("linkage.guide", {{"point", "D"}, {"angle_deg", 30}});
    EXPECT_NE(state().at("sketch").dump().find("\"guide_deg\":30.0"), std::string::npos);
}

TEST_F(LinkageTest, ALengthChangesAndTheHeldCrankStays) {
    four_bar();
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 400}});
    run("linkage.set", {{"crank", 0.9}, {"coupler_point", {1, -0.5}}});
    EXPECT_NEAR(driver("crank"), 400.0, 1e-6) << "its turns are counted";
    EXPECT_NEAR(glm::length(at("B")), 0.9, 1e-9);
    EXPECT_NEAR(glm::distance(at("B"), at("P")), std::hypot(1.0, 0.5), 1e-8);
}

TEST_F(LinkageTest, TwelveLegsWalkOnTheirFeet) {
    run("linkage.preset", {{"name", "walker"}});
    run("linkage.motor", {{"joint", "motor"}, {"deg_per_s", 90}});
    ASSERT_EQ(part().copies.size(), 11u);
    double walked = 0.0, highest = -1e9, lowest = 1e9;
    for (int i = 0; i < 240; ++i) {
        wait(1);
        highest = std::max(highest, part().lowest_foot());
        lowest = std::min(lowest, part().lowest_foot());
        EXPECT_LT(std::abs(part().walked - walked), 0.05) << "no leg jumps";
        walked = part().walked;
    }
    EXPECT_GT(std::abs(walked), 1.0) << "one turn";
    EXPECT_LT(highest - lowest, 0.1) << "it hardly bobs";
}

TEST_F(LinkageTest, ADraggedJointTakesTheCrankAlong) {
    four_bar();
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 30}});
    run("linkage.drag", {{"point", "B"}, {"to", {0, 5, 0}}}, 1);
    run("linkage.let_go", {}, 1);
    EXPECT_NEAR(driver("crank"), 90.0, 1e-3);
    EXPECT_NEAR(at("B").y, 1.0, 1e-6);
    EXPECT_FALSE(part().drag);
    run("undo");
    EXPECT_NEAR(driver("crank"), 30.0, 1e-6) << "a drag is one step";
}

TEST_F(LinkageTest, TheLibrarysMechanismsHaveTheirNamedLengths) {
    for (const MechanismKind& kind : mechanism_kinds()) {
        run("linkage.preset", {{"name", kind.name}});
        EXPECT_EQ(state().at("status"), "Reached") << kind.name;
        const std::shared_ptr<Part> reopened = part().load(part().save(), "labs.linkage");
        EXPECT_EQ(linkage_state(dynamic_cast<const LinkagePart&>(*reopened)), linkage_state(part()))
            << kind.name;
        EXPECT_LT(state().at("closed_to").get<double>(), 1e-6) << kind.name;
        EXPECT_TRUE(*kind.traced == '\0' || state().at("points").contains(kind.traced)) << kind.name;
        const std::string maker = kind.name == std::string("walker") ? "jansen" : kind.name;
        EXPECT_TRUE(test::says(lab().code(workspace), "ik::" + maker + "({")) << lab().code(workspace);
    }
    EXPECT_EQ(state().at("drivers").size(), 6u) << "a Stewart platform has six legs";
}

TEST_F(LinkageTest, AMotorStopsAtADeadPointAndSaysWhy) {
    four_bar();
    run("linkage.set", {{"crank", 2.2}});
    run("linkage.motor", {{"joint", "crank"}, {"deg_per_s", 90}});
    SharedPart before;
    for (int i = 0; i < 240 && lab().moving(workspace); ++i) {
        before = workspace.document.parts().at(linkage_lab);
        wait(1);
    }
    EXPECT_FALSE(lab().moving(workspace)) << "the window may idle";
    EXPECT_EQ(state().at("status"), "DeadPoint");
    const auto incidents = lab().review(workspace, *before, part());
    ASSERT_EQ(incidents.size(), 1u);
    EXPECT_EQ(incidents[0].name, "crank");
    EXPECT_TRUE(test::says(incidents[0].cause, "crank is at a dead point B, C and D are in line"));
    // 2.5 + 2 against 2.2 and 3: the law of cosines.
    const double limit = glm::degrees(std::acos((2.2 * 2.2 + 9.0 - 4.5 * 4.5) / (2.0 * 2.2 * 3.0)));
    EXPECT_NEAR(incidents[0].degrees, limit, 0.1);
    EXPECT_EQ(incidents[0].buttons.size(), 3u);
}

TEST_F(LinkageTest, ADragThroughADeadPointIsAnIncident) {
    four_bar();
    run("linkage.set", {{"crank", 2.2}});
    std::vector<Incident> all;
    for (int angle = 100; angle < 290; angle += 4) {
        const double at = glm::radians(static_cast<double>(angle));
        const Json to{3 + 2 * std::cos(at), 2 * std::sin(at), 0};
        for (const Incident& each : incidents_of("linkage.drag", {{"point", "C"}, {"to", to}}, 1))
            all.push_back(each);
    }
    ASSERT_EQ(all.size(), 1u);
    EXPECT_TRUE(test::says(all[0].cause, "passed a dead point B, C and D are in line"));
}

// The path of P bends round the target: the nearest point vanishes, and P jumps to the other side.
TEST_F(LinkageTest, ADragAcrossAPathIsAnIncidentWhereThePointJumps) {
    four_bar();
    run("linkage.drag", {{"point", "P"}, {"to", {-1.5, 1.4, 0}}}, 1);
    std::vector<Incident> all;
    for (int i = 1; i <= 90; ++i) {
        const glm::dvec3 was = at("P");
        const std::vector<Incident> now =
            incidents_of("linkage.drag", {{"point", "P"}, {"to", {-1.5 + 0.05 * i, 1.4, 0}}}, 1);
        EXPECT_EQ(now.empty(), glm::distance(at("P"), was) < 0.5) << i;
        EXPECT_EQ(state().at("jumped").is_null(), now.empty()) << i;
        for (const Incident& each : now) all.push_back(each);
        const SharedPart same = workspace.document.parts().at(linkage_lab);
        EXPECT_TRUE(lab().review(workspace, *same, part()).empty()) << "told once";
    }
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].kind, Incident::Kind::Jump);
    EXPECT_EQ(all[0].name, "P");
    EXPECT_TRUE(test::says(all[0].cause, "P jumped mm no longer the nearest moved 50.0 mm"));
    // The same distance in one move, from the target's old position, is not a jump.
    run("linkage.let_go");
    EXPECT_TRUE(incidents_of("linkage.drag", {{"point", "P"}, {"to", {-1.5, 1.4, 0}}}, 1).empty());
}

TEST_F(LinkageTest, ErrorsAreReportedByNameAndNothingIsLost) {
    four_bar();
    expect_refused("linkage.set", {{"lengths", {{"cranc", 1}}}}, {"cranc"});
    expect_refused("linkage.set", {{"lengths", {{"coupler_point", {1}}}}}, {"coupler_point"});
    expect_refused("linkage.set", {{"crank", 100}}, {"crank", "100"});
    expect_refused("linkage.drive", {{"joint", "nobody"}, {"angle_deg", 1}}, {"nobody"});
    expect_refused("linkage.drive", {{"joint", "crank"}}, {"angle_deg"});
    expect_refused("linkage.target", {{"point", "X"}, {"to", {0, 0, 0}}}, {"X"});
    expect_refused("linkage.bar", {{"from", "B"}, {"to", "B"}}, {"different"});
    expect_refused("linkage.bar", {{"from", "B"}, {"to", "C"}}, {"B", "C", "already"});
    expect_refused("linkage.bar", {{"from", "B"}, {"to", {1, 2}}}, {"to"});
    expect_refused("linkage.motor.add", {{"point", "P"}}, {"P", "not pinned", "second bar"});
    expect_refused("linkage.remove", {{"bar", "bar 9"}}, {"bar 9"});
    run("linkage.preset", {{"name", "delta"}});
    expect_refused("linkage.joint", {{"at", {0, 0, 0}}}, {"plane"});
}

TEST_F(LinkageTest, ChangedLengthsKeepPoseAndAssemblyMode) {
    four_bar();
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 90}});
    run("linkage.other_mode");
    run("linkage.release", {{"joint", "crank"}});
    const glm::dvec3 before = at("C");
    run("linkage.set", {{"rocker", 2.01}});
    EXPECT_LT(glm::distance(at("C"), before), 0.05);
    EXPECT_NEAR(driver("crank"), 90.0, 2.0);
    run("linkage.preset", {{"name", "stewart"}});
    run("linkage.target", {{"point", "platform"}, {"to", {0.1, 0.05, at("platform").z + 0.05}}});
    run("linkage.target.remove", {{"point", "platform"}});
    const glm::dvec3 platform = at("platform");
    run("linkage.set", {{"platform_radius", part().shape->mechanism.index() == 9 ? 0.501 : 0.5}});
    EXPECT_LT(glm::distance(at("platform"), platform), 0.08);
}

TEST_F(LinkageTest, ADeadPointWithoutDriverIsReportedToo) {
    LinkagePart stuck = part();
    stuck.result.report.status = ik::LinkageStatus::DeadPoint;
    stuck.result.report.stopped.reset();
    EXPECT_EQ(linkage_verdict(stuck, runtime()).text, "Dead point");
}

TEST_F(LinkageTest, AllLegsOfAWalkerChangeTheirMode) {
    run("linkage.preset", {{"name", "walker"}});
    const auto height = [&] { return part().at(*part().linkage().find_point("foot"), part().copies[4]).y; };
    const double before = height();
    run("linkage.other_mode");
    EXPECT_GT(std::abs(height() - before), 0.01);
    // A leg one whole turn further is the leg itself.
    const LinkageCopy& opposite = part().copies[5];
    EXPECT_NEAR(opposite.phase, glm::radians(180.0), 1e-9);
    const double foot = part().at(*part().linkage().find_point("foot"), opposite).y;
    run("linkage.drive", {{"joint", "motor"}, {"angle_deg", driver("motor") + 180.0}});
    EXPECT_NEAR(at("foot").y, foot, 1e-6);
}

TEST_F(LinkageTest, AStrokeOverAWalkerStartsWhereItIsDrawn) {
    run("linkage.preset", {{"name", "walker"}});
    const double ground = part().lowest_foot();
    ASSERT_LT(ground, -0.1);
    const Camera camera({.distance = 12.0f, .orthographic = true}, {{0, 0}, {800, 600}});
    Emit emit;
    lab().stroke(workspace, 0, camera, {100, 100}, {100, 100}, emit);
    const auto emitted = emit.take();
    ASSERT_FALSE(emitted.empty());
    const glm::vec3 drawn = *camera.on_plane({100, 100}, glm::vec3(0.0f), {0, 0, 1});
    const Json place = (*emitted[0].arguments).at("at");
    EXPECT_NEAR(place[1].get<double>(), drawn.y + ground, 1e-5);
    workspace.ui.toasts.clear();
    run("linkage.joint", {{"at", place}});
    tells("drawn by hand");
}

/// Distance between the kept path and the present mode's path, metres.
double path_error(LinkageRuntime& kept, const LinkagePart& part) {
    const std::vector<PathPoint> shown = kept.path(part);
    LinkageRuntime fresh;
    double error = 0.0;
    for (const PathPoint& each : fresh.path(part)) {
        double nearest = 1e9;
        for (const PathPoint& other : shown) nearest = std::min(nearest, glm::distance(each.at, other.at));
        error = std::max(error, nearest);
    }
    return error;
}

TEST_F(LinkageTest, EachAssemblyModeHasItsOwnPath) {
    four_bar();
    run("linkage.select", {{"point", "P"}});
    LinkageRuntime kept;
    for (int angle = 0; angle < 360; angle += 15) {
        run("linkage.drive", {{"joint", "crank"}, {"angle_deg", angle}});
        run("linkage.other_mode");
        ASSERT_LT(path_error(kept, part()), 0.2) << angle;
    }
}

/// If a turn has two ends, poses between them are not on it.
TEST_F(LinkageTest, EachModeOfARockerHasItsOwnPath) {
    test::RandomNumbers random(5);
    int swings = 0;
    for (int i = 0; i < 120; ++i) {
        const auto length = [&] { return random.uniform(1.0, 3.0); };
        LinkageRuntime kept;
        const auto drawn =
            opened({.ground = length(), .crank = length(), .coupler = length(), .rocker = length()}, kept);
        if (!drawn) continue;
        const LinkageTurn& turn = kept.turn(*drawn);
        if (turn.poses.size() < 10 || turn.whole) continue;
        workspace.document.set(linkage_lab, drawn->clone());
        for (const double share : {0.2, 0.5, 0.8}) {
            const double at = std::lerp(turn.poses.front().value, turn.poses.back().value, share);
            run("linkage.drive", {{"joint", "crank"}, {"angle_deg", glm::degrees(at)}});
            run("linkage.other_mode");
            EXPECT_LT(path_error(kept, part()), 0.5) << i << " " << share;
        }
        ++swings;
    }
    EXPECT_GT(swings, 20);
}

TEST_F(LinkageTest, APinOfAPresetIsNotDraggedByAccident) {
    four_bar();
    Emit emit;
    const auto& points = part().linkage().points;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i].link == ik::ground_link)
            lab().drag(workspace, static_cast<PickId>(i), {glm::vec3(1.0f)}, emit);
    EXPECT_TRUE(emit.take().empty());
}

TEST_F(LinkageTest, CodeHasPoseModeAndLegs) {
    four_bar();
    run("linkage.other_mode");
    run("linkage.range", {{"joint", "crank"}, {"max", 90}});
    const std::string code = lab().code(workspace);
    EXPECT_TRUE(test::says(code, "links[0] maximum initial_state state joints value"));
    EXPECT_TRUE(test::says(code, "crank frame 60.0 *")) << "a motor at rest runs";
    run("linkage.preset", {{"name", "walker"}});
    EXPECT_TRUE(test::says(lab().code(workspace), "One of the twelve legs"));
}

TEST_F(LinkageTest, NamesAreUnique) {
    draw_four_bar();
    run("linkage.bar", {{"from", {0, -1, 0}}, {"to", {1, -1, 0}}, {"name", "CG"}});
    run("linkage.bar", {{"from", {3, 3, 0}}, {"to", "C"}});
    EXPECT_EQ(part().shape->sketch.bars.back().name, "CG 1");
    run("linkage.joint", {{"at", {2, 5, 0}}, {"name", "foot"}});
    run("linkage.bar", {{"from", "foot"}, {"to", "C"}});
    EXPECT_EQ(part().shape->sketch.bars.back().name, "C-foot");
    draw_four_bar();
    expect_refused("linkage.bar", {{"from", "A"}, {"to", {-1, 0, 0}}, {"name", "motor 1"}}, {"motor 1"});
    run("linkage.guide", {{"point", "D"}});
    expect_refused("linkage.bar", {{"from", "A"}, {"to", {-1, 0, 0}}, {"name", "D"}}, {"D"});
    expect_scene_refused("/sketch/bars/1/name", "AB", "labs.linkage.sketch.bars.1.name");
}

TEST_F(LinkageTest, ABarsLengthKeepsTheOthers) {
    draw_four_bar();
    const double crank = glm::distance(at("A"), at("B")), rocker = glm::distance(at("C"), at("D"));
    run("linkage.length", {{"bar", "BC"}, {"length", 2.5}});
    EXPECT_NEAR(glm::distance(at("B"), at("C")), 2.5, 1e-6);
    EXPECT_NEAR(glm::distance(at("A"), at("B")), crank, 1e-6);
    EXPECT_NEAR(glm::distance(at("C"), at("D")), rocker, 1e-6);
    EXPECT_EQ(at("D"), glm::dvec3(3, 0, 0));
    expect_refused("linkage.length", {{"bar", "BC"}, {"length", 9}}, {"BC", "9"});
}

TEST_F(LinkageTest, BarsWithoutSupportWaitForPins) {
    run("linkage.clear");
    EXPECT_EQ(state().at("verdict"), "Draw a bar");
    EXPECT_EQ(state().at("tool"), "draw") << "an empty lab is there to be drawn in";
    EXPECT_EQ(linkage_verdict(part(), runtime()).why, "Drag from one place to another in the view.");
    run("linkage.bar", {{"from", {0, 0, 0}}, {"to", {0, 1, 0}}});
    EXPECT_EQ(state().at("verdict"), "Nothing holds it");
    EXPECT_TRUE(test::says(lab().invitation(workspace), "Drag a bar")) << "a drag draws, with Draw chosen";
    run("linkage.pin", {{"point", "A"}});
    EXPECT_EQ(state().at("verdict"), "1 degree of freedom");
    run("linkage.bar", {{"from", {2, 0, 0}}, {"to", {3, 0, 0}}});
    EXPECT_EQ(state().at("verdict"), "CD is loose") << "named after its joints";
    run("linkage.drag", {{"point", "B"}, {"to", {5, 0, 0}}});
    EXPECT_NEAR(at("B").x, 1.0, 1e-6) << "the rest moves";
}

// Drivers, motors, ranges and drags of a linkage: its goals, through edits, undo and files.

class LinkageDrivers : public LinkageTest {};

TEST_F(LinkageDrivers, AFarValueIsReachedInTime) {
    four_bar();
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 100000}});
    tick(60);
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
    const Json extra{{"joint", other}, {"value", 0.0}, {"rate", 0.0}, {"held", false}, {"last_rate", 0.0}};
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
