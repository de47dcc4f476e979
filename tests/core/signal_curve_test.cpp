#include "tendril/signal/curve.hpp"

#include "signal_support.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using signal::Curve;
using signal::CurveKey;
using signal::Piece;

TEST(SignalCurve, PiecesAreConstantLinearOrCubic) {
    const Curve curve{.keys = {{.time = 0.0, .value = 1.0, .piece = Piece::Constant},
                               {.time = 1.0, .value = 3.0, .piece = Piece::Linear},
                               {.time = 2.0, .value = 5.0, .leave = 4.0, .piece = Piece::Cubic},
                               {.time = 4.0, .value = 5.0, .arrive = -4.0}}};
    EXPECT_EQ(signal::evaluate_keys(curve, 0.0), 1.0);
    EXPECT_EQ(signal::evaluate_keys(curve, 0.999), 1.0);
    EXPECT_EQ(signal::evaluate_keys(curve, 1.0), 3.0);
    EXPECT_EQ(signal::evaluate_keys(curve, 1.25), 3.5);
    EXPECT_EQ(signal::evaluate_keys(curve, 2.0), 5.0);
    EXPECT_EQ(signal::evaluate_keys(curve, 3.0), 7.0) << "a parabola: slopes 4 and -4 over 2";
    EXPECT_EQ(signal::evaluate_keys(curve, 4.0), 5.0);
    EXPECT_EQ(signal::evaluate_keys(curve, -10.0), 1.0) << "the end values hold";
    EXPECT_EQ(signal::evaluate_keys(curve, 10.0), 5.0);
    const double h = 1e-6;
    EXPECT_NEAR((signal::evaluate_keys(curve, 2.0 + h) - 5.0) / h, 4.0, 1e-4);
    EXPECT_NEAR((5.0 - signal::evaluate_keys(curve, 4.0 - h)) / h, -4.0, 1e-4);
}

TEST(SignalCurve, MapsFromTheSourceRangeToTheTargetRange) {
    Curve curve{.source_min = 10.0, .source_max = 20.0, .target_min = 45.0, .target_max = -45.0};
    EXPECT_EQ(signal::evaluate(curve, 10.0), 45.0);
    EXPECT_EQ(signal::evaluate(curve, 15.0), 0.0);
    EXPECT_EQ(signal::evaluate(curve, 25.0), -45.0);
    curve.source_min = 20.0;
    for (const double value : {-5.0, 20.0, 100.0}) EXPECT_EQ(signal::evaluate(curve, value), 45.0);
    EXPECT_EQ(signal::evaluate(curve, not_a_number), 45.0);
    curve.keys = {{.time = 0.5, .value = 0.25}};
    EXPECT_EQ(signal::evaluate(curve, 3.0), 22.5) << "one key";
    curve.keys.clear();
    EXPECT_EQ(signal::evaluate(curve, 3.0), 45.0) << "none";
}

TEST(SignalCurve, RefusalsNameTheKey) {
    const auto message = [](std::vector<CurveKey> keys) -> std::string {
        return signal::check(Curve{.keys = std::move(keys)}).message();
    };
    EXPECT_TRUE(test::says(message({}), "curve keys none"));
    EXPECT_TRUE(test::says(message({{.time = 0.0}, {.time = 0.5}, {.time = 0.25}}),
                           "curve keys[2].time before 0.25"));
    EXPECT_TRUE(test::says(message({{.time = 0.0}, {.time = 0.0}}), "curve keys[1].time before 0"));
    EXPECT_TRUE(test::says(message({{.time = 0.0}, {.time = 1.0, .value = not_a_number}}),
                           "curve keys[1].value finite 1e9 nan"));
    EXPECT_TRUE(
        test::says(message({{.time = 0.0, .arrive = infinity}}), "curve keys[0].arrive finite 1e9 inf"));
    EXPECT_TRUE(test::says(message({{.time = 0.0, .piece = static_cast<Piece>(7)}}),
                           "curve keys[0].piece constant linear cubic 7"));
    EXPECT_TRUE(test::says(signal::check(Curve{.target_max = not_a_number}).message(),
                           "curve target_max finite 1e9 nan"));
    EXPECT_EQ(signal::check(signal::Filter(Curve{.keys = {}})).code(), ErrorCode::InvalidArgument);
    EXPECT_EQ(message({{.time = -3.0}, {.time = 7.0}}), "");
}

TEST(SignalCurve, IsFiniteHoweverItsKeysLie) {
    Random random(1);
    for (int i = 0; i < 3000; ++i) {
        Curve curve;
        curve.keys.clear();
        const std::size_t count = random.below(6);
        for (std::size_t k = 0; k < count; ++k) {
            const double odd[] = {0.0, 5e-324, 1e9, -1e9, 0.5};
            CurveKey key{.time = odd[random.below(5)], .value = odd[random.below(5)]};
            key.arrive = odd[random.below(5)], key.leave = odd[random.below(5)];
            key.piece = static_cast<Piece>(random.below(3));
            curve.keys.push_back(key);  // unsorted and equal times too: not refused here, but finite
        }
        if (random.chance(2)) signal::set_smooth_tangents(curve);
        for (const double time : {-1e9, 0.0, 5e-324, 0.25, 0.5, 0.75, 1.0, 1e9, not_a_number})
            ASSERT_TRUE(std::abs(signal::evaluate(curve, time)) <= signal::max_output);
    }
}

TEST(SignalCurve, SmoothTangentsStayBetweenKeys) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        Curve curve;
        curve.keys.clear();
        for (int k = 0; k < 8; ++k) {
            const double value = static_cast<double>(random.below(4));
            curve.keys.push_back({.time = k / 7.0, .value = value, .piece = Piece::Cubic});
        }
        signal::set_smooth_tangents(curve);
        double lowest = 4.0, highest = 0.0;
        for (const CurveKey& key : curve.keys) {
            EXPECT_EQ(key.arrive, key.leave);
            lowest = std::min(lowest, key.value), highest = std::max(highest, key.value);
        }
        for (double t = 0.0; t <= 1.0; t += 0.01) {
            EXPECT_GE(signal::evaluate_keys(curve, t), lowest - 0.5);
            EXPECT_LE(signal::evaluate_keys(curve, t), highest + 0.5);
        }
    }
    Curve ramp{.keys = {{.time = 0.0, .value = 0.0, .piece = Piece::Cubic},
                        {.time = 1.0, .value = 1.0, .piece = Piece::Cubic},
                        {.time = 2.0, .value = 4.0}}};
    signal::set_smooth_tangents(ramp);
    EXPECT_EQ(ramp.keys[0].leave, 0.0);
    EXPECT_EQ(ramp.keys[1].leave, 2.0);
}

}  // namespace
}  // namespace tendril::test
