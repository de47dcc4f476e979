// What joint limits cost: an iteration with them against one without, for every method, in the same run; how
// often each method arrives from rest where some pose within the limits made the target; a solve and an
// explanation where they hold the tip back.
//
//     tendril_bench_ik_limits            the tables
//     tendril_bench_ik_limits --check    the same, and exit code 1 when a claim does not hold
#include <cmath>
#include <random>

#include "../core/kept_solver.hpp"
#include "measure.hpp"
#include "tendril/ik/solver.hpp"

namespace {

using namespace tendril::ik;
using tendril::test::KeptSolver;
namespace bench = tendril::bench;

constexpr float degree = 3.14159265f / 180.0f;
constexpr int repetitions = 9, forced = 20, solves = 200;

using Joints = std::vector<glm::vec3>;

/// Bones along +X at rest, 1 m each.
struct Arm {
    std::vector<Limit> limits;

    KeptSolver solver() const { return KeptSolver(std::vector<float>(limits.size(), 1.0f)); }
    Joints at_rest() const {
        Joints joints;
        for (std::size_t i = 0; i <= limits.size(); ++i)
            joints.emplace_back(static_cast<float>(i), 0.0f, 0.0f);
        return joints;
    }
};

/// All kinds in turn; or shoulder, elbow, wrist and fingers.
Arm arm_of(std::size_t bones, bool human) {
    constexpr JointKind all[] = {JointKind::BallAndSocket, JointKind::Hinge,   JointKind::Saddle,
                                 JointKind::Pivot,         JointKind::Gliding, JointKind::Suture};
    constexpr JointKind limb[] = {JointKind::BallAndSocket, JointKind::Hinge, JointKind::Gliding,
                                  JointKind::Hinge, JointKind::Hinge};
    Arm arm;
    for (std::size_t i = 0; i < bones; ++i) arm.limits.push_back(Limit::of(human ? limb[i % 5] : all[i % 6]));
    return arm;
}

// ---- An iteration

double microseconds_an_iteration(const Arm& arm, Method method, bool limited, double& ratio_of) {
    KeptSolver with = arm.solver(), without = arm.solver();
    const Joints rest = arm.at_rest();
    const auto bones = static_cast<float>(arm.limits.size());
    const glm::vec3 target = glm::vec3(0.5f, 0.3f, 0.2f) * bones;
    Options options;
    options.max_iterations = forced;
    options.every_iteration = true;
    options.tolerance = 0.0f;
    Options limits = options;
    limits.limits = arm.limits;
    const auto run = [&](KeptSolver& solver, const Options& what) {
        for (int i = 0; i < solves; ++i) {
            Joints joints = rest;
            solver.state.reset();
            solver.solve(method, joints, target, what);
        }
    };
    const auto seconds =
        bench::race({[&] { run(without, options); }, [&] { run(with, limits); }}, repetitions);
    ratio_of = seconds[1] / seconds[0];
    return 1e6 * seconds[limited ? 1 : 0] / (solves * forced);
}

void iterations_table() {
    std::printf("An iteration, %d forced, ball-jointed and with limits of all kinds\n", forced);
    std::printf("%-20s %6s %14s %9s\n", "method", "bones", "limited us", "ratio");
    for (const Method method : all_methods) {
        if (method == Method::TwoBone) continue;
        for (const std::size_t bones : {5u, 20u, 100u}) {
            double ratio = 0.0;
            const double limited = microseconds_an_iteration(arm_of(bones, false), method, true, ratio);
            std::printf("%-20s %6zu %14.2f %9.1f\n", name(method), bones, limited, ratio);
        }
    }
}

// ---- From rest

/// Where a solver that is told to reach anywhere ends is a pose within the limits: a target that can be
/// reached.
std::vector<glm::vec3> reachable(const Arm& arm, int count) {
    std::mt19937 random(1);
    const auto around = [&] { return static_cast<float>(random()) / 2147483648.0f - 1.0f; };
    std::vector<glm::vec3> targets;
    KeptSolver solver = arm.solver();
    const float reach = solver.reach();
    for (int i = 0; i < count; ++i) {
        Joints joints = arm.at_rest();
        solver.state.reset();
        Options options;
        options.limits = arm.limits;
        options.max_iterations = 20;
        solver.solve(Method::Ccd, joints, glm::vec3(around(), around(), around()) * reach, options);
        targets.push_back(joints.back());
    }
    return targets;
}

/// The smaller share of the default method, percent.
double arrivals_table() {
    double least = 100.0;
    std::printf(
        "\nFrom rest to where some pose within the limits is, to 0.01 of the reach, 200 iterations\n");
    std::printf("%-20s %-10s %9s %11s %9s\n", "method", "arm", "arrive %", "iterations", "us");
    for (const bool human : {false, true}) {
        const Arm arm = arm_of(5, human);
        const std::vector<glm::vec3> targets = reachable(arm, 1000);
        for (const Method method : all_methods) {
            if (method == Method::TwoBone) continue;
            KeptSolver solver = arm.solver();
            Options options;
            options.limits = arm.limits;
            options.max_iterations = 200;
            int there = 0;
            double iterations = 0.0;
            const double start = bench::cpu_seconds();
            for (const glm::vec3 target : targets) {
                Joints joints = arm.at_rest();
                solver.state.reset();
                const Report report = solver.solve(method, joints, target, options);
                there += report.residual <= 0.01f * solver.reach();
                iterations += report.iterations;
            }
            const double us = 1e6 * (bench::cpu_seconds() - start),
                         count = static_cast<double>(targets.size());
            std::printf("%-20s %-10s %9.1f %11.1f %9.1f\n", name(method), human ? "human" : "all kinds",
                        100.0 * there / count, iterations / count, us / count);
            if (method == Method::Fabrik) least = std::min(least, 100.0 * there / count);
        }
    }
    return least;
}

// ---- Held back

void held_table() {
    Arm arm = arm_of(5, true);
    arm.limits[1] = Limit::hinge({0, 0, 1}, 0, 145 * degree);
    KeptSolver solver = arm.solver();
    const glm::vec3 target{-4.5f, -0.5f, 1.0f};
    Options options;
    options.limits = arm.limits;
    Joints joints = arm.at_rest();
    const Report report = solver.solve(Method::Fabrik, joints, target, options);
    const auto seconds = bench::race({[&] { solver.solve(Method::Fabrik, joints, target, options); },
                                      [&] { solver.explain(joints, target, options); }},
                                     99);
    std::printf("\nHuman arm, target out of its limits (%s): solve %.0f us, explain %.0f us\n",
                name(report.status), 1e6 * seconds[0], 1e6 * seconds[1]);
}

}  // namespace

int main(int count, char** arguments) {
    iterations_table();
    const double least = arrivals_table();
    held_table();
    std::printf("\n");
    const bool holds = bench::claim("fabrik arrives from rest, percent of what can be reached", least, 95.0);
    return bench::has_flag(count, arguments, "--check") && !holds ? 1 : 0;
}
