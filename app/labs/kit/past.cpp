#include "app/labs/kit/past.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/part_cache.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

LabSetting Past::plot() const {
    std::vector<LabSetting::Choice> choices{{"nothing", "nothing"}};
    for (const Probe& each : probes) choices.push_back({each.name, each.title});
    return {
        .key = lab + " plot",
        .command = "view." + lab + "_plot",
        .title = std::string("Plot the ") + what + "'s last ten seconds",
        .argument = "of",
        .help = "Plots a value over the last ten seconds of the " + capitalised(lab) + " lab below the scene",
        .choices = std::move(choices)};
}

LabSetting Past::ghosts() const {
    return {.key = lab + " ghosts",
            .command = "view." + lab + "_ghosts",
            .title = std::string("Show the ") + what + "'s past poses",
            .argument = "of",
            .help = "Shows the poses of the last ten seconds of the " + capitalised(lab) +
                    " lab, one for each half second",
            .choices = {{"nothing", "none"}, {"past", "every half second"}}};
}

std::optional<PastCurve> Past::curve(const Workspace& workspace) const {
    const std::size_t chosen = plot().chosen(workspace.settings);
    return chosen > 0 ? std::optional(probes[chosen - 1].curve(workspace)) : std::nullopt;
}

namespace {

constexpr float plot_height = 130.0f;      ///< pixels at scale 1
constexpr std::uint64_t half_second = 30;  ///< ticks
constexpr std::size_t max_rows = 5;        ///< of the inspector's incidents
/// Moments computed per frame. A count, not a time limit, so that every run draws the same pictures.
constexpr std::size_t moments_a_frame = 16;

/// "Joint 2 flipped: one of its bones turned 128 degrees in one tick"
std::string incident_title(const Incident& incident) {
    if (!incident.title.empty()) return incident.title;
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

PastTicks past_ticks(const Workspace& workspace) {
    const Rewind& past = workspace.rewind;
    const std::uint64_t now = workspace.moment;
    return past.empty() ? PastTicks{now, now} : PastTicks{past.oldest(), std::max(past.newest(), now)};
}

/// Goes to the moment at an index. Call it after the item that the user drags.
void go_to_past(const Workspace& workspace, int place, Emit& emit) {
    const PastTicks past = past_ticks(workspace);
    if (workspace.rewind.empty() || place == past.place(workspace.moment)) return;
    // If undo changes the moment while the mouse is held still, do not change it back.
    if (!ImGui::IsItemActivated() && ImGui::GetIO().MouseDelta.x == 0.0f) return;
    emit.continuously("time.seek", {{"ticks_back", std::max(0, past.place(past.last) - place)}});
}

std::string strip_help(const Workspace& workspace) {
    const std::string help = "The last ten seconds. Drag to go back in time.",
                      lost = discards_text(workspace);
    return lost.empty() ? help : help + "\n" + lost;
}

}  // namespace

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

// The plot.

namespace {

struct PastRuntime final : Runtime {
    std::string of;  ///< the key of the curve that `values` belong to
    PartCache<float> values;
    bool waits = false;  ///< some values are still missing
    PartCache<PoseLines> poses;
};

PastRuntime& runtime_of(const Workspace& workspace, const Past& past) {
    return workspace.runtimes.of<PastRuntime>(past.lab + " past");
}

float seconds(std::uint64_t ticks) {
    return static_cast<float>(static_cast<double>(ticks) * tick_seconds);
}

/// The height of the plots' font, in pixels.
float small_font_size() {
    ImGui::PushFont(small_font());
    const float size = ImGui::GetFontSize();
    ImGui::PopFont();
    return size;
}

/// Marks where the line passes the tick of an incident; larger for a flip.
std::vector<Curve> marks_on(const Curve& line, const Workspace& workspace) {
    const std::uint64_t first = past_ticks(workspace).first;
    const Palette& colours = palette(workspace.settings.theme);
    std::vector<Curve> marks;
    for (const Incident& incident : workspace.rewind.incidents()) {
        if (incident.tick + 1 < first) continue;
        const float at = seconds(incident.tick + 1 - first), value = value_at(line, at);
        if (!std::isfinite(value)) continue;
        marks.push_back({.name = incident_title(incident),
                         .colour = incident_colour(incident, colours),
                         .points = {{at, value}},
                         .width = incident.kind == Incident::Kind::Flip ? 1.5f : 1.0f});
    }
    return marks;
}

}  // namespace

void past_rows(const Workspace& workspace, const Past& past, Emit& emit) {
    const auto choose = [&](const LabSetting& setting, std::size_t choice) {
        emit(setting.command, {{setting.argument, setting.choices[choice].name}});
    };
    const LabSetting plot = past.plot();
    std::vector<const char*> titles;
    for (const LabSetting::Choice& choice : plot.choices) titles.push_back(choice.title.c_str());
    int chosen = static_cast<int>(plot.chosen(workspace.settings));
    if (choice_field("plot", chosen, titles.data(), static_cast<int>(titles.size())))
        choose(plot, static_cast<std::size_t>(chosen));
    explain(past.plot_help);
    bool ghosts = past.shows_ghosts(workspace.settings);
    if (ImGui::Checkbox("Past poses", &ghosts)) choose(past.ghosts(), ghosts ? 1 : 0);
    explain(past.ghosts_help);
}

float past_plot_height(const Settings& settings, const Past& past) {
    return past.plot().chosen(settings) > 0 ? plot_height : 0.0f;
}

std::vector<PastValue> past_values(const Workspace& workspace, const Past& past, const PastCurve& curve,
                                   std::size_t most_made) {
    PastRuntime& runtime = runtime_of(workspace, past);
    const Rewind& rewind = workspace.rewind;
    if (const std::string& of = curve.of.empty() ? curve.name : curve.of; runtime.of != of) {
        runtime.values.clear();
        runtime.of = of;
    }
    runtime.waits = false;
    std::vector<PastValue> values;
    const auto add = [&](std::uint64_t tick, const SharedPart& part) {
        const bool costs = curve.at_hand && !runtime.values.has(part) && !curve.at_hand(part);
        if (costs && most_made == 0) {
            runtime.waits = true;
            return;
        }
        if (costs) --most_made;
        const float value = runtime.values.of(part, [&] { return static_cast<float>(curve.value(part)); });
        if (std::isfinite(value)) values.push_back({tick, value});
    };
    if (rewind.empty() || workspace.moment > rewind.newest())
        add(workspace.moment, workspace.document.parts().at(past.lab));
    for (auto moment = rewind.moments().rbegin(); moment != rewind.moments().rend(); ++moment)
        add(moment->tick, moment->part);
    std::reverse(values.begin(), values.end());
    runtime.values.trim(rewind);
    return values;
}

bool past_plot_waits(const Workspace& workspace, const Past& past) {
    return runtime_of(workspace, past).waits;
}

void past_plot(const Workspace& workspace, const Past& past, const std::optional<StripLine>& strip,
               Emit& emit) {
    const std::optional<PastCurve> plotted = past.curve(workspace);
    if (!plotted) {
        PastRuntime& runtime = runtime_of(workspace, past);
        runtime.values.clear();
        runtime.waits = false;
        return;
    }
    const PastCurve& curve = *plotted;
    const std::uint64_t first = past_ticks(workspace).first;
    const Palette& colours = palette(workspace.settings.theme);
    Curve line{.name = curve.name, .colour = colours.accent, .points = {}, .marks = false};
    const std::size_t most_made = workspace.clock.measured ? moments_a_frame : all_moments;
    for (const PastValue& each : past_values(workspace, past, curve, most_made))
        line.points.emplace_back(seconds(each.tick - first), each.value);
    if (line.points.empty()) return note(curve.missing);
    const float lines = ImGui::GetContentRegionAvail().y / small_font_size() - 0.2f;
    const auto [low, high] =
        std::minmax_element(line.points.begin(), line.points.end(),
                            [](const glm::vec2& a, const glm::vec2& b) { return a.y < b.y; });
    constexpr float margin = 1.1f;
    const float low_y = std::min(margin * low->y, 0.0f),
                high_y = std::max(margin * high->y, curve.lowest_range);
    const float now = seconds(std::max(workspace.moment, first) - first);
    std::vector<Curve> marks = marks_on(line, workspace);
    // Incidents are drawn over the mark of the present.
    if (const float value = value_at(line, now); std::isfinite(value))
        marks.insert(marks.begin(),
                     {.name = curve.name, .colour = colours.accent, .points = {{now, value}}, .width = 1.7f});
    std::vector<Curve> curves{std::move(line)};
    std::move(marks.begin(), marks.end(), std::back_inserter(curves));
    const StripLine axis = strip.value_or(StripLine{});
    const PlotStroke stroke = plot("past plot", curves,
                                   {.x = strip ? "time" : "time of the last ten seconds",
                                    .x_unit = "s",
                                    .y = curve.name.c_str(),
                                    .y_unit = curve.unit.c_str(),
                                    .min_y = 0.0f,
                                    .min_x = seconds(past_strip_ticks),
                                    .low_y = low_y,
                                    .high_y = high_y,
                                    .at_x = now,
                                    .left = axis.left,
                                    .right = axis.right},
                                   lines);
    if (stroke.drawn)
        go_to_past(workspace, static_cast<int>(std::lround(static_cast<double>(stroke.to.x) / tick_seconds)),
                   emit);
}

std::vector<const Rewind::Moment*> ghost_moments(const Workspace& workspace, const Past& past) {
    const Rewind& rewind = workspace.rewind;
    const Part& now = *workspace.document.parts().at(past.lab);
    std::vector<const Rewind::Moment*> shown;
    std::uint64_t next = 0;  // large parts do not keep every tick: take the first in each half second
    for (const Rewind::Moment& moment : rewind.moments()) {
        const std::uint64_t begin = moment.tick - moment.tick % half_second;
        if (begin < next || begin < rewind.oldest()) continue;
        next = begin + half_second;
        if (!past.same_joints || past.same_joints(*moment.part, now)) shown.push_back(&moment);
    }
    return shown;
}

void draw_past_ghosts(const View& view, const Past& past, DrawList& list) {
    PartCache<PoseLines>& poses = runtime_of(view.workspace, past).poses;
    if (!past.shows_ghosts(view.workspace.settings)) return poses.clear();
    const Rewind& rewind = view.workspace.rewind;
    for (const Rewind::Moment* const moment : ghost_moments(view.workspace, past)) {
        const auto age =
            static_cast<float>(rewind.newest() - moment->tick) / static_cast<float>(Rewind::max_ticks);
        const glm::vec4 colour = faded(view.palette, view.palette.ghost, 0.75f - 0.55f * age);
        const PoseLines& lines =
            poses.of(moment->part, [&] { return past.pose(view.workspace, moment->part); });
        if (lines.size() > max_ghost_lines) continue;
        for (const auto& [from, to] : lines) list.line(from, to, 1.5f * view.scale, colour);
    }
    poses.trim(rewind);
}

void add_ghost_legend(const Workspace& workspace, const Past& past, std::vector<LegendRow>& rows) {
    if (past.shows_ghosts(workspace.settings))
        rows.push_back({"past poses", palette(workspace.settings.theme).ghost});
}

Json past_state(const Workspace& workspace, const Past& past) {
    Json json{{"plot", nullptr}, {"ghosts", Json::array()}};
    if (const auto curve = past.curve(workspace)) {
        Json values = Json::array();
        for (const PastValue& each : past_values(workspace, past, *curve))
            values.push_back({each.tick, number(each.value)});
        json["plot"] = {{"of", past.probes[past.plot().chosen(workspace.settings) - 1].name},
                        {"name", curve->name},
                        {"unit", curve->unit},
                        {"values", std::move(values)}};
    }
    if (past.shows_ghosts(workspace.settings))
        for (const Rewind::Moment* const moment : ghost_moments(workspace, past))
            json["ghosts"].push_back(moment->tick);
    return json;
}

void draw_turn(const View& view, glm::vec3 from, glm::vec3 to, glm::vec3 about, DrawList& list) {
    constexpr int sides = 24;
    const glm::vec4 colour(view.palette.limit, 1.0f);
    const float radius_from = glm::distance(from, about), radius_to = glm::distance(to, about);
    glm::vec3 last = from;
    for (int i = 1; i <= sides; ++i) {
        const float t = static_cast<float>(i) / sides;
        const glm::vec3 chord = glm::mix(from, to, t) - about;
        const float length = glm::length(chord), radius = glm::mix(radius_from, radius_to, t);
        // A half turn has no shorter way: draw a straight line.
        const glm::vec3 next = length > 0.05f * radius ? about + chord * (radius / length) : about + chord;
        list.line(last, next, 2.0f * view.scale, colour).layer = Layer::Overlay;
        last = next;
    }
}

void draw_incident_mark(const View& view, const Incident& incident, glm::vec3 at, DrawList& list) {
    list.ring(at, 14.0f * view.scale, 2.5f * view.scale, glm::vec4(view.palette.limit, 1.0f)).layer =
        Layer::Overlay;
    if (incident.kind != Incident::Kind::Flip) return;
    list.labels.push_back({.at = at,
                           .clearance = 18.0f * view.scale,
                           .text = fixed_text(static_cast<double>(incident.degrees), 0) + " degrees",
                           .colour = view.palette.text,
                           .rank = 4});
}

namespace {

/// "1.4 s ago", relative to the latest moment, whichever one is shown.
std::string age_text(const Workspace& workspace, const Incident& incident) {
    const std::uint64_t after = incident.tick + 1, now = past_ticks(workspace).last;
    if (after >= now) return "just now";
    return fixed_text(static_cast<double>(now - after) * tick_seconds, 2) + " s ago";
}

void incident_row(const Workspace& workspace, std::size_t number, const Palette& palette, Emit& emit) {
    const Incident& incident = workspace.rewind.incidents()[number];
    const auto& shown = workspace.ui.incident;
    const bool chosen = shown && shown->tick == incident.tick && shown->kind == incident.kind;
    ImGui::PushID(static_cast<int>(number));
    colour_mark(incident_colour(incident, palette));
    // Only the first words of a flip: the angle appears once it is selected.
    std::string title = incident_title(incident);
    if (incident.title.empty())
        title = title.substr(0, title.find(':')) + ", " + age_text(workspace, incident);
    const std::string whole = title;
    const float room = ImGui::GetContentRegionAvail().x;
    const std::size_t bone = title.find(" (");  // the name leaves space for the amount
    if (bone != title.npos && elided(title, room) != title)
        title.erase(bone, title.find(')', bone) + 1 - bone);
    title = elided(title, room);
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, ImVec2(0.0f, 0.5f));
    if (ImGui::Selectable(title.c_str(), chosen, ImGuiSelectableFlags_None,
                          {0.0f, ImGui::GetFrameHeight()})) {
        chosen ? emit("time.incident") : emit("time.incident", {{"number", number}});
    }
    ImGui::PopStyleVar();
    ImGui::PopID();
    if (ImGui::IsItemHovered() && (!workspace.ui.incident || title != whole))
        tooltip((title == whole ? "" : whole + ": ") + incident.cause + ".");
}

}  // namespace

void incident_rows(const Workspace& workspace, const Palette& palette, Emit& emit) {
    const auto& incidents = workspace.rewind.incidents();
    if (incidents.empty()) return;
    const PanelSection ids("What happened");
    std::size_t rows = 0;
    for (std::size_t i = incidents.size(); i-- > 0 && rows < max_rows; ++rows)
        incident_row(workspace, i, palette, emit);
    // Below the rows, which must not move under the mouse that clicks one.
    const auto& shown = workspace.ui.incident;
    bool& seen = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("incident seen"));
    const bool appears = shown.has_value() && !seen;
    seen = shown.has_value();
    if (!shown) return;
    note(incident_title(*shown) + ":");
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted((shown->cause + ".").c_str());
    if (!shown->cure.empty()) ImGui::TextUnformatted(shown->cure.c_str());
    ImGui::PopTextWrapPos();
    for (const Cure& cure : shown->buttons) cure_line(cure.text, cure, emit, true);
    if (const std::string lost = discards_text(workspace); !lost.empty()) note(lost);
    // Scroll to the incident if its mark on the strip was clicked.
    if (appears && workspace.ui.incident_chosen && !ImGui::IsWindowHovered()) ImGui::SetScrollHereY(1.0f);
}

}  // namespace tendril::app
