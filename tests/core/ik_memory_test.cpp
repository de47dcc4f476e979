// Solving allocates nothing: every method, with every option, with and without class Chain.
#include "ik_support.hpp"
#include "memory.hpp"

namespace tendril::test::ik_memory_test {
namespace {

using ik::Limit;
using ik::Method;
using ik::Options;
using ik::Status;

TEST(IkMemory, SolvingAllocatesNothing) {
    Random random(7);
    for (const Method method : ik::all_methods) {
        const std::size_t bones = method == Method::TwoBone ? 2 : 12;
        const Lengths lengths = some_lengths(bones, random);
        const auto reach = static_cast<float>(reach_of(lengths));
        KeptSolver solver(lengths);
        const std::vector<Limit> limits(bones, Limit::of(ik::JointKind::BallAndSocket));
        std::vector<float> residuals(10);
        const Options options[] = {{},
                                   {.tolerance = 0.0f},
                                   {.pole = glm::vec3(0, 9, 0)},
                                   {.pole = glm::vec3(0, 9, 0), .pole_turn = ik::PoleTurn::EachJoint},
                                   {.limits = limits},
                                   {.limits = limits, .tip_orientation = glm::quat(1, 0, 0, 0)},
                                   {.snap_back = 0.4f, .tip_orientation = glm::quat(1, 0, 0, 0)},
                                   {.soft_zone = 0.2f, .residuals = residuals}};
        for (const Options& each : options)
            for (const float far : {0.0f, 0.3f, 0.7f, 0.995f, 1.5f}) {
                Joints joints = random.chance(3) ? straight_joints(lengths) : some_pose(lengths, random);
                const glm::vec3 target = some_direction(random) * (far * reach);
                Status status = Status::InvalidInput;
                without_memory([&] {
                    status = solver.solve(method, joints, target, each).status;
                    solver.explain(joints, target, each);
                });
                EXPECT_NE(status, Status::InvalidInput) << name(method);
            }
    }
}

TEST(IkMemory, SolvingAChainAllocatesNothing) {
    Chain chain = straight(20);
    KeptSolver solver(chain);
    Status status = Status::InvalidInput;
    without_memory([&] { status = solver.solve(Method::Fabrik, chain, {3, 4, 5}).status; });
    EXPECT_EQ(status, Status::Converged);
    EXPECT_TRUE(Holds(chain));
}

}  // namespace
}  // namespace tendril::test::ik_memory_test
