// Units: added, changed, removed, switched off and on.
#include "app/document/json_complete.hpp"
#include "app/labs/rig/rig_commands.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/unit_json.hpp"

namespace tendril::app {
namespace {

Argument unit_name_argument(bool required) {
    return unit_argument("name", required, "of the unit");
}

/// All but its place is the unit as a scene file has it.
void add(RigPart& part, const Arguments& given) {
    Json unit = given.json();
    unit.erase("at");
    add_unit(part, read_unit(JsonPlace(unit, "")), given.has("at") ? given.integer("at") : -1);
}

/// What is not given stays, also within a part of an aim and within a filter.
void set(RigPart& part, const Arguments& given) {
    const rig::Unit& now = unit_named(part, given.text("name"));
    Json unit = unit_json(now), changes = given.json();
    for (const char* nested : {"primary", "secondary", "filter"}) {
        if (!changes.contains(nested) || !changes[nested].is_object() || !unit.contains(nested)) continue;
        if (unit[nested].is_object())
            unit[nested].update(changes[nested]);
        else
            unit[nested] = changes[nested];
        changes.erase(nested);
    }
    unit.update(changes);
    set_unit(part, now.name, read_unit(JsonPlace(unit, "")));
}

void remove_unit(RigPart& part, const Arguments& given) {
    remove_unit(part, given.text("name"));
}

void move(RigPart& part, const Arguments& given) {
    move_unit(part, given.text("name"), given.integer("at"));
}

void enable(RigPart& part, const Arguments& given) {
    enable_unit(part, given.text("name"), given.boolean("on"));
}

/// And then all that a unit may have.
std::vector<Argument> unit_arguments(std::vector<Argument> arguments) {
    for (const std::string& each : unit_members())
        arguments.push_back(json_argument(each.c_str(), false, "as the unit has it"));
    return arguments;
}

}  // namespace

void add_unit_commands(CommandTable& table) {
    table.add(rig_command(
        "rig.unit.add", "Add a unit",
        unit_arguments({choice_argument("unit", true, "its operation", operation_names()),
                        text_argument("name", false, "one of its own; after its operation where left out"),
                        integer_argument("at", "its place among the units; at the end where left out", 0,
                                         static_cast<double>(max_lab_units))}),
        "Adds a unit with its inputs: literals, outputs of units before it, elements", add));
    table.add(rig_command("rig.unit.set", "Change a unit's inputs",
                          unit_arguments({unit_name_argument(true)}),
                          "Changes inputs of a unit; those that are not given stay", set));
    table.add(rig_command("rig.unit.remove", "Remove a unit", {unit_name_argument(true)},
                          "Removes a unit from which no other takes an output", remove_unit));
    table.add(rig_command("rig.unit.move", "Move a unit in the order",
                          {unit_name_argument(true),
                           {.name = "at",
                            .type = ArgumentType::Integer,
                            .help = "its new place among the units of the rig, or of the body that it is in",
                            .low = 0,
                            .high = static_cast<double>(max_lab_units)}},
                          "Moves a unit, so that it runs earlier or later", move));
    table.add(rig_command("rig.unit.enable", "Switch a unit on or off",
                          {unit_name_argument(true), {.name = "on", .type = ArgumentType::Boolean}},
                          "Switches a unit off or on", enable));
}

}  // namespace tendril::app
