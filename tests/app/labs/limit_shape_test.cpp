// The outline of a limit against the library's own measure: the drawing shows the solvers' limits.
#include "app/labs/kit/limit_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/core/random.hpp"

namespace tendril::app {
namespace {

class Pose {
  public:
    explicit Pose(test::Random& random) {
        rest = glm::normalize(random.point(1.0f) + glm::vec3(1e-3f));
        const glm::vec3 other = glm::normalize(random.point(1.0f) + glm::vec3(0.0f, 1e-3f, 0.0f));
        limit.axis = glm::cross(rest, other) + 0.3f * rest;
        parent = glm::angleAxis(random.around(3.0f), glm::normalize(random.point(1.0f) + glm::vec3(1e-3f)));
    }
    /// The solver's angles of a bone that points there, in the world, by the shortest rotation from rest.
    ik::JointAngles measured(glm::vec3 direction) const {
        const glm::vec3 to = glm::conjugate(parent) * direction;
        return ik::measure(limit, rest, glm::quat(rest, to));
    }
    float excess(glm::vec3 direction) const { return ik::excess(limit, measured(direction)); }

    ik::Limit limit;
    glm::vec3 rest;
    glm::quat parent;
};

glm::quat turn_between(glm::vec3 bone, glm::vec3 side, glm::vec3 to_bone, glm::vec3 to_side) {
    const glm::mat3 from(bone, side, glm::cross(bone, side)),
        to(to_bone, to_side, glm::cross(to_bone, to_side));
    return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

float angle(test::Random& random, float low, float high) {
    return low + (high - low) * 0.5f * (1.0f + random.around(1.0f));
}

TEST(LimitShape, AConesOutlineIsAsFarAsTheSolverLets) {
    test::Random random(5);
    for (int round = 0; round < 300; ++round) {
        Pose pose(random);
        ik::Limit& limit = pose.limit;
        limit.kind = ik::JointKind::BallAndSocket;
        for (float* half : {&limit.up, &limit.down, &limit.left, &limit.right})
            *half = angle(random, 0.1f, 2.6f);
        limit.twist_min = -0.5f, limit.twist_max = 0.5f;
        const float least = std::min({limit.up, limit.down, limit.left, limit.right});
        const LimitShape shape(limit, pose.rest, pose.parent);
        const auto outline = shape.outline(64);
        ASSERT_EQ(outline.size(), 65u);
        EXPECT_LT(glm::distance(outline.front(), outline.back()), 1e-4f);
        for (const glm::vec3& direction : outline) {
            EXPECT_NEAR(glm::length(direction), 1.0f, 1e-5f);
            EXPECT_LT(pose.excess(direction), 3e-4f);
            const ik::JointAngles at = pose.measured(direction);
            EXPECT_GT(pose.excess(shape.direction(1.01f * at.up, 1.01f * at.left)), 0.004f * least);
            EXPECT_EQ(pose.excess(shape.direction(0.99f * at.up, 0.99f * at.left)), 0.0f);
        }
    }
}

TEST(LimitShape, AHingesFanEndsWhereItsRangeDoes) {
    test::Random random(6);
    for (int round = 0; round < 300; ++round) {
        Pose pose(random);
        const float middle = random.around(1.5f), half = angle(random, 0.1f, 1.2f);
        pose.limit.kind = ik::JointKind::Hinge;
        pose.limit.min = middle - half, pose.limit.max = middle + half;
        const LimitShape shape(pose.limit, pose.rest, pose.parent);
        const auto outline = shape.outline(40);
        for (const glm::vec3& direction : outline) EXPECT_LT(pose.excess(direction), 1e-3f);
        EXPECT_NEAR(pose.measured(outline.front()).up, pose.limit.min, 1e-3f);
        EXPECT_NEAR(pose.measured(outline.back()).up, pose.limit.max, 1e-3f);
        EXPECT_GT(pose.excess(shape.direction(pose.limit.max + 0.02f * half, 0.0f)), 0.01f * half);
        EXPECT_GT(pose.excess(shape.direction(pose.limit.min - 0.02f * half, 0.0f)), 0.01f * half);
    }
}

TEST(LimitShape, TheEndsOfTheDialAreThoseOfTheTwist) {
    test::Random random(7);
    for (int round = 0; round < 300; ++round) {
        Pose pose(random);
        ik::Limit& limit = pose.limit;
        limit.kind = ik::JointKind::BallAndSocket;
        limit.up = limit.down = limit.left = limit.right = 2.0f;
        limit.twist_min = angle(random, -2.0f, -0.2f), limit.twist_max = angle(random, 0.2f, 2.0f);
        const LimitShape shape(limit, pose.rest, pose.parent);
        const float up = random.around(1.2f), left = random.around(1.2f);
        const glm::vec3 side_at_rest = glm::conjugate(pose.parent) * shape.side({});
        const auto posed = [&](float twist) {
            const glm::quat world = turn_between(pose.rest, side_at_rest, shape.direction(up, left),
                                                 shape.side({up, left, twist}));
            return ik::measure(limit, pose.rest, glm::conjugate(pose.parent) * world);
        };
        for (const float twist : {limit.twist_min, 0.0f, limit.twist_max}) {
            const ik::JointAngles at = posed(twist);
            EXPECT_NEAR(at.twist, twist, 2e-3f);
            EXPECT_NEAR(at.up, up, 2e-3f);
            EXPECT_NEAR(at.left, left, 2e-3f);
            EXPECT_LT(ik::excess(limit, at), 2e-3f);
        }
        EXPECT_GT(ik::excess(limit, posed(1.05f * limit.twist_max)), 0.01f * limit.twist_max);
        EXPECT_GT(ik::excess(limit, posed(1.05f * limit.twist_min)), -0.01f * limit.twist_min);
    }
}

}  // namespace
}  // namespace tendril::app
