// The whole of the lab: what it begins with, and how it is simulated.
#include "app/labs/kit/world_file.hpp"
#include "app/labs/rope/rope_commands.hpp"
#include "app/labs/rope/rope_names.hpp"
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
    // The shortest decimals of a float are what was meant: 0.1 is no 0.10000000149.
    if (given.has("substep")) wanted.substep = shortest_decimal(given.number("substep"));
    if (given.has("iterations")) wanted.iterations = given.integer("iterations");
    if (given.has("solver")) wanted.solver = rope_solvers.value(given.text("solver"));
    if (given.has("damping")) wanted.damping = given.number("damping");
    if (given.has("gravity")) {
        wanted.gravity =
            given.is_point("gravity") ? given.point("gravity") : glm::vec3(0, -given.number("gravity"), 0);
    }
    if (given.has("gravity_scale")) wanted.gravity_scale = given.number("gravity_scale");
    if (given.has("external")) wanted.external = given.point("external");
    if (given.has("compliance")) wanted.compliance = given.number("compliance");
    if (given.has("friction")) wanted.friction = given.number("friction");
    if (given.has("longest_frame")) wanted.longest_frame = given.number("longest_frame");
    if (wanted != edit.seen().settings()) edit.world().set_settings(wanted);
}

void set_jitter(RopeEdit& edit, const Arguments& given) {
    edit.part.jitter.dial = given.number("dial");
    edit.part.jitter.frame = 0.0;  // the next frame already follows the dial
}

std::vector<Argument> settings_arguments() {
    return {
        number_argument("substep", "seconds", rope::min_substep, rope::max_substep),
        integer_argument("iterations", "passes in a substep", 1, rope::max_iterations),
        choice_argument("solver", false, "how lengths are kept", rope_solvers.names()),
        number_argument("damping", "1/s", 0.0, rope::max_rate),
        {.name = "gravity",
         .type = ArgumentType::NumberOrPoint,
         .required = false,
         .help = "m/s^2: downwards, or [x, y, z]",
         .low = -rope::max_acceleration,
         .high = rope::max_acceleration},
        number_argument("gravity_scale", "factor on gravity", -rope::max_scale, rope::max_scale),
        point_argument("external", false, "m/s^2 in addition to gravity: a wind"),
        number_argument("compliance", "strain per newton; relaxation ignores it", 0.0, rope::max_compliance),
        number_argument("friction", "between ropes and colliders", 0.0, rope::max_friction),
        number_argument("longest_frame", "seconds, the most that a frame simulates; the rest is dropped",
                        0.001, 10.0)};
}

}  // namespace

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
    table.add(rope_command("rope.settings", "Set how ropes are simulated", settings_arguments(),
                           "Sets how ropes are simulated; what is left out stays", settings));
    table.add(
        rope_command("rope.jitter", "Make frame times uneven",
                     {{.name = "dial", .help = "0: even frames; 1: from 1 to 250 ms", .low = 0, .high = 1}},
                     "Makes frames uneven, as in a program that stutters", set_jitter));
}

}  // namespace tendril::app
