// Fitting capsules to a mesh: a body with known radii, and outliers.
#include <gtest/gtest.h>

#include <tendril/humanoid/body.hpp>

#include "humanoid_figure.hpp"

namespace tendril::test {
namespace {

/// The figure as tubes around its bones, each with its own radius and offset from its bone.
class FittedCapsules : public testing::Test, protected Figured {
  protected:
    struct Tube {
        glm::dvec3 from, to;
        double radius;
    };

    FittedCapsules() {
        std::vector<Placement> rest(skeleton.size());
        place(skeleton, rest_pose(skeleton), rest);
        for (const BodyCapsule& each : usual) {
            const PlacedCapsule at = place(each, map, rest);
            const glm::dvec3 way = glm::normalize(at.to - at.from);
            const glm::dvec3 aside = glm::normalize(glm::cross(way, glm::dvec3(0.3, 0.2, 0.9)));
            const double radius = at.radius * between(0.6, 1.8);
            const glm::dvec3 by = 0.3 * at.radius * between(-1.0, 1.0) * aside;
            tubes.push_back({at.from + by, at.to + by, radius});
        }
    }
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    }
    /// Points on the tubes; `stray` of each 100 are 1.5 to 3 times as far out.
    std::vector<SkinPoint> points(int stray) {
        std::vector<SkinPoint> result;
        for (std::size_t i = 0; i < tubes.size(); ++i) {
            const Tube& tube = tubes[i];
            const glm::dvec3 way = glm::normalize(tube.to - tube.from);
            const glm::dvec3 u = glm::normalize(glm::cross(way, glm::dvec3(0.3, 0.2, 0.9)));
            const glm::dvec3 v = glm::cross(way, u);
            // Free ends are round like a capsule's, a radius beyond the line.
            const double over = ends_free(usual[i].bone) ? tube.radius : 0.0;
            for (int k = 0; k < 800; ++k) {
                double place = between(-over, glm::length(tube.to - tube.from) + over);
                const double angle = 6.283185307179586 * k / 100.0;
                double out = tube.radius;
                const double beyond = std::max(-place, place - glm::length(tube.to - tube.from));
                if (beyond > 0.0) out = std::sqrt(std::max(out * out - beyond * beyond, 0.0));
                if (k % 100 < stray) out *= between(1.5, 3.0);
                result.push_back(
                    {tube.from + place * way + out * (std::cos(angle * 7.0) * u + std::sin(angle * 7.0) * v),
                     static_cast<std::size_t>(map[usual[i].bone].node)});
            }
        }
        return result;
    }
    static bool ends_free(Bone bone) {
        return bone == Bone::Head || bone == Bone::LeftHand || bone == Bone::RightHand;
    }
    /// Expects radii within 5 % of the tubes', and lines within `line` radii of theirs.
    void expect_tubes(const std::vector<BodyCapsule>& fitted, double line) {
        std::vector<Placement> rest(skeleton.size());
        place(skeleton, rest_pose(skeleton), rest);
        ASSERT_EQ(fitted.size(), tubes.size());
        for (std::size_t i = 0; i < fitted.size(); ++i) {
            const Tube& tube = tubes[i];
            const PlacedCapsule at = place(fitted[i], map, rest);
            EXPECT_NEAR(at.radius, tube.radius, 0.05 * tube.radius) << name(fitted[i].bone);
            const glm::dvec3 way = glm::normalize(tube.to - tube.from);
            for (const glm::dvec3& end : {at.from, at.to}) {
                const glm::dvec3 off = end - tube.from;
                EXPECT_LT(glm::length(off - glm::dot(off, way) * way), line * tube.radius);
            }
            EXPECT_NEAR(glm::distance(at.from, at.to), glm::distance(tube.from, tube.to),
                        0.2 * tube.radius + 0.05 * glm::distance(tube.from, tube.to))
                << name(fitted[i].bone);
        }
    }

    std::mt19937 engine{11};
    std::vector<BodyCapsule> usual = default_capsules(skeleton, map);
    std::vector<Tube> tubes;
};

TEST_F(FittedCapsules, HaveTheRadiiOfTheBody) {
    expect_tubes(fitted_capsules(skeleton, map, points(0)), 0.05);
}

TEST_F(FittedCapsules, IgnoreOutliers) {
    expect_tubes(fitted_capsules(skeleton, map, points(12)), 0.15);
}

TEST_F(FittedCapsules, DoNotDependOnNodeRotationsAndScales) {
    const std::vector<SkinPoint> cloud = points(0);
    const auto plain = fitted_capsules(skeleton, map, cloud);
    std::vector<Node> nodes = skeleton.nodes();
    // Give every node a rotation that its children undo, and scale the root by a half.
    const glm::dquat turn = glm::angleAxis(0.8, glm::normalize(glm::dvec3(0.2, 1.0, -0.5)));
    for (Node& node : nodes) {
        node.rest.rotation = node.parent < 0 ? turn : glm::dquat(1.0, 0.0, 0.0, 0.0);
        if (node.parent >= 0) node.rest.translation = 2.0 * (glm::conjugate(turn) * node.rest.translation);
        if (node.parent < 0) node.rest.scale = glm::dvec3(0.5);
    }
    const Skeleton other = *Skeleton::make(nodes);
    const auto turned = fitted_capsules(other, map, cloud);
    std::vector<Placement> rest(skeleton.size()), other_rest(skeleton.size());
    place(skeleton, rest_pose(skeleton), rest);
    place(other, rest_pose(other), other_rest);
    ASSERT_EQ(plain.size(), turned.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const PlacedCapsule a = place(plain[i], map, rest), b = place(turned[i], map, other_rest);
        EXPECT_NEAR(a.radius, b.radius, 1e-9);
        EXPECT_LT(glm::distance(a.from, b.from) + glm::distance(a.to, b.to), 1e-9);
    }
}

TEST_F(FittedCapsules, AreTheDefaultsIfPointsAreFewOrTooNearOrFar) {
    EXPECT_EQ(fitted_capsules(skeleton, map, {}), usual);
    std::vector<SkinPoint> cloud = points(0);
    std::vector<SkinPoint> few;
    for (std::size_t i = 0; i < cloud.size(); i += 60) few.push_back(cloud[i]);
    EXPECT_EQ(fitted_capsules(skeleton, map, few), usual);
    for (const double times : {8.0, 0.1}) {
        for (Tube& tube : tubes) tube.radius *= times;
        EXPECT_EQ(fitted_capsules(skeleton, map, points(0)), usual) << times;
        for (Tube& tube : tubes) tube.radius /= times;
    }
}

TEST_F(FittedCapsules, IgnorePointsThatAreNotFinite) {
    std::vector<SkinPoint> cloud = points(0);
    const auto before = fitted_capsules(skeleton, map, cloud);
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
        cloud.push_back({{bad, 0.0, 0.0}, cloud[0].node});
        cloud.push_back({{0.0, 0.0, bad}, cloud[1000].node});
    }
    cloud.push_back({{0.0, 1.0, 0.0}, skeleton.size()});
    cloud.push_back({{0.0, 1.0, 0.0}, static_cast<std::size_t>(-1)});
    EXPECT_EQ(fitted_capsules(skeleton, map, cloud), before);
}

TEST_F(FittedCapsules, KeepHandsOutAndLeaveTheBodyAtRest) {
    const auto capsules = fitted_capsules(skeleton, map, points(0));
    Body body = *Body::make(skeleton, map, default_limits(skeleton, map), capsules);
    BodyState state;
    auto pose = rest;
    ASSERT_TRUE(body.solve(pose, std::vector<BodyTarget>{}, state));
    EXPECT_EQ(pose, rest) << "as it was made";
    state = {};
    for (int frame = 0; frame <= 100; ++frame) {
        pose = rest;
        const std::vector<BodyTarget> targets{{Effector::LeftHand, {0.1, 1.15, 0.5 - 0.01 * frame}}};
        const auto report = body.solve(pose, targets, state);
        ASSERT_TRUE(report);
        EXPECT_LT(report->penetration, 5e-3) << frame;
    }
}

}  // namespace
}  // namespace tendril::test
