#include "app/shell/command_palette.hpp"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Splits at blanks, but not within brackets or quotes.
std::vector<std::string> pieces(const std::string& line) {
    std::vector<std::string> found;
    std::string piece;
    int depth = 0;
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (!quoted && (c == '[' || c == '{')) ++depth;
        if (!quoted && (c == ']' || c == '}')) --depth;
        if (c == ' ' && depth <= 0 && !quoted) {
            if (!piece.empty()) found.push_back(std::exchange(piece, {}));
        } else {
            piece += c;
        }
    }
    if (!piece.empty()) found.push_back(piece);
    return found;
}

/// Scrolls just as far as it takes to have the last item wholly in the window.
void scroll_to_item() {
    const float top = ImGui::GetWindowPos().y, bottom = top + ImGui::GetWindowSize().y;
    if (ImGui::GetItemRectMin().y < top) ImGui::SetScrollHereY(0.0f);
    if (ImGui::GetItemRectMax().y > bottom) ImGui::SetScrollHereY(1.0f);
}

void begin_palette(std::size_t commands, glm::vec2 screen, float scale) {
    const float width = std::min(820.0f * scale, 0.9f * screen.x);
    const float rows =
        static_cast<float>(std::max<std::size_t>(commands, 3)) + 5.0f;  // with the line and its help
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.14f * screen.y}, ImGuiCond_Always, {0.5f, 0.0f});
    ImGui::SetNextWindowSize(
        {width, std::min(rows * ImGui::GetTextLineHeightWithSpacing(), 0.7f * screen.y)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 9.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::Begin("palette", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

}  // namespace

TypedCommand read_typed_command(const std::string& line) {
    const auto words = pieces(line);
    if (words.empty()) throw std::runtime_error("no command");
    Json arguments = Json::object();
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (equals == 0 || equals == std::string::npos) {
            throw std::runtime_error("\"" + words[i] + "\" is no argument; write name=value");
        }
        const std::string value = words[i].substr(equals + 1);
        Json parsed = Json::parse(value, nullptr, false);
        arguments[words[i].substr(0, equals)] = parsed.is_discarded() ? Json(value) : std::move(parsed);
    }
    return {words.front(), std::move(arguments)};
}

std::vector<const Command*> search_commands(const CommandTable& table, const std::string& query) {
    std::istringstream stream(lower(query.substr(0, query.find('='))));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    // With "chain.add length=..." typed, the last word is an argument's name.
    if (query.find('=') != std::string::npos && words.size() > 1) words.resize(1);

    std::vector<const Command*> first, rest;
    for (const Command& command : table.all()) {
        const std::string text = lower(command.name + " " + command.help);
        const auto in_text = [&](const std::string& word) { return text.find(word) != std::string::npos; };
        if (!std::all_of(words.begin(), words.end(), in_text)) continue;
        const bool starts = !words.empty() && command.name.rfind(words.front(), 0) == 0;
        (starts ? first : rest).push_back(&command);
    }
    first.insert(first.end(), rest.begin(), rest.end());
    return first;
}

void CommandPalette::forget() {
    line_.fill('\0');
    chosen_ = listed_choice_ = 0;
    take_caret_ = false;
    complaint_.clear();
}

void CommandPalette::run_chosen(const Command& chosen, Emit& emit) {
    const auto needed = std::find_if(chosen.arguments.begin(), chosen.arguments.end(),
                                     [](const Argument& a) { return a.required; });
    if (needed == chosen.arguments.end()) {
        emit("view.palette", {{"open", false}});
        emit(chosen.name);
        return;
    }
    std::snprintf(line_.data(), line_.size(), "%s %s=", chosen.name.c_str(), needed->name.c_str());
    complaint_ = "Type its arguments: " + usage(chosen);
    chosen_ = 0;
    take_caret_ = true;
}

void CommandPalette::run(const CommandTable& table, const Command* chosen, Emit& emit) {
    const std::string line = line_.data();
    take_caret_ = true;
    try {
        if (line.find('=') == std::string::npos && chosen != nullptr) {
            run_chosen(*chosen, emit);
            return;
        }
        const TypedCommand typed = read_typed_command(line);
        if (table.find(typed.name) == nullptr)
            throw std::runtime_error("there is no command \"" + typed.name + "\"");
        emit("view.palette", {{"open", false}});
        emit.typed(typed.name, typed.arguments);
    } catch (const std::runtime_error& error) {
        complaint_ = error.what();
    }
}

bool CommandPalette::line_field(bool appearing) {
    if (appearing) ImGui::SetWindowFocus();
    if (appearing || take_caret_) ImGui::SetKeyboardFocusHere();
    // Dear ImGui selects the whole line when it hands over the keyboard: what is typed next would replace it.
    const auto caret_to_end = [](ImGuiInputTextCallbackData* data) {
        bool& wanted = *static_cast<bool*>(data->UserData);
        if (wanted) data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
        wanted = false;
        return 0;
    };
    ImGui::SetNextItemWidth(-1.0f);
    const bool entered = ImGui::InputTextWithHint(
        "##line", "Find a command: time.speed factor=0.5", line_.data(), line_.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackAlways, caret_to_end,
        &take_caret_);
    if (entered)
        ImGui::SetKeyboardFocusHere(-1);  // Enter lets go of the line; whatever comes of it, take it back
    if (ImGui::IsItemEdited()) {
        chosen_ = 0;
        complaint_.clear();
    }
    return entered;
}

void CommandPalette::move_choice(int count) {
    const auto step = [&](ImGuiKey key, int by) {
        if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(key))) chosen_ += by;
    };
    step(ImGuiKey_DownArrow, 1);
    step(ImGuiKey_UpArrow, -1);
    chosen_ = std::clamp(chosen_, 0, std::max(0, count - 1));
}

const Command* CommandPalette::list(const Found& found, const Shortcuts& shortcuts,
                                    bool bring_choice_into_view) {
    const Command* clicked = nullptr;
    ImGui::BeginChild("found", {0.0f, -ImGui::GetTextLineHeightWithSpacing()}, false, ImGuiWindowFlags_NoNav);
    if (ImGui::BeginTable("commands", 3, ImGuiTableFlags_NoPadOuterX | ImGuiTableFlags_SizingStretchProp)) {
        ImGui::TableSetupColumn("usage", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch, 1.35f);
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed);
        for (int i = 0; i < static_cast<int>(found.size()); ++i) {
            const Command& command = *found[static_cast<std::size_t>(i)];
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::PushID(i);
            if (ImGui::Selectable("##row", i == chosen_, ImGuiSelectableFlags_SpanAllColumns))
                clicked = &command;
            ImGui::PopID();
            if (i == chosen_ && bring_choice_into_view) scroll_to_item();
            ImGui::SameLine(0.0f, 0.0f);
            text_elided(usage(command), ImGui::GetContentRegionAvail().x);
            ImGui::TableNextColumn();
            text_elided(command.help, ImGui::GetContentRegionAvail().x, true);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", shortcuts.keys_for(command.name).c_str());
        }
        ImGui::EndTable();
    }
    ImGui::EndChild();
    return clicked;
}

void CommandPalette::explain(const Found& found) {
    const float room = ImGui::GetContentRegionAvail().x;
    if (!complaint_.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
        text_elided(complaint_, room);
        ImGui::PopStyleColor();
    } else {
        text_elided(count_text(found.size(), "command") + ".  Up and Down choose, Enter runs, Escape closes.",
                    room, true);
    }
}

void CommandPalette::frame(bool open, const CommandTable& table, const Shortcuts& shortcuts, glm::vec2 screen,
                           float scale, Emit& emit) {
    const bool appearing = open && !was_open_;
    was_open_ = open;
    if (!open) return;
    if (appearing) forget();
    const Found before = search_commands(table, line_.data());
    begin_palette(before.size(), screen, scale);
    const bool entered = line_field(appearing);
    const Found found = search_commands(table, line_.data());
    move_choice(static_cast<int>(found.size()));
    const bool moved = std::exchange(listed_choice_, chosen_) != chosen_;
    const Command* clicked = list(found, shortcuts, moved);
    explain(found);
    if (clicked != nullptr) {
        run_chosen(*clicked, emit);
    } else if (entered) {
        run(table, found.empty() ? nullptr : found[static_cast<std::size_t>(chosen_)], emit);
    }
    ImGui::End();
}

}  // namespace tendril::app
