#include "app/labs/rig/take.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/labs/rig/walk.hpp"

namespace tendril::app {
namespace {

constexpr std::uint64_t most_seek_work = 40'000'000;  ///< a second or so

bool same_keys(const RigTake& a, const RigTake& b) {
    if (a.keys == b.keys) return true;
    return a.keys && b.keys && *a.keys == *b.keys;
}

/// A walk goes where its limits let it; the path has been checked when it was given.
void walk(const rig::Rig& rig, const std::vector<RigWalk>& walks, rig::State& state, double ticks) {
    for (const RigWalk& each : walks)
        if (const auto at = rig.element(each.control))
            static_cast<void>(rig.set_control(state, *at, walk_value(each, state.controls[*at], ticks)));
}

void apply_key(const rig::Rig& rig, const ControlKey& key, rig::State& state) {
    static_cast<void>(rig.set_control(state, key.element, key.value));
}

void apply_keys(RigPart& part) {
    if (!part.take.keys) return;
    const auto& keys = *part.take.keys;
    const std::uint32_t tick = part.take.tick;
    auto key = std::ranges::lower_bound(keys, tick, {}, &ControlKey::tick);
    for (; key != keys.end() && key->tick == tick; ++key) {
        apply_key(part.rig, *key, part.state);
        part.moving = true;
    }
}

/// From the part's tick to the next.
void pass(RigPart& part, RigRuntime& runtime, bool measured) {
    walk(part.rig, part.walks, part.state, part.take.tick + 1.0);
    part.moving = runtime.solve(part, tick_seconds, measured);
    ++part.take.tick;
    part.take.last = std::max(part.take.last, part.take.tick);
    runtime.snapshots.offer(part);
    apply_keys(part);
}

void ensure_start(RigPart& part) {
    if (!part.take.start) part.take.start = std::make_shared<const rig::State>(part.state);
}

}  // namespace

bool RigTake::operator==(const RigTake& other) const {
    return tick == other.tick && last == other.last && began == other.began &&
           (start == other.start || (start && other.start && *start == *other.start)) &&
           same_keys(*this, other);
}

std::uint64_t tick_work_of(const rig::State& state) {
    std::uint64_t work = state.controls.size();
    for (const rig::UnitState& unit : state.units) work += 10 * unit.memory.size();
    return work;
}

void begin_take(RigPart& part) {
    if (part.rates && part.rates->running) part.rates.reset();  // it was of the take so far
    for (RigWalk& each : part.walks)
        each.motion.ticks = (each.motion.ticks + part.take.tick) % ticks_per_round(each.motion);
    part.take = {.start = nullptr, .keys = nullptr, .tick = 0, .last = 0, .began = part.take.now()};
}

void key_control(RigPart& part, std::size_t element) {
    const std::size_t count = part.take.keys ? part.take.keys->size() : 0;
    if (part.take.tick == 0 || count >= most_take_keys) return begin_take(part);
    const std::uint32_t tick = part.take.tick, at = static_cast<std::uint32_t>(element);
    std::vector<ControlKey> keys;
    if (part.take.keys) keys = *part.take.keys;
    std::erase_if(keys, [&](const ControlKey& key) {
        return key.tick > tick || (key.tick == tick && key.element == at);
    });
    keys.push_back({tick, at, part.state.controls[element]});
    part.take.keys = std::make_shared<const std::vector<ControlKey>>(std::move(keys));
    part.take.last = tick;
}

bool time_moves(const RigPart& part) {
    if (part.moving || !part.walks.empty()) return true;
    return part.take.keys && !part.take.keys->empty() && part.take.keys->back().tick > part.take.tick;
}

void pass_tick(RigPart& part, RigRuntime& runtime, bool measured) {
    if (part.take.tick >= most_take_ticks) begin_take(part);
    ensure_start(part);
    pass(part, runtime, measured);
}

void go_to(RigPart& part, std::uint32_t tick, RigRuntime& runtime) {
    if (tick == part.take.tick) return;
    ensure_start(part);
    const auto* nearest = runtime.snapshots.nearest(part, tick);
    const std::uint32_t known = nearest ? nearest->first : 0;
    const bool from_here = part.take.tick < tick && part.take.tick >= known;
    const std::uint32_t from = from_here ? part.take.tick : known;
    if ((tick - from) * tick_work_of(part.state) > most_seek_work)
        throw std::invalid_argument("that is " + std::to_string(tick - from) +
                                    " ticks from the nearest that is known, which would take too long; go "
                                    "there in smaller steps");
    if (!from_here) {
        part.state = nearest ? nearest->second.state : *part.take.start;
        part.moving = nearest ? nearest->second.moving : true;
        part.take.tick = from;
        apply_keys(part);
    }
    while (part.take.tick < tick) pass(part, runtime, false);
}

TakeRunner::TakeRunner(const RigPart& part, rig::Workspace& scratch)
    : part_(part), scratch_(scratch), state_(part.take.start ? *part.take.start : part.state) {}

void TakeRunner::frame(double seconds, double ticks) {
    constexpr double rounding = 1e-6;
    while (part_.take.keys && next_key_ < part_.take.keys->size() &&
           (*part_.take.keys)[next_key_].tick < ticks - rounding)
        apply_key(part_.rig, (*part_.take.keys)[next_key_++], state_);
    walk(part_.rig, part_.walks, state_, ticks);
    part_.rig.solve(state_, seconds, scratch_);
}

void TakeRunner::tick() {
    ++ticks_;
    frame(tick_seconds, ticks_);
}

}  // namespace tendril::app
