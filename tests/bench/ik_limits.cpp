// Cost of joint limits: whole solves by the default method over sizes and kinds of joints, against the same
// without limits in the same run: limits far off, reached, and dragged along; and a target that the limits
// forbid.
#include <random>

#include "../core/kept_solver.hpp"
#include "measure.hpp"

namespace {

using namespace tendril::ik;
using tendril::test::KeptSolver;
namespace bench = tendril::bench;

constexpr float degree = 3.14159265f / 180.0f;
constexpr int repetitions = 9;

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

/// Tips of poses within the limits, from solves for arbitrary targets: reachable targets.
std::vector<glm::vec3> reachable(const Arm& arm, int count) {
    std::mt19937 random(1);
    const auto around = [&] { return static_cast<float>(random()) / 2147483648.0f - 1.0f; };
    std::vector<glm::vec3> targets;
    KeptSolver solver = arm.solver();
    const float reach = solver.reach();
    for (int i = 0; i < count; ++i) {
        Joints joints = arm.at_rest();
        solver.state.reset();
        Options options{.max_iterations = 20, .limits = arm.limits};
        solver.solve(Method::Ccd, joints, glm::vec3(around(), around(), around()) * reach, options);
        targets.push_back(joints.back());
    }
    return targets;
}

/// Hinges of changing axes, wide cones, all kinds in turn.
enum class Kind { Hinges, Cones, Mixed };
constexpr const char* kind_names[] = {"hinges", "cones", "all kinds"};
constexpr std::size_t sizes[] = {3, 5, 10, 30, 100};

Limit cone(float swing, float twist) {
    Limit limit = Limit::of(JointKind::BallAndSocket);
    limit.up = limit.left = swing * degree, limit.down = limit.right = 0.7f * swing * degree;
    limit.twist_min = -twist * degree, limit.twist_max = twist * degree;
    return limit;
}

Arm arm_of(std::size_t bones, Kind kind) {
    constexpr JointKind all[] = {JointKind::BallAndSocket, JointKind::Hinge,   JointKind::Saddle,
                                 JointKind::Pivot,         JointKind::Gliding, JointKind::Suture};
    Arm arm;
    for (std::size_t i = 0; i < bones; ++i)
        arm.limits.push_back(
            kind == Kind::Mixed ? Limit::of(all[i % 6])
            : kind == Kind::Cones
                ? cone(60, 40)
                : Limit::hinge(i % 2 ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0), -60 * degree, 100 * degree));
    return arm;
}

/// The same arm with limits that no solve comes near.
Arm unreached(Arm arm) {
    for (Limit& limit : arm.limits) limit = cone(175, 175);
    return arm;
}

/// Nanoseconds per bone and iteration, and microseconds per solve.
struct Cost {
    double iteration = 0.0, solve = 0.0;
};

/// A solver, its chain after the last solve, and the cost of a lap.
struct Lap {
    KeptSolver solver;
    Joints joints;
    int iterations = 0;

    /// Solves for all targets in turn: each from rest, or from the pose after the last solve.
    void run(const Arm& arm, const std::vector<glm::vec3>& targets, const Options& options, bool dragged) {
        iterations = 0;
        for (const glm::vec3 target : targets) {
            if (!dragged) joints = arm.at_rest(), solver.state.reset();
            iterations += solver.solve(Method::Fabrik, joints, target, options).iterations;
        }
    }
};

/// With limits and without.
std::array<Cost, 2> costs(const Arm& arm, const std::vector<glm::vec3>& targets, bool dragged) {
    std::array laps{Lap{arm.solver(), arm.at_rest()}, Lap{arm.solver(), arm.at_rest()}};
    const Options options[] = {{.max_iterations = 200, .limits = arm.limits}, {.max_iterations = 200}};
    const int count = std::max(1, 200 / static_cast<int>(arm.limits.size()));
    const auto run = [&](std::size_t i) {
        for (int lap = 0; lap < count; ++lap) laps[i].run(arm, targets, options[i], dragged);
    };
    run(0), run(1);  // a drag begins where the last lap ended
    const auto seconds = bench::race({[&] { run(0); }, [&] { run(1); }}, repetitions);
    std::array<Cost, 2> result;
    for (std::size_t i = 0; i < 2; ++i) {
        const double total = seconds[i] / count, bones = static_cast<double>(arm.limits.size());
        result[i] = {1e9 * total / (bones * std::max(laps[i].iterations, 1)),
                     1e6 * total / static_cast<double>(targets.size())};
    }
    return result;
}

/// Through poses within the limits, in small steps, there and back: joint by joint part of the way from one
/// to another.
std::vector<glm::vec3> path(const Arm& arm) {
    const std::vector<glm::vec3> ends = reachable(arm, 2);
    KeptSolver solver = arm.solver();
    Joints start = arm.at_rest();
    solver.solve(Method::Fabrik, start, ends[0], {.limits = arm.limits});
    const State state = solver.state;
    std::vector<glm::vec3> targets;
    for (int i = 0; i <= 40; ++i) {
        Joints joints = start;
        solver.state = state;
        solver.solve(Method::Fabrik, joints, ends[1],
                     {.limits = arm.limits, .weight = static_cast<float>(i) / 200.0f});
        targets.push_back(joints.back());
    }
    for (std::size_t i = targets.size(); i-- > 0;) targets.push_back(glm::vec3(targets[i]));
    return targets;
}

/// The worst ratios to the same without limits: of an iteration, in solves from rest; of a frame, while the
/// chain is dragged. Half of the mixed joints have no freedom about some axis, so they are at a bound in
/// every pose.
struct Ratios {
    double far = 0.0, met = 0.0, mixed = 0.0;  ///< an iteration: limits not reached, met, mixed
    double dragged = 0.0;                      ///< a frame: limits met, including mixed
};

Ratios met_limits_table() {
    Ratios worst;
    std::printf("\nLimits that end well, ns a bone and iteration and us a solve, and times that without\n");
    std::printf("%-10s %-8s %6s %9s %6s %9s %6s\n", "joints", "limits", "bones", "ns", "ratio", "us",
                "ratio");
    for (const Kind kind : {Kind::Hinges, Kind::Cones, Kind::Mixed})
        for (const std::size_t bones : sizes) {
            const Arm arm = arm_of(bones, kind);
            const std::vector<glm::vec3> targets = reachable(arm, 40);
            for (const char* state : {"far", "met", "dragged"}) {
                const bool far = state[0] == 'f', dragged = state[0] == 'd';
                if (far && kind != Kind::Cones) continue;
                const auto [with, without] =
                    costs(far ? unreached(arm) : arm, dragged ? path(arm) : targets, dragged);
                const double ratio = with.iteration / without.iteration;
                std::printf("%-10s %-8s %6zu %9.1f %6.1f %9.2f %6.1f\n",
                            kind_names[static_cast<std::size_t>(kind)], state, bones, with.iteration, ratio,
                            with.solve, with.solve / without.solve);
                double& most = far                   ? worst.far
                               : dragged             ? worst.dragged
                               : kind == Kind::Mixed ? worst.mixed
                                                     : worst.met;
                most = std::max(most, dragged ? with.solve / without.solve : ratio);
            }
        }
    return worst;
}

/// A target that the limits keep the tip away from by a tenth of the reach or more.
std::optional<glm::vec3> forbidden_target(const Arm& arm) {
    std::mt19937 random(2);
    const auto around = [&] { return static_cast<float>(random()) / 2147483648.0f - 1.0f; };
    KeptSolver solver = arm.solver();
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 target = glm::vec3(around(), around(), around()) * (0.9f * solver.reach());
        Joints joints = arm.at_rest();
        solver.state.reset();
        const Report report = solver.solve(Method::Fabrik, joints, target, {.limits = arm.limits});
        if (report.status == Status::Limited && report.residual > 0.1f * solver.reach()) return target;
    }
    return std::nullopt;
}

struct Worst {
    double us = 0.0, us_of_100 = 0.0;  ///< up to 30 bones; 100
    double residual = 0.0;             ///< excess over a search in every frame, relative to the reach
    double gain = 1e9;                 ///< over a search in every frame
};

/// A forbidden target that moves by 2 mm per frame.
Worst forbidden_table() {
    Worst worst;
    std::printf(
        "\nA forbidden target dragged by 2 mm a frame, us a frame: as it is, and with 8 restarts in each\n");
    std::printf("%-10s %6s %9s %9s %8s %11s\n", "joints", "bones", "us", "searching", "times", "residual");
    for (const Kind kind : {Kind::Hinges, Kind::Cones, Kind::Mixed})
        for (const std::size_t bones : sizes) {
            const Arm arm = arm_of(bones, kind);
            const std::optional<glm::vec3> start = forbidden_target(arm);
            if (!start) continue;
            std::vector<glm::vec3> targets;
            for (int i = 0; i < 50; ++i)
                targets.push_back(*start + glm::vec3(0, 0.002f, 0.001f) * static_cast<float>(i));
            const Options follows{.limits = arm.limits}, searches{.limits = arm.limits, .restarts = 8};
            KeptSolver solvers[] = {arm.solver(), arm.solver()};
            Joints joints[] = {arm.at_rest(), arm.at_rest()};
            float residuals[2] = {};
            const auto frames = [&](std::size_t i, const Options& options) {
                for (const glm::vec3 target : targets)
                    residuals[i] = solvers[i].solve(Method::Fabrik, joints[i], target, options).residual;
                for (std::size_t k = targets.size(); k-- > 0;)
                    solvers[i].solve(Method::Fabrik, joints[i], targets[k], options);
            };
            frames(0, follows);
            const auto seconds =
                bench::race({[&] { frames(0, follows); }, [&] { frames(1, searches); }}, repetitions);
            const double frame = 1e6 / (2.0 * static_cast<double>(targets.size()));
            const double us = seconds[0] * frame, gain = seconds[1] / seconds[0];
            std::printf("%-10s %6zu %9.2f %9.2f %8.1f %5.3f %5.3f\n",
                        kind_names[static_cast<std::size_t>(kind)], bones, us, seconds[1] * frame, gain,
                        static_cast<double>(residuals[0]) / static_cast<double>(bones),
                        static_cast<double>(residuals[1]) / static_cast<double>(bones));
            double& most = bones <= 30 ? worst.us : worst.us_of_100;
            most = std::max(most, us);
            worst.residual = std::max(
                worst.residual, static_cast<double>((residuals[0] - residuals[1]) / solvers[0].reach()));
            worst.gain = std::min(worst.gain, gain);
        }
    return worst;
}

}  // namespace

int main(int count, char** arguments) {
    const Ratios met = met_limits_table();
    const Worst forbidden = forbidden_table();
    std::printf("\n");
    bool holds =
        bench::claim("4 times an iteration without limits, over one with limits far off", 4 / met.far, 1);
    holds &= bench::claim("the same where hinges and cones meet them", 4 / met.met, 1);
    holds &= bench::claim("5 times that, over one with joints of all kinds", 5 / met.mixed, 1);
    holds &= bench::claim("4 times a frame without limits, over one that meets them", 4 / met.dragged, 1);
    holds &=
        bench::claim_loops("a frame of dragging a forbidden target, to 30 bones", 1e-6 * forbidden.us, 4);
    holds &= bench::claim_loops("the same with 100 bones", 1e-6 * forbidden.us_of_100, 16);
    holds &= bench::claim("0.01 of the reach, over what its residual is worse by than a search's",
                          0.01 / std::max(forbidden.residual, 1e-9), 1);
    holds &= bench::claim("a search in every such frame, over going on", forbidden.gain, 4);
    return bench::has_flag(count, arguments, "--check") && !holds ? 1 : 0;
}
