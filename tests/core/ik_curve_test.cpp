// Chains placed along curves: cases from an independent implementation, the rule itself on random curves,
// frames, fit, weights, jumps, and hostile input.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "memory.hpp"
#include "random.hpp"
#include "tendril/ik/curve.hpp"
#include "tests/places.hpp"

namespace tendril::test::ik_curve_test {
namespace {

using ik::CurveKind;
using ik::CurveOptions;
using ik::CurveReport;
using ik::Status;
using Points = std::vector<glm::vec3>;
using Json = nlohmann::json;

struct Placed {
    explicit Placed(std::vector<float> bones, Points rest = {})
        : lengths(std::move(bones)),
          rest_directions(std::move(rest)),
          joints(lengths.size() + 1),
          state(lengths.size()),
          memory(lengths.size()) {
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            const glm::vec3 along = rest_directions.empty() ? glm::vec3(1, 0, 0) : rest_directions[i];
            joints[i + 1] = joints[i] + lengths[i] * along;
        }
    }
    CurveReport place(const Points& points, const CurveOptions& options = {}) {
        return ik::place_along(points, {lengths, rest_directions}, joints, state, memory, options);
    }
    float reach() const { return std::accumulate(lengths.begin(), lengths.end(), 0.0f); }

    std::vector<float> lengths;
    Points rest_directions, joints;
    ik::State state;
    ik::CurveMemory memory;
};

Points random_points(Random& random, std::size_t count, float size = 1.0f) {
    Points points(count);
    for (glm::vec3& each : points) each = random.point(size);
    return points;
}
std::vector<float> random_lengths(Random& random, std::size_t count, float most) {
    std::vector<float> lengths(count);
    for (float& each : lengths) each = most * (0.1f + 0.9f * random.part());
    return lengths;
}
Points read_points(const Json& list) {
    Points points;
    for (const Json& each : list) points.emplace_back(each[0], each[1], each[2]);
    return points;
}
glm::vec3 turned(const glm::quat& q, const glm::vec3& v) {
    return q * v;
}
const float nan = std::numeric_limits<float>::quiet_NaN();

void matches(const Json& expected) {
    Placed chain(expected.at("lengths").get<std::vector<float>>());
    const CurveReport report = chain.place(read_points(expected.at("control_points")));
    const Points joints = read_points(expected.at("joints"));
    for (std::size_t i = 0; i < joints.size(); ++i)
        EXPECT_LE(glm::distance(chain.joints[i], joints[i]), 1e-5f * chain.reach()) << "joint " << i;
    EXPECT_EQ(report.bones_past_end, expected.at("bones_past_end").get<std::size_t>());
}

TEST(IkCurve, ASmallCaseByHand) {
    // Two points give a straight line of constant speed.
    Placed chain({0.5f, 0.25f, 1.0f});
    const CurveReport report = chain.place({{1, 1, 1}, {1, 2, 1}});
    EXPECT_EQ(chain.joints, (Points{{1, 1, 1}, {1, 1.5f, 1}, {1, 1.75f, 1}, {1, 2.75f, 1}}));
    EXPECT_EQ(report.status, Status::Stretched);
    EXPECT_EQ(report.bones_past_end, 1u);
    EXPECT_FLOAT_EQ(report.past_end, 0.75f);
}

TEST(IkCurve, AgreesWithAnIndependentImplementation) {
    std::ifstream file(reference_path("spline.json"));
    if (!file) GTEST_SKIP() << "spline.json is not here";
    const Json cases = Json::parse(file).at("cases");
    ASSERT_GE(cases.size(), 40u);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        matches(cases[i]);
    }
}

// By brute force: between a joint and the next, no point of the curve is a bone's length away.
TEST(IkCurve, EachJointIsTheFirstPointAtItsBonesLength) {
    Random random(71);
    for (int trial = 0; trial < 300; ++trial) {
        const CurveKind kind = trial % 2 ? CurveKind::BSpline : CurveKind::Hermite;
        const Points points = random_points(random, 2 + random.below(10));
        Placed chain(random_lengths(random, 1 + random.below(20), 0.5f));
        const CurveReport report = chain.place(points, {.kind = kind});
        ASSERT_EQ(chain.joints[0], points[0]);
        for (std::size_t i = 0; i < chain.lengths.size(); ++i) {
            const float length = chain.lengths[i];
            ASSERT_NEAR(glm::distance(chain.joints[i], chain.joints[i + 1]), length, 1e-6f);
            const double from = chain.memory.at[i], to = chain.memory.at[i + 1];
            ASSERT_LT(from, to);
            if (from >= static_cast<double>(points.size() - 1)) continue;  // beyond the curve's end
            const double last = std::min(to, static_cast<double>(points.size() - 1));
            for (int k = 0; k < 200; ++k) {
                const auto at = static_cast<float>(from + (last - from) * k / 200.0);
                ASSERT_LE(glm::distance(ik::curve_point(points, kind, at), chain.joints[i]),
                          length * 1.00001f + 1e-6f)
                    << "trial " << trial << " bone " << i;
            }
        }
        EXPECT_EQ(report.status == Status::Stretched, report.bones_past_end > 0);
    }
}

TEST(IkCurve, BothKindsBeginAndEndOnTheControlPoints) {
    Random random(5);
    for (const CurveKind kind : {CurveKind::Hermite, CurveKind::BSpline}) {
        const Points points = random_points(random, 6);
        EXPECT_LE(glm::distance(ik::curve_point(points, kind, 0.0f), points.front()), 1e-6f);
        EXPECT_LE(glm::distance(ik::curve_point(points, kind, 5.0f), points.back()), 1e-6f);
        EXPECT_LE(glm::distance(ik::curve_point(points, kind, 99.0f), points.back()), 1e-6f);
    }
    EXPECT_EQ(ik::curve_point(random_points(random, 6), CurveKind::Hermite, nan), glm::vec3(0.0f));
}

TEST(IkCurve, RotationsTakeTheRestDirectionsToTheBones) {
    Random random(9);
    for (int trial = 0; trial < 200; ++trial) {
        Points rest(12);
        for (glm::vec3& each : rest) each = glm::normalize(random.point(1.0f) + glm::vec3(0, 0, 1e-3f));
        Placed chain(random_lengths(random, 12, 0.3f), rest);
        chain.place(random_points(random, 5), {.roll_start = random.around(3), .roll_end = random.around(3)});
        for (std::size_t i = 0; i < 12; ++i) {
            const glm::vec3 bone = (chain.joints[i + 1] - chain.joints[i]) / chain.lengths[i];
            ASSERT_LE(glm::distance(turned(chain.state.rotations[i], rest[i]), bone), 2e-5f);
        }
        ASSERT_TRUE(ik::check(chain.state, 12));
    }
}

TEST(IkCurve, AlongItsRestPoseAChainDoesNotRotate) {
    Placed chain(std::vector<float>(8, 0.25f));
    chain.place({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}});
    for (const glm::quat& each : chain.state.rotations) EXPECT_NEAR(std::abs(each.w), 1.0f, 1e-6f);
}

TEST(IkCurve, ALoopInAPlaneCausesNoRoll) {
    Points circle;
    for (int i = 0; i <= 32; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / 16.0f;  // goes round twice
        circle.emplace_back(std::cos(angle), 0.0f, std::sin(angle));
    }
    Placed chain(std::vector<float>(60, 0.2f));
    chain.place(circle, {.up = {0, 1, 0}});
    for (const glm::quat& each : chain.state.rotations)
        EXPECT_LE(glm::distance(turned(each, {0, 1, 0}), glm::vec3(0, 1, 0)), 1e-5f);
}

TEST(IkCurve, RollIsSpreadFromTheFirstBoneToTheLast) {
    Placed chain({1, 2, 1, 1});
    chain.place({{0, 0, 0}, {5, 0, 0}}, {.roll_start = 0.2f, .roll_end = 1.0f});
    const float expected[]{0.2f, 0.4f, 0.8f, 1.0f};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 side = turned(chain.state.rotations[i], {0, 1, 0});
        EXPECT_NEAR(std::atan2(side.z, side.y), expected[i], 1e-5f);
    }
}

// On a helix of slope b a rotation-minimising frame turns by 2 pi (1 - sin(slope)) a turn against the normal.
TEST(IkCurve, FramesOnAHelixTurnAsItsGeometrySays) {
    constexpr float pitch = 0.5f, two_pi = 6.2831853f;
    Points helix;
    for (int i = 0; i <= 64; ++i) {
        const float turns = static_cast<float>(i) / 32.0f;
        helix.emplace_back(std::cos(two_pi * turns), pitch * turns, std::sin(two_pi * turns));
    }
    const float turn = std::hypot(two_pi, pitch);
    Placed chain(std::vector<float>(100, turn / 50.0f));
    chain.place(helix, {.up = {1, 0, 0}});
    const auto roll_at = [&](std::size_t bone) {  // the side's angle from the direction to the axis
        const glm::vec3 at = 0.5f * (chain.joints[bone] + chain.joints[bone + 1]);
        const glm::vec3 along = glm::normalize(chain.joints[bone + 1] - chain.joints[bone]);
        const glm::vec3 out = glm::normalize(glm::vec3(at.x, 0, at.z));
        const glm::vec3 side = turned(chain.state.rotations[bone], {0, 0, 1});
        return std::atan2(glm::dot(glm::cross(out, side), along), glm::dot(out, side));
    };
    const float sine = pitch / turn;
    const float found = std::remainder(roll_at(75) - roll_at(25), two_pi);
    EXPECT_NEAR(std::abs(found), two_pi * sine, 0.02f);
}

TEST(IkCurve, AFittedChainEndsOnTheLastControlPoint) {
    Random random(13);
    int fitted = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const bool gentle = trial % 2 == 0;
        Points points = random_points(random, 3 + random.below(4));
        if (gentle)
            for (std::size_t i = 0; i < points.size(); ++i)
                points[i] = 0.3f * points[i] + glm::vec3(static_cast<float>(i), 0.0f, 0.0f);
        Placed chain(std::vector<float>(40, 0.02f + 0.1f * random.part()));
        const CurveReport report = chain.place(points, {.fit = true, .max_factor = 20.0f});
        ASSERT_GE(report.factor, 0.05f);
        ASSERT_LE(report.factor, 20.0f);
        for (std::size_t i = 0; i < 40; ++i)
            ASSERT_NEAR(glm::distance(chain.joints[i], chain.joints[i + 1]), report.factor * chain.lengths[i],
                        1e-5f);
        const float left = report.past_end + report.short_of_end;
        EXPECT_NEAR(glm::distance(chain.joints.back(), points.back()), left, 1e-5f);
        if (gentle) {
            EXPECT_LE(left, 1e-5f) << "trial " << trial;
        } else if (left < 1e-5f) {
            ++fitted;
        }
    }
    EXPECT_GE(fitted, 90) << "of 150 curves with folds, at some of which the tip jumps over the end";
}

TEST(IkCurve, AFitStopsAtItsLimitAndReportsTheRest) {
    Placed chain(std::vector<float>(4, 1.0f));
    const CurveReport report = chain.place({{0, 0, 0}, {10, 0, 0}}, {.fit = true, .max_factor = 1.5f});
    EXPECT_FLOAT_EQ(report.factor, 1.5f);
    EXPECT_NEAR(report.short_of_end, 4.0f, 1e-5f);
}

TEST(IkCurve, WeightsLeaveBonesInPlaceAndKeepLengths) {
    Random random(17);
    const Points points = random_points(random, 5);
    Placed rest(std::vector<float>(9, 0.2f)), none(rest), half(rest), root_half(rest), whole(rest);
    none.place(points, {.weight = 0.0f});
    for (std::size_t i = 0; i < 10; ++i) EXPECT_LE(glm::distance(none.joints[i], rest.joints[i]), 1e-5f);
    half.place(points, {.weight = 0.5f});
    whole.place(points);
    std::vector<float> falloff(9, 1.0f);
    for (std::size_t i = 5; i < 9; ++i) falloff[i] = 0.0f;
    root_half.place(points, {.weights = falloff});
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_NEAR(glm::distance(half.joints[i], half.joints[i + 1]), 0.2f, 1e-6f);
        EXPECT_NEAR(glm::distance(root_half.joints[i], root_half.joints[i + 1]), 0.2f, 1e-6f);
        if (i < 5) {
            EXPECT_EQ(root_half.joints[i + 1], whole.joints[i + 1]);
        } else {
            EXPECT_LE(glm::distance(root_half.joints[i + 1] - root_half.joints[i], glm::vec3(0.2f, 0, 0)),
                      1e-5f);
        }
    }
    EXPECT_LE(glm::distance(half.joints[0], 0.5f * points[0]), 1e-6f);
}

TEST(IkCurve, ASmallChangeMovesJointsLittleUnlessAJumpIsReported) {
    Random random(23);
    int jumps = 0;
    for (int trial = 0; trial < 400; ++trial) {
        Points points = random_points(random, 3 + random.below(8));
        Placed chain(random_lengths(random, 30, 0.2f));
        EXPECT_FALSE(chain.place(points).jumped) << "the first call";
        EXPECT_FALSE(chain.place(points).jumped) << "nothing moved";
        const Points before = chain.joints;
        points[random.below(points.size())] += 1e-4f * glm::normalize(random.point(1.0f) + glm::vec3(1e-3f));
        const CurveReport report = chain.place(points);
        if (report.jumped) {
            ++jumps;
            continue;
        }
        for (std::size_t i = 0; i < before.size(); ++i)
            ASSERT_LE(glm::distance(before[i], chain.joints[i]), 20.0f * 1e-4f + 2e-5f * chain.reach())
                << "trial " << trial;
    }
    EXPECT_LT(jumps, 60);
}

// Finds the first joint that leaves its crossing while the control points move along straight lines. By brute
// force: halves each step in which a joint moves far along the curve, until the points hardly move.
class BruteForce {
  public:
    BruteForce(const std::vector<float>& lengths, const Points& from, const Points& to)
        : lengths_(lengths), from_(from), to_(to) {}

    std::optional<std::size_t> jumped() {
        constexpr int samples = 32;
        Places before = at(0.0f);
        for (int i = 1; i <= samples; ++i) {
            const Places now = at(static_cast<float>(i) / samples);
            search(static_cast<float>(i - 1) / samples, before, static_cast<float>(i) / samples, now);
            before = now;
        }
        return first_;
    }

  private:
    using Places = std::vector<double>;

    Places at(float share) const {
        Points points = from_;
        for (std::size_t i = 0; i < points.size(); ++i) points[i] += share * (to_[i] - from_[i]);
        Placed chain(lengths_);
        chain.place(points);
        return chain.memory.at;
    }
    void search(float low, const Places& before, float high, const Places& after) {
        std::size_t joint = 1;
        while (joint < before.size() && std::abs(after[joint] - before[joint]) <= 0.01) ++joint;
        if (joint == before.size() || (first_ && *first_ <= joint)) return;
        if (high - low < 1e-6f) {
            first_ = joint;
            return;
        }
        const float middle = 0.5f * (low + high);
        const Places between = at(middle);
        search(low, before, middle, between);
        search(middle, between, high, after);
    }

    const std::vector<float>& lengths_;
    const Points &from_, &to_;
    std::optional<std::size_t> first_{};
};

// In larger steps a joint may leave its crossing and come back to it in between, which the rule does not see.
TEST(IkCurve, AJumpIsAnotherCrossingForAnyMotion) {
    Random random(29);
    int jumps = 0;
    for (const float step : {3e-2f, 1e-1f, 3e-1f}) {
        int wrong = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const Points points = random_points(random, 3 + random.below(5));
            Points moved = points;
            moved[random.below(points.size())] += random.point(step);
            Placed chain(random_lengths(random, 8, 1.0f));
            chain.place(points);
            const auto jumped = chain.place(moved).jumped;
            const auto expected = BruteForce(chain.lengths, points, moved).jumped();
            jumps += expected ? 1 : 0;
            wrong += jumped != expected ? 1 : 0;
        }
        EXPECT_LE(wrong, step < 0.2f ? 2 : 6) << step;
    }
    EXPECT_GE(jumps, 50);
}

/// The curve bends hard at one end of its pieces only, and the joint goes on to the next crossing.
TEST(IkCurve, AJumpWithinOnePieceIsReported) {
    Placed chain({0.38f});
    const CurveOptions options{.kind = CurveKind::BSpline};
    EXPECT_FALSE(chain.place({{0, 0, 0}, {0.21f, 0, 0}, {0.42f, 0, 0}}, options).jumped);
    EXPECT_EQ(chain.place({{0, 0, 0}, {0.42f, -0.06f, 0.15f}, {0.42f, 0, 0}}, options).jumped, 1u);
}

TEST(IkCurve, DegenerateCurvesGiveFiniteChainsOfTheirLengths) {
    Random random(31);
    std::vector<Points> curves{{{1, 2, 3}, {1, 2, 3}},
                               Points(64, {5, 5, 5}),
                               {{0, 0, 0}, {1e-30f, 0, 0}},
                               {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}},
                               {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}},
                               {{0, 0, 0}, {0, 0, 0}, {1, 1, 0}},
                               {{1e9f, 1e9f, -1e9f}, {-1e9f, 1e9f, 1e9f}},
                               random_points(random, 64, 1e-3f),
                               random_points(random, 64, 100.0f)};
    Points line;
    for (int i = 0; i < 64; ++i) line.emplace_back(random.around(3.0f), 0.0f, 0.0f);
    curves.push_back(line);
    for (int trial = 0; trial < 2000; ++trial) {
        Points points = random_points(random, 2 + random.below(8));
        for (glm::vec3& each : points) {
            if (random.chance(3)) each = points[random.below(points.size())];
            if (random.chance(20)) each = random.point(1e6f);
            if (random.chance(20)) each *= 1e-12f;
        }
        curves.push_back(points);
    }
    for (std::size_t c = 0; c < curves.size(); ++c)
        for (const CurveKind kind : {CurveKind::Hermite, CurveKind::BSpline}) {
            std::vector<float> lengths = random_lengths(random, 7, 1.0f);
            if (c % 3 == 0) lengths[random.below(7)] = 0.0f;
            if (c % 5 == 0) lengths[random.below(7)] = 1e-20f;
            Placed chain(lengths);
            const glm::vec3 up = c % 4 ? random.point(1.0f) : glm::vec3(0.0f);
            const CurveReport report = chain.place(
                curves[c], {.kind = kind, .fit = c % 7 == 0, .up = up, .weight = c % 2 ? 1.0f : 0.7f});
            ASSERT_NE(report.status, Status::InvalidInput) << c;
            const bool all_equal =
                std::ranges::all_of(curves[c], [&](const glm::vec3& each) { return each == curves[c][0]; });
            ASSERT_EQ(report.collapsed, all_equal) << c;
            ASSERT_TRUE(ik::check(chain.state, 7)) << c;
            for (std::size_t i = 0; i < 7; ++i) {
                const float size = 1.0f + glm::length(chain.joints[i]);
                ASSERT_TRUE(std::isfinite(size)) << c;
                if (c % 7 != 0) {
                    ASSERT_NEAR(glm::distance(chain.joints[i], chain.joints[i + 1]), lengths[i], 2e-6f * size)
                        << c;
                }
            }
        }
}

TEST(IkCurve, AllocatesNothing) {
    Random random(3);
    const Points points = random_points(random, 8);
    Placed chain(std::vector<float>(30, 0.1f));
    CurveReport report;
    without_memory([&] { report = chain.place(points, {.fit = true}); });
    EXPECT_NE(report.status, Status::InvalidInput);
}

}  // namespace
}  // namespace tendril::test::ik_curve_test
