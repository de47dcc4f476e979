// What the filters cost and gain, in numbers, and the ranking of a fit.
#include <imgui.h>

#include "app/document/units.hpp"
#include "app/labs/signal/panels.hpp"
#include "app/labs/signal/presets.hpp"
#include "app/labs/signal/scene.hpp"
#include "app/labs/signal/signal_lab.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

std::string or_dash(const std::optional<double>& value, double factor, int decimals, const char* unit) {
    if (!value) return "-";
    return fixed_text(factor * *value, decimals) + " " + unit;
}

/// The same four digits or so, whatever the size; what grows without bound is said so.
std::string difference_text(double value) {
    if (value > 1e6) return "unbounded";
    return fixed_text(value, value < 10.0 ? 3 : 0);
}

void response_rows(const StageMeasures& measures) {
    if (measures.following == signal::Following::DoesNotFollow) {
        reading("lag", "does not follow");
        explain("No shift in time makes the input explain even a tenth of what the output does.");
    } else {
        reading("lag", "%s", or_dash(measures.lag, 1e3, 1, "ms").c_str());
        explain("How far the output has to be shifted back in time to fit its input best.");
    }
    reading("overshoot", "%s", or_dash(measures.overshoot, 1e2, 1, "%").c_str());
    explain("How far it goes beyond a jump of the input, as a part of the jump. Needs jumps: a square wave.");
    reading("settling", "%s", or_dash(measures.settling_time, 1e3, 0, "ms").c_str());
    explain("From a jump until it stays within 2 % of it. Needs jumps: a square wave.");
    reading("jitter left", "%s", or_dash(measures.jitter, 1e2, 1, "%").c_str());
    explain("Second differences of the output over those of the input.");
}

void measure_rows(const StageMeasures& measures) {
    if (measures.following == signal::Following::Unstable) {
        reading("response", "unstable");
        explain(
            "It runs away: more than ten times as far as its input spans, and ever farther. Lag, overshoot, "
            "settling and jitter of that would mean nothing.");
    } else {
        response_rows(measures);
    }
    reading("rate difference", "%s", difference_text(measures.rate_difference).c_str());
    explain(
        "The maximum difference between 15, 30, 60, 144 Hz and uneven frames at one time, of what the chain "
        "up "
        "to here puts out.");
}

}  // namespace

void fit_rows(const SignalPart& part, Emit& emit) {
    if (part.plot != SignalPlot::Fit) return;
    section("Fit");
    if (part.recording) {
        note(
            "Drag the blue ball as the output should move. The input begins when you take hold of it; the "
            "recording ends when you let go.");
        if (row_button("Stop", 1, true, "Ends the recording; what is there is kept")) emit("signal.fit.stop");
        return;
    }
    const char* const recording = "Plays the input from its start while you drag the output ball";
    if (part.wanted.empty()) {
        note("Draw the response that you want into the plot, record it by hand, or open a file of it.");
        if (row_button("Draw from the output", 1, true, "Begins with what the filters make of the input now"))
            emit("signal.fit.draw", {{"from", -1.0}, {"from_value", 0.0}, {"to", -1.0}, {"to_value", 0.0}});
        if (row_button("Record by hand", 1, true, recording)) emit("signal.fit.record");
    } else {
        if (part.fitting) {
            if (row_button("Cancel", 3, true, "What is fitted so far stays")) emit("signal.fit.cancel");
        } else if (row_button("Fit", 3, true, "Finds the parameters of every kind of filter")) {
            emit("signal.fit");
        }
        if (row_button("Record", 3, true, recording)) emit("signal.fit.record");
        if (row_button("Forget", 3, true, "Forgets the response that is wanted")) emit("signal.fit.clear");
        end_row();
    }
    std::string path;
    if (text_field("response", path, "CSV file, Enter")) emit("signal.fit", {{"to", path}});
    explain("A file of the response that is wanted. Enter reads it and fits every kind of filter to it.");
    if (part.wanted.empty()) return;
    if (part.fitting) {
        const std::size_t done = part.fits.size(), all = signal::kinds().size();
        ImGui::ProgressBar(static_cast<float>(done) / static_cast<float>(all), {-1.0f, 0.0f}, "");
        note(std::to_string(done) + " of " + std::to_string(all) + " kinds of filter are fitted.");
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
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("Puts it in the place of the chain");
        ImGui::SetCursorPos(at);
        ImGui::TextUnformatted(kind_title(fit.filter).c_str());
        ImGui::SameLine();
        text_flush_right(left, i > 0);
        ImGui::PopID();
    }
    note("What is left, as a part of the response's range. Click one to put it in place.");
}

void SignalLab::inspector(const Workspace& workspace, Emit& emit) const {
    const SignalPart& part = signal_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    const ChainAnalysis& analysis = signal_runtime(workspace).chain(part);
    show_verdict(signal_verdict(part, analysis.whole), colours);
    section("Now");
    reading("input", "%.3f", input_of(part));
    const double output = output_of(part);
    if (std::abs(output) < 1e6)
        reading("output", "%.3f", output);
    else
        reading("output", "grows without bound");
    fit_rows(part, emit);
    if (part.stages.empty()) return;
    section("Read-outs");
    for (std::size_t i = 0; i < part.stages.size(); ++i) {
        const SignalStage& stage = part.stages[i];
        colour_mark(stage_colour(colours, part, i));
        ImGui::AlignTextToFramePadding();
        if (!stage.enabled) {
            ImGui::TextDisabled("%s (off)", kind_title(stage.filter).c_str());
            continue;
        }
        ImGui::TextUnformatted(kind_title(stage.filter).c_str());
        measure_rows(analysis.stages[i]);
    }
    if (enabled_filters(part).size() > 1) {
        section("The whole chain");
        measure_rows(analysis.whole);
    }
}

}  // namespace tendril::app
