// Shared by benchmarks with a main of their own: interleaved timing, and claims.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <vector>

#include "tendril/result.hpp"

namespace tendril::bench {

/// Refused calls would measure nothing.
inline void require(const Result& result) {
    if (result) return;
    std::fprintf(stderr, "%s\n", result.message());
    std::abort();
}

/// Of this process with all its threads, independent of other processes.
inline double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}
inline double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Runs all of them in turn `repetitions` times, so that disturbances affect all alike; `prepare` runs before
/// each and is not timed. Returns the median seconds of each.
inline std::vector<double> race(
    const std::vector<std::function<void()>>& runs, int repetitions, double (*now)() = cpu_seconds,
    const std::function<void()>& prepare = [] {}) {
    std::vector<std::vector<double>> times(runs.size());
    for (int i = 0; i < repetitions; ++i) {
        for (std::size_t j = 0; j < runs.size(); ++j) {
            prepare();
            const double start = now();
            runs[j]();
            times[j].push_back(now() - start);
        }
    }
    std::vector<double> medians;
    for (std::vector<double>& each : times) medians.push_back(median(std::move(each)));
    return medians;
}

inline bool claim(const char* what, double value, double least) {
    const bool holds = value >= least;
    std::printf("%s  %-60s %.2f, at least %.2f\n", holds ? "PASS" : "FAIL", what, value, least);
    return holds;
}

/// Whether the flag is present; removes it for the parser of the other arguments.
inline bool take_flag(int& count, char** arguments, const char* flag) {
    char** const end = arguments + count;
    char** const kept = std::remove_if(
        arguments + 1, end, [&](const char* argument) { return std::strcmp(argument, flag) == 0; });
    count = static_cast<int>(kept - arguments);
    return kept != end;
}

inline bool has_flag(int count, char** arguments, const char* flag) {
    return std::any_of(arguments + 1, arguments + count,
                       [&](const char* argument) { return std::strcmp(argument, flag) == 0; });
}

}  // namespace tendril::bench
