#include "app/labs/kit/past_view.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/document/text.hpp"
#include "app/document/units.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/part_cache.hpp"
#include "app/labs/kit/past_strip.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/lists.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/text.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

constexpr float plot_height = 130.0f;      ///< pixels at scale 1
constexpr std::uint64_t half_second = 30;  ///< ticks
/// Moments computed per frame. A count, not a time limit, so that every run draws the same.
constexpr std::size_t moments_a_frame = 16;

struct PastRuntime final : Runtime {
    std::string of;  ///< the key of the curve that `values` belong to
    PartCache<float> values;
    bool waits = false;  ///< some values are still missing
    PartCache<PoseLines> poses;
};

PastRuntime& runtime_of(const Workspace& workspace, const PastView& view) {
    return workspace.runtimes.of<PastRuntime>(view.lab + " past");
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

PastView past_view(const std::string& lab, const std::string& what, std::vector<LabSetting::Choice> numbers,
                   std::function<bool(const Part&, const Part&)> same_joints) {
    const std::string title = capitalised(lab);
    numbers.insert(numbers.begin(), {"nothing", "nothing"});
    return {
        .lab = lab,
        .same_joints = std::move(same_joints),
        .plot = {.key = lab + " plot",
                 .command = "view." + lab + "_plot",
                 .title = "Plot the " + what + "'s last ten seconds",
                 .argument = "of",
                 .help = "Plots a value over the last ten seconds of the " + title + " lab below the scene",
                 .choices = std::move(numbers)},
        .ghosts = {.key = lab + " ghosts",
                   .command = "view." + lab + "_ghosts",
                   .title = "Show the " + what + "'s past poses",
                   .argument = "of",
                   .help = "Shows the poses of the last ten seconds of the " + title +
                           " lab, one for each half second",
                   .choices = {{"nothing", "none"}, {"past", "every half second"}}}};
}

void past_view_rows(const Workspace& workspace, const PastView& view, const PastHelp& help, Emit& emit) {
    const auto choose = [&](const LabSetting& setting, std::size_t choice) {
        emit(setting.command, {{setting.argument, setting.choices[choice].name}});
    };
    std::vector<const char*> titles;
    for (const LabSetting::Choice& choice : view.plot.choices) titles.push_back(choice.title.c_str());
    int chosen = static_cast<int>(view.plot.chosen(workspace.settings));
    if (choice_field("plot", chosen, titles.data(), static_cast<int>(titles.size())))
        choose(view.plot, static_cast<std::size_t>(chosen));
    explain(help.plot);
    bool ghosts = view.shows_ghosts(workspace.settings);
    if (ImGui::Checkbox("Past poses", &ghosts)) choose(view.ghosts, ghosts ? 1 : 0);
    explain(help.ghosts);
}

float past_plot_height(const Settings& settings, const PastView& view) {
    return view.plots(settings) ? plot_height : 0.0f;
}

std::vector<PastValue> past_values(const Workspace& workspace, const PastView& view, const PastCurve& curve,
                                   std::size_t most_made) {
    PastRuntime& runtime = runtime_of(workspace, view);
    const Rewind& past = workspace.rewind;
    if (runtime.of != curve.of) {
        runtime.values.clear();
        runtime.of = curve.of;
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
    if (past.empty() || workspace.moment > past.newest())
        add(workspace.moment, workspace.document.parts().at(view.lab));
    for (auto moment = past.moments().rbegin(); moment != past.moments().rend(); ++moment)
        add(moment->tick, moment->part);
    std::reverse(values.begin(), values.end());
    runtime.values.trim(past);
    return values;
}

bool past_plot_waits(const Workspace& workspace, const PastView& view) {
    return runtime_of(workspace, view).waits;
}

void past_plot(const Workspace& workspace, const PastView& view, const std::optional<PastCurve>& plotted,
               const std::optional<StripLine>& strip, Emit& emit) {
    if (!plotted) {
        PastRuntime& runtime = runtime_of(workspace, view);
        runtime.values.clear();
        runtime.waits = false;
        return;
    }
    const PastCurve& curve = *plotted;
    const std::uint64_t first = past_ticks(workspace).first;
    const Palette& colours = palette(workspace.settings.theme);
    Curve line{.name = curve.name, .colour = colours.accent, .points = {}, .marks = false};
    const std::size_t most_made = workspace.clock.measured ? moments_a_frame : all_moments;
    for (const PastValue& each : past_values(workspace, view, curve, most_made))
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

std::vector<const Rewind::Moment*> ghost_moments(const Workspace& workspace, const PastView& view) {
    const Rewind& past = workspace.rewind;
    const Part& now = *workspace.document.parts().at(view.lab);
    std::vector<const Rewind::Moment*> shown;
    std::uint64_t next = 0;  // large parts do not keep every tick: take the first in each half second
    for (const Rewind::Moment& moment : past.moments()) {
        const std::uint64_t begin = moment.tick - moment.tick % half_second;
        if (begin < next || begin < past.oldest()) continue;
        next = begin + half_second;
        if (!view.same_joints || view.same_joints(*moment.part, now)) shown.push_back(&moment);
    }
    return shown;
}

void draw_past_ghosts(const View& view, const PastView& past,
                      const std::function<PoseLines(const SharedPart&)>& pose, DrawList& list) {
    PartCache<PoseLines>& poses = runtime_of(view.workspace, past).poses;
    if (!past.shows_ghosts(view.workspace.settings)) return poses.clear();
    const Rewind& rewind = view.workspace.rewind;
    for (const Rewind::Moment* const moment : ghost_moments(view.workspace, past)) {
        const auto age =
            static_cast<float>(rewind.newest() - moment->tick) / static_cast<float>(Rewind::max_ticks);
        const glm::vec4 colour = faded(view.palette, view.palette.ghost, 0.75f - 0.55f * age);
        const PoseLines& lines = poses.of(moment->part, [&] { return pose(moment->part); });
        if (lines.size() > max_ghost_lines) continue;
        for (const auto& [from, to] : lines) list.line(from, to, 1.5f * view.scale, colour);
    }
    poses.trim(rewind);
}

Json past_view_state(const Workspace& workspace, const PastView& view,
                     const std::optional<PastCurve>& curve) {
    Json json{{"plot", nullptr}, {"ghosts", Json::array()}};
    if (curve) {
        Json values = Json::array();
        for (const PastValue& each : past_values(workspace, view, *curve))
            values.push_back({each.tick, number(each.value)});
        json["plot"] = {{"of", view.plot.choices[view.plot.chosen(workspace.settings)].name},
                        {"name", curve->name},
                        {"unit", curve->unit},
                        {"values", std::move(values)}};
    }
    if (view.shows_ghosts(workspace.settings))
        for (const Rewind::Moment* const moment : ghost_moments(workspace, view))
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
        // A half turn has no shorter way round: draw it straight.
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

constexpr std::size_t max_rows = 5;

/// "1.4 s ago", counted from the latest moment, whichever is shown.
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
    title = title.substr(0, title.find(':')) + ", " + age_text(workspace, incident);
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, ImVec2(0.0f, 0.5f));
    if (ImGui::Selectable(elided(title, ImGui::GetContentRegionAvail().x).c_str(), chosen,
                          ImGuiSelectableFlags_None, {0.0f, ImGui::GetFrameHeight()})) {
        chosen ? emit("time.incident") : emit("time.incident", {{"number", number}});
    }
    ImGui::PopStyleVar();
    ImGui::PopID();
    if (ImGui::IsItemHovered() && !workspace.ui.incident) tooltip(incident.cause + ".");
}

}  // namespace

void incident_rows(const Workspace& workspace, const Palette& palette, Emit& emit) {
    const auto& incidents = workspace.rewind.incidents();
    if (incidents.empty()) return;
    const PanelSection ids("What happened");
    std::size_t rows = 0;
    for (std::size_t i = incidents.size(); i-- > 0 && rows < max_rows; ++rows)
        incident_row(workspace, i, palette, emit);
    // Place it below the rows, which must not move under the mouse that clicks one.
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
    for (const Cure& cure : shown->buttons) cure_line(cure.text, cure, emit);
    if (const std::string lost = discards_text(workspace); !lost.empty()) note(lost);
    // Scroll to the incident if its mark on the strip was clicked.
    if (appears && !ImGui::IsWindowHovered()) ImGui::SetScrollHereY(1.0f);
}

}  // namespace tendril::app
