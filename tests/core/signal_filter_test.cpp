// Properties shared by every kind of filter.

#include "signal_support.hpp"

namespace tendril::test {
namespace {

using signal::Filter;
using signal::FilterState;
using signal::Kind;

TEST(SignalFilter, TheTableHasEveryKindAndField) {
    for (std::size_t i = 0; i < std::variant_size_v<Filter>; ++i) {
        const Kind& kind = signal::kinds()[i];
        EXPECT_EQ(kind.blank().index(), i);
        EXPECT_EQ(signal::find_kind(signal::kind_names[i]), &kind);
        EXPECT_STREQ(signal::kind(kind.blank()), kind.name);
        EXPECT_TRUE(signal::check(kind.blank())) << signal::check(kind.blank()).message();
        EXPECT_FALSE(kind.table().empty());
    }
    EXPECT_EQ(signal::find_kind("spline"), nullptr);
}

TEST(SignalFilter, RefusalsNameTheParameterAndItsValue) {
    const auto message = [](const Filter& filter) -> std::string { return signal::check(filter).message(); };
    EXPECT_TRUE(says(message(signal::ScaleBiasClamp{.in_range = {0.0, infinity}}),
                     "scale_bias_clamp in_range[1] -1e9 1e9 inf"));
    EXPECT_TRUE(says(message(signal::ScaleBiasClamp{.clamp_min = 2.0, .clamp_max = 1.0}),
                     "scale_bias_clamp clamp_min clamp_max 2"));
    EXPECT_TRUE(says(message(signal::Hysteresis{.low = 1.0, .high = 0.5}), "hysteresis low high 1"));
}

/// A filter that check() accepts; parameters are at the ends of their ranges as often as in between.
Filter some_filter(Random& random) {
    for (;;) {
        const Kind& kind = signal::kinds()[random.below(signal::kinds().size())];
        Filter filter = kind.blank();
        for (const Field& field : kind.table()) {
            if (field.count != nullptr) continue;
            const FieldRange usual = field.slider();
            const double lows[] = {field.range.low, field.range.high, usual.low, usual.high, 0.0};
            for (int i = 0; i < field.size(); ++i) {
                double value = lows[random.below(5)];
                if (random.chance(2)) value = between(random, usual.low, usual.high);
                if (field.type == FieldType::Flag) value = random.chance(2) ? 1.0 : 0.0;
                if (!random.chance(4)) field.set_number(fields_in(filter), value, i);
            }
        }
        if (signal::check(filter)) return filter;
    }
}
double some_dt(Random& random) {
    const double odd[] = {0.0, -1.0, not_a_number, infinity, 1e-300, 5e-324, 1e-12, 3600.0, 1e9, 1e300};
    return random.chance(4) ? odd[random.below(10)] : std::exp2(around(random, 14.0));
}
double some_input(Random& random) {
    const double odd[] = {not_a_number, infinity, -infinity, 1e300, 1e9, -1e9, 5e-324, -0.0};
    return random.chance(6) ? odd[random.below(8)] : around(random, random.chance(3) ? 1e9 : 2.0);
}

TEST(SignalFilter, NeverOutputsNaN) {
    Random random(1);
    for (int i = 0; i < 6000; ++i) {
        const Filter filter = some_filter(random);
        FilterState state;
        for (int k = 0; k < 60; ++k) {
            const double dt = some_dt(random), input = some_input(random),
                         output = signal::step(filter, state, input, dt);
            ASSERT_TRUE(std::abs(output) <= signal::max_output)
                << signal::kind(filter) << " gives " << output << " for " << input << ", dt " << dt;
        }
    }
}

TEST(SignalFilter, RefusedInputsAndTimesChangeNothing) {
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const Filter filter = some_filter(random);
        FilterState state;
        for (int k = 0; k < 5; ++k) {
            const FilterState before = state;
            for (const double bad : {not_a_number, infinity, -infinity, 1.01e9}) {
                EXPECT_EQ(signal::step(filter, state, bad, 0.1), signal::value(before));
                EXPECT_EQ(state, before) << signal::kind(filter);
            }
            for (const double dt : {0.0, -1.0, not_a_number, infinity}) {
                const double output = signal::step(filter, state, 0.7, dt);
                EXPECT_EQ(output,
                          signal::started(before) ? signal::value(before) : signal::immediate(filter, 0.7));
                EXPECT_EQ(state, before) << signal::kind(filter);
            }
            const double input = around(random, 3.0);
            const double output = signal::step(filter, state, input, 0.01);
            EXPECT_TRUE(signal::started(state));
            EXPECT_EQ(output, signal::value(state));
            if (!signal::started(before)) {
                EXPECT_EQ(output, signal::immediate(filter, input));
            }
        }
    }
}

TEST(SignalFilter, TheFirstStepDependsOnTheInputOnly) {
    const double input = 0.75;
    for (const Kind& kind : signal::kinds()) {
        const std::string name = kind.name;
        const double expected = name == "dead_zone" ? 0.65 : name == "hysteresis" ? 1.0 : input;
        EXPECT_EQ(signal::immediate(kind.blank(), input), expected) << name;
    }
    EXPECT_EQ(signal::immediate(signal::ScaleBiasClamp{.scale = 2.0, .bias = 1.0, .interp = true}, 3.0), 7.0);
    EXPECT_EQ(signal::immediate(signal::RateLimit{}, not_a_number), 0.0);
}

TEST(SignalFilter, AStateOfAnotherKindStartsOver) {
    FilterState state;
    signal::step(signal::Spring<>{}, state, 5.0, 0.1);
    EXPECT_EQ(signal::step(signal::SmoothDamp{}, state, not_a_number, 0.1), 0.0);
    EXPECT_EQ(signal::value(state), 5.0) << "refused: nothing has changed";
    EXPECT_EQ(signal::step(signal::SmoothDamp{}, state, 2.0, 0.1), 2.0) << "the first step";
    EXPECT_TRUE(std::holds_alternative<signal::MotionState>(state));
}

TEST(SignalScaleBiasClamp, StagesFollowInOrder) {
    const signal::ScaleBiasClamp all{.map_range = true,
                                     .in_range = {0.0, 10.0},
                                     .out_range = {1.0, 0.0},
                                     .scale = 4.0,
                                     .bias = 0.5,
                                     .clamp = true,
                                     .clamp_min = -3.0,
                                     .clamp_max = 3.0,
                                     .interp = true,
                                     .speed_increasing = 2.0,
                                     .speed_decreasing = 1.0};
    signal::OutputState state;
    EXPECT_EQ(signal::step(all, state, 5.0, 0.25), 2.5) << "the first without interpolation";
    EXPECT_EQ(signal::step(all, state, 0.0, 0.25), 2.75) << "4.5, clamped to 3; half of the way up";
    EXPECT_EQ(signal::step(all, state, 20.0, 0.25), 2.75 - 0.25 * 5.75) << "1 to 0 goes on beyond 10";
    signal::ScaleBiasClamp narrow{.map_range = true, .in_range = {2.0, 2.0}, .out_range = {7.0, 9.0}};
    EXPECT_EQ(signal::immediate(narrow, -100.0), 7.0);
    EXPECT_EQ(signal::immediate(narrow, 2.0), 7.0);
    narrow.in_range = {0.0, 5e-324};
    EXPECT_TRUE(std::isfinite(signal::immediate(narrow, 1e9)));
    narrow.out_range = {7.0, 7.0};
    EXPECT_EQ(signal::immediate(narrow, 1e9), 7.0);
}

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
    EXPECT_TRUE(says(message({}), "curve keys none"));
    EXPECT_TRUE(
        says(message({{.time = 0.0}, {.time = 0.5}, {.time = 0.25}}), "curve keys[2].time before 0.25"));
    EXPECT_TRUE(says(message({{.time = 0.0}, {.time = 0.0}}), "curve keys[1].time before 0"));
    EXPECT_TRUE(
        says(message({{.time = 0.0}, {.time = 1.0, .value = not_a_number}}), "curve keys[1].value 1e9 nan"));
    EXPECT_EQ(signal::check(signal::Filter(Curve{.keys = {}})).code(), ErrorCode::InvalidArgument);
    EXPECT_EQ(message({{.time = -3.0}, {.time = 7.0}}), "");
}

TEST(SignalCurve, IsFiniteForAnyKeys) {
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
            curve.keys.push_back(key);  // unsorted and equal times too: accepted here, and finite
        }
        if (random.chance(2)) signal::set_smooth_tangents(curve);
        for (const double time : {-1e9, 0.0, 5e-324, 0.25, 0.5, 0.75, 1.0, 1e9, not_a_number})
            ASSERT_TRUE(std::abs(signal::evaluate(curve, time)) <= signal::max_output);
    }
}

TEST(SignalCurve, SmoothTangentsStayBetweenKeys) {
    Curve uneven{
        .keys = {{.time = 0.0, .value = 0.0}, {.time = 0.2, .value = 1.0}, {.time = 1.0, .value = 2.0}}};
    signal::set_smooth_tangents(uneven);
    EXPECT_DOUBLE_EQ(uneven.keys[1].leave, 2.0) << "from neighbour to neighbour";
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
