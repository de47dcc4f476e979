// Commands that analyse a solve: microscope.* and race.*.
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/io/solver_json.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_runtime.hpp"
#include "app/labs/chain/commands.hpp"

namespace tendril::app {

void check_race(const ChainPart& part) {
    if (part.study.kind != Study::Kind::Race) throw Refused("no race is open");
}

namespace {

constexpr const char* starts[] = {"last", "here", "straight"};
std::optional<Study::From> start_of(const Arguments& given) {
    if (!given.has("start")) return std::nullopt;
    const auto found = std::find(std::begin(starts), std::end(starts), given.text("start"));
    return static_cast<Study::From>(found - std::begin(starts));
}

Argument start_argument() {
    return choice_argument(
        "start", false, "what each solve starts from: the last start, the current pose, or a straight line",
        {std::begin(starts), std::end(starts)});
}

/// Studies need mode Reach; the chain then shows the result of a solve from the study's start.
template <Study::Kind kind>
void open(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    if (!part.result) part.study.last_start.clear();  // bent by hand since the last solve
    part.study.begin(kind, start_of(given), part.chain, part.reach);
    enter_mode(part, ChainMode::Reach);
    reach_for(part, part.target, runtime);
}

void check_microscope(const ChainPart& part) {
    if (part.study.kind != Study::Kind::Microscope) throw Refused("the microscope is not open");
}
/// `check` refuses if another study is open, or none.
template <void (*check)(const ChainPart&)>
void close(ChainPart& part, const Arguments&) {
    check(part);
    part.study.close();
}

/// Shows a step of the solve or an iteration of the race, and pauses. Throws Refused if it does not exist.
template <void (*check)(const ChainPart&)>
void seek(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    check(part);
    const char* const name = given.has("step") ? "step" : "iteration";
    const std::size_t last = runtime.studied(part).last();
    const auto to = static_cast<std::size_t>(given.integer(name));
    if (to > last)
        throw Refused(std::string(name) + " must be 0 to " + std::to_string(last) + ", got " +
                      std::to_string(to));
    part.study.go_to(to, last);
    part.study.pace = 0.0f;
}

/// The end of the iteration `by` iterations away.
long end_of_iteration(const Trace& trace, std::size_t step, int by) {
    int iteration = trace.iteration(step);
    const bool within = step < trace.end_of_iteration(iteration);
    if (within && by > 0) --iteration;  // the next end is this iteration's
    return static_cast<long>(trace.end_of_iteration(iteration + by));
}

/// In a race, steps are iterations.
void step(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    if (!part.study.open()) throw Refused("neither the microscope nor a race is open");
    const Studied shown = runtime.studied(part);
    const auto last = static_cast<long>(shown.last());
    const std::size_t now = std::min(part.study.step, shown.last());
    const int by = given.has("by") ? given.integer("by") : 1;
    long to = static_cast<long>(now) + by;
    if (given.has("iterations"))
        to = shown.trace ? end_of_iteration(*shown.trace, now, given.integer("iterations"))
                         : static_cast<long>(now) + given.integer("iterations");
    part.study.go_to(static_cast<std::size_t>(std::clamp(to, 0L, last)), shown.last());
    part.study.pace = 0.0f;
}

/// Restarts playback if it is at the last step.
void play(ChainPart& part, float pace, ChainRuntime& runtime) {
    Study& study = part.study;
    study.pace = pace;
    study.passed = 0.0;
    if (study.step >= runtime.studied(part).last()) study.step = 0;
}

void play_microscope(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    check_microscope(part);
    play(part, given.has("pace") ? given.number("pace") : default_pace, runtime);
}

void play_race(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    check_race(part);
    const bool on = !given.has("on") || given.boolean("on");
    if (!on && given.has("pace")) throw Refused("pace is for playing, and on is false");
    if (!on) {
        part.study.pace = 0.0f;
        return;
    }
    const std::size_t last = runtime.studied(part).last();
    play(part, given.has("pace") ? given.number("pace") : race_pace(last), runtime);
}

void choose_racer(ChainPart& part, const Arguments& given) {
    check_race(part);
    const ik::Method method = *ik::method_named(given.text("name"));
    part.study.racers[static_cast<std::size_t>(method)] = given.boolean("on");
}

void lay_out_race(ChainPart& part, const Arguments& given) {
    check_race(part);
    part.study.side_by_side = given.boolean("on");
}

std::vector<Argument> step_arguments() {
    return {integer_argument("by", "steps forward, or back if negative; default: 1", -max_trace_steps,
                             max_trace_steps),
            integer_argument("iterations", "iterations forward, or back if negative, to the end of one",
                             -max_iterations, max_iterations)};
}

/// Brings the start into view: the chain may have been elsewhere when the view was framed.
Command opening(Command command) {
    command.apply = [open = std::move(command.apply)](Workspace& workspace, const Arguments& given) {
        open(workspace, given);
        const Rect view{{0.0f, 0.0f}, workspace.ui.view_size};
        CameraPose& pose = workspace.lab == chain_lab ? workspace.camera : workspace.cameras[chain_lab];
        const Camera camera(pose, view);
        const bool seen = std::ranges::all_of(chain_part(workspace).study.start, [&](const glm::vec3& joint) {
            const auto at = camera.project(joint);
            return at && view.contains(*at);
        });
        const Bounds all = ChainLab().bounds(workspace, false);
        if (!seen) pose = framed(pose, view, all.centre, all.radius);
    };
    return command;
}

void add_microscope_commands(CommandTable& table) {
    table.add(opening(chain_command("microscope.open", "Open the microscope", {start_argument()},
                                    "Shows a solve step by step, always from the same start",
                                    open<Study::Kind::Microscope>, Effect::Edit)));
    table.add(chain_command("microscope.seek", "Show a step of the solve",
                            {{.name = "step",
                              .type = ArgumentType::Integer,
                              .help = "how many steps are shown",
                              .low = 0,
                              .high = max_trace_steps}},
                            "Goes to a step of the solve", seek<check_microscope>, Effect::Look));
    table.add(chain_command("study.step", "Step through microscope or race", step_arguments(),
                            "Steps forward or back: through the solve under the microscope, or through the "
                            "race iteration by iteration",
                            step, Effect::Look));
    table.add(chain_command("microscope.play", "Play the solve's steps",
                            {number_argument("pace", "steps per second; default: 8",
                                             shortest_decimal(slowest_pace), shortest_decimal(fastest_pace))},
                            "Plays the steps up to the last", play_microscope, Effect::Look));
    table.add(chain_command(
        "microscope.pause", "Pause the solve's steps", {}, "Stops playing the steps",
        [](ChainPart& part, const Arguments&) {
            check_microscope(part);
            part.study.pace = 0.0f;
        },
        Effect::Look));
    table.add(chain_command("microscope.close", "Close the microscope", {},
                            "Closes the microscope; the chain stays as the solve left it",
                            close<check_microscope>, Effect::Look));
}

}  // namespace

void add_study_commands(CommandTable& table) {
    add_microscope_commands(table);
    table.add(opening(chain_command("race.open", "Start a race of solvers", {start_argument()},
                                    "Compares solvers from the same start to the same target, with a plot",
                                    open<Study::Kind::Race>, Effect::Edit)));
    table.add(chain_command(
        "race.solver", "Choose which solvers race",
        {choice_argument("name", true, "which solver", {solver_names().begin(), solver_names().end()}),
         {.name = "on", .type = ArgumentType::Boolean, .help = "true: it takes part"}},
        "Lets a solver take part in the race", choose_racer, Effect::Look));
    table.add(chain_command("race.side_by_side", "Show the race side by side",
                            {{.name = "on", .type = ArgumentType::Boolean, .help = "false: overlaid"}},
                            "Shows the chains of the race beside each other", lay_out_race, Effect::Look));
    table.add(chain_command("race.show", "Show an iteration of the race",
                            {{.name = "iteration",
                              .type = ArgumentType::Integer,
                              .help = "after how many iterations; a solver that took fewer stays at its end",
                              .low = 0,
                              .high = max_iterations}},
                            "Shows each solver's chain as it stood after an iteration", seek<check_race>,
                            Effect::Look));
    table.add(chain_command(
        "race.play", "Play or pause the race",
        {switch_argument("on", "false: pauses; default: true"),
         number_argument("pace", "iterations per second; default: 4, or so many that it takes 3 to 11 s",
                         shortest_decimal(slowest_pace), shortest_decimal(fastest_pace))},
        "Plays the race iteration by iteration, from its start if it is at its end", play_race,
        Effect::Look));
    table.add(chain_command("race.close", "Close the race", {},
                            "Closes the race; the chain stays as its own solver left it", close<check_race>,
                            Effect::Look));
    add_race_file_commands(table);
}

}  // namespace tendril::app
