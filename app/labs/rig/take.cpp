#include "app/labs/rig/take.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <span>
#include <stdexcept>
#include <utility>

#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

constexpr std::uint64_t max_seek_work = 40'000'000;  ///< about a second

bool same_keys(const RigTake& a, const RigTake& b) {
    if (a.keys == b.keys) return true;
    return a.keys && b.keys && *a.keys == *b.keys;
}

/// Walks each control along its path; limits clamp it. The path was checked when it was set.
void walk(const rig::Rig& rig, const std::vector<RigWalk>& walks, rig::State& state, double ticks) {
    for (const RigWalk& each : walks)
        if (const auto at = rig.element(each.control))
            static_cast<void>(rig.set_control(state, *at, walk_value(each, state.controls[*at], ticks)));
}

void apply_key(const rig::Rig& rig, const TakeKey& key, rig::State& state) {
    static_cast<void>(rig.set_control(state, key.element, key.value));
}

/// The keys of a tick: those up to its last solve, then later ones, which take effect in the next tick.
struct KeysOfTick {
    std::span<const TakeKey> solved, set;
};
KeysOfTick keys_at(const RigTake& take, std::uint32_t tick) {
    if (!take.keys) return {};
    const auto begin = std::ranges::lower_bound(*take.keys, tick, {}, &TakeKey::tick);
    const auto end = std::ranges::upper_bound(*take.keys, tick, {}, &TakeKey::tick);
    const auto is_solve = [](const TakeKey& key) { return key.element == TakeKey::solve; };
    const auto set = std::find_if(std::reverse_iterator(end), std::reverse_iterator(begin), is_solve).base();
    return {{begin, set}, {set, end}};
}

/// True if the control already has the key's value: it was set here, or changes nothing.
bool is_shown(const RigPart& part, const TakeKey& key) {
    return part.state->controls[key.element] == key.value;
}

/// Applies the keys that are visible at the part's tick.
void arrive(RigPart& part, RigRuntime& runtime, bool measured = false) {
    for (const TakeKey& key : keys_at(part.take, part.take.tick).solved) {
        if (key.element == TakeKey::solve) {
            part.moving |= runtime.solve(part, 0.0, measured);
        } else {
            apply_key(part.rig, key, part.state.edit());
            part.moving = true;
        }
    }
}

/// Applies the keys set after the part's tick was displayed.
void leave(RigPart& part) {
    for (const TakeKey& key : keys_at(part.take, part.take.tick).set)
        if (!is_shown(part, key)) apply_key(part.rig, key, part.state.edit());
}

/// Advances from the part's tick to the next.
void pass(RigPart& part, RigRuntime& runtime, bool measured) {
    leave(part);
    walk(part.rig, part.walks, part.state.edit(), part.take.tick + 1.0);
    part.moving = runtime.solve(part, tick_seconds, measured);
    ++part.take.tick;
    part.take.last = std::max(part.take.last, part.take.tick);
    runtime.snapshots.offer(part);
    arrive(part, runtime);
}

void ensure_start(RigPart& part) {
    if (!part.take.start) part.take.start = part.state.share();
}

std::shared_ptr<const std::vector<TakeKey>> shared(std::vector<TakeKey> keys) {
    return keys.empty() ? nullptr : std::make_shared<const std::vector<TakeKey>>(std::move(keys));
}

/// The keys in effect, without keys of the current tick that are not applied yet.
std::vector<TakeKey> keys_so_far(const RigPart& part) {
    const RigTake& take = part.take;
    if (!take.keys) return {};
    std::vector<TakeKey> keys(take.keys->begin(),
                              std::ranges::lower_bound(*take.keys, take.tick, {}, &TakeKey::tick));
    const KeysOfTick here = keys_at(take, take.tick);
    keys.insert(keys.end(), here.solved.begin(), here.solved.end());
    for (const TakeKey& key : here.set)
        if (is_shown(part, key)) keys.push_back(key);
    return keys;
}

bool too_far(const RigPart& part, std::uint32_t ticks) {
    return ticks * part.rig.work() > max_seek_work;
}

/// Goes to a tick from the nearest snapshot before it. Returns false if that is too far away.
bool go_from_known(RigPart& part, std::uint32_t tick, RigRuntime& runtime) {
    const auto* nearest = runtime.snapshots.nearest(part, tick);
    const std::uint32_t from = nearest ? nearest->first : 0;
    if (too_far(part, tick - from)) return false;
    part.state = nearest ? nearest->second.state : SharedState(*part.take.start);
    part.last_solved.reset();
    part.edited = !nearest;  // the start of a take may not be solved
    part.moving = nearest ? nearest->second.moving : true;
    part.take.tick = from;
    arrive(part, runtime);
    while (part.take.tick < tick) pass(part, runtime, false);
    return true;
}

/// Undoes the keys of the current tick. `keys`: those of earlier ticks.
bool undo_keys_here(RigPart& part, std::vector<TakeKey> keys, RigRuntime& runtime) {
    part.take.keys = shared(std::move(keys));
    if (!go_from_known(part, part.take.tick, runtime)) return false;
    runtime.snapshots.keep(part);  // a drag returns here repeatedly
    return true;
}

/// The last value set for each control, then a single solve.
std::vector<TakeKey> as_one(std::span<const TakeKey> keys, std::uint32_t tick) {
    std::vector<TakeKey> once;
    for (const TakeKey& key : keys) {
        if (key.element == TakeKey::solve) continue;
        std::erase_if(once, [&](const TakeKey& each) { return each.element == key.element; });
        once.push_back(key);
    }
    once.push_back({tick, TakeKey::solve});
    return once;
}

}  // namespace

bool RigTake::operator==(const RigTake& other) const {
    return tick == other.tick && last == other.last && began == other.began && recording == other.recording &&
           (start == other.start || (start && other.start && *start == *other.start)) &&
           same_keys(*this, other);
}

void begin_take(RigPart& part) {
    part.rates.reset();  // the rates belong to the old take
    for (RigWalk& each : part.walks)
        each.motion.ticks = (each.motion.ticks + part.take.tick) % ticks_per_round(each.motion);
    part.take = {.start = nullptr,
                 .keys = nullptr,
                 .tick = 0,
                 .last = 0,
                 .began = part.take.now(),
                 .recording = part.take.recording};
}

void key_control(RigPart& part, std::size_t element) {
    const std::size_t count = part.take.keys ? part.take.keys->size() : 0;
    if (part.take.tick == 0 || count >= max_take_keys) return begin_take(part);
    const std::uint32_t tick = part.take.tick, at = static_cast<std::uint32_t>(element);
    std::vector<TakeKey> keys = keys_so_far(part);
    // Units have already seen the values set before the last solve at this tick.
    const auto seen = std::find_if(keys.rbegin(), keys.rend(), [&](const TakeKey& key) {
        return key.tick < tick || key.element == TakeKey::solve;
    });
    keys.erase(std::remove_if(seen.base(), keys.end(), [&](const TakeKey& key) { return key.element == at; }),
               keys.end());
    keys.push_back({tick, at, part.state->controls[element]});
    part.take.keys = shared(std::move(keys));
    part.take.last = tick;
}

void solve_now(RigPart& part, RigRuntime& runtime, bool measured) {
    const RigPart before = part;
    std::vector<TakeKey> keys = keys_so_far(part);
    const std::uint32_t tick = part.take.tick;
    const auto here = std::ranges::lower_bound(keys, tick, {}, &TakeKey::tick);
    const std::vector<TakeKey> set_here = as_one({here, keys.end()}, tick);
    const bool again = std::ranges::find(here, keys.end(), TakeKey::solve, &TakeKey::element) != keys.end();
    keys.erase(here, keys.end());
    bool remembered = tick > 0 && keys.size() + set_here.size() <= max_take_keys;
    if (remembered && again && !undo_keys_here(part, keys, runtime)) {
        part = before;
        remembered = false;
    }
    if (!remembered) {
        part.moving |= runtime.solve(part, 0.0, measured);
        if (part.state != before.state) begin_take(part);
        return;
    }
    keys.insert(keys.end(), set_here.begin(), set_here.end());
    part.take.keys = shared(std::move(keys));
    part.take.last = tick;
    if (again)
        arrive(part, runtime, measured);
    else
        part.moving |= runtime.solve(part, 0.0, measured);
    if (part.state == before.state) part = before;
}

bool time_moves(const RigPart& part) {
    if (part.moving || part.take.recording || !part.walks.empty()) return true;
    if (!part.take.keys || part.take.keys->empty()) return false;
    const KeysOfTick here = keys_at(part.take, part.take.tick);
    return part.take.keys->back().tick > part.take.tick ||
           std::ranges::any_of(here.set, [&](const TakeKey& key) { return !is_shown(part, key); });
}

void pass_tick(RigPart& part, RigRuntime& runtime, bool measured) {
    if (part.take.tick >= max_take_ticks) begin_take(part);
    ensure_start(part);
    pass(part, runtime, measured);
}

void go_to(RigPart& part, std::uint32_t tick, RigRuntime& runtime) {
    if (tick == part.take.tick) return;
    ensure_start(part);
    const auto* nearest = runtime.snapshots.nearest(part, tick);
    const std::uint32_t known = nearest ? nearest->first : 0;
    const bool from_here = part.take.tick < tick && part.take.tick >= known;
    const std::uint32_t ticks = tick - (from_here ? part.take.tick : known);
    if (too_far(part, ticks))
        throw std::invalid_argument(
            "that is " + std::to_string(ticks) +
            " ticks from the nearest known tick, which would take too long; go there in smaller steps");
    if (from_here)
        while (part.take.tick < tick) pass(part, runtime, false);
    else
        go_from_known(part, tick, runtime);
}

TakeRunner::TakeRunner(const RigPart& part, rig::Workspace& scratch)
    : part_(part), scratch_(scratch), state_(part.take.start ? *part.take.start : *part.state) {}

void TakeRunner::keys_before(double ticks) {
    constexpr double rounding = 1e-6;
    if (!part_.take.keys) return;
    for (; next_key_ < part_.take.keys->size(); ++next_key_) {
        const TakeKey& key = (*part_.take.keys)[next_key_];
        if (!(key.tick < ticks - rounding)) return;
        if (key.element == TakeKey::solve)
            part_.rig.solve(state_, 0.0, scratch_);
        else
            apply_key(part_.rig, key, state_);
    }
}

void TakeRunner::frame(double seconds, double ticks) {
    keys_before(ticks);
    walk(part_.rig, part_.walks, state_, ticks);
    part_.rig.solve(state_, seconds, scratch_);
}

namespace {

using Path = Motion::Path;

/// Angle along the path, radians. A round is a whole number of ticks, so the angle never drifts.
double angle_after(const Motion& motion, double ticks) {
    const double rounds =
        (static_cast<double>(motion.ticks) + ticks) / static_cast<double>(ticks_per_round(motion));
    return glm::two_pi<double>() * (rounds - std::floor(rounds));
}

/// Position on the unit path, and the direction of travel.
struct Step {
    glm::dvec3 at{0.0}, along{0.0, 0.0, 1.0};
};
Step step_at(Path path, double angle) {
    const double c = math::cosine(angle), s = math::sine(angle);
    switch (path) {
        case Path::Still:
            break;
        case Path::Circle:
            return {{c, 0.0, s}, {-s, 0.0, c}};
        case Path::FigureEight:
            return {{c, 0.0, s * c}, {-s, 0.0, c * c - s * s}};
        case Path::Sweep:
            return {{s, 0.0, 0.0}, {c < 0.0 ? -1.0 : 1.0, 0.0, 0.0}};
    }
    return {};
}

}  // namespace

bool can_walk(rig::ControlKind kind) {
    return kind == rig::ControlKind::Transform || kind == rig::ControlKind::Position;
}

glm::dvec3 walk_point(const Motion& motion, double ticks) {
    return glm::dvec3(motion.centre) +
           static_cast<double>(motion.radius) * step_at(motion.path, angle_after(motion, ticks)).at;
}

rig::Value walk_value(const RigWalk& walk, const rig::Value& now, double ticks) {
    const glm::dvec3 at = walk_point(walk.motion, ticks);
    const auto* pose = std::get_if<rig::Transform>(&now);
    if (!pose) return at;
    rig::Transform to{at, pose->rotation, pose->scale};
    if (walk.turn) {
        const glm::dvec3 along = step_at(walk.motion.path, angle_after(walk.motion, ticks)).along;
        const double half = 0.5 * math::arctangent(along.x, along.z);
        to.rotation = glm::dquat(math::cosine(half), 0.0, math::sine(half), 0.0);
    }
    return to;
}

// Ticks and background work of the Rig lab.

void keep_recording(Workspace& workspace, RigPart& part, const RigPart& before) {
    if (!part.take.recording || part.take.start == before.take.start || clip_room(before) == 0) return;
    const std::string lacks = keep_clip(part, before, before.take.last, rig_runtime(workspace));
    workspace.toast("That ended the recording: " + seconds_text(part.clip->frames() - 1) +
                    " are kept as the clip" + (lacks.empty() ? "" : "; " + lacks));
}

bool RigLab::moving(const Workspace& workspace) const {
    return time_moves(rig_part(workspace));
}

void RigLab::step(Workspace& workspace) const {
    const int due = workspace.clock.whole_ticks();
    if (due == 0) return;
    const bool modified = workspace.modified();
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    for (int i = 0; i < due; ++i) {
        if (part.take.recording && part.take.tick >= max_take_ticks) {
            const RigPart before = part;
            begin_take(part);
            keep_recording(workspace, part, before);
        }
        pass_tick(part, rig_runtime(workspace), workspace.clock.measured);
    }
    if (!modified) workspace.saved = workspace.document;  // playing does not modify the scene
}

std::uint64_t RigLab::tick_work(const Workspace& workspace) const {
    return rig_part(workspace).rig.work();
}

double RigLab::seconds(const Workspace& workspace) const {
    return static_cast<double>(rig_part(workspace).take.now()) * tick_seconds;
}

bool RigLab::working(const Workspace& workspace) const {
    const RigPart& part = rig_part(workspace);
    return (part.clip_left && part.clip_left->running) || (part.rates && part.rates->running);
}

void RigLab::work(Workspace& workspace) const {
    const bool modified = workspace.modified();
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    RigRuntime& runtime = rig_runtime(workspace);
    continue_clip_solve(part, runtime.workspace(part.rig));
    runtime.rates.advance(part);
    if (!modified) workspace.saved = workspace.document;
}

}  // namespace tendril::app
