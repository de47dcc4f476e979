#include <algorithm>
#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/document/runtime.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"

namespace tendril::app {
namespace {

/// If the step would change a lab that is not in view, shows that lab instead, says so and returns true.
bool waits(Workspace& workspace, bool back) {
    const std::string word = back ? "undo" : "redo", lab = workspace.history.next_lab(back);
    if (lab.empty() || lab == workspace.lab) return false;
    workspace.open_lab(lab);
    workspace.toast("The change to " + word + " is in the " + capitalised(lab) + " lab, now open. " +
                    capitalised(word) + " again to " + word + " it.");
    return true;
}

void step_through(Workspace& workspace, bool back, const Arguments& given) {
    if (given.has("ask") && given.boolean("ask") && waits(workspace, back)) return;
    Place place = workspace.place();
    place.moment = workspace.moment_id();
    auto document = back ? workspace.history.undo(workspace.document, &place)
                         : workspace.history.redo(workspace.document, &place);
    if (!document) throw Refused(back ? "nothing to undo" : "nothing to redo");
    // Show the lab in which the change was made.
    const std::string shown = workspace.lab;
    if (!place.lab.empty()) workspace.open_lab(place.lab);
    Rewind& rewind = workspace.rewind;
    if (!rewind.empty() && workspace.moment >= rewind.newest()) {  // keep the state before this step
        if (workspace.moment > rewind.newest()) workspace.remember_moment();
        ++workspace.moment;
    }
    workspace.clock.replaying = false;
    workspace.ui.incident.reset();
    const auto before = workspace.document.parts();
    workspace.document = std::move(*document);
    const auto parts = workspace.document.parts();
    // Opening a scene changes all labs; its name shows that, without a toast.
    std::vector<std::string> changed;
    for (const auto& [lab, part] : parts)
        if (const auto was = before.find(lab); was != before.end() && was->second != part)
            changed.push_back(lab);
    if (changed.size() == 1 && changed[0] != shown)
        workspace.toast(std::string(back ? "Undone" : "Redone") + " in the " + capitalised(changed[0]) +
                        " lab.");
    for (const auto& [lab, part] : parts) {
        if (auto instead = part->after_undo()) workspace.document.set(lab, std::move(instead));
    }
    if (place.openings) workspace.set_openings(*place.openings);
    if (place.path) workspace.path = *place.path;
    if (place.recovered) workspace.recovered = *place.recovered;
    if (place.camera) workspace.camera = *place.camera;
    if (const Rewind::Moment* then = place.moment ? rewind.find(*place.moment) : nullptr) {
        workspace.moment = then->tick;
        workspace.clock.tick = then->clock;
        workspace.edition = then->edition;
    } else if (!workspace.restore_later(parts.at(workspace.lab))) {
        workspace.discard_later(before.at(workspace.lab));
        workspace.begin_edition();
    }
}

void add_history_commands(CommandTable& table) {
    const Argument ask = switch_argument("ask", "true: only opens the lab of a change that is not in view");
    table.add("undo", "Undo", {ask},
              "Undoes the last change; a whole drag is one change. Keeps 1000 of them, in up to 256 MB",
              Effect::Replace, [](Workspace& w, const Arguments& a) { step_through(w, true, a); });
    table.add("paste", "Paste", {},
              "Pastes the clipboard's text into the lab. In a script, hold Ctrl and send the text instead",
              Effect::Look, [](Workspace& w, const Arguments&) { w.ui.pastes = true; });
    table.add("redo", "Redo", {ask}, "Redoes the last undone change", Effect::Replace,
              [](Workspace& w, const Arguments& a) { step_through(w, false, a); });
}

void seek(Workspace& w, const Arguments& given) {
    if (w.rewind.empty()) throw Refused("there is no earlier moment to go back to");
    w.ui.incident.reset();
    w.clock.replaying = false;
    w.go_to_moment(static_cast<std::uint64_t>(given.integer("ticks_back")));
}

void replay(Workspace& w) {
    w.pass_change();
    if (w.rewind.empty()) throw Refused("there is no earlier moment to replay");
    const std::uint64_t newest = std::max(w.rewind.newest(), w.moment);
    w.go_to_moment(w.moment == newest ? newest - w.rewind.oldest() : newest - w.moment);
    w.ui.incident.reset();
    w.clock.replaying = true;
    w.clock.replayed = w.moment;
}

/// Seeks to the moment after an incident and shows the moment before it on top.
void show_incident(Workspace& w, const Arguments& given) {
    if (!given.has("number")) return w.ui.incident.reset();
    w.pass_change();
    const auto& incidents = w.rewind.incidents();
    const auto number = static_cast<std::size_t>(given.integer("number"));
    if (number >= incidents.size())
        throw Refused("number must be less than " + std::to_string(incidents.size()) +
                      ", which is how many incidents are remembered, got " + std::to_string(number));
    const Incident incident = incidents[number];
    if (!w.rewind.empty()) {
        const std::uint64_t newest = std::max(w.rewind.newest(), w.moment);
        w.go_to_moment(newest - std::min(newest, incident.tick + 1));
    }
    w.clock.replaying = false;
    w.ui.incident = incident;
    w.ui.incident_chosen = true;
}

/// The fewest decimals that read back exactly, as the user would type them.
std::string plain(float value) {
    return number(value).dump();
}

void add_time_commands(CommandTable& table) {
    const auto add = [&](const char* name, const char* title, const char* help, auto change) {
        table.add(name, title, {}, help, Effect::Look,
                  [change](Workspace& w, const Arguments&) { change(w); });
    };
    const auto run = [](Workspace& w, bool playing) {
        w.clock.playing = playing;
        w.clock.looks_back = w.clock.replaying = false;
        if (playing) w.ui.incident.reset();
    };
    add("time.play", "Run the simulation", "Runs the simulation", [run](Workspace& w) { run(w, true); });
    add("time.pause", "Pause the simulation", "Pauses the simulation or the replay",
        [run](Workspace& w) { run(w, false); });
    add("time.toggle", "Run or pause the simulation", "Runs or pauses the simulation",
        [run](Workspace& w) { run(w, !w.clock.playing && !w.clock.replaying); });
    add("time.step", "Advance by one tick", "Pauses and advances by one tick of 1/60 s", [run](Workspace& w) {
        run(w, false);
        ++w.clock.steps_due;
    });
    table.add("time.speed", "Set the simulation's speed",
              {{.name = "factor",
                .help = "1 is real time; below 1 is slow motion",
                .low = slowest,
                .high = fastest,
                .present = [](const Workspace& w) { return plain(w.clock.speed); }}},
              "Sets the speed of the simulation", Effect::Look,
              [](Workspace& w, const Arguments& a) { w.clock.speed = a.number("factor"); });
    table.add(
        "time.seek", "Go back in time",
        {index_argument("ticks_back", true, "ticks of 1/60 s before the latest one", Rewind::max_ticks + 1)},
        "Pauses and goes back to an earlier moment, from which time continues. Going back past a change "
        "can be undone",
        Effect::Replace, seek);
    table.add("time.replay", "Replay the last ten seconds", {},
              "Replays the last ten seconds, from the moment shown or, if that is the latest, from the "
              "start",
              Effect::Replace, [](Workspace& w, const Arguments&) { replay(w); });
    table.add("time.incident", "Show when a joint jumped",
              {offering(index_argument("number", false,
                                       "which of the state's events, 0 is the oldest; default: none",
                                       Rewind::max_incidents),
                        [](const Workspace& w) { return places(w.rewind.incidents().size()); })},
              "Goes to a moment when a joint jumped, and shows the poses before and after it",
              Effect::Replace, show_incident);
}

/// A command for a setting with two values: sets the given one, or toggles if none is given.
template <class Choice>
Command either(const char* name, const char* title, const char* argument, std::vector<std::string> choices,
               const char* help, Choice Settings::*setting) {
    const std::string first = choices[0], second = choices[1];
    return {
        name,
        title,
        {{.name = argument,
          .type = ArgumentType::Text,
          .required = false,
          .help = "default: the other one",
          .choices = std::move(choices),
          .present = [first, second, setting](
                         const Workspace& w) { return w.settings.*setting == Choice{0} ? first : second; }}},
        help,
        Effect::Look,
        [argument, second, setting](Workspace& w, const Arguments& a) {
            Choice& value = w.settings.*setting;
            const bool to_second = a.has(argument) ? a.text(argument) == second : value == Choice{0};
            value = to_second ? Choice{1} : Choice{0};
        }};
}

/// The open lab, and its sections that were drawn.
std::vector<std::string> known_sections(const Workspace& w) {
    std::vector<std::string> names{w.lab};
    for (const std::string& each : w.runtimes.of<DrawnSections>("sections").names)
        if (each.starts_with(w.lab + ":")) names.push_back(each);
    return names;
}

void add_window_commands(CommandTable& table) {
    const auto toggle = [&](const char* name, const char* title, const char* help, auto member) {
        table.add(name, title, {switch_argument("open", "toggles if omitted")}, help, Effect::Look,
                  [member](Workspace& w, const Arguments& a) {
                      bool& open = member(w);
                      open = a.has("open") ? a.boolean("open") : !open;
                  });
    };
    toggle("view.help", "Show keys and mouse", "Shows the keys and mouse actions",
           [](Workspace& w) -> bool& { return w.ui.help; });
    toggle("view.palette", "Find a command", "Finds a command by its name",
           [](Workspace& w) -> bool& { return w.ui.palette; });
    toggle("view.settings", "Show the settings", "Shows the settings",
           [](Workspace& w) -> bool& { return w.ui.settings; });

    table.add("view.panels", "Show or hide the side panels",
              {switch_argument("left", "the lab's panel"), switch_argument("right", "the inspector")},
              "Shows or hides the side panels", Effect::Look, [](Workspace& w, const Arguments& a) {
                  Settings& s = w.settings;
                  const bool toggle_both = !a.has("left") && !a.has("right");
                  const bool open = !(s.left_open || s.right_open);
                  if (toggle_both) s.left_open = s.right_open = open;
                  if (a.has("left")) s.left_open = a.boolean("left");
                  if (a.has("right")) s.right_open = a.boolean("right");
              });
    table.add("view.panel_width", "Set a side panel's width",
              {choice_argument("side", true, "which panel", {"left", "right"}),
               {.name = "width", .help = "unscaled pixels", .low = 180, .high = 520}},
              "Makes a side panel wider or narrower", Effect::Look, [](Workspace& w, const Arguments& a) {
                  (a.text("side") == "left" ? w.settings.left_width : w.settings.right_width) =
                      a.number("width");
              });
    table.add(either("view.theme", "Switch between light and dark", "name", {"dark", "light"},
                     "Dark or light", &Settings::theme));
    table.add(either("view.labels", "Show labels always or on hover", "show", {"hover", "always"},
                     "Shows labels on hover, or always", &Settings::labels));
    table.add("view.fold", "Fold or unfold a section",
              {offering(text_argument("section", true, "lab and title; a lab alone: all of its sections"),
                        known_sections),
               {.name = "folded", .type = ArgumentType::Boolean, .help = "true: only the title shows"}},
              "Folds a section of a panel, or unfolds it", Effect::Look,
              [](Workspace& w, const Arguments& a) {
                  set_folded(w.settings, a.text("section"), a.boolean("folded"));
              });
    table.add("view.text_scale", "Set the text size",
              {{.name = "scale",
                .help = "1 is the system's own size",
                .low = 0.5,
                .high = 3.0,
                .present = [](const Workspace& w) { return plain(w.settings.text_scale); }}},
              "Size of text and widgets", Effect::Look,
              [](Workspace& w, const Arguments& a) { w.settings.text_scale = a.number("scale"); });
}

}  // namespace

void add_workspace_commands(CommandTable& table) {
    add_history_commands(table);
    add_scene_commands(table);
    add_time_commands(table);
    add_window_commands(table);
    table.add("lab.open", "Open a lab",
              {{.name = "name",
                .type = ArgumentType::Text,
                .help = "a name that --list-labs prints",
                .known =
                    [](const Workspace& w) {
                        std::vector<std::string> names;
                        for (const auto& [name, part] : w.document.parts()) names.push_back(name);
                        return names;
                    },
                .present = [](const Workspace& w) { return w.lab; }}},
              "Opens a lab", Effect::Look, [](Workspace& w, const Arguments& a) {
                  const std::string name = a.text("name");
                  if (!w.document.parts().contains(name)) throw Refused("there is no lab \"" + name + "\"");
                  w.open_lab(name);
              });
}

}  // namespace tendril::app
