// Elements and named curves: added, set and removed.
#include "app/document/json_complete.hpp"
#include "app/labs/kit/part_command.hpp"
#include "app/labs/kit/require.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/rig_commands.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/take.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

Argument name_argument() {
    return element_argument("name", true, "of the element");
}
Argument curve_argument() {
    return offering(text_argument("name", true, "of the curve"), [](const Workspace& w) {
        return names(rig_part(w).rig.definition().curves,
                     [](const rig::NamedCurve& each) { return each.name; });
    });
}

JsonPlace place_of(const Arguments& given, const char* name) {
    return {given.json(name), name};
}

void add_element(RigPart& part, const Arguments& given) {
    rig::Definition definition = part.rig.definition();
    definition.elements.push_back(read_element(JsonPlace(given.json(), "")));
    redefine(part, std::move(definition));
}

/// What is left out of the transform stays. The pose that a unit gave a bone is no part of its input pose.
void set_element(RigPart& part, const Arguments& given) {
    const std::size_t at = element_named(part, given.text("name"));
    const rig::Space space =
        given.has("space") && given.text("space") == "global" ? rig::Space::Global : rig::Space::Local;
    const bool control = part.rig.definition().elements[at].control.has_value();
    const rig::Transform now = !control && space == rig::Space::Global
                                   ? part.rig.start_pose(part.state, at)
                                   : part.state.elements.get(part.rig.id(at), space,
                                                             control ? rig::Pose::Current : rig::Pose::Input);
    const rig::Transform to = read_transform(place_of(given, "transform"), now);
    const bool propagate = !given.has("propagate") || given.boolean("propagate");
    const rig::State before = part.state;
    require_ok(part.rig.set_element(part.state, at, space, to,
                                    propagate ? rig::Propagate::Yes : rig::Propagate::No));
    if (part.state != before) changed(part);
}

void remove(RigPart& part, const Arguments& given) {
    remove_element(part, given.text("name"));
}

/// The element or the unit, whichever was selected last.
void remove_selected(RigPart& part, const Arguments&) {
    const RigSelection selected = part.selected;
    if (selected.unit_last)
        remove_unit(part, selected.unit);
    else if (!selected.element.empty())
        remove_element(part, selected.element);
    else
        throw Refused("nothing is selected");
}

std::size_t control_named(const RigPart& part, const std::string& name) {
    const std::size_t at = element_named(part, name);
    if (!part.rig.definition().elements[at].control)
        throw std::invalid_argument("\"" + name + "\" is no control");
    return at;
}

void set_value(RigPart& part, std::size_t at, const rig::Value& value) {
    rig::State after = part.state;
    require_ok(part.rig.set_control(after, at, value));
    if (after.controls[at] == part.state.controls[at]) return;  // units may have moved it since
    if (!part.last_solved) part.last_solved = std::make_shared<const rig::State>(std::move(part.state));
    part.state = std::move(after);
    part.moving = true;
    part.backward.reset();
    part.rates.reset();
    const std::string& name = part.rig.definition().elements[at].name;
    // One that is set does not walk on; else the take remembers it, and goes on.
    const bool walked =
        std::erase_if(part.walks, [&](const RigWalk& walk) { return walk.control == name; }) > 0;
    walked ? begin_take(part) : key_control(part, at);
}

void set_control(RigPart& part, const Arguments& given) {
    const std::size_t at = control_named(part, given.text("name"));
    const rig::Control& control = *part.rig.definition().elements[at].control;
    set_value(part, at, read_control_value(place_of(given, "value"), control.kind, part.state.controls[at]));
}

void reset_control(RigPart& part, const Arguments& given) {
    const std::size_t at = control_named(part, given.text("name"));
    const rig::Element& element = part.rig.definition().elements[at];
    set_value(part, at, rig::rest_value(*element.control, element.initial));
}

void add_curve(RigPart& part, const Arguments& given) {
    rig::Definition definition = part.rig.definition();
    definition.curves.push_back({given.text("name"), given.has("value") ? given.real("value") : 0.0});
    redefine(part, std::move(definition));
}

void set_curve(RigPart& part, const Arguments& given) {
    const std::size_t at = curve_named(part, given.text("name"));
    const double value = given.real("value");
    if (value == part.state.input_curves[at]) return;  // units may have written it since
    require_ok(part.rig.set_curve(part.state, at, value));
    changed(part);
}

}  // namespace

void add_element_commands(CommandTable& table) {
    table.add(rig_command(
        "rig.element.add", "Add a bone, null or control",
        {text_argument("name", true, "of the element"),
         choice_argument("kind", false, "a bone where left out", {"bone", "null", "control"}),
         element_argument("parent", false, "an element; none where left out"),
         json_argument("local", false,
                       "{translation, rotation [x, y, z, w], scale} within the parent; the initial pose"),
         choice_argument("control", false, "what kind of control; transform where left out",
                         {"transform", "position", "rotation", "float", "bool", "vector2d"}),
         json_argument("axes", false, "of a 2D control, vector2d: two of \"x\", \"y\", \"z\""),
         json_argument("minimum", false, "of a control: a number, [a, b] or [x, y, z] as its kind has it"),
         json_argument("maximum", false, "likewise"),
         element_argument("space", false, "of a control: the element that it goes with, its parent")},
        "Adds a bone, a null or a control", add_element));
    table.add(rig_command(
        "rig.element.set", "Set an element's pose",
        {name_argument(),
         choice_argument("space", false, "of the transform; local where left out", {"local", "global"}),
         json_argument("transform", true, "{translation, rotation, scale}; what is left out stays"),
         switch_argument("propagate", "the children move with it; on where left out")},
        "Sets an element's input pose, from which every solve begins", set_element));
    table.add(rig_command("rig.element.remove", "Remove an element", {name_argument()},
                          "Removes an element that is no parent and that no unit names", remove));
    table.add(rig_command("rig.remove_selected", "Delete selection", {},
                          "Removes the element or the unit that was selected last", remove_selected));
    table.add(rig_command("rig.control.set", "Set a control",
                          {control_argument("name", true, "of the element"),
                           json_argument("value", true,
                                         "{translation, rotation, scale}, [x, y, z], [x, y, z, w], a number, "
                                         "a bool or [a, b], as its kind has it")},
                          "Sets a control, within its limits", set_control));
    table.add(rig_command("rig.control.reset", "Reset a control",
                          {control_argument("name", true, "of the element")},
                          "Sets a control to the value that it begins with", reset_control));
    table.add(rig_command("rig.curve.add", "Add a curve",
                          {text_argument("name", true, "of the curve"),
                           number_argument("value", "0 where left out", -1e9, 1e9)},
                          "Adds a named curve, which units write", add_curve));
    table.add(rig_command("rig.curve.set", "Set a curve's value",
                          {curve_argument(), {.name = "value", .help = "before the units"}},
                          "Sets the value that a curve has before the units write it", set_curve));
}

}  // namespace tendril::app
