// Gain of batch.hpp over a plain loop of `step` and `interp_to`, one thread, each value with its own
// parameters.
//
// Claims: the minimum gain in any row, over all kinds of damping, with and without force and target velocity,
// for 1e3, 1e5 and 1e6 values. The plain loop uses an array of parameters and one of states, as a game would.
// Times are processor time.
#include <random>

#include "measure.hpp"
#include "tendril/ik/many.hpp"
#include "tendril/signal/batch.hpp"
#include "tendril/signal/interpolate.hpp"
#include "tendril/signal/spring.hpp"

namespace {

using namespace tendril::bench;
using tendril::signal::Spring;
using tendril::signal::SpringArrays;
using tendril::signal::SpringState;

constexpr int repetitions = 15;
constexpr double dt = 1.0 / 60.0;
constexpr std::size_t sizes[] = {1000, 100'000, 1'000'000};
using Floats = std::vector<float>;

/// Seconds of a plain loop, then of each vector unit.
using Seconds = std::vector<double>;

class Values {
  public:
    Values(std::size_t count, float damping_low, float damping_high, bool pushed)
        : springs_(count), states_(count), target_(count) {
        std::mt19937 random(1);
        const auto draw = [&](float low, float high) {
            return std::uniform_real_distribution<float>(low, high)(random);
        };
        for (std::size_t i = 0; i < count; ++i) {
            strength_.push_back(draw(0.5f, 8.0f)), damping_.push_back(draw(damping_low, damping_high));
            if (pushed) force_.push_back(draw(-10.0f, 10.0f)), amount_.push_back(draw(0.0f, 1.0f));
            springs_[i] = {.strength = static_cast<double>(strength_[i]),
                           .critical_damping = static_cast<double>(damping_[i]),
                           .force = pushed ? force_[i] : 0.0f,
                           .target_velocity_amount = pushed ? static_cast<double>(amount_[i]) : 0.0};
            target_[i] = draw(-1.0f, 1.0f);
        }
        value_ = velocity_ = previous_ = Floats(count);
        require(start_springs(arrays()));
        one_by_one();
    }
    /// Changes the target, so that all are always in motion; not timed.
    void move_targets() {
        for (float& to : target_) to = -0.99f * to;
    }
    void one_by_one() {
        for (std::size_t i = 0; i < states_.size(); ++i) step(springs_[i], states_[i], target_[i], dt);
    }
    void at_once(std::string_view unit) { require(step_springs(arrays(), dt, {unit})); }

    void interp_one_by_one() {
        for (std::size_t i = 0; i < value_.size(); ++i)
            value_[i] =
                tendril::signal::interp_to(value_[i], target_[i], dt, static_cast<double>(strength_[i]));
    }
    void interp_at_once(std::string_view unit) {
        require(tendril::signal::interp_to(value_, target_, strength_, dt, {unit}));
    }
    void exact_one_by_one() {
        for (std::size_t i = 0; i < value_.size(); ++i)
            value_[i] = tendril::signal::interp_to_exact(value_[i], target_[i], dt,
                                                         static_cast<double>(strength_[i]));
    }
    void exact_at_once(std::string_view unit) {
        require(tendril::signal::interp_to_exact(value_, target_, strength_, dt, {unit}));
    }

  private:
    SpringArrays arrays() {
        return {.strength = strength_,
                .critical_damping = damping_,
                .force = force_,
                .target_velocity_amount = amount_,
                .target = target_,
                .value = value_,
                .velocity = velocity_,
                .previous_target = previous_};
    }

    std::vector<Spring<float>> springs_;
    std::vector<SpringState<float>> states_;
    Floats strength_, damping_, force_, amount_, target_, value_, velocity_, previous_;
};

using Plain = void (Values::*)();
using Batch = void (Values::*)(std::string_view);

/// The same work, repeated often enough to be measured.
Seconds compete(Values& values, std::size_t count, Plain plain, Batch batch) {
    const int often = static_cast<int>(std::max<std::size_t>(1, 300'000 / count));
    std::vector<std::function<void()>> runs{[&] {
        for (int i = 0; i < often; ++i) (values.*plain)();
    }};
    for (const std::string_view unit : tendril::ik::vector_units())
        runs.push_back([&values, unit, batch, often] {
            for (int i = 0; i < often; ++i) (values.*batch)(unit);
        });
    Seconds seconds = race(runs, repetitions, cpu_seconds, [&] { values.move_targets(); });
    for (double& each : seconds) each /= often;
    return seconds;
}

/// Gains of each vector unit, row by row.
using Gains = std::vector<std::vector<double>>;

void print_row(const std::string& name, std::size_t count, const Seconds& seconds, Gains& gains) {
    const double each = static_cast<double>(count) * 1e-9;
    std::printf("%-44s%8zu%9.2f", name.c_str(), count, seconds[0] / each);
    gains.resize(seconds.size() - 1);
    for (std::size_t i = 1; i < seconds.size(); ++i) {
        gains[i - 1].push_back(seconds[0] / seconds[i]);
        std::printf("%9.2f %5.1fx", seconds[i] / each, seconds[0] / seconds[i]);
    }
    std::printf("\n");
}

struct Regime {
    const char* name;
    float low, high;
};
constexpr Regime regimes[] = {
    {"without damping", 0.0f, 0.0f},        {"under critical damping", 0.1f, 0.9f},
    {"critical damping", 1.0f, 1.0f},       {"about critical damping", 0.999f, 1.001f},
    {"over critical damping", 1.5f, 10.0f}, {"all mixed", 0.0f, 2.0f}};

void springs_table(Gains& gains) {
    for (const std::size_t count : sizes)
        for (const bool pushed : {false, true})
            for (const Regime& regime : regimes) {
                Values values(count, regime.low, regime.high, pushed);
                const std::string name = std::string(regime.name) + (pushed ? ", force, velocity" : "");
                print_row(name, count, compete(values, count, &Values::one_by_one, &Values::at_once), gains);
            }
}

void interp_table(Gains& gains, Gains& exact) {
    for (const std::size_t count : sizes) {
        Values values(count, 1.0f, 1.0f, false);
        print_row("interp_to", count,
                  compete(values, count, &Values::interp_one_by_one, &Values::interp_at_once), gains);
        print_row("interp_to_exact", count,
                  compete(values, count, &Values::exact_one_by_one, &Values::exact_at_once), exact);
    }
}

}  // namespace

int main(int count, char** arguments) {
    const auto units = tendril::ik::vector_units();
    std::printf("ns per value and step, medians of %d\n%-44s%8s%9s", repetitions, "", "values", "plain");
    for (const std::string_view unit : units) std::printf("%16s", std::string(unit).c_str());
    std::printf("\n");
    Gains springs, interp, exact;
    springs_table(springs);
    interp_table(interp, exact);
    bool all = true;
    for (std::size_t i = 0; i < units.size(); ++i) {
        const bool wide = units[i] == "AVX3";
        if (!wide && units[i] != "AVX2") continue;
        const auto claims = [&](const char* what, const Gains& gains, double least) {
            const std::string text = std::string(units[i]) + " over a plain loop: " + what;
            return claim(text.c_str(), *std::min_element(gains[i].begin(), gains[i].end()), least);
        };
        all &= claims("springs", springs, wide ? 7.0 : 4.5);
        all &= claims("interp_to", interp, 8.0);
        all &= claims("interp_to_exact", exact, wide ? 12.0 : 8.0);
    }
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
