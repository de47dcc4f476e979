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
    /// Metres, before the first iteration and after each; never empty. The last is where the iterations
    /// ended.
    std::vector<float> residuals;
    /// Whether that was not the best pose, so that the best came back: the report's residual is the best's.
    bool restored = false;
    /// Of the whole solve, the fastest of several; measured here and now, so it differs from run to run:
    /// never in a state, nor in a picture that is compared.
    double microseconds = 0.0;
};

struct Race {
    std::vector<Racer> racers;
    float tolerance = 0.0f;  ///< metres
    bool within_limits = false;
};

Race run_race(const Chain& chain, const ReachSettings& settings, glm::vec3 target, const Racers& racers,
              ChainRuntime& runtime);

/// How a racer ended, in words: "Stalled, 310 mm from the target"; where the best pose was restored, "best
/// pose restored: 230 mm" beside it, else empty.
std::string end_text(const Racer& racer);
std::string restored_text(const Racer& racer);

/// A line for each iteration of each solver: solver, iteration, residual, microseconds, and on its last line
/// status, ran (ran_text's words), and restored: the best pose's residual where that came back.
std::string race_csv(const Race& race);

}  // namespace tendril::app
