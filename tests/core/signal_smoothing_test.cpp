#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

#include "signal_support.hpp"
#include "tests/places.hpp"

namespace tendril::test::signal_smoothing_test {
namespace {

TEST(SignalSmoothing, ExponentialDecayHalvesEveryHalflife) {
    const signal::Filter filter = filter_of("exponential_decay", {{"halflife", 0.25}});
    EXPECT_EQ(outputs(filter, 0.25, {0.0, 1.0, 1.0, 1.0}), (std::vector<double>{0.0, 0.5, 0.75, 0.875}));
    EXPECT_NEAR(reached(filter, 144.0, 0.5), 0.75, 1e-12);
    EXPECT_EQ(outputs(filter_of("exponential_decay", {{"halflife", 0.0}}), 0.01, {0.0, 1.0}).back(), 1.0);
    Random random(1);
    for (int i = 0; i < 10'000; ++i) {
        signal::OutputState state{.value = 1.0, .started = true};
        const double dt = std::exp2(around(random, 12.0)), halflife = std::exp2(around(random, 6.0));
        signal::step(signal::ExponentialDecay{halflife}, state, 0.0, dt);
        EXPECT_NEAR(state.value, std::exp2(-dt / halflife), 1e-15 + 1e-14 * state.value);
    }
}

TEST(SignalSmoothing, RateLimitBoundsTheRate) {
    const signal::Filter filter = filter_of("rate_limit", {{"rise", 2.0}, {"fall", 8.0}});
    EXPECT_EQ(outputs(filter, 0.125, {0.0, 1.0, 1.0, -5.0, -0.625}),
              (std::vector<double>{0.0, 0.25, 0.5, -0.5, -0.625}));
    EXPECT_EQ(outputs(filter_of("rate_limit", {{"rise", 0.0}}), 1.0, {0.0, 1.0}).back(), 0.0);
}

TEST(SignalSmoothing, SmoothDampIsNotExact) {
    const signal::Filter filter = filter_of("smooth_damp", {{"smooth_time", 0.1}});
    EXPECT_NEAR(outputs(filter, 0.5, {0.0, 1.0}).back(), 0.9626, 5e-5);
    const double w = 2.0 / 0.1, exact = 1.0 - (1.0 + w * 0.5) * std::exp(-w * 0.5);
    EXPECT_NEAR(exact, 0.9995, 5e-5);
    const signal::Filter spring = filter_of("spring", {{"strength", w / turn}, {"critical_damping", 1.0}});
    EXPECT_NEAR(outputs(spring, 0.5, {0.0, 1.0}).back(), exact, 1e-12);
}

TEST(SignalSmoothing, SmoothDampNeverPassesItsTarget) {
    Random random(2);
    for (int i = 0; i < 300; ++i) {
        const signal::SmoothDamp parameters{between(random, 0.0, 1.0), random.chance(2) ? 3.0 : 1e6};
        signal::MotionState state;
        for (int k = 0; k < 60; ++k) {
            const double before = state.value, input = around(random, 4.0), dt = between(random, 1e-4, 0.3);
            const bool first = !state.started;
            const double after = signal::step(parameters, state, input, dt);
            if (!first) {
                EXPECT_LE((after - input) * (input - before), 1e-12);
            }
        }
    }
}

/// The maximum output within 30 s after a step from 0 to 1.
double largest_at(double hz) {
    const signal::SpringSemiImplicit spring{.strength = 8.0, .critical_damping = 1.0};
    signal::MotionState state;
    signal::step(spring, state, 0.0, 1.0 / hz);
    double largest = 0.0;
    for (int i = 0; i < static_cast<int>(30 * hz); ++i)
        largest = std::max(largest, std::abs(signal::step(spring, state, 1.0, 1.0 / hz)));
    return largest;
}

TEST(SignalSmoothing, TheSemiImplicitSpringExplodesUnder60Point7Frames) {
    EXPECT_LT(largest_at(60.8), 3.0);
    EXPECT_GT(largest_at(60.5), 3.0);
    EXPECT_GT(largest_at(15.0), 1e20);
    EXPECT_LE(largest_at(15.0), signal::max_output) << "never more than that";
}

/// After a jump the filter continues exactly like a fresh one.
TEST(SignalSmoothing, OneEuroStartsOverAfterAJump) {
    const signal::OneEuro plain{.min_cutoff = 1.0, .beta = 0.5},
        resets{.min_cutoff = 1.0, .beta = 0.5, .reset_jump = 0.5};
    signal::MotionState slow, anew, fresh;
    const double dt = 1.0 / 60.0;
    for (int i = 0; i < 30; ++i) {
        const double hand = 0.01 * i;
        EXPECT_EQ(signal::step(resets, anew, hand, dt), signal::step(plain, slow, hand, dt))
            << "without a jump";
    }
    EXPECT_EQ(signal::step(resets, anew, 5.0, dt), 5.0);
    EXPECT_LT(signal::step(plain, slow, 5.0, dt), 4.0);
    signal::step(plain, fresh, 5.0, dt);
    for (int i = 0; i < 30; ++i)
        EXPECT_EQ(signal::step(resets, anew, 5.0 + 0.01 * i, dt),
                  signal::step(plain, fresh, 5.0 + 0.01 * i, dt));
    EXPECT_EQ(signal::step(resets, anew, 50.0, 0.0), anew.value) << "no time passes";
    EXPECT_LT(anew.value, 6.0);
}

TEST(SignalSmoothing, OneEuroIsSteadyAtRestAndFastInMotion) {
    const signal::OneEuro filter{.min_cutoff = 1.0, .beta = 0.5};
    Random random(3);
    signal::MotionState rest, motion;
    double worst_rest = 0.0, worst_lag = 0.0;
    for (int i = 0; i < 600; ++i) {
        const double noise = around(random, 0.01), place = 5.0 * i / 60.0;
        const double steady = signal::step(filter, rest, noise, 1.0 / 60.0);
        const double moving = signal::step(filter, motion, place, 1.0 / 60.0);
        if (i > 300) worst_rest = std::max(worst_rest, std::abs(steady));
        if (i > 300) worst_lag = std::max(worst_lag, (place - moving) / 5.0);
    }
    EXPECT_LT(worst_rest, 0.006);
    EXPECT_LT(worst_lag, 0.08) << "1 Hz alone would lag 0.16 s";
    // By hand: dt 0.1, cutoffs 1: alpha = 0.6283 / 1.6283; derivative 0.3859 * 20 = 7.717, cutoff 4.859.
    signal::MotionState state;
    signal::step(filter, state, 0.0, 0.1);
    EXPECT_NEAR(signal::step(filter, state, 2.0, 0.1), 2.0 * 3.0528 / 4.0528, 1e-4);
    EXPECT_NEAR(state.velocity, 7.7173, 1e-4);
}

/// The documented definition, computed from all samples.
double mean_of_last(const std::deque<std::pair<double, double>>& samples, double window) {
    double time = 0.0, area = 0.0;
    for (auto sample = samples.rbegin(); sample != samples.rend() && time < window; ++sample) {
        const double dt = std::min(sample->first, window - time);
        time += dt;
        area += dt * sample->second;
    }
    return time > 0.0 ? area / time : samples.back().second;
}

TEST(SignalSmoothing, MovingAverageWeightsTheOldestSampleInPart) {
    Random random(4);
    for (const double window : {0.0, 0.03, 0.2, 1.0, 100.0}) {
        const signal::MovingAverage filter{window};
        signal::MovingAverageState state;
        std::deque<std::pair<double, double>> samples;
        for (int i = 0; i < 2000; ++i) {
            const double dt = random.chance(30) ? 0.5 : between(random, 1e-4, 0.05),
                         input = around(random, 3.0);
            samples.emplace_back(dt, input);
            ASSERT_NEAR(signal::step(filter, state, input, dt), mean_of_last(samples, window), 1e-12)
                << window << " s, row " << i;
        }
        EXPECT_LE(state.entries.size(), window > 50.0 ? 2000u : 200u + static_cast<unsigned>(window * 2000));
    }
}

TEST(SignalSmoothing, MovingAverageKeepsNothingOfOldSamples) {
    const signal::MovingAverage filter{0.1};
    signal::MovingAverageState state;
    signal::step(filter, state, 1e9, 0.01);
    double output = 0.0;
    for (int i = 0; i < 30; ++i) output = signal::step(filter, state, 1e-9, 0.01);
    EXPECT_NEAR(output, 1e-9, 1e-22) << "no rounding of the large one is left";
}

TEST(SignalShaping, DeadZoneAndHysteresis) {
    EXPECT_EQ(outputs(filter_of("dead_zone", {{"width", 0.5}}), 0.1, {0.25, -0.5, 0.75, -2.0, 0.0}),
              (std::vector<double>{0.0, 0.0, 0.25, -1.5, 0.0}));
    EXPECT_FALSE(std::signbit(outputs(filter_of("dead_zone"), 0.1, {-0.01}).back()));
    EXPECT_EQ(outputs(filter_of("hysteresis", {{"low", 0.25}, {"high", 0.75}}), 0.1,
                      {0.5, 0.75, 0.5, 0.3, 0.25, 0.7, 0.8}),
              (std::vector<double>{0, 1, 1, 1, 0, 0, 1}));
    EXPECT_EQ(outputs(filter_of("hysteresis", {{"low", 0.5}, {"high", 0.5}}), 0.1, {0.5, 0.4, 0.6, 0.5}),
              (std::vector<double>{1, 0, 1, 1}));
}

TEST(SignalInertialize, PassesAnInputWithoutJumps) {
    const signal::Filter filter = filter_of("inertialize", {{"threshold", 0.5}});
    std::vector<double> wave;
    for (int i = 0; i < 200; ++i) wave.push_back(3.0 * std::sin(0.1 * i));
    EXPECT_EQ(outputs(filter, 1.0 / 60.0, wave), wave);
    EXPECT_EQ(outputs(filter_of("inertialize", {{"halflife", 0.0}}), 0.1, {0.0, 5.0}).back(), 5.0);
}

TEST(SignalInertialize, ReplacesAJumpByASmoothTransition) {
    // Two slopes with a jump of 5 in between: position and velocity of the output are continuous.
    const signal::Filter filter = filter_of("inertialize", {{"halflife", 0.2}, {"threshold", 1.0}});
    const double dt = 1.0 / 2000.0;
    std::vector<double> cut;
    for (int i = 0; i < 2000; ++i) cut.push_back(2.0 * i * dt);
    for (int i = 0; i < 6000; ++i) cut.push_back(7.0 - 3.0 * i * dt);
    const std::vector<double> smooth = outputs(filter, dt, cut);
    for (std::size_t i = 2; i < smooth.size(); ++i) {
        const double velocity = (smooth[i] - smooth[i - 1]) / dt,
                     before = (smooth[i - 1] - smooth[i - 2]) / dt;
        // Bound: w^2 times 5, and 2 w times a relative velocity of 5, with w = 2 ln 2 / 0.2 s.
        ASSERT_LT(std::abs(velocity - before), 320.0 * dt) << "row " << i;
    }
    EXPECT_NEAR(smooth[2000 + 4000], cut[2000 + 4000], 0.01) << "after ten half-lives";
    // Without velocities, (1 + 2 ln 2) / 4 is left after one half-life.
    signal::FilterState state;
    signal::step(filter, state, 0.0, dt);
    for (int i = 0; i < 400; ++i) signal::step(filter, state, 4.0, dt);
    EXPECT_NEAR(4.0 - signal::value(state), 4.0 * (1.0 + 2.0 * std::log(2.0)) / 4.0, 1e-9);
}

TEST(SignalInertialize, NoiseWithConstantJumpsStaysBounded) {
    const signal::Filter filter = filter_of("inertialize", {{"halflife", 0.3}, {"threshold", 0.01}});
    Random random(5);
    signal::FilterState state;
    for (int i = 0; i < 20'000; ++i) {
        const double input = around(random, 1.0), dt = between(random, 0.001, 0.1);
        EXPECT_LT(std::abs(signal::step(filter, state, input, dt)), 5.0);
    }
}

}  // namespace
}  // namespace tendril::test::signal_smoothing_test

namespace tendril::test {
namespace {

using signal::interp_to;
using signal::interp_to_exact;

glm::dquat about(const glm::dvec3& axis, double angle) {
    return glm::angleAxis(angle, axis);
}
/// Angle between two rotations by the shorter way, radians.
double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat between = a * glm::conjugate(b);
    return 2.0 * std::atan2(glm::length(glm::dvec3(between.x, between.y, between.z)), std::abs(between.w));
}

TEST(SignalInterpolate, TheExactFormDoesNotDependOnFrameRate) {
    const signal::Filter filter = filter_of("interp_to_exact", {{"speed", 10.0}});
    for (const double hz : {30.0, 60.0, 144.0})
        EXPECT_NEAR(1.0 - reached(filter, hz, 0.5), std::exp(-5.0), 1e-6) << hz << " Hz";
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const double from = around(random, 100.0), to = around(random, 100.0);
        const double dt = between(random, 1e-4, 1.0), speed = between(random, 0.0, 20.0);
        const double whole = interp_to_exact(from, to, dt, speed);
        const double halves = interp_to_exact(interp_to_exact(from, to, dt / 2, speed), to, dt / 2, speed);
        EXPECT_NEAR(whole, halves, 1e-9 * (1.0 + std::abs(to - from)));
        const double near = to + 1e-5;  // close enough for interp_to to snap
        EXPECT_NEAR(interp_to_exact(interp_to_exact(near, to, dt / 2, speed), to, dt / 2, speed) - to,
                    1e-5 * std::exp(-speed * dt), 1e-12);
    }
}

TEST(SignalInterpolate, NeverOvershoots) {
    Random random(2);
    for (int i = 0; i < 10'000; ++i) {
        const double from = around(random, 1e3), to = around(random, 1e3);
        const double dt = std::exp2(around(random, 20.0)), speed = std::exp2(around(random, 10.0));
        for (const double next : {interp_to(from, to, dt, speed), interp_to_exact(from, to, dt, speed)}) {
            EXPECT_GE(next, std::min(from, to));
            EXPECT_LE(next, std::max(from, to));
        }
    }
}

TEST(SignalInterpolate, JumpsAtSpeedZeroAndArrivesExactly) {
    EXPECT_EQ(interp_to(1.0, 5.0, 0.1, 0.0), 5.0);
    EXPECT_EQ(interp_to(1.0, 5.0, 0.1, -3.0), 5.0);
    EXPECT_EQ(interp_to(1.0, 5.0, 0.1, not_a_number), 5.0);
    EXPECT_EQ(interp_to(1.0, 1.00009, 0.001, 1.0), 1.00009) << "squared distance under 1e-8";
    EXPECT_NE(interp_to(1.0, 1.00011, 0.001, 1.0), 1.00011);
    EXPECT_EQ(interp_to(1.0f, 5.0f, 0.25, 2.0), 3.0f);
    EXPECT_EQ(interp_to(glm::vec3(1, 2, 3), glm::vec3(5, 2, 1), 0.25, 2.0), glm::vec3(3, 2, 2));
    EXPECT_EQ(interp_to(glm::dvec3(1, 2, 3), glm::dvec3(5, 2, 1), 1.0, 2.0), glm::dvec3(5, 2, 1));
}

TEST(SignalInterpolate, RotationsTakeTheShortWay) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(random.point(1.0f)) + glm::dvec3(0, 0, 1.5));
        const double angle = between(random, 0.01, 3.1);
        const glm::dquat from = about({1, 0, 0}, around(random, 3.0)), to = about(axis, angle) * from;
        const double sign = random.chance(2) ? -1.0 : 1.0;  // the same rotation with either sign
        const glm::dquat mid = interp_to(from, to * sign, 0.25, 1.0);
        EXPECT_NEAR(angle_between(from, mid), 0.25 * angle, 1e-9);
        EXPECT_NEAR(angle_between(mid, to), 0.75 * angle, 1e-9);
        EXPECT_NEAR(glm::length(mid), 1.0, 1e-12);
        const glm::quat coarse = interp_to(glm::quat(from), glm::quat(to), 0.25, 1.0);
        EXPECT_NEAR(angle_between(glm::dquat(coarse), mid), 0.0, 1e-6);
    }
    const glm::quat target(0.5f, 0.5f, -0.5f, 0.5f);
    EXPECT_EQ(interp_to(glm::quat(1, 0, 0, 0), target, 1.0, 1.0), target);
    EXPECT_EQ(interp_to(-target, target, 1e-3, 1.0), target) << "they are the same rotation";
}

TEST(SignalInterpolate, BadNumbersChangeNothing) {
    for (const double bad : {not_a_number, infinity, -infinity, 1.1e9}) {
        EXPECT_EQ(interp_to(3.0, bad, 0.1, 1.0), 3.0);
        EXPECT_EQ(interp_to_exact(3.0, bad, 0.1, 1.0), 3.0);
        EXPECT_EQ(interp_to(glm::vec3(1), glm::vec3(0, static_cast<float>(bad), 0), 0.1, 1.0), glm::vec3(1));
    }
    for (const double dt : {0.0, -1.0, not_a_number, infinity, -infinity})
        EXPECT_EQ(interp_to(3.0, 4.0, dt, 0.0), 3.0) << dt;
    EXPECT_EQ(interp_to(not_a_number, 4.0, 0.1, 1.0), 4.0);
    const glm::quat good(1, 0, 0, 0), none(0, 0, 0, 0);
    EXPECT_EQ(interp_to(good, none, 0.1, 1.0), good);
    EXPECT_EQ(interp_to(none, good, 0.1, 1.0), good);
}

// Numeric cases from an independent implementation in double precision. Skipped if the files are missing; the
// other tests do not need them.

using Json = nlohmann::json;
using signal::Filter;
using signal::FilterState;

Json reference(const char* name) {
    std::ifstream file(reference_path(name));
    return file ? Json::parse(file) : Json();
}

/// A case's filter; each parameter must be in the kind's table.
Filter filter_of(const std::string& kind, const Json& parameters) {
    const signal::Kind* const found = signal::find_kind(kind);
    EXPECT_NE(found, nullptr) << kind;
    Filter filter = found->blank();
    std::size_t read = 0;
    for (const Field& field : found->table()) {
        const auto given = parameters.find(field.name);
        if (given == parameters.end()) continue;
        ++read;
        for (int i = 0; i < field.size(); ++i) {
            const Json& value = given->is_array() ? given->at(static_cast<std::size_t>(i)) : *given;
            field.set_number(signal::fields_in(filter),
                             value.is_boolean() ? (value.get<bool>() ? 1.0 : 0.0) : value.get<double>(), i);
        }
    }
    EXPECT_EQ(read, parameters.size());
    EXPECT_TRUE(signal::check(filter)) << signal::check(filter).message();
    return filter;
}

/// Plays a case and returns the maximum deviation.
double play(const Json& example, const std::string& kind) {
    SCOPED_TRACE(example.at("name").get<std::string>());
    const Filter filter = filter_of(kind, example.at("params"));
    FilterState state;
    double worst = 0.0;
    for (std::size_t i = 0; i < example.at("steps").size(); ++i) {
        const Json& row = example["steps"][i];
        const double output =
            signal::step(filter, state, row.at("input").get<double>(), row.at("dt").get<double>());
        const double off = std::abs(output - row.at("expect").get<double>());
        EXPECT_LE(off, example.at("tolerance").get<double>()) << "row " << i;
        worst = std::max(worst, off);
    }
    return worst;
}

TEST(SignalReference, Filters) {
    for (const std::string name : {"filters", "scale_bias_clamp"}) {
        const Json cases = reference((name + ".json").c_str());
        if (cases.empty()) GTEST_SKIP() << name << ".json is not there";
        double worst = 0.0;
        for (const Json& example : cases) worst = std::max(worst, play(example, example.value("kind", name)));
        std::printf("%zu cases, worst deviation %.2g\n", cases.size(), worst);
    }
}

TEST(SignalReference, Spring) {
    const Json cases = reference("spring.json");
    if (cases.empty()) GTEST_SKIP() << "spring.json is not there";
    double worst = 0.0;
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        const auto spring = std::get<signal::Spring<>>(filter_of("spring", example.at("params")));
        signal::SpringState<> state;
        for (std::size_t i = 0; i < example.at("steps").size(); ++i) {
            const Json& row = example["steps"][i];
            signal::step(spring, state, row.at("target").get<double>(), row.at("dt").get<double>());
            const double off = std::abs(state.value - row.at("expect").at("value").get<double>());
            const double velocity_off =
                std::abs(state.velocity - row.at("expect").at("velocity").get<double>());
            EXPECT_LE(off, example.at("tolerance").get<double>()) << "row " << i;
            EXPECT_LE(velocity_off, example.at("tolerance").get<double>()) << "row " << i;
            worst = std::max({worst, off, velocity_off});
        }
    }
    std::printf("%zu cases, worst deviation %.2g\n", cases.size(), worst);
}

}  // namespace
}  // namespace tendril::test
