// The curve passes through its points smoothly, and its frames rotate no more than it bends.
#include "app/view/spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

namespace tendril::app {
namespace {

using Points = std::vector<glm::vec3>;

Points random_walk(std::mt19937& random, int count) {
    std::normal_distribution<float> step(0.0f, 0.3f);
    Points points{glm::vec3(0.0f)};
    glm::vec3 direction(1.0f, 0.0f, 0.0f);
    for (int i = 1; i < count; ++i) {
        direction = glm::normalize(direction + glm::vec3{step(random), step(random), step(random)});
        points.push_back(points.back() + 0.1f * direction);
    }
    return points;
}

/// Ten curve points per span, with their frames.
std::vector<CurvePoint> curve_through(const Points& points) {
    std::vector<CurvePoint> curve;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const CurveSpan span = curve_span(points, i);
        for (int k = curve.empty() ? 0 : 1; k <= 10; ++k) {
            const float t = 0.1f * static_cast<float>(k);
            curve.push_back({.at = span.at(t), .tangent = glm::normalize(span.slope(t))});
        }
    }
    set_frames(curve);
    return curve;
}

TEST(Spline, GoesThroughItsPointsWithoutKinks) {
    std::mt19937 random(1);
    const Points points = random_walk(random, 40);
    for (std::size_t i = 0; i + 2 < points.size(); ++i) {
        const CurveSpan before = curve_span(points, i), after = curve_span(points, i + 1);
        EXPECT_EQ(before.at(0.0f), points[i]);
        EXPECT_LT(glm::distance(before.at(1.0f), points[i + 1]), 1e-6f);
        EXPECT_GT(glm::dot(glm::normalize(before.slope(1.0f)), glm::normalize(after.slope(0.0f))), 0.99999f);
    }
}

TEST(Spline, SlopeIsTheDerivative) {
    const Points points{{0, 0, 0}, {1, 0, 0}, {1.2f, 0.7f, 0}, {1, 1, 1}};
    for (std::size_t i = 0; i < 3; ++i) {
        const CurveSpan span = curve_span(points, i);
        for (const float t : {0.1f, 0.4f, 0.8f}) {
            const glm::vec3 difference = (span.at(t + 0.01f) - span.at(t - 0.01f)) / 0.02f;
            EXPECT_LT(glm::distance(difference, span.slope(t)), 1e-3f);
        }
    }
}

TEST(Spline, ACircleThroughFewPointsIsRound) {
    Points points;
    for (int i = 0; i < 16; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / 12.0f;
        points.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
    }
    for (std::size_t i = 1; i + 2 < points.size(); ++i)
        EXPECT_NEAR(glm::length(curve_span(points, i).at(0.5f)), 1.0f, 0.002f);
}

TEST(Spline, AStraightLineStaysStraightHoweverItsPointsLie) {
    const Points points{{0, 0, 0}, {0.01f, 0, 0}, {1, 0, 0}, {1.001f, 0, 0}, {5, 0, 0}};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const CurveSpan span = curve_span(points, i);
        EXPECT_NEAR(span.turn(), 0.0f, 1e-5f);
        float last = span.a.x;
        for (int k = 1; k <= 10; ++k) {
            const float x = span.at(0.1f * static_cast<float>(k)).x;
            EXPECT_GE(x, last) << "and does not turn back";
            last = x;
        }
    }
}

TEST(Spline, FramesAreSquareAndTurnNoMoreThanTheCurve) {
    std::mt19937 random(2);
    for (int round = 0; round < 50; ++round) {
        const std::vector<CurvePoint> curve = curve_through(random_walk(random, 30));
        for (std::size_t i = 0; i < curve.size(); ++i) {
            ASSERT_NEAR(glm::length(curve[i].normal), 1.0f, 1e-5f);
            ASSERT_NEAR(glm::dot(curve[i].normal, curve[i].tangent), 0.0f, 1e-5f);
            if (i == 0) continue;
            const float bend = glm::distance(curve[i].tangent, curve[i - 1].tangent);
            const float turn = glm::distance(curve[i].normal, curve[i - 1].normal);
            EXPECT_LE(turn, 1.1f * bend + 1e-4f);
        }
    }
}

TEST(Spline, InAPlaneFramesDoNotTwist) {
    Points points;
    for (int i = 0; i <= 30; ++i) {
        const float t = 0.3f * static_cast<float>(i);
        points.emplace_back(t, std::sin(t), 0.0f);
    }
    const std::vector<CurvePoint> curve = curve_through(points);
    for (const CurvePoint& point : curve) EXPECT_NEAR(point.normal.z, curve[0].normal.z, 1e-3f);
}

TEST(Spline, OnALoopInSpaceFramesAreWithinTheMethodsError) {
    // Relative to a helix, a frame without twist rotates against its torsion: for (cos t, sin t, c t) the
    // angle is t c / sqrt(1 + c^2).
    const float c = 0.5f, speed = std::sqrt(1.0f + c * c);
    std::vector<CurvePoint> curve;
    for (int i = 0; i <= 40; ++i) {
        const float t = 0.2f * static_cast<float>(i);
        curve.push_back({.at = {std::cos(t), std::sin(t), c * t},
                         .tangent = glm::vec3(-std::sin(t), std::cos(t), c) / speed});
    }
    set_frames(curve);
    const auto angle = [&](std::size_t i) {  // from the principal normal, about the tangent
        const float t = 0.2f * static_cast<float>(i);
        const glm::vec3 inward(-std::cos(t), -std::sin(t), 0.0f);
        const glm::vec3 across = glm::cross(curve[i].tangent, inward);
        return std::atan2(glm::dot(curve[i].normal, across), glm::dot(curve[i].normal, inward));
    };
    const float wanted = -8.0f * c / speed;
    EXPECT_NEAR(std::remainder(angle(40) - angle(0) - wanted, glm::two_pi<float>()), 0.0f, 1e-3f);
}

TEST(Spline, FramesMoveSteadilyAsTheCurveDoes) {
    std::mt19937 random(3);
    std::normal_distribution<float> small(0.0f, 1e-4f);
    for (int round = 0; round < 50; ++round) {
        Points points = random_walk(random, 20);
        if (round % 2 == 1)  // like hanging ropes
            for (glm::vec3& point : points) point = {point.y, -point.x, point.z};
        const std::vector<CurvePoint> before = curve_through(points);
        for (glm::vec3& point : points) point += glm::vec3{small(random), small(random), small(random)};
        const std::vector<CurvePoint> after = curve_through(points);
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_LT(glm::distance(before[i].normal, after[i].normal), 0.1f);
    }
}

}  // namespace
}  // namespace tendril::app
