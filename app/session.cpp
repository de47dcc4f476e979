#include "app/session.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <utility>

#include "app/app.hpp"
#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/labs.hpp"
#include "app/live_loop.hpp"
#include "app/system/atomic_file.hpp"
#include "app/system/environment.hpp"
#include "app/system/file.hpp"

namespace tendril::app {
namespace {

std::atomic<bool> ending{false};  // safe to set in a signal handler

constexpr glm::ivec2 headless_size{1280, 720}, window_size{1440, 900};

std::unique_ptr<Window> make_window(const SessionOptions& options, glm::ivec2 size) {
    if (!options.headless) {
        try {
            return open_window(Backend::Glfw, size);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(std::string(error.what()) +
                                     "; --headless --screenshot FILE draws without a window");
        }
    }
    return options.backend ? open_window(*options.backend, size) : open_offscreen(size);
}

/// Fails before anything runs if an output could not be written at the end.
Outputs check_outputs(const SessionOptions& options) {
    Outputs outputs;
    outputs.force = options.force;
    if (!options.script.empty()) outputs.inputs.emplace_back(options.script);
    std::vector<std::filesystem::path> before;
    for (const auto& [path, kind] : {std::pair{options.screenshot, OutputKind::Picture},
                                     {options.state, OutputKind::State},
                                     {options.record, OutputKind::Recording}}) {
        if (path.empty()) continue;
        std::error_code error;
        const auto file = std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
        const bool is_file =
            !std::filesystem::exists(file, error) || std::filesystem::is_regular_file(file, error);
        if (is_file && std::ranges::find(before, file) != before.end())
            throw std::runtime_error(path + " is named for two outputs");
        before.push_back(file);
        outputs.check({path}, kind, kind != OutputKind::Recording);
        check_writable(path);
        outputs.own(path, file_stamp(path));
    }
    outputs.in_window = !options.headless;  // refusals so far cannot be repeated
    return outputs;
}

Script read_script(const SessionOptions& options, const CommandTable& commands) {
    if (options.script.empty()) return {};
    try {
        return parse_script(read_text_file(options.script), commands);
    } catch (const std::runtime_error& error) {
        const std::string what = error.what();
        throw std::runtime_error(what.starts_with("line ") ? options.script + ": " + what : what);
    }
}

/// Leaves nothing to undo or save: the session starts here. False if a lab of the file could not be read.
bool open_given(App& app, const std::string& file) {
    Workspace& workspace = app.workspace();
    if (file_route(app.labs(), file).lab == nullptr) {
        const std::vector<LabNote> notes = load_scene_file(workspace, file);
        return std::ranges::all_of(notes, &LabNote::whole);
    }
    const std::uint64_t beginnings = workspace.beginnings;
    app.commands().run(workspace, "file.open", {{"path", file}});
    app.commands().find("file.open")->finish(workspace);
    workspace.saved = workspace.document;
    workspace.history.clear();
    if (workspace.beginnings == beginnings)
        workspace.start_anew();  // otherwise the file brought its own past
    return true;
}

/// The recording's first line holds the start.
void start_recorded(App& app, const SessionOptions& options, const RecordingStart& start) {
    try {
        app.start_from(start);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(options.script + ": line " + std::to_string(start.line) + ": " +
                                 error.what());
    }
}

/// Uses another name if another program has created that file meanwhile: the session cannot be repeated.
void write_recording(App& app, const std::filesystem::path& wanted) {
    const auto [path, refusal] = app.workspace().writes().place_at_end(wanted, OutputKind::Recording);
    write_file_atomically(path, app.recording());
    if (!refusal.empty()) throw std::runtime_error(refusal + "; the recording is in " + path.string());
}

/// Writes all outputs, then reports the first failure.
void write_outputs(App& app, const SessionOptions& options) {
    app.workspace().outputs.in_window = false;
    std::exception_ptr failure;
    const auto write = [&](const std::string& path, auto writer) {
        try {
            if (!path.empty()) writer();
        } catch (const std::runtime_error&) {
            if (!failure) failure = std::current_exception();
        }
    };
    write(options.record, [&] { write_recording(app, options.record); });
    write(options.state, [&] { app.write_state(options.state); });
    write(options.screenshot, [&] { app.write_screenshot(options.screenshot); });
    if (failure) std::rethrow_exception(failure);
}

void run_headless(App& app, Player& player, int frames) {
    while (!player.done() && !ending && !app.quit()) player.advance(app);
    for (int i = 0; i < frames && !ending && !app.quit(); ++i) app.tick(nullptr);
}

int run(const SessionOptions& options) {
    Outputs outputs = check_outputs(options);
    const Labs labs;
    Script script = read_script(options, make_command_table(labs));
    glm::ivec2 size = options.size.value_or(options.headless ? headless_size : window_size);
    if (script.start) size = script.start->size;

    const auto window = make_window(options, size);
    if (!options.size && !script.start) window->fit_screen();
    App app(*window, options.headless);
    app.workspace().names_pictures = !options.headless;
    app.workspace().outputs = std::move(outputs);
    // A recording has its own settings, which must not replace the user's.
    const bool config = options.config && !options.headless && !script.start;
    // Off screen the config folder is only used by commands.
    if (options.config && !script.start) app.workspace().config = config_folder();
    LiveLoop live(app, *window, {.config = config, .ending = ending});
    if (!options.headless && options.script.empty()) offer_cards(app);
    int exit_code = open_scene(app, options) || !options.headless ? 0 : 2;
    if (script.start) start_recorded(app, options, *script.start);
    if (!options.record.empty()) app.start_recording(!options.headless);

    Player player(std::move(script));
    try {
        if (options.headless) {
            run_headless(app, player, options.frames.value_or(0));
        } else {
            live.run(player, options.frames);
        }
    } catch (const ScriptFailure& failure) {
        complain(options.script + ": " + failure.what());
        exit_code = 1;
    } catch (const std::runtime_error& error) {  // a screenshot or state could not be written
        complain(error.what());
        exit_code = 2;
    }
    write_outputs(app, options);
    return exit_code;
}

/// True if the user has already chosen the lab's setting that the command changes.
bool is_chosen(const Lab& lab, const Settings& settings, const std::string& command) {
    return std::ranges::any_of(lab.all_settings(), [&](const LabSetting& each) {
        return each.command == command && settings.choices.contains(each.key);
    });
}

}  // namespace

bool open_scene(App& app, const SessionOptions& options) {
    const bool whole = options.scene.empty() || open_given(app, options.scene);
    if (!options.lab.empty()) {
        if (app.labs().find(options.lab) == nullptr) {
            throw std::runtime_error("there is no lab \"" + options.lab + "\"; --list-labs names them");
        }
        app.workspace().open_lab(options.lab);
        app.workspace().cameras.clear();  // a recording only stores the open lab's camera
    }
    if (opens_alive(options)) open_alive(app);
    app.settle();
    return whole;
}

int run_session(const SessionOptions& options) {
    try {
        return run(options);
    } catch (const std::exception& error) {
        complain(error.what());
        return 2;
    }
}

void end_session_on_signals() {
    handle_end_signals([](int) { ending = true; });
}

void end_at_once_on_signals() {
    handle_end_signals(SIG_DFL);
}

const std::atomic<bool>& session_ending() {
    return ending;
}

bool opens_alive(const SessionOptions& options) {
    return !options.headless && options.scene.empty() && options.script.empty() && options.lab.empty();
}

void open_alive(App& app) {
    Workspace& workspace = app.workspace();
    const std::string first = workspace.lab;
    const auto set_up = [&](const Lab& lab) {
        workspace.open_lab(lab.name());
        for (const CommandCall& call : lab.opening()) {
            if (is_chosen(lab, workspace.settings, call.name)) continue;
            app.commands().run(workspace, call.name, to_json(call.arguments));
        }
    };
    for (const auto& lab : app.labs().all())
        if (lab->name() != first) set_up(*lab);
    set_up(*app.labs().find(first));
    workspace.saved = workspace.document;
    workspace.history.clear();
    const auto cameras = workspace.cameras;
    workspace.start_anew();
    workspace.cameras = cameras;
    for (const auto& lab : app.labs().all()) workspace.openings.insert(lab->name());
}

void offer_cards(App& app) {
    Settings& settings = app.workspace().settings;
    for (const auto& lab : app.labs().all())
        if (!card_known(settings, lab->name())) show_card(settings, lab->name(), true);
}

}  // namespace tendril::app
