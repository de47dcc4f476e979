// What one chooses in the Humanoid lab: the character, its bones, a clip, how all of it is shown.
#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "app/document/units.hpp"
#include "app/fields/field_rows.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/labs/humanoid/past/past.hpp"
#include "app/labs/kit/flip_rule.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

constexpr PastHelp past_help{
    "What of the last ten seconds is plotted below the scene: how far the selected effector is from its "
    "target, "
    "or how the selected joint is turned, from the T-pose",
    "Where the body was, at every half second"};

void rest_row(const HumanoidPanel& panel) {
    const HumanoidPart& part = panel.part;
    const char* const name = humanoid::name(part.map->rest);
    reading("rest pose", "%s", part.map->rest == humanoid::RestPose::Other ? "neither T nor A" : name);
    explain("T: the arms are level at rest. A: they hang by a quarter to three quarters of a right angle.");
    bool on = part.t_pose;
    if (ImGui::Checkbox("Rest as a T-pose", &on)) panel.emit("humanoid.t_pose", {{"on", on}});
    explain(
        "Shows the rest pose with its arms straight aside and its legs straight down, and as it came as a "
        "ghost.");
}

void scale_row(const HumanoidPanel& panel) {
    if (panel.part.loaded->file.empty()) return;
    // Units span many orders of magnitude: centimetres are the usual one.
    auto centimetres = static_cast<float>(100.0 * panel.part.loaded->character.scale);
    if (number_field("unit of the file", centimetres, 0.01f, 1e-4f, 1e8f, "%.4g cm"))
        panel.emit.continuously("humanoid.scale", {{"metres", 0.01 * static_cast<double>(centimetres)}});
    explain("How long a unit of the file is. The character's height says whether it is right.");
}

void kept_map_rows(const HumanoidPanel& panel) {
    KeptMaps& maps = panel.runtime.kept_maps;
    if (const std::string& why = maps.refused(panel.workspace); !why.empty()) note(why + '.');
    const SavedMap* const map = maps.offered(panel.workspace);
    if (map == nullptr) return;
    const std::vector<humanoid::Bone> bones = bones_that_differ(*map, panel.part);
    std::string names;
    for (const humanoid::Bone bone : bones)
        names += (names.empty() ? "" : ", ") + std::string(humanoid::name(bone));
    note("A bone map that you made for these node names differs in " + count_text(bones.size(), "bone") +
         ": " + names + '.');
    if (row_button("Use it", 2, true, "The bones become what you made them then"))
        panel.emit("humanoid.map.use");
    if (row_button("Forget it", 2, true, "It is not offered again")) panel.emit("humanoid.map.forget");
    end_row();
}

}  // namespace

HumanoidPanel humanoid_panel(const Workspace& workspace, Emit& emit) {
    return {workspace, humanoid_part(workspace), humanoid_runtime(workspace),
            palette(workspace.settings.theme), emit};
}

void character_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Character", panel.emit)) return;
    const LoadedCharacter& loaded = *panel.part.loaded;
    std::string file = loaded.file;
    if (text_field("file", file, "type or drop one") && file != loaded.file) {
        if (file.empty())
            panel.emit("humanoid.load");
        else
            panel.emit("humanoid.load", {{"path", file}});
    }
    explain("A character with its clips: .gltf, .glb, .fbx or .bvh. Enter reads it.");
    if (const Loading& loading = panel.runtime.loading; loading.running()) {
        note("Loading " + std::filesystem::path(loading.file()).filename().string() + " ...");
        ImGui::ProgressBar(loading.part(), {-1.0f, 0.0f}, "");
        if (row_button("Cancel", 1, true, "The character that is there stays"))
            panel.emit("humanoid.load.cancel");
        end_row();
    }
    if (row_button("Stick figure", 1, !loaded.file.empty(), "The figure that is there without a file"))
        panel.emit("humanoid.load");
    end_row();
    kept_map_rows(panel);
    scale_row(panel);
    reading("height", "%.2f m", loaded.height());
    rest_row(panel);
    for (const std::string& text : loaded.character.notes) note(text);
}

void clip_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Clip", panel.emit)) return;
    const std::vector<humanoid::Clip>& clips = panel.part.loaded->clips();
    const Playback& playback = panel.part.playback;
    if (clips.empty()) return note("The character has no clips.");
    const std::string shown = playback.clip ? clips[*playback.clip].name : "none (rest pose)";
    if (begin_search("clip", &shown, panel.runtime.panel.clip)) {
        if (search_row("none (rest pose)", !playback.clip, panel.runtime.panel.clip))
            panel.emit("humanoid.clip", {{"name", ""}});
        for (std::size_t i = 0; i < clips.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (search_row(clips[i].name, playback.clip == i, panel.runtime.panel.clip))
                panel.emit("humanoid.clip", {{"index", i}, {"play", true}});
            ImGui::PopID();
        }
        end_search();
    }
    explain("Which motion of the file is shown. Type a part of its name to find one.");
    FieldRows(playback, "humanoid.clip", panel.emit).rows("speed", "loop", "in_place");
    if (playback.playing && !panel.workspace.clock.playing) note("Paused: press Space to let it play.");
}

void look_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "View", panel.emit)) return;
    const FieldRows view(panel.part.view, "humanoid.view", panel.emit);
    view.row("follow");
    if (panel.part.loaded->character.skin.mesh) view.rows("skin", "skinning");
    view.rows("limits", "ghost");
    past_view_rows(panel.workspace, humanoid_past(), past_help, panel.emit);
}

void HumanoidLab::panel(const Workspace& workspace, Emit& emit) const {
    const HumanoidPanel panel = humanoid_panel(workspace, emit);
    character_rows(panel);
    clip_rows(panel);
    lint_rows(panel);
    target_rows(panel);
    hand_rows(panel);
    ground_rows(panel);
    spring_rows(panel);
    attachment_rows(panel);
    look_rows(panel);
    if (folding_section(workspace, "What counts as a flip", emit, false))
        flip_rows(panel.part.flips, humanoid_flip_words, emit);
    export_rows(panel);
    bone_rows(panel);
    map_rows(panel);
}

}  // namespace tendril::app
