// What a solver holds, and its door: what is checked before a solve. The solve itself is in loop.cpp.
#include "tendril/ik/solver.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "chain/checks.hpp"
#include "ik/math.hpp"
#include "ik/solve/loop.hpp"
#include "ik/solve/parts.hpp"
#include "ik/solve/validate.hpp"

namespace tendril::ik {

using namespace detail;

namespace {

std::vector<float> lengths_of(const Chain& chain) {
    std::vector<float> lengths;
    for (std::size_t i = 1; i < chain.size(); ++i) lengths.push_back(chain.length(i));
    return lengths;
}

void require_direction(std::size_t index, const glm::vec3& direction) {
    const std::string argument = "rest_directions[" + std::to_string(index) + "]";
    tendril::detail::require_point("Solver", argument, direction);
    const float size = length(direction);
    if (std::abs(size - 1.0f) > 1e-3f) {
        tendril::detail::refuse("Solver", argument, "a unit vector",
                                "one of length " + tendril::detail::text(size));
    }
}

}  // namespace

Solver::Solver(std::span<const float> lengths, std::span<const glm::vec3> rest_directions)
    : parts_(std::make_unique<Parts>()) {
    Workspace& room = parts_->room;
    double reach = 0.0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        tendril::detail::require_length("Solver", "lengths[" + std::to_string(i) + "]", lengths[i]);
        reach += static_cast<double>(lengths[i]);
        room.longest = std::max(room.longest, lengths[i]);
    }
    if (!rest_directions.empty() && rest_directions.size() != lengths.size()) {
        tendril::detail::refuse("Solver", "rest_directions", "as many as lengths or none",
                                std::to_string(rest_directions.size()));
    }
    for (std::size_t i = 0; i < rest_directions.size(); ++i) require_direction(i, rest_directions[i]);
    room.reach = static_cast<float>(reach);
    room.resize(lengths.size());
    std::copy(lengths.begin(), lengths.end(), room.lengths.begin());
    for (std::size_t i = 0; i < rest_directions.size(); ++i) {
        room.rest_directions[i] = times(rest_directions[i], 1.0f / length(rest_directions[i]));
    }
}

Solver::Solver(const Chain& chain)
    : Solver(lengths_of(chain),
             std::vector<glm::vec3>(chain.empty() ? 0 : chain.size() - 1, chain.default_direction())) {}

Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

std::size_t Solver::bones() const noexcept {
    return parts_->room.lengths.size();
}

float Solver::reach() const noexcept {
    return parts_->room.reach;
}

Report Solver::solve(Method method, std::span<glm::vec3> joints, glm::vec3 target, const Options& options,
                     Observer* observer) noexcept {
    const Report refused{Status::InvalidInput, 0, 0.0f};
    // With a tip orientation the last bone is laid by itself.
    const bool taken = takes(method, bones()) || (options.tip_orientation && takes(method, bones() - 1));
    if (joints.size() != bones() + 1 || !taken) return refused;
    if (!are_points(joints) || !are_points({&target, 1}) || !are_valid(options, bones())) return refused;
    if (!fit(options.limits, parts_->room.rest_directions)) return refused;
    Problem problem{joints, target, options.tolerance.value_or(1e-3f * reach()), options, parts_->room};
    int order = 0;
    return observer ? run(method, problem, Watched(*observer, order)) : run(method, problem, Unwatched());
}

Report Solver::solve(Method method, Chain& chain, glm::vec3 target, const Options& options,
                     Observer* observer) noexcept {
    const Report refused{Status::InvalidInput, 0, 0.0f};
    if (chain.size() != bones() + 1) return refused;
    std::vector<glm::vec3>& joints = parts_->room.joints;
    for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = chain.segments()[i].position;
    Options kept = options;
    // Checked first, so that what is wrong with it is not hidden.
    if (are_valid(options, bones())) kept.max_stretch_scale = 1.0f;
    const Report report = solve(method, joints, target, kept, observer);
    if (report.status == Status::InvalidInput) return report;
    if (!chain.set_positions(joints)) return refused;  // a chain takes no joint that far out
    return report;
}

std::span<const glm::quat> Solver::rotations() const noexcept {
    return parts_->room.rotations;
}

bool Solver::set_rotations(std::span<const glm::quat> rotations) noexcept {
    if (rotations.size() != bones()) return false;
    if (!std::all_of(rotations.begin(), rotations.end(), is_unit)) return false;
    std::copy(rotations.begin(), rotations.end(), parts_->room.rotations.begin());
    return true;
}

void Solver::forget_rotations() noexcept {
    std::fill(parts_->room.rotations.begin(), parts_->room.rotations.end(), glm::quat(1, 0, 0, 0));
}

}  // namespace tendril::ik
