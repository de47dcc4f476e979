// How a tick passes: a simulation step, a change by hand, or a replay of the last seconds.
#include <algorithm>
#include <utility>

#include "app/app.hpp"
#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"

namespace tendril::app {

/// Drops the incidents of a chain or rig that no longer exists.
void App::drop_incidents(const Part& before) {
    if (workspace_.rewind.incidents().empty() ||
        lab().same_joints(before, *workspace_.document.parts().at(workspace_.lab)))
        return;
    workspace_.rewind.forget_incidents();
    workspace_.ui.incident.reset();
}

/// Notes the open lab's incidents in a change or tick.
void App::review(const std::shared_ptr<const Part>& before, std::uint64_t moment) {
    const auto& after = workspace_.document.parts().at(workspace_.lab);
    if (before == after) return;
    for (Incident& incident : lab().review(workspace_, *before, *after)) {
        incident.tick = moment;
        workspace_.rewind.note(std::move(incident));
    }
}

/// Called only for the user's actions: a script knows what it requested.
void App::note_refusal(const std::string& why) {
    workspace_.rewind.note({.tick = workspace_.moment, .cause = "refused: " + why});
}

std::optional<App::Opening> App::end_opening() {
    if (workspace_.openings.erase(workspace_.lab) == 0) return std::nullopt;
    Opening before{workspace_.document, workspace_.saved, workspace_.rewind, workspace_.edition};
    const std::vector<CommandCall> calls = lab().calm();
    if (calls.empty()) return before;
    const History history = workspace_.history;
    for (const CommandCall& call : calls) {
        try {
            commands_->run(workspace_, call.name, to_json(call.arguments));
        } catch (const Refused&) {
            continue;  // there is nothing left to stop
        }
    }
    workspace_.history = history;
    workspace_.saved.set(workspace_.lab, workspace_.document.parts().at(workspace_.lab));
    workspace_.rewind.clear();
    return before;
}

void App::resume(Opening opening) {
    workspace_.document = std::move(opening.document);
    workspace_.saved = std::move(opening.saved);
    workspace_.rewind = std::move(opening.rewind);
    workspace_.edition = opening.edition;
    workspace_.openings.insert(workspace_.lab);
}

void App::step_lab() {
    Clock& clock = workspace_.clock;
    if (!lab().moving(workspace_)) {
        workspace_.pass_change();
    } else {
        // One moment per tick: the part before any change by hand.
        if (workspace_.rewind.changed()) {
            workspace_.rewind.remember_change(workspace_.moment, clock.tick);
        } else {
            workspace_.remember_moment();
        }
        ++workspace_.moment;
        const auto before = workspace_.document.parts().at(workspace_.lab);
        lab().step(workspace_);
        if (workspace_.openings.contains(workspace_.lab))
            workspace_.saved.set(workspace_.lab, workspace_.document.parts().at(workspace_.lab));
        review(before, workspace_.moment - 1);
    }
    ++clock.tick;
    clock.passed += static_cast<double>(clock.speed);
    clock.steps_due = std::max(0, clock.steps_due - 1);
}

/// Advances by the clock's speed to the nearest remembered moment.
void App::replay() {
    Clock& clock = workspace_.clock;
    const Rewind& rewind = workspace_.rewind;
    if (rewind.empty()) {
        clock.replaying = false;
        return;
    }
    clock.replayed += static_cast<std::uint64_t>(clock.whole_ticks());
    clock.passed += static_cast<double>(clock.speed);
    const std::uint64_t newest = rewind.newest();
    const std::uint64_t to = std::min(newest, clock.replayed);
    workspace_.go_to_moment(newest - to);
    if (to == newest) clock.replaying = false;
}

void App::advance_time() {
    const Clock& clock = workspace_.clock;
    if (clock.replaying) {
        replay();
    } else if (clock.steps_due > 0 || (clock.playing && lab().moving(workspace_))) {
        step_lab();
    } else {
        workspace_.pass_change();
    }
    while (clock.steps_due > 0) step_lab();
    if (lab().working(workspace_)) {
        const auto before = workspace_.document.parts().at(workspace_.lab);
        lab().work(workspace_);
        if (workspace_.document.parts().at(workspace_.lab) != before) {
            workspace_.openings.erase(workspace_.lab);
            drop_incidents(*before);
        }
    }
    pass_video();
    watch_shown_card();
    auto& toasts = workspace_.ui.toasts;
    for (Toast& toast : toasts) --toast.ticks_left;
    std::erase_if(toasts, [](const Toast& toast) { return toast.ticks_left <= 0; });
}

}  // namespace tendril::app
