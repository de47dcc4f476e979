#include "app/labs/signal/panel.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>

#include "app/fields/field_rows.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/signal/analysis.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/signal_lab.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

// The panel: presets, input and filters.

namespace {

void preset_section(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const SignalPreset& preset : signal_presets())
        buttons.push_back({preset.name, preset.title, preset.point});
    preset_rows(signal_lab, buttons, "Removes every filter", emit, 1);
}

void input_section(const SignalPart& part, Emit& emit) {
    const SignalInput& input = part.input;
    int chosen = static_cast<int>(input.kind);
    const auto titles = input_kinds.titles();
    const char* why_not[6] = {};
    const bool recorded = input.recording || input.kind == InputKind::Hand;
    if (!recorded) why_not[static_cast<int>(InputKind::Recorded)] = "drag the ball first";
    if (!input.file) why_not[static_cast<int>(InputKind::Csv)] = "give a file below";
    if (choice_field("kind", chosen, titles.data(), 6, why_not))
        emit("signal.input", {{"kind", input_kinds.name(static_cast<InputKind>(chosen))}});
    explain("The input of the first filter.");
    const bool wave =
        input.kind == InputKind::Square || input.kind == InputKind::Sine || input.kind == InputKind::Noise;
    if (wave) {
        float amplitude = static_cast<float>(input.amplitude), period = static_cast<float>(input.period);
        if (number_field("amplitude", amplitude, 0.01f, 0.0f, 100.0f, "%.2f"))
            emit.continuously("signal.input", {{"amplitude", amplitude}});
        explain("How far the input goes to each side of 0.");
        if (number_field("period", period, 0.02f, 0.1f, 60.0f, "%.2f s"))
            emit.continuously("signal.input", {{"period", period}});
        explain(input.kind == InputKind::Noise
                    ? "The slow drift turns towards a new value four times in this time."
                    : "How long it takes until the input repeats.");
    }
    if (input.kind == InputKind::Hand) {
        float hand = static_cast<float>(input.hand);
        if (number_field("value", hand, 0.01f, -1e6f, 1e6f, "%.3f"))
            emit.continuously("signal.hand", {{"value", hand}});
        explain("The input itself: how high the orange ball is.");
    }
    std::string path = input.path;
    if (text_field("CSV file", path, "path, Enter opens it"))
        emit("signal.input", {{"kind", "csv"}, {"path", path}});
    explain("A file whose rows become a looping input. Enter opens it.");
    note(input_kinds.help(input.kind));
}

void export_section(Emit& emit) {
    if (row_button("Copy as C++", 2, true,
                   "Copies the filters that make the shown output as a program that uses the library"))
        emit("signal.copy", {{"as", "cpp"}});
    if (row_button("Copy as CSV", 2, true, "Time, input and every stage of the last ten seconds"))
        emit("signal.copy", {{"as", "csv"}});
}

/// One button with a list: fourteen buttons would be too many.
void add_button(Emit& emit) {
    const bool pressed = row_button("Add a filter", 2, true,
                                    "Choose a kind; the new filter is beside the others, on the same input");
    if (!begin_list_of_button("add filter", pressed)) return;
    for (const signal::Kind& kind : signal::kinds())
        if (list_row(kind_title(kind), false))
            emit("signal.filter.add", {{"kind", kind.name}, {"beside", true}});
    end_list();
}

}  // namespace

std::string kind_title(const signal::Kind& kind) {
    std::string title = kind.name;
    if (title == "one_euro") return "1 Euro";
    if (title == "interp_to") return "Interp to (engine)";
    if (title == "interp_to_exact") return "Interp to, exact";
    if (title == "spring_semi_implicit") return "Spring, semi-implicit";
    std::replace(title.begin(), title.end(), '_', ' ');
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
    return title;
}

std::string kind_title(const signal::Filter& filter) {
    return kind_title(signal::kind_of(filter));
}

std::string rows_text(const InputRows& rows) {
    constexpr double even = 1.15;  // at 60 Hz, times in whole milliseconds are 16 and 17 apart
    double shortest = rows.back().dt, longest = shortest;
    for (std::size_t i = 1; i < rows.size(); ++i)  // the first row's dt is a copy of the second's
        shortest = std::min(shortest, rows[i].dt), longest = std::max(longest, rows[i].dt);
    const std::string spread =
        longest <= even * shortest
            ? si_text(length_of(&rows) / static_cast<double>(rows.size()), "s") + " apart"
            : "uneven: " + si_text(shortest, "s") + " to " + si_text(longest, "s") + " apart";
    return std::to_string(rows.size()) + " rows in " + si_text(length_of(&rows), "s") + ", " + spread + '.';
}

std::string stage_title(const SignalPart& part, std::size_t stage) {
    const auto same = [&](std::size_t before) {
        return std::count_if(part.stages.begin(), part.stages.begin() + static_cast<std::ptrdiff_t>(before),
                             [&](const SignalStage& each) {
                                 return each.filter.index() == part.stages[stage].filter.index();
                             });
    };
    const std::string title = kind_title(part.stages[stage].filter);
    return same(part.stages.size()) > 1 ? title + " " + std::to_string(same(stage) + 1) : title;
}

void chain_rows(const SignalPart& part, const Palette& palette, Emit& emit) {
    // Above the list, because they change its length.
    add_button(emit);
    const bool chosen = part.selected.has_value();
    const std::size_t at = part.selected.value_or(0);
    const bool after = chosen && at > 0 && !part.stages[at].beside;
    if (row_button(after ? "Beside" : "After", 2, chosen && at > 0,
                   after ? "The selected filter works on the input, beside those above it"
                         : "The selected filter works on the output of the one above it"))
        emit("signal.filter.beside", {{"at", at}, {"on", after}});
    end_row();
    if (row_button("Up", 3, chosen && at > 0, "The selected filter is applied earlier"))
        emit("signal.filter.move", {{"at", at}, {"to", at - 1}});
    if (row_button("Down", 3, chosen && at + 1 < part.stages.size(), "The selected filter is applied later"))
        emit("signal.filter.move", {{"at", at}, {"to", at + 1}});
    if (row_button("Remove", 3, chosen, "Removes the selected filter"))
        emit("signal.filter.remove", {{"at", at}});
    end_row();
    for (std::size_t i = 0; i < part.stages.size(); ++i) {
        const SignalStage& stage = part.stages[i];
        ImGui::PushID(static_cast<int>(i));
        if (i > 0 && !stage.beside)
            ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.8f * ImGui::GetFontSize());
        colour_mark(stage_colour(palette, stage));
        bool on = stage.enabled;
        if (ImGui::Checkbox("##on", &on)) emit("signal.filter.enable", {{"at", i}, {"on", on}});
        if (ImGui::IsItemHovered()) tooltip("Off: its input passes unchanged");
        ImGui::SameLine();
        const float width = std::max(20.0f, ImGui::GetContentRegionAvail().x);
        const bool selected = part.selected == i;
        const std::string title =
            elided(stage_title(part, i), width - 2.0f * ImGui::GetStyle().FramePadding.x);
        ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, ImVec2(0.0f, 0.5f));
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(selected ? ImGuiCol_Header : ImGuiCol_ChildBg));
        if (ImGui::Button((title + "##title").c_str(), {width, 0.0f})) emit("signal.select", {{"at", i}});
        if (ImGui::IsItemHovered()) tooltip("Click selects this filter: its parameters are below");
        ImGui::PopStyleColor();
        ImGui::PopStyleVar();
        ImGui::PopID();
    }
    if (part.stages.empty()) note("No filters: the output is the input.");
    if (part.stages.size() > 1) note("Each works on the input; an indented one, on the filter above it.");
}

void SignalLab::panel(const Workspace& workspace, Emit& emit) const {
    const SignalPart& part = signal_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    if (const FoldingSection open(workspace, "Presets", emit); open) preset_section(emit);
    if (const FoldingSection open(workspace, "Input", emit, false); open) input_section(part, emit);
    if (const FoldingSection open(workspace, "Filters", emit); open) chain_rows(part, colours, emit);
    parameter_rows(workspace, colours, emit);
    if (const FoldingSection open(workspace, "Export", emit, false); open) export_section(emit);
}

// The parameters of the selected filter, from the library's table; for a curve also its editor, for a spring
// two alternative descriptions.

namespace {

/// Half-life, and duration and bounce of the same spring: all can be set.
void spring_rows(const signal::Spring<>& spring, std::size_t at, Emit& emit) {
    const signal::SpringFeel feel = signal::feel_of(spring.strength, spring.critical_damping);
    const auto set = [&](const Expected<signal::SpringShape>& shape) {
        if (!shape) return;
        emit.continuously(
            "signal.filter.set",
            {{"at", at}, {"strength", shape->strength}, {"critical_damping", shape->critical_damping}});
    };
    if (std::isfinite(feel.half_life)) {
        float half_life = static_cast<float>(feel.half_life);
        if (number_field("half-life", half_life, 0.002f, 0.001f, 10.0f, "%.3f s"))
            set(signal::of_half_life(static_cast<double>(half_life), spring.critical_damping));
        explain(
            "The same spring, given by the time until half of the way is left. Sets strength; damping "
            "stays.");
    }
    if (std::isfinite(feel.duration)) {
        float duration = static_cast<float>(feel.duration), bounce = static_cast<float>(feel.bounce);
        bool changed = number_field("duration", duration, 0.005f, 0.01f, 10.0f, "%.3f s");
        explain("The same spring, given by the time of one swing without damping. Sets strength.");
        changed |= number_field("bounce", bounce, 0.005f, -0.9f, 1.0f, "%.3f");
        explain(
            "How much the spring overshoots: 0 does not, 1 swings for ever, less than 0 is sluggish. Sets "
            "the damping.");
        if (changed) set(signal::of_duration(static_cast<double>(duration), static_cast<double>(bounce)));
    }
}

}  // namespace

void parameter_rows(const Workspace& workspace, const Palette& palette, Emit& emit) {
    const SignalPart& part = signal_part(workspace);
    if (!part.selected || *part.selected >= part.stages.size()) return;
    const std::size_t at = *part.selected;
    const signal::Filter& filter = part.stages[at].filter;
    const std::string title = kind_title(filter);
    const PanelSection ids(title.c_str());
    ImGui::PushID(static_cast<int>(at));
    MoreRows more;
    const signal::Kind& kind = signal::kind_of(filter);
    FieldRows rows({kind.table(), signal::fields_in(filter), kind.fresh()}, filter_texts(kind),
                   "signal.filter.set", emit, {{"at", at}});
    rows.under(more);
    for (const FieldText& text : filter_texts(kind)) rows.row(text.name);
    if (const auto* spring = std::get_if<signal::Spring<>>(&filter))
        more.add("half-life, duration, bounce", {}, false,  // strength and damping have rows of their own
                 [spring, at, &emit] { spring_rows(*spring, at, emit); });
    if (const auto* curve = std::get_if<signal::Curve>(&filter)) {
        signal::Curve edited = *curve;
        const double before = output_of(part, {lane_of(part, at).first, at});
        const double range = curve->source_max - curve->source_min;
        const double input = range != 0.0 ? (before - curve->source_min) / range : 0.0;
        if (curve_editor("curve", edited, stage_colour(palette, part.stages[at]), 11.0f, input))
            emit.continuously("signal.filter.set",
                              {{"at", at}, {"keys", SharedJson(save_fields(edited).at("keys"))}});
        note("Drag a key. Double-click adds one, right-click removes it.");
    }
    more_rows(workspace, title.c_str(), more, emit);
    ImGui::PopID();
}

// The inspector: measurements, and the ranking of a fit.

namespace {

struct Reading {
    const char* name;
    std::string text;
    const char* help;
};

std::vector<Reading> readings(const signal::Measures& measures) {
    const bool unstable = measures.following == signal::Following::Unstable,
               follows = measures.following != signal::Following::DoesNotFollow;
    const double differs = measures.rate_difference;
    const auto shown = [&](const std::optional<double>& value, double factor, int decimals,
                           const char* unit) {
        return unstable || !value ? "-" : fixed_text(factor * *value, decimals) + " " + unit;
    };
    return {
        {"lag",
         unstable  ? "unstable"
         : follows ? shown(measures.lag, 1e3, 1, "ms")
                   : "none",
         unstable ? "The output is over ten times the range of the input, and still growing: lag, overshoot, "
                    "settling and jitter mean nothing."
         : follows ? "How long the output trails the input: the shift in time that makes them match best."
                   : "Shifted in time by any amount, the input matches less than a tenth of the output."},
        {"overshoot", shown(measures.overshoot, 1e2, 1, "%"),
         "How far it goes beyond a jump of the input, relative to the jump. Needs jumps: a square wave."},
        {"settling", shown(measures.settling_time, 1e3, 0, "ms"),
         "From a jump until it stays within 2 % of it. Needs jumps: a square wave."},
        {"jitter left", shown(measures.jitter, 1e2, 1, "%"),
         "How much remains of the jitter of the input: second differences, output over input."},
        {"rate difference", differs > 1e6 ? "huge" : fixed_text(differs, differs < 10.0 ? 3 : 0),
         "The maximum difference, at any one time, between outputs at 15, 30, 60, 144 Hz and uneven "
         "frames."}};
}

float reading_column() {
    return 4.1f * ImGui::GetFontSize();  // holds "1184.2 %"
}

/// Number of filters whose numbers fit beside their names.
std::size_t filters_a_row() {
    const float two = ImGui::CalcTextSize("rate difference").x + 2.0f * reading_column();
    return two <= ImGui::GetContentRegionAvail().x ? 2 : 1;
}

/// Two filters side by side, in their colours, or one.
void measure_rows(const SignalPart& part, const ChainAnalysis& analysis, const Palette& colours,
                  const std::vector<std::size_t>& stages) {
    const std::vector<Reading> left = readings(analysis.stages[stages.front()]),
                               right = readings(analysis.stages[stages.back()]);
    const bool two = stages.size() > 1;
    const auto colour = [&](std::size_t stage) {
        const glm::vec3 c = two ? stage_colour(colours, part.stages[stage]) : colours.text;
        return ImVec4(c.x, c.y, c.z, 1.0f);
    };
    const float column = reading_column(), room = column - 0.3f * ImGui::GetFontSize();
    for (std::size_t i = 0; i < right.size(); ++i) {
        const float end = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - column;
        ImGui::PushStyleColor(ImGuiCol_Text, colour(stages.back()));
        reading(right[i].name, "%s", (two ? elided(right[i].text, room) : right[i].text).c_str());
        ImGui::PopStyleColor();
        const std::string help = right[i].help, other = left[i].help;
        explain((help == other ? help
                               : stage_title(part, stages.front()) + ": " + other + '\n' +
                                     stage_title(part, stages.back()) + ": " + help)
                    .c_str());
        if (!two) continue;
        const std::string text = elided(left[i].text, room);
        ImGui::SameLine(end - ImGui::CalcTextSize(text.c_str()).x);
        ImGui::TextColored(colour(stages.front()), "%s", text.c_str());
    }
}

/// The ranking of fitted filters.
void fit_rows(const SignalPart& part, Emit& emit) {
    if (part.plot != SignalPlot::Fit) return;
    const PanelSection ids("Fit");
    if (part.recording) {
        note(
            "Drag the blue ball as the output should move. The input starts when you grab it; the recording "
            "ends when you let go.");
        if (row_button("Stop", 1, true, "Stops recording; what was recorded is kept"))
            emit("signal.fit.stop");
        return;
    }
    const char* const recording = "Plays the input from its start while you drag the output ball";
    if (part.wanted.empty()) {
        note("Draw the response that you want in the plot, record it by hand, or open it from a file.");
        if (row_button("Draw from the output", 1, true, "Starts from the present output"))
            emit("signal.fit.draw", {{"from", -1.0}, {"from_value", 0.0}, {"to", -1.0}, {"to_value", 0.0}});
        if (row_button("Record by hand", 1, true, recording)) emit("signal.fit.record");
    } else {
        if (part.fitting) {
            if (row_button("Cancel", 3, true, "Filters fitted so far are kept")) emit("signal.fit.cancel");
        } else if (row_button("Fit", 3, true, "Finds the parameters of every kind of filter")) {
            emit("signal.fit");
        }
        if (row_button("Record", 3, true, recording)) emit("signal.fit.record");
        if (row_button("Forget", 3, true, "Forgets the desired response")) emit("signal.fit.clear");
        end_row();
    }
    std::string path;
    if (text_field("response", path, "CSV file, Enter")) emit("signal.fit", {{"to", path}});
    explain("A file with the desired response. Enter reads it and fits every kind of filter to it.");
    if (part.wanted.empty()) return;
    if (part.fitting) {
        const std::size_t done = part.fits.size(), all = signal::kinds().size();
        ImGui::ProgressBar(static_cast<float>(done) / static_cast<float>(all), {-1.0f, 0.0f}, "");
        note(std::to_string(done) + " of " + std::to_string(all) + " kinds of filter fitted.");
    }
    for (std::size_t i = 0; i < part.fits.size(); ++i) {
        const Fit& fit = part.fits[i];
        ImGui::PushID(static_cast<int>(i));
        const std::string left =
            fit.residual < 1e-4 ? "< 0.01 %" : fixed_text(100.0 * std::min(fit.residual, 1e4), 2) + " %";
        const float width = ImGui::GetContentRegionAvail().x;
        const ImVec2 at = ImGui::GetCursorPos();
        if (ImGui::Selectable("##use", false, 0, {width, ImGui::GetTextLineHeight()}))
            emit("signal.fit.use", {{"rank", i}});
        if (ImGui::IsItemHovered()) tooltip("Replaces the chain with it");
        ImGui::SetCursorPos(at);
        ImGui::TextUnformatted(kind_title(fit.filter).c_str());
        ImGui::SameLine();
        text_flush_right(left, i > 0);
        ImGui::PopID();
    }
    note("Error left, % of the range; click to use.");
}

}  // namespace

void SignalLab::inspector(const Workspace& workspace, Emit& emit) const {
    const SignalPart& part = signal_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    const ChainAnalysis& analysis = signal_runtime(workspace).chain(part);
    show_verdict(signal_verdict(part, analysis.whole), colours, emit);
    const PanelSection now("Now");
    reading("input", "%.3f", input_of(part));
    if (part.input.kind == InputKind::Csv) note(rows_text(*part.input.file));
    const double output = output_of(part);
    if (std::abs(output) < 1e6)
        reading("output", "%.3f", output);
    else
        reading("output", "grows without bound");
    fit_rows(part, emit);
    if (part.stages.empty()) return;
    const PanelSection each("Read-outs");
    std::vector<std::size_t> shown;  // those named above the next rows
    for (std::size_t i = 0; i < part.stages.size(); ++i) {
        const SignalStage& stage = part.stages[i];
        colour_mark(stage_colour(colours, stage));
        ImGui::AlignTextToFramePadding();
        if (stage.enabled) {
            ImGui::TextUnformatted(stage_title(part, i).c_str());
            if (i > 0 && !stage.beside) note("with those above it, from the input on");
            shown.push_back(i);
        } else {
            ImGui::TextDisabled("%s (off)", stage_title(part, i).c_str());
        }
        if (shown.size() < filters_a_row() && i + 1 < part.stages.size()) continue;
        if (!shown.empty()) measure_rows(part, analysis, colours, shown);
        shown.clear();
    }
}

// The desired response, drawn with the mouse over its input, and the best fits.

glm::vec3 fit_colour(const Palette& palette, std::size_t rank) {
    return rank == 0 ? palette.head : rank == 1 ? rgb(0xCC79A7) : palette.tail;
}

void fit_plot(const SignalPart& part, const Palette& palette, float height, Emit& emit) {
    const bool drawn = !part.wanted.empty();
    const InputRows rows = drawn ? part.fit_input : rows_to_answer(part);
    const std::vector<double> time = signal::times_of(rows);
    std::vector<double> input;
    for (const signal::Sample& row : rows) input.push_back(row.input);
    std::vector<Curve> curves{curve_of("input", input_colour(palette), time, input)};
    curves.back().strength = 0.5f;
    for (std::size_t i = 0; i < std::min(shown_fits, part.fits.size()); ++i) {
        const std::vector<double> output = signal::run({&part.fits[i].filter, 1}, rows);
        curves.push_back(curve_of(kind_title(part.fits[i].filter), fit_colour(palette, i), time, output));
    }
    if (drawn) {
        curves.push_back(curve_of("wanted", palette.text, time, part.wanted));
        curves.back().width = 1.4f;
    }
    // Always leave room to draw beyond the present values.
    Span span = span_of(part.input, input);
    const double range = span.high - span.low, low = span.low - range, high = span.high + range;
    for (const double value : part.wanted)
        span.low = std::min(span.low, value), span.high = std::max(span.high, value);
    if (!drawn) {  // a stroke starts from the chain's output
        for (const double value : signal::run(enabled_filters(part), rows)) {
            span.low = std::min(span.low, std::max(value, low));
            span.high = std::max(span.high, std::min(value, high));
        }
    }
    const double margin = 0.25 * (span.high - span.low), end = time.empty() ? 1.0 : time.back();
    PlotAxes axes = time_axes({span.low - margin, span.high + margin}, 0.0, end);
    axes.keeps_axes = axes.fixed_y = true;
    if (part.recording) axes.at_x = static_cast<float>(part.time);
    const PlotStroke stroke = plot("fit", curves, axes, height);
    if (!stroke.drawn) return;
    emit.continuously("signal.fit.draw", {{"from", stroke.from.x},
                                          {"from_value", stroke.from.y},
                                          {"to", stroke.to.x},
                                          {"to_value", stroke.to.y}});
}

}  // namespace tendril::app
