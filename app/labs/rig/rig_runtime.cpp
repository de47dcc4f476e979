#include "app/labs/rig/rig_runtime.hpp"

#include <chrono>

namespace tendril::app {
namespace {

using Clock = std::chrono::steady_clock;

/// A unit takes what passes until it is done; the time that this takes itself is some 30 ns.
class Stopwatch final : public rig::Observer {
  public:
    explicit Stopwatch(std::vector<double>& microseconds) : microseconds_(microseconds) {}
    void begin(rig::State&) override { last_ = Clock::now(); }
    void unit_done(std::size_t unit, rig::State&) override {
        const Clock::time_point now = Clock::now();
        microseconds_[unit] = std::chrono::duration<double, std::micro>(now - last_).count();
        last_ = Clock::now();
    }

  private:
    std::vector<double>& microseconds_;
    Clock::time_point last_;
};

}  // namespace

/// Copies of a rig share their definition; what is kept here keeps it where it is.
bool RigRuntime::keeps(const rig::Rig& rig) const {
    return kept_ && &kept_->rig.definition() == &rig.definition();
}

rig::Workspace& RigRuntime::workspace(const rig::Rig& rig) {
    if (!keeps(rig)) kept_.emplace(Kept{rig, rig::Workspace(rig), {}});
    return kept_->workspace;
}

bool RigRuntime::solve(RigPart& part, double dt, bool measured) {
    rig::Workspace& scratch = workspace(part.rig);
    part.last_solved.reset();
    part.edited = false;
    if (!measured) return part.rig.solve(part.state, dt, scratch);
    kept_->microseconds.resize(part.rig.definition().units.size());
    Stopwatch stopwatch(kept_->microseconds);
    return part.rig.solve(part.state, dt, scratch, &stopwatch);
}

const rig::Hierarchy& RigRuntime::resolved(const Workspace& workspace) {
    const std::shared_ptr<const Part>& part = workspace.document.parts().at(rig_lab);
    if (read_.part != part) {
        read_ = {part, rig_part(workspace).state.elements};
        read_.elements.resolve_all();
    }
    return read_.elements;
}

const rig::Explanation& RigRuntime::explanation(const Workspace& workspace, std::size_t element) {
    const std::shared_ptr<const Part>& part = workspace.document.parts().at(rig_lab);
    if (why_.part != part || why_.element != element) {
        const RigPart& rig = rig_part(workspace);
        why_ = {part, element, rig::explain(rig.rig, rig.state, element, this->workspace(rig.rig))};
    }
    return why_.explanation;
}

std::vector<double> RigRuntime::microseconds(const rig::Rig& rig) const {
    return keeps(rig) ? kept_->microseconds : std::vector<double>();
}

}  // namespace tendril::app
