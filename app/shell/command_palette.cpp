#include "app/shell/command_palette.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/shell/shell.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_recent = 8;

/// Height below the list: the chosen row's help, and a line with the mistake or the available keys.
float height_below(const std::string& help) {
    const float line = ImGui::GetTextLineHeightWithSpacing(), width = ImGui::GetContentRegionAvail().x;
    const float wrapped = ImGui::CalcTextSize(help.c_str(), nullptr, false, width).y;
    // Room for two lines of help keeps the list from moving; in a low window the rows need that room.
    const float fewest = ImGui::GetWindowHeight() < 18.0f * line ? 1.0f : 2.0f;
    return line +
           std::clamp(wrapped, fewest * ImGui::GetTextLineHeight(), 4.0f * ImGui::GetTextLineHeight()) +
           3.0f * ImGui::GetStyle().ItemSpacing.y + 0.25f * ImGui::GetTextLineHeight();
}

void begin_palette(const std::vector<PaletteRow>& rows, bool headed, glm::vec2 screen, float scale) {
    const float width = std::min(820.0f * scale, 0.9f * screen.x);
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float others = (headed ? 7.0f : 6.0f) * line;  // the input line, its command, its help
    const float wanted = palette_list_height(rows, width - 2.0f * ImGui::GetStyle().WindowPadding.x) + others;
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.1f * screen.y}, ImGuiCond_Always, {0.5f, 0.0f});
    ImGui::SetNextWindowSize(
        {width, std::min(wanted, std::max(0.7f * screen.y, std::min(0.86f * screen.y, 16.0f * line)))});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 9.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::Begin("palette", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

/// The lab that a command acts on, if that is not the open one.
const Lab* other_lab(const ShellFrame& frame, const Command& command) {
    return command.lab == frame.workspace.lab ? nullptr : frame.labs.find(command.lab);
}

/// Shows the command whose arguments are being typed.
void header(const ShellFrame& frame, const Command& command) {
    const float room = ImGui::GetContentRegionAvail().x;
    const Lab* const lab = other_lab(frame, command);
    ImGui::TextUnformatted((command.title + (lab ? ", in the " + lab->title() + " lab" : "")).c_str());
    const float left = room - ImGui::GetItemRectSize().x - ImGui::GetStyle().ItemSpacing.x;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", elided_at_word(command.help, left).c_str());
}

/// The line that Enter and Tab begin for a command: "chain.add length=", "undo".
std::string begun(const Command& command, bool optional_too) {
    const auto needed = std::find_if(command.arguments.begin(), command.arguments.end(),
                                     [](const Argument& a) { return a.required; });
    if (needed != command.arguments.end()) return command.name + " " + needed->name + "=";
    return command.name + (optional_too && !command.arguments.empty() ? " " : "");
}

/// Positions of the columns, in pixels from the left.
struct Columns {
    float where = 0.0f, syntax = 0.0f, keys = 0.0f;
    bool two_lines = false;  ///< the syntax is below the title
    float height = 0.0f;     ///< a row's
};

/// Pixels between columns; margin() is before the first.
float gap() {
    return 1.2f * ImGui::GetFontSize();
}
float margin() {
    return 0.4f * ImGui::GetFontSize();
}

float width_of(const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x;
}

Columns columns(const std::vector<PaletteRow>& rows, float width) {
    float title = 0.0f, where = 0.0f, name = 0.0f, keys = 0.0f;
    for (const PaletteRow& row : rows) {
        title = std::max(title, width_of(row.title));
        where = std::max(where, width_of(row.where));
        name = std::max(name, width_of(row.syntax.substr(0, row.syntax.find(' ')) + " ..."));
        keys = std::max(keys, width_of(row.keys));
    }
    Columns c;
    c.where = margin() + title + gap();
    c.syntax = c.where + (where > 0.0f ? where + gap() : 0.0f);
    c.keys = width - keys - margin();
    c.two_lines = c.syntax + name + gap() > c.keys;
    c.height = ImGui::GetTextLineHeightWithSpacing() + (c.two_lines ? ImGui::GetTextLineHeight() : 0.0f);
    return c;
}

void write_at(ImVec2 at, const std::string& text, bool bright) {
    const ImU32 colour = ImGui::GetColorU32(bright ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    ImGui::GetWindowDrawList()->AddText(at, colour, text.c_str(), text.c_str() + text.size());
}

void write_row(const PaletteRow& row, const Columns& c, ImVec2 from) {
    const auto at = [&](float x, float y = 0.0f) { return ImVec2(std::floor(from.x + x), from.y + y); };
    const float right = c.keys - (row.keys.empty() ? 0.0f : gap());
    if (c.two_lines) {
        write_at(at(margin()), elided_at_word(row.title, right - margin()), !row.done);
        const std::string below = row.where.empty() ? row.syntax : row.where + ":  " + row.syntax;
        write_at(at(gap(), ImGui::GetTextLineHeight()), elided_at_word(below, right - gap()), false);
    } else {
        write_at(at(margin()), row.title, !row.done);
        write_at(at(c.where), row.where, false);
        write_at(at(c.syntax), elided_at_word(row.syntax, c.keys - gap() - c.syntax), false);
    }
    write_at(at(c.keys), row.keys, false);
}

/// Scrolls by the minimum that shows all of the last item.
void scroll_to_item() {
    const float top = ImGui::GetWindowPos().y, bottom = top + ImGui::GetWindowSize().y;
    if (ImGui::GetItemRectMin().y < top) ImGui::SetScrollHereY(0.0f);
    if (ImGui::GetItemRectMax().y > bottom) ImGui::SetScrollHereY(1.0f);
}

}  // namespace

CommandPalette::Offer CommandPalette::offer(const ShellFrame& frame) const {
    const std::string line = line_.data();
    Offer offer{.typed = read_typed_line(frame.commands, line)};
    if (offer.typed.command == nullptr) {
        offer.found = search_commands(frame.commands, line, frame.workspace.lab, recent_);
    } else {
        offer.completions = completions(offer.typed, line, frame.workspace);
    }
    return offer;
}

void CommandPalette::reset() {
    line_.fill('\0');
    chosen_ = listed_choice_ = 0;
    moved_ = focus_line_ = false;
    error_.clear();
}

void CommandPalette::set_line(const std::string& line) {
    if (line.size() >= line_.size()) return;
    line_.fill('\0');
    std::copy(line.begin(), line.end(), line_.begin());
    chosen_ = 0;
    moved_ = false;
    focus_line_ = true;
    error_.clear();
}

std::string CommandPalette::tabbed(const ShellFrame& frame) const {
    const std::string line = line_.data();
    const Offer now = offer(frame);
    const auto chosen = static_cast<std::size_t>(chosen_);
    if (chosen >= now.size()) return line;
    if (now.typed.command != nullptr)
        return moved_ ? now.completions[chosen].line : completed(now.typed, line, now.completions, chosen);
    std::vector<std::string> names;
    for (const Command& command : frame.commands.all())
        if (!line.empty() && command.name.starts_with(line)) names.push_back(command.name);
    const std::string common = common_prefix(names);
    if (!moved_ && names.size() > 1 && common.size() > line.size()) return common;
    return begun(*now.found[chosen], true);
}

int CommandPalette::on_tab(const ShellFrame& frame, ImGuiInputTextCallbackData& data) {
    // While focused the field edits its own copy, which has the typed text.
    std::copy(data.Buf, data.Buf + data.BufTextLen + 1, line_.begin());
    const std::string line = tabbed(frame);
    if (line.size() >= line_.size() || line == data.Buf) return 0;
    data.DeleteChars(0, data.BufTextLen);
    data.InsertChars(0, line.c_str());
    return 0;
}

bool CommandPalette::line_field(const ShellFrame& frame, bool appearing) {
    if (appearing || focus_line_) {
        ImGui::SetWindowFocus();  // a click on a row has moved it to the list
        ImGui::SetKeyboardFocusHere();
    }
    struct Context {
        CommandPalette& palette;
        const ShellFrame& frame;
    } context{*this, frame};
    const auto called = [](ImGuiInputTextCallbackData* data) {
        const auto& [palette, of] = *static_cast<Context*>(data->UserData);
        if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion) return palette.on_tab(of, *data);
        // Dear ImGui selects the whole line when it gets the focus; typing would replace it.
        if (palette.focus_line_)
            data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
        palette.focus_line_ = false;
        return 0;
    };
    ImGui::SetNextItemWidth(-1.0f);
    const bool entered = ImGui::InputTextWithHint(
        "##line", "Find a command: add, undo, time.speed factor=0.5", line_.data(), line_.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackAlways |
            ImGuiInputTextFlags_CallbackCompletion,
        called, &context);
    if (entered) ImGui::SetKeyboardFocusHere(-1);  // Enter drops the focus; take it back in any case
    if (ImGui::IsItemEdited()) {
        chosen_ = 0;
        moved_ = false;
        error_.clear();
    }
    return entered;
}

void CommandPalette::move_choice(int count) {
    const int before = chosen_;
    const auto step = [&](ImGuiKey key, int by) {
        if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(key))) chosen_ += by;
    };
    step(ImGuiKey_DownArrow, 1);
    step(ImGuiKey_UpArrow, -1);
    chosen_ = std::clamp(chosen_, 0, std::max(0, count - 1));
    moved_ = moved_ || chosen_ != before;
}

std::vector<PaletteRow> CommandPalette::rows(const ShellFrame& frame, const Offer& offer) const {
    std::vector<PaletteRow> list;
    for (const Command* command : offer.found) {
        const Lab* const lab = other_lab(frame, *command);
        list.push_back({command->title, lab ? lab->title() : "", usage(*command),
                        frame.shortcuts.keys_for(command->name),
                        (lab ? "Opens the " + lab->title() + " lab. " : "") + command->help});
    }
    for (const CompletionRow& completion : offer.completions) {
        const std::string help = completion.help.empty() ? completion.detail : completion.help;
        list.push_back({completion.text, "", completion.detail, completion.given ? "given" : "", help,
                        completion.given});
    }
    return list;
}

void CommandPalette::status(const Offer& offer) const {
    const float room = ImGui::GetContentRegionAvail().x;
    const bool search = offer.typed.command == nullptr;
    const std::string wrong = error_.empty() ? mistake(offer.typed) : error_;
    if (!wrong.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
        text_elided(wrong, room);
        ImGui::PopStyleColor();
        return;
    }
    const std::string keys = "Up and Down choose, Tab completes, Enter runs, Escape closes.";
    const std::string lack = missing(offer.typed);
    const bool typed_now = offer.typed.last.assigned && lack.starts_with(offer.typed.last.name + " ");
    const std::string text = search ? count_text(offer.found.size(), "command") + ".  " + keys
                             : !lack.empty() && !typed_now ? lack
                                                           : keys;
    const bool fits = ImGui::CalcTextSize(text.c_str()).x <= room;
    ImGui::TextDisabled("%s", elided_at_word(fits || !search ? text : keys, room).c_str());
}

void CommandPalette::run(const ShellFrame& frame, const Command& command, SharedJson arguments, Emit& emit) {
    std::erase(recent_, command.name);
    recent_.insert(recent_.begin(), command.name);
    if (recent_.size() > max_recent) recent_.pop_back();
    emit("view.palette", {{"open", false}});
    if (other_lab(frame, command) != nullptr) emit("lab.open", {{"name", command.lab}});
    ran_ = Emitted{command.name, arguments, false};
    emit.typed(command.name, std::move(arguments));
}

void CommandPalette::choose(const ShellFrame& frame, const Offer& offer, std::size_t row, Emit& emit) {
    if (offer.typed.command != nullptr) return set_line(offer.completions[row].line);
    const Command& command = *offer.found[row];
    const bool needs = std::any_of(command.arguments.begin(), command.arguments.end(),
                                   [](const Argument& a) { return a.required; });
    if (needs) return set_line(begun(command, false));
    // Use the arguments of the command's shortcut: Ctrl+Q asks before it quits.
    const auto& keys = frame.shortcuts.all();
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const Shortcut& each) {
        return each.command == command.name && frame.works_here(each);
    });
    run(frame, command, key == keys.end() ? Json::object() : to_json(key->arguments), emit);
}

void CommandPalette::run(const ShellFrame& frame, Emit& emit) {
    focus_line_ = true;
    try {
        TypedCommand typed = read_typed_command(line_.data());
        const Command* command = frame.commands.find(typed.name);
        if (command == nullptr) throw std::runtime_error("there is no command \"" + typed.name + "\"");
        check_arguments(*command, *typed.arguments);
        run(frame, *command, std::move(typed.arguments), emit);
    } catch (const std::runtime_error& error) {
        error_ = error.what();
    }
}

void CommandPalette::enter(const ShellFrame& frame, const Offer& offer, Emit& emit) {
    focus_line_ = true;
    const std::string line = line_.data();
    const auto row = static_cast<std::size_t>(chosen_);
    if (line.empty() && !moved_ && recent_.empty()) return;  // nothing was entered
    if (offer.typed.command == nullptr) {
        if (line.find('=') == std::string::npos && row < offer.found.size())
            return choose(frame, offer, row, emit);
        return run(frame, emit);
    }
    const bool changes_line = row < offer.completions.size() && offer.completions[row].line != line;
    if (changes_line && moved_) return choose(frame, offer, row, emit);
    run(frame, emit);
    // The line is valid but incomplete: continue with the unfinished or missing argument.
    if (!error_.empty() && changes_line && !offer.completions[row].given && mistake(offer.typed).empty())
        choose(frame, offer, row, emit);
}

void CommandPalette::frame(const ShellFrame& frame, Emit& emit) {
    const bool open = frame.workspace.ui.palette;
    const bool appearing = open && !was_open_;
    was_open_ = open;
    if (!open) return;
    if (appearing) reset();
    const Offer before = offer(frame);
    begin_palette(rows(frame, before), before.typed.command != nullptr, frame.screen(), frame.layout.scale);
    const bool entered = line_field(frame, appearing);
    const Offer now = offer(frame);
    if (now.typed.command != nullptr) header(frame, *now.typed.command);
    move_choice(static_cast<int>(now.size()));
    const bool moved = std::exchange(listed_choice_, chosen_) != chosen_;
    const std::vector<PaletteRow> list = rows(frame, now);
    const auto chosen = static_cast<std::size_t>(chosen_);
    const std::string help = chosen < list.size() ? list[chosen].help : std::string();
    const auto clicked = palette_list(list, chosen_, moved, height_below(help));
    ImGui::Dummy({0.0f, 0.25f * ImGui::GetTextLineHeight()});
    ImGui::TextWrapped("%s", help.c_str());
    ImGui::SetCursorPosY(ImGui::GetWindowHeight() - ImGui::GetStyle().WindowPadding.y -
                         ImGui::GetTextLineHeight());
    status(now);
    if (clicked) {
        focus_line_ = true;
        choose(frame, now, *clicked, emit);
    } else if (entered) {
        enter(frame, now, emit);
    }
    ImGui::End();
}

float palette_list_height(const std::vector<PaletteRow>& rows, float width) {
    return static_cast<float>(std::max<std::size_t>(rows.size(), 3)) * columns(rows, width).height;
}

std::optional<std::size_t> palette_list(const std::vector<PaletteRow>& rows, int chosen,
                                        bool bring_choice_into_view, float below) {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float width = std::max(1.0f, room.x - ImGui::GetStyle().ScrollbarSize);
    const Columns c = columns(rows, width);
    const float whole = std::max(1.0f, std::floor((room.y - below) / c.height)) * c.height;
    std::optional<std::size_t> clicked;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0.0f, 0.0f));
    ImGui::BeginChild("found", {0.0f, whole}, false, ImGuiWindowFlags_NoNav);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool is_chosen = static_cast<int>(i) == chosen;
        const ImVec2 from = ImGui::GetCursorScreenPos();
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable("##row", is_chosen, ImGuiSelectableFlags_None, {width, c.height})) clicked = i;
        ImGui::PopID();
        if (is_chosen && bring_choice_into_view) scroll_to_item();
        if (!ImGui::IsItemVisible()) continue;
        explain(rows[i].help.c_str());
        write_row(
            rows[i], c,
            {from.x, from.y + 0.5f * (c.height - ImGui::GetTextLineHeight() * (c.two_lines ? 2.0f : 1.0f))});
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    return clicked;
}

}  // namespace tendril::app
