// The rig as a whole: emptied, solved, put in the place of another.
#include <algorithm>
#include <stdexcept>
#include <tendril/rig/backward.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/names.hpp"
#include "app/document/refused.hpp"
#include "app/document/units.hpp"
#include "app/labs/kit/index_list.hpp"
#include "app/labs/kit/name_list.hpp"
#include "app/labs/kit/part_command.hpp"
#include "app/labs/rig/code.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_commands.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/take.hpp"

namespace tendril::app {
namespace {

void clear(RigPart& part, const Arguments&) {
    part = RigPart();
}

void reset(RigPart& part, const Arguments&) {
    part = first_rig();
}

void select_elements(const RigPart& part, Selection& elements, const Arguments& given, bool add) {
    if (!gives_one(given, "element", "elements"))
        return elements.take(element_list(part, given, "elements"), add);
    const std::string name = given.text("element");
    if (name.empty()) return;
    const std::size_t at = element_named(part, name);
    add ? elements.toggle(at) : elements.only(at);
}

void select(RigPart& part, const Arguments& given) {
    const bool add = given.has("add") && given.boolean("add");
    const bool gives_elements = given.has("element") || given.has("elements");
    RigSelection selected = add ? part.selected : RigSelection();
    if (gives_elements) select_elements(part, selected.elements, given, add);
    if (given.has("unit")) selected.unit = given.text("unit");
    if (!selected.unit.empty()) unit_named(part, selected.unit);
    const bool chosen = selected.unit != part.selected.unit || selected.elements.empty();
    const bool stays = !gives_elements && (given.has("unit") || selected.unit_last);
    selected.unit_last = !selected.unit.empty() && (chosen || stays);
    part.selected = std::move(selected);
}

/// Reading changes no answer, but works out and stores what is pending, which shows: so it is done to the
/// part itself.
void read(Workspace& workspace, const Arguments& given) {
    const std::vector<std::size_t> elements = elements_given(rig_part(workspace), given);
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    const std::uint64_t before = part.state.elements.recomputations();
    for (const std::size_t each : elements) {
        part.state.elements.get(part.rig.id(each), rig::Space::Global);
        part.state.elements.get(part.rig.id(each), rig::Space::Local);
    }
    const auto count = static_cast<std::size_t>(part.state.elements.recomputations() - before);
    const std::string what = elements.size() == 1 ? part.rig.definition().elements[elements.front()].name
                                                  : count_text(elements.size(), "element");
    workspace.toast("Reading " + what + ": " +
                    (count == 0 ? "nothing was pending" : count_text(count, "transform") + " worked out"));
}

void copy(Workspace& workspace, const Arguments&) {
    workspace.ui.copied = rig_code(rig_part(workspace));
    workspace.toast("The rig is on the clipboard as C++");
}

void take_preset(Workspace& workspace, const Arguments& given) {
    const RigPreset& preset = rig_preset(given.text("name"));
    // Where that is open nothing is changed: a recording begins with a scene file, which cannot tell.
    change_part<RigPart>(workspace, rig_lab,
                         [&](RigPart& part, const RigPart&) { part = RigPart(preset.make()); });
    (workspace.lab == rig_lab ? workspace.camera : workspace.cameras[rig_lab]) = preset.view;
}

BackwardLeft solve_backward(RigPart& part, rig::Workspace& scratch) {
    constexpr std::uint64_t max_work = 40'000'000;  // a second or so
    const rig::BackwardReport report =
        rig::solve_backward(part.rig, part.state, scratch, {.max_work = max_work});
    if (report.stopped && report.iterations == 0)
        throw std::invalid_argument(
            "the rig is so large, and has so many controls, that a backward solve would take too long");
    BackwardLeft left{{}, report.elements, report.stopped};
    if (report.worst) left.bone = part.rig.definition().elements[*report.worst].name;
    return left;
}

/// No time passes. What was changed before is still to be seen by what remembers: the next tick solves too.
void solve(Workspace& workspace, const Arguments& given) {
    auto& runtime = workspace.runtimes.of<RigRuntime>(rig_lab);
    const bool backward = given.has("direction") && given.text("direction") == "backward";
    change_part<RigPart>(workspace, rig_lab, [&](RigPart& part, const RigPart& before) {
        if (backward) {
            part.backward = solve_backward(part, runtime.workspace(part.rig));
            part.moving = true;
            if (!part.last_solved) part.last_solved = std::make_shared<const rig::State>(before.state);
            if (part.state != before.state) begin_take(part);
        } else {
            solve_now(part, runtime, workspace.clock.measured);
        }
    });
}

}  // namespace

Command rig_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                    void (*change)(RigPart&, const Arguments&)) {
    return part_command<RigPart>(rig_lab, name, title, std::move(arguments), help, change);
}

Argument element_argument(const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [](const Workspace& w) {
        return names(rig_part(w).rig.definition().elements,
                     [](const rig::Element& each) { return each.name; });
    });
}

Argument control_argument(const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [](const Workspace& w) {
        std::vector<std::string> list;
        for (const rig::Element& each : rig_part(w).rig.definition().elements)
            if (each.kind == rig::ElementKind::Control) list.push_back(each.name);
        return list;
    });
}

Argument unit_argument(const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [](const Workspace& w) {
        return names(rig_part(w).rig.unit_names(), [](const std::string& each) { return each; });
    });
}

std::vector<std::size_t> element_list(const RigPart& part, const Arguments& given, const char* name) {
    std::vector<std::size_t> elements;
    for (const std::string& each : name_list(given, name)) {
        const auto at = part.rig.element(each);
        if (!at) throw Refused(std::string(name) + ": there is no element " + json_summary(each));
        elements.push_back(*at);
    }
    return elements;
}

std::vector<std::size_t> elements_given(const RigPart& part, const Arguments& given) {
    if (gives_one(given, "name", "names")) return {element_named(part, given.text("name"))};
    std::vector<std::size_t> elements = element_list(part, given, "names");
    if (elements.empty()) throw Refused("names: [] has no element in it");
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    return elements;
}

Argument json_argument(const char* name, bool required, const char* help) {
    return {.name = name, .type = ArgumentType::Any, .required = required, .help = help};
}

void add_solve_commands(CommandTable& table) {
    table.add(rig_command("rig.clear", "Remove everything from the rig", {},
                          "Removes every element, curve and unit", clear));
    table.add(rig_command("rig.reset", "Reset the Rig lab", {}, "Resets this lab to its first state", reset));
    table.add(part_command<RigPart>(
        rig_lab, "rig.select", "Select elements or a unit",
        {element_argument("element", false, "none where left out"),
         name_list_argument("elements", "element", "; the last one is shown"),
         unit_argument("unit", false, "none where left out"),
         switch_argument("add",
                         "true: adds to what is selected, or with element takes out what is; the "
                         "unit stays where left out")},
        "Selects elements, a unit, or both", select, Effect::Look));
    table.add({.name = "rig.read",
               .title = "Read the pose of elements",
               .arguments = {element_argument("name", false, "of the element"),
                             name_list_argument("names", "name")},
               .help = "Reads the poses of elements, and says how many transforms had to be worked out",
               .effect = Effect::Look,
               .apply = read});
    table.add({.name = "rig.copy",
               .title = "Copy the rig as C++",
               .arguments = {},
               .help = "Puts the rig on the clipboard, as a C++ program against the library",
               .effect = Effect::Look,
               .apply = copy});
    table.add(
        {.name = "rig.preset",
         .title = "Open a rig preset",
         .arguments = {choice_argument("name", true, "which scene",
                                       names(rig_presets(), [](const auto& each) { return each.name; }))},
         .help = "Opens a preset",
         .effect = Effect::Edit,
         .apply = take_preset});
    table.add({.name = "rig.solve",
               .title = "Solve the rig",
               .arguments = {choice_argument("direction", false, "forward where left out",
                                             {"forward", "backward"})},
               .help = "Runs the units, or sets the controls from the bones as they are; no time passes",
               .effect = Effect::Edit,
               .apply = solve});
}

}  // namespace tendril::app
