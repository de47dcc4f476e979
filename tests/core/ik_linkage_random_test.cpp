// Random linkages: closed for any drive and drag, from any state, there and back; and hostile ones.
#include "ik_linkage_support.hpp"

namespace tendril::test::ik_linkage_random_test {
namespace {

using namespace linkage;

/// The largest change of a bar's length or a pin's position.
double distortion(const LinkageSketch& sketch, const LinkageSolver& solver) {
    double largest = 0.0;
    const auto length_of = [&](std::size_t a, std::size_t b) {
        return glm::length(solver.point(a) - solver.point(b));
    };
    for (const SketchBar& bar : sketch.bars)
        for (const std::size_t each : bar.points)
            largest = std::max(
                largest, std::abs(length_of(bar.points[0], each) -
                                  glm::length(sketch.points[bar.points[0]].at - sketch.points[each].at)));
    for (std::size_t i = 0; i < sketch.points.size(); ++i)
        if (sketch.points[i].hold == SketchHold::Pinned)
            largest = std::max(largest, glm::length(glm::dvec2(solver.point(i)) - sketch.points[i].at));
    return largest;
}

// 10^5 poses were run once, with `linkages` set to 2000.
TEST(Linkage, RandomOnesStayClosedWhenDrivenAndDragged) {
    constexpr int linkages = 20;
    Random random(21);
    int poses = 0, driven = 0, reached = 0;
    for (int trial = 0; trial < linkages; ++trial) {
        const LinkageSketch sketch = random_sketch(random);
        const Expected<Linkage> linkage = linkage_from(sketch);
        ASSERT_TRUE(linkage) << linkage.message();
        Machine machine(linkage);
        for (int i = 0; i < 50; ++i) {
            const bool drive = random.chance(2);
            const LinkTarget target{1 + random.below(sketch.points.size() - 1), random_place(random, 3.0f)};
            const LinkageReport report =
                drive ? machine.drive("motor",
                                      machine.value("motor") + static_cast<double>(random.around(1.0f)))
                      : machine.solver.solve(machine.state, {{}, {&target, 1}});
            ASSERT_NE(report.status, LinkageStatus::Open) << trial << " " << i;
            ASSERT_LE(report.closed_to, 1e-6 * machine.solver.size()) << trial << " " << i;
            ASSERT_LE(distortion(sketch, machine.solver), 1e-6 * machine.solver.size());
            ++poses;
            if (!drive) continue;
            ++driven;
            reached += report.status == LinkageStatus::Reached;
            // Without ranges, a driver stops only at a dead point, with no freedom left.
            if (report.status == LinkageStatus::Reached) continue;
            ASSERT_EQ(report.status, LinkageStatus::DeadPoint) << trial << " " << i;
            ASSERT_EQ(report.stopped, machine.link("motor"));
            ASSERT_GT(report.driver_residual, 1e-6);
        }
    }
    EXPECT_GE(reached, driven / 2);
}

TEST(Linkage, ClosesFromAnyStateIfAPoseExists) {
    Random random(4);
    int closed = 0;
    constexpr int trials = 100;
    for (int trial = 0; trial < trials; ++trial) {
        Machine machine(linkage_from(random_sketch(random)));
        for (std::size_t i = 0; i < machine.state.joints.size(); ++i)
            machine.state.joints[i].value += 3.0 * static_cast<double>(random.around(1.0f));
        closed += machine.solver.solve(machine.state).status == LinkageStatus::Reached;
    }
    EXPECT_GE(closed, trials - 1);
}

// Forward and back at any pace gives the same pose, unless a dead point came in between.
TEST(Linkage, RandomOnesReturnOnTheSamePath) {
    Random random(33);
    int compared = 0;
    for (int trial = 0; trial < 100; ++trial) {
        Machine machine(linkage_from(random_sketch(random)));
        const double from = machine.value("motor"), by = static_cast<double>(random.around(2.0f));
        if (machine.drive("motor", from).freedom != 0) continue;
        const LinkageState before = machine.state;
        bool reached = true;
        for (int i = 1; i <= 8; ++i)
            reached = machine.drive("motor", from + by * i / 8.0).status == LinkageStatus::Reached && reached;
        for (const double part : {0.7, 0.0})
            reached = machine.drive("motor", from + by * part).status == LinkageStatus::Reached && reached;
        if (!reached) continue;
        ++compared;
        for (std::size_t i = 0; i < before.joints.size(); ++i)
            ASSERT_NEAR(machine.state.joints[i].value, before.joints[i].value, 1e-5) << trial << " " << i;
    }
    EXPECT_GE(compared, 25);
}

/// A linkage in space: all kinds of joints, ranges, any scale; closures may contradict each other.
Linkage random_linkage(Random& random) {
    constexpr float scales[] = {1.0f, 1.0f, 1e-4f, 1e6f};
    const float scale = scales[random.below(4)];
    const auto place = [&] { return glm::dvec3(random.point(scale)); };
    Linkage linkage;
    const std::size_t count = 1 + random.below(8);
    for (std::size_t i = 0; i < count; ++i) {
        Link link{.parent = i > 0 && !random.chance(3) ? random.below(i) : ground_link,
                  .joint = static_cast<LinkJoint>(random.below(3)),
                  .at = random.chance(6) ? glm::dvec3(0.0) : place(),
                  .axis = glm::dvec3(random.point(1.0f)) + glm::dvec3(0.0, 0.0, 1e-3)};
        if (random.chance(3)) {
            const double width = random.chance(4) ? 0.0 : static_cast<double>(random.part());
            link.minimum = -width;
            link.maximum = width;
        }
        linkage.links.push_back(link);
        linkage.points.push_back({"", i, place()});
    }
    for (std::size_t i = random.below(4); i-- > 0 && count > 1;) {
        const std::size_t first = 1 + random.below(count - 1);
        Closure closure{.kind = random.chance(3) ? ClosureKind::Frame : ClosureKind::Point,
                        .first = first,
                        .second = random.chance(2) ? ground_link : random.below(first)};
        closure.first_at = closure.second_at = place();
        if (random.chance(2)) closure.second_at = place();
        linkage.closures.push_back(closure);
    }
    return linkage;
}

void in_range(const Linkage& linkage, const LinkageState& state) {
    for (std::size_t k = 0; k < linkage.links.size(); ++k) {
        const JointPlace& joint = state.joints[k];
        ASSERT_TRUE(std::isfinite(joint.value) && std::isfinite(joint.turn.w));
        if (linkage.links[k].joint == LinkJoint::Ball) {
            const double sine = glm::length(glm::dvec3(joint.turn.x, joint.turn.y, joint.turn.z));
            ASSERT_LE(2.0 * std::atan2(sine, std::abs(joint.turn.w)), linkage.links[k].maximum + 1e-6);
        } else {
            ASSERT_TRUE(joint.value >= linkage.links[k].minimum && joint.value <= linkage.links[k].maximum);
        }
    }
}

TEST(Linkage, AnyLinkageStaysFiniteAndInRange) {
    constexpr int linkages = 60;  // 5000 were run once
    Random random(44);
    for (int trial = 0; trial < linkages; ++trial) {
        const Linkage linkage = random_linkage(random);
        ASSERT_TRUE(check(linkage)) << check(linkage).message();
        Machine machine{Expected<Linkage>(linkage)};
        for (int i = 0; i < 10; ++i) {
            const std::size_t link = random.below(linkage.links.size());
            const LinkDriver driver{link, static_cast<double>(random.around(random.chance(4) ? 1e6f : 2.0f))};
            const LinkTarget target{random.below(linkage.points.size()),
                                    machine.solver.size() * glm::dvec3(random.point(2.0f)), 1.0,
                                    random.chance(2)};
            const bool drive = linkage.links[link].joint != LinkJoint::Ball && random.chance(2);
            const std::size_t draw = random.below(2);
            const LinkageReport report = machine.solver.solve(
                machine.state, {{&driver, drive ? 1u : 0u}, {&target, draw}}, {.max_iterations = 200});
            ASSERT_NE(report.status, LinkageStatus::InvalidInput) << trial;
            const bool open = !machine.solver.open_closures().empty();
            // At the iteration limit, either is possible.
            if (report.status != LinkageStatus::IterationLimit) {
                ASSERT_EQ(open, report.status == LinkageStatus::Open) << trial << " " << i;
            }
            ASSERT_TRUE(open || report.closed_to <= 1e-6 * machine.solver.size()) << trial << " " << i;
            ASSERT_TRUE(std::isfinite(report.residual) && std::isfinite(report.closed_to));
            ASSERT_GE(report.freedom, 0);
            in_range(linkage, machine.state);
        }
    }
}

// A net of 200 links, some of no length, pinned at places that no pose can join, with empty ranges.
TEST(Linkage, TwoHundredContradictingLinksEndWithAStatus) {
    Random random(9);
    for (const bool space : {false, true}) {
        Linkage linkage;
        for (std::size_t i = 0; i < 200; ++i) {
            Link link{.parent = i % 10 == 0 ? ground_link : i - 1,
                      .joint = space ? static_cast<LinkJoint>(random.below(3)) : LinkJoint::Hinge,
                      .at = i % 7 == 3 ? linkage.links[i - 1].at : random_place(random, 2.0f)};
            if (random.chance(4) && link.joint != LinkJoint::Ball) link.minimum = link.maximum = 0.0;
            if (random.chance(8)) link.maximum = 0.0;
            linkage.links.push_back(link);
            if (i % 10 != 9) continue;
            linkage.points.push_back({"", i, random_place(random, 2.0f)});
            linkage.closures.push_back({"", ClosureKind::Point, i, i > 10 ? i - 10 : ground_link,
                                        random_place(random, 2.0f), random_place(random, 3.0f)});
        }
        ASSERT_TRUE(check(linkage)) << check(linkage).message();
        Machine machine{Expected<Linkage>(linkage)};
        const LinkTarget target{3, {50.0, -20.0, 0.0}, 1.0, true};
        const LinkageReport report =
            machine.solver.solve(machine.state, {{}, {&target, 1}}, {.max_iterations = 12});
        EXPECT_NE(report.status, LinkageStatus::InvalidInput);
        EXPECT_TRUE(std::isfinite(report.closed_to) && std::isfinite(report.residual));
        EXPECT_EQ(report.closed_to > 1e-6 * machine.solver.size(), !machine.solver.open_closures().empty());
        in_range(linkage, machine.state);
    }
}

}  // namespace
}  // namespace tendril::test::ik_linkage_random_test
