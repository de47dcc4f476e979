#include "app/shell/card_watch.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/view/camera.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/row_search.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

/// Writing the state of a large part is slow: checks wait one tick per this many bytes.
constexpr std::size_t bytes_per_tick = 8192;
/// Larger parts are never checked.
constexpr std::size_t max_watched_bytes = 1u << 20;

/// True if the command matches the line, in the arguments that the line gives.
bool matches(const CardLine& line, const std::string& command, const Json& arguments) {
    if (line.command != command) return false;
    const auto& wanted = line.arguments->items();
    return std::all_of(wanted.begin(), wanted.end(), [&](const auto& each) {
        const auto given = arguments.find(each.key());
        return given != arguments.end() && (each.value().is_null() || *given == each.value());
    });
}

const CardCondition* avoided(const CardStep& step) {
    const auto found = std::find_if(step.when.begin(), step.when.end(), [](const CardCondition& each) {
        return each.kind == CardCondition::Kind::Avoided;
    });
    return found == step.when.end() ? nullptr : &*found;
}

/// The position that the command moved something to: the argument that is null in the line.
std::optional<glm::vec3> moved_to(const CardLine& line, const Json& arguments) {
    for (const auto& [key, value] : line.arguments->items()) {
        const auto given = arguments.find(key);
        if (value.is_null() && given != arguments.end() && given->is_array() && given->size() == 3)
            return glm::vec3(given->at(0).get<float>(), given->at(1).get<float>(), given->at(2).get<float>());
    }
    return std::nullopt;
}

void note_drag(RepeatedDrag& drag, glm::vec3 to, std::uint64_t moment) {
    constexpr std::size_t max_points = 4096;
    if (drag.path.size() >= max_points)
        drag.path.erase(drag.path.begin(), drag.path.begin() + max_points / 2);
    drag.path.push_back({moment, to});
}

/// True if the incident is the one that was cured: at the same joint, or for the same reason.
bool recurs(const RepeatedDrag& drag, const Json& incident) {
    const auto same = [&](const char* member) {
        return drag.incident->value(member, Json()) == incident.value(member, Json());
    };
    return same("joint") || same("cause");
}

/// Records where the drag was when it last caused an incident of that kind. After the cure, another joint may
/// jump for a different reason, such as a jump of the mouse; the drag then has to be repeated from there.
void note_incident(RepeatedDrag& drag, const std::string& kind, const Json& events) {
    for (const Json& each : events) {
        const auto moment = each.at("tick").get<std::uint64_t>();
        if (each.at("kind") != kind || (drag.caused && moment <= *drag.caused)) continue;
        for (std::size_t i = 1; i < drag.path.size(); ++i) {
            const RepeatedDrag::Point last = drag.path[i - 1], here = drag.path[i];
            if (here.moment != moment || here.at == last.at) continue;
            drag.caused = moment;
            if (drag.cured && !recurs(drag, each)) {
                drag.path.erase(drag.path.begin(), drag.path.begin() + static_cast<std::ptrdiff_t>(i));
                break;
            }
            drag.cured = false;
            drag.incident = each;
            drag.place = here.at;
            drag.direction = glm::normalize(here.at - last.at);
        }
    }
}

/// True if the cured drag has crossed the place where it caused the incident.
bool passed_again(const RepeatedDrag& drag, float within) {
    if (!drag.cured) return false;
    float side = 0.0f;       // the side on which it was, well away from the place
    bool came_near = false;  // since it was on that side
    for (std::size_t i = 0; i < drag.path.size(); ++i) {
        const glm::vec3 here = drag.path[i].at, last = drag.path[i > 0 ? i - 1 : 0].at;
        came_near = came_near || distance_to(drag.place, last, here) <= within;
        const float along = glm::dot(here - drag.place, drag.direction);
        if (std::abs(along) < 0.5f * within) continue;
        if (came_near && side * along < 0.0f) return true;
        side = along;
        came_near = false;
    }
    return false;
}

bool holds(const CardCondition& condition, std::uint64_t tried, const RepeatedDrag& drag, const Json& state) {
    using Kind = CardCondition::Kind;
    switch (condition.kind) {
        case Kind::Expected:
            return check_expectation(condition.expect, state).empty();
        case Kind::Present:
            return find_in_state(state, condition.name) != nullptr;
        case Kind::Noted: {
            const Json& events = state.at("events");
            return std::any_of(events.begin(), events.end(), [&](const Json& each) {
                return each.at("kind") == condition.name && each.at("tick").get<std::uint64_t>() >= tried;
            });
        }
        case Kind::Avoided:
            return passed_again(drag, condition.within);
    }
    return false;
}

/// True if the step waits only for its conditions.
bool pending(const CardProgress& progress, std::size_t step) {
    return !progress.done[step] && progress.tried[step];
}

constexpr float max_panel_share = 0.5f;
/// In larger parts, handles are not searched for the one to highlight.
constexpr std::size_t max_shown_bytes = 1u << 20;

enum class Fold { Steps, Current, Title };

/// The card's dimensions, in pixels.
struct Measure {
    float scale, line, padding, indent, wrap, title, footer, gap;

    Measure(const ShellFrame& frame, float width)
        : scale(frame.layout.scale),
          line(ImGui::GetTextLineHeight()),
          padding(12.0f * scale),
          indent(1.5f * line),
          wrap(std::max(4.0f * line, width - 2.0f * padding - indent)),
          title(ImGui::GetFrameHeight() + 0.5f * line),
          footer(ImGui::GetFrameHeight() + 0.3f * line),
          gap(0.45f * line) {}

    float height_of(const CardStep& step) const {
        return ImGui::CalcTextSize(step.text.c_str(), nullptr, false, wrap).y + gap;
    }
};

CardProgress progress_of(const ShellFrame& frame) {
    const auto& all = frame.workspace.ui.cards;
    const auto found = all.find(frame.workspace.lab);
    return found == all.end() ? CardProgress{} : found->second;
}

bool done(const CardProgress& progress, std::size_t step) {
    return step < progress.done.size() && progress.done[step];
}

float height(const Card& card, const Measure& m, Fold fold, std::size_t current) {
    float sum = 1.2f * m.padding + m.title;
    if (fold == Fold::Title) return sum;
    if (fold == Fold::Current)
        return sum + (current < card.steps.size() ? m.height_of(card.steps[current]) : 0.0f);
    for (const CardStep& step : card.steps) sum += m.height_of(step);
    return sum + m.footer;
}

/// A race, the microscope and the incidents of a trace need the card's space.
bool gives_way(const ShellFrame& frame) {
    return frame.lab.analyses(frame.workspace) ||
           std::ranges::any_of(frame.workspace.rewind.incidents(),
                               [](const Incident& each) { return !each.title.empty(); });
}

Fold fold_of(const ShellFrame& frame, const Measure& m, std::size_t current, float room) {
    if (gives_way(frame)) return Fold::Title;
    const Card& card = *frame.card;
    for (const Fold fold : {Fold::Steps, Fold::Current})
        if (height(card, m, fold, current) <= max_panel_share * room) return fold;
    return Fold::Title;
}

/// Sets up a card's scene and restarts the card.
void begin_card(const ShellFrame& frame, std::size_t index, Emit& emit) {
    for (const CardLine& line : frame.cards[index].scene) emit.typed(line.command, line.arguments);
    emit("view.card", {{"open", true}, {"number", index + 1}});
}

std::size_t shown_index(const ShellFrame& frame) {
    return static_cast<std::size_t>(frame.card - frame.cards.data());
}

void next_card_button(const ShellFrame& frame, Emit& emit) {
    const std::size_t next = (shown_index(frame) + 1) % frame.cards.size();
    const std::string tip =
        "Next card: " + frame.cards[next].title + ". Sets up its scene; undo restores yours";
    if (icon_button("next card", Icon::ChevronRight, tip.c_str())) begin_card(frame, next, emit);
}

void title_row(const Card& card, const CardProgress& progress, const ShellFrame& frame, const Measure& m,
               Emit& emit) {
    const float right = ImGui::GetWindowWidth() - m.padding, button = ImGui::GetFrameHeight();
    const auto count = std::count(progress.done.begin(), progress.done.end(), true);
    const std::string text = std::to_string(count) + " of " + std::to_string(card.steps.size());
    const float buttons = frame.cards.size() > 1 ? 2.0f * button : button;
    const float taken = ImGui::CalcTextSize(text.c_str()).x + buttons + 1.5f * m.gap;
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(heading_font());
    const bool both = ImGui::CalcTextSize(card.title.c_str()).x <= right - m.padding - taken;
    ImGui::TextUnformatted(elided(card.title, right - m.padding - (both ? taken : buttons)).c_str());
    ImGui::PopFont();
    if (both) {
        ImGui::SameLine(right - taken);
        ImGui::TextDisabled("%s", text.c_str());
    }
    if (frame.cards.size() > 1) {
        ImGui::SameLine(right - buttons + 0.2f * button);
        next_card_button(frame, emit);
    }
    ImGui::SameLine(right - button + 0.2f * button);
    const std::string keys = frame.shortcuts.keys_for("view.card");
    const std::string tip = "Put this card away. " + keys + ", or Help in the menu, brings it back";
    if (icon_button("put away", Icon::Close, tip.c_str())) emit("view.card", {{"open", false}});
}

void step_row(const CardStep& step, std::size_t index, bool is_done, bool is_current, const Measure& m,
              const Palette& colours) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList* const list = ImGui::GetWindowDrawList();
    const ImVec2 mark{at.x + 0.5f * m.line, at.y + 0.5f * m.line};
    if (is_done) {
        draw_icon(list, Icon::Check, mark, 0.8f * m.line, imgui_u32(colours.accent, 0.9f));
    } else {
        const std::string number = std::to_string(index + 1);
        const ImVec2 size = ImGui::CalcTextSize(number.c_str());
        if (is_current) list->AddCircleFilled(mark, 0.62f * m.line, imgui_u32(colours.accent), 24);
        list->AddText({mark.x - 0.5f * size.x, mark.y - 0.5f * size.y},
                      is_current ? imgui_u32(colours.bar) : imgui_u32(colours.text_dim), number.c_str());
    }
    const float alpha = is_done ? 0.85f : 1.0f;
    list->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x + m.indent, at.y},
                  imgui_u32(is_done ? colours.text_dim : colours.text, alpha), step.text.c_str(), nullptr,
                  m.wrap);
    ImGui::Dummy({m.indent + m.wrap, m.height_of(step) - ImGui::GetStyle().ItemSpacing.y});
}

void footer(const ShellFrame& frame, const Measure& m, Emit& emit) {
    ImGui::SetCursorPosX(m.padding + m.indent - ImGui::GetStyle().FramePadding.x);
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
    if (ImGui::Button("Start from the beginning")) begin_card(frame, shown_index(frame), emit);
    ImGui::PopStyleColor(2);
    if (ImGui::IsItemHovered()) tooltip("Sets up the scene that this card is about; undo restores yours");
}

/// Finds a handle by its pick if known, since listing many handles is slow.
std::optional<Handle> handle_named(const ShellFrame& frame, const std::string& name, PickId& known) {
    const Workspace& workspace = frame.workspace;
    if (known != no_pick) {
        auto handle = frame.lab.handle(workspace, known);
        if (handle && handle->name == name) return handle;
    }
    known = no_pick;
    if (workspace.document.parts().at(workspace.lab)->bytes() > max_shown_bytes) return std::nullopt;
    for (Handle& each : frame.lab.handles(workspace)) {
        if (each.name != name) continue;
        known = each.pick;
        return std::move(each);
    }
    return std::nullopt;
}

}  // namespace

void note_command(CardProgress& progress, const Card& card, const std::string& command, const Json& arguments,
                  bool changes, std::uint64_t moment, bool in_panel) {
    progress.done.resize(card.steps.size());
    progress.tried.resize(card.steps.size());
    progress.drags.resize(card.steps.size());
    for (std::size_t i = 0; i < card.steps.size(); ++i) {
        const CardStep& step = card.steps[i];
        auto& tried = progress.tried[i];
        const bool by_hand = !in_panel || step.place != CardStep::Place::Handle;
        const auto line = std::find_if(step.by.begin(), step.by.end(), [&](const CardLine& each) {
            return by_hand && matches(each, command, arguments);
        });
        const CardCondition* const cure = avoided(step);
        RepeatedDrag& drag = progress.drags[i];
        if (cure != nullptr && line != step.by.end()) {
            if (const auto to = moved_to(*line, arguments)) note_drag(drag, *to, moment);
        } else if (cure != nullptr && changes) {
            drag.path.clear();
            drag.cured = drag.caused && command == cure->cure;
        }
        if (line != step.by.end()) {
            tried = tried.value_or(moment);
            if (step.when.empty()) progress.done[i] = true;
            progress.seen = nullptr;
        } else if (changes) {
            tried.reset();
        }
    }
}

void watch_card(CardProgress& progress, const Card& card, const std::shared_ptr<const Part>& part,
                const std::function<Json()>& state, bool dragging) {
    if (progress.ticks_to_wait > 0) --progress.ticks_to_wait;
    if (!card_waits(progress, part) || progress.ticks_to_wait > 0) return;
    const Json now = state();
    bool undecided = false;
    for (std::size_t i = 0; i < card.steps.size(); ++i) {
        if (!pending(progress, i)) continue;
        const auto& when = card.steps[i].when;
        RepeatedDrag& drag = progress.drags[i];
        if (const CardCondition* const cure = avoided(card.steps[i]))
            note_incident(drag, cure->name, now.at("events"));
        if (dragging && drag.cured) {
            undecided = true;  // the rest of the drag may still cause it
            continue;
        }
        progress.done[i] = std::all_of(when.begin(), when.end(), [&](const CardCondition& condition) {
            return holds(condition, *progress.tried[i], drag, now);
        });
    }
    progress.seen = undecided ? nullptr : part;
    progress.ticks_to_wait = 1 + part->bytes() / bytes_per_tick;
}

bool card_waits(const CardProgress& progress, const std::shared_ptr<const Part>& part) {
    if (progress.seen == part || part->bytes() > max_watched_bytes) return false;
    for (std::size_t i = 0; i < progress.done.size(); ++i)
        if (pending(progress, i)) return true;
    return false;
}

std::size_t current_step(const CardProgress& progress, const Card& card) {
    for (std::size_t i = 0; i < card.steps.size(); ++i)
        if (i >= progress.done.size() || !progress.done[i]) return i;
    return card.steps.size();
}

const CardStep* step_to_do(const ShellFrame& frame) {
    if (frame.card == nullptr || gives_way(frame)) return nullptr;
    const std::size_t current = current_step(progress_of(frame), *frame.card);
    return current < frame.card->steps.size() ? &frame.card->steps[current] : nullptr;
}

float card_height(const ShellFrame& frame, glm::vec2 panel) {
    if (frame.card == nullptr) return 0.0f;
    const Measure m(frame, panel.x);
    const std::size_t current = current_step(progress_of(frame), *frame.card);
    return std::round(height(*frame.card, m, fold_of(frame, m, current, panel.y), current));
}

void show_card(const ShellFrame& frame, glm::vec2 panel, Emit& emit) {
    const Card& card = *frame.card;
    const Palette& colours = frame.colours();
    const Measure m(frame, panel.x);
    const CardProgress progress = progress_of(frame);
    const std::size_t current = current_step(progress, card);
    const Fold fold = fold_of(frame, m, current, panel.y);
    const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImDrawList* const list = ImGui::GetWindowDrawList();
    list->AddRectFilled(low, {low.x + size.x, low.y + size.y},
                        imgui_u32(glm::mix(colours.panel, colours.field, 0.6f)));
    list->AddLine(low, {low.x + size.x, low.y}, imgui_u32(colours.accent), 2.0f * m.scale);
    ImGui::SetCursorPos({m.padding, 0.7f * m.padding});
    title_row(card, progress, frame, m, emit);
    ImGui::SetCursorPos({m.padding, 0.7f * m.padding + m.title});
    for (std::size_t i = 0; i < card.steps.size() && fold != Fold::Title; ++i) {
        if (fold == Fold::Current && i != current) continue;
        ImGui::SetCursorPosX(m.padding);
        step_row(card.steps[i], i, done(progress, i), i == current, m, colours);
    }
    if (fold == Fold::Steps) footer(frame, m, emit);
}

void light_card_section(const ShellFrame& frame, bool left) {
    const CardStep* const step = step_to_do(frame);
    if (step == nullptr) return;
    if (step->place == (left ? CardStep::Place::Panel : CardStep::Place::Inspector))
        light_section(step->place_name.c_str());
}

std::optional<glm::vec2> show_card_halo(const ShellFrame& frame, PickId& known) {
    const CardStep* const step = step_to_do(frame);
    if (step == nullptr || step->place != CardStep::Place::Handle) return std::nullopt;
    const std::optional<Handle> found = handle_named(frame, step->place_name, known);
    if (!found || frame.lab.panes(frame.workspace).size() > 1) return std::nullopt;
    // A lab may have a handle that it does not show now.
    if (std::ranges::none_of(frame.drawn, [&](const Stroke& each) { return each.pick == found->pick; }))
        return std::nullopt;
    const Workspace& workspace = frame.workspace;
    const Rect& view = frame.layout.view;
    const auto at = Camera(workspace.camera, view).project(found->frame.position);
    if (!at || !view.contains(*at)) return std::nullopt;
    const float scale = frame.layout.scale;
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    list->PushClipRect({view.min.x, view.min.y}, {view.max.x, view.max.y});
    const glm::vec3 colour = frame.colours().accent;
    list->AddCircle({at->x, at->y}, 27.0f * scale, imgui_u32(colour, 0.16f), 64, 9.0f * scale);
    list->AddCircle({at->x, at->y}, 24.0f * scale, imgui_u32(colour, 0.95f), 64, 2.0f * scale);
    list->PopClipRect();
    return at;
}

}  // namespace tendril::app
