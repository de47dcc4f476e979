// FABRIK near full reach, where FABRIK (2011) crawls: its iterations, and that it moves joints no further.
#include "ik_support.hpp"

namespace tendril::test::ik_rim_test {
namespace {

using ik::Method;
using ik::Report;
using ik::Status;

constexpr std::size_t targets = 1000;
constexpr float bands[][2] = {{0.05f, 0.9f}, {0.9f, 0.95f}, {0.95f, 0.99f}, {0.99f, 0.999f}};

struct Tally {
    std::size_t over = 0;  ///< solves with too many iterations
    int most = 0;
    double travel = 0.0, plain_travel = 0.0;
};

double travel(const Joints& from, const Joints& to) {
    double sum = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) sum += distance(from[i], to[i]);
    return sum;
}

/// Skips distances that no pose can reach.
float some_distance(const Lengths& lengths, const float (&band)[2], Random& random) {
    const auto reach = static_cast<float>(reach_of(lengths));
    const float nearest = 2.0f * *std::max_element(lengths.begin(), lengths.end()) - reach;
    return std::max(between(random, band[0], band[1]) * reach, nearest + 0.01f * reach);
}

Tally solve_band(std::size_t bones, const float (&band)[2], int may_take, bool equal, bool from_straight) {
    Random random(bones * 1000 + static_cast<std::size_t>(band[1] * 1000.0f));
    Tally tally;
    for (std::size_t i = 0; i < targets; ++i) {
        const Lengths lengths = equal ? Lengths(bones, 1.0f) : some_lengths(bones, random);
        const Joints start = from_straight ? straight_joints(lengths) : some_pose(lengths, random);
        const glm::vec3 target = some_direction(random) * some_distance(lengths, band, random);
        KeptSolver solver(lengths);
        Joints joints = start, plain = start;
        const Report report = solver.solve(Method::Fabrik, joints, target);
        solver.solve(Method::FabrikPlain, plain, target, {.max_iterations = 3000});
        EXPECT_EQ(report.status, Status::Converged) << name(report.status) << ", target " << i;
        EXPECT_TRUE(Holds(joints, lengths)) << "target " << i;
        if (report.iterations > may_take) ++tally.over;
        tally.most = std::max(tally.most, report.iterations);
        tally.travel += travel(start, joints);
        tally.plain_travel += travel(start, plain);
    }
    return tally;
}

void check_band(std::size_t bones, const float (&band)[2], bool equal, bool from_straight) {
    const int may_take = 12;  // also for 3 bones, where 20 are allowed
    const Tally tally = solve_band(bones, band, may_take, equal, from_straight);
    SCOPED_TRACE(std::to_string(bones) + " bones, up to " + std::to_string(band[1]) + ", most " +
                 std::to_string(tally.most));
    EXPECT_LE(tally.over, targets / 1000);
    EXPECT_LE(tally.travel, 1.05 * tally.plain_travel);
}

TEST(IkRim, TwelveIterationsReachTheRimFromAnyPose) {
    for (const auto& [equal, straight] : {std::pair{true, false}, {true, true}, {false, false}})
        for (const std::size_t bones : {3u, 10u, 30u})
            for (const auto& band : bands) check_band(bones, band, equal, straight);
}

/// The inner rim: one bone longer than all others together, and a target that only a folded chain reaches.
TEST(IkRim, ATargetAtTheInnerRimIsReached) {
    Random random(11);
    for (int i = 0; i < 1000; ++i) {
        Lengths lengths = some_lengths(2 + random.below(6), random);
        float& longest = lengths[random.below(lengths.size())];
        longest += static_cast<float>(reach_of(lengths));
        const auto reach = static_cast<float>(reach_of(lengths));
        const float nearest = 2.0f * longest - reach;
        const float off = between(random, 0.001f, 0.05f) * reach;
        const glm::vec3 target = some_direction(random) * (nearest + off);
        KeptSolver solver(lengths);
        Joints joints = some_pose(lengths, random);
        const Report report = solver.solve(Method::Fabrik, joints, target);
        EXPECT_EQ(report.status, Status::Converged)
            << name(report.status) << ", residual " << report.residual / reach << " R, case " << i;
        EXPECT_TRUE(Holds(joints, lengths));
    }
}

}  // namespace
}  // namespace tendril::test::ik_rim_test
