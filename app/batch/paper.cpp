#include "app/batch/paper.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <tendril/ik/solver.hpp>

#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t joint_count = paper_bones + 1;
constexpr std::size_t rounds = 3;
constexpr std::size_t block = 50;  // solves per clock reading, since reading takes time too

/// 0 to 1. The standard library's distributions differ between implementations, its generator does not.
float uniform(std::mt19937& random) {
    return static_cast<float>(random() >> 8) / static_cast<float>(1u << 24);
}

glm::vec3 direction(std::mt19937& random) {
    const float z = 2.0f * uniform(random) - 1.0f;
    const float angle = 2.0f * std::numbers::pi_v<float> * uniform(random);
    const float side = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return {side * math::cosine(angle), side * math::sine(angle), z};
}

PaperTargets make_targets(const char* name, ik::Status solved, float nearest, float farthest) {
    PaperTargets made{name, solved, {}, {}};
    std::mt19937 random(2011);
    const float reach = paper_bone_length * static_cast<float>(paper_bones);
    for (std::size_t i = 0; i < paper_count; ++i) {
        const float far = reach * (nearest + (farthest - nearest) * uniform(random));
        made.targets.push_back(direction(random) * far);
        glm::vec3 joint(0.0f);
        made.starts.push_back(joint);
        for (std::size_t bone = 0; bone < paper_bones; ++bone)
            made.starts.push_back(joint += direction(random) * paper_bone_length);
    }
    return made;
}

double median(std::vector<int> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Solves targets `from` to `to` from the poses in `joints`; returns nanoseconds.
double solve_block(const PaperTargets& targets, const PaperSolve& solve, std::size_t from, std::size_t to,
                   std::vector<glm::vec3>& joints, std::vector<ik::Report>& reports) {
    const auto begin = Clock::now();
    for (std::size_t i = from; i < to; ++i)
        reports[i] = solve(std::span(joints).subspan(i * joint_count, joint_count), targets.targets[i]);
    return std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
}

}  // namespace

PaperTargets reachable_targets() {
    return make_targets("reachable", ik::Status::Converged, 0.05f, 0.95f);
}

PaperTargets unreachable_targets() {
    return make_targets("unreachable", ik::Status::Stretched, 1.05f, 2.0f);
}

PaperSolve paper_solver(ik::Method method) {
    const std::vector<float> lengths(paper_bones, paper_bone_length);
    ik::Options options;
    options.tolerance = paper_tolerance;
    options.max_iterations = paper_iterations;
    struct Kept {
        ik::Solver solver;
        ik::State state;
    };
    const auto kept =
        std::make_shared<Kept>(Kept{ik::Solver::make(lengths).value(), ik::State(lengths.size())});
    return [=](std::span<glm::vec3> joints, glm::vec3 target) {
        return kept->solver.solve(method, joints, kept->state, target, options);
    };
}

std::span<const ik::Method> paper_methods() {
    static constexpr std::array methods{ik::Method::Fabrik, ik::Method::FabrikPlain,
                                        ik::Method::Ccd,    ik::Method::JacobianTranspose,
                                        ik::Method::Dls,    ik::Method::SvdDls};
    return methods;
}

std::optional<PaperRow> measure(const PaperTargets& targets, const PaperSolve& solve,
                                const std::function<bool(double)>& progress) {
    const std::size_t count = targets.targets.size();
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<ik::Report> reports(count);
    // The fastest of several rounds: other programs can only slow a block down.
    std::vector<double> fastest(blocks, 1e300);
    for (std::size_t round = 0; round < rounds; ++round) {
        std::vector<glm::vec3> joints = targets.starts;
        for (std::size_t i = 0; i < blocks; ++i) {
            if (!progress(static_cast<double>(round * blocks + i) / static_cast<double>(rounds * blocks)))
                return std::nullopt;
            const std::size_t from = i * block, to = std::min(count, from + block);
            fastest[i] = std::min(fastest[i], solve_block(targets, solve, from, to, joints, reports));
        }
    }

    PaperRow row;
    std::vector<int> iterations;
    for (const ik::Report& report : reports) iterations.push_back(report.iterations);
    const double all = std::accumulate(iterations.begin(), iterations.end(), 0.0);
    const double time = std::accumulate(fastest.begin(), fastest.end(), 0.0);
    const auto solved = std::count_if(reports.begin(), reports.end(),
                                      [&](const auto& report) { return report.status == targets.solved; });
    const auto solves = static_cast<double>(count);
    row.solved = static_cast<double>(solved) / solves;
    row.mean_iterations = all / solves;
    row.median_iterations = median(iterations);
    row.microseconds = time / solves / 1000.0;
    if (all > 0.0) row.nanoseconds = time / all;
    return row;
}

}  // namespace tendril::app
