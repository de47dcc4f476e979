// The whole of the lab: what it begins with, and how it is simulated.
#include "app/labs/kit/world_file.hpp"
#include "app/labs/rope/code.hpp"
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

}  // namespace tendril::app
