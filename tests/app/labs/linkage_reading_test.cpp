// The Linkage lab's messages about a linkage: ways out of a dead point, transmission angles, rotations,
// floating links; motors between bars; and the view.
#include <glm/trigonometric.hpp>
#include <map>

#include "app/labs/linkage/draw.hpp"
#include "app/labs/linkage/measures.hpp"
#include "app/view/camera.hpp"
#include "tests/app/labs/linkage_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/app/support/random_numbers.hpp"

namespace tendril::app {
namespace {

class LinkageReading : public LinkageTest {
  protected:
    /// Runs the motor until it stops at its dead point.
    void stall() {
        four_bar();
        run("linkage.set", {{"crank", 2.2}});
        run("linkage.motor", {{"joint", "crank"}, {"deg_per_s", 90}});
        run_to_dead_point();
    }
    void run_to_dead_point() {
        tick(240);
        ASSERT_EQ(state().at("status"), "DeadPoint");
    }
    void take(const char* title) {
        const auto ways = ways_on(part(), runtime());
        const auto way = std::ranges::find(ways, std::string(title), &Cure::title);
        ASSERT_NE(way, ways.end()) << "there is no " << title;
        for (const CommandCall& call : way->calls) run(call.name.c_str(), to_json(call.arguments));
    }
    /// Bars by the names of their ends.
    void add_bars(const std::vector<std::string>& names) {
        for (const std::string& name : names)
            run("linkage.bar", {{"from", name.substr(0, 1)}, {"to", name.substr(1)}, {"name", name}});
    }
    /// The side of the line from B to D on which coupler and rocker meet.
    bool meets_left() const {
        const glm::dvec3 d(3, 0, 0), line = d - at("B"), to = at("C") - at("B");
        return line.x * to.y - line.y * to.x > 0.0;
    }
    const LinkageTurn& turn() { return runtime().turn(part()); }
    bool all_in_view() {
        const Camera camera(workspace.camera, {{0, 0}, workspace.ui.view_size});
        PartInTurn in_turn(part());
        const auto seen = [&](const LinkagePart& now) {
            for (std::size_t i = 0; i < now.linkage().points.size(); ++i) {
                const auto pixel = camera.project(in_scene(now, now.at(i)));
                if (!pixel || !camera.viewport().contains(*pixel)) return false;
            }
            return true;
        };
        for (const LinkageTurn::Pose& each : turn().poses)
            if (!seen(*in_turn.at(each))) return false;
        return seen(part());
    }
    /// Two bars in a row from the pin A: a robot arm.
    void draw_arm() {
        run("linkage.clear");
        run("linkage.bar", {{"from", {1, 0, 0}}, {"to", {2, 0, 0}}});
        run("linkage.bar", {{"from", {0, 0, 0}}, {"to", "A"}});
        run("linkage.pin", {{"point", "C"}});
    }
};

TEST_F(LinkageReading, EveryCureForADeadPointWorks) {
    stall();
    const double stopped = driver("crank");
    EXPECT_EQ(motor_button(part()),
              "Stopped at " + value_text(part(), "crank", glm::radians(stopped)) + ": turn back");
    const bool left = meets_left();
    take("Turn back");
    EXPECT_EQ(motor_button(part()), "Stop");
    wait(30);
    EXPECT_NEAR(driver("crank"), stopped - 45.0, 2.0);
    EXPECT_EQ(meets_left(), left) << "back the way it came";
    stall();
    take("Other mode");
    wait(30);
    EXPECT_NEAR(driver("crank"), stopped - 45.0, 2.0);
    EXPECT_NE(meets_left(), left) << "past the dead point";
    stall();
    take("Shorten");
    wait(300);
    EXPECT_EQ(state().at("status"), "Reached");
    EXPECT_GT(driver("crank"), stopped + 360.0) << "all round";
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 30}});
    EXPECT_EQ(motor_button(part()), "Run");
    EXPECT_TRUE(ways_on(part(), runtime()).empty());
}

TEST_F(LinkageReading, ASliderCrankIsShortenedToo) {
    run("linkage.preset", {{"name", "slider_crank"}});
    run("linkage.set", {{"crank", 1.0}, {"rod", 0.8}, {"offset", 0.1}});
    run("linkage.motor", {{"joint", "crank"}, {"deg_per_s", 90}});
    run_to_dead_point();
    ASSERT_TRUE(runtime().round_crank(part(), 0));
    EXPECT_NEAR(runtime().round_crank(part(), 0)->longest, 0.7, 1e-3);
    take("Shorten");
    wait(300);
    EXPECT_EQ(state().at("status"), "Reached");
}

/// Jansen's leg, drawn by hand. It folds at one end of its travel: a crank shortened there would not come
/// round.
TEST_F(LinkageReading, ADrawnLegIsShortenedAtEitherEndOfItsTravelAndItsPathIsSmooth) {
    for (const double speed : {90.0, -90.0}) {
        run("linkage.clear");
        const std::pair<const char*, glm::dvec2> joints[] = {
            {"A", {0, 0}},        {"B", {0.62, 0}},      {"C", {-0.99, 1.29}},  {"D", {-1.57, -0.32}},
            {"E", {-3.08, 0.34}}, {"F", {-1.11, -1.88}}, {"G", {-2.44, -1.16}}, {"H", {-1.78, -3.78}}};
        for (const auto& [name, at] : joints) run("linkage.joint", {{"at", {at.x, at.y, 0}}, {"name", name}});
        for (const std::string bar : {"AB", "BC", "CD", "CE", "DE", "BF", "DF", "EG", "FG", "FH", "GH"})
            run("linkage.bar", {{"from", bar.substr(0, 1)}, {"to", bar.substr(1)}});
        for (const char* pin : {"A", "D"}) run("linkage.pin", {{"point", pin}});
        run("linkage.motor.add", {{"point", "A"}});
        run("linkage.select", {{"point", "A"}});
        EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "Click a joint its path"));
        run("linkage.drive", {{"joint", "motor 1"}, {"angle_deg", 45}});
        run("linkage.length", {{"bar", "AB"}, {"length", 0.95}});
        run("linkage.select", {{"point", "H"}});
        const std::vector<PathPoint> path = runtime().path(part());
        for (std::size_t i = 1; i < path.size(); ++i)
            ASSERT_LT(glm::distance(path[i].at, path[i - 1].at),
                      0.021 * runtime().solver(part().shape).size())
                << i << " of " << path.size();
        run("linkage.motor", {{"joint", "motor 1"}, {"deg_per_s", speed}});
        run_to_dead_point();
        EXPECT_EQ(ways_on(part(), runtime()).size(), 3u) << speed;
        take("Shorten");
        wait(300);
        EXPECT_EQ(state().at("status"), "Reached") << speed;
        EXPECT_TRUE(turn().whole) << speed;
        EXPECT_EQ(motor_button(part()), "Stop") << "it runs on";
    }
}

TEST_F(LinkageReading, APointsSpeedIsItsCranksTimesItsLength) {
    four_bar();
    EXPECT_NEAR(point_speed(part(), "B", runtime()), glm::radians(90.0), 1e-5)
        << "stopped: at the usual speed";
    run("linkage.motor", {{"joint", "crank"}, {"deg_per_s", -30}});
    EXPECT_NEAR(point_speed(part(), "B", runtime()), glm::radians(30.0), 1e-5);
    EXPECT_TRUE(std::isnan(point_speed(part(), "A", runtime()))) << "of the ground";
    EXPECT_TRUE(test::says(lab().hint(workspace, linkage_pick(1)), "B, 0.52 m/s: drag"));
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 0}});
    EXPECT_NEAR(point_speed(part(), "B", runtime()), glm::radians(30.0), 1e-5) << "as it last ran";
    EXPECT_TRUE(test::says(lab().hint(workspace, linkage_pick(1)), "B, 0.52 m/s at 30 deg/s: drag"));
    EXPECT_EQ(part().load(part().save(), "labs.linkage")->save(), part().save());
    run("linkage.motor", {{"joint", "crank"}});
    EXPECT_NEAR(part().drives[0].rate, glm::radians(-30.0), 1e-12) << "and runs again";
    run("linkage.select", {{"point", "P"}});
    const std::vector<PathPoint> path = runtime().path(part());
    const LinkageTurn& poses = turn();
    PartInTurn in_turn(part());
    for (std::size_t i = 1; i < path.size(); i += 7) {
        const double before = point_speed(*in_turn.at(poses.poses[i - 1]), "P", runtime()),
                     after = point_speed(*in_turn.at(poses.poses[i]), "P", runtime());
        EXPECT_NEAR(path[i].speed, 0.5 * (before + after), 0.01) << i;
    }
    run("view.linkage_plot", {{"of", "speed"}});
    EXPECT_EQ(linkage_past().curve(workspace)->unit, "m/s");
    EXPECT_FALSE(linkage_turn_curves(workspace, *linkage_past().curve(workspace)).empty());
    run("linkage.preset", {{"name", "pantograph"}});
    EXPECT_TRUE(std::isnan(point_speed(part(), "P", runtime()))) << "it has no motor";
}

/// A drag link's crank is longer than its ground: between a length at which coupler and rocker fold, and one
/// at which they stretch.
TEST_F(LinkageReading, ACrankIsShortenedToADragLinksToo) {
    const auto drawn =
        opened({.ground = 1.0, .crank = 5.5, .coupler = 3.0, .rocker = 3.0}, runtime()).value();
    ASSERT_TRUE(runtime().round_crank(drawn, 0));
    EXPECT_NEAR(runtime().round_crank(drawn, 0)->longest, 5.0, 0.01);
}

TEST_F(LinkageReading, TheMinimumTransmissionAngleFollowsTheLawOfCosines) {
    test::RandomNumbers random(7);
    int checked = 0;
    for (int i = 0; i < 60; ++i) {
        const double g = random.uniform(2.0, 4.0), b = random.uniform(1.0, 4.0), r = random.uniform(1.0, 4.0);
        const double longest = std::min(b + r - g, g - std::abs(b - r));
        if (longest < 0.2) continue;
        const double a = random.uniform(0.1, 0.95) * longest;
        run("linkage.preset", {{"name", "four_bar"}});
        run("linkage.set", {{"lengths", {{"ground", g}, {"crank", a}, {"coupler", b}, {"rocker", r}}}});
        run("linkage.drive", {{"joint", "crank"}, {"angle_deg", random.uniform(-720.0, 720.0)}});
        double expected = 90.0;
        for (const double d : {g - a, g + a}) {
            const double angle = glm::degrees(std::acos((b * b + r * r - d * d) / (2.0 * b * r)));
            expected = std::min({expected, angle, 180.0 - angle});
        }
        ASSERT_TRUE(turn().whole) << g << " " << a << " " << b << " " << r;
        const auto worst = worst_transmission(part(), turn());
        ASSERT_TRUE(worst);
        EXPECT_NEAR(worst->degrees, expected, 0.2);
        EXPECT_LE(worst->degrees, transmission_angle(part()) + 0.2);
        const double at = std::remainder(glm::degrees(worst->value), 180.0);
        EXPECT_NEAR(at, 0.0, 1.0) << "the crank is in line with the pins";
        EXPECT_NEAR(state().at("transmission_minimum").at("degrees").get<double>(), worst->degrees, 0.2);
        ++checked;
    }
    EXPECT_GT(checked, 20);
    stall();
    EXPECT_NEAR(worst_transmission(part(), turn())->degrees, 0.0, 0.1) << "at its dead point";
}

/// One or two rigid triangles may be attached to any bar of a four-bar, and bars may be drawn in any order.
TEST_F(LinkageReading, TheTransmissionAngleIsTheFourBarsUnderAnyTriangles) {
    test::RandomNumbers random(41);
    int dead_points = 0;
    for (int i = 0; i < 60; ++i) {
        const auto near = [&](double x, double y) {
            return glm::dvec3(x + random.uniform(-0.6, 0.6), y + random.uniform(-0.6, 0.6), 0.0);
        };
        std::map<std::string, glm::dvec3> joints{
            {"A", near(0, 0)}, {"B", near(0, 2)}, {"C", near(3, 2)}, {"D", near(3, 0)}};
        std::vector<std::string> bars{"AB", "BC", "CD"};
        for (const auto& [name, on] : {std::pair("E", "AB"), {"F", "BC"}, {"G", "CD"}})
            if (random.uniform(0, 1) < 0.6) {
                joints[name] = near(1.5, 4);
                bars.push_back(name + std::string(1, on[0]));
                bars.push_back(name + std::string(1, on[1]));
            }
        std::shuffle(bars.begin(), bars.end(), random.random);
        run("linkage.clear");
        std::vector<std::string> names{"A", "B", "C", "D", "E", "F", "G"};
        std::shuffle(names.begin(), names.end(), random.random);
        for (const std::string& name : names)
            if (joints.contains(name))
                run("linkage.joint", {{"at", {joints[name].x, joints[name].y, 0}}, {"name", name}});
        add_bars(bars);
        for (const char* pin : {"A", "D"}) run("linkage.pin", {{"point", pin}});
        run("linkage.motor.add", {{"point", "A"}, {"bar", "AB"}, {"name", "m"}});
        const auto apart = [&](const char* a, const char* b) { return glm::distance(joints[a], joints[b]); };
        const double g = apart("A", "D"), a = apart("A", "B"), b = apart("B", "C"), c = apart("C", "D");
        LinkageRuntime runtime;
        const auto plain = opened({.ground = g, .crank = a, .coupler = b, .rocker = c}, runtime);
        EXPECT_EQ(four_bar_kind(part()), four_bar_kind(plain.value())) << i;
        const auto find = [&](const char* name) { return *part().linkage().find_point(name); };
        const auto status = [&] { return part().result.report.status; };
        const auto expect_law_of_cosines = [&] {
            const double d = glm::distance(part().at(find("B")), part().at(find("D")));
            const double cosine = std::clamp((b * b + c * c - d * d) / (2.0 * b * c), -1.0, 1.0);
            const double angle = glm::degrees(std::acos(cosine));
            EXPECT_NEAR(transmission_angle(part()), std::min(angle, 180.0 - angle), 0.01) << i;
        };
        for (int k = 0; k < 40 && status() == ik::LinkageStatus::Reached; ++k) {
            expect_law_of_cosines();
            run("linkage.drive", {{"joint", "m"}, {"angle_deg", glm::degrees(part().value_of("m")) + 10.0}});
        }
        if (status() != ik::LinkageStatus::DeadPoint) continue;
        EXPECT_NEAR(transmission_angle(part()), 0.0, 0.2) << i;
        EXPECT_NEAR(worst_transmission(part(), turn())->degrees, 0.0, 0.2) << i;
        ++dead_points;
    }
    EXPECT_GT(dead_points, 10);
}

TEST_F(LinkageReading, AFourBarsTypeSaysWhetherItsCrankTurnsAllRound) {
    test::RandomNumbers random(11);
    int rounds = 0, swings = 0;
    for (int i = 0; i < 80; ++i) {
        const auto length = [&] { return random.uniform(1.0, 4.0); };
        const double a = length(), b = length(), c = length(), g = length();
        const double longest = std::max({a, b, c, g});
        if (a + b + c + g < 2.05 * longest) continue;
        LinkageRuntime fresh;
        const auto drawn = opened({.ground = g, .crank = a, .coupler = b, .rocker = c}, fresh);
        if (!drawn || drawn->result.report.status != ik::LinkageStatus::Reached) continue;
        const std::string kind = four_bar_kind(*drawn);
        const bool goes_round = kind == "crank-rocker" || kind == "drag link";
        EXPECT_EQ(fresh.turn(*drawn).whole, goes_round)
            << kind << ": " << g << " " << a << " " << b << " " << c;
        ++(goes_round ? rounds : swings);
    }
    EXPECT_GT(rounds, 10);
    EXPECT_GT(swings, 10);
    EXPECT_EQ(four_bar_kind(part()), "crank-rocker");
    run("linkage.set", {{"crank", 1.5}});
    EXPECT_EQ(four_bar_kind(part()), "change point");
    run("linkage.preset", {{"name", "slider_crank"}});
    EXPECT_EQ(four_bar_kind(part()), "");
}

// Joints of one rigid body are in line by construction: they are never the cause.
TEST_F(LinkageReading, ADeadPointNamesTheCausingJointsBesideAnyTriangles) {
    test::RandomNumbers random(15);
    int in_line = 0, meeting = 0;
    for (int i = 0; i < 80; ++i) {
        const auto joint = [&](const char* name, double x, double y, double spread = 0.6) {
            run("linkage.joint",
                {{"at", {x + random.uniform(-spread, spread), y + random.uniform(-spread, spread), 0}},
                 {"name", name}});
        };
        const bool driven_aside = i % 2 == 1;
        run("linkage.clear");
        joint("A", 0, 0), joint("B", 0, 2), joint("C", 3, 2), joint("D", 3, 0),
            joint("E", 1.5, i % 3 == 0 ? 2 : 3);
        add_bars({"AB", "BC", "CD", "BE", "CE"});
        if (driven_aside)
            joint("F", 3, 5), joint("G", 5, 4), add_bars({"EF", "FG"});
        else
            joint("F", 4, 1, 0.4), add_bars({"CF", "DF"});
        for (const char* pin : {"A", "D"}) run("linkage.pin", {{"point", pin}});
        if (driven_aside) run("linkage.pin", {{"point", "G"}});
        run("linkage.motor.add",
            {{"point", driven_aside ? "G" : "A"}, {"bar", driven_aside ? "FG" : "AB"}, {"name", "m"}});
        const auto status = [&] { return part().result.report.status; };
        for (int k = 0; k < 40 && status() == ik::LinkageStatus::Reached; ++k)
            run("linkage.drive",
                {{"joint", "m"},
                 {"angle_deg", glm::degrees(part().value_of("m")) + (i % 4 < 2 ? 10.0 : -10.0)}});
        if (status() != ik::LinkageStatus::DeadPoint) continue;
        const std::string reason = dead_point_reason(part(), runtime());
        const auto off_line = [&](const char* a, const char* b, const char* c) {
            const glm::dvec3 u = glm::normalize(at(b) - at(a)), v = glm::normalize(at(c) - at(b));
            return std::abs(u.x * v.y - u.y * v.x);
        };
        if (reason == "B, C and D are in line" || reason == "D, C and B are in line") {
            EXPECT_LT(off_line("B", "C", "D"), 0.02) << i;
            ++in_line;
        } else if (driven_aside &&
                   (reason == "A, B and C are in line" || reason == "C, B and A are in line")) {
            EXPECT_LT(off_line("A", "B", "C"), 0.02) << i;
        } else {
            ASSERT_TRUE(driven_aside) << i << ": " << reason;
            EXPECT_TRUE(test::says(reason, "the lines B-A, C-D and E-F")) << i << ": " << reason;
            // The third line must pass through the crossing of two of them.
            const glm::dvec3 u = at("B") - at("A"), v = at("D") - at("C"), w = at("C") - at("A");
            const double across = u.x * v.y - u.y * v.x;
            if (std::abs(across) < 0.1) continue;
            const glm::dvec3 meet = at("A") + (w.x * v.y - w.y * v.x) / across * u;
            const glm::dvec3 f = at("F") - at("E"), to = meet - at("E");
            EXPECT_LT(std::abs(f.x * to.y - f.y * to.x) / glm::length(f) / (1.0 + glm::length(to)), 0.02)
                << i;
            ++meeting;
        }
    }
    EXPECT_GT(in_line, 10);
    EXPECT_GT(meeting, 5);
}

TEST_F(LinkageReading, AnAngleIsReachedTheShortWayAndTurnsOnRequest) {
    four_bar();
    const auto to = [&](double angle) {
        run("linkage.drive", {{"joint", "crank"}, {"angle_deg", angle}});
        return driver("crank");
    };
    EXPECT_NEAR(to(170), 170.0, 1e-6);
    EXPECT_NEAR(to(-170), 190.0, 1e-6);
    EXPECT_NEAR(to(10), 370.0, 1e-6) << "half a turn: on";
    EXPECT_NEAR(to(720), 720.0, 1e-6);
    EXPECT_NEAR(to(-10), 710.0, 1e-6);
    EXPECT_NEAR(to(-360), -360.0, 1e-6);
    run("linkage.range", {{"joint", "crank"}, {"min", -400}, {"max", -200}});
    EXPECT_NEAR(to(100), -260.0, 1e-6) << "the range has no other";
}

TEST_F(LinkageReading, APlotOverTheMotorsAngleCoversTheWholeTurn) {
    four_bar();
    run("linkage.drive", {{"joint", "crank"}, {"angle_deg", 500}});
    run("view.linkage_plot", {{"of", "transmission"}});
    const auto pieces = [&] { return linkage_turn_curves(workspace, *linkage_past().curve(workspace)); };
    workspace.runtimes.clear();
    ASSERT_EQ(pieces().size(), 2u) << "it begins after the present pose";
    const Curve now_on = pieces()[0], from_zero = pieces()[1];
    EXPECT_NEAR(now_on.points.front().x, 143.0f, 0.1f);
    EXPECT_EQ(now_on.points.back().x, 360.0f);
    EXPECT_EQ(from_zero.points.front().x, 0.0f);
    EXPECT_NEAR(from_zero.points.back().x, 143.0f, 0.1f);
    EXPECT_NEAR(value_at(from_zero, 140.0f), transmission_angle(part()), 0.1);
    run("view.linkage_plot", {{"of", "motor"}});
    EXPECT_TRUE(pieces().empty());
    stall();
    run("view.linkage_plot", {{"of", "transmission"}});
    ASSERT_EQ(pieces().size(), 2u) << "a gap where the crank cannot go";
    EXPECT_GT(pieces()[0].points.front().x, pieces()[1].points.back().x + 90.0f);
    run("linkage.preset", {{"name", "delta"}});
    EXPECT_TRUE(pieces().empty());
}

TEST_F(LinkageReading, AnglesAreShownWithinATurn) {
    four_bar();
    const auto shown = [&](double degrees) { return shown_value(part(), "crank", glm::radians(degrees)); };
    EXPECT_NEAR(shown(3725.0).value, 125.0, 1e-9);
    EXPECT_EQ(shown(3725.0).turns, 10);
    EXPECT_NEAR(shown(-10.0).value, 350.0, 1e-9);
    EXPECT_EQ(shown(-10.0).turns, -1);
    EXPECT_EQ(value_text(part(), "crank", glm::radians(359.97)), "0.0 degrees");
    EXPECT_EQ(shown(359.97).turns, 1);
    EXPECT_EQ(value_text(part(), "crank", 0.0), "0.0 degrees");
    run("linkage.range", {{"joint", "crank"}, {"min", -45}});
    EXPECT_NEAR(shown(-10.0).value, -10.0, 1e-9) << "as its range counts";
    EXPECT_NEAR(shown(1e9).value, 1e9, 1.0);
    run("linkage.preset", {{"name", "delta"}});
    EXPECT_NEAR(shown_value(part(), "motor_0", glm::radians(-5.0)).value, -5.0, 1e-9);
    run("linkage.preset", {{"name", "slider_crank"}});
    EXPECT_EQ(value_text(part(), "S", 1.25), "1.250 m");
    run("linkage.motor", {{"joint", "crank"}, {"deg_per_s", -360}});
    wait(130);
    EXPECT_EQ(linkage_verdict(part(), runtime()).why, "The motor runs: 2 whole turns backwards.");
    EXPECT_EQ(linkage_verdict(part(), runtime(), false).why,
              "Paused: 2 whole turns backwards. Space continues.");
    EXPECT_EQ(motor_button(part(), false), "Continue");
    // 300 degrees from where it was drawn, it has passed 360.
    draw_four_bar();
    run("linkage.move", {{"point", "B"}, {"to", {-0.94, 0.34, 0}}});
    run("linkage.motor", {{"joint", "motor 1"}, {"deg_per_s", 360}});
    wait(50);
    EXPECT_EQ(linkage_verdict(part(), runtime()).why, "The motor runs.");
}

TEST_F(LinkageReading, FloatingBarsHaveThreeMoreDegreesOfFreedom) {
    run("linkage.clear");
    run("linkage.bar", {{"from", {0, 0, 0}}, {"to", {0, 1, 0}}});
    EXPECT_EQ(state().at("freedom"), 3);
    EXPECT_EQ(state().at("gruebler"), 3);
    EXPECT_TRUE(test::says(linkage_verdict(part(), runtime()).why, "floats 3 degrees of freedom Pin"));
    run("linkage.bar", {{"from", "B"}, {"to", {2, 2, 0}}});
    EXPECT_EQ(state().at("freedom"), 4) << "two bars with a joint";
    run("linkage.bar", {{"from", "C"}, {"to", {3, 0, 0}}});
    run("linkage.bar", {{"from", "D"}, {"to", "A"}});
    EXPECT_EQ(state().at("freedom"), 4) << "a closed four-bar that floats";
    const Camera camera(workspace.camera, {{0, 0}, workspace.ui.view_size});
    DrawList list;
    lab().draw({workspace, camera, palette(Theme::Dark)}, list);
    EXPECT_NEAR(list.strokes.front().radius_a, 0.036f, 1e-6f) << "as thick as if it were held";
    EXPECT_EQ(state().at("gruebler"), 4);
    run("linkage.pin", {{"point", "A"}});
    EXPECT_EQ(state().at("freedom"), 2);
    run("linkage.pin", {{"point", "D"}});
    EXPECT_EQ(state().at("freedom"), 1);
    run("linkage.bar", {{"from", {5, 5, 0}}, {"to", {6, 5, 0}}});
    EXPECT_EQ(state().at("freedom"), 4) << "another that is loose";
    EXPECT_TRUE(test::says(linkage_verdict(part(), runtime()).why, "floats 3 degrees"));
}

TEST_F(LinkageReading, AnElbowIsDrivenAgainstTheUpperArm) {
    draw_arm();
    expect_refused("linkage.motor.add", {{"point", "B"}}, {"B", "not pinned", "second bar"});
    expect_refused("linkage.motor.add", {{"point", "C"}, {"against", "AC"}}, {"C has one bar", "leave out"});
    run("linkage.motor.add", {{"point", "C"}, {"name", "shoulder"}});
    run("linkage.motor.add", {{"point", "A"}, {"name", "elbow"}});
    const ik::SketchMotor& elbow = part().shape->sketch.motors.back();
    EXPECT_EQ(part().shape->sketch.bars[elbow.bar].name, "AB") << "the forearm, though it was drawn first";
    EXPECT_EQ(part().shape->sketch.bars[elbow.against].name, "AC");
    EXPECT_EQ(state().at("freedom"), 2);
    EXPECT_NEAR(std::abs(driver("elbow")), 180.0, 1e-6) << "straight";
    run("linkage.drive", {{"joint", "elbow"}, {"angle_deg", 90}});
    run("linkage.drive", {{"joint", "shoulder"}, {"angle_deg", 90}});
    EXPECT_NEAR(at("A").y, 1.0, 1e-6);
    EXPECT_NEAR(std::abs(at("B").x), 1.0, 1e-6);
    EXPECT_NEAR(at("B").y, 1.0, 1e-6);
    run("linkage.drive", {{"joint", "shoulder"}, {"angle_deg", 30}});
    std::string name;
    EXPECT_NEAR(angle_at(part(), "A", &name), 90.0, 1e-6) << "the elbow keeps its angle";
    EXPECT_EQ(name, "BAC");
    angle_at(part(), "B", &name);
    EXPECT_EQ(name, "BA to X") << "from B to A";
    EXPECT_EQ(part().load(part().save(), "labs.linkage")->save(), part().save());
    expect_refused("linkage.motor.add", {{"point", "A"}}, {"has a motor"});
    run("linkage.motor.remove", {{"joint", "elbow"}});
    Emit emit;
    run("linkage.tool", {{"name", "motor"}});
    lab().click(workspace, linkage_pick(*part().linkage().find_point("A")), emit);
    const auto emitted = emit.take();
    ASSERT_EQ(emitted.size(), 2u);
    EXPECT_EQ(emitted[1].name, "linkage.motor.add");
}

TEST_F(LinkageReading, NeitherBarsNorPinsLeaveAMotorInsideOneBody) {
    draw_arm();
    run("linkage.move", {{"point", "B"}, {"to", {1, 1, 0}}});
    run("linkage.motor.add", {{"point", "A"}, {"name", "elbow"}});
    const char* const words = "motor \"elbow\" could not turn";
    expect_refused("linkage.bar", {{"from", "B"}, {"to", "C"}}, {std::string("linkage.bar: ") + words});
    expect_refused("linkage.pin", {{"point", "B"}}, {std::string("linkage.pin: ") + words});
}

TEST_F(LinkageReading, IfMoreBarsMeetTwoAreChosen) {
    draw_arm();
    run("linkage.bar", {{"from", "A"}, {"to", {1, 2, 0}}});
    expect_refused("linkage.motor.add", {{"point", "A"}}, {"3 bars", "A", "bar and against"});
    expect_refused("linkage.motor.add", {{"point", "A"}, {"bar", "AB"}}, {"3 bars"});
    expect_refused("linkage.motor.add", {{"point", "A"}, {"bar", "AB"}, {"against", "AB"}},
                   {"against", "another"});
    expect_refused("linkage.motor.add", {{"point", "B"}, {"bar", "AC"}}, {"AC", "not on B"});
    run("linkage.motor.add", {{"point", "A"}, {"bar", "AD"}, {"against", "AB"}});
    expect_refused("linkage.motor.add", {{"point", "A"}, {"bar", "AB"}, {"against", "AD"}}, {"has a motor"});
    run("linkage.drive", {{"joint", "motor 1"}, {"angle_deg", 60}});
    const glm::dvec3 one = at("B") - at("A"), three = at("D") - at("A");
    EXPECT_NEAR(glm::dot(one, three) / (glm::length(one) * glm::length(three)), 0.5, 1e-6);
}

TEST_F(LinkageReading, APresetAndTheOtherModeAreInView) {
    for (const MechanismKind& kind : mechanism_kinds()) {
        run("linkage.preset", {{"name", kind.name}});
        EXPECT_TRUE(all_in_view()) << kind.name;
    }
    four_bar();
    for (const char* way : {"there", "back"}) {
        workspace.camera = {.target = {0.2f, 0.9f, 0.0f}, .distance = 1.5f, .orthographic = true};
        EXPECT_FALSE(all_in_view());
        run("linkage.other_mode");
        EXPECT_TRUE(all_in_view()) << way;
    }
    const CameraPose framed = workspace.camera;
    workspace.camera.distance *= 1.5f;
    const CameraPose wider = workspace.camera;
    run("linkage.other_mode");
    EXPECT_EQ(workspace.camera.distance, wider.distance) << "all is in view: nothing moves";
    EXPECT_NE(wider.distance, framed.distance);
}

}  // namespace
}  // namespace tendril::app
