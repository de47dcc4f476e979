// Cyclic coordinate descent against the textbook: O(n^2), in double, applying each joint's rotation at once.
#include "ik_hostile.hpp"

namespace tendril::test::ik_ccd_test {
namespace {

using ik::Method;
using Wide = std::vector<glm::dvec3>;

void textbook_iteration(Wide& joints, glm::dvec3 target) {
    for (std::size_t i = joints.size() - 1; i-- > 0;) {
        const glm::dvec3 a = joints.back() - joints[i], b = target - joints[i], axis = cross(a, b);
        if (glm::length(axis) < 1e-12) continue;
        const double angle = std::atan2(glm::length(axis), dot(a, b));
        for (std::size_t k = i + 1; k < joints.size(); ++k)
            joints[k] = joints[i] + turned(joints[k] - joints[i], axis / glm::length(axis), angle);
    }
}

ik::Options iterations(int count) {
    ik::Options options{.max_iterations = count, .every_iteration = true};
    return options;
}

TEST(IkCcd, MatchesTheTextbook) {
    Random random(1);
    double worst = 0.0;
    for (int k = 0; k < 300; ++k) {
        const Lengths lengths = some_lengths(2 + random.below(9), random);
        Joints joints = some_pose(lengths, random);
        const auto reach = static_cast<float>(reach_of(lengths));
        const glm::vec3 target = some_direction(random) * some_span(lengths, 0.4f, 0.9f, random);
        Wide wide(joints.begin(), joints.end());
        const double before = distance(joints.back(), target);
        textbook_iteration(wide, target);
        // A solve returns its best pose; here that must be the one after the iteration.
        if (glm::length(wide.back() - glm::dvec3(target)) > 0.99 * before) continue;
        KeptSolver(lengths).solve(Method::Ccd, joints, target, iterations(1));
        for (std::size_t i = 0; i < joints.size(); ++i)
            worst =
                std::max(worst, glm::length(glm::dvec3(joints[i]) - wide[i]) / static_cast<double>(reach));
    }
    std::printf("worst deviation %.2g of the reach\n", worst);
    EXPECT_LT(worst, 2e-5);
}

TEST(IkCcd, TurnsEveryJointOnceFromTheTip) {
    Random random(2);
    const Lengths lengths{1.0f, 0.7f, 0.9f, 0.4f};
    Joints joints = some_pose(lengths, random);
    Recorder recorder;
    KeptSolver(lengths).solve(Method::Ccd, joints, {1.0f, 1.0f, 0.5f}, iterations(1), &recorder);
    std::vector<std::pair<std::size_t, std::size_t>> seen;  // the pivot joint, and the joint that moved
    int order = -1;
    for (const ik::Step& step : recorder.steps) {
        if (step.phase != ik::Phase::Rotate) continue;
        seen.emplace_back(step.neighbour, step.joint);
        order = std::max(order, step.order);
    }
    const std::vector<std::pair<std::size_t, std::size_t>> expected{{3, 4}, {2, 3}, {2, 4}, {1, 2}, {1, 3},
                                                                    {1, 4}, {0, 1}, {0, 2}, {0, 3}, {0, 4}};
    EXPECT_EQ(seen, expected);
    EXPECT_EQ(order, recorder.steps.front().order + 3) << "what moves at once shares its number";
}

TEST(IkCcd, HandlesATipOrTargetOnAJointAndHalfATurn) {
    const Lengths three(3, 1.0f);
    const Joints folded{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}};
    const Joints ring{{0, 0, 0}, {1, 0, 0}, {0.5f, 0.8660254f, 0}, {0, 0, 0}};
    for (const Joints& start : {folded, ring})
        for (const glm::vec3 target : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 0),
                                       glm::vec3(0.5f, 0.8660254f, 0), glm::vec3(-0.3f, -0.4f, 0)})
            for (const int count : {1, 2, 50})
                expect_invariants(Method::Ccd, three, start, target, iterations(count));
}

TEST(IkCcd, ReachesTargetsInTheMiddleOfItsRange) {
    Random random(3);
    int reached = 0;
    for (int k = 0; k < 500; ++k) {
        const Lengths lengths = some_lengths(3 + random.below(8), random);
        Joints joints = some_pose(lengths, random);
        const glm::vec3 target = some_direction(random) * some_span(lengths, 0.3f, 0.8f, random);
        const ik::Report report = KeptSolver(lengths).solve(Method::Ccd, joints, target);
        reached += report.status == ik::Status::Converged;
    }
    EXPECT_GE(reached, 475);
}

TEST(IkCcd, LengthsDoNotDriftInAThousandIterations) {
    Random random(4);
    const Lengths lengths = some_lengths(20, random);
    Joints joints = some_pose(lengths, random);
    KeptSolver(lengths).solve(Method::Ccd, joints, {3.0f, 1.0f, 2.0f}, iterations(1000));
    EXPECT_TRUE(Holds(joints, lengths));
}

TEST(IkCcd, SurvivesAnyInput) {
    expect_invariants_always(Method::Ccd, 2000);
}

}  // namespace
}  // namespace tendril::test::ik_ccd_test
