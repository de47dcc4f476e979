// A step of a solve in words.
#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/labs/chain/trace.hpp"

namespace tendril::app {
namespace {

/// "joint 2", "joints 2 to 4".
std::string joints_of(std::span<const ik::Step> steps) {
    std::size_t low = steps.front().joint, high = low;
    for (const ik::Step& step : steps) {
        low = std::min(low, step.joint);
        high = std::max(high, step.joint);
    }
    if (low == high) return "joint " + std::to_string(low);
    return "joints " + std::to_string(low) + " to " + std::to_string(high);
}

std::string pull(const Trace& trace, std::size_t frame, const ik::Step& step) {
    if (step.neighbour == ik::no_joint) {
        return step.phase == ik::Phase::ForwardReaching
                   ? "Forward reaching: the tip goes onto the target."
                   : "Backward reaching: the root goes back to its place.";
    }
    const float length = glm::distance(trace.pose(frame)[step.neighbour], step.to);
    char text[200];
    std::snprintf(text, sizeof text,
                  "%s reaching: joint %zu slides along its line to joint %zu until it is %.3f m away.",
                  step.phase == ik::Phase::ForwardReaching ? "Forward" : "Backward", step.joint,
                  step.neighbour, static_cast<double>(length));
    return text;
}

}  // namespace

std::string describe_frame(const Trace& trace, std::size_t frame) {
    const auto steps = trace.frame(frame);
    if (steps.empty()) return "The start: nothing has moved yet.";
    const ik::Step& first = steps.front();
    const std::string joints = joints_of(steps);
    const std::string about =
        first.neighbour == ik::no_joint ? "" : " about joint " + std::to_string(first.neighbour);
    switch (first.phase) {
        case ik::Phase::Prepare:
            return "Before the first iteration: the chain is prepared (" + joints + ").";
        case ik::Phase::ForwardReaching:
        case ik::Phase::BackwardReaching:
            return pull(trace, frame, first);
        case ik::Phase::Accelerate:
            return "The chain is straightened or bent until it spans the distance, then turned onto "
                   "the target (" +
                   joints + ").";
        case ik::Phase::Rotate:
            return "Everything beyond turns" + about + ", so that the tip looks at the target (" + joints +
                   ").";
        case ik::Phase::Gradient:
            return "All joints turn a little, as the Jacobian says (" + joints + ").";
        case ik::Phase::Pole:
            return "The chain swivels until the elbow points at the pole target (" + joints + ").";
        case ik::Phase::Limit:
            return "Limits: " + joints + (steps.size() == 1 ? " is" : " are") +
                   " brought back within limits.";
        case ik::Phase::Analytic:
            return "Solved in closed form, without iterating (" + joints + ").";
        case ik::Phase::RestoreBest:
            return "The best pose is restored, for the last was worse (" + joints + ").";
        case ik::Phase::Blend:
            return "Blended with the given pose by the weight (" + joints + ").";
    }
    return {};
}

}  // namespace tendril::app
