#include "app/labs/kit/past_strip.hpp"

#include <imgui.h>

#include <algorithm>

#include "app/document/text.hpp"
#include "app/document/units.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

std::string incident_title(const Incident& incident) {
    const bool named = !incident.name.empty();
    const std::string joint = named ? "Bone " + incident.name : "Joint " + std::to_string(incident.joint);
    switch (incident.kind) {
        case Incident::Kind::Flip:
            return joint + (named ? " flipped: it turned " : " flipped: one of its bones turned ") +
                   fixed_text(static_cast<double>(incident.degrees), 0) + " degrees in one tick";
        case Incident::Kind::Jump:
            if (named) break;
            return joint + " jumped";
        case Incident::Kind::Limit:
            if (named) break;
            return joint + " reached its limit";
        case Incident::Kind::Restart:
            return "The solver restarted";
        case Incident::Kind::Status:
            break;
    }
    // "Stretched: ...", "refused: ..."
    return capitalised(incident.cause.substr(0, incident.cause.find(':')));
}

glm::vec3 incident_colour(const Incident& incident, const Palette& palette) {
    switch (incident.kind) {
        case Incident::Kind::Flip:
        case Incident::Kind::Jump:
        case Incident::Kind::Limit:
            return palette.limit;
        case Incident::Kind::Restart:
            return palette.accent;
        case Incident::Kind::Status:
            break;
    }
    return palette.text_dim;
}

void replay_button(const Workspace& workspace, Emit& emit) {
    const bool runs = workspace.clock.replaying;
    if (icon_button("replay", runs ? Icon::Pause : Icon::Play,
                    runs ? "Pauses" : "Replays the last ten seconds, at the simulation's speed",
                    !workspace.rewind.empty(), runs))
        emit(runs ? "time.pause" : "time.replay");
    ImGui::SameLine();
}

void record_button(const Workspace& workspace, Emit& emit) {
    const float side = ImGui::GetFrameHeight(), height = 0.45f * side;
    const ImVec2 at = ImGui::GetCursorScreenPos(), low{at.x, at.y + 0.92f * side};
    const bool enabled = !workspace.rewind.empty();
    ImGui::SetCursorScreenPos(low);
    ImGui::BeginDisabled(!enabled);
    if (ImGui::InvisibleButton("record", {side, height})) emit("view.video_dialog");
    const ImU32 colour = ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_CheckMark : ImGuiCol_Text);
    draw_icon(ImGui::GetWindowDrawList(), Icon::Record, {low.x + 0.5f * side, low.y + 0.5f * height}, height,
              colour);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        tooltip("Pauses, and saves the last ten seconds as a video");
    ImGui::SetCursorScreenPos(at);
}

TimeMark incident_mark(const Incident& incident, int at, const Palette& palette) {
    return {.at = at,
            .colour = incident_colour(incident, palette),
            .large = incident.kind == Incident::Kind::Flip || incident.kind == Incident::Kind::Jump};
}

void tell_incident(const Incident& incident) {
    tooltip(incident_title(incident) + ":\n" + incident.cause +
            ".\nClick to compare the poses before and after.");
}

PastTicks past_ticks(const Workspace& workspace) {
    const Rewind& past = workspace.rewind;
    const std::uint64_t now = workspace.moment;
    return past.empty() ? PastTicks{now, now} : PastTicks{past.oldest(), std::max(past.newest(), now)};
}

void go_to_past(const Workspace& workspace, int place, Emit& emit) {
    const PastTicks past = past_ticks(workspace);
    if (workspace.rewind.empty() || place == past.place(workspace.moment)) return;
    // If undo changes the moment while the mouse is held still, do not change it back.
    if (!ImGui::IsItemActivated() && ImGui::GetIO().MouseDelta.x == 0.0f) return;
    emit.continuously("time.seek", {{"ticks_back", std::max(0, past.place(past.last) - place)}});
}

std::string discards_text(const Workspace& workspace) {
    const std::uint64_t ticks = workspace.later_ticks();
    if (ticks == 0) return {};
    const double seconds = static_cast<double>(ticks) * tick_seconds;
    return "An edit here discards the " + fixed_text(seconds, seconds < 0.1 ? 2 : 1) +
           " s after it. Undo brings them back.";
}

StripLine past_strip(const Workspace& workspace, Emit& emit) {
    record_button(workspace, emit);
    replay_button(workspace, emit);
    return past_time_strip(workspace, emit);
}

bool other_strip_button(bool shown, const std::string& other) {
    const bool asked = ImGui::Button(shown ? capitalised(other).c_str() : "Past");
    if (ImGui::IsItemHovered()) tooltip("Shows the " + (shown ? other : "last ten seconds") + " here");
    ImGui::SameLine();
    return asked;
}

namespace {

std::string strip_help(const Workspace& workspace) {
    const std::string help = "The last ten seconds. Drag to go back to that moment.",
                      lost = discards_text(workspace);
    return lost.empty() ? help : help + "\n" + lost;
}

}  // namespace

StripLine past_time_strip(const Workspace& workspace, Emit& emit) {
    const PastTicks past = past_ticks(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    // The strip spans ten seconds from the start; the unrecorded part is on its right.
    TimeStrip strip{
        .ticks = past_strip_ticks, .seconds = tick_seconds, .known = past.place(past.last), .bars = {}};
    const auto& incidents = workspace.rewind.incidents();
    for (const Incident& incident : incidents)
        strip.marks.push_back(incident_mark(incident, past.place(incident.tick + 1), colours));
    int tick = past.place(workspace.moment);
    const TimeStripUse use = time_strip("past", tick, strip);
    if (use.on_mark >= 0)
        tell_incident(incidents[static_cast<std::size_t>(use.on_mark)]);
    else if (use.hovered >= 0 && !ImGui::IsItemActive())
        tooltip(strip_help(workspace));
    if (use.mark_clicked) {
        emit("time.incident", {{"number", use.on_mark}});
    } else if (use.moved) {
        go_to_past(workspace, tick, emit);
    }
    return {use.left, use.right};
}

}  // namespace tendril::app
