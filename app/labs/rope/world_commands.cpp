// The whole of the lab: what it begins with, and how it is simulated.
#include <algorithm>
#include <string_view>

#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/world_file.hpp"
#include "app/labs/rope/body_commands.hpp"
#include "app/labs/rope/code.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/labs/rope/rope_time.hpp"
#include "app/labs/rope/scenes.hpp"

namespace tendril::app {
namespace {

void clear(RopeEdit& edit, const Arguments&) {
    if (edit.seen().state().bodies.empty() && edit.seen().state().colliders.empty()) return;
    edit.world().clear();
    forget_missing(edit.part);
}

void reset(RopeEdit& edit, const Arguments&) {
    edit.part = first_ropes();
}

/// Another scene is looked at as it is best seen; how ropes are shown, and the tool, stay.
void take_scene(Workspace& workspace, const Arguments& given) {
    const RopeSceneEntry& entry = rope_scene(given.text("name"));
    RopeScene scene = make_rope_scene(entry);
    RopePart& part = workspace.document.edit<RopePart>(rope_lab);
    part.world = std::make_shared<const NamedWorld>(std::move(scene.world));
    part.swings = std::move(scene.swings);
    part.time = 0.0;
    part.jitter = {.dial = part.jitter.dial};
    part.selection.reset();
    part.hold.reset();
    part.quiet_ticks = 0;
    part.samples.clear();
    (workspace.lab == rope_lab ? workspace.camera : workspace.cameras[rope_lab]) = entry.view;
}

void settings(RopeEdit& edit, const Arguments& given) {
    rope::Settings wanted = edit.seen().settings();
    const bool downwards = given.has("gravity") && !given.is_point("gravity");
    if (downwards) wanted.gravity = glm::vec3(0, -given.number("gravity"), 0);
    set_fields(given, wanted, downwards ? "gravity" : "");
    if (wanted != edit.seen().settings()) edit.world().set_settings(wanted);
}

void set_jitter(RopeEdit& edit, const Arguments& given) {
    edit.part.jitter.dial = given.number("dial");
    edit.part.jitter.frame = 0.0;  // the next frame already follows the dial
}

std::vector<Argument> settings_arguments() {
    std::vector<Argument> arguments = field_arguments<rope::Settings>();
    for (Argument& argument : arguments)
        if (argument.name == "gravity") {
            argument.type = ArgumentType::NumberOrPoint;
            argument.help = "m/s^2: downwards, or [x, y, z]";
        }
    return arguments;
}

}  // namespace

template <>
std::span<const FieldText> field_texts<rope::Settings>() {
    static constexpr EnumRow solvers[] = {rope_solvers.row(rope::Solver::Direct),
                                          rope_solvers.row(rope::Solver::Xpbd),
                                          rope_solvers.row(rope::Solver::Relaxation)};
    static constexpr FieldText texts[] = {
        {.name = "substep",
         .label = "substep",
         .help = "The length of the equal steps into which the simulation is cut. Shorter ones follow fast "
                 "motion better and cost more.",
         .decimals = 5},
        {.name = "iterations",
         .label = "iterations",
         .help =
             "The maximum number of passes per substep. Direct ends as soon as it has converged; with the "
             "others more passes stretch a rope less and cost more."},
        {.name = "solver", .label = "solver", .help = "How lengths are kept", .choices = solvers},
        {.name = "damping",
         .label = "damping",
         .help = "How fast motion dies away. Raise it where ropes swing for too long."},
        {.name = "gravity",
         .label = "gravity",
         .help = "The acceleration due to gravity, along each axis; Y points up. On Earth it is 0, -9.81, 0.",
         .step = 0.05f},
        {.name = "gravity_scale", .label = "gravity scale", .help = "A factor on gravity."},
        {.name = "external",
         .label = "wind",
         .help = "A steady acceleration of everything that moves, beside gravity.",
         .step = 0.05f},
        {.name = "compliance",
         .label = "compliance",
         .help = "How elastic ropes are: the fraction of its length that a rope stretches per newton. 0 does "
                 "not stretch; relaxation ignores it.",
         .step = 1e-5f,
         .decimals = 5},
        {.name = "friction",
         .label = "friction",
         .help = "Coulomb's coefficient between ropes and colliders. At 0 ropes slide off; more holds "
                 "them."},
        {.name = "longest_frame",
         .label = "longest frame",
         .help = "How much time a frame simulates at most; what is over is dropped, so that a slow frame "
                 "does not make the next one slower.",
         .step = 1.0f,
         .decimals = 0,
         .scale = 1000.0,
         .unit = "ms"}};
    return texts;
}

void add_world_commands(CommandTable& table) {
    table.add(rope_command("rope.clear", "Remove all ropes and colliders", {},
                           "Removes every rope and collider", clear));
    table.add(
        rope_command("rope.reset", "Reset the Rope lab", {}, "Resets this lab to its first state", reset));
    table.add(
        {.name = "rope.preset",
         .title = "Open a rope preset",
         .arguments = {choice_argument("name", true, "which scene",
                                       names(rope_scenes(), [](const auto& each) { return each.name; }))},
         .help = "Opens a preset",
         .effect = Effect::Edit,
         .apply = take_scene});
    table.add({.name = "rope.copy",
               .title = "Copy the ropes as C++",
               .arguments = {},
               .help = "Puts ropes and colliders on the clipboard, as a C++ program against the library",
               .effect = Effect::Look,
               .apply = [](Workspace& workspace, const Arguments&) {
                   workspace.ui.copied = rope_code(rope_part(workspace));
                   workspace.toast("The ropes are on the clipboard as C++");
               }});
    table.add(rope_command("rope.settings", "Set how ropes are simulated", settings_arguments(),
                           "Sets how ropes are simulated; what is left out stays", settings));
    table.add(
        rope_command("rope.jitter", "Make frame times uneven",
                     {{.name = "dial", .help = "0: even frames; 1: from 1 to 250 ms", .low = 0, .high = 1}},
                     "Makes frames uneven, as in a program that stutters", set_jitter));
}

// What ropes cannot enter.

namespace {

struct Kind {
    const char* name;
    rope::Shape shape;
    std::vector<std::string_view> needs, takes;
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> list{{"sphere", rope::Sphere{}, {"centre", "radius"}, {}},
                                        {"capsule", rope::Capsule{}, {"a", "b", "radius"}, {}},
                                        {"plane", rope::Plane{}, {"point", "normal"}, {}},
                                        {"box", rope::Box{}, {"centre", "half_extents"}, {"rotation"}}};
    return list;
}

const Kind& kind_of(std::string_view name) {
    return *std::find_if(kinds().begin(), kinds().end(), [&](const Kind& kind) { return name == kind.name; });
}

bool has(const std::vector<std::string_view>& list, std::string_view name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

void check_needs(const Kind& kind, const Arguments& given) {
    for (const std::string_view name : kind.needs) {
        if (!given.has(std::string(name).c_str()))
            throw Refused(std::string(name) + " is missing; a " + kind.name + " needs it");
    }
}

/// A shape of that kind with what is given in place of what it had. Refuses what the kind does not have.
rope::Shape changed(rope::Shape shape, const Kind& kind, const Arguments& given) {
    for (const char* name : {"centre", "radius", "a", "b", "point", "normal", "half_extents", "rotation"}) {
        if (!has(kind.needs, name) && !has(kind.takes, name) && given.has(name))
            throw Refused(std::string("a ") + kind.name + " has no " + name);
    }
    const auto take = [&](const char* name, glm::vec3& value) {
        if (given.has(name)) value = given.point(name);
    };
    if (auto* sphere = std::get_if<rope::Sphere>(&shape)) {
        take("centre", sphere->centre);
        if (given.has("radius")) sphere->radius = given.number("radius");
    } else if (auto* capsule = std::get_if<rope::Capsule>(&shape)) {
        take("a", capsule->a);
        take("b", capsule->b);
        if (given.has("radius")) capsule->radius = given.number("radius");
    } else if (auto* plane = std::get_if<rope::Plane>(&shape)) {
        take("point", plane->point);
        take("normal", plane->normal);
    } else if (auto* box = std::get_if<rope::Box>(&shape)) {
        take("centre", box->centre);
        take("half_extents", box->half_extents);
        if (given.has("rotation")) box->rotation = given.rotation("rotation");
    }
    return shape;
}

Swing* swing_of(RopePart& part, const std::string& collider) {
    const auto found = std::find_if(part.swings.begin(), part.swings.end(),
                                    [&](const Swing& swing) { return swing.collider == collider; });
    return found == part.swings.end() ? nullptr : &*found;
}

/// A swing whose centre is `at` at this moment.
void centre_on(Swing& swing, glm::vec3 at, double time) {
    swing.middle = glm::vec3(0.0f);
    swing.middle = at - swing_point(swing, time);
    require(swing);
}

void add_collider(RopeEdit& edit, const Arguments& given) {
    const std::string name = given.text("name");
    if (name.empty()) throw Refused("name must not be empty");
    const Kind& kind = kind_of(given.text("kind"));
    check_needs(kind, given);
    const rope::Shape shape = changed(kind.shape, kind, given);
    check_collider_count(edit.seen());
    edit.world().add_collider(name, shape);
}

void set(RopeEdit& edit, const Arguments& given) {
    const rope::Collider& collider = collider_of(edit.seen(), given.text("name"));
    const rope::Shape shape = changed(collider.shape, kind_of(rope::kind(collider.shape)), given);
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

void remove_collider(RopeEdit& edit, const Arguments& given) {
    collider_of(edit.seen(), given.text("name"));
    edit.world().remove_collider(given.text("name"));
    forget_missing(edit.part);
}

/// It swings on from where it is: to change how far or how fast never makes it jump.
void set_swing(RopeEdit& edit, const Arguments& given) {
    const rope::Collider& collider = collider_of(edit.seen(), given.text("name"));
    const glm::vec3 by = given.point("by");
    const std::string name = given.text("name");
    Swing* swing = swing_of(edit.part, name);
    if (by == glm::vec3(0.0f)) {
        std::erase_if(edit.part.swings, [&](const Swing& s) { return s.collider == name; });
        return;
    }
    Swing wanted = swing ? *swing : Swing{.collider = name};
    const glm::vec3 at = swing ? swing_point(*swing, edit.part.time) : rope::centre(collider.shape);
    wanted.swing = by;
    if (given.has("period")) wanted.period = given.number("period");
    if (swing && wanted == *swing) return;
    centre_on(wanted, at, edit.part.time);
    if (swing)
        *swing = wanted;
    else
        edit.part.swings.push_back(wanted);
}

Argument name_argument() {
    return collider_argument("name", true, "which");
}

}  // namespace

void add_collider_commands(CommandTable& table) {
    const auto with_shape = [](std::vector<Argument> arguments) {
        for (const Argument& argument :
             {point_argument("centre", false, "of a sphere or box"),
              number_argument("radius", "of a sphere or capsule, metres", 0.0, 1e9),
              point_argument("a", false, "a capsule's end"), point_argument("b", false, "its other end"),
              point_argument("point", false, "on a plane"),
              point_argument("normal", false, "of a plane, outwards"),
              point_argument("half_extents", false, "of a box, metres"),
              Argument{.name = "rotation",
              .type = ArgumentType::Rotation,
              .required = false,
              .help = "of a box: [x, y, z, w], or degrees about X, Y and Z"}})
            arguments.push_back(argument);
        return arguments;
    };
    table.add(
        rope_command("rope.collider.add", "Add a collider",
                     with_shape({text_argument("name", true, "a new one"),
                                 choice_argument("kind", true,
                                                 "sphere: centre, radius; capsule: a, b, radius; "
                                                 "plane: point, normal; box: centre, half_extents, rotation",
                                                 names(kinds(), [](const Kind& k) { return k.name; }))}),
                     "Adds a body that ropes cannot enter", add_collider));
    table.add(rope_command("rope.collider.set", "Change a collider", with_shape({name_argument()}),
                           "Sets the place, size or rotation of a collider", set));
    table.add(rope_command("rope.collider.move", "Move a collider",
                           {name_argument(), point_argument("to", true, "where its centre goes, metres")},
                           "Moves a collider; it pushes what it meets", move));
    table.add(rope_command("rope.collider.remove", "Remove a collider", {name_argument()},
                           "Removes a collider", remove_collider));
    table.add(rope_command(
        "rope.collider.swing", "Swing a collider",
        {name_argument(), point_argument("by", true, "metres to each side; 0: off"),
         number_argument("period", "seconds", shortest_decimal(min_period), shortest_decimal(max_period))},
        "Makes a collider swing to and fro", set_swing));
}

}  // namespace tendril::app

// What is selected, held and shown. But for what a drag does to a rope, it leaves no step to undo.

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopeView>() noexcept {
    using app::RopeView;
    static constexpr Field rows[] = {field<&RopeView::particles>("particles"),
                                     field<&RopeView::strain>("strain"),
                                     field<&RopeView::sides>("sides", {app::min_sides, app::max_sides})};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<RopeView>() {
    static constexpr FieldText texts[] = {
        {.name = "strain",
         .label = "Strain as colour",
         .help = "Colours each rope by how far its segments are from their lengths."},
        {.name = "particles", .label = "Particles", .help = "Draws the particles that ropes are made of."},
        {.name = "sides",
         .label = "sides",
         .help = "How many sides ropes have in the picture. More look rounder and take longer to draw."}};
    return texts;
}

namespace {

void select(RopeEdit& edit, const Arguments& given) {
    const bool particle = given.has("rope") || given.has("particle") || given.has("particles");
    const bool add = given.has("add") && given.boolean("add");
    if (particle && given.has("collider"))
        throw Refused("a particle or a collider can be selected, not both");
    if (given.has("collider")) {
        collider_of(edit.seen(), given.text("collider"));
        edit.part.selection = RopeSelection{{}, {}, given.text("collider")};
    } else if (particle) {
        if (!given.has("rope")) throw Refused("rope is missing (a text)");
        if (!given.has("particle") && !given.has("particles"))
            throw Refused("particle is missing (a whole number)");
        std::vector<std::size_t> chosen;
        for (const NamedParticle& each : named_particles(edit.seen(), given)) chosen.push_back(each.index);
        const std::string rope = given.text("rope");
        const auto& before = edit.part.selection;
        RopeSelection selection{rope, {}, {}};
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

void set_view(RopeEdit& edit, const Arguments& given) {
    set_fields(given, edit.part.view);
}

}  // namespace

void add_look_commands(CommandTable& table) {
    table.add(
        rope_command("rope.select", "Select particles or a collider",
                     {rope_argument(false, "of the particle"), particle_argument(false, "which"),
                      collider_argument("collider", false, "instead of a particle"), particles_argument(),
                      switch_argument("add", "true: adds particles of the same rope, or takes one out")},
                     "Selects particles or a collider; nothing when all is left out", select, Effect::Look));
    table.add(rope_command(
        "rope.hold", "Hold particles",
        {rope_argument(true, "which"), particle_argument(false, "which; one of them a free one"),
         particles_argument(), point_argument("at", false, "metres"), each_argument("points", "particles")},
        "Holds free particles until rope.let_go, as a drag does, and moves pinned ones along", hold));
    table.add(rope_command(
        "rope.let_go", "Let go of held particles", {}, "Releases what rope.hold holds",
        [](RopeEdit& edit, const Arguments&) { let_go(edit.part); }, Effect::Look));
    table.add(rope_command(
        "rope.tool", "Choose the click action", {choice_argument("name", true, "which", rope_tools.names())},
        "Sets what a click in the scene does",
        [](RopeEdit& edit, const Arguments& given) { edit.part.tool = rope_tools.value(given.text("name")); },
        Effect::Look));
    table.add(rope_command("rope.view", "Set how ropes are shown", field_arguments<RopeView>(),
                           "Sets how ropes are shown; what is left out stays", set_view, Effect::Look));
}

}  // namespace tendril::app
