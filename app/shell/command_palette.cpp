#include "app/shell/command_palette.hpp"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "app/shell/shortcuts.hpp"

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

}  // namespace

TypedCommand read_typed_command(const std::string& line) {
    const auto words = pieces(line);
    if (words.empty()) throw std::runtime_error("no command");
    TypedCommand typed{.name = words.front()};
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (equals == 0 || equals == std::string::npos) {
            throw std::runtime_error("\"" + words[i] + "\" is no argument; write name=value");
        }
        const std::string value = words[i].substr(equals + 1);
        Json parsed = Json::parse(value, nullptr, false);
        typed.arguments[words[i].substr(0, equals)] = parsed.is_discarded() ? Json(value) : std::move(parsed);
    }
    return typed;
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

void CommandPalette::run(const CommandTable& table, const Command* chosen, Emit& emit) {
    const std::string line = line_.data();
    try {
        if (line.find('=') == std::string::npos && chosen != nullptr) {
            const bool needs = std::any_of(chosen->arguments.begin(), chosen->arguments.end(),
                                           [](const Argument& a) { return a.required; });
            if (!needs) {
                emit("view.palette", {{"open", false}});
                emit(chosen->name);
                return;
            }
            std::snprintf(line_.data(), line_.size(), "%s %s=", chosen->name.c_str(), chosen->arguments.front().name.c_str());
            complaint_ = "Type its arguments: " + usage(*chosen);
            return;
        }
        const TypedCommand typed = read_typed_command(line);
        if (table.find(typed.name) == nullptr) throw std::runtime_error("there is no command \"" + typed.name + "\"");
        emit("view.palette", {{"open", false}});
        emit(typed.name, typed.arguments);
    } catch (const std::runtime_error& error) {
        complaint_ = error.what();
    }
}

void CommandPalette::list(const std::vector<const Command*>& found) {
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
            if (ImGui::Selectable("##row", i == chosen_, ImGuiSelectableFlags_SpanAllColumns)) chosen_ = i;
            ImGui::PopID();
            if (i == chosen_ && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
            ImGui::SameLine(0.0f, 0.0f);
            ImGui::TextUnformatted(usage(command).c_str());
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", command.help.c_str());
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", keys_for(command.name).c_str());
        }
        ImGui::EndTable();
    }
    ImGui::EndChild();
}

void CommandPalette::frame(bool open, const CommandTable& table, glm::vec2 screen, float scale, Emit& emit) {
    const bool appearing = open && !was_open_;
    was_open_ = open;
    if (!open) return;
    if (appearing) {
        line_.fill('\0');
        chosen_ = 0;
        complaint_.clear();
    }
    const float width = std::min(820.0f * scale, 0.9f * screen.x);
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.14f * screen.y}, ImGuiCond_Always, {0.5f, 0.0f});
    const auto found = search_commands(table, line_.data());
    const float rows = static_cast<float>(std::max<std::size_t>(found.size(), 3)) + 5.0f;  // with the line and its help
    ImGui::SetNextWindowSize({width, std::min(rows * ImGui::GetTextLineHeightWithSpacing(), 0.7f * screen.y)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 9.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::Begin("palette", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);

    ImGui::SetNextItemWidth(-1.0f);
    if (appearing) {
        ImGui::SetWindowFocus();
        ImGui::SetKeyboardFocusHere();
    }
    const bool entered = ImGui::InputTextWithHint("##line", "Find a command: chain.add length=1.5", line_.data(),
                                                  line_.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemEdited()) {
        chosen_ = 0;
        complaint_.clear();
    }
    const auto step = [&](ImGuiKey key, int by) {
        if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(key))) chosen_ += by;
    };
    step(ImGuiKey_DownArrow, 1);
    step(ImGuiKey_UpArrow, -1);
    chosen_ = std::clamp(chosen_, 0, std::max(0, static_cast<int>(found.size()) - 1));
    list(found);
    if (!complaint_.empty()) {
        ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s", complaint_.c_str());
    } else {
        ImGui::TextDisabled("%zu commands.  Up and Down choose, Enter runs, Escape closes.", found.size());
    }
    if (entered) {
        run(table, found.empty() ? nullptr : found[static_cast<std::size_t>(chosen_)], emit);
        ImGui::SetKeyboardFocusHere(-1);
    }
    ImGui::End();
}

}  // namespace tendril::app
