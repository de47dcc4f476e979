#include "app/labs/kit/incident_rows.hpp"

#include <imgui.h>

#include "app/labs/kit/past_strip.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_rows = 5;

/// "1.4 s ago"
std::string age_text(const Workspace& workspace, const Incident& incident) {
    const std::uint64_t after = incident.tick + 1, now = workspace.moment;
    if (after == now) return "just now";
    const double seconds = static_cast<double>(after > now ? after - now : now - after) * tick_seconds;
    char text[32];
    std::snprintf(text, sizeof text, after > now ? "in %.2f s" : "%.2f s ago", seconds);
    return text;
}

void incident_row(const Workspace& workspace, std::size_t number, const Palette& palette, Emit& emit) {
    const Incident& incident = workspace.rewind.incidents()[number];
    const auto& shown = workspace.ui.incident;
    const bool chosen = shown && shown->tick == incident.tick && shown->kind == incident.kind;
    ImGui::PushID(static_cast<int>(number));
    colour_mark(incident_colour(incident, palette));
    // Of a flip the first words: how far it turned is told when it is shown.
    std::string title = incident_title(incident);
    title = title.substr(0, title.find(':')) + ", " + age_text(workspace, incident);
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, ImVec2(0.0f, 0.5f));
    if (ImGui::Selectable(elided(title, ImGui::GetContentRegionAvail().x).c_str(), chosen,
                          ImGuiSelectableFlags_None, {0.0f, ImGui::GetFrameHeight()})) {
        chosen ? emit("time.incident") : emit("time.incident", {{"number", number}});
    }
    ImGui::PopStyleVar();
    ImGui::PopID();
    if (ImGui::IsItemHovered()) tooltip(incident.cause + ".");
}

}  // namespace

void incident_rows(const Workspace& workspace, const Palette& palette, Emit& emit) {
    const auto& incidents = workspace.rewind.incidents();
    if (incidents.empty()) return;
    section("What happened");
    if (const auto& shown = workspace.ui.incident) {
        note(incident_title(*shown) + ":");
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted((shown->cause + ".").c_str());
        ImGui::PopTextWrapPos();
    }
    std::size_t rows = 0;
    for (std::size_t i = incidents.size(); i-- > 0 && rows < max_rows; ++rows)
        incident_row(workspace, i, palette, emit);
}

}  // namespace tendril::app
