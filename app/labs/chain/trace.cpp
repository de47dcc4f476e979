#include "app/labs/chain/trace.hpp"

#include <algorithm>
#include <tendril/ik/solver.hpp>

#include "app/labs/chain/chain_runtime.hpp"

namespace tendril::app {
namespace {

class Recorder final : public ik::Observer {
  public:
    explicit Recorder(Trace& trace) : trace_(trace) {}
    void step(const ik::Step& step) noexcept override {
        if (trace_.steps.size() >= static_cast<std::size_t>(max_trace_steps)) {
            trace_.cut = true;
            return;
        }
        if (trace_.steps.empty() || trace_.steps.back().order != step.order) {
            trace_.frame_begins.push_back(trace_.steps.size());
        }
        trace_.steps.push_back(step);
    }
    void iteration_done(int, float residual) noexcept override {
        if (!trace_.cut) trace_.residuals.push_back(residual);
    }

  private:
    Trace& trace_;
};

}  // namespace

std::span<const ik::Step> Trace::frame(std::size_t frame) const {
    if (frame == 0 || frame > frames()) return {};
    const std::size_t begin = frame_begins[frame - 1];
    const std::size_t end = frame < frames() ? frame_begins[frame] : steps.size();
    return std::span(steps).subspan(begin, end - begin);
}

std::vector<glm::vec3> Trace::pose(std::size_t frame) const {
    std::vector<glm::vec3> joints = start;
    const std::size_t end = frame < frames() ? frame_begins[frame] : steps.size();
    for (std::size_t i = 0; i < end; ++i) joints[steps[i].joint] = steps[i].to;
    return joints;
}

int Trace::iteration(std::size_t frame) const {
    const auto steps_of = this->frame(frame);
    return steps_of.empty() ? 0 : steps_of.front().iteration;
}

std::size_t Trace::end_of_iteration(int iteration) const {
    const std::vector<int> ends = iteration_ends(*this);
    const auto wanted = std::min(static_cast<std::size_t>(std::max(0, iteration)), ends.size() - 1);
    return static_cast<std::size_t>(ends[wanted]);
}

std::vector<int> iteration_ends(const Trace& trace) {
    std::vector<int> ends{0};
    for (std::size_t frame = 1; frame <= trace.frames(); ++frame) {
        const auto iteration = static_cast<std::size_t>(trace.iteration(frame));
        if (iteration >= ends.size()) ends.resize(iteration + 1, ends.back());
        ends.back() = static_cast<int>(frame);
    }
    return ends;
}

Trace record_trace(Chain chain, ReachSettings settings, glm::vec3 target, ChainRuntime& runtime) {
    Trace trace;
    trace.method = settings.method;
    trace.start = positions(chain);
    Recorder recorder(trace);
    ik::Solver& solver = runtime.solver(chain);
    trace.report = solver.solve(settings.method, chain, state_for(settings, solver.bones()), target,
                                solver_options(settings, solver.reach()), &recorder);
    return trace;
}

}  // namespace tendril::app
