#include "app/shell/card_watch.hpp"

#include <algorithm>

#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

/// Writing the state of a large part is slow: checks wait one tick for so many of its bytes.
constexpr std::size_t bytes_a_tick = 8192;
/// Larger parts are never checked.
constexpr std::size_t max_watched_bytes = 1u << 20;

constexpr const char* events_path = "events";

/// The value at a path, null if there is none.
Json value_at(const Json& state, const std::string& path) {
    const Json* const found = find_in_state(state, path);
    return found == nullptr ? Json(nullptr) : *found;
}

/// The tick of the newest event in the state, -1 if there is none.
double newest_event(const Json& state) {
    double newest = -1.0;
    for (const Json& each : value_at(state, "events"))
        newest = std::max(newest, value_at(each, "tick").get<double>());
    return newest;
}

/// Whether an event of the kind has occurred since the card was shown.
bool has_event(const CardProgress& progress, const Json& state, const std::string& kind) {
    const Json now = value_at(state, "time.moment"), events = value_at(state, "events");
    double last = progress.start.at(events_path)->get<double>();
    if (now.is_number() && now.get<double>() < last) last = -1.0;  // time was reset
    return std::any_of(events.begin(), events.end(), [&](const Json& each) {
        return value_at(each, "kind") == kind && value_at(each, "tick").get<double>() > last;
    });
}

bool holds(const CardCondition& condition, const CardProgress& progress, const Json& state) {
    using Kind = CardCondition::Kind;
    switch (condition.kind) {
        case Kind::Expected:
            return check_expectation(condition.expect, state).empty();
        case Kind::Changed: {
            const auto start = progress.start.find(condition.name);
            return start != progress.start.end() && value_at(state, condition.name) != *start->second;
        }
        case Kind::Noted:
            return has_event(progress, state, condition.name);
    }
    return false;
}

void begin(CardProgress& progress, const Card& card, const Json& state) {
    progress.done.assign(card.steps.size(), false);
    progress.start[events_path] = Json(newest_event(state));
    for (const CardStep& step : card.steps)
        for (const CardCondition& condition : step.when)
            if (condition.kind == CardCondition::Kind::Changed)
                progress.start[condition.name] = value_at(state, condition.name);
}

}  // namespace

void watch_card(CardProgress& progress, const Card& card, const std::shared_ptr<const Part>& part,
                const std::function<Json()>& state) {
    if (progress.ticks_to_wait > 0) --progress.ticks_to_wait;
    if (part->bytes() > max_watched_bytes) return;
    const bool fresh = progress.done.empty();
    if (!fresh && (!card_waits(progress, part) || progress.ticks_to_wait > 0)) return;
    const Json now = state();
    if (fresh) begin(progress, card, now);
    for (std::size_t i = 0; i < card.steps.size(); ++i) {
        if (progress.done[i]) continue;
        const auto& when = card.steps[i].when;
        progress.done[i] = std::all_of(when.begin(), when.end(), [&](const CardCondition& condition) {
            return holds(condition, progress, now);
        });
    }
    progress.seen = part;
    progress.ticks_to_wait = 1 + part->bytes() / bytes_a_tick;
}

bool card_waits(const CardProgress& progress, const std::shared_ptr<const Part>& part) {
    const bool all = std::all_of(progress.done.begin(), progress.done.end(), [](bool done) { return done; });
    return progress.seen != part && part->bytes() <= max_watched_bytes && (!all || progress.done.empty());
}

std::size_t current_step(const CardProgress& progress, const Card& card) {
    for (std::size_t i = 0; i < card.steps.size(); ++i)
        if (i >= progress.done.size() || !progress.done[i]) return i;
    return card.steps.size();
}

}  // namespace tendril::app
