#include "app/shell/card_watch.hpp"

#include <algorithm>

#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

/// Writing the state of a large part is slow: checks wait one tick for so many of its bytes.
constexpr std::size_t bytes_a_tick = 8192;
/// Larger parts are never checked.
constexpr std::size_t max_watched_bytes = 1u << 20;

/// Whether the command is the one in the line, with the arguments that matter.
bool matches(const CardLine& line, const std::string& command, const Json& arguments) {
    if (line.command != command) return false;
    const auto& wanted = line.arguments->items();
    return std::all_of(wanted.begin(), wanted.end(), [&](const auto& each) {
        const auto given = arguments.find(each.key());
        return given != arguments.end() && (each.value().is_null() || *given == each.value());
    });
}

bool holds(const CardCondition& condition, std::uint64_t tried, const Json& state) {
    using Kind = CardCondition::Kind;
    switch (condition.kind) {
        case Kind::Expected:
            return check_expectation(condition.expect, state).empty();
        case Kind::Present:
            return find_in_state(state, condition.name) != nullptr;
        case Kind::Noted: {
            const Json& events = state.at("events");
            return std::any_of(events.begin(), events.end(), [&](const Json& each) {
                return each.at("kind") == condition.name && each.at("tick").get<std::uint64_t>() >= tried;
            });
        }
    }
    return false;
}

/// Whether the step waits only for its conditions.
bool pending(const CardProgress& progress, std::size_t step) {
    return !progress.done[step] && progress.tried[step];
}

}  // namespace

void note_command(CardProgress& progress, const Card& card, const std::string& command, const Json& arguments,
                  bool changes, std::uint64_t moment, bool in_panel) {
    progress.done.resize(card.steps.size());
    progress.tried.resize(card.steps.size());
    for (std::size_t i = 0; i < card.steps.size(); ++i) {
        const CardStep& step = card.steps[i];
        auto& tried = progress.tried[i];
        const bool by_hand = !in_panel || step.place != CardStep::Place::Handle;
        const bool is_it = by_hand && std::any_of(step.by.begin(), step.by.end(), [&](const CardLine& line) {
                               return matches(line, command, arguments);
                           });
        if (is_it) {
            tried = tried.value_or(moment);
            if (step.when.empty()) progress.done[i] = true;
            progress.seen = nullptr;
        } else if (changes) {
            tried.reset();
        }
    }
}

void watch_card(CardProgress& progress, const Card& card, const std::shared_ptr<const Part>& part,
                const std::function<Json()>& state) {
    if (progress.ticks_to_wait > 0) --progress.ticks_to_wait;
    if (!card_waits(progress, part) || progress.ticks_to_wait > 0) return;
    const Json now = state();
    for (std::size_t i = 0; i < card.steps.size(); ++i) {
        if (!pending(progress, i)) continue;
        const auto& when = card.steps[i].when;
        progress.done[i] = std::all_of(when.begin(), when.end(), [&](const CardCondition& condition) {
            return holds(condition, *progress.tried[i], now);
        });
    }
    progress.seen = part;
    progress.ticks_to_wait = 1 + part->bytes() / bytes_a_tick;
}

bool card_waits(const CardProgress& progress, const std::shared_ptr<const Part>& part) {
    if (progress.seen == part || part->bytes() > max_watched_bytes) return false;
    for (std::size_t i = 0; i < progress.done.size(); ++i)
        if (pending(progress, i)) return true;
    return false;
}

std::size_t current_step(const CardProgress& progress, const Card& card) {
    for (std::size_t i = 0; i < card.steps.size(); ++i)
        if (i >= progress.done.size() || !progress.done[i]) return i;
    return card.steps.size();
}

}  // namespace tendril::app
