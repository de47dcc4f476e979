
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <sstream>
#include <string>
#include <tendril/chain/segment.hpp>
#include <tendril/version.hpp>

#include "app/batch/output.hpp"
#include "app/batch/subcommands.hpp"
#include "app/document/command.hpp"
#include "app/io/solver_text.hpp"
#include "app/io/text.hpp"
#include "app/labs/labs.hpp"
#include "app/session.hpp"
#include "app/shell/shortcuts.hpp"

namespace tendril::app {
namespace {

/// "1280x720"; throws CLI::ValidationError for anything else or a size out of range.
glm::ivec2 read_size(const std::string& text) {
    int width = 0, height = 0, used = 0;
    const int read = std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &used);
    if (read != 2 || used != static_cast<int>(text.size()) || width < 1 || height < 1 || width > 16384 ||
        height > 16384) {
        throw CLI::ValidationError("--size: must be WIDTHxHEIGHT, each 1 to 16384, got \"" + text + "\"");
    }
    return {width, height};
}

/// Prints to standard output. Throws std::runtime_error if that fails.
void print(const std::string& text) {
    Progress none;
    Output out(none);
    out.write(text);
    out.finish();
}

std::string list_of_commands() {
    const Labs labs;
    std::string list;
    const auto type_text = [](ArgumentType type) {
        switch (type) {
            case ArgumentType::Number:
                return "number";
            case ArgumentType::Integer:
                return "integer";
            case ArgumentType::Boolean:
                return "boolean";
            case ArgumentType::Text:
                return "text";
            case ArgumentType::Point:
                return "[x, y, z]";
            case ArgumentType::NumberOrPoint:
                return "number or [x, y, z]";
            case ArgumentType::Rotation:
                return "[x, y, z, w] or [x, y, z] in degrees";
            case ArgumentType::List:
                return "list";
            case ArgumentType::ListOrText:
                return "list or text";
            case ArgumentType::Any:
                return "JSON";
        }
        return "";
    };
    const CommandTable table = make_command_table(labs);
    for (const Command& command : table.all()) {
        list += usage(command) + "\n    " + command.title + "\n    " + command.help + '\n';
        for (const Argument& argument : command.arguments) {
            std::string choices;
            for (const auto& choice : argument.choices) choices += (choices.empty() ? ": " : ", ") + choice;
            const std::string name =
                argument.name +
                std::string(std::max<std::size_t>(argument.name.size(), 18) - argument.name.size(), ' ');
            list += "    " + name + ' ' + type_text(argument.type) +
                    (argument.required ? "; " : ", optional; ") + argument.help + choices + '\n';
        }
    }
    return list;
}

std::string list_of_labs() {
    std::string list;
    for (const Labs labs; const auto& lab : labs.all()) list += lab->name() + '\n';
    return list;
}

/// The command line of a session.
struct SessionLine {
    SessionOptions options;
    std::string size;
    bool no_config = false, labs = false, commands = false, shortcuts = false;

    void add_to(CLI::App& line);
    void check();
    int run();
};

void SessionLine::add_to(CLI::App& line) {
    static const std::map<std::string, Backend> backends{
        {"glfw", Backend::Glfw}, {"osmesa", Backend::OsMesa}, {"egl", Backend::Egl}};
    line.add_option("SCENE", options.scene, "A scene to open, or any file that a lab reads");
    line.add_option("--lab", options.lab, "Open this lab")->option_text("NAME");
    line.add_option("--size", size, "Size of the window, or of the picture")->option_text("WxH");
    line.add_flag("--headless", options.headless, "Without a window or a display");
    line.add_option_function<std::string>(
            "--backend", [this](const std::string& name) { options.backend = backends.at(name); },
            "Drawing backend: a window, or one of the two that need no display")
        ->check(CLI::IsMember({"glfw", "osmesa", "egl"}))
        ->option_text("glfw|osmesa|egl");
    line.add_option("--script", options.script, "Play a script or a recording")->option_text("FILE");
    line.add_option("--frames", options.frames, "Then run this many ticks of 1/60 s and exit")
        ->check(CLI::Range(0, 1'000'000))
        ->option_text("N");
    line.add_option("--screenshot", options.screenshot, "Write the final picture")->option_text("PNG");
    line.add_option("--state", options.state, "Write the final state")->option_text("JSON");
    line.add_option("--record", options.record, "Record your actions as a script")->option_text("FILE");
    line.add_flag("--force", options.force, "Replace files that exist; see app/README.md");
    line.add_flag("--no-config", no_config, "Do not read or write settings or kept bone maps");
    line.add_flag("--list-labs", labs, "Print the labs");
    line.add_flag("--list-commands", commands, "Print every command with its arguments");
    line.add_flag("--list-shortcuts", shortcuts, "Print the keys and mouse actions, as in app/README.md");
    line.set_version_flag("--version", std::string("tendril ") + tendril::version_string);
}

void SessionLine::check() {
    if (!size.empty()) options.size = read_size(size);
    if (options.backend && *options.backend != Backend::Glfw) options.headless = true;
    if (options.headless && options.backend == Backend::Glfw) {
        throw CLI::ValidationError("--backend glfw opens a window, --headless forbids one");
    }
    options.config = !no_config;
}

int SessionLine::run() {
    if (labs) print(list_of_labs());
    if (commands) print(list_of_commands());
    if (shortcuts) {
        const Labs all;
        print(Shortcuts(all, make_command_table(all)).markdown());
    }
    if (labs || commands || shortcuts) return 0;
    return run_session(options);
}

struct SolveLine {
    SolveOptions options;
    std::string solver = "fabrik";
    bool csv = false, json = false;

    CLI::App* add_to(CLI::App& line);
    const SolveOptions& checked();
};

CLI::App* SolveLine::add_to(CLI::App& line) {
    CLI::App* solve = line.add_subcommand("solve", "Solve the cases of a file and print the answers");
    solve->add_option("CASES", options.cases, "A list of cases as JSON; see below")->required();
    solve->add_option("--solver", solver, "A solver, or all; default: fabrik")->option_text("NAME|all");
    solve
        ->add_option("--max-iterations", options.max_iterations,
                     "1 to 1000000; default: 100, of a linkage 1000")
        ->check(CLI::Range(1, 1'000'000))
        ->option_text("N");
    solve
        ->add_option("--tolerance", options.tolerance,
                     "Default: 1e-3 of the reach; of a linkage 1e-10 of its size")
        ->option_text("METRES");
    solve->add_option("--drive", options.drivers, "A linkage's driver, degrees or metres; can be repeated")
        ->option_text("JOINT=VALUE|FROM:TO:STEP");
    solve->add_option("--target", options.targets, "Pulls a linkage's point; can be repeated")
        ->option_text("POINT=X,Y,Z");
    const auto csv_flag = solve->add_flag("--csv", csv, "Print rows of comma-separated values");
    solve->add_flag("--json", json, "Print one JSON array, with positions of joints or points")
        ->excludes(csv_flag);
    solve->footer("Solvers: " + method_names() + ".\n" + solve_help);
    return solve;
}

const SolveOptions& SolveLine::checked() {
    options.format = csv ? RowFormat::Csv : json ? RowFormat::Json : RowFormat::Table;
    options.methods = methods_named(solver);
    // CLI::Range would accept NaN.
    if (const auto& t = options.tolerance; t && !(*t >= 0.0f && *t <= tendril::max_magnitude))
        throw CLI::ValidationError("--tolerance: must be 0 to 1e9 metres, got " + std::to_string(*t));
    return options;
}

CLI::App* add_signal(CLI::App& line, SignalOptions& options) {
    CLI::App* signal =
        line.add_subcommand(signal_subcommand, "Run filters over samples, or fit them to a response");
    signal->add_option("FILTER", options.filters, "A filter as JSON, or a list of them; see below")
        ->required();
    signal->add_option("SAMPLES", options.samples, "A CSV file: dt,input")->required();
    const auto rates = signal->add_flag("--rates", options.rates, "Print an output for each frame rate");
    signal->add_option("--fit", options.fit, "Fit every kind of filter to this CSV file")
        ->option_text("RESPONSE")
        ->excludes(rates);
    signal->footer(signal_help());
    return signal;
}

CLI::App* add_lint(CLI::App& line, LintOptions& options) {
    CLI::App* lint = line.add_subcommand("lint", "Report faults in a character's clips");
    lint->add_option("FILE", options.file, "A character: .gltf, .glb, .vrm, .vrma, .fbx or .bvh")->required();
    lint->add_option("--motion", options.motion, "Check another character's clips on this one")
        ->option_text("FILE");
    lint->add_flag("--json", options.json, "Print one JSON object");
    lint->footer(lint_help);
    return lint;
}

CLI::App* add_bake(CLI::App& line, BakeOptions& options) {
    CLI::App* bake = line.add_subcommand("bake", "Write a character's clip to a file, feet on the ground");
    bake->add_option("FILE", options.file, "A character: .gltf, .glb, .vrm, .vrma, .fbx or .bvh")->required();
    bake->add_option("--motion", options.motion, "Take the clips from another character's file")
        ->option_text("FILE");
    CLI::Option* const clip =
        bake->add_option("--clip", options.clip, "A clip; default: the first")->option_text("NAME");
    bake->add_flag("--all", options.all, "Every clip, each to its own file")->excludes(clip);
    bake->add_option("--ground", options.ground,
                     "The ground under its feet; default: none, feet not corrected")
        ->check(CLI::IsMember(bake_grounds()))
        ->option_text("KIND");
    bake->add_flag("--travel", options.travel,
                   "A clip that walks in place travels at its standing foot's speed");
    bake->add_option("--fps", options.fps, "Frames per second, 1 to 1000; default: the clip's own")
        ->check(CLI::Range(1.0, 1000.0))
        ->option_text("N");
    bake->add_option("--out", options.out, "A .gltf, .glb or .bvh file; see below")->option_text("FILE");
    bake->add_flag("--force", options.force, "Replace a .gltf, .glb or .bvh file that exists");
    bake->footer(bake_help);
    return bake;
}

CLI::App* add_trace(CLI::App& line, TraceOptions& options) {
    CLI::App* trace = line.add_subcommand("trace", "Explain an engine's chain, frame by frame");
    trace->add_option("FILE", options.file, "JSON Lines, CSV or a log; see below")->required();
    const auto csv = trace->add_flag("--csv", options.csv, "Print rows of comma-separated values");
    trace->add_flag("--json", options.json, "Print one JSON array")->excludes(csv);
    ConventionChoice& choice = options.conventions;
    trace->add_option("--up", choice.up, "The up axis; overrides the file")
        ->check(CLI::IsMember(trace_ups.names()))
        ->option_text("y|z");
    trace->add_option("--handed", choice.handed, "The handedness of its axes")
        ->check(CLI::IsMember(trace_hands.names()))
        ->option_text("right|left");
    trace->add_option("--unit", choice.unit, "The unit of its positions")
        ->check(CLI::IsMember(trace_units.names()))
        ->option_text("m|cm|mm");
    trace->add_option("--rotations", choice.rotations, "The order of a quaternion's numbers")
        ->check(CLI::IsMember(quaternion_orders.names()))
        ->option_text("xyzw|wxyz");
    trace
        ->add_option("--target-joint", choice.target_joint,
                     "The joint that reaches for the target, from 0 at the root; default: the nearest to it")
        ->option_text("N");
    trace->add_option("--fps", options.fps, "Frames per second; default: the file's, or 60")
        ->option_text("N");
    trace->footer(trace_help);
    return trace;
}

/// Options before a subcommand are for the window, which a subcommand does not open.
void refuse_options_before(const CLI::App& line, const CLI::App& subcommand) {
    for (const CLI::Option* option : line.get_options()) {
        if (option->count() > 0) {
            throw CLI::ValidationError(subcommand.get_name() + " does not take " + option->get_name() +
                                       "; to open a scene file of that name, write ./" +
                                       subcommand.get_name());
        }
    }
}

/// The subcommands, which draw nothing; each has its own help.
class BatchLine {
  public:
    explicit BatchLine(CLI::App& line)
        : line_(line),
          solve_(solve_options_.add_to(line)),
          signal_(add_signal(line, signal_options_)),
          paper_(line.add_subcommand("paper", "Measure the solvers and print a table")),
          code_(line.add_subcommand("code", "Print a scene as a C++ program that uses the library")),
          lint_(add_lint(line, lint_options_)),
          bake_(add_bake(line, bake_options_)),
          trace_(add_trace(line, trace_options_)) {
        paper_->add_flag("--csv", paper_csv_, "Print rows of comma-separated values");
        paper_->footer(paper_help);
        code_->add_option("SCENE", scene_, "A scene file; its open lab is printed")->required();
    }
    bool asked() const { return !line_.get_subcommands().empty(); }
    /// The program's exit code.
    int run() {
        refuse_options_before(line_, *line_.get_subcommands().front());
        const std::atomic<bool>& ending = session_ending();
        if (solve_->parsed()) solve_cases(solve_options_.checked(), ending);
        if (signal_->parsed()) run_signal(signal_options_, ending);
        if (paper_->parsed()) print_paper(paper_csv_, ending);
        if (code_->parsed() || bake_->parsed() || lint_->parsed() || trace_->parsed())
            end_at_once_on_signals();
        if (code_->parsed()) print_code(scene_);
        if (bake_->parsed()) run_bake(bake_options_);
        if (trace_->parsed()) return run_trace(trace_options_) > 0 ? 1 : 0;
        return lint_->parsed() && run_lint(lint_options_) > 0 ? 1 : 0;
    }

  private:
    CLI::App& line_;
    SolveLine solve_options_;
    SignalOptions signal_options_;
    LintOptions lint_options_;
    BakeOptions bake_options_;
    TraceOptions trace_options_;
    CLI::App *solve_, *signal_, *paper_, *code_, *lint_, *bake_, *trace_;
    bool paper_csv_ = false;
    std::string scene_;
};

/// Prints the help or the version.
int print_help(const CLI::App& line, const CLI::ParseError& error) {
    std::ostringstream text;
    const int exit_code = line.exit(error, text);
    try {
        print(text.str());
        return exit_code;
    } catch (const std::exception& failure) {
        complain(failure.what());
        return 2;
    }
}

}  // namespace

int run_command_line(const std::vector<std::string>& words) {
    CLI::App line("Tendril: see, tune and export procedural animation.", "tendril");
    SessionLine session;
    session.add_to(line);
    BatchLine batch(line);
    line.require_subcommand(0, 1);
    try {
        line.parse(
            std::vector<std::string>(words.rbegin(), words.rend() - 1));  // CLI11 takes them from the back
        if (!batch.asked()) {
            session.check();
            return session.run();
        }
        return batch.run();
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return print_help(line, error);
        complain(error.what());
        return 2;
    } catch (const std::exception& error) {
        complain(error.what());
        return 2;
    }
}

}  // namespace tendril::app
