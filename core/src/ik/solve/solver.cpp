// Solver's entry points: checks input, then calls the solve in loop.cpp.
#include "tendril/ik/solver.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ik/limits/pose.hpp"
#include "ik/math.hpp"
#include "ik/solve/loop.hpp"
#include "ik/solve/parts.hpp"
#include "ik/solve/plane.hpp"
#include "ik/solve/validate.hpp"
#include "math/checks.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik {

using namespace detail;
using namespace tendril::detail;

namespace {

Result check_direction(std::size_t index, const glm::vec3& direction) noexcept {
    const Argument argument{"rest_directions", index};
    if (const Result bad = check_point("Solver", argument, direction); !bad) return bad;
    const float size = length(direction);
    if (std::abs(size - 1.0f) > 1e-3f) return refused("Solver", argument, "of length 1", size);
    return {};
}

Result check_bones(std::span<const float> lengths, std::span<const glm::vec3> rest_directions) noexcept {
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (const Result bad = check_length("Solver", {"lengths", i}, lengths[i]); !bad) return bad;
    }
    if (rest_directions.empty()) return {};
    if (const Result bad = check_count("Solver", "rest_directions", rest_directions.size(), lengths.size());
        !bad)
        return bad;
    for (std::size_t i = 0; i < rest_directions.size(); ++i) {
        if (const Result bad = check_direction(i, rest_directions[i]); !bad) return bad;
    }
    return {};
}

/// Sizes and fills the workspace for validated bones.
void fill(Workspace& scratch, std::span<const float> lengths, std::span<const glm::vec3> rest_directions) {
    double reach = 0.0;
    for (const float length : lengths) {
        reach += static_cast<double>(length);
        scratch.longest = std::max(scratch.longest, length);
    }
    scratch.reach = static_cast<float>(reach);
    scratch.resize(lengths.size());
    std::copy(lengths.begin(), lengths.end(), scratch.lengths.begin());
    for (std::size_t i = 0; i < rest_directions.size(); ++i) {
        scratch.rest_directions[i] = times(rest_directions[i], 1.0f / length(rest_directions[i]));
    }
}

/// Leaves the joint limits to load_limits(), which checks those that have changed.
Result check_all_but_limits(std::size_t bones, Method method, std::span<const glm::vec3> joints,
                            const State& state, const glm::vec3& target, const Options& options) noexcept {
    // With a tip orientation the last bone is placed separately.
    if (!takes(method, bones) && !(options.tip_orientation && takes(method, bones - 1)))
        return check_takes(method, bones);
    if (const Result bad = check_count("solve", "joints", joints.size(), bones + 1); !bad) return bad;
    for (std::size_t i = 0; i < joints.size(); ++i)
        if (!is_point(joints[i])) return refused_point("solve", {"joints", i}, joints[i]);
    if (const Result bad = check_point("solve", "target", target); !bad) return bad;
    if (const Result bad = check(options, bones); !bad) return bad;
    return is_valid(state, bones) ? Result() : ik::check(state, bones);
}

/// True if a solve could move a joint further out than a Chain accepts.
bool may_leave_range(const Chain& chain, float reach) noexcept {
    const glm::vec3& root = chain.segments()[0].position;
    return std::max({std::abs(root.x), std::abs(root.y), std::abs(root.z)}) + 2.0f * reach > max_magnitude;
}

}  // namespace

Solver::Solver(std::unique_ptr<Parts> parts) noexcept : parts_(std::move(parts)) {}

Expected<Solver> Solver::make(std::span<const float> lengths, std::span<const glm::vec3> rest_directions) {
    if (const Result bad = check_bones(lengths, rest_directions); !bad) return bad;
    auto parts = std::make_unique<Parts>();
    fill(parts->scratch, lengths, rest_directions);
    return Solver(std::move(parts));
}

Solver::Solver(const Chain& chain) : parts_(std::make_unique<Parts>()) {
    std::vector<float> lengths;
    for (std::size_t i = 1; i < chain.size(); ++i) lengths.push_back(chain.length(i));
    fill(parts_->scratch, lengths, std::vector<glm::vec3>(lengths.size(), chain.default_direction()));
}

Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

std::size_t Solver::bones() const noexcept {
    return parts_ ? parts_->scratch.lengths.size() : 0;
}

float Solver::reach() const noexcept {
    return parts_ ? parts_->scratch.reach : 0.0f;
}

Report Solver::solve(Method method, std::span<glm::vec3> joints, State& state, glm::vec3 target,
                     const Options& options, Observer* observer) noexcept {
    if (!parts_) return refusal<Report>(moved_from("solve", "solver"));
    if (const Result bad = check_all_but_limits(bones(), method, joints, state, target, options); !bad)
        return refusal<Report>(bad);
    if (options.plane && bones() > 0)
        return PlaneProblem(parts_->scratch, joints, state, target, options).solve(method, observer);
    if (const Result bad = load_limits(parts_->scratch, options.limits); !bad) return refusal<Report>(bad);
    Problem problem{joints,  target,          options.tolerance.value_or(1e-3f * reach()),
                    options, parts_->scratch, state};
    int order = 0;
    return observer ? run_weighted(method, problem, Watched(*observer, order))
                    : run_weighted(method, problem, Unwatched());
}

Report Solver::solve(Method method, Chain& chain, State& state, glm::vec3 target, const Options& options,
                     Observer* observer) noexcept {
    if (!parts_) return refusal<Report>(moved_from("solve", "solver"));
    if (const Result bad = check_count("solve", "chain: its segments", chain.size(), bones() + 1); !bad)
        return refusal<Report>(bad);
    std::vector<glm::vec3>& joints = parts_->scratch.joints;
    for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = chain.segments()[i].position;
    Options saved = options;
    // Checked first, so that overriding it does not hide an invalid value.
    if (check(options, bones())) saved.max_stretch_scale = 1.0f;
    const bool risky = may_leave_range(chain, reach()) && state.bones() == bones();
    if (risky) parts_->scratch.saved = state;
    Report report = solve(method, joints, state, target, saved, observer);
    if (!report.accepted) return report;
    if (const Result bad = chain.set_positions(joints); !bad) {  // a joint is over max_magnitude
        if (risky) state = parts_->scratch.saved;
        return refusal<Report>(bad);
    }
    return report;
}

}  // namespace tendril::ik
