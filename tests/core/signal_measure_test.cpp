// Measures of signals with known answers, and comparisons of frame rates.
#include "tendril/signal/measure.hpp"

#include <functional>

#include "signal_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using signal::Filter;
using signal::Response;
using signal::Sample;

/// Samples a function of time.
std::vector<Sample> sampled(const std::function<double(double)>& of, double seconds, double hz) {
    std::vector<Sample> samples;
    for (int i = 0; i <= static_cast<int>(seconds * hz); ++i) samples.push_back({1.0 / hz, of(i / hz)});
    return samples;
}
double step_at_one(double t) {
    return t < 1.0 ? 0.0 : 1.0;
}

struct Rows {
    std::vector<double> time, wanted, output;
    Response response() const { return {time, wanted, output}; }
};
Rows rows(const std::function<double(double)>& wanted, const std::function<double(double)>& output,
          double seconds = 4.0, double hz = 60.0) {
    Rows all;
    for (int i = 0; i <= static_cast<int>(seconds * hz); ++i) {
        all.time.push_back(i / hz);
        all.wanted.push_back(wanted(i / hz));
        all.output.push_back(output(i / hz));
    }
    return all;
}

TEST(SignalMeasure, LagIsTheBestFittingShift) {
    for (const double shift : {-0.21, -0.003, 0.0, 0.0042, 0.05, 0.3, 0.77}) {
        const auto bump = [](double t) { return std::exp(-20.0 * (t - 2.0) * (t - 2.0)); };
        const Rows late = rows(bump, [&](double t) { return bump(t - shift); });
        ASSERT_TRUE(signal::lag(late.response()));
        EXPECT_NEAR(*signal::lag(late.response()), shift, 1e-4);
        const auto ramp = [](double t) { return 3.0 * t; };
        const Rows slope = rows(ramp, [&](double t) { return ramp(std::clamp(t - shift, 0.0, 4.0)); });
        EXPECT_NEAR(*signal::lag(slope.response()), shift, 1e-4);
    }
    const auto bump = [](double t) { return std::exp(-20.0 * (t - 0.8) * (t - 0.8)); };
    const Rows brief = rows(
        bump, [&](double t) { return bump(t - 0.77); }, 2.0);
    EXPECT_FALSE(signal::lag(brief.response())) << "more than a quarter of the time";
    const auto wave = [](double t) { return std::sin(turn * t); };
    const Rows periodic = rows(wave, [&](double t) { return 0.4 * wave(t - 0.1); });
    EXPECT_NEAR(*signal::lag(periodic.response()), 0.1, 0.01) << "not a period more";
}

TEST(SignalMeasure, AConstantSignalHasNoMeasures) {
    const auto flat = [](double) { return 2.0; };
    const auto wave = [](double t) { return std::sin(turn * t); };
    EXPECT_FALSE(signal::lag(rows(flat, wave).response()));
    EXPECT_FALSE(signal::lag(rows(wave, flat).response()));
    EXPECT_FALSE(signal::lag({}));
    EXPECT_FALSE(signal::lag(rows(wave, wave).response(), not_a_number));
    EXPECT_FALSE(signal::lag(rows(wave, wave).response(), infinity));
    EXPECT_FALSE(signal::overshoot(rows(flat, wave).response()));
    EXPECT_FALSE(signal::overshoot(rows(wave, wave).response())) << "no step in it";
    EXPECT_FALSE(signal::settling_time(rows(wave, wave).response()));
    const Rows still = rows(flat, wave);
    EXPECT_FALSE(signal::jitter(still.time, still.wanted, still.output));
    const Filter spring = filter_of("spring");
    for (const std::vector<Sample>& samples :
         {std::vector<Sample>{}, std::vector<Sample>{{0.1, 1.0}}, std::vector<Sample>(50, {0.1, 1.0}),
          std::vector<Sample>(50, {0.1, not_a_number}), std::vector<Sample>(50, {-1.0, 3.0})}) {
        const signal::Measures measures = signal::measure({&spring, 1}, samples);
        EXPECT_FALSE(measures.lag || measures.overshoot || measures.settling_time || measures.jitter);
        EXPECT_EQ(measures.rate_difference, 0.0);
    }
}

TEST(SignalMeasure, OvershootAndSettlingOfSprings) {
    for (const double damping : {0.2, 0.5, 0.8}) {
        const Filter spring = filter_of("spring", {{"strength", 2.0}, {"critical_damping", damping}});
        const signal::Measures measures = signal::measure({&spring, 1}, sampled(step_at_one, 6.0, 1000.0));
        const double expected = std::exp(-damping * turn / 2.0 / std::sqrt(1.0 - damping * damping));
        ASSERT_TRUE(measures.overshoot);
        EXPECT_NEAR(*measures.overshoot, expected, 1e-3) << damping;
    }
    // (1 + w t) exp(-w t) = 0.02 at w t = 5.8339.
    const Filter critical = filter_of("spring", {{"strength", 2.0}, {"critical_damping", 1.0}});
    const signal::Measures measures = signal::measure({&critical, 1}, sampled(step_at_one, 6.0, 1000.0));
    EXPECT_EQ(*measures.overshoot, 0.0);
    EXPECT_NEAR(*measures.settling_time, 5.8339 / (turn * 2.0), 1.1e-3);
    EXPECT_NEAR(*measures.lag, 1.6783 / (turn * 2.0), 0.02) << "about where half is reached";
    EXPECT_FALSE(signal::measure({&critical, 1}, sampled(step_at_one, 1.2, 1000.0)).settling_time)
        << "the input ends too early";
    const Filter pass = filter_of("exponential_decay", {{"halflife", 0.0}});
    EXPECT_EQ(*signal::measure({&pass, 1}, sampled(step_at_one, 2.0, 60.0)).settling_time, 0.0);
}

TEST(SignalMeasure, ARunawayIsUnstableWithoutOtherMeasures) {
    const auto square = sampled([](double t) { return std::fmod(t, 2.0) < 1.0 ? 1.0 : -1.0; }, 10.0, 60.0);
    const Filter explodes = filter_of("spring_semi_implicit", {{"strength", 8.0}, {"critical_damping", 1.0}});
    const signal::Measures measures = signal::measure({&explodes, 1}, square);
    EXPECT_EQ(measures.following, signal::Following::Unstable);
    EXPECT_FALSE(measures.lag || measures.overshoot || measures.settling_time || measures.jitter);
    EXPECT_GT(measures.rate_difference, 1e3);
    // The same filter at a sufficient frame rate, and exact springs, are stable.
    const auto fast = sampled([](double t) { return std::fmod(t, 2.0) < 1.0 ? 1.0 : -1.0; }, 10.0, 75.0);
    EXPECT_EQ(signal::measure({&explodes, 1}, fast).following, signal::Following::Follows);
    for (const double damping : {0.02, 0.35, 1.0, 3.0}) {
        const Filter spring = filter_of("spring", {{"strength", 8.0}, {"critical_damping", damping}});
        EXPECT_EQ(signal::measure({&spring, 1}, square).following, signal::Following::Follows) << damping;
    }
}

TEST(SignalMeasure, ARunawayIsFarOutOfRangeAndGrowing) {
    const auto wave = [](double t) { return std::sin(turn * t); };  // spans 2: beyond 21 is far
    const auto outcome = [&](const std::function<double(double)>& output) {
        return signal::unstable(rows(wave, output).response());
    };
    EXPECT_FALSE(outcome([&](double t) { return 15.0 * wave(t); })) << "a resonance within bounds";
    EXPECT_FALSE(outcome([&](double t) { return 500.0 * wave(t); })) << "it does not grow";
    EXPECT_FALSE(outcome([&](double t) { return 500.0 * std::exp(-t) * wave(t); })) << "it dies away";
    EXPECT_FALSE(outcome([&](double t) { return 5.0 * t * wave(t); })) << "not yet far";
    EXPECT_TRUE(outcome([&](double t) { return 20.0 * t * wave(t); }));
    EXPECT_TRUE(outcome([&](double t) { return std::exp(2.0 * t); }));
    EXPECT_TRUE(outcome([&](double t) { return t < 2.0 ? 0.0 : 1e9; }))
        << "stopped at the end of all numbers";
    EXPECT_TRUE(outcome([&](double t) { return t < 2.0 ? 0.0 : infinity; }));
    EXPECT_TRUE(outcome([&](double t) { return t < 2.0 ? 0.0 : not_a_number; }));
    const auto flat = [](double) { return 2.0; };
    EXPECT_FALSE(signal::unstable(rows(flat, [](double t) { return std::exp(9.0 * t); }).response()));
    EXPECT_FALSE(signal::unstable({}));
}

TEST(SignalMeasure, IndependentMotionHasNoLag) {
    const auto wave = [](double t) { return std::sin(turn * t); };
    const auto verdict = [&](const std::function<double(double)>& output) {
        const Rows all = rows(wave, output);
        return signal::measure(all.response(), all.wanted);
    };
    const auto other = [](double t) { return std::sin(3.7 * turn * t); };
    EXPECT_EQ(verdict(other).following, signal::Following::DoesNotFollow);
    EXPECT_FALSE(verdict(other).lag);
    EXPECT_TRUE(verdict(other).jitter) << "what is left of the input's jitter is still a number";
    EXPECT_EQ(verdict([](double) { return 3.0; }).following, signal::Following::DoesNotFollow);
    // The input's share of the variance is slightly above and slightly below a tenth.
    EXPECT_EQ(verdict([&](double t) { return wave(t) + 2.9 * other(t); }).following,
              signal::Following::Follows);
    EXPECT_EQ(verdict([&](double t) { return wave(t) + 3.2 * other(t); }).following,
              signal::Following::DoesNotFollow);
    EXPECT_EQ(verdict(wave).following, signal::Following::Follows);
    const auto flat = [](double) { return 2.0; };
    const Rows nothing = rows(flat, wave);
    EXPECT_EQ(signal::measure(nothing.response(), nothing.wanted).following, signal::Following::Unknown);
    EXPECT_EQ(signal::measure({}, std::vector<double>{}).following, signal::Following::Unknown);
}

TEST(SignalMeasure, EveryStepCounts) {
    // Up by 1 without overshoot, down by 2 with a tenth of overshoot.
    const Rows both = rows([](double t) { return t < 1.0   ? 0.0
                                                 : t < 2.0 ? 1.0
                                                           : -1.0; },
                           [](double t) {
                               return t < 1.0 ? 0.0 : t < 2.0 ? 1.0 : t < 2.5 ? -1.2 : -1.0;
                           });
    EXPECT_EQ(signal::steps_of(both.response()).size(), 2u);
    EXPECT_NEAR(*signal::overshoot(both.response()), 0.1, 1e-12);
    EXPECT_NEAR(*signal::settling_time(both.response()), 0.5, 1.0 / 60.0);
}

TEST(SignalMeasure, ASpikeIsNoStep) {
    const auto spike = [](double t) { return t > 0.99 && t < 1.01 ? 5.0 : 0.0; };
    EXPECT_TRUE(signal::steps_of(rows(spike, spike).response()).size() == 1u) << "but that back from it is";
    const auto triangle = [](double t) { return std::abs(std::fmod(40.0 * t, 2.0) - 1.0); };
    EXPECT_TRUE(signal::steps_of(rows(triangle, triangle).response()).empty());
}

TEST(SignalMeasure, ScalingIsNotCountedAsAnError) {
    const Filter scale = filter_of("scale_bias_clamp", {{"scale", -20.0}, {"bias", 100.0}});
    const signal::Measures measures = signal::measure({&scale, 1}, sampled(step_at_one, 3.0, 60.0));
    EXPECT_NEAR(*measures.lag, 0.0, 1e-6);
    EXPECT_EQ(*measures.overshoot, 0.0);
    EXPECT_EQ(*measures.settling_time, 0.0);
    EXPECT_NEAR(*measures.jitter, 20.0, 1e-9) << "but that is what is left of the input's";
}

TEST(SignalMeasure, JitterIsTheRemainingPartOfSecondDifferences) {
    Random random(1);
    Rows noisy;
    double time = 0.0;
    for (int i = 0; i < 300; ++i) {
        noisy.time.push_back(time += between(random, 0.005, 0.03));
        noisy.wanted.push_back(around(random, 1.0));
        noisy.output.push_back(0.25 * noisy.wanted.back() + 7.0 * time + 3.0);
    }
    EXPECT_NEAR(*signal::jitter(noisy.time, noisy.wanted, noisy.output), 0.25, 1e-9) << "ramps have none";
    const Filter pass = filter_of("rate_limit", {{"rise", 1e9}, {"fall", 1e9}});
    std::vector<Sample> noise;
    for (int i = 0; i < 300; ++i) noise.push_back({0.01, around(random, 1.0)});
    EXPECT_NEAR(*signal::measure({&pass, 1}, noise).jitter, 1.0, 1e-12);
    const Filter smooth = filter_of("exponential_decay", {{"halflife", 0.2}});
    EXPECT_LT(*signal::measure({&smooth, 1}, noise).jitter, 0.1);
}

double difference_of(const Filter& filter, std::span<const Sample> samples) {
    return signal::compare_rates({&filter, 1}, samples).difference;
}

TEST(SignalRates, TheDifferenceComesFromTheFilterOnly) {
    Random random(2);
    std::vector<Sample> noise;
    for (int i = 0; i < 300; ++i) noise.push_back({1.0 / 60.0, around(random, 2.0)});
    const auto wave = sampled([](double t) { return std::sin(9.0 * t); }, 5.0, 60.0);
    const auto square = sampled([](double t) { return std::fmod(t, 1.1) < 0.55 ? 0.0 : 1.0; }, 5.0, 60.0);
    for (const std::vector<Sample>* samples :
         std::initializer_list<const std::vector<Sample>*>{&noise, &wave, &square}) {
        for (const char* exact : {"spring", "exponential_decay", "rate_limit", "moving_average", "dead_zone",
                                  "hysteresis", "curve", "scale_bias_clamp"})
            EXPECT_LT(difference_of(filter_of(exact), *samples), 1e-9) << exact;
        // Except for the last 1e-4, at which interp_to_exact snaps.
        EXPECT_LT(difference_of(filter_of("interp_to_exact"), *samples), 2e-4);
        for (const char* inexact : {"interp_to", "smooth_damp", "one_euro"})
            EXPECT_GT(difference_of(filter_of(inexact), *samples), 5e-3) << inexact;
        const Filter explodes = filter_of("spring_semi_implicit", {{"strength", 8.0}});
        EXPECT_GT(difference_of(explodes, *samples), 1e3);
    }
}

TEST(SignalRates, StepsMatchTheDocumentedExample) {
    // Half a second after the step, at speed 10; at 15 Hz there have been seven steps, 7/15 s.
    std::vector<Sample> step(60, {1.0 / 60.0, 1.0});
    for (int i = 0; i < 4; ++i) step[static_cast<std::size_t>(i)].input = 0.0;
    const Filter filter = filter_of("interp_to", {{"speed", 10.0}});
    const double half = 4.0 / 60.0 + 0.5;
    const double times[] = {4.0 / 60.0 + 7.0 / 15.0, half};
    const auto outputs = signal::outputs_at({&filter, 1}, step, times);
    ASSERT_EQ(outputs.size(), 5u);
    EXPECT_NEAR(1.0 - outputs[0][0], 0.0005, 5e-5);
    EXPECT_NEAR(1.0 - outputs[1][1], 0.0023, 5e-5);
    EXPECT_NEAR(1.0 - outputs[2][1], 0.0042, 5e-5);
    EXPECT_NEAR(1.0 - outputs[3][1], 0.0056, 1e-4) << "its frames are cut at those of 15 Hz";
}

TEST(SignalRates, AtItsOwnRateItEqualsThePlainRun) {
    const auto samples =
        sampled([](double t) { return std::sin(7.0 * t) + 0.2 * std::sin(31.0 * t); }, 3.0, 60.0);
    const Filter chain[] = {filter_of("one_euro"), filter_of("spring"), filter_of("moving_average")};
    const std::vector<double> plain = signal::run(chain, samples), times = signal::times_of(samples);
    const signal::FrameRate own[] = {{60.0}};
    const std::vector<double> again = signal::outputs_at(chain, samples, times, own)[0];
    ASSERT_EQ(plain.size(), again.size());
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(plain[i], again[i], 1e-9) << i;
    EXPECT_EQ(signal::run_stages(chain, samples).back(), plain);
    EXPECT_EQ(signal::run({}, samples)[5], samples[5].input) << "no filters";
    const auto once = signal::compare_rates(chain, samples),
               again_all = signal::compare_rates(chain, samples);
    EXPECT_EQ(once.difference, again_all.difference);
    EXPECT_EQ(once.runs[4].time, again_all.runs[4].time);
    const std::vector<double> at[] = {{once.at}};
    double low = 10.0, high = -10.0;
    for (const auto& each : signal::outputs_at(chain, samples, at[0]))
        low = std::min(low, each[0]), high = std::max(high, each[0]);
    EXPECT_NEAR(high - low, once.difference, 1e-12) << "outputs_at shows the same runs";
}

LABEL(slow, "SignalRates.FramesHaveTheSpecifiedLengths");

TEST(SignalRates, FramesHaveTheSpecifiedLengths) {
    const Filter filter = filter_of("curve");
    const std::vector<Sample> samples(600, {1.0 / 60.0, 1.0});
    const signal::RateComparison comparison = signal::compare_rates({&filter, 1}, samples);
    ASSERT_EQ(comparison.runs.size(), 5u);
    const std::size_t counts[] = {150, 300, 600, 1560};  // 144 Hz: 1440 frames, and 120 cuts
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(comparison.runs[i].time.size(), counts[i]);
    const signal::RateRun& jittered = comparison.runs[4];
    EXPECT_TRUE(jittered.rate.jittered);
    EXPECT_NEAR(static_cast<double>(jittered.time.size()), 750.0, 40.0) << "600, and 150 cuts";
    for (std::size_t i = 1; i < jittered.time.size(); ++i)
        EXPECT_LE((jittered.time[i] - jittered.time[i - 1]) * 60.0, 1.601);
    for (const signal::RateRun& run : comparison.runs) {
        EXPECT_EQ(run.time.size(), run.output.size());
        EXPECT_NEAR(run.time.back(), 10.0, 1e-9);
        for (std::size_t i = 1; i < run.time.size(); ++i) EXPECT_GT(run.time[i], run.time[i - 1] + 1e-10);
    }
    const std::vector<Sample> endless(3, {1e9, 1.0});
    EXPECT_EQ(signal::compare_rates({&filter, 1}, endless).runs[2].time.size(), 1'000'000u);
    const signal::FrameRate odd[] = {{not_a_number}, {-1.0}, {1e-9}, {1e300}};
    for (const signal::RateRun& run : signal::compare_rates({&filter, 1}, samples, odd).runs)
        EXPECT_EQ(run.time.size(), 600u) << "they count as 60";
    EXPECT_TRUE(signal::compare_rates({&filter, 1}, samples, {}).runs.empty());
}

TEST(SignalRates, InvalidRowsAreIgnored) {
    const Filter spring = filter_of("spring");
    std::vector<Sample> good = sampled([](double t) { return std::cos(3.0 * t); }, 2.0, 60.0), bad = good;
    bad.insert(bad.begin() + 30,
               {{0.0, 5.0}, {-1.0, not_a_number}, {not_a_number, 7.0}, {0.0, good[29].input}});
    EXPECT_EQ(signal::compare_rates({&spring, 1}, good).runs[2].output,
              signal::compare_rates({&spring, 1}, bad).runs[2].output);
    EXPECT_EQ(signal::run({&spring, 1}, good).back(), signal::run({&spring, 1}, bad).back());
    const std::vector<Sample> none(20, {0.1, not_a_number});
    EXPECT_TRUE(signal::compare_rates({&spring, 1}, none).runs.empty());
    const double time = 1.0;
    EXPECT_EQ(signal::outputs_at({&spring, 1}, none, {&time, 1})[0][0], 0.0);
}

}  // namespace
}  // namespace tendril::test
