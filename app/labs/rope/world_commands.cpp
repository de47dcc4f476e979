// Commands on the whole world, on colliders, and on selection, drags and view.
#include <algorithm>
#include <utility>

#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/rope/body_commands.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/labs/rope/rope_time.hpp"

namespace tendril::app {
namespace {

void clear(RopeEdit& edit, const Arguments&) {
    if (edit.seen().state().bodies.empty() && edit.seen().state().colliders.empty()) return;
    edit.world().clear();
    edit.part.samples.clear();
    forget_missing(edit.part);
}

void reset(RopeEdit& edit, const Arguments&) {
    const bool raced = !edit.part.rivals.empty();
    edit.part = make_rope_scene(rope_scenes().front());
    if (raced) begin_race(edit.part);
}

void restart(RopePart& part, const Arguments&) {
    if (!part.start) throw Refused("nothing has moved since the last change");
    part = dynamic_cast<const RopePart&>(*part.at_moment(part.start));
}

/// Opens a scene with its own view. Display settings and the tool do not change.
void take_scene(Workspace& workspace, const Arguments& given) {
    const RopeSceneEntry& entry =
        named(rope_scenes(), std::mem_fn(&RopeSceneEntry::name), given.text("name"), "scene");
    RopePart& part = workspace.document.edit<RopePart>(rope_lab);
    const RopePart before = std::exchange(part, make_rope_scene(entry));
    static_cast<Part&>(part) = before;
    part.tool = before.tool;
    part.view = before.view;
    part.jitter.rate = before.jitter.rate;
    part.jitter.dial = before.jitter.dial;
    if (!before.rivals.empty()) begin_race(part);
    (workspace.lab == rope_lab ? workspace.camera : workspace.cameras[rope_lab]) = entry.view;
}

/// rope.settings and, under a name that is easy to find, rope.wind: velocity, gusts and still_air.
void settings(RopeEdit& edit, const Arguments& given) {
    rope::Settings wanted = edit.seen().settings();
    if (given.has("velocity")) wanted.wind = given.point("velocity");
    const bool downwards = given.has("gravity") && !given.is_point("gravity");
    if (downwards) wanted.gravity = glm::vec3(0, -given.number("gravity"), 0);
    set_fields(given, wanted, downwards ? "gravity" : "");
    if (wanted != edit.seen().settings()) edit.world().set_settings(wanted);
}

void set_jitter(RopeEdit& edit, const Arguments& given) {
    set_fields(given, edit.part.jitter);
    edit.part.jitter.frame = 0.0;  // the next frame already uses the new dial
}

std::vector<Argument> settings_arguments() {
    std::vector<Argument> arguments = field_arguments<rope::Settings>();
    Argument& gravity = *std::ranges::find(arguments, std::string("gravity"), &Argument::name);
    gravity.type = ArgumentType::NumberOrPoint;
    gravity.help = "m/s^2: downwards, or [x, y, z]";
    return arguments;
}

}  // namespace

void add_world_commands(CommandTable& table) {
    table.add(rope_command("rope.clear", "Remove all ropes and colliders", {},
                           "Removes every rope and collider", clear));
    table.add(
        rope_command("rope.reset", "Reset the Rope lab", {}, "Resets this lab to its first state", reset));
    table.add(part_command<RopePart>(rope_lab, "rope.restart", "Restart the ropes", {},
                                     "Returns everything to its state after the last change", restart));
    table.add("rope.preset", "Open a rope preset",
              {choice_argument("name", true, "which scene",
                               names(rope_scenes(), [](const auto& each) { return each.name; }))},
              "Opens a preset", Effect::Edit, take_scene);
    table.add("rope.copy", "Copy the ropes as C++", {},
              "Copies ropes and colliders to the clipboard as a C++ program that uses the library",
              Effect::Look, [](Workspace& workspace, const Arguments&) {
                  workspace.ui.copied = RopeLab().code(workspace);
                  workspace.toast("The ropes are on the clipboard as C++");
              });
    table.add(rope_command("rope.settings", "Set how ropes are simulated", settings_arguments(),
                           "Sets how ropes are simulated; omitted settings are kept", settings));
    std::vector<Argument> wind = field_arguments(wind_fields(), wind_texts());
    wind.front().name = "velocity", wind.front().required = true;
    table.add(rope_command("rope.wind", "Set the wind", std::move(wind),
                           "Sets the wind on cloth, ropes and hair", settings));
    table.add(rope_command("rope.jitter", "Set the frame rate", field_arguments<Jitter>(),
                           "Sets the frame rate, and makes frames uneven, as in a program that stutters",
                           set_jitter));
}

// Commands on colliders.

namespace {

/// The field for a collider's shape, by its kind.
const Field& shape_row() {
    return fields<rope::Collider>().front();
}

/// The collider with the given fields of its shape. Refuses fields that its kind does not have.
rope::Shape changed(rope::Collider collider, const Arguments& given) {
    const FieldsIn in(shape_row().kind(&collider).table(), shape_row().address_in(&collider));
    for (const FieldText& text : field_texts<rope::Shape>())
        if (given.has(text.name) && find_field(in.table, text.name) == nullptr)
            throw Refused(std::string("a ") + rope::kind(collider.shape) + " has no " + text.name);
    set_fields(given, in);
    return collider.shape;
}

/// One argument per field of any kind of shape.
std::vector<Argument> shape_arguments() {
    std::vector<Argument> all;
    for (const FieldKind& kind : shape_row().kinds)
        for (Argument& each : field_arguments(kind.table(), field_texts<rope::Shape>()))
            if (std::ranges::find(all, each.name, &Argument::name) == all.end())
                all.push_back(std::move(each));
    return all;
}

Swing* swing_of(RopePart& part, const std::string& collider) {
    const auto found = std::ranges::find(part.swings, collider, &Swing::collider);
    return found == part.swings.end() ? nullptr : &*found;
}

/// Shifts a swing so that its centre is at `at` now.
void centre_on(Swing& swing, glm::vec3 at, double time) {
    swing.middle = glm::vec3(0.0f);
    swing.middle = at - swing_point(swing, time);
    require(swing);
}

void add_collider(RopeEdit& edit, const Arguments& given) {
    const std::string name = given.text("name");
    if (name.empty()) throw Refused("name must not be empty");
    rope::Collider blank;
    const auto kind = std::ranges::find(rope::shape_kinds, given.text("kind"));
    shape_row().set(&blank, {static_cast<double>(kind - rope::shape_kinds)});
    for (const Field& field : shape_fields(blank).table)
        if (field.required && !given.has(field.name))
            throw Refused(std::string(field.name) + " is missing; a " + *kind + " needs it");
    const rope::Shape shape = changed(blank, given);
    check_collider_count(edit.seen());
    edit.world().add_collider(name, shape);
}

void set(RopeEdit& edit, const Arguments& given) {
    const rope::Collider& collider = collider_of(edit.seen(), given.text("name"));
    const rope::Shape shape = changed(collider, given);
    if (shape == collider.shape) return;
    Swing* const swing = swing_of(edit.part, given.text("name"));
    if (swing != nullptr && rope::centre(shape) != rope::centre(collider.shape))
        centre_on(*swing, rope::centre(shape), edit.part.time);
    edit.set_collider(given.text("name"), shape);
}

void move(RopeEdit& edit, const Arguments& given) {
    const std::string name = given.text("name");
    collider_of(edit.seen(), name);
    const glm::vec3 to = given.point("to");
    if (Swing* swing = swing_of(edit.part, name)) centre_on(*swing, to, edit.part.time);
    edit.move_collider(name, to);
}

/// A swing continues from its present position: changing its amplitude or period must not make it jump.
void set_swing(RopeEdit& edit, const Arguments& given) {
    const rope::Collider& collider = collider_of(edit.seen(), given.text("name"));
    const std::string name = given.text("name");
    Swing* swing = swing_of(edit.part, name);
    Swing wanted = swing ? *swing : Swing{.collider = name};
    const glm::vec3 at = swing ? swing_point(*swing, edit.part.time) : rope::centre(collider.shape);
    if (!swing && !given.has("by")) throw Refused("expected by: the collider does not swing");
    if (given.has("by")) wanted.swing = given.point("by");
    set_fields(given, wanted);
    if (wanted.swing == glm::vec3(0.0f)) {
        std::erase_if(edit.part.swings, [&](const Swing& s) { return s.collider == name; });
        return;
    }
    if (swing && wanted == *swing) return;
    centre_on(wanted, at, edit.part.time);
    if (swing)
        *swing = wanted;
    else
        edit.part.swings.push_back(wanted);
}

void set_drive(RopeEdit& edit, const Arguments& given) {
    const std::string name = given.text("name");
    rope::Drive wanted = collider_of(edit.seen(), name).drive;
    set_fields(given, wanted);
    if (wanted != collider_of(edit.seen(), name).drive)
        edit.world().change(name, &rope::World::drive_collider, wanted);
}

Argument name_argument() {
    return collider_argument("name", true, "which");
}

}  // namespace

void add_collider_commands(CommandTable& table) {
    std::vector<Argument> added = shape_arguments(), set_arguments = added;
    added.insert(added.begin(),
                 {text_argument("name", true, "a new name"),
                  choice_argument("kind", true,
                                  "sphere: centre, radius; capsule: a, b, radius; "
                                  "plane: point, normal; box: centre, half_extents, rotation",
                                  {std::begin(rope::shape_kinds), std::end(rope::shape_kinds)})});
    set_arguments.insert(set_arguments.begin(), name_argument());
    table.add(rope_command("rope.collider.add", "Add a collider", std::move(added),
                           "Adds a body that ropes cannot enter", add_collider));
    table.add(rope_command("rope.collider.set", "Change a collider", std::move(set_arguments),
                           "Sets the position, size or rotation of a collider", set));
    table.add(rope_command("rope.collider.move", "Move a collider",
                           {name_argument(), point_argument("to", true, "its centre's new position, metres")},
                           "Moves a collider; it pushes bodies in its way", move));
    table.add(rope_command("rope.collider.remove", "Remove a collider", {name_argument()},
                           "Removes a collider", remove_named<collider_of, &rope::World::remove_collider>));
    std::vector<Argument> drive = field_arguments<rope::Drive>();
    drive.insert(drive.begin(), name_argument());
    table.add(rope_command("rope.collider.drive", "Move a collider steadily", std::move(drive),
                           "Moves and turns a collider steadily; it carries bodies that lie on it",
                           set_drive));
    std::vector<Argument> swing = field_arguments<Swing>();
    swing.insert(swing.begin(),
                 {name_argument(), point_argument("by", false, "metres to each side; 0: off")});
    table.add(rope_command("rope.collider.swing", "Swing a collider", std::move(swing),
                           "Makes a collider swing to and fro", set_swing));
}

// Commands on selection, drags and view. Only the effect of a drag on a rope is an undo step.

namespace {

void select(RopeEdit& edit, const Arguments& given) {
    const bool particle = given.has("rope") || given.has("particle") || given.has("particles");
    const bool add = given.has("add") && given.boolean("add");
    if (particle + given.has("collider") + given.has("tie") > 1)
        throw Refused("a particle, a collider or a tie can be selected, not both");
    if (given.has("collider")) {
        collider_of(edit.seen(), given.text("collider"));
        edit.part.selection = RopeSelection{{}, {}, given.text("collider"), {}};
    } else if (given.has("tie")) {
        tie_of(edit.seen(), given.text("tie"));
        edit.part.selection = RopeSelection{{}, {}, {}, given.text("tie")};
    } else if (particle) {
        if (!given.has("rope")) throw Refused("rope is missing (a text)");
        const std::string rope = given.text("rope");
        std::vector<std::size_t> chosen;
        if (!given.has("particle") && !given.has("particles"))
            for (std::size_t i = 0; i < body_of(edit.seen(), rope).count; ++i) chosen.push_back(i);
        else
            for (const NamedParticle& each : named_particles(edit.seen(), given))
                chosen.push_back(each.index);
        const auto& before = edit.part.selection;
        RopeSelection selection{rope, {}, {}, {}};
        if (add && before && before->body == rope) selection = *before;
        if (add && given.has("particle"))
            selection.particles.toggle(chosen.front());
        else
            selection.particles.take(chosen, add);
        edit.part.selection = std::move(selection);
        if (edit.part.selection->particles.empty()) edit.part.selection.reset();
    } else if (!add) {
        edit.part.selection.reset();
    }
}

void hold(RopeEdit& edit, const Arguments& given) {
    const std::vector<NamedParticle> all = named_particles(edit.seen(), given);
    for (const char* point : {"at", "points"})
        if (given.has(point) == given.has(point[0] == 'a' ? "particles" : "particle"))
            throw Refused("needs particle and at, or particles and points");
    const std::vector<rope::PinPlace> places = pin_places(given, all, "at", "points");
    const std::vector<std::size_t> held = held_particles(edit.part);
    Hold wanted{all.front().body, {}};
    for (const NamedParticle& each : all)
        if (!edit.seen().pinned(each.particle) || std::ranges::binary_search(held, each.particle))
            wanted.particles.push_back(each.index);
    std::sort(wanted.particles.begin(), wanted.particles.end());
    if (wanted.particles.empty())
        throw Refused("particle " + std::to_string(all.front().index) + " of \"" + all.front().body +
                      "\" is pinned; rope.pin moves it");
    if (edit.part.hold != wanted) let_go(edit.part);
    edit.move_pins(places);
    edit.part.hold = wanted;
}

}  // namespace

void add_look_commands(CommandTable& table) {
    table.add(rope_command(
        "rope.select", "Select a particle, collider or tie",
        {rope_argument(false, "of the particle"), particle_argument(false, "which; omitted: the whole rope"),
         collider_argument("collider", false, "instead of a particle"),
         tie_argument("tie", false, "instead of a particle"), particles_argument(),
         switch_argument("add", "true: adds particles of the same rope, or removes one")},
        "Selects particles, a collider or a tie; nothing if all are omitted", select, Effect::Look));
    table.add(rope_command(
        "rope.hold", "Hold particles",
        {rope_argument(true, "which"), particle_argument(false, "which; at least one must be free"),
         particles_argument(), point_argument("at", false, "metres"), each_argument("points", "particles")},
        "Holds free particles until rope.let_go, as a drag does, and moves pinned ones along", hold));
    table.add(rope_command(
        "rope.let_go", "Let go of held particles", {}, "Releases what rope.hold holds",
        [](RopeEdit& edit, const Arguments&) { let_go(edit.part); }, Effect::Look));
    table.add(rope_command(
        "rope.tool", "Choose the click action", {choice_argument("name", true, "which", rope_tools.names())},
        "Sets the click action in the scene",
        [](RopeEdit& edit, const Arguments& given) {
            edit.part.tool = rope_tools.value(given.text("name"));
            // A particle selected for another purpose is not the end of a tie.
            if (edit.part.tool == RopeTool::Tie) edit.part.selection.reset();
        },
        Effect::Look));
    table.add(rope_command(
        "rope.view", "Set how ropes are shown", field_arguments<RopeView>(),
        "Sets how ropes are shown; omitted settings are kept",
        [](RopeEdit& edit, const Arguments& given) { set_fields(given, edit.part.view); }, Effect::Look));
}

}  // namespace tendril::app
