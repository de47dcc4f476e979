// Linkages: a report's claims are true for any drive, and every step continues along its branch.
#include "ik_linkage_support.hpp"

namespace tendril::test::ik_linkage_verdict_test {
namespace {

using namespace linkage;
constexpr SketchHold pinned = SketchHold::Pinned;

// 20000 solves were run once.
TEST(Linkage, AtADeadPointADriverIsOffItsValue) {
    Machine machine{Expected<LinkageSketch>(five_bar())};
    Random random(7);
    const std::size_t left = machine.link("left"), right = machine.link("right");
    int stopped = 0, reached = 0;
    for (int i = 0; i < 1500; ++i) {
        const auto step = [&] { return static_cast<double>(random.around(1.5f)); };
        const LinkDriver drivers[] = {{left, machine.value("left") + step()},
                                      {right, machine.value("right") + step()}};
        const LinkageReport report = machine.solver.solve(machine.state, {drivers, {}});
        if (report.status == LinkageStatus::DeadPoint) {
            ++stopped;
            ASSERT_GT(report.driver_residual, 1e-6) << i;
            ASSERT_TRUE(report.stopped) << i;
        }
        if (report.status != LinkageStatus::Reached) continue;
        ++reached;
        ASSERT_LE(report.driver_residual, 1e-6) << i;
        ASSERT_FALSE(report.stopped) << i;
    }
    EXPECT_GE(stopped, 100);
    EXPECT_GE(reached, 100);
}

TEST(Linkage, ARangeThatStopsDriversIsNamedInAnyPose) {
    Random random(5);
    int limited = 0;
    for (int trial = 0; trial < 60; ++trial) {
        Linkage linkage = *linkage_from(five_bar());
        for (const char* name : {"BC", "CD"}) {
            Link& link = linkage.links[linkage.find_link(name).value()];
            link.minimum = link.rest - 0.4 * static_cast<double>(random.part());
            link.maximum = link.rest + 0.4 * static_cast<double>(random.part());
        }
        Machine machine{Expected<Linkage>(linkage)};
        const double left = static_cast<double>(random.around(0.1f)),
                     right = static_cast<double>(random.around(0.1f));
        for (int i = 0; i < 20; ++i) {
            const LinkDriver drivers[] = {{machine.link("left"), machine.value("left") + left},
                                          {machine.link("right"), machine.value("right") + right}};
            const LinkageReport report = machine.solver.solve(machine.state, {drivers, {}});
            if (report.status == LinkageStatus::Reached) continue;
            ASSERT_EQ(report.status, LinkageStatus::Limited) << trial << " " << i;
            ASSERT_FALSE(machine.solver.active().empty()) << trial << " " << i;
            for (const std::size_t each : machine.solver.active()) {
                const Link& link = linkage.links[each];
                const double value = machine.state.joints[each].value;
                ASSERT_LE(std::min(value - link.minimum, link.maximum - value), 1e-6) << trial << " " << i;
            }
            ++limited;
        }
    }
    EXPECT_GE(limited, 100);
}

struct Drag {
    int jumps = 0;
    double at = 0.0;             ///< fraction of the path
    double jump = 0.0;           ///< metres
    double largest_other = 0.0;  ///< move of the point in a frame without a jump, relative to the target's
    int most_iterations = 0;     ///< in a frame without a jump
};

/// Drags a point along a straight line in `steps` steps.
Drag drag(Machine machine, const std::string& point, const glm::dvec3& from, const glm::dvec3& to,
          int steps) {
    Drag result;
    machine.reach(point, from);
    machine.reach(point, from);
    for (int i = 1; i <= steps; ++i) {
        const double part = static_cast<double>(i) / steps;
        const glm::dvec3 before = machine.point(point);
        const LinkageReport report = machine.reach(point, from + part * (to - from));
        const double moved = glm::length(machine.point(point) - before);
        if (report.jumped) {
            ++result.jumps;
            result.at = part;
            result.jump = report.jump;
            EXPECT_EQ(*report.jumped, 0u);
            EXPECT_NEAR(report.jump, moved, 1e-9);
            continue;
        }
        result.largest_other = std::max(result.largest_other, moved * steps / glm::length(to - from));
        result.most_iterations = std::max(result.most_iterations, report.iterations);
    }
    return result;
}

// As the target leaves the coupler curve's evolute, the nearest point of the curve vanishes.
TEST(Linkage, AJumpOfATargetsPointIsReportedOnceAtAnyStep) {
    for (const int steps : {50, 200, 1000}) {
        const Drag coupler = drag(Machine{four_bar()}, "P", {-1.5, 1.4, 0}, {3, 1.4, 0}, steps);
        EXPECT_EQ(coupler.jumps, 1) << steps;
        EXPECT_NEAR(coupler.at, 0.5555, 1.0 / steps) << steps;
        EXPECT_GT(coupler.jump, 0.8) << steps;
        const Drag foot = drag(Machine{jansen()}, "foot", {-60, -60, 0}, {20, -60, 0}, steps);
        EXPECT_EQ(foot.jumps, 1) << steps;
        EXPECT_GT(foot.jump, 15.0) << steps;
        // The crank's end turns quickly as the target passes its axis, but does not jump.
        for (const double beside : {0.2, -0.4}) {
            const Drag crank = drag(Machine{slider_crank()}, "B", {1.5, beside, 0}, {-1.5, beside, 0}, steps);
            EXPECT_EQ(crank.jumps, 0) << steps;
            EXPECT_LE(crank.largest_other, 1.1 / std::abs(beside)) << steps;
        }
    }
}

// A distant target pulls hard at once: the motion that follows is rarely called a jump.
TEST(Linkage, ADistantTargetRarelyCausesAReportedJump) {
    Machine machine{four_bar()};
    Random random(6);
    int jumps = 0;
    for (int i = 0; i < 500; ++i)
        jumps += machine.reach("P", glm::dvec3(1, 1, 0) + random_place(random, 2.0f)).jumped.has_value();
    EXPECT_LE(jumps, 50);
}

TEST(Linkage, AnUnreachableTargetTakesFewIterationsPerFrame) {
    int most = 0;
    double share = 0.0;
    const auto circles = [&](Machine machine, const char* point, const glm::dvec3& centre, double radius) {
        constexpr int frames = 240, few = 15;
        int quick = 0;
        most = 0;
        for (int i = -5; i < frames; ++i) {
            const double angle = deg(1.5 * i);
            const LinkageReport report =
                machine.reach(point, centre + radius * glm::dvec3(std::cos(angle), std::sin(angle), 0.0));
            if (i < 0) continue;
            most = std::max(most, report.iterations);
            quick += report.iterations <= few;
        }
        share = static_cast<double>(quick) / frames;
        return most;
    };
    EXPECT_LE(circles(Machine{four_bar()}, "P", {1, 1, 0}, 5.0), 12);
    EXPECT_LE(circles(Machine{slider_crank()}, "B", {0, 0, 0}, 4.0), 12);
    EXPECT_LE(circles(Machine{jansen()}, "crank", {0, 0, 0}, 60.0), 12);
    // Where it jumps, or ranges end its path, a few frames take more.
    LinkageSketch limited = *four_bar();
    limited.motors.push_back({"rocker", 3, 2, ground_link, 0.0, 2.0});
    circles(Machine{four_bar()}, "P", {0.9, 1.4, 0}, 0.3);
    EXPECT_GE(share, 0.95) << most;
    circles(Machine{Expected<LinkageSketch>(limited)}, "P", {1, 1, 0}, 3.0);
    EXPECT_GE(share, 0.95) << most;
    circles(Machine{delta()}, "platform", {0, 0, -0.6}, 0.5);
    EXPECT_GE(share, 0.95) << most;
    for (const int bars : {3, 10, 40}) {
        LinkageSketch chain{.points = {{"P0", {0, 0}, pinned}}};
        for (std::size_t i = 1; i <= static_cast<std::size_t>(bars); ++i) {
            chain.points.push_back(
                {"P" + std::to_string(i), {static_cast<double>(i), i % 2 == 1 ? 0.3 : 0.0}});
            chain.bars.push_back({"bar_" + std::to_string(i), {i - 1, i}});
        }
        const std::string tip = "P" + std::to_string(bars);
        EXPECT_LE(circles(Machine{Expected<LinkageSketch>(chain)}, tip.c_str(), {0, 0, 0}, 1.5 * bars), 12)
            << bars;
    }
}

/// Drives two turns from the starting angle, and two back.
void stays_a_parallelogram(const FourBar& lengths, double step) {
    Machine machine{four_bar(lengths)};
    for (const double sign : {1.0, -1.0}) {
        const double from = step * std::ceil(machine.value("crank") / step);
        for (int i = 0; i * std::abs(step) <= deg(720); ++i) {
            const LinkageReport report = machine.drive("crank", from + sign * i * step);
            ASSERT_EQ(report.status, LinkageStatus::Reached) << step << " " << i;
            ASSERT_FALSE(report.passed_dead_point) << step << " " << i;
            const glm::dvec3 coupler = machine.point("C") - machine.point("B");
            ASSERT_LE(glm::length(coupler - glm::dvec3(lengths.ground, 0, 0)), 1e-5)
                << lengths.ground << " in steps of " << step / deg(1) << ", step " << i;
        }
    }
}

TEST(Linkage, AParallelogramStaysOneForAnyStep) {
    for (const double ground : {1.0, 1.5, 2.0, 3.0})
        for (const double degrees :
             {1.0, 1.25, 2.0, 3.0, 5.0, 7.5, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0, 179.0, 180.0, 360.0})
            stays_a_parallelogram({.ground = ground, .crank = 1.0, .coupler = ground, .rocker = 1.0},
                                  deg(degrees));
    // Steps that end close to a flat pose, but not in it.
    for (int exponent = -14; exponent <= -2; ++exponent)
        for (const double sign : {-1.0, 1.0})
            stays_a_parallelogram({.ground = 2.0, .crank = 1.0, .coupler = 2.0, .rocker = 1.0},
                                  deg(15) + sign * std::pow(10.0, exponent) / 12.0);
}

// If the shortest and the longest bar are together as long as the other two, two branches cross: large steps
// follow the same branch as small ones.
TEST(Linkage, AtAChangePointLargeStepsContinueLikeSmallOnes) {
    const FourBar lengths{.ground = 3.0, .crank = 1.0, .coupler = 2.5, .rocker = 1.5};
    for (const double degrees : {5.0, 10.0, 15.0, 30.0, 45.0}) {
        Machine fine{four_bar(lengths)}, coarse{four_bar(lengths)};
        const auto to_first = [&](Machine& machine) { machine.drive("crank", deg(45)); };
        to_first(fine), to_first(coarse);
        double at = deg(45);
        for (int i = 1; i * degrees <= 720; ++i) {
            const double to = deg(45) + deg(degrees) * i;
            while (at < to - 1e-9) fine.drive("crank", at = std::min(at + deg(0.5), to));
            ASSERT_EQ(coarse.drive("crank", to).status, LinkageStatus::Reached);
            ASSERT_LE(glm::length(coarse.point("C") - fine.point("C")), 1e-4) << degrees << " " << i;
        }
    }
}

// Bars close to a change point's: the branches are a small distance apart, and a drive stays on its own.
TEST(Linkage, ADriveStaysOnItsBranchWhereTwoNearlyMeet) {
    Random random(53);
    const auto part = [&] { return static_cast<double>(random.part()); };
    int steps = 0;
    for (int i = 0; i < 300; ++i) {
        const double ground = 0.5 + 2.0 * part(), crank = 0.3 + 1.5 * part(), coupler = 0.5 + 2.0 * part();
        const double sums[] = {ground + coupler - crank, ground + crank - coupler, crank + coupler - ground};
        const double off = std::pow(10.0, -7.0 + 5.0 * part()) * (random.chance(2) ? 1.0 : -1.0);
        const double rocker = sums[random.below(3)] * (1.0 + off);
        const auto sketch =
            four_bar({.ground = ground, .crank = crank, .coupler = coupler, .rocker = rocker});
        if (!(rocker > 0.05) || !sketch) continue;
        Machine machine{sketch};
        const auto side = [&] {
            const glm::dvec3 a = machine.point("C") - machine.point("B"),
                             b = machine.point("D") - machine.point("C");
            return a.x * b.y - a.y * b.x;
        };
        ASSERT_TRUE(machine.solver.place(machine.state));
        const double first = side(), step = deg(0.2 + 30.0 * part() * part());
        double at = machine.value("crank");
        for (int k = 0; k < 60 && machine.drive("crank", at += step).status == LinkageStatus::Reached; ++k) {
            ++steps;
            ASSERT_GT(first * side(), 0.0) << i << ", off by " << off << ", at " << at;
        }
    }
    EXPECT_GT(steps, 5000);
}

// A crank and a rocker about skew axes, and a coupler between two balls that is free to spin about itself.
TEST(Linkage, ADriveInSpaceStaysOnItsBranchWhereTwoNearlyMeet) {
    Random random(11);
    const auto part = [&] { return static_cast<double>(random.part()); };
    int steps = 0;
    for (int i = 0; i < 150; ++i) {
        const double crank = 0.3 + part(), rocker = 0.5 + part();
        const glm::dvec3 pivot(1.0 + part(), part() - 0.5, part() - 0.5);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(part() - 0.5, part() - 0.5, 0.3 + part()));
        const glm::dvec3 x = glm::normalize(glm::cross(axis, glm::dvec3(1.0, 0.3, 0.2))),
                         y = glm::cross(axis, x);
        const auto tip = [&](double angle) {
            return crank * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
        };
        // The squared length of the coupler is free + reach * cos(the rocker's angle - phase).
        struct Span {
            double free, reach, phase;
        };
        const auto span_at = [&](double angle) {
            const glm::dvec3 d = pivot - tip(angle);
            const double a = glm::dot(d, x), b = glm::dot(d, y);
            return Span{rocker * rocker + glm::dot(d, d), 2.0 * rocker * std::hypot(a, b), std::atan2(b, a)};
        };
        // Just long enough to reach all round: the two branches nearly meet at `meet`.
        double square = 0.0, meet = 0.0;
        for (double width = 0.01, from = 0.0, to = deg(360); width > 1e-11; width *= 0.01) {
            for (double angle = from; angle < to; angle += width)
                if (const Span span = span_at(angle); span.free - span.reach > square)
                    square = span.free - span.reach, meet = angle;
            from = meet - width, to = meet + width;
        }
        square += std::pow(10.0, -6.0 + 5.0 * part());
        const double start = meet + 2.0;
        const Span span = span_at(start);
        const double cosine = (square - span.free) / span.reach;
        if (std::abs(cosine) > 0.95) continue;
        const double angle = span.phase + std::acos(cosine);
        const glm::dvec3 end = pivot + rocker * (std::cos(angle) * x + std::sin(angle) * y);
        Linkage linkage{
            .links = {{.name = "crank", .at = glm::dvec3(0.0), .rest = start},
                      {.name = "rocker", .at = pivot, .axis = axis, .rest = angle},
                      {.name = "coupler", .parent = 0, .joint = LinkJoint::Ball, .at = tip(start)}},
            .closures = {{"end", ClosureKind::Point, 2, 1, end, end}}};
        Machine machine{Expected<Linkage>(linkage)};
        const double step = deg(0.2 + 30.0 * part() * part());
        double at = start;
        for (int k = 0; k < 60 && machine.drive("crank", at += step).status == LinkageStatus::Reached; ++k) {
            ++steps;
            ASSERT_GT(std::sin(machine.value("rocker") - span_at(at).phase), 0.0) << i << ", at " << at;
        }
    }
    EXPECT_GT(steps, 2000);
}

/// L. Henneberg's two moves (1911) generate all minimally rigid frames in the plane, trusses, prisms and K3,3
/// among them: a joint on two bars; a joint in the middle of a bar, with a third.
TEST(Linkage, AFrameIsOneRigidBodyUntilABarIsRemoved) {
    Random random(29);
    for (int i = 0; i < 60; ++i) {
        LinkageSketch sketch;
        const auto joint = [&] {
            sketch.points.push_back({std::string(1, static_cast<char>('A' + sketch.points.size())),
                                     glm::dvec2(random.point(4.0f))});
            return sketch.points.size() - 1;
        };
        const auto bar = [&](std::size_t a, std::size_t b) {
            sketch.bars.push_back({sketch.points[a].name + sketch.points[b].name, {a, b}});
        };
        joint(), joint(), bar(0, 1);
        while (sketch.points.size() < 9) {
            const std::size_t added = joint();
            if (added > 2 && i % 3 > 0) {
                const std::size_t split = random.below(sketch.bars.size());
                const std::size_t one = sketch.bars[split].points[0], other = sketch.bars[split].points[1];
                std::size_t third = one;
                while (third == one || third == other) third = random.below(added);
                sketch.bars.erase(sketch.bars.begin() + static_cast<std::ptrdiff_t>(split));
                bar(one, added), bar(added, other), bar(third, added);
            } else {
                const std::size_t one = random.below(added);
                bar(added, one), bar((one + 1 + random.below(added - 1)) % added, added);
            }
        }
        for (SketchBar& each : sketch.bars) std::swap(each, sketch.bars[random.below(sketch.bars.size())]);
        EXPECT_EQ(rigid_bodies(sketch), std::vector<std::size_t>(sketch.bars.size(), 0)) << i;
        sketch.points[0].hold = pinned;
        EXPECT_EQ(rigid_bodies(sketch), std::vector<std::size_t>(sketch.bars.size(), 0))
            << i << ", on one pin";
        const std::size_t point = sketch.bars[0].points[0];
        for (std::size_t other = 1; other < sketch.bars.size(); ++other) {
            if (std::ranges::count(sketch.bars[other].points, point) == 0) continue;
            sketch.motors = {{"m", point, 0, other}};
            EXPECT_TRUE(
                says(linkage_from(sketch).message(), "motor m could not turn bar would be one rigid body"));
        }
        sketch.motors.clear();
        sketch.points[8].hold = i % 2 == 0 ? pinned : SketchHold::Guided;
        EXPECT_EQ(rigid_bodies(sketch), std::vector<std::size_t>(sketch.bars.size(), ground_link)) << i;
        sketch.points[8].hold = SketchHold::Free;
        ASSERT_TRUE(remove_bar(sketch, random.below(sketch.bars.size())));
        EXPECT_GT(std::ranges::max(rigid_bodies(sketch)), 0u) << i;
        LinkageSolver solver = *LinkageSolver::make(*linkage_from(sketch));
        EXPECT_EQ(solver.freedom(solver.initial_state()).actual, 2) << i;
    }
}

TEST(Linkage, ACrankDrawnAtItsDeadPointIsNotOneBodyWithTheGround) {
    LinkageSketch sketch{
        .points = {{"A", {0, 0}, pinned}, {"B", {0, 2}}, {"C", {1.5, 1}}, {"D", {3, 0}, pinned}},
        .bars = {{"AB", {0, 1}}, {"BC", {1, 2}}, {"CD", {2, 3}}},
        .motors = {{"m", 0, 0}}};
    EXPECT_TRUE(linkage_from(sketch));
    EXPECT_EQ(rigid_bodies(sketch), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Linkage, AHeldBallBalancesLikeOneLinkWithItsParent) {
    Linkage linkage{
        .links = {{.name = "crank"}, {.name = "rod", .parent = 0, .joint = LinkJoint::Ball, .at = {1, 0, 0}}},
        .closures = {{"end", ClosureKind::Point, 1, ground_link, glm::dvec3(2, 0, 0), glm::dvec3(2, 0, 0)}}};
    LinkageSolver solver = *LinkageSolver::make(linkage);
    const std::size_t ball = 1;
    glm::dvec3 force(0.0);
    EXPECT_GT(solver.balance(solver.initial_state(), 0, {}, {&force, 1}), 0.4);
    EXPECT_NEAR(solver.balance(solver.initial_state(), 0, {&ball, 1}, {&force, 1}), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(force.y), 0.5, 1e-12);
}

TEST(Linkage, AFreeMechanismHasNoOtherMode) {
    Machine loose{four_bar()};
    const LinkageState before = loose.state;
    EXPECT_EQ(loose.solver.other_mode(loose.state, {}).code(), ErrorCode::NotFound);
    EXPECT_EQ(loose.state, before);
    LinkageSketch sketch{.points = {{"O", {0, 0}, pinned}, {"A", {1, 0}}}, .bars = {{"arm", {0, 1}}}};
    Machine pendulum{Expected<LinkageSketch>(sketch)};
    EXPECT_FALSE(pendulum.solver.other_mode(pendulum.state, {}));
    const LinkDriver driver{0, 0.0};
    EXPECT_FALSE(pendulum.solver.other_mode(pendulum.state, {&driver, 1}));
    // A truss has another mode: its mirror image.
    sketch.points = {{"A", {0, 0}, pinned}, {"B", {1, 2}}, {"C", {3, 0}, pinned}};
    sketch.bars = {{"a", {0, 1}}, {"b", {1, 2}}};
    Machine truss{Expected<LinkageSketch>(sketch)};
    ASSERT_TRUE(truss.solver.other_mode(truss.state, {}));
    truss.solver.solve(truss.state);
    EXPECT_LE(glm::length(truss.point("B") - glm::dvec3(1, -2, 0)), 1e-6);
}

TEST(Linkage, OtherModesAreFoundWithoutAllocating) {
    for (const Expected<LinkageSketch>& sketch : {four_bar(), slider_crank({1.0, 3.0, 0.5}), jansen()}) {
        Machine machine{sketch};
        const std::size_t driven =
            machine.solver.linkage().find_link("motor") ? machine.link("motor") : machine.link("crank");
        machine.solver.solve(machine.state);
        const LinkDriver driver{driven, machine.state.joints[driven].value};
        const LinkageState before = machine.state;
        bool found = false;
        LinkageFreedom freedom;
        without_memory([&] {
            found = machine.solver.other_mode(machine.state, {&driver, 1}).ok();
            freedom = machine.solver.freedom(machine.state);
        });
        EXPECT_TRUE(found);
        EXPECT_NE(machine.state, before);
        EXPECT_EQ(freedom.actual, 1);
    }
}

TEST(Linkage, AnUnknownNameIsNotFound) {
    const LinkageSketch sketch = *four_bar();
    const Linkage linkage = *linkage_from(sketch);
    for (const char* name : {"nobody", "", "Crank", "cran", "crank "}) {
        EXPECT_EQ(linkage.find_link(name), std::nullopt) << name;
        EXPECT_EQ(linkage.find_point(name), std::nullopt) << name;
        EXPECT_EQ(sketch.find_point(name), std::nullopt) << name;
        EXPECT_EQ(sketch.find_bar(name), std::nullopt) << name;
    }
    EXPECT_EQ(linkage.find_point("P"), 4u);
    EXPECT_EQ(sketch.find_bar("coupler"), 1u);
}

TEST(Linkage, AMotorsRangeMayIncludeAnyTurnOfItsAngle) {
    LinkageSketch sketch{.points = {{"O", {0, 0}, pinned},
                                    {"A", {-std::cos(deg(172)), -std::sin(deg(172))}},
                                    {"B", {0, -2 * std::sin(deg(172))}}},
                         .bars = {{"upper", {0, 1}}, {"lower", {1, 2}}}};
    // From O (172 degrees) to B (-172).
    const double bend = deg(16);
    sketch.motors = {{"elbow", 1, 1, 0, -0.5, 0.5}};
    const Expected<Linkage> elbow = linkage_from(sketch);
    ASSERT_TRUE(elbow) << elbow.message();
    EXPECT_NEAR(elbow->links[*elbow->find_link("elbow")].rest, bend, 1e-12);
    for (const int turns : {-2, 0, 3}) {
        LinkageSketch turned = *four_bar();
        turned.motors[0].minimum = deg(360 * turns - 10);
        turned.motors[0].maximum = deg(360 * turns + 200);
        const Expected<Linkage> linkage = linkage_from(turned);
        ASSERT_TRUE(linkage) << linkage.message();
        EXPECT_NEAR(linkage->links[*linkage->find_link("crank")].rest, deg(360 * turns), 1e-9);
    }
}

TEST(Linkage, FourBarsOfAllLengthsThatCloseCanBeDrawn) {
    for (const FourBar& lengths :
         {FourBar{1, 1, 1, 1}, FourBar{1, 1, 2, 2}, FourBar{2, 1, 2, 1}, FourBar{2, 2, 1, 1}}) {
        const Expected<LinkageSketch> sketch = four_bar(lengths);
        ASSERT_TRUE(sketch) << sketch.message();
        const Expected<Linkage> linkage = linkage_from(*sketch);
        ASSERT_TRUE(linkage) << linkage.message();
        Machine machine{linkage};
        EXPECT_EQ(machine.drive("crank", machine.value("crank") + 0.1).status, LinkageStatus::Reached);
        EXPECT_NEAR(glm::length(machine.point("C") - machine.point("D")), lengths.rocker, 1e-9);
        EXPECT_NEAR(glm::length(machine.point("C") - machine.point("B")), lengths.coupler, 1e-9);
    }
}

TEST(Linkage, IsNotOpenAtTheIterationLimit) {
    Random random(4);
    int unfinished = 0;
    for (int trial = 0; trial < 40; ++trial) {
        Machine machine(linkage_from(random_sketch(random)));
        for (JointPlace& each : machine.state.joints)
            each.value += 3.0 * static_cast<double>(random.around(1.0f));
        LinkageState hasty = machine.state;
        if (machine.solver.solve(machine.state).status != LinkageStatus::Reached) continue;
        for (int i = 0; i < 400; ++i) {
            const LinkageStatus status = machine.solver.solve(hasty, {}, {.max_iterations = 1}).status;
            if (status == LinkageStatus::Reached) break;
            // Only a minimum that does not close ends in Open.
            if (status == LinkageStatus::Open) break;
            ASSERT_EQ(status, LinkageStatus::IterationLimit);
            ++unfinished;
            EXPECT_FALSE(machine.solver.open_closures().empty());
        }
    }
    EXPECT_GE(unfinished, 20);
}

TEST(Linkage, AStageWithCoincidingJointsAndPointsMoves) {
    Linkage linkage{.links = {{"x", ground_link, LinkJoint::Slider, {0, 0, 0}, {1, 0, 0}},
                              {"y", 0, LinkJoint::Slider, {0, 0, 0}, {0, 1, 0}}},
                    .points = {{"tool", 1, {0, 0, 0}}}};
    for (const double far : {1e-3, 1.0, 1e4}) {
        Machine machine{Expected<Linkage>(linkage)};
        EXPECT_EQ(machine.reach("tool", {far, -2.0 * far, 0.0}).status, LinkageStatus::Reached) << far;
        EXPECT_LE(glm::length(machine.point("tool") - glm::dvec3(far, -2.0 * far, 0.0)), 1e-6);
        EXPECT_EQ(machine.drive("x", -3.0 * far).status, LinkageStatus::Reached) << far;
        EXPECT_EQ(machine.value("x"), -3.0 * far);
    }
    linkage.links[0].minimum = 0.0;
    linkage.links[0].maximum = 4.0;
    EXPECT_EQ(LinkageSolver::make(linkage)->size(), 4.0);
}

TEST(Linkage, FreedomDependsOnThePoseNotOnTheLastSolve) {
    Linkage linkage{.links = {{"arm", ground_link, LinkJoint::Ball, {0, 0, 0}}}};
    linkage.links[0].maximum = deg(60);
    linkage.points = {{"hand", 0, {1, 0, 0}}};
    Machine machine{Expected<Linkage>(linkage)};
    EXPECT_EQ(machine.reach("hand", {-1.0, 0.5, 0.0}).status, LinkageStatus::Limited);
    LinkageSolver fresh = std::move(*LinkageSolver::make(linkage));
    EXPECT_EQ(machine.solver.freedom(machine.state), fresh.freedom(machine.state));
    EXPECT_EQ(machine.solver.freedom(machine.state).actual, 3);
    // The call does not change the solve's result.
    ASSERT_EQ(machine.solver.active().size(), 1u);
    EXPECT_EQ(machine.solver.active()[0], 0u);
}

}  // namespace
}  // namespace tendril::test::ik_linkage_verdict_test
