// Linkages: cases of an independent implementation over whole turns, closed forms, targets out of reach
// against brute force, modes and dead points, ranges, priorities, freedom, sketches, and hostile input.
#include <fstream>
#include <nlohmann/json.hpp>

#include "ik_linkage_support.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::test::ik_linkage_test {
namespace {

using namespace linkage;
using Json = nlohmann::json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

FourBar four_bar_of(const Json& lengths) {
    return {lengths.at("ground"),
            lengths.at("crank"),
            lengths.at("coupler"),
            lengths.at("rocker"),
            {lengths.at("coupler_point")[0], lengths.at("coupler_point")[1]}};
}

/// Drives two turns in steps of `step` degrees; the rows cover one turn.
void follows(Machine& machine, const std::string& driver, const Json& rows, int step,
             const std::vector<std::string>& points) {
    const int spacing = 360 / static_cast<int>(rows.size());
    for (int degrees = 0; degrees <= 720; degrees += step) {
        const LinkageReport report = machine.drive(driver, deg(degrees));
        ASSERT_EQ(report.status, LinkageStatus::Reached) << degrees;
        ASSERT_FALSE(report.passed_dead_point) << degrees;
        ASSERT_LE(report.closed_to, 1e-6 * machine.solver.size());
        ASSERT_EQ(report.freedom, 0);
        if (degrees % spacing != 0) continue;
        const Json& row = rows[static_cast<std::size_t>(degrees / spacing) % rows.size()];
        for (const std::string& each : points) {
            const glm::dvec3 at = machine.point(each);
            const double x = row.contains("slider_x") ? row.at("slider_x") : row.at(each)[0];
            const double y = row.contains("slider_x") ? at.y : row.at(each)[1].get<double>();
            EXPECT_LE(glm::length(at - glm::dvec3(x, y, 0.0)), 1e-5);
        }
    }
}

TEST(Linkage, AgreesWithAnIndependentImplementationOverWholeTurns) {
    std::ifstream file(reference_path("linkage.json"));
    if (!file) GTEST_SKIP() << "linkage.json is not here";
    const Json cases = Json::parse(file);
    for (const bool fine : {false, true}) {
        for (const Json& each : cases.at("four_bar")) {
            Machine machine(four_bar(four_bar_of(each)));
            follows(machine, "crank", each.at("rows"), fine ? 1 : 15, {"B", "C", "P"});
        }
        for (const Json& each : cases.at("slider_crank")) {
            Machine machine(slider_crank({each.at("crank"), each.at("rod"), each.at("offset")}));
            follows(machine, "crank", each.at("rows"), fine ? 1 : 15, {"S"});
        }
        Machine machine{jansen()};
        follows(machine, "motor", cases.at("jansen").at("rows"), fine ? 1 : 10,
                {"crank", "upper", "lower", "back", "knee", "foot"});
    }
    for (const Json& each : cases.at("delta")) {
        const Delta lengths{each.at("base_radius"), each.at("platform_radius"), each.at("upper_arm"),
                            each.at("forearm")};
        Machine machine(delta(lengths));
        for (const Json& row : each.at("rows")) {
            const Json& to = row.at("platform");
            ASSERT_EQ(machine.reach("platform", {to[0], to[1], to[2]}).status, LinkageStatus::Reached);
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(machine.value("motor_" + std::to_string(i)), deg(row.at("motors_deg")[i]), 1e-5);
        }
    }
}

TEST(Linkage, PeaucellierDrawsAStraightLine) {
    Machine machine{peaucellier()};
    for (int degrees = -50; degrees <= 50; ++degrees) {
        ASSERT_EQ(machine.drive("crank", deg(degrees)).status, LinkageStatus::Reached);
        EXPECT_NEAR(machine.point("P").x, (3.0 * 3.0 - 1.2 * 1.2) / 2.0, 1e-6);
    }
}

TEST(Linkage, APantographEnlargesAndAScissorLiftLifts) {
    Machine machine{pantograph({1.0, 2.5})};
    Random random(3);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 to = glm::dvec3(0.4, 0.0, 0.0) + random_place(random, 0.1f);
        ASSERT_EQ(machine.reach("T", to).status, LinkageStatus::Reached);
        EXPECT_LE(glm::length(machine.point("P") - 2.5 * machine.point("T")), 1e-8);
    }
    Machine lift{scissor_lift({5, 1.0, 0.6})};
    for (int degrees = 5; degrees <= 85; degrees += 5) {
        ASSERT_EQ(lift.drive("lift", deg(degrees)).status, LinkageStatus::Reached);
        EXPECT_NEAR(lift.point("R5").y, 5.0 * std::sin(deg(degrees)), 1e-7);
    }
}

glm::dquat turned_by(const glm::dvec3& vector) {
    const double angle = glm::length(vector);
    return angle > 0.0 ? glm::angleAxis(angle, vector / angle) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

TEST(Linkage, AStewartPlatformIsWhereItsLegsPutIt) {
    const Stewart lengths;
    Machine machine(stewart(lengths));
    Random random(11);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 at = glm::dvec3(0.0, 0.0, 1.0) + 0.25 * glm::dvec3(random.point(1.0f));
        const glm::dquat turn = turned_by(0.25 * glm::dvec3(random.point(1.0f)));
        const auto legs = stewart_legs(lengths, at, turn);
        std::vector<LinkDriver> drivers;
        for (std::size_t k = 0; k < 6; ++k)
            drivers.push_back({machine.link("leg_" + std::to_string(k)), legs[k]});
        const LinkageReport report = machine.solver.solve(machine.state, {drivers, {}});
        ASSERT_EQ(report.status, LinkageStatus::Reached);
        ASSERT_EQ(report.freedom, 0);
        EXPECT_LE(glm::length(machine.point("platform") - at), 1e-6);
        const glm::dquat is = machine.solver.links()[machine.link("platform")].rotation;
        EXPECT_GE(std::abs(glm::dot(is, turn)), 1.0 - 1e-12);
    }
}

TEST(Linkage, ADeltaRobotMatchesItsClosedFormAndStaysLevel) {
    const Delta lengths;
    Machine machine(delta(lengths));
    Random random(12);
    int checked = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 at = glm::dvec3(0.0, 0.0, -0.45) + 0.12 * glm::dvec3(random.point(1.0f));
        const auto motors = delta_motors(lengths, at);
        const LinkageReport report = machine.reach("platform", at);
        if (!motors) continue;
        ++checked;
        ASSERT_EQ(report.status, LinkageStatus::Reached);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(machine.value("motor_" + std::to_string(k)), (*motors)[k], 1e-5);
        EXPECT_NEAR(std::abs(machine.solver.links()[machine.link("platform")].rotation.w), 1.0, 1e-9);
    }
    EXPECT_GE(checked, 150);
}

TEST(Linkage, ADeadPointMatchesTheClosedFormAndNamesItsDriver) {
    Machine machine{four_bar({.ground = 3.0, .crank = 2.0, .coupler = 1.5, .rocker = 1.2})};
    const double dead = std::acos((3.0 * 3.0 + 2.0 * 2.0 - 2.7 * 2.7) / (2.0 * 3.0 * 2.0));
    ASSERT_EQ(machine.drive("crank", deg(10)).status, LinkageStatus::Reached);
    const glm::dvec3 before = machine.point("C");
    for (int i = 0; i < 3; ++i) {
        const LinkageReport report = machine.drive("crank", deg(90));
        ASSERT_EQ(report.status, LinkageStatus::DeadPoint);
        ASSERT_EQ(report.stopped, machine.link("crank"));
        EXPECT_NEAR(report.stopped_at, dead, 1e-6);
        EXPECT_NEAR(machine.value("crank"), dead, 1e-6);
    }
    // Back again, on the same side.
    EXPECT_EQ(machine.drive("crank", deg(10)).status, LinkageStatus::Reached);
    EXPECT_LE(glm::length(machine.point("C") - before), 1e-6);
}

TEST(Linkage, ContradictingClosuresAreNamedAndLeastFarApart) {
    // Two arms that are too short to meet over the ground.
    Linkage linkage{.links = {{"left", ground_link, LinkJoint::Hinge, {0, 0, 0}},
                              {"right", ground_link, LinkJoint::Hinge, {5, 0, 0}}},
                    .points = {{"L", 0, {1, 0.5, 0}}, {"R", 1, {4, 1, 0}}},
                    .closures = {{"top", ClosureKind::Point, 0, 1, {1, 0.5, 0}, {4, 1, 0}}}};
    Machine machine{Expected<Linkage>(linkage)};
    const LinkageReport report = machine.solver.solve(machine.state);
    EXPECT_EQ(report.status, LinkageStatus::Open);
    EXPECT_NEAR(report.closed_to, 5.0 - std::sqrt(1.25) - std::sqrt(2.0), 1e-4);
    ASSERT_EQ(machine.solver.open_closures().size(), 1u);
    EXPECT_EQ(machine.solver.open_closures()[0], 0u);
}

TEST(Linkage, ContradictingClosuresComeAsCloseAsBruteForce) {
    // A four-bar with a coupler point also closed on a third point, from any starting pose.
    Random random(17);
    for (int trial = 0; trial < 8; ++trial) {
        const glm::dvec3 place = glm::dvec3(1.5, 0.5, 0.0) + random_place(random, 3.0f);
        Linkage linkage{.links = {{"crank", ground_link, LinkJoint::Hinge, {0, 0, 0}},
                                  {"coupler", 0, LinkJoint::Hinge, {1, 0, 0}},
                                  {"rocker", ground_link, LinkJoint::Hinge, {3, 0, 0}}},
                        .closures = {{"C", ClosureKind::Point, 1, 2, {3, 0, 0}, {5, 0, 0}},
                                     {"P", ClosureKind::Point, 1, ground_link, {2, 1, 0}, place}}};
        const auto squares = [&](const glm::dvec3& angles) {
            const auto turned = [](double angle, double x, double y) {
                const double c = std::cos(angle), s = std::sin(angle);
                return glm::dvec3(c * x - s * y, s * x + c * y, 0.0);
            };
            const glm::dvec3 b = turned(angles.x, 1, 0);
            const double both = angles.x + angles.y;
            const glm::dvec3 c = b + turned(both, 2, 0) - (glm::dvec3(3, 0, 0) + turned(angles.z, 2, 0));
            const glm::dvec3 p = b + turned(both, 1, 1) - place;
            return glm::dot(c, c) + glm::dot(p, p);
        };
        double least = 1e9;
        glm::dvec3 best(0.0);
        const auto attempt = [&](const glm::dvec3& angles) {
            if (const double sum = squares(angles); sum < least) least = sum, best = angles;
        };
        for (int i = 0; i < 45; ++i)
            for (int j = 0; j < 45; ++j)
                for (int k = 0; k < 45; ++k) attempt(deg(8.0) * glm::dvec3(i, j, k));
        for (double step = deg(4.0); step > 1e-5; step *= 0.7)
            for (int i = 0; i < 27; ++i)
                attempt(best + step * glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));

        Machine machine{Expected<Linkage>(linkage)};
        for (JointPlace& each : machine.state.joints)
            each.value = 3.0 * static_cast<double>(random.around(1.0f));
        ASSERT_EQ(machine.solver.solve(machine.state).status, LinkageStatus::Open);
        const auto value = [&](std::size_t link) { return machine.state.joints[link].value; };
        EXPECT_LE(squares({value(0), value(1), value(2)}), 1.02 * least) << trial;
        // The next frame keeps the pose.
        const LinkageState before = machine.state;
        const LinkageReport report = machine.solver.solve(machine.state);
        EXPECT_EQ(report.status, LinkageStatus::Open);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(value(i), before.joints[i].value, 1e-4);
        EXPECT_EQ(machine.solver.open_closures().size(), 2u);
    }
}

TEST(Linkage, AStraightArmBendsToAPointOnItsLine) {
    LinkageSketch sketch{.points = {{"O", {0, 0}, SketchHold::Pinned}, {"A", {1, 0}}, {"B", {2, 0}}},
                         .bars = {{"upper", {0, 1}}, {"lower", {1, 2}}}};
    Machine machine{Expected<LinkageSketch>(sketch)};
    EXPECT_EQ(machine.reach("B", {1.2, 0.0, 0.0}).status, LinkageStatus::Reached);
    // Stretched towards a target out of reach, it keeps its pose in the next frame.
    ASSERT_EQ(machine.reach("B", {4.0, 0.0, 0.0}).status, LinkageStatus::TargetMissed);
    const LinkageState stretched = machine.state;
    machine.reach("B", {4.0, 0.0, 0.0});
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(machine.state.joints[i].value, stretched.joints[i].value, 1e-4);
}

TEST(Linkage, AnUnreachablePointIsApproachedAsBruteForceDoes) {
    Random random(5);
    int missed = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const FourBar lengths{3.0,
                              0.6 + 0.4 * static_cast<double>(random.part()),
                              2.4,
                              2.3,
                              {1.0, static_cast<double>(random.around(1.0f))}};
        Machine machine{four_bar(lengths)}, sweep{four_bar(lengths)};
        const glm::dvec3 to = random_place(random, 4.0f);
        double nearest = 1e9, at = 0.0;
        const auto look = [&](double angle) {
            sweep.drive("crank", angle);
            const double far = glm::length(sweep.point("P") - to);
            if (far < nearest) nearest = far, at = angle;
        };
        for (int degrees = 0; degrees < 360; degrees += 2) look(deg(degrees));
        const double coarse = at;
        for (int i = -40; i <= 40; ++i) look(coarse + deg(0.05 * i));
        // Descent finds the nearest local minimum: start close to the global one.
        machine.drive("crank", at - 0.3);
        const LinkageReport report = machine.reach("P", to);
        EXPECT_EQ(report.status, LinkageStatus::TargetMissed);
        missed += report.residual > 0.01;
        EXPECT_LE(report.residual, 1.01 * nearest);
    }
    EXPECT_GE(missed, 30);
}

TEST(Linkage, ContradictingDriversComeAsCloseAsPossible) {
    // Two cranks that would tear it apart half way.
    Machine machine{Expected<LinkageSketch>(five_bar())};
    const double reach = 2.0 * std::hypot(1.0, 0.8);
    for (const double open : {0.3, 0.7, 1.2}) {
        const double left = deg(90) + open, right = deg(90) - 1.5 * open;
        const LinkDriver drivers[] = {{machine.link("left"), left}, {machine.link("right"), right}};
        const LinkageReport report = machine.solver.solve(machine.state, {drivers, {}});
        double nearest = 1e9;
        for (int i = -1000; i <= 1000; ++i)
            for (int k = -1000; k <= 1000; k += 1) {
                const double a = left + 0.001 * i, b = right + 0.001 * k;
                const double apart = std::hypot(2.0 + std::cos(b) - std::cos(a), std::sin(b) - std::sin(a));
                if (apart <= reach)
                    nearest =
                        std::min(nearest, 1e-6 * (static_cast<double>(i) * i + static_cast<double>(k) * k));
                if (i % 10) k += 9;
            }
        const double a = machine.value("left") - left, b = machine.value("right") - right;
        EXPECT_LE(std::hypot(a, b), 1.01 * std::sqrt(nearest) + 1e-6) << open;
        EXPECT_EQ(report.status, nearest > 0.0 ? LinkageStatus::DeadPoint : LinkageStatus::Reached);
    }
}

LABEL(slow, "Linkage.JansensLegTakesAllItsModesInTurn");

// Each of its three dyads may cross on either side.
TEST(Linkage, JansensLegTakesAllItsModesInTurn) {
    const Jansen lengths;
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = lengths;
    using Point = glm::dvec2;
    const auto crossing = [](const Point& p, double from_p, const Point& q, double from_q, bool left) {
        const Point way = q - p;
        const double apart = glm::length(way),
                     along = (apart * apart + from_p * from_p - from_q * from_q) / (2.0 * apart);
        const double beside = std::sqrt(from_p * from_p - along * along);  // NaN: they do not meet
        return p + along / apart * way + (left ? 1.0 : -1.0) * beside / apart * Point(-way.y, way.x);
    };
    std::size_t all = 0;
    for (int angle = 7; angle < 360; angle += 20) {
        Machine machine{jansen()};
        machine.drive("motor", deg(angle));
        const Point crank = m * Point(std::cos(deg(angle)), std::sin(deg(angle))), pivot(-a, -l);
        std::vector<Point> feet;
        for (int sides = 0; sides < 8; ++sides) {
            const Point upper = crossing(pivot, b, crank, j, (sides & 1) != 0),
                        lower = crossing(crank, k, pivot, c, (sides & 2) != 0),
                        back = crossing(pivot, d, upper, e, true),  // one bar with `upper`
                knee = crossing(lower, g, back, f, (sides & 4) != 0),
                        foot = crossing(lower, i, knee, h, true);
            if (std::isfinite(foot.x)) feet.push_back(foot);
        }
        std::vector<std::size_t> seen;
        for (std::size_t turn = 0; turn < 2 * feet.size(); ++turn) {
            const LinkDriver driver{machine.link("motor"), machine.value("motor")};
            ASSERT_TRUE(machine.solver.other_mode(machine.state, {&driver, 1}));
            machine.solver.solve(machine.state, {{&driver, 1}, {}});
            const Point foot(machine.point("foot"));
            const auto is = std::ranges::find_if(
                feet, [&](const Point& each) { return glm::distance(each, foot) < 1e-4; });
            ASSERT_NE(is, feet.end()) << angle;
            seen.push_back(static_cast<std::size_t>(is - feet.begin()));
        }
        for (std::size_t each = 0; each < feet.size(); ++each)
            EXPECT_EQ(std::ranges::count(seen, each), 2)
                << angle << ": mode " << each << " of " << feet.size();
        all += feet.size();
    }
    EXPECT_GT(all, 100u);
    Machine machine{jansen()};
    EXPECT_FALSE(machine.solver.other_mode(machine.state, std::vector<LinkDriver>{{0, nan}}));
}

TEST(Linkage, ATargetThatPullsItPastADeadPointIsReported) {
    // The rocker's motor cannot pass its dead point; a pull on the crank's end does.
    Machine machine{four_bar({.ground = 3.0, .crank = 1.0, .coupler = 2.5, .rocker = 2.0})};
    const std::size_t watched[] = {machine.link("rocker")};
    const std::size_t crank[] = {machine.link("crank")};
    int rocker_passed = 0, crank_passed = 0;
    for (int degrees = 0; degrees <= 360; degrees += 2) {
        const LinkTarget target{machine.point_index("B"),
                                {std::cos(deg(degrees)), std::sin(deg(degrees)), 0.0}};
        LinkageState other = machine.state;
        const LinkageReport report =
            machine.solver.solve(machine.state, {{}, {&target, 1}}, {.watched = watched});
        rocker_passed += report.passed_dead_point;
        crank_passed += machine.solver.solve(other, {{}, {&target, 1}}, {.watched = crank}).passed_dead_point;
        ASSERT_EQ(report.status, LinkageStatus::Reached) << degrees;
        EXPECT_EQ(other, machine.state);
    }
    EXPECT_EQ(rocker_passed, 2);
    EXPECT_EQ(crank_passed, 0);
}

TEST(Linkage, ARangeStopsADriverAndIsNamed) {
    LinkageSketch sketch = *four_bar();
    sketch.motors.push_back({"rocker", 3, 2, ground_link, 0.0, deg(120)});
    Machine machine{Expected<LinkageSketch>(sketch)};
    LinkageReport report;
    bool limited = false;
    for (int degrees = 0; degrees <= 180 && !limited; ++degrees) {
        report = machine.drive("crank", deg(degrees));
        limited = report.status == LinkageStatus::Limited;
        ASSERT_LE(machine.value("rocker"), deg(120) + 1e-9);
    }
    ASSERT_TRUE(limited);
    ASSERT_EQ(machine.solver.active().size(), 1u);
    EXPECT_EQ(machine.solver.active()[0], machine.link("rocker"));
    EXPECT_EQ(report.stopped, machine.link("crank"));
    EXPECT_NEAR(machine.value("rocker"), deg(120), 1e-6);
    // The driver's own range stops it, too.
    sketch.motors = {{"crank", 0, 0, ground_link, -1.0, 0.5}};
    Machine own{Expected<LinkageSketch>(sketch)};
    report = own.drive("crank", 2.0);
    EXPECT_EQ(report.status, LinkageStatus::Limited);
    EXPECT_NEAR(own.value("crank"), 0.5, 1e-12);
    EXPECT_EQ(report.stopped, own.link("crank"));
}

TEST(Linkage, ATargetRespectsRangesOfHingesSlidersAndBalls) {
    // A slider along X, a ball joint on it, and an arm of 1 m along X.
    Linkage linkage{
        .links = {{"carriage", ground_link, LinkJoint::Slider, {0, 0, 0}, {1, 0, 0}, 0.0, -0.5, 0.5},
                  {"arm", 0, LinkJoint::Ball, {0, 0, 0}}}};
    linkage.links[1].maximum = deg(60);
    linkage.points = {{"hand", 1, {1, 0, 0}}};
    Machine machine{Expected<Linkage>(linkage)};
    Random random(8);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 to = 2.0 * glm::dvec3(random.point(1.0f));
        const LinkageReport report = machine.reach("hand", to);
        // The nearest point of all caps, by brute force over the slider.
        double nearest = 1e9;
        for (int k = -500; k <= 500; ++k) {
            const glm::dvec3 from = to - glm::dvec3(0.001 * k, 0.0, 0.0);
            const double aside = std::hypot(from.y, from.z);
            const double angle = std::min(std::atan2(aside, from.x), deg(60));
            nearest = std::min(nearest, std::hypot(from.x - std::cos(angle), aside - std::sin(angle)));
        }
        EXPECT_LE(report.residual, 1.01 * nearest + 2e-3) << i;
        EXPECT_LE(std::abs(machine.value("carriage")), 0.5);
        EXPECT_LE(2.0 * std::acos(std::min(1.0, std::abs(machine.state.joints[1].turn.w))), deg(60) + 1e-7);
    }
}

TEST(Linkage, InATiltedPlaneOnlyTheInPlanePartCounts) {
    // The four-bar, rotated about X.
    const auto tilted = [](const glm::dvec3& at) {
        return glm::dvec3(at.x, 0.6 * at.y - 0.8 * at.z, 0.8 * at.y + 0.6 * at.z);
    };
    Linkage linkage = *linkage_from(*four_bar());
    for (Link& each : linkage.links) each.at = tilted(each.at), each.axis = tilted(each.axis);
    for (LinkPoint& each : linkage.points) each.at = tilted(each.at);
    for (Closure& each : linkage.closures)
        each.first_at = tilted(each.first_at), each.second_at = tilted(each.second_at);
    Machine machine{Expected<Linkage>(linkage)}, flat{four_bar()};
    EXPECT_TRUE(machine.solver.planar());
    EXPECT_EQ(machine.solver.freedom(machine.state), (LinkageFreedom{1, 1}));
    flat.drive("crank", 1.0);
    const LinkageReport report = machine.reach("P", tilted(flat.point("P") + glm::dvec3(0.0, 0.0, 0.5)));
    EXPECT_EQ(report.status, LinkageStatus::Reached);
    EXPECT_LE(report.residual, 1e-6);
    EXPECT_LE(glm::length(machine.point("P") - tilted(flat.point("P"))), 1e-6);
}

TEST(Linkage, ExactTargetsPrecedeWeightedOnesAndDriversPrecedeBoth) {
    LinkageSketch sketch{
        .points = {{"O", {0, 0}, SketchHold::Pinned}, {"A", {1, 0}}, {"B", {2, 0.2}}, {"C", {3, 0}}},
        .bars = {{"one", {0, 1}}, {"two", {1, 2}}, {"three", {2, 3}}}};
    Machine machine{Expected<LinkageSketch>(sketch)};
    const LinkTarget targets[] = {{3, {1.5, 1.5, 0.0}, 1.0, true}, {1, {-2.0, 2.0, 0.0}, 1000.0, false}};
    LinkageReport report = machine.solver.solve(machine.state, {{}, targets});
    EXPECT_EQ(report.status, LinkageStatus::TargetMissed);
    EXPECT_LE(machine.solver.residuals()[0], 1e-6);
    EXPECT_GT(machine.solver.residuals()[1], 1.0);
    // Over all poses with C at its target, A is as close to its own target as possible: on its circle about
    // O, where the two other bars still reach C.
    double nearest = 1e9;
    const double two = glm::length(glm::dvec2(1.0, 0.2));
    for (int i = 0; i < 36000; ++i) {
        const glm::dvec2 a(std::cos(deg(0.01 * i)), std::sin(deg(0.01 * i)));
        const double apart = glm::length(a - glm::dvec2(1.5, 1.5));
        if (apart <= 2.0 * two) nearest = std::min(nearest, glm::length(a - glm::dvec2(-2.0, 2.0)));
    }
    EXPECT_LE(machine.solver.residuals()[1], 1.01 * nearest);
    const LinkDriver driver{0, 1.0};
    report = machine.solver.solve(machine.state, {{&driver, 1}, targets});
    EXPECT_LE(report.driver_residual, 1e-12);
    EXPECT_LE(machine.solver.residuals()[0], 1e-6);
    // Two targets in conflict: the heavier one comes closer.
    for (const double weight : {1.0, 100.0}) {
        const LinkTarget apart[] = {{3, {0, 9, 0}, weight}, {2, {0, -9, 0}, 1.0}};
        machine.solver.solve(machine.state, {{}, apart});
        const double high = machine.point("C").y;
        EXPECT_EQ(high > 1.5, weight > 1.0) << high;
    }
}

TEST(Linkage, CountsFreedomByGrueblerAndActually) {
    const auto freedom = [](Machine machine) { return machine.solver.freedom(machine.state); };
    EXPECT_EQ(freedom(Machine(four_bar())), (LinkageFreedom{1, 1}));
    EXPECT_EQ(freedom(Machine(jansen())), (LinkageFreedom{1, 1}));
    EXPECT_EQ(freedom(Machine(pantograph())), (LinkageFreedom{2, 2}));
    EXPECT_EQ(freedom(Machine(delta())), (LinkageFreedom{3, 3}));
    EXPECT_EQ(freedom(Machine(stewart())), (LinkageFreedom{6, 6}));
    // By the count a third rocker is one too many, but as it is parallel the linkage still moves.
    LinkageSketch sketch;
    const SketchHold pinned = SketchHold::Pinned;
    sketch.points = {{"A", {0, 0}, pinned}, {"B", {1, 0}, pinned}, {"C", {2, 0}, pinned},
                     {"P", {0.5, 1}},       {"Q", {1.5, 1}},       {"R", {2.5, 1}}};
    sketch.bars = {{"a", {0, 3}}, {"b", {1, 4}}, {"c", {2, 5}}, {"coupler", {3, 4, 5}}};
    sketch.motors = {{"a", 0, 0}};
    Machine machine{Expected<LinkageSketch>(sketch)};
    EXPECT_EQ(machine.solver.freedom(machine.state), (LinkageFreedom{0, 1}));
    for (int i = 0; i < 50; ++i) {
        const LinkageReport report = machine.drive("a", machine.value("a") + 0.02);
        ASSERT_EQ(report.status, LinkageStatus::Reached);
        ASSERT_LE(report.closed_to, 1e-6);
        ASSERT_EQ(report.freedom, 0);
    }
    // A truss: nothing moves, and a target is simply missed.
    sketch.points[5].at.x = 2.2;
    EXPECT_FALSE(linkage_from(sketch)) << "its motor could not turn";
    sketch.motors.clear();
    Machine truss{Expected<LinkageSketch>(sketch)};
    EXPECT_EQ(truss.solver.freedom(truss.state).actual, 0);
    EXPECT_EQ(truss.reach("P", {5, 5, 0}).status, LinkageStatus::TargetMissed);
    EXPECT_LE(glm::length(truss.point("P") - glm::dvec3(0.5, 1, 0)), 1e-6);
    EXPECT_EQ(truss.drive("a", 0.1).status, LinkageStatus::DeadPoint);
}

TEST(Linkage, ASketchGivesItsLinkageAfterEdits) {
    LinkageSketch sketch = *jansen();
    ASSERT_TRUE(remove_point(sketch, *sketch.find_point("foot")));
    EXPECT_EQ(sketch.bars[*sketch.find_bar("ghi")].points.size(), 2u);
    Machine shorter{Expected<LinkageSketch>(sketch)};
    EXPECT_EQ(shorter.drive("motor", 1.0).status, LinkageStatus::Reached);
    ASSERT_TRUE(remove_bar(sketch, *sketch.find_bar("j")));
    Machine loose{Expected<LinkageSketch>(sketch)};
    EXPECT_EQ(loose.solver.freedom(loose.state), (LinkageFreedom{2, 2}));
    ASSERT_TRUE(remove_point(sketch, *sketch.find_point("axis")));
    EXPECT_TRUE(sketch.motors.empty());
    EXPECT_FALSE(sketch.find_bar("m"));
    EXPECT_FALSE(remove_point(sketch, 99));
    EXPECT_FALSE(remove_bar(sketch, 99));
    // A motor between two bars: its angle is between them, whichever of them is the parent.
    LinkageSketch elbow{.points = {{"O", {0, 0}, SketchHold::Pinned}, {"A", {1, 0}}, {"B", {1, 1}}},
                        .bars = {{"upper", {0, 1}}, {"lower", {1, 2}}}};
    elbow.motors = {{"elbow", 1, 1, 0}};
    Machine arm{Expected<LinkageSketch>(elbow)};
    EXPECT_EQ(arm.drive("elbow", 0.0).status, LinkageStatus::Reached);
    EXPECT_NEAR(glm::length(arm.point("B")), 0.0, 1e-9);
    std::swap(elbow.motors[0].bar, elbow.motors[0].against);
    Machine reversed{Expected<LinkageSketch>(elbow)};
    EXPECT_NEAR(reversed.value("elbow"), deg(90), 1e-12);
    EXPECT_EQ(reversed.drive("elbow", deg(135)).status, LinkageStatus::Reached);
    EXPECT_NEAR(reversed.point("B").x, 1.0 + std::sqrt(0.5), 1e-9);
}

TEST(Linkage, InvalidLinkagesAreRefusedByNameAndPlace) {
    const LinkageSketch good = *four_bar();
    const auto refused = [&](auto change, const char* words) {
        LinkageSketch sketch = good;
        change(sketch);
        const Expected<Linkage> linkage = linkage_from(sketch);
        ASSERT_FALSE(linkage) << words;
        EXPECT_TRUE(says(linkage.message(), words)) << linkage.message();
    };
    refused([](auto& s) { s.bars[1].points = {1}; }, "bar \"coupler\" 2 to 512 points 1");
    refused([](auto& s) { s.bars[1].points = {1, 77}; }, "bars 1 points 1 index of points 77");
    refused([](auto& s) { s.bars[1].points = {1, 1}; }, "bar \"coupler\" length");
    refused([](auto& s) { s.points[2].at = s.points[1].at; }, "bar \"coupler\" length");
    refused(
        [](auto& s) {
            s.points[0].hold = s.points[3].hold = SketchHold::Free;
            s.motors.clear();
        },
        "bar \"crank\" pinned or guided");
    refused([](auto& s) { s.motors.push_back({"second", 0, 0}); }, "motor \"second\" no other motor");
    refused([](auto& s) { s.motors[0].bar = 9; }, "motors 0 bar index of bars 9");
    refused([](auto& s) { s.motors[0].point = 1; }, "motor \"crank\" pinned point turn against point \"B\"");
    refused(
        [](auto& s) {
            s.motors[0].minimum = 2.0;
            s.motors[0].maximum = 1.0;
        },
        "motor \"crank\" minimum at most its maximum 2");
    refused(
        [](auto& s) {
            s.motors[0].minimum = 2.0;
            s.motors[0].maximum = 3.0;
        },
        "motor \"crank\" within its range 0");
    refused([](auto& s) { s.motors[0].point = 3; }, "motor \"crank\" a point of its bar point \"D\"");
    refused([](auto& s) { s.motors[0].against = 2; }, "motor \"crank\" another bar bar \"rocker\"");
    refused([](auto& s) { s.motors[0].name = "rocker"; }, "different names two \"rocker\"");
    const auto bad = [](auto change, const char* words) {
        Linkage linkage = *linkage_from(*four_bar());
        change(linkage);
        EXPECT_FALSE(LinkageSolver::make(linkage)) << words;
        EXPECT_TRUE(says(check(linkage).message(), words)) << check(linkage).message();
    };
    bad([](auto& l) { l.links[1].parent = 1; }, "links 1 parent earlier link 1");
    bad([](auto& l) { l.links[1].axis = glm::dvec3(0.0); }, "links 1 axis longer than 0");
    bad([](auto& l) { l.links[1].minimum = l.links[1].rest + 1.0; }, "links 1 rest within its range");
    bad([](auto& l) { l.points[0].link = 9; }, "points 0 link index 9");
    bad([](auto& l) { l.closures[0].second = l.closures[0].first; }, "closures 0 second other than its first");
    bad([](auto& l) { l.links[1].name = l.links[0].name; }, "links 1 name no earlier link crank");
    const auto bad_ball = [&](double Link::*field, double value, const char* words) {
        bad(
            [&](auto& l) {
                l.links[1].joint = LinkJoint::Ball;
                l.links[1].*field = value;
            },
            words);
    };
    bad_ball(&Link::maximum, 5.0, "links 1 maximum 0 to pi 5");
    bad_ball(&Link::maximum, -1.0, "links 1 maximum 0 to pi -1");
    EXPECT_TRUE(says(four_bar({.ground = 9.0}).message(), "four_bar ground other three together 9"));
    EXPECT_TRUE(says(slider_crank({.offset = 9.0}).message(), "slider_crank offset crank and rod 9"));
    EXPECT_TRUE(says(jansen({.k = 999.0}).message(), "jansen k triangle"));
    EXPECT_TRUE(says(peaucellier({.crank = 9.0}).message(), "peaucellier crank"));
    EXPECT_TRUE(says(delta({.forearm = 0.01}).message(), "delta forearm"));
    EXPECT_TRUE(says(stewart({.height = 9.0}).message(), "stewart height"));
    EXPECT_TRUE(says(stewart({.minimum = 3.0}).message(), "stewart minimum at most the maximum 3"));
    EXPECT_TRUE(says(four_bar({.crank = nan}).message(), "four_bar crank nan"));
}

TEST(Linkage, AMissingPointIsAtTheOriginAndAnEmptyLinkageIsSolved) {
    Machine machine{four_bar()};
    EXPECT_EQ(machine.solver.point(99), glm::dvec3(0.0));
    LinkageSolver empty = std::move(*LinkageSolver::make({}));
    LinkageState none = empty.initial_state();
    EXPECT_EQ(empty.solve(none).status, LinkageStatus::Reached);
}

TEST(Linkage, FarTurnsTakeSeveralSolvesAndAreReported) {
    Machine machine{four_bar()};
    const LinkageReport report = machine.drive("crank", 1e8);
    EXPECT_EQ(report.status, LinkageStatus::IterationLimit);
    EXPECT_LE(report.closed_to, 1e-6);
    EXPECT_GT(machine.value("crank"), 50.0);
}

// A workspace keeps nothing between solves, and solving allocates nothing.
TEST(Linkage, ANewSolverGivesTheSameBitsAndNoneAllocates) {
    Machine machine{jansen()};
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        LinkageState copy = machine.state;
        LinkageSolver fresh = std::move(*LinkageSolver::make(machine.solver.linkage()));
        const LinkDriver driver{machine.link("motor"), 3.0 * static_cast<double>(random.around(1.0f))};
        const LinkTarget target{machine.point_index("foot"), 100.0 * glm::dvec3(random.point(1.0f))};
        const bool drive = random.chance(2);
        const LinkageGoals goals = drive ? LinkageGoals{{&driver, 1}, {}} : LinkageGoals{{}, {&target, 1}};
        const std::size_t watched[] = {driver.link};
        LinkageReport one, other;
        without_memory([&] { one = machine.solver.solve(machine.state, goals, {.watched = watched}); });
        other = fresh.solve(copy, goals, {.watched = watched});
        ASSERT_EQ(one, other) << i;
        ASSERT_EQ(machine.state, copy) << i;
    }
}

}  // namespace
}  // namespace tendril::test::ik_linkage_test
