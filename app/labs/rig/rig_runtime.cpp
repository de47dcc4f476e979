#include "app/labs/rig/rig_runtime.hpp"

#include <algorithm>
#include <chrono>

namespace tendril::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Times each unit; the overhead is about 30 ns per unit.
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

/// Copies of a rig share their definition. kept_ holds a copy, so the address cannot be reused.
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
    if (!measured) return part.rig.solve(part.state.edit(), dt, scratch);
    kept_->microseconds.resize(part.rig.definition().units.size());
    Stopwatch stopwatch(kept_->microseconds);
    return part.rig.solve(part.state.edit(), dt, scratch, &stopwatch);
}

const rig::Hierarchy& RigRuntime::resolved(const Workspace& workspace) {
    const std::shared_ptr<const Part>& part = workspace.document.parts().at(rig_lab);
    if (read_.part != part) {
        read_ = {part, rig_part(workspace).state->elements};
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

namespace {

constexpr std::size_t max_bytes = 32u << 20;

/// The first tick at which the keys differ; snapshots after it are invalid.
std::uint32_t first_difference(const std::vector<TakeKey>& a, const std::vector<TakeKey>& b) {
    const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    constexpr std::uint32_t never = ~0u;
    return std::min(in_a == a.end() ? never : in_a->tick, in_b == b.end() ? never : in_b->tick);
}

}  // namespace

void TakeSnapshots::follow(const RigPart& part) {
    const bool same = start_ == part.take.start && walks_ == part.walks && rig_ &&
                      &rig_->definition() == &part.rig.definition();
    if (same && keys_ == part.take.keys) return;
    static const std::vector<TakeKey> none;
    if (!same) {
        by_tick_.clear();
        bytes_ = 0;
        stride_ = first_stride;
        start_ = part.take.start;
        walks_ = part.walks;
        rig_ = part.rig;
    } else {
        const std::uint32_t until =
            first_difference(keys_ ? *keys_ : none, part.take.keys ? *part.take.keys : none);
        while (!by_tick_.empty() && by_tick_.rbegin()->first > until) {
            bytes_ -= state_bytes(by_tick_.rbegin()->second.state);
            by_tick_.erase(std::prev(by_tick_.end()));
        }
    }
    keys_ = part.take.keys;
}

void TakeSnapshots::offer(const RigPart& part) {
    follow(part);
    if (part.take.tick % stride_ == 0) keep(part);
}

void TakeSnapshots::keep(const RigPart& part) {
    follow(part);
    if (by_tick_.contains(part.take.tick)) return;
    by_tick_.emplace(part.take.tick, Snapshot{part.state, part.moving});
    bytes_ += state_bytes(part.state);
    while (bytes_ > max_bytes && stride_ < max_take_ticks) {  // drop every other snapshot
        stride_ *= 2;
        std::erase_if(by_tick_, [&](const auto& each) {
            if (each.first % stride_ == 0) return false;
            bytes_ -= state_bytes(each.second.state);
            return true;
        });
    }
}

const std::pair<const std::uint32_t, TakeSnapshots::Snapshot>* TakeSnapshots::nearest(const RigPart& part,
                                                                                      std::uint32_t tick) {
    follow(part);
    const auto after = by_tick_.upper_bound(tick);
    return after == by_tick_.begin() ? nullptr : &*std::prev(after);
}

}  // namespace tendril::app
