#include "app/shell/card_watch.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/flips.hpp"

namespace tendril::app {
namespace {

/// Writing the state of a large part is slow: checks wait one tick per this many bytes.
constexpr std::size_t bytes_per_tick = 8192;
/// Larger parts are never checked.
constexpr std::size_t max_watched_bytes = 1u << 20;

/// Whether the command is the line's, with the arguments that matter.
bool matches(const CardLine& line, const std::string& command, const Json& arguments) {
    if (line.command != command) return false;
    const auto& wanted = line.arguments->items();
    return std::all_of(wanted.begin(), wanted.end(), [&](const auto& each) {
        const auto given = arguments.find(each.key());
        return given != arguments.end() && (each.value().is_null() || *given == each.value());
    });
}

const CardCondition* avoided(const CardStep& step) {
    const auto found = std::find_if(step.when.begin(), step.when.end(), [](const CardCondition& each) {
        return each.kind == CardCondition::Kind::Avoided;
    });
    return found == step.when.end() ? nullptr : &*found;
}

/// The position that the command moved something to: the argument that is null in the line.
std::optional<glm::vec3> moved_to(const CardLine& line, const Json& arguments) {
    for (const auto& [key, value] : line.arguments->items()) {
        const auto given = arguments.find(key);
        if (value.is_null() && given != arguments.end() && given->is_array() && given->size() == 3)
            return glm::vec3(given->at(0).get<float>(), given->at(1).get<float>(), given->at(2).get<float>());
    }
    return std::nullopt;
}

void note_drag(RepeatedDrag& drag, glm::vec3 to, std::uint64_t moment) {
    constexpr std::size_t max_points = 4096;
    if (drag.path.size() >= max_points)
        drag.path.erase(drag.path.begin(), drag.path.begin() + max_points / 2);
    drag.path.push_back({moment, to});
}

/// Whether the incident is the one that was cured: at the same joint, or for the same reason.
bool recurs(const RepeatedDrag& drag, const Json& incident) {
    const auto same = [&](const char* member) {
        return drag.incident->value(member, Json()) == incident.value(member, Json());
    };
    return same("joint") || same("cause");
}

/// Records where the drag was when it last caused an incident of that kind. After the cure, another joint may
/// jump for a different reason, such as a jump of the mouse: the drag then restarts there.
void note_incident(RepeatedDrag& drag, const std::string& kind, const Json& events) {
    for (const Json& each : events) {
        const auto moment = each.at("tick").get<std::uint64_t>();
        if (each.at("kind") != kind || (drag.caused && moment <= *drag.caused)) continue;
        for (std::size_t i = 1; i < drag.path.size(); ++i) {
            const RepeatedDrag::Point last = drag.path[i - 1], here = drag.path[i];
            if (here.moment != moment || here.at == last.at) continue;
            drag.caused = moment;
            if (drag.cured && !recurs(drag, each)) {
                drag.path.erase(drag.path.begin(), drag.path.begin() + static_cast<std::ptrdiff_t>(i));
                break;
            }
            drag.cured = false;
            drag.incident = each;
            drag.place = here.at;
            drag.direction = glm::normalize(here.at - last.at);
        }
    }
}

/// Whether the cured drag has crossed the place where it caused the incident.
bool passed_again(const RepeatedDrag& drag, float within) {
    if (!drag.cured) return false;
    float side = 0.0f;       // the side on which it was, well away from the place
    bool came_near = false;  // since it was on that side
    for (std::size_t i = 0; i < drag.path.size(); ++i) {
        const glm::vec3 here = drag.path[i].at, last = drag.path[i > 0 ? i - 1 : 0].at;
        came_near = came_near || distance_to(drag.place, last, here) <= within;
        const float along = glm::dot(here - drag.place, drag.direction);
        if (std::abs(along) < 0.5f * within) continue;
        if (came_near && side * along < 0.0f) return true;
        side = along;
        came_near = false;
    }
    return false;
}

bool holds(const CardCondition& condition, std::uint64_t tried, const RepeatedDrag& drag, const Json& state) {
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
        case Kind::Avoided:
            return passed_again(drag, condition.within);
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
    progress.drags.resize(card.steps.size());
    for (std::size_t i = 0; i < card.steps.size(); ++i) {
        const CardStep& step = card.steps[i];
        auto& tried = progress.tried[i];
        const bool by_hand = !in_panel || step.place != CardStep::Place::Handle;
        const auto line = std::find_if(step.by.begin(), step.by.end(), [&](const CardLine& each) {
            return by_hand && matches(each, command, arguments);
        });
        const CardCondition* const cure = avoided(step);
        RepeatedDrag& drag = progress.drags[i];
        if (cure != nullptr && line != step.by.end()) {
            if (const auto to = moved_to(*line, arguments)) note_drag(drag, *to, moment);
        } else if (cure != nullptr && changes) {
            drag.path.clear();
            drag.cured = drag.caused && command == cure->cure;
        }
        if (line != step.by.end()) {
            tried = tried.value_or(moment);
            if (step.when.empty()) progress.done[i] = true;
            progress.seen = nullptr;
        } else if (changes) {
            tried.reset();
        }
    }
}

void watch_card(CardProgress& progress, const Card& card, const std::shared_ptr<const Part>& part,
                const std::function<Json()>& state, bool dragging) {
    if (progress.ticks_to_wait > 0) --progress.ticks_to_wait;
    if (!card_waits(progress, part) || progress.ticks_to_wait > 0) return;
    const Json now = state();
    bool undecided = false;
    for (std::size_t i = 0; i < card.steps.size(); ++i) {
        if (!pending(progress, i)) continue;
        const auto& when = card.steps[i].when;
        RepeatedDrag& drag = progress.drags[i];
        if (const CardCondition* const cure = avoided(card.steps[i]))
            note_incident(drag, cure->name, now.at("events"));
        if (dragging && drag.cured) {
            undecided = true;  // the rest of the drag may still cause it
            continue;
        }
        progress.done[i] = std::all_of(when.begin(), when.end(), [&](const CardCondition& condition) {
            return holds(condition, *progress.tried[i], drag, now);
        });
    }
    progress.seen = undecided ? nullptr : part;
    progress.ticks_to_wait = 1 + part->bytes() / bytes_per_tick;
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
