// Cost of FABRIK: FABRIK (2011) and accelerated, against the same passes as a bare loop.
//
// Claims: 20 forced iterations of 10 bones take at most 0.012 loops (measure.hpp) per bone and pass, at
// most 1.5 times a bare loop measured in the same run; the cost grows linearly; an accelerated iteration
// costs at most twice a plain one, and no more in a plane than in space.
// Google Benchmark's options work too.
#include <benchmark/benchmark.h>

#include "../core/kept_solver.hpp"
#include "measure.hpp"

namespace {

using namespace tendril::bench;
using tendril::ik::Method;
using tendril::ik::Options;
using Solver = tendril::test::KeptSolver;

constexpr std::size_t sizes[] = {4, 10, 100, 1'000, 10'000};
constexpr const char* kinds[] = {"bare", "fabrik_plain", "fabrik", "plane"};
constexpr int repetitions = 9;
constexpr int forced = 20;

/// Two alternating targets well inside, so that every iteration has work to do.
glm::vec3 target(std::size_t bones, std::size_t turn) {
    const float reach = static_cast<float>(bones);
    return turn % 2 == 0 ? glm::vec3(0.5f, 0.4f, -0.2f) * reach : glm::vec3(-0.3f, 0.1f, 0.5f) * reach;
}

std::vector<glm::vec3> bent(std::size_t bones) {
    std::vector<glm::vec3> joints{{0, 0, 0}};
    for (std::size_t i = 0; i < bones; ++i) {
        const float turn = 0.3f * std::sin(static_cast<float>(i));
        joints.push_back(joints.back() + glm::vec3(std::cos(turn), std::sin(turn), 0.0f));
    }
    return joints;
}

/// A hand-written version: the numbers in a row, two loops, no checks and no degenerate cases.
struct Bare {
    std::vector<float> xyz, lengths;

    void lay(std::size_t at, std::size_t joint, float length) {
        const float* p = &xyz[3 * at];
        float* q = &xyz[3 * joint];
        const float x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
        const float scale = length / std::sqrt(x * x + y * y + z * z);
        q[0] = p[0] + x * scale, q[1] = p[1] + y * scale, q[2] = p[2] + z * scale;
    }
    void put(std::size_t joint, const glm::vec3& at) {
        xyz[3 * joint] = at.x, xyz[3 * joint + 1] = at.y, xyz[3 * joint + 2] = at.z;
    }
    void iterate(const glm::vec3& to) {
        const std::size_t bones = lengths.size();
        const glm::vec3 root(xyz[0], xyz[1], xyz[2]);
        put(bones, to);
        for (std::size_t i = bones; i-- > 0;) lay(i + 1, i, lengths[i]);
        put(0, root);
        for (std::size_t i = 0; i < bones; ++i) lay(i, i + 1, lengths[i]);
    }
};

void count_passes(benchmark::State& state, std::size_t bones) {
    using benchmark::Counter;
    state.counters["bone_and_pass"] = Counter(static_cast<double>(bones) * 2.0 * forced,
                                              Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void run_bare(benchmark::State& state, std::size_t bones) {
    Bare bare;
    for (const glm::vec3& joint : bent(bones)) bare.xyz.insert(bare.xyz.end(), {joint.x, joint.y, joint.z});
    bare.lengths.assign(bones, 1.0f);
    std::size_t turn = 0;
    for (auto _ : state) {
        const glm::vec3 to = target(bones, turn++);
        for (int i = 0; i < forced; ++i) bare.iterate(to);
        benchmark::DoNotOptimize(bare.xyz.data());
        benchmark::ClobberMemory();
    }
    count_passes(state, bones);
}

/// With a tolerance of 0 the accelerated one takes its extra step in every iteration.
void run_solver(benchmark::State& state, Method method, std::size_t bones, bool planar = false) {
    std::vector<glm::vec3> joints = bent(bones);
    Solver solver(std::vector<float>(bones, 1.0f));
    Options options{.tolerance = 0.0f, .max_iterations = forced, .every_iteration = true};
    if (planar) options.plane.emplace();
    std::size_t turn = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(solver.solve(method, joints, target(bones, turn++), options));
        benchmark::ClobberMemory();
    }
    count_passes(state, bones);
}

std::string name_of(const std::string& kind, std::size_t bones) {
    return kind + "/" + std::to_string(bones);
}

/// The slope of log(time) over log(size), from 10 bones on: 1 is linear.
double exponent_of(const std::string& kind, const std::map<std::string, double>& seconds) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const std::size_t bones : sizes) {
        if (bones < 10) continue;
        const double x = std::log(static_cast<double>(bones)), y = std::log(seconds.at(name_of(kind, bones)));
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

bool report_cost(const std::map<std::string, double>& seconds) {
    if (seconds.size() != std::size(sizes) * std::size(kinds)) return std::printf("left out\n"), false;
    std::printf(
        "\nns per bone and pass, %d forced iterations (and times the bare loop), medians of %d\n%-14s",
        forced, repetitions, "bones");
    for (const std::size_t bones : sizes) std::printf("%16zu", bones);
    std::printf("\n");
    for (const std::string kind : kinds) {
        std::printf("%-14s", kind.c_str());
        for (const std::size_t bones : sizes) {
            const double each = seconds.at(name_of(kind, bones)), bare = seconds.at(name_of("bare", bones));
            std::printf("%8.2f (%4.2fx)", each * 1e9 / (2.0 * forced * static_cast<double>(bones)),
                        each / bare);
        }
        std::printf("  n^%.3f\n", exponent_of(kind, seconds));
    }
    const double plain = seconds.at("fabrik_plain/10");
    double most = 0.0, planar = 0.0;
    for (const std::size_t bones : sizes) {
        // With 4 bones, the 0.5 us that a solve in a plane costs besides its iterations are a third of it.
        if (bones >= 10)
            planar =
                std::max(planar, seconds.at(name_of("plane", bones)) / seconds.at(name_of("fabrik", bones)));
        most =
            std::max(most, seconds.at(name_of("fabrik", bones)) / seconds.at(name_of("fabrik_plain", bones)));
    }
    std::printf("\n");
    bool all = claim_loops("10 bones: 100 bones in a pass", plain * 100.0 / (2.0 * forced * 10.0), 1.2);
    all &= claim_at_most("10 bones: times the bare loop", plain / seconds.at("bare/10"), 1.5);
    all &= claim_at_most("plain: exponent of growth", exponent_of("fabrik_plain", seconds), 1.05);
    // Longer chains leave more rounding to the extra step.
    all &= claim_at_most("accelerated: exponent of growth", exponent_of("fabrik", seconds), 1.1);
    all &= claim_at_most("accelerated iteration, times a plain one, worst size", most, 2.0);
    // With what a solve costs besides (coordinates, sides): about 70 ns per bone. An iteration alone costs
    // the same to 2 %.
    all &= claim_at_most("20 iterations in a plane, times solid ones, worst size", planar, 1.25);
    return all;
}

void register_all() {
    for (const std::size_t bones : sizes)
        for (auto* each : {benchmark::RegisterBenchmark(name_of("bare", bones).c_str(), run_bare, bones),
                           benchmark::RegisterBenchmark(name_of("fabrik_plain", bones).c_str(), run_solver,
                                                        Method::FabrikPlain, bones, false),
                           benchmark::RegisterBenchmark(name_of("fabrik", bones).c_str(), run_solver,
                                                        Method::Fabrik, bones, false),
                           benchmark::RegisterBenchmark(name_of("plane", bones).c_str(), run_solver,
                                                        Method::Fabrik, bones, true)})
            each->Repetitions(repetitions)->ReportAggregatesOnly()->MinTime(0.02);
}

}  // namespace

int main(int count, char** arguments) {
    const bool check = take_flag(count, arguments, "--check");
    benchmark::Initialize(&count, arguments);
    if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
    register_all();
    Medians medians;
    benchmark::RunSpecifiedBenchmarks(&medians);
    return report_cost(medians.seconds) || !check ? 0 : 1;
}
