#include "app/labs/signal/signal_lab.hpp"

#include <algorithm>
#include <cmath>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/code_text.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/panel.hpp"

namespace tendril::app {
namespace {

constexpr PickId hand_pick = 0, output_pick = 1;

Json number_or_null(const std::optional<double>& value, double factor) {
    return value ? Json(factor * *value) : Json(nullptr);
}

Json following_name(signal::Following following) {
    switch (following) {
        case signal::Following::Follows:
            return "follows";
        case signal::Following::DoesNotFollow:
            return "does_not_follow";
        case signal::Following::Unstable:
            return "unstable";
        default:
            return nullptr;
    }
}

std::string initialiser(const signal::Filter& filter) {
    const signal::Kind& kind = signal::kind_of(filter);
    return library_name(kind.in_code) +
           struct_text({kind.table(), signal::fields_in(filter)}, "                        ");
}

}  // namespace

std::shared_ptr<Part> SignalLab::blank() const {
    return std::make_shared<SignalPart>(signal_presets().front().part);
}

CameraPose SignalLab::first_view() const {
    return {.target = {0.0f, ball_level, 0.0f}, .pitch = 0.06f, .distance = 3.6f};
}

void SignalLab::add_commands(CommandTable& table) const {
    add_filter_commands(table);
    add_input_commands(table);
    add_fit_commands(table);
}

/// At rest if the hand has not moved for as long as the plot shows.
bool SignalLab::moving(const Workspace& workspace) const {
    const SignalPart& part = signal_part(workspace);
    if (part.recording && !part.recording->begun) return false;
    if (part.input.kind != InputKind::Hand || part.past.size() < max_past) return true;
    const double first = part.past.front().input;
    const bool still = std::all_of(part.past.begin(), part.past.end(),
                                   [&](const signal::Sample& row) { return row.input == first; });
    return !still || part.input.hand != first;
}

void SignalLab::step(Workspace& workspace) const {
    const bool modified = workspace.modified();
    pass_signal_time(workspace.document.edit<SignalPart>(signal_lab),
                     tick_seconds * static_cast<double>(workspace.clock.speed));
    if (!modified) workspace.saved = workspace.document;  // time does not mark the scene as modified
}

void SignalLab::work(Workspace& workspace) const {
    const bool modified = workspace.modified();
    signal_runtime(workspace).fit_work.advance(workspace.document.edit<SignalPart>(signal_lab));
    if (!modified) workspace.saved = workspace.document;
}

void SignalLab::timeline(const Workspace& workspace, Emit& emit) const {
    replay_button(workspace, emit);
    past_time_strip(workspace, emit);
}

std::vector<Handle> SignalLab::handles(const Workspace& workspace) const {
    const SignalPart& part = signal_part(workspace);
    const BallPlaces places = ball_places(part);
    return {{"hand", hand_pick, {places.input}},
            {.name = "output",
             .pick = output_pick,
             .frame = {places.output},
             .drag = part.recording ? Drag::Position : Drag::Nothing}};
}

void SignalLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const {
    const double height = static_cast<double>(frame.position.y - ball_level);
    const double value = std::clamp(height, -max_amplitude, max_amplitude);
    if (pick == hand_pick) emit.continuously("signal.hand", {{"value", value}});
    if (pick == output_pick && signal_part(workspace).recording)
        emit.continuously("signal.fit.hand", {{"value", value}});
}

/// A CSV file becomes the input.
std::vector<FileKind> SignalLab::files() const {
    return {{"signals", {".csv"}, "signal.input", {{"kind", "csv"}}}};
}

/// Ends the recording in the same undo step as the drag.
void SignalLab::drop(const Workspace& workspace, PickId pick, Emit& emit) const {
    const auto& recording = signal_part(workspace).recording;
    if (pick == output_pick && recording && recording->begun) emit.continuously("signal.fit.stop");
}

std::string SignalLab::hint(const Workspace& workspace, PickId pick) const {
    const SignalPart& part = signal_part(workspace);
    const bool hand = part.input.kind == InputKind::Hand;
    if (pick == output_pick && part.recording)
        return "The output: drag it as it should move; releasing it ends the recording.";
    if (pick == hand_pick)
        return hand ? "The input: drag it up and down." : "The input: drag it to take it over by hand.";
    if (pick == output_pick) return "The output of the whole chain.";
    return {};
}

std::vector<Shortcut> SignalLab::shortcuts() const {
    return {delete_shortcut("signal.filter.remove_selected")};
}

std::vector<MouseHelp> SignalLab::mouse_help() const {
    return {{"Left drag on the orange ball", "makes the hand's height the input"},
            {"Left drag on the blue ball, after Record", "records the desired response"},
            {"Mouse over a plot", "reads every curve at that time"},
            {"CSV file, opened or dropped", "becomes the input"},
            {"Left drag in the plot Fit", "draws the desired response"},
            {"Curve: drag, double-click, right-click", "moves, adds, removes a key"}};
}

Json SignalLab::state(const Workspace& workspace) const {
    const SignalPart& part = signal_part(workspace);
    const ChainAnalysis& analysis = signal_runtime(workspace).chain(part);
    Json filters = Json::array(), fits = Json::array();
    for (std::size_t i = 0; i < part.stages.size(); ++i) {
        const SignalStage& stage = part.stages[i];
        const signal::Measures& measures = analysis.stages[i];
        Json json = save_fields(stage);
        json["output"] = output_of(part, {lane_of(part, i).first, i + 1});
        json["following"] = following_name(measures.following);
        json["lag_ms"] = number_or_null(measures.lag, 1e3);
        json["overshoot_percent"] = number_or_null(measures.overshoot, 1e2);
        json["settling_ms"] = number_or_null(measures.settling_time, 1e3);
        json["jitter_percent"] = number_or_null(measures.jitter, 1e2);
        json["rate_difference"] = measures.rate_difference;
        filters.push_back(std::move(json));
    }
    for (const Fit& fit : part.fits)
        fits.push_back({{"filter", filter_json(fit.filter)}, {"residual", fit.residual}});
    Json input = save_fields(part.input);
    input["value"] = input_of(part);
    if (part.input.file) input["rows"] = rows_text(*part.input.file);
    return Json{{"lab", signal_lab},
                {"input", std::move(input)},
                {"output", output_of(part)},
                {"verdict", signal_verdict(part, analysis.whole).text},
                {"filters", std::move(filters)},
                {"seconds", part.time},
                {"selected", part.selected ? Json(*part.selected) : Json(nullptr)},
                {"plot", signal_plots.name(part.plot)},
                {"wanted", part.recording ? part.recording->rows : part.wanted.size()},
                {"recording", part.recording.has_value()},
                {"fits", std::move(fits)},
                {"fitting", part.fitting.has_value()}};
}

Verdict signal_verdict(const SignalPart& part, const signal::Measures& whole) {
    if (enabled_filters(part).empty())
        return {"No filter is on", Verdict::Kind::Open, "The output is the input."};
    if (whole.following == signal::Following::Unstable)
        return {"Runs away", Verdict::Kind::Bad, "The output keeps growing away from the input."};
    if (whole.following == signal::Following::DoesNotFollow)
        return {"Does not follow", Verdict::Kind::Bad,
                "Shifted in time by any amount, the output does not match the input."};
    std::string why;
    const auto add = [&](const std::string& what) { why += (why.empty() ? "" : ", ") + what; };
    if (whole.lag)
        add(std::abs(*whole.lag) < 5e-5 ? "no lag" : si_text(*whole.lag, "s") + " behind the input");
    if (whole.overshoot) {
        add(*whole.overshoot < 5e-4 ? "no overshoot"
                                    : "overshoots by " + fixed_text(100.0 * *whole.overshoot, 1) + " %");
    }
    if (!why.empty() && std::ranges::count(part.stages, true, &SignalStage::enabled) > 1)
        why = stage_title(part, *shown_stage(part)) + ": " + why;
    if (!why.empty()) why = capitalised(why) + '.';
    if (whole.settling_time)
        return {"Settles in " + si_text(*whole.settling_time, "s"), Verdict::Kind::Good, why};
    if (whole.overshoot)
        return {"Does not settle", Verdict::Kind::Bad,
                "It is still moving when the input jumps again. " + why};
    if (whole.following == signal::Following::Follows) return {"Follows", Verdict::Kind::Good, why};
    return {"Nothing to follow yet", Verdict::Kind::Open, "The input has not changed."};
}

/// A complete program: the enabled filters, stepped frame by frame through one second after a jump.
std::string SignalLab::code(const Workspace& workspace) const {
    std::string text =
        "// Filters, exported from Tendril.\n"
        "//\n"
        "// CMake: find_package(tendril REQUIRED)\n"
        "//        target_link_libraries(your_program PRIVATE tendril::core)\n"
        "#include <cstdio>\n"
        "#include <tendril/signal/run.hpp>\n"
        "#include <vector>\n\n"
        "using namespace tendril;\n\n"
        "int main() {\n"
        "    // Applied in this order.\n"
        "    const std::vector<signal::Filter> filters{";
    const std::vector<signal::Filter> filters = enabled_filters(signal_part(workspace));
    for (const signal::Filter& filter : filters) text += "\n        " + initialiser(filter) + ",";
    text += filters.empty() ? "};\n" : "\n    };\n";
    text +=
        "    // What they remember: copy it to save it, start from a fresh one to reset them.\n"
        "    std::vector<signal::FilterState> states(filters.size());\n\n"
        "    const double dt = 1.0 / 60.0;\n"
        "    for (int frame = 0; frame <= 60; ++frame) {\n"
        "        const double input = frame == 0 ? 0.0 : 1.0;  // a jump\n"
        "        const double output = signal::step(filters, states, input, dt);\n"
        "        std::printf(\"%.4f %.6f\\n\", frame * dt, output);\n"
        "    }\n"
        "}\n";
    return text;
}

}  // namespace tendril::app
