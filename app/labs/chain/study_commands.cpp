// Analyses of a solve: their commands, microscope.* and race.*, and their rows in the panel.
#include <imgui.h>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/io/solver_text.hpp"
#include "app/io/text.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/race.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/tooltip.hpp"

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
    return choice_argument("start", false,
                           "the start of each solve: the last start, the current pose, or a straight "
                           "line; default: the last, or straight if the chain has arrived",
                           {std::begin(starts), std::end(starts)});
}

/// Studies need mode Reach; the chain then shows the result of a solve from the study's start.
template <Study::Kind kind>
void open(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    if (!part.result) part.study.last_start.clear();  // bent by hand since the last solve
    const bool opens = !part.study.open();
    const auto from = start_of(given);
    part.study.begin(kind, from, part.chain, part.reach);
    // A chain that has arrived would have nothing to show.
    if (opens && !from && part.result &&
        glm::distance(part.study.start.back(), part.target) <=
            reach_tolerance(part.reach, part.chain.reach()))
        part.study.begin(kind, Study::From::Straight, part.chain, part.reach);
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
    if (within && by > 0) --iteration;  // this iteration's end comes next
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

constexpr float plot_lines = 13.0f;

std::vector<glm::vec2> by_iteration(const std::vector<float>& residuals) {
    std::vector<glm::vec2> points;
    for (const float residual : residuals) points.push_back({static_cast<float>(points.size()), residual});
    return points;
}

/// The y axis begins two decades below the tolerance.
PlotAxes residual_axes(float tolerance, int iteration) {
    return {.x = "iterations",
            .y = "tip to target",
            .y_unit = "m",
            .min_y = std::max(1e-7f, 1e-2f * tolerance),
            .level = tolerance,
            .note = "\ntolerance " + short_text(static_cast<double>(tolerance), "m") + ", dashed",
            .at_x = static_cast<float>(iteration),
            .whole_x = true};
}

void start_buttons(const char* command, Emit& emit) {
    if (row_button("Start here", 2, true, "Each solve starts from the chain's current pose"))
        emit(command, {{"start", "here"}});
    if (row_button("Start straight", 2, true, "Each solve starts with the chain in a straight line"))
        emit(command, {{"start", "straight"}});
}

/// Key of the panel's state (not the document's): whether the x axis is time.
constexpr const char* against_time = "against time";

void racer_row(const ShownChain& shown, ik::Method method, bool time, const Palette& palette, Emit& emit) {
    const auto index = static_cast<std::size_t>(method);
    const bool accepted = takes(method, shown.part.chain);
    bool on = accepted && shown.part.study.racers[index];
    colour_mark(solver_colour(palette, method));
    ImGui::BeginDisabled(!accepted);
    if (ImGui::Checkbox(solver_title(method), &on))
        emit("race.solver", {{"name", ik::name(method)}, {"on", on}});
    ImGui::EndDisabled();
    if (!accepted) {
        explain((std::string("It cannot run on this chain: it ") + needs_two_bones + ".").c_str());
        return small_right(needs_two_bones);
    }
    const auto& racers = shown.race->racers;
    const auto racer = std::ranges::find(racers, method, &Racer::method);
    const bool raced = racer != racers.end();
    explain((std::string("Whether it runs in the race. ") + solver_help(method) +
             (raced ? " It ran as " + ran_text(method, racer->report) + ". " + end_text(*racer) + "." : ""))
                .c_str());
    if (!raced) return;
    ImGui::SameLine();
    const RacerAt at = racer_at(*racer, shown.step());
    text_flush_right(time ? si_text(1e-6 * racer->microseconds, "s") : std::to_string(racer->iterations()));
    if (racer->report.status == ik::Status::InvalidInput) return small_right("does not support this chain");
    // Always one line, so that no row moves.
    small_right(at.finished ? end_text(*racer) : progress_text(at) + ", " + error_reading(at));
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

void race_plot(const ShownChain& shown, bool time, const Palette& palette) {
    const Race& race = *shown.race;
    std::vector<Curve> curves;
    for (const Racer& racer : race.racers) {
        Curve curve{solver_title(racer.method), solver_colour(palette, racer.method),
                    by_iteration(racer.residuals)};
        const float last = std::max(1.0f, static_cast<float>(racer.residuals.size() - 1));
        if (time)
            for (glm::vec2& p : curve.points) p.x *= 1e-6f * static_cast<float>(racer.microseconds) / last;
        curves.push_back(std::move(curve));
    }
    PlotAxes axes = residual_axes(race.tolerance, time ? -1 : static_cast<int>(shown.step()));
    axes.whole_x = !time;
    if (time) {
        axes.x = "time";
        axes.x_unit = "s";
        axes.min_x = 0.0f;
    }
    plot("race plot", curves, axes, plot_lines);
}

void study_rows(const ChainPart& part, Emit& emit) {
    const bool solvable = part.chain.size() > 1 && part.chain.size() <= max_studied_segments;
    const char* why_not =
        part.chain.size() < 2 ? "Needs a chain of at least one bone" : "For chains of up to 512 joints";
    static_assert(max_studied_segments == 512);
    const bool magnified = part.study.kind == Study::Kind::Microscope;
    const bool racing = part.study.kind == Study::Kind::Race;
    if (row_button(magnified ? "Close" : "Microscope", 2, solvable,
                   magnified   ? "Closes the microscope"
                   : !solvable ? why_not
                               : "Every step of one solve, and the pose after it"))
        emit(magnified ? "microscope.close" : "microscope.open");
    if (row_button(racing ? "Close" : "Race", 2, solvable,
                   racing      ? "Closes the race"
                   : !solvable ? why_not
                               : "Several solvers, from the same start"))
        emit(racing ? "race.close" : "race.open");
    end_row();
}

void export_rows(Emit& emit) {
    if (row_button("Copy as C++", 2, true, "This chain, mode and solver as a program that uses the library"))
        emit("chain.copy", {{"as", "cpp"}});
    if (row_button("Copy as JSON", 2, true, "The scene as text")) emit("chain.copy", {{"as", "json"}});
    end_row();
    if (row_button("Save a trace", 1, true,
                   "Writes the last ten seconds beside the scene, for tendril trace and other programs"))
        emit("chain.save_trace");
    end_row();
    picture_rows(emit);
}

void microscope_rows(const ShownChain& shown, const Palette& palette, Emit& emit) {
    const PanelSection ids("Microscope");
    const ChainPart& part = shown.part;
    const Trace& trace = *shown.trace;
    const std::size_t step = part.study.step;
    if (row_button("|<", 4, step > 0, "One iteration back")) emit("study.step", {{"iterations", -1}});
    if (row_button("<", 4, step > 0, "One step back")) emit("study.step", {{"by", -1}});
    if (row_button(">", 4, step < trace.frames(), "One step forward")) emit("study.step", {{"by", 1}});
    if (row_button(">|", 4, step < trace.frames(), "One iteration forward"))
        emit("study.step", {{"iterations", 1}});
    end_row();
    // Below the buttons, because these texts change length from step to step.
    reading("step", "%zu of %zu", step, trace.frames());
    reading("iteration", "%d of %d", trace.iteration(step), trace.report.iterations);
    note(ran_text(trace.method, trace.report) + ".");
    const float from = ImGui::GetCursorPosY();
    note(describe_frame(trace, step));
    // Space for two lines even if the text is shorter, so that the plot does not move from step to step.
    const float below = from + 2.0f * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
    ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), below));
    if (part.motion.path != Motion::Path::Still)
        note("The moving target waits while the microscope is open.");
    if (trace.cut) note("The solve took more steps than were recorded.");
    float pace = part.study.pace > 0.0f ? part.study.pace : default_pace;
    if (number_field("play at", pace, 0.1f, slowest_pace, fastest_pace, "%.1f steps/s"))
        emit.continuously("microscope.play", {{"pace", pace}});
    explain("How fast the steps play.");
    start_buttons("microscope.open", emit);
    end_row();
    const Curve curve{solver_title(trace.method), palette.accent, by_iteration(trace.residuals)};
    const float tolerance = reach_tolerance(part.reach, part.chain.reach());
    plot("error", {&curve, 1}, residual_axes(tolerance, trace.iteration(step)), plot_lines);
}

void race_rows(const ShownChain& shown, const Palette& palette, Emit& emit) {
    const PanelSection ids("Race");
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const ImGuiID kept_as = ImGui::GetID(against_time);
    bool time = kept.GetBool(kept_as);
    small_right(time ? "time" : "iterations");
    for (const ik::Method method : ik::all_methods) racer_row(shown, method, time, palette, emit);
    race_plot(shown, time, palette);
    if (ImGui::Checkbox("Against time", &time)) kept.SetBool(kept_as, time);
    if (ImGui::IsItemHovered()) tooltip("Measured on this machine, the fastest of several runs");
    bool apart = shown.part.study.side_by_side;
    if (ImGui::Checkbox("Side by side", &apart)) {
        emit("race.side_by_side", {{"on", apart}});
        emit("camera.frame", {{"what", "all"}});
    }
    explain("Shows each solver's chain in its own view, all with the same camera, instead of all in one.");
    start_buttons("race.open", emit);
    end_row();
    if (row_button("Copy numbers as CSV", 1, true,
                   "Every solver's distance from the target, time and status at each iteration"))
        emit("race.copy");
    const std::string film = "Writes the race from its start to its end as an animated PNG of " +
                             fixed_text(race_film_seconds(shown.last()), 0) +
                             " s beside the scene, with names, iterations, errors and the plot. The command "
                             "race.record also writes GIF and MP4, at "
                             "any size and pace.";
    if (row_button("Record the race", 2, true, film.c_str())) emit("race.record");
    if (row_button(
            "Save a picture", 2, true,
            "Saves or copies the scene, as Ctrl+P does; with the plot by iteration unless side by side"))
        emit("view.picture_dialog");
    end_row();
}

}  // namespace tendril::app
