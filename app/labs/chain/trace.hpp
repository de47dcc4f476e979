// The inside of one solve: every elementary step that an observer saw, and the pose after each.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <tendril/chain/chain.hpp>
#include <tendril/ik/observer.hpp>
#include <vector>

#include "app/labs/chain/reach.hpp"

namespace tendril::app {

inline constexpr int max_trace_steps = 200'000;  ///< what comes later is left out, and said to be

struct Trace {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::vector<glm::vec3> start;           ///< the joints before anything moved
    std::vector<ik::Step> steps;            ///< in the order in which they happened
    std::vector<std::size_t> frame_begins;  ///< where each group of steps that happen at once begins
    std::vector<float> residuals;           ///< metres, at the start and after each iteration
    bool cut = false;

    std::size_t frames() const { return frame_begins.size(); }
    /// The steps that take frame `frame - 1` to `frame`; none for frame 0.
    std::span<const ik::Step> frame(std::size_t frame) const;
    /// The joints after `frame` frames.
    std::vector<glm::vec3> pose(std::size_t frame) const;
    /// The iteration that a frame belongs to; 0 before the first.
    int iteration(std::size_t frame) const;
    /// The last frame of an iteration.
    std::size_t end_of_iteration(int iteration) const;
};

/// The last frame of what comes before the first iteration, and of each iteration.
std::vector<int> iteration_ends(const Trace& trace);

/// Solves a copy of the chain, and watches.
Trace record_trace(Chain chain, ReachSettings settings, glm::vec3 target, ChainRuntime& runtime);

/// "Forward reaching: joint 2 goes to 1.00 m from joint 3, on the line through where it was."
std::string describe_frame(const Trace& trace, std::size_t frame);

}  // namespace tendril::app
