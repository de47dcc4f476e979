// The same start and the same target for several solvers.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <tendril/chain/chain.hpp>
#include <vector>

#include "app/labs/chain/reach.hpp"

namespace tendril::app {

/// Who takes part, by ik::Method.
using Racers = std::array<bool, ik::all_methods.size()>;

struct Racer {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::vector<glm::vec3> joints;  ///< where they ended
    std::vector<float> residuals;   ///< metres, at the start and after each iteration
    /// Of the whole solve, the least of several; measured here and now, so it differs from run to run: never
    /// in a state, nor in a picture that is compared.
    double microseconds = 0.0;
};

struct Race {
    std::vector<Racer> racers;
    float tolerance = 0.0f;  ///< metres
};

Race run_race(const Chain& chain, const ReachSettings& settings, glm::vec3 target, const Racers& racers);

/// A line for each iteration of each solver: solver, iteration, residual, microseconds, status.
std::string race_csv(const Race& race);

}  // namespace tendril::app
