// Cost of the four modes per segment, from ten segments to a million, against a plain loop for each pull.
//
// Claims: Forward, Backward and WithIndex take at most 1.3 times as long as their plain loop at every size,
// and their cost grows with an exponent of at most 1.05 from a hundred segments on. Google Benchmark's
// options work too.
#include <benchmark/benchmark.h>

#include <glm/geometric.hpp>

#include "measure.hpp"
#include "tendril/chain/chain.hpp"

namespace {

using tendril::Chain;
using namespace tendril::bench;

constexpr std::size_t sizes[] = {10, 100, 1'000, 10'000, 100'000, 1'000'000};
constexpr const char* modes[] = {"forward", "backward", "with_index", "fixed"};
constexpr int repetitions = 7;
constexpr double max_ratio = 1.3;
constexpr double max_exponent = 1.05;

/// Two alternating targets, so that every pull has work to do.
glm::vec3 target(std::size_t turn) {
    return turn % 2 == 0 ? glm::vec3(3, 7, -2) : glm::vec3(-5, 1, 4);
}

float length_of(std::size_t i) {
    return 0.5f + 0.25f * static_cast<float>(i % 3);
}

Chain make_chain(std::size_t count) {
    Chain chain;
    for (std::size_t i = 0; i < count; ++i) require(chain.add(length_of(i)));
    return chain;
}

/// A good hand-written version: two arrays, one loop, one division; no checks, no degenerate cases.
struct Plain {
    std::vector<glm::vec3> positions;
    std::vector<float> lengths;

    void to_tail(std::size_t pinned, glm::vec3 to) {
        positions[pinned] = to;
        for (std::size_t i = pinned + 1; i < positions.size(); ++i) {
            const glm::vec3 along = positions[i] - to;
            to += along * (lengths[i] / glm::length(along));
            positions[i] = to;
        }
    }
    void to_head(std::size_t pinned, glm::vec3 to) {
        positions[pinned] = to;
        for (std::size_t i = pinned; i-- > 0;) {
            const glm::vec3 along = positions[i] - to;
            to += along * (lengths[i + 1] / glm::length(along));
            positions[i] = to;
        }
    }
};

void pull_plain(Plain& plain, const std::string& mode, glm::vec3 to) {
    const std::size_t tail = plain.positions.size() - 1, middle = plain.positions.size() / 2;
    if (mode == "forward") plain.to_tail(0, to);
    if (mode == "backward") plain.to_head(tail, to);
    if (mode == "with_index") plain.to_tail(middle, to), plain.to_head(middle, to);
    if (mode == "fixed") {
        const glm::vec3 kept = plain.positions[tail];
        plain.to_tail(0, to);
        plain.to_head(tail, kept);
    }
}

void pull_chain(Chain& chain, const std::string& mode, glm::vec3 to) {
    if (mode == "forward") require(chain.forward(to));
    if (mode == "backward") require(chain.backward(to));
    if (mode == "with_index") require(chain.with_index(chain.size() / 2, to));
    if (mode == "fixed") require(chain.fixed(to).accepted);
}

void count_segments(benchmark::State& state, std::size_t count) {
    using benchmark::Counter;
    state.counters["per_segment"] =
        Counter(static_cast<double>(count), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void run_plain(benchmark::State& state, const std::string& mode, std::size_t count) {
    Plain plain;
    const Chain chain = make_chain(count);
    for (const tendril::Segment& segment : chain.segments()) {
        plain.positions.push_back(segment.position);
        plain.lengths.push_back(segment.length);
    }
    std::size_t turn = 0;
    for (auto _ : state) {
        pull_plain(plain, mode, target(turn++));
        benchmark::DoNotOptimize(plain.positions.data());
        benchmark::ClobberMemory();
    }
    count_segments(state, count);
}

void run_chain(benchmark::State& state, const std::string& mode, std::size_t count) {
    Chain chain = make_chain(count);
    std::size_t turn = 0;
    for (auto _ : state) {
        pull_chain(chain, mode, target(turn++));
        benchmark::DoNotOptimize(chain.segments().data());
        benchmark::ClobberMemory();
    }
    count_segments(state, count);
}

std::string name_of(const std::string& mode, std::size_t count) {
    return mode + "/" + std::to_string(count);
}
std::string plain_name_of(const std::string& mode, std::size_t count) {
    return "plain_" + name_of(mode, count);
}

struct Result {
    std::vector<double> seconds, ratios;  // one per size
    double worst_ratio = 0.0;
    double exponent = 0.0;  // the slope of log(time) over log(size) from 100 segments on: 1 is linear
};

/// Empty if a filter omitted one of the sizes.
Result result_of(const std::string& mode, const std::map<std::string, double>& seconds) {
    Result result;
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const std::size_t count : sizes) {
        const auto here = seconds.find(name_of(mode, count)),
                   plain = seconds.find(plain_name_of(mode, count));
        if (here == seconds.end() || plain == seconds.end()) return {};
        result.seconds.push_back(here->second);
        result.ratios.push_back(here->second / plain->second);
        if (count < 100)
            continue;  // a processor overlaps pulls this short, so they cost less than their share
        const double x = std::log(static_cast<double>(count)), y = std::log(here->second);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    result.worst_ratio = *std::max_element(result.ratios.begin(), result.ratios.end());
    result.exponent = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return result;
}

/// Prints the table and the claims; false unless all of them hold.
bool report(const std::map<std::string, double>& seconds) {
    std::printf("\nns per segment (and times the same pull as a plain loop), medians of %d\n%-11s",
                repetitions, "");
    for (const std::size_t count : sizes) std::printf("%16zu", count);
    std::printf("\n");
    std::map<std::string, Result> results;
    for (const char* mode : modes) {
        const Result& result = results[mode] = result_of(mode, seconds);
        if (result.seconds.empty()) return std::printf("%-11s left out\n", mode), false;
        std::printf("%-11s", mode);
        for (std::size_t i = 0; i < std::size(sizes); ++i) {
            const double each = result.seconds[i] * 1e9 / static_cast<double>(sizes[i]);
            std::printf("%8.2f (%4.2fx)", each, result.ratios[i]);
        }
        std::printf("  n^%.3f\n", result.exponent);
    }
    std::printf("\n");
    bool all = true;
    for (const char* mode : {"forward", "backward", "with_index"}) {
        const std::string name = mode;
        all &= claim_at_most((name + ": worst ratio to a plain loop").c_str(), results[name].worst_ratio,
                             max_ratio);
        all &= claim_at_most((name + ": exponent of growth").c_str(), results[name].exponent, max_exponent);
    }
    return all;
}

}  // namespace

int main(int count, char** arguments) {
    const bool check = take_flag(count, arguments, "--check");
    benchmark::Initialize(&count, arguments);
    if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
    for (const std::size_t size : sizes)
        for (const std::string mode : modes)
            for (auto* each :
                 {benchmark::RegisterBenchmark(plain_name_of(mode, size).c_str(), run_plain, mode, size),
                  benchmark::RegisterBenchmark(name_of(mode, size).c_str(), run_chain, mode, size)})
                each->Repetitions(repetitions)->ReportAggregatesOnly()->MinTime(0.05);
    Medians medians;
    benchmark::RunSpecifiedBenchmarks(&medians);
    return report(medians.seconds) || !check ? 0 : 1;
}
