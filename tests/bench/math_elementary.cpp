// The library's own elementary functions against the system's. Claim: they take at most 1.3 times as long for
// the angles that solvers use.
#include "tendril/elementary.hpp"

#include <cmath>
#include <random>

#include "measure.hpp"

namespace {

using namespace tendril;

constexpr std::size_t count = 4096;
constexpr int repetitions = 201;

template <class T, class Ours, class Theirs>
bool compare(const char* what, T low, T high, const Ours& ours, const Theirs& theirs) {
    std::mt19937 random(1);
    std::uniform_real_distribution<T> draw(low, high);
    std::vector<T> x(count), y(count), result(count);
    for (std::size_t i = 0; i < count; ++i) x[i] = draw(random), y[i] = draw(random);
    const auto run = [&](const auto& function) {
        return [&] {
            for (std::size_t i = 0; i < count; ++i) result[i] = function(x[i], y[i]);
            benchmark::DoNotOptimize(result.data());
            benchmark::ClobberMemory();
        };
    };
    const auto seconds = bench::race({run(theirs), run(ours)}, repetitions);
    std::printf("%-24s%8.2f ns%8.2f ns\n", what, 1e9 / count * seconds[0], 1e9 / count * seconds[1]);
    return bench::claim_at_most(what, seconds[1] / seconds[0], 1.3);
}

}  // namespace

int main(int arguments, char** values) {
    std::printf("a call, medians of %d: the system's, the library's\n", repetitions);
    bool all = true;
    all &= compare(
        "sine", -6.0, 6.0, [](double x, double) { return math::sine(x); },
        [](double x, double) { return std::sin(x); });
    all &= compare(
        "cosine", -6.0, 6.0, [](double x, double) { return math::cosine(x); },
        [](double x, double) { return std::cos(x); });
    all &= compare(
        "sine of a float", -6.0f, 6.0f, [](float x, float) { return math::sine(x); },
        [](float x, float) { return std::sin(x); });
    all &= compare(
        "cosine of a float", -6.0f, 6.0f, [](float x, float) { return math::cosine(x); },
        [](float x, float) { return std::cos(x); });
    all &= compare(
        "arctangent", -1.0, 1.0, [](double x, double y) { return math::arctangent(x, y); },
        [](double x, double y) { return std::atan2(x, y); });
    all &= compare(
        "arctangent of floats", -1.0f, 1.0f, [](float x, float y) { return math::arctangent(x, y); },
        [](float x, float y) { return std::atan2(x, y); });
    all &= compare(
        "decay", 0.0, 4.0, [](double x, double) { return math::decay(x); },
        [](double x, double) { return std::exp(-x); });
    return all || !bench::has_flag(arguments, values, "--check") ? 0 : 1;
}
