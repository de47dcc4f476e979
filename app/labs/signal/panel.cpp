// What one chooses in the Signal lab: a preset, what goes in, the filters.
#include <imgui.h>

#include <algorithm>

#include "app/labs/kit/folding.hpp"
#include "app/labs/kit/preset_rows.hpp"
#include "app/labs/signal/panels.hpp"
#include "app/labs/signal/presets.hpp"
#include "app/labs/signal/scene.hpp"
#include "app/labs/signal/signal_lab.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
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
    explain("What goes into the first filter.");
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
                    ? "The slow drift heads for a new value four times in this time."
                    : "How long it takes until the input begins anew.");
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
    explain("A file whose rows become the input, over and over. Enter opens it.");
    note(input_kinds.help(input.kind));
}

void export_section(Emit& emit) {
    if (row_button("Copy as C++", 2, true, "The filters that are on, as a program against the library"))
        emit("signal.copy", {{"as", "cpp"}});
    if (row_button("Copy as CSV", 2, true, "Time, input and every stage of the last ten seconds"))
        emit("signal.copy", {{"as", "csv"}});
}

/// Adding is one button and a list: fourteen buttons would be a wall.
void add_button(Emit& emit) {
    if (row_button("Add a filter", 1, true, "A list of every kind; the new one comes last"))
        ImGui::OpenPopup("add filter");
    if (!ImGui::BeginPopup("add filter")) return;
    close_popup_on_escape();
    for (const signal::Kind& kind : signal::kinds())
        if (ImGui::MenuItem(kind_title(kind).c_str())) emit("signal.filter.add", {{"kind", kind.name}});
    ImGui::EndPopup();
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

void chain_rows(const SignalPart& part, const Palette& palette, Emit& emit) {
    for (std::size_t i = 0; i < part.stages.size(); ++i) {
        const SignalStage& stage = part.stages[i];
        ImGui::PushID(static_cast<int>(i));
        colour_mark(stage_colour(palette, part, i));
        bool on = stage.enabled;
        if (ImGui::Checkbox("##on", &on)) emit("signal.filter.enable", {{"at", i}, {"on", on}});
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("Off, its input passes as it is");
        ImGui::SameLine();
        const float width = std::max(20.0f, ImGui::GetContentRegionAvail().x);
        const bool selected = part.selected == i;
        const std::string title =
            elided(kind_title(stage.filter), width - 2.0f * ImGui::GetStyle().FramePadding.x);
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
    const bool chosen = part.selected.has_value();
    const std::size_t at = part.selected.value_or(0);
    if (row_button("Up", 3, chosen && at > 0, "Moves the selected filter up: applied earlier"))
        emit("signal.filter.move", {{"at", at}, {"to", at - 1}});
    if (row_button("Down", 3, chosen && at + 1 < part.stages.size(), "Moves it down: applied later"))
        emit("signal.filter.move", {{"at", at}, {"to", at + 1}});
    if (row_button("Remove", 3, chosen, "Removes the selected filter"))
        emit("signal.filter.remove", {{"at", at}});
    end_row();
    add_button(emit);
}

void SignalLab::panel(const Workspace& workspace, Emit& emit) const {
    const SignalPart& part = signal_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    const auto open = [&](const char* title) { return folding_section(workspace, title, emit); };
    if (open("Presets")) preset_section(emit);
    if (open("Input")) input_section(part, emit);
    if (open("Filters")) chain_rows(part, colours, emit);
    parameter_rows(part, colours, emit);
    if (open("Export")) export_section(emit);
}

}  // namespace tendril::app
