// Shared by benchmarks with a main of their own: interleaved timing, and claims. Each prints its tables and a
// line per claim; with --check it exits with 1 if a claim does not hold.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>
#include <source_location>
#include <string>
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

/// Appends a figure to the file that TENDRIL_BENCH_FIGURES names, for tests/bench/compare.
inline void record(const std::string& name, double seconds) {
    const char* const path = std::getenv("TENDRIL_BENCH_FIGURES");
    std::FILE* const file = path ? std::fopen(path, "a") : nullptr;
    if (!file) return;
    std::fprintf(file, "%s\t%.9g\n", name.c_str(), seconds);
    std::fclose(file);
}
/// Named by the place that measured them and their numbers there.
inline void record(const std::vector<double>& seconds, const std::source_location& where) {
    const std::string path = where.file_name();
    for (std::size_t i = 0; i < seconds.size(); ++i)
        record(
            path.substr(path.rfind('/') + 1) + ":" + std::to_string(where.line()) + " #" + std::to_string(i),
            seconds[i]);
}

/// Runs all of them in turn `repetitions` times, so that disturbances affect all alike; `prepare` runs before
/// each and is not timed. Returns the median seconds of each, and records them.
inline std::vector<double> race(
    const std::vector<std::function<void()>>& runs, int repetitions, double (*now)() = cpu_seconds,
    const std::function<void()>& prepare = [] {},
    const std::source_location& where = std::source_location::current()) {
    std::vector<std::vector<double>> times(runs.size());
    for (int i = 0; i < repetitions; ++i)
        for (std::size_t j = 0; j < runs.size(); ++j) {
            prepare();
            const double start = now();
            runs[j]();
            times[j].push_back(now() - start);
        }
    std::vector<double> medians;
    for (std::vector<double>& each : times) medians.push_back(median(std::move(each)));
    record(medians, where);
    return medians;
}

inline bool claim(const char* what, double value, double least) {
    const bool holds = value >= least;
    std::printf("%s  %-60s %.2f, at least %.2f\n", holds ? "PASS" : "FAIL", what, value, least);
    return holds;
}
inline bool claim_at_most(const char* what, double value, double most) {
    const bool holds = value <= most;
    std::printf("%s  %-60s %.3f, at most %.2f\n", holds ? "PASS" : "FAIL", what, value, most);
    return holds;
}

/// A reporter that keeps the seconds of a call by name, from the medians of the repetitions.
class Medians : public benchmark::ConsoleReporter {
  public:
    Medians() : ConsoleReporter(OO_Tabular) {}
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& each : runs) {
            if (each.run_type != Run::RT_Aggregate || each.aggregate_name != "median") continue;
            seconds[each.run_name.function_name] = each.GetAdjustedCPUTime() * 1e-9;
            record(each.run_name.function_name, each.GetAdjustedCPUTime() * 1e-9);
        }
    }
    std::map<std::string, double> seconds;
};

/// Seconds of one loop, the unit in which time is claimed: 100 bones are set to their length, one after the
/// other, which waits for a square root and a division each as the solvers do. 1.2 us on the machine of the
/// claims.
inline double loop_seconds() {
    std::vector<double> x(101), y(101);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i), y[i] = i % 2 ? 0.3 : -0.3;
    constexpr int loops = 2000;
    return race({[&] {
                    for (int round = 0; round < loops; ++round) {
                        for (std::size_t i = 1; i < x.size(); ++i) {
                            const double dx = x[i] - x[i - 1], dy = y[i] - y[i - 1];
                            const double scale = 1.0 / std::sqrt(dx * dx + dy * dy);
                            x[i] = x[i - 1] + dx * scale, y[i] = y[i - 1] + dy * scale;
                        }
                        x[0] = round % 2 ? 0.5 : -0.5;
                        benchmark::DoNotOptimize(x.data());
                        benchmark::ClobberMemory();
                    }
                }},
                31)[0] /
           loops;
}

/// A claim of time that holds on slower machines too: at most that many loops.
inline bool claim_loops(const char* what, double seconds, double most) {
    return claim_at_most((std::string(what) + ", in loops").c_str(), seconds / loop_seconds(), most);
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
