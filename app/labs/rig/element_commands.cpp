// Commands that add, set and remove elements, named curves and units.
#include <algorithm>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/rig_commands.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/take.hpp"
#include "app/labs/rig/values.hpp"

namespace tendril::app {
namespace {

Argument curve_argument() {
    return offering(text_argument("name", true, "of the curve"), [](const Workspace& w) {
        return names(rig_part(w).rig.definition().curves,
                     [](const rig::NamedCurve& each) { return each.name; });
    });
}

void add_element(RigPart& part, const Arguments& given) {
    rig::Definition definition = part.rig.definition();
    definition.elements.push_back(read_element(JsonPlace(given.json(), "")));
    redefine(part, std::move(definition));
}

/// The input pose, without what units did to a bone or null.
rig::Transform input_pose(RigPart& part, std::size_t at, rig::Space space) {
    const bool control = part.rig.definition().elements[at].control.has_value();
    if (!control && space == rig::Space::Global) return part.rig.start_pose(part.state, at);
    return part.state.edit().elements.get(part.rig.id(at), space,
                                          control ? rig::Pose::Current : rig::Pose::Input);
}

/// A value to set, with its JSON path in the command.
struct WantedValue {
    std::size_t element;  ///< index in the definition
    JsonPlace value;
};

/// One value for all elements, from argument `one`, or one per element, from `each`. In definition order.
std::vector<WantedValue> wanted_values(const RigPart& part, const Arguments& given, const char* one,
                                       const char* each) {
    std::vector<WantedValue> wanted;
    if (gives_one(given, one, each)) {
        for (const std::size_t at : elements_given(part, given))
            wanted.push_back({at, {given.json(one), one}});
        return wanted;
    }
    const std::size_t count = elements_given(part, given).size();
    if (given.has("names") && given.json("names").size() != count)
        throw Refused("names: list each once, as each has its own value");
    const JsonPlace values = each_list(given, each, "names", count);
    for (const std::size_t at : element_list(part, given, "names"))
        wanted.push_back({at, values.element(wanted.size())});
    std::ranges::sort(wanted, {}, &WantedValue::element);
    return wanted;
}

/// Members omitted from a transform keep their value. Sets parents first, because they move their children.
void set_elements(RigPart& part, const Arguments& given) {
    const std::vector<WantedValue> elements = wanted_values(part, given, "transform", "transforms");
    const rig::Space space =
        given.has("space") && given.text("space") == "global" ? rig::Space::Global : rig::Space::Local;
    const bool propagate = !given.has("propagate") || given.boolean("propagate");
    const SharedState before = part.state;
    for (const std::size_t at : from_the_roots(part.rig, before->elements)) {
        const auto each = std::ranges::lower_bound(elements, at, {}, &WantedValue::element);
        if (each == elements.end() || each->element != at) continue;
        const rig::Transform now = input_pose(part, at, space);
        const Json wanted = filled(each->value.json(), transform_json(now));
        require_ok(part.rig.set_element(part.state.edit(), at, space,
                                        read_transform({wanted, each->value.where()}, now),
                                        propagate ? rig::Propagate::Yes : rig::Propagate::No));
    }
    if (part.state != before) changed(part);
}

/// Removes the elements or the unit, whichever was selected last.
void remove_selected(RigPart& part, const Arguments&) {
    const RigSelection selected = part.selected;
    if (selected.unit_last)
        remove_unit(part, selected.unit);
    else if (!selected.elements.empty())
        remove_elements(part, selected.elements.all());
    else
        throw Refused("nothing is selected");
}

const rig::Element& control_at(const RigPart& part, std::size_t at) {
    const rig::Element& element = part.rig.definition().elements[at];
    if (!element.control) throw std::invalid_argument("\"" + element.name + "\" is not a control");
    return element;
}

struct ControlValue {
    std::size_t element;  ///< index in the definition
    rig::Value value;
};

/// The values that would change their control, in the given order.
std::vector<ControlValue> differing(const RigPart& part, std::vector<ControlValue> values) {
    rig::State after = part.state;
    for (const ControlValue& each : values) require_ok(part.rig.set_control(after, each.element, each.value));
    std::erase_if(values, [&](const ControlValue& each) {
        return after.controls[each.element] == part.state->controls[each.element];
    });
    return values;
}

/// Sets values. Skips a control that already has its value, since units may have moved it.
void set_values(RigPart& part, std::vector<ControlValue> values) {
    constexpr std::size_t max_keys_at_once = 64;  // each one copies all keys
    values = differing(part, std::move(values));
    if (values.empty()) return;
    if (!part.last_solved) part.last_solved = part.state.share();
    std::vector<bool> is_set(part.state->controls.size());
    for (const ControlValue& each : values) {
        require_ok(part.rig.set_control(part.state.edit(), each.element, each.value));
        is_set[each.element] = true;
    }
    part.moving = true;
    part.backward.reset();
    part.rates.reset();
    // Setting a control ends its walk, which starts a new take. Otherwise the take records the value.
    const bool walked = std::erase_if(part.walks, [&](const RigWalk& walk) {
                            const auto at = part.rig.element(walk.control);
                            return at && is_set[*at];
                        }) > 0;
    if (walked || values.size() > max_keys_at_once) return begin_take(part);
    for (const ControlValue& each : values) key_control(part, each.element);
}

/// A null end is removed; an omitted one stays. Values stay, within the new limits.
void set_limits(RigPart& part, const Arguments& given) {
    rig::Definition definition = part.rig.definition();
    std::vector<ControlValue> values;
    for (const std::size_t at : elements_given(part, given)) {
        control_at(part, at);
        values.push_back({at, part.state->controls[at]});
        Json element = save_fields(definition.elements[at]);
        for (const char* end : {"minimum", "maximum"}) {
            if (given.has(end)) element[end] = given.json(end);
            if (element.value(end, Json()).is_null()) element.erase(end);
        }
        definition.elements[at] = read_element(JsonPlace(element, ""));
    }
    if (definition == part.rig.definition()) return;
    redefine(part, std::move(definition));
    set_values(part, std::move(values));
}

/// A single value can only be set on controls of one kind.
void check_one_kind(const RigPart& part, const std::vector<WantedValue>& controls) {
    const rig::Element& first = control_at(part, controls.front().element);
    for (const WantedValue& each : controls) {
        const rig::Element& element = control_at(part, each.element);
        if (element.control->kind == first.control->kind) continue;
        throw std::invalid_argument("names: \"" + first.name + "\" is a " +
                                    control_title(first.control->kind) + ", \"" + element.name + "\" a " +
                                    control_title(element.control->kind) + "; give controls of one kind");
    }
}

void set_controls(RigPart& part, const Arguments& given) {
    const std::vector<WantedValue> controls = wanted_values(part, given, "value", "values");
    if (given.has("value")) check_one_kind(part, controls);
    std::vector<ControlValue> values;
    for (const WantedValue& each : controls) {
        const rig::ControlKind kind = control_at(part, each.element).control->kind;
        const rig::Value& now = part.state->controls[each.element];
        const Json wanted = filled(each.value.json(), control_value_json(kind, now));
        values.push_back({each.element, read_control_value({wanted, each.value.where()}, kind, now)});
    }
    set_values(part, std::move(values));
}

void reset_controls(RigPart& part, const Arguments& given) {
    std::vector<ControlValue> values;
    for (const std::size_t at : elements_given(part, given)) {
        const rig::Element& element = control_at(part, at);
        values.push_back({at, rig::rest_value(*element.control, element.initial)});
    }
    set_values(part, std::move(values));
}

void add_curve(RigPart& part, const Arguments& given) {
    rig::Definition definition = part.rig.definition();
    definition.curves.push_back({given.text("name"), given.has("value") ? given.real("value") : 0.0});
    redefine(part, std::move(definition));
}

template <Named kind>
void rename_it(RigPart& part, const Arguments& given) {
    rename(part, kind, given.text("name"), given.text("to"));
}

Argument new_name_argument() {
    return text_argument("to", true, "its new name, which no other has");
}

void set_curve(RigPart& part, const Arguments& given) {
    const std::size_t at = curve_named(part, given.text("name"));
    const double value = given.real("value");
    if (value == part.state->input_curves[at]) return;  // units may have written it since
    require_ok(part.rig.set_curve(part.state.edit(), at, value));
    changed(part);
}

}  // namespace

void add_element_commands(CommandTable& table) {
    table.add(rig_command(
        "rig.element.add", "Add a bone, null or control",
        {text_argument("name", true, "of the element"),
         choice_argument("kind", false, "default: bone", {"bone", "null", "control"}),
         element_argument("parent", false, "an element; none if omitted"),
         json_argument("local", false,
                       "the initial pose within the parent: {translation, rotation [x, y, z, w], scale}"),
         choice_argument("control", false, "kind of control; default: transform",
                         {"transform", "position", "rotation", "float", "bool", "vector2d"}),
         json_argument("axes", false, "of a 2D control, vector2d: two of \"x\", \"y\", \"z\""),
         json_argument("minimum", false,
                       "of a control: a number, [a, b] or [x, y, z], depending on its kind"),
         json_argument("maximum", false, "likewise"),
         element_argument("space", false, "of a control: the element that it moves with, its parent")},
        "Adds a bone, a null or a control", add_element));
    const Argument name = element_argument("name", false, "of the element"),
                   control = control_argument("name", false, "of the element"),
                   names = name_list_argument("names", "name");
    table.add(rig_command(
        "rig.element.set", "Set the pose of elements",
        {name, names,
         choice_argument("space", false, "of the transform; default: local", {"local", "global"}),
         json_argument(
             "transform", false,
             "{translation, rotation, scale}; omitted ones are kept; a null in [x, y, z] keeps that number"),
         each_argument("transforms", "names"),
         switch_argument("propagate", "the children move with it; default: on")},
        "Sets the input poses of elements, from which every solve begins", set_elements));
    table.add(rig_command("rig.element.rename", "Rename an element",
                          {element_argument("name", true, "of the element"), new_name_argument()},
                          "Renames an element; units, paths and the clip follow", rename_it<Named::Element>));
    table.add(rig_command(
        "rig.element.remove", "Remove elements", {name, names},
        "Removes elements, unless others are below them or a unit uses them",
        [](RigPart& part, const Arguments& given) { remove_elements(part, elements_given(part, given)); }));
    table.add(
        rig_command("rig.element.mirror", "Mirror a branch", {element_argument("name", true, "at its top")},
                    "Copies an element, all below it and the units that move them to the other side of its "
                    "parent, across x; left becomes right in names",
                    [](RigPart& part, const Arguments& given) { mirror_branch(part, given.text("name")); }));
    table.add(rig_command("rig.remove_selected", "Delete selection", {},
                          "Removes the elements or the unit, whichever was selected last", remove_selected));
    table.add(rig_command(
        "rig.control.set", "Set controls",
        {control, names,
         json_argument("value", false,
                       "{translation, rotation, scale}, [x, y, z], [x, y, z, w], a number, a bool or [a, b], "
                       "depending on its kind; a null in [x, y, z] keeps that number"),
         each_argument("values", "names")},
        "Sets controls, within their limits: one value for controls of one kind, or one for each",
        set_controls));
    table.add(
        rig_command("rig.control.limits", "Set the limits of controls",
                    {control, names, json_argument("minimum", false, "as in rig.element.add; null: none"),
                     json_argument("maximum", false, "likewise")},
                    "Sets the limits of controls of one kind", set_limits));
    table.add(rig_command("rig.control.reset", "Reset controls", {control, names},
                          "Sets controls to their initial values", reset_controls));
    table.add(rig_command(
        "rig.curve.add", "Add a curve",
        {text_argument("name", true, "of the curve"), number_argument("value", "default: 0", -1e9, 1e9)},
        "Adds a named curve that units can write to", add_curve));
    table.add(rig_command("rig.curve.rename", "Rename a curve", {curve_argument(), new_name_argument()},
                          "Renames a curve; units that write to it follow", rename_it<Named::Curve>));
    table.add(rig_command("rig.curve.set", "Set a curve's value",
                          {curve_argument(), {.name = "value", .help = "its value before the units run"}},
                          "Sets the value that a curve has before the units write to it", set_curve));
}

// Commands that add, change, move, remove and switch units.

namespace {

Argument unit_name_argument(bool required) {
    return unit_argument("name", required, "of the unit");
}

/// Adds a unit. Every member except "at" and "into" belongs to the unit, as in a scene file.
void add(RigPart& part, const Arguments& given) {
    Json unit = given.json();
    unit.erase("at");
    unit.erase("into");
    add_unit(part, read_unit(JsonPlace(unit, "")), given.has("at") ? given.integer("at") : -1,
             text_or_none(given, "into"));
}

void set(RigPart& part, const Arguments& given) {
    rig::Unit unit = unit_named(part, given.text("name"));
    const std::string name = unit.name;
    edit_unit(JsonPlace(given.json(), ""), unit);
    set_unit(part, name, std::move(unit));
}

/// Appends every member that a unit may have.
std::vector<Argument> unit_arguments(std::vector<Argument> arguments) {
    for (const std::string& each : unit_members())
        arguments.push_back(json_argument(each.c_str(), false, "a member of the unit, as in a scene file"));
    return arguments;
}

}  // namespace

void add_unit_commands(CommandTable& table) {
    table.add(rig_command(
        "rig.unit.add", "Add a unit",
        unit_arguments({choice_argument("unit", true, "its operation", operation_names()),
                        text_argument("name", false, "a unique name; taken from its operation if omitted"),
                        integer_argument("at", "position in the list of units; at the end if omitted", 0,
                                         static_cast<double>(max_lab_units)),
                        unit_argument("into", false, "of the for-each that runs it; none if omitted")}),
        "Adds a unit with its inputs: literals, outputs of earlier units, elements", add));
    table.add(rig_command("rig.unit.set", "Change a unit's inputs",
                          unit_arguments({unit_name_argument(true)}),
                          "Changes inputs of a unit; omitted ones are kept", set));
    table.add(rig_command("rig.unit.rename", "Rename a unit", {unit_name_argument(true), new_name_argument()},
                          "Renames a unit; units that use its outputs follow", rename_it<Named::Unit>));
    table.add(
        rig_command("rig.unit.remove", "Remove a unit", {unit_name_argument(true)},
                    "Removes a unit whose outputs no other unit uses",
                    [](RigPart& part, const Arguments& given) { remove_unit(part, given.text("name")); }));
    table.add(rig_command("rig.unit.move", "Move a unit in the order",
                          {unit_name_argument(true),
                           {.name = "at",
                            .type = ArgumentType::Integer,
                            .help = "its new position in the list of the rig, or of the body that it is in",
                            .low = 0,
                            .high = static_cast<double>(max_lab_units)}},
                          "Moves a unit, so that it runs earlier or later",
                          [](RigPart& part, const Arguments& given) {
                              move_unit(part, given.text("name"), given.integer("at"));
                          }));
    table.add(rig_command("rig.unit.enable", "Switch a unit on or off",
                          {unit_name_argument(true), {.name = "on", .type = ArgumentType::Boolean}},
                          "Switches a unit off or on", [](RigPart& part, const Arguments& given) {
                              enable_unit(part, given.text("name"), given.boolean("on"));
                          }));
}

}  // namespace tendril::app
