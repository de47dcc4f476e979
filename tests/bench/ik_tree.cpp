// Trees of chains: what an iteration costs per joint beside that of a single chain's solver, and beside the
// two pulls alone. The tolerance is 0, so that the Newton step is never left out. Times are medians; only
// their ratios within one run mean anything.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "../core/kept_solver.hpp"
#include "tendril/ik/tree.hpp"

namespace {

using tendril::ik::Effector;
using tendril::ik::Tree;
using tendril::ik::TreeJoint;

constexpr int iterations = 20;
using Places = std::vector<glm::vec3>;

void count(benchmark::State& state, std::size_t joints) {
    using benchmark::Counter;
    state.counters["per_joint_and_iteration"] = Counter(
        static_cast<double>(joints) * iterations, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

/// A gentle bow, so that nothing is straight and nothing coincides.
Places bow(const std::vector<TreeJoint>& joints) {
    Places places(joints.size(), glm::vec3(0.0f));
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const float angle = 0.7f * static_cast<float>(k);
        const glm::vec3 way(std::cos(angle), std::sin(angle), 0.3f);
        places[k] = places[joints[k].parent] + way * (joints[k].length / std::sqrt(1.09f));
    }
    return places;
}

glm::vec3 target(std::size_t turn) {
    const float angle = 0.1f * static_cast<float>(turn % 64);
    return {0.6f * std::cos(angle), 0.6f * std::sin(angle), 0.2f};
}

std::vector<TreeJoint> chain(std::size_t bones) {
    std::vector<TreeJoint> joints{{}};
    for (std::size_t k = 0; k < bones; ++k) joints.push_back({k, 1.0f / static_cast<float>(bones)});
    return joints;
}

void chain_solver(benchmark::State& state, tendril::ik::Method method) {
    const auto bones = static_cast<std::size_t>(state.range(0));
    tendril::test::KeptSolver solver(std::vector<float>(bones, 1.0f / static_cast<float>(bones)));
    Places places = bow(chain(bones));
    std::size_t turn = 0;
    for (auto _ : state) {
        solver.solve(method, places, target(turn++), {.max_iterations = iterations, .every_iteration = true});
        benchmark::DoNotOptimize(places.data());
    }
    count(state, bones);
}

void run_tree(benchmark::State& state, const std::vector<TreeJoint>& joints, std::vector<Effector> effectors,
              bool plain) {
    Tree tree = Tree::make(joints).value();
    Places places = bow(joints);
    const Places goals = places;
    std::size_t turn = 0;
    for (auto _ : state) {
        const glm::vec3 by = target(turn++);
        for (Effector& effector : effectors) effector.target = goals[effector.joint] * 0.7f + by * 0.1f;
        tree.solve(
            places, effectors,
            {.tolerance = 0.0f, .max_iterations = iterations, .every_iteration = true, .plain = plain});
        benchmark::DoNotOptimize(places.data());
    }
    count(state, joints.size() - 1);
}

void chain_as_tree(benchmark::State& state, bool plain) {
    const auto bones = static_cast<std::size_t>(state.range(0));
    run_tree(state, chain(bones), {{bones}}, plain);
}

/// As many effectors as given, on the tips of branches that share a trunk; 121 joints whatever their number.
void branches(benchmark::State& state) {
    const auto tips = static_cast<std::size_t>(state.range(0));
    std::vector<TreeJoint> joints = chain(20);
    std::vector<Effector> effectors;
    for (std::size_t tip = 0; tip < tips; ++tip) {
        std::size_t parent = 20;
        for (std::size_t k = 0; k < 100 / tips; ++k) {
            joints.push_back({parent, 0.05f});
            parent = joints.size() - 1;
        }
        effectors.push_back({parent});
    }
    run_tree(state, joints, effectors, false);
}

BENCHMARK_CAPTURE(chain_solver, fabrik_plain, tendril::ik::Method::FabrikPlain)->Arg(10)->Arg(100);
BENCHMARK_CAPTURE(chain_as_tree, plain, true)->Arg(10)->Arg(100);
BENCHMARK_CAPTURE(chain_solver, fabrik, tendril::ik::Method::Fabrik)->Arg(10)->Arg(100);
BENCHMARK_CAPTURE(chain_as_tree, with_newton, false)->Arg(10)->Arg(100);
BENCHMARK(branches)->Arg(1)->Arg(2)->Arg(10)->Arg(50);

}  // namespace
