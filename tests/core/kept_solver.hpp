// A solver with its chain's state, as programs keep them between frames.
#pragma once

#include <algorithm>

#include "tendril/ik/solver.hpp"

namespace tendril::test {

class KeptSolver {
  public:
    /// Makes a solver of valid bones: an invalid one ends the program.
    explicit KeptSolver(std::span<const float> lengths, std::span<const glm::vec3> rest_directions = {})
        : KeptSolver(ik::Solver::make(lengths, rest_directions).value()) {}
    explicit KeptSolver(const Chain& chain) : KeptSolver(ik::Solver(chain)) {}
    explicit KeptSolver(ik::Solver solver) : solver_(std::move(solver)), state(solver_.initial_state()) {}

    std::size_t bones() const noexcept { return solver_.bones(); }
    float reach() const noexcept { return solver_.reach(); }

    ik::Report solve(ik::Method method, std::span<glm::vec3> joints, glm::vec3 target,
                     const ik::Options& options = {}, ik::Observer* observer = nullptr) noexcept {
        return solver_.solve(method, joints, state, target, options, observer);
    }
    ik::Report solve(ik::Method method, Chain& chain, glm::vec3 target, const ik::Options& options = {},
                     ik::Observer* observer = nullptr) noexcept {
        return solver_.solve(method, chain, state, target, options, observer);
    }
    std::optional<ik::ActiveLimit> explain(std::span<const glm::vec3> joints, glm::vec3 target,
                                           const ik::Options& options) noexcept {
        return solver_.explain(joints, state, target, options);
    }

    std::span<const glm::quat> rotations() const noexcept { return state.rotations; }
    void set_rotations(std::span<const glm::quat> rotations) noexcept {
        std::copy(rotations.begin(), rotations.end(), state.rotations.begin());
    }

  private:
    ik::Solver solver_;

  public:
    ik::State state;
};

}  // namespace tendril::test
