// The rig as a whole: emptied, solved, put in the place of another.
#include <stdexcept>
#include <tendril/rig/backward.hpp>

#include "app/document/units.hpp"
#include "app/labs/kit/names.hpp"
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

void select(RigPart& part, const Arguments& given) {
    RigSelection selected;
    if (given.has("element")) selected.element = given.text("element");
    if (given.has("unit")) selected.unit = given.text("unit");
    if (!selected.element.empty()) element_named(part, selected.element);
    if (!selected.unit.empty()) unit_named(part, selected.unit);
    selected.unit_last =
        !selected.unit.empty() && (selected.element.empty() || selected.unit != part.selected.unit);
    part.selected = std::move(selected);
}

/// Reading changes no answer, but works out and stores what is pending, which shows: so it is done to the
/// part itself.
void read(Workspace& workspace, const Arguments& given) {
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    const std::string name = given.text("name");
    const rig::ElementId id = part.rig.id(element_named(part, name));
    const std::uint64_t before = part.state.elements.recomputations();
    part.state.elements.get(id, rig::Space::Global);
    part.state.elements.get(id, rig::Space::Local);
    const auto count = static_cast<std::size_t>(part.state.elements.recomputations() - before);
    workspace.toast("Reading " + name + ": " +
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
    constexpr std::uint64_t most_work = 40'000'000;  // a second or so
    const rig::BackwardReport report =
        rig::solve_backward(part.rig, part.state, scratch, {.max_work = most_work});
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

Argument json_argument(const char* name, bool required, const char* help) {
    return {.name = name, .type = ArgumentType::Any, .required = required, .help = help};
}

void add_solve_commands(CommandTable& table) {
    table.add(rig_command("rig.clear", "Remove everything from the rig", {},
                          "Removes every element, curve and unit", clear));
    table.add(rig_command("rig.reset", "Reset the Rig lab", {}, "Resets this lab to its first state", reset));
    table.add(part_command<RigPart>(rig_lab, "rig.select", "Select an element or unit",
                                    {element_argument("element", false, "none where left out"),
                                     unit_argument("unit", false, "none where left out")},
                                    "Selects an element, a unit, or one of each", select, Effect::Look));
    table.add({.name = "rig.read",
               .title = "Read an element's pose",
               .arguments = {element_argument("name", true, "of the element")},
               .help = "Reads an element's pose, and says how many transforms had to be worked out for it",
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
