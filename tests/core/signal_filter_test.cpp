// Properties of every kind of filter.
#include "tendril/signal/filter.hpp"

#include <set>

#include "signal_support.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using signal::Filter;
using signal::FilterState;
using signal::Kind;

TEST(SignalFilter, TheTableHasEveryKindAndField) {
    const std::vector<std::string> names{
        "interp_to",  "interp_to_exact", "scale_bias_clamp",     "spring",   "exponential_decay",
        "rate_limit", "smooth_damp",     "spring_semi_implicit", "one_euro", "moving_average",
        "dead_zone",  "hysteresis",      "inertialize",          "curve"};
    ASSERT_EQ(signal::kinds().size(), names.size());
    ASSERT_EQ(std::variant_size_v<Filter>, names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Kind& kind = signal::kinds()[i];
        EXPECT_EQ(kind.name, names[i]);
        EXPECT_EQ(kind.blank().index(), i);
        EXPECT_EQ(signal::find_kind(names[i]), &kind);
        EXPECT_STREQ(signal::kind(kind.blank()), kind.name);
        EXPECT_TRUE(signal::check(kind.blank())) << signal::check(kind.blank()).message();
        EXPECT_FALSE(kind.fields.empty());
    }
    EXPECT_EQ(signal::find_kind("spline"), nullptr);
}

TEST(SignalFilter, RefusalsNameTheParameterAndItsValue) {
    const auto message = [](const Filter& filter) -> std::string { return signal::check(filter).message(); };
    EXPECT_TRUE(test::says(message(signal::RateLimit{.rise = -1.0}), "rate_limit rise 0 1e9 -1"));
    EXPECT_TRUE(test::says(message(signal::Spring<>{.critical_damping = not_a_number}),
                           "spring critical_damping 0 1000 nan"));
    EXPECT_TRUE(test::says(message(signal::ScaleBiasClamp{.in_range = {0.0, infinity}}),
                           "scale_bias_clamp in_range[1] -1e9 1e9 inf"));
    EXPECT_TRUE(test::says(message(signal::ScaleBiasClamp{.clamp_min = 2.0, .clamp_max = 1.0}),
                           "scale_bias_clamp clamp_min clamp_max 2"));
    EXPECT_TRUE(test::says(message(signal::Hysteresis{.low = 1.0, .high = 0.5}), "hysteresis low high 1"));
}

/// Any filter that check() accepts; parameters at the ends of their ranges as often as between.
Filter some_filter(Random& random) {
    for (;;) {
        const Kind& kind = signal::kinds()[random.below(signal::kinds().size())];
        Filter filter = kind.blank();
        for (const Field& field : kind.fields) {
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

TEST(SignalFilter, NeverPutsOutWhatIsNotANumber) {
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

TEST(SignalFilter, TheFirstStepReturnsWhatTheInputAloneSays) {
    const double input = 0.75;
    for (const Kind& kind : signal::kinds()) {
        const std::string name = kind.name;
        const double expected = name == "dead_zone" ? 0.65 : name == "hysteresis" ? 1.0 : input;
        EXPECT_EQ(signal::immediate(kind.blank(), input), expected) << name;
    }
    EXPECT_EQ(signal::immediate(signal::ScaleBiasClamp{.scale = 2.0, .bias = 1.0, .interp = true}, 3.0), 7.0);
    EXPECT_EQ(signal::immediate(signal::RateLimit{}, not_a_number), 0.0);
}

TEST(SignalFilter, StatesPutBackGiveTheSameBits) {
    Random random(3);
    for (int i = 0; i < 1500; ++i) {
        const Filter filter = some_filter(random);
        FilterState state;
        for (int k = 0; k < 20; ++k) {
            const double input = around(random, 2.0), dt = std::exp2(around(random, 8.0));
            signal::step(filter, state, input, dt);
        }
        const FilterState saved = state;
        std::vector<double> first, second;
        std::vector<signal::Sample> rest;
        for (int k = 0; k < 20; ++k) {
            const double input = around(random, 2.0), dt = std::exp2(around(random, 8.0));
            rest.push_back({dt, input});
        }
        for (const signal::Sample& each : rest)
            first.push_back(signal::step(filter, state, each.input, each.dt));
        const FilterState end = state;
        state = saved;
        EXPECT_EQ(state, saved);
        for (const signal::Sample& each : rest)
            second.push_back(signal::step(filter, state, each.input, each.dt));
        EXPECT_EQ(first, second) << signal::kind(filter);
        EXPECT_EQ(state, end) << signal::kind(filter);
    }
}

TEST(SignalFilter, TheStateOfAnotherKindIsTakenAsFresh) {
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

}  // namespace
}  // namespace tendril::test
