// Commands that analyse a solve: microscope.* and race.*.
#include <algorithm>
#include <stdexcept>

#include "app/document/atomic_file.hpp"
#include "app/labs/chain/chain_runtime.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"

namespace tendril::app {
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
void open(ChainPart& part, const Arguments& given, ChainRuntime& runtime, Study::Kind kind) {
    part.study.begin(kind, start_of(given), part.chain, part.reach);
    enter_mode(part, ChainMode::Reach);
    reach_for(part, part.target, runtime);
}

void open_microscope(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    open(part, given, runtime, Study::Kind::Microscope);
}

void check_microscope(const ChainPart& part) {
    if (part.study.kind != Study::Kind::Microscope) throw Refused("the microscope is not open");
}
void check_race(const ChainPart& part) {
    if (part.study.kind != Study::Kind::Race) throw Refused("no race is open");
}

void seek_step(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    check_microscope(part);
    part.study.step = static_cast<std::size_t>(given.integer("step"));
    part.study.pace = 0.0f;
    const std::size_t last = runtime.studied(part).trace->frames();
    if (part.study.step > last) {
        throw Refused("step must be 0 to " + std::to_string(last) + ", got " +
                      std::to_string(part.study.step));
    }
}

void step(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    check_microscope(part);
    const std::shared_ptr<const Trace> shown = runtime.studied(part).trace;
    const Trace& trace = *shown;
    const auto last = static_cast<long>(trace.frames());
    long to = static_cast<long>(part.study.step);
    if (given.has("iterations")) {
        int iteration = trace.iteration(part.study.step);
        const bool within = part.study.step < trace.end_of_iteration(iteration);
        if (within && given.integer("iterations") > 0)
            --iteration;  // the first iteration forward is the end of this one
        to = static_cast<long>(trace.end_of_iteration(iteration + given.integer("iterations")));
    } else {
        to += given.has("by") ? given.integer("by") : 1;
    }
    part.study.step = static_cast<std::size_t>(std::clamp(to, 0L, last));
    part.study.pace = 0.0f;
}

/// Restarts playback if it is at the last step.
void play(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    check_microscope(part);
    Study& study = part.study;
    study.pace = given.has("pace") ? given.number("pace") : default_pace;
    study.passed = 0.0;
    if (study.step >= runtime.studied(part).trace->frames()) study.step = 0;
}
void pause(ChainPart& part, const Arguments&) {
    check_microscope(part);
    part.study.pace = 0.0f;
}

void close_microscope(ChainPart& part, const Arguments&) {
    check_microscope(part);
    part.study.close();
}
void close_race(ChainPart& part, const Arguments&) {
    check_race(part);
    part.study.close();
}

void open_race(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    open(part, given, runtime, Study::Kind::Race);
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

void add_microscope_commands(CommandTable& table) {
    table.add(chain_command("microscope.open", "Open the microscope", {start_argument()},
                            "Shows a solve step by step, always from the same start", open_microscope,
                            Effect::Edit));
    table.add(chain_command("microscope.seek", "Show a step of the solve",
                            {{.name = "step",
                              .type = ArgumentType::Integer,
                              .help = "how many steps are shown",
                              .low = 0,
                              .high = max_trace_steps}},
                            "Goes to a step of the solve", seek_step, Effect::Look));
    table.add(chain_command(
        "microscope.step", "Step through the solve",
        {integer_argument("by", "steps forward, or back if negative; default: 1", -max_trace_steps,
                          max_trace_steps),
         integer_argument("iterations", "iterations forward, or back if negative, to the end of one",
                          -max_iterations, max_iterations)},
        "Steps forward or back through the solve", step, Effect::Look));
    table.add(chain_command("microscope.play", "Play the solve's steps",
                            {number_argument("pace", "steps per second; default: 8",
                                             shortest_decimal(slowest_pace), shortest_decimal(fastest_pace))},
                            "Plays the steps up to the last", play, Effect::Look));
    table.add(chain_command("microscope.pause", "Pause the solve's steps", {}, "Stops playing the steps",
                            pause, Effect::Look));
    table.add(chain_command("microscope.close", "Close the microscope", {},
                            "Closes the microscope; the chain stays as the solve left it", close_microscope,
                            Effect::Look));
}

/// Writes the race's results without changing the chain.
Command race_save() {
    return {.name = "race.save",
            .title = "Save the race as CSV",
            .arguments = {{.name = "path", .type = ArgumentType::Text, .help = "a CSV file to write"}},
            .help = "Writes every solver's residual at each iteration as CSV",
            .effect = Effect::Look,
            .apply = [](Workspace& workspace, const Arguments& given) {
                const ShownChain shown = shown_chain(workspace);
                check_race(shown.part);
                write_file_atomically(given.text("path"), race_csv(*shown.race));
                workspace.toast(written_text(given.text("path")));
            }};
}

}  // namespace

void add_study_commands(CommandTable& table) {
    add_microscope_commands(table);
    table.add(chain_command("race.open", "Start a race of solvers", {start_argument()},
                            "Runs several solvers from the same start to the same target", open_race,
                            Effect::Edit));
    table.add(
        chain_command("race.solver", "Choose which solvers race",
                      {choice_argument("name", true, "which solver",
                                       names(ik::all_methods, [](ik::Method m) { return ik::name(m); })),
                       {.name = "on", .type = ArgumentType::Boolean, .help = "true: it takes part"}},
                      "Lets a solver take part in the race", choose_racer, Effect::Look));
    table.add(chain_command("race.side_by_side", "Show the race side by side",
                            {{.name = "on", .type = ArgumentType::Boolean, .help = "false: overlaid"}},
                            "Shows the chains of the race beside each other", lay_out_race, Effect::Look));
    table.add(race_save());
    table.add(chain_command("race.close", "Close the race", {},
                            "Closes the race; the chain stays as its own solver left it", close_race,
                            Effect::Look));
}

}  // namespace tendril::app
