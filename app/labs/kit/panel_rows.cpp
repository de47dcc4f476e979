#include "app/labs/kit/panel_rows.hpp"

#include <imgui.h>
#include <algorithm>
#include <utility>

#include "app/document/runtime.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/row_search.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

namespace {

bool is_open(const Workspace& workspace, const char* title, Emit& emit, bool open_at_first) {
    const std::string section = workspace.lab + ": " + title;
    workspace.runtimes.of<DrawnSections>("sections").names.insert(section);
    const bool open = !is_folded(workspace.settings, section, !open_at_first);
    if (RowSearch* const search = row_search()) {
        search->inside.clear();
        if (!open) search->inside.push_back(section);
        if (search->title == title)
            search->found.insert(search->found.end(), search->inside.begin(), search->inside.end());
        return true;
    }
    if (section_button(title, open)) emit("view.fold", {{"section", section}, {"folded", open}});
    return open;
}

}  // namespace

FoldingSection::FoldingSection(const Workspace& workspace, const char* title, Emit& emit, bool open_at_first)
    : open_(is_open(workspace, title, emit, open_at_first)), ids_(title) {}

void more_rows(const Workspace& workspace, const char* title, const MoreRows& more, Emit& emit) {
    if (more.empty()) return;
    const std::string section = workspace.lab + ": " + title + ", more";
    workspace.runtimes.of<DrawnSections>("sections").names.insert(section);
    const bool open = !is_folded(workspace.settings, section, true);
    if (RowSearch* const search = row_search()) {
        const std::vector<std::string> around = search->inside;
        if (!open) search->inside.push_back(section);
        more.draw();
        search->inside = around;
        return;
    }
    if (more.head(open)) emit("view.fold", {{"section", section}, {"folded", open}});
    if (open) more.draw();
}

void folding_section(const Workspace& workspace, const char* title, Emit& emit, bool open_at_first,
                     const std::function<void(MoreRows&)>& rows) {
    const FoldingSection open(workspace, title, emit, open_at_first);
    if (!open) return;
    MoreRows more;
    rows(more);
    more_rows(workspace, title, more, emit);
}

bool preset_rows(const std::string& lab, const std::vector<PresetButton>& presets, const char* clears,
                 Emit& emit, int of) {
    bool opened = false;
    int in_row = 0, shown = 0;
    for (const PresetButton& preset : presets) {
        const char* const tooltip = preset.tooltip.empty() ? nullptr : preset.tooltip.c_str();
        const int wanted = preset.of > 0 ? preset.of : of;
        if (std::exchange(in_row, wanted) != wanted) end_row(), shown = 0;  // the width changes
        ++shown;
        if (!row_button(preset.title.c_str(), wanted, true, tooltip)) continue;
        emit(lab + ".preset", {{"name", preset.name}});
        opened = true;
    }
    // The last two buttons share the row of the last preset if they fill it.
    const bool filled = in_row == 3 && shown % 3 == 1;
    if (!filled) end_row();
    const int last = filled ? 3 : 2;
    if (row_button("Empty", last, true, clears)) emit(lab + ".clear");
    if (row_button("Reset", last, true, "Replaces this scene by the lab's first one; undo restores it"))
        emit(lab + ".reset");
    end_row();
    return opened;
}

void picture_rows(Emit& emit) {
    if (row_button("Save a picture", 2, true, "Saves or copies the view: size, background, labels (Ctrl+P)"))
        emit("view.picture_dialog");
    if (row_button("Record a video", 2, true, "The last ten seconds, or a full turn of the camera"))
        emit("view.video_dialog");
    end_row();
}

void cure_line(const std::string& text, const std::optional<Cure>& cure, Emit& emit, bool whole) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = ImGui::GetContentRegionAvail().x, left = ImGui::GetCursorPosX();
    const float width =
        cure ? ImGui::CalcTextSize(cure->title.c_str()).x + 2.0f * style.FramePadding.x : 0.0f;
    const float beside = room - width - (cure ? style.ItemSpacing.x : 0.0f);
    const bool above = whole && ImGui::CalcTextSize(text.c_str()).x > beside;
    if (above)
        note(text);
    else if (!text.empty())
        text_elided(text, beside, true);
    if (!cure) return;
    if (!above && !text.empty()) ImGui::SameLine(0.0f, 0.0f);
    ImGui::SetCursorPosX(left + std::max(0.0f, room - width));
    if (ImGui::SmallButton((cure->title + "##" + cure->text).c_str()))
        for (const CommandCall& call : cure->calls) emit.continuously(call.name, call.arguments);
    explain(cure->help.c_str());
}

void show_verdict(const Verdict& said, const Palette& palette, Emit& emit, VerdictLines room,
                  const std::function<void()>& notes) {
    const float top = ImGui::GetCursorPosY();
    verdict(said.text, said.kind == Verdict::Kind::Bad ? palette.limit : palette.text);
    if (!said.why.empty()) note(said.why);
    const float between = static_cast<float>(room.paragraphs - 1) * ImGui::GetStyle().ItemSpacing.y;
    const float height = verdict_height(room.verdict) + note_height(room.notes) + between;
    if (said.cure) {  // at the end of the space: nothing moves when the cure disappears
        const float spacing = ImGui::GetStyle().ItemSpacing.y, y = ImGui::GetCursorPosY();
        const float last = top + height - ImGui::GetTextLineHeight() - spacing;
        if (last < y && y - spacing <= last) ImGui::SetCursorPosY(last);
        cure_line("", said.cure, emit);
    }
    if (notes) notes();
    keep_room("verdict", top, height);
}

}  // namespace tendril::app
