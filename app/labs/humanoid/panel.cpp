#include "app/labs/humanoid/panel.hpp"

#include <imgui.h>
#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>

#include "app/fields/field_rows.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/past.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/row_search.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

// Sections of the left panel: the character, its bones, a clip, the view.

namespace {

void rest_row(const HumanoidPanel& panel) {
    const HumanoidPart& part = panel.part;
    const char* const name = humanoid::name(part.map->rest);
    reading("rest pose", "%s", part.map->rest == humanoid::RestPose::Other ? "neither T nor A" : name);
    explain("T: arms level at rest. A: arms lowered by 22 to 68 degrees.");
    bool on = part.t_pose;
    if (ImGui::Checkbox("Rest as a T-pose", &on)) panel.emit("humanoid.t_pose", {{"on", on}});
    explain(
        "Shows the rest pose with arms straight out and legs straight down; the ghost is the file's own "
        "pose.");
}

void scale_row(const HumanoidPanel& panel) {
    if (panel.part.loaded->file.empty()) return;
    // Units span many orders of magnitude; centimetres are the usual one.
    auto centimetres = static_cast<float>(100.0 * panel.part.loaded->character.scale);
    if (number_field("file unit", centimetres, 0.01f, 1e-4f, 1e8f, "%.4g cm"))
        panel.emit.continuously("humanoid.scale", {{"metres", 0.01 * static_cast<double>(centimetres)}});
    explain("The length of one unit in the file. The character's height shows whether it is right.");
}

/// Warns of an implausible height, with a button that fixes it.
void unit_rows(const HumanoidPanel& panel) {
    const auto doubt = panel.part.loaded->doubted_unit(*panel.part.map);
    if (panel.part.loaded->file.empty() || !doubt) return;
    note(text(*doubt));
    const std::string title = *doubt->unit.name != '\0' ? std::string("Use ") + doubt->unit.name
                                                        : "Make it " + fixed_text(doubt->then, 2) + " m tall";
    if (row_button(title.c_str(), 1, true, "Corrects the file's unit"))
        panel.emit("humanoid.scale", {{"metres", doubt->unit.metres}});
    end_row();
}

void kept_map_rows(const HumanoidPanel& panel) {
    KeptMaps& maps = panel.runtime.kept_maps;
    if (const std::string& why = maps.refused(panel.workspace); !why.empty()) note(why + '.');
    const SavedMap* const map = maps.offered(panel.workspace);
    if (map == nullptr) return;
    const std::vector<humanoid::Bone> bones = bones_that_differ(*map, panel.part);
    note("A bone map that you kept for these node names differs in " + count_text(bones.size(), "bone") +
         ": " + name_list_text(names(bones, [](humanoid::Bone each) { return humanoid::name(each); })) + '.');
    if (row_button("Use it", 2, true, "Maps the bones as in the kept map")) panel.emit("humanoid.map.use");
    if (row_button("Forget it", 2, true, "It will not be offered again")) panel.emit("humanoid.map.forget");
    end_row();
}

void loaded_rows(const HumanoidPanel& panel, MoreRows& more) {
    const LoadedCharacter& loaded = *panel.part.loaded;
    std::string file = loaded.file;
    const bool entered = loaded.file.empty()
                             ? path_field("file", file, "or drop one", "humanoid.load", panel.emit)
                             : text_field("file", file, "");
    if (entered && file != loaded.file) panel.emit("file.open", {{"path", file}, {"ask", true}});
    explain("A character with its clips: .gltf, .glb, .vrm, .vrma, .fbx or .bvh. Enter reads it.");
    progress_row(panel, "humanoid.load");
    if (!loaded.file.empty()) {
        if (row_button("Browse", 2, true, "Chooses a character or a motion"))
            panel.emit("scene.open_dialog", {{"by", "humanoid.load"}});
        if (row_button("Stick figure", 2, true, "Goes back to the built-in figure"))
            panel.emit("humanoid.load");
        end_row();
    }
    unit_rows(panel);
    kept_map_rows(panel);
    more.add("height", {"humanoid.scale", {"metres"}}, false, [&panel, &loaded] {
        scale_row(panel);
        reading("height", "%.2f m", loaded.height());
    });
    const FileSpace& space = loaded.character.space;
    if (!loaded.file.empty()) FieldRows(space, "humanoid.up", panel.emit).under(more).row("axis");
    if (!loaded.character.root_offsets.empty())
        FieldRows(space, "humanoid.root", panel.emit).under(more).row("positions");
    more.add("rest pose", {"humanoid.t_pose", {"on"}}, panel.part.t_pose, [&panel] { rest_row(panel); });
    for (const std::string& each : loaded.character.sentences()) note(each);
}

/// Rows for a clip that walks in place.
void pace_rows(const HumanoidPanel& panel) {
    // Seconds. A walk in place is a cycle, and a long clip is slow to measure.
    constexpr double longest = 20.0;
    const Playback& playback = panel.part.playback;
    const humanoid::Clip* const clip = panel.part.clip();
    if (clip == nullptr || clip->duration > longest) return;
    const Solvers::Gait* const gait = panel.runtime.solvers.gait(panel.part);
    if (gait == nullptr || gait->pace == glm::dvec3(0.0)) return;
    note("The clip was recorded in place.");
    const std::string title = "Travel at " + fixed_text(glm::length(gait->pace), 1) + " m/s";
    if (row_option(title.c_str(), 1, playback.travel,
                   "Moves the figure at the speed of its standing foot, so that it can climb stairs"))
        panel.emit("humanoid.clip", {{"travel", !playback.travel}});
    end_row();
}

void playback_rows(const HumanoidPanel& panel, MoreRows& more) {
    const std::vector<humanoid::Clip>& clips = panel.part.loaded->clips();
    const Playback& playback = panel.part.playback;
    if (clips.empty()) note("The character has no clips.");
    const std::string shown = playback.clip ? clips[*playback.clip].name : "none";
    if (begin_list("clip", &shown, {.after = field_button_width("Load")})) {
        if (list_row("none (rest pose)", !playback.clip)) panel.emit("humanoid.clip", {{"name", ""}});
        for (std::size_t i = 0; i < clips.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (list_row(clips[i].name, playback.clip == i))
                panel.emit("humanoid.clip", {{"index", i}, {"play", true}});
            ImGui::PopID();
        }
        end_list();
    }
    if (field_button("Load", "clip")) panel.emit("scene.open_dialog", {{"by", "humanoid.motion.load"}});
    explain(
        "The motion to play. Type part of a name to find one. Load takes a motion of another character from "
        "a file: it is retargeted through the two bone maps, and feet stand where the other's do.");
    motion_note(panel);
    FieldRows(playback, "humanoid.clip", panel.emit)
        .under(more)
        .rows("speed", "loop", "in_place", "travel", "targets_travel");
    pace_rows(panel);
}

}  // namespace

HumanoidPanel humanoid_panel(const Workspace& workspace, Emit& emit) {
    return {workspace, humanoid_part(workspace), humanoid_runtime(workspace),
            palette(workspace.settings.theme), emit};
}

void character_rows(const HumanoidPanel& panel) {
    folding_section(panel.workspace, "Character", panel.emit, true,
                    [&](MoreRows& more) { loaded_rows(panel, more); });
}

void clip_rows(const HumanoidPanel& panel) {
    folding_section(panel.workspace, "Clip", panel.emit, true,
                    [&](MoreRows& more) { playback_rows(panel, more); });
}

void look_rows(const HumanoidPanel& panel) {
    folding_section(panel.workspace, "View", panel.emit, false, [&](MoreRows& more) {
        const FieldRows view = FieldRows(panel.part.view, "humanoid.view", panel.emit).under(more);
        view.row("follow");
        if (panel.part.loaded->character.skin.mesh) view.rows("skin", "skinning");
        view.rows("limits", "ghost");
        past_rows(panel.workspace, humanoid_past(), panel.emit);
        FieldRows(panel.part.flips, "humanoid.flips", panel.emit).under(more).all();
    });
}

void HumanoidLab::panel(const Workspace& workspace, Emit& emit) const {
    const HumanoidPanel panel = humanoid_panel(workspace, emit);
    bool& incomplete = panel.runtime.panel.bones_first;
    SharedCharacter& decided = panel.runtime.panel.bones_of;
    // Sections keep their order while the mouse is in the panel, unless the character changed.
    if (row_search() == nullptr &&
        (decided != panel.part.loaded ||
         !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows | ImGuiHoveredFlags_AllowWhenBlockedByPopup |
                                 ImGuiHoveredFlags_AllowWhenBlockedByActiveItem))) {
        incomplete = panel.runtime.solvers.body(panel.part) == nullptr;
        // Do not let this character's export overwrite the last one's.
        if (decided && decided->path != panel.part.loaded->path) panel.runtime.panel.export_to.clear();
        decided = panel.part.loaded;
    }
    if (incomplete) bone_rows(panel, true);  // nothing else works without it
    character_rows(panel);
    clip_rows(panel);
    lint_rows(panel);
    target_rows(panel);
    hand_rows(panel);
    ground_rows(panel);
    if (const FoldingSection open(workspace, "Curves and springs", emit, false); open) {
        curve_rows(panel);
        spring_rows(panel);
    }
    attachment_rows(panel);
    look_rows(panel);
    export_rows(panel);
    if (!incomplete) bone_rows(panel, false);
}

// Sections of the right panel: the selection, and the character in numbers.

namespace {

void text_row(const char* name, const std::string& value) {
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(name).x - ImGui::GetFontSize();
    reading(name, "%s", elided(value, free).c_str());
    explain(value.c_str());
}

void position_rows(const glm::dvec3& at) {
    reading("x", "%.4f m", at.x);
    reading("y", "%.4f m", at.y);
    reading("z", "%.4f m", at.z);
}

/// The distances from effectors to their targets.
void target_inspector(const HumanoidPanel& panel) {
    if (!panel.part.ik.has_targets()) return;
    const PanelSection ids("Targets");
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    if (!shown.refused.empty()) return note(shown.refused);
    for (const humanoid::Effector effector : all_effectors) {
        if (!panel.part.ik.target(effector)) continue;
        reading(title(effector).c_str(), "%s", length_text(shown.residual(effector).value_or(0.0)).c_str());
        explain("How far the effector is from its target.");
    }
    if (!shown.body) return;
    const std::string limited =
        name_list_text(bone_names([&](std::size_t i) { return shown.body->at_limit[i]; }));
    kept_note("limited", limited.empty() ? "No joint is at its limit." : "At their limits: " + limited + ".",
              3);
}

/// The selected nodes.
void node_inspector(const HumanoidPanel& panel) {
    const PanelSection ids("Selection");
    const HumanoidPart& part = panel.part;
    const auto node = part.selection.active();
    if (!node) return note("Nothing is selected.");
    const std::string& name = part.skeleton()[*node].name;
    if (part.selection.several()) {
        reading("nodes", "%zu", part.selection.all().size());
        note(name_list_text(names_of(part.selection, part.skeleton())));
        note("Showing " + name + ".");
    }
    text_row("node", name);
    const auto bone = part.bone_of(*node);
    text_row("bone", bone ? humanoid::name(*bone) : "none");
    const std::int32_t parent = part.skeleton()[*node].parent;
    text_row("parent", parent < 0 ? "none" : part.skeleton()[static_cast<std::size_t>(parent)].name);
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    position_rows(shown.placed[*node].position);
    if (!shown.before.empty())
        reading(
            "moved from the clip", "%s",
            length_text(glm::distance(shown.placed[*node].position, shown.before[*node].position)).c_str());
    curve_inspector(panel);
    spring_inspector(panel);
}

/// Statistics of the character.
void character_inspector(const HumanoidPanel& panel) {
    const PanelSection ids("Character");
    const LoadedCharacter& loaded = *panel.part.loaded;
    text_row("from",
             loaded.file.empty() ? "built in" : std::filesystem::path(loaded.file).filename().string());
    reading("nodes", "%zu", loaded.skeleton().size());
    reading("clips", "%zu", loaded.clips().size());
    if (const humanoid::Clip* clip = panel.part.clip()) {
        const PanelSection of_clip("Clip");
        text_row("name", clip->name);
        const bool paused = panel.part.playback.playing && !panel.workspace.clock.playing;
        reading(paused ? "time, paused" : "time", "%.2f of %.2f s", panel.part.playback.time, clip->duration);
        if (paused) explain("Space plays it.");
        if (panel.part.playback.rounds > 0)
            reading("round", "%lld", static_cast<long long>(panel.part.playback.rounds + 1));
    }
}

}  // namespace

void HumanoidLab::inspector(const Workspace& workspace, Emit& emit) const {
    const HumanoidPanel panel = humanoid_panel(workspace, emit);
    show_verdict(humanoid_verdict(workspace), panel.colours, emit);
    const bool selected = !panel.part.selection.empty();
    if (selected) node_inspector(panel);  // the clicked item comes first
    limit_inspector(panel);
    target_inspector(panel);
    character_inspector(panel);
    if (!selected) node_inspector(panel);
    incident_rows(workspace, panel.colours, emit);
}

// The bone map: a row per bone with its node and a bar for the confidence of the match. A clicked row waits
// for a node, from the list or from a click on the figure.

namespace {

using humanoid::Bone;

const std::string& node_name(const HumanoidPart& part, std::int32_t node) {
    return part.skeleton()[static_cast<std::size_t>(node)].name;
}

const char* sureness(double confidence) {
    return confidence >= 0.8 ? "sure" : confidence >= 0.5 ? "likely" : "doubtful";
}

/// The length is the confidence; the colour makes doubtful matches stand out.
void confidence_bar(const HumanoidPanel& panel, double confidence, ImVec2 at, float width, float height) {
    ImDrawList* const list = ImGui::GetWindowDrawList();
    list->AddRectFilled(at, {at.x + width, at.y + height}, imgui_u32(panel.colours.field), 1.5f);
    const glm::vec3 colour = confidence >= 0.8   ? panel.colours.tail
                             : confidence >= 0.5 ? panel.colours.selection
                                                 : panel.colours.limit;
    list->AddRectFilled(at, {at.x + width * static_cast<float>(confidence), at.y + height}, imgui_u32(colour),
                        1.5f);
}

void bone_tooltip(const HumanoidPart& part, Bone bone) {
    const humanoid::BoneMatch& match = (*part.map)[bone];
    std::string text = humanoid::name(bone);
    if (match.node >= 0)
        text += ": " + node_name(part, match.node) + "\n" + sureness(match.confidence) + ", " +
                fixed_text(100.0 * match.confidence, 0) + " %";
    else
        text += humanoid::is_needed(bone) ? ": missing; full-body IK needs it" : ": none; not required";
    if (!match.reasons.empty()) text += "\n" + match.reasons;
    tooltip(text);
}

void bone_row(const HumanoidPanel& panel, Bone bone) {
    const humanoid::BoneMatch& match = (*panel.part.map)[bone];
    auto& waiting = panel.runtime.panel.bone;
    const float em = ImGui::GetFontSize(), line = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos(), at = ImGui::GetCursorPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(static_cast<int>(bone));
    if (match.node >= 0 && panel.part.selection.has(static_cast<std::size_t>(match.node))) {
        const bool active = panel.part.selection.active() == static_cast<std::size_t>(match.node);
        ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + width, corner.y + line},
                                                  imgui_u32(panel.colours.selection, active ? 0.45f : 0.22f),
                                                  3.0f);
    }
    if (ImGui::Selectable("##row", waiting == bone, 0, {width, line})) {
        const bool more = ImGui::GetIO().KeyShift;
        if (!more) waiting = waiting == bone ? std::nullopt : std::optional(bone);
        if (match.node >= 0 && (more || waiting))
            panel.emit("humanoid.select", {{"node", node_name(panel.part, match.node)}, {"add", more}});
    }
    if (ImGui::IsItemHovered()) bone_tooltip(panel.part, bone);
    ImGui::PopID();
    const float bar = 2.0f * em, names = 7.2f * em;
    ImGui::SetCursorPos(at);
    ImGui::TextUnformatted(elided(humanoid::name(bone), std::min(names, width)).c_str());
    if (match.node >= 0) {
        ImGui::SetCursorPos({at.x + names, at.y});
        const std::string node = elided(node_name(panel.part, match.node), width - names - bar - 0.5f * em);
        // Dim text would be lost on the colour of a selected row.
        if (panel.part.selection.has(static_cast<std::size_t>(match.node)))
            ImGui::TextUnformatted(node.c_str());
        else
            ImGui::TextDisabled("%s", node.c_str());
        confidence_bar(panel, match.confidence, {corner.x + width - bar, corner.y + 0.35f * line}, bar,
                       0.35f * line);
    } else {
        const bool needed = humanoid::is_needed(bone);
        ImGui::SetCursorPos({at.x + names, at.y});
        ImGui::PushStyleColor(ImGuiCol_Text,
                              imgui_u32(needed ? panel.colours.limit : panel.colours.text_dim));
        ImGui::TextUnformatted(needed ? "missing" : "none");
        ImGui::PopStyleColor();
    }
}

/// A list of all nodes for the waiting row. Always present, so that nothing below it moves.
void node_chooser(const HumanoidPanel& panel) {
    auto& waiting = panel.runtime.panel.bone;
    ImGui::BeginDisabled(!waiting);
    const std::int32_t now = waiting ? (*panel.part.map)[*waiting].node : -1;
    const std::string shown = !waiting ? "click a bone" : now < 0 ? "none" : node_name(panel.part, now);
    if (begin_list("node", &shown)) {
        std::optional<std::int32_t> picked;
        if (list_row("none", now < 0)) picked = -1;
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(panel.part.skeleton().size()); ++i)
            if (list_row(node_name(panel.part, i), now == i)) picked = i;
        if (picked) map_waiting_bone(panel.part, waiting, *picked, panel.emit);
        end_list();
    }
    ImGui::EndDisabled();
    explain("The node that the chosen bone is mapped to. Type part of its name to find it.");
}

}  // namespace

void bone_rows(const HumanoidPanel& panel, bool open_at_first) {
    const FoldingSection open(panel.workspace, "Bones", panel.emit, open_at_first);
    if (!open) return;
    node_chooser(panel);
    const auto& waiting = panel.runtime.panel.bone;
    kept_note("how to map",
              waiting ? std::string(humanoid::name(*waiting)) +
                            ": click its node in the figure, or pick it from the list."
                      : "To map a bone, click its row, then a node of the figure.",
              2);
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) bone_row(panel, static_cast<Bone>(i));
    map_rows(panel);
    // The note is below the rows, so that they stay in place when it appears.
    const std::string& why = panel.runtime.solvers.why_no_body(panel.part);
    if (!why.empty()) coloured_note("Full-body IK is off: " + why + ".", panel.colours.limit);
}

void map_waiting_bone(const HumanoidPart& part, std::optional<humanoid::Bone>& waiting, std::int32_t node,
                      Emit& emit) {
    const Bone bone = *waiting;
    const std::int32_t before = (*part.map)[bone].node;
    const std::string name = node < 0 ? std::string() : node_name(part, node);
    if (node != before) emit("humanoid.map", {{"bone", humanoid::name(bone)}, {"node", name}});
    if (node >= 0 && (part.selection.active() != static_cast<std::size_t>(node) || part.selection.several()))
        emit("humanoid.select", {{"node", name}});
    waiting.reset();
    if (before >= 0 || node < 0) return;  // for a correction, only that bone was meant
    for (std::size_t i = 1; i < humanoid::bone_count && !waiting; ++i) {
        const auto next = static_cast<Bone>((static_cast<std::size_t>(bone) + i) % humanoid::bone_count);
        const std::int32_t its = (*part.map)[next].node;
        if (its < 0 || its == node) waiting = next;
    }
}

Verdict humanoid_verdict(const Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    if (runtime.solvers.body(part) == nullptr)
        return {"Incomplete body", Verdict::Kind::Bad, runtime.solvers.why_no_body(part) + '.'};
    for (const Attachment& each : part.attachments.list)
        if (const std::size_t torn = torn_edges(part.attachments, each); torn > 0)
            return {'"' + each.name + "\" is torn at " + count_text(torn, "edge"), Verdict::Kind::Bad,
                    "It is stuck in the body. Remove it and attach it again."};
    const auto mapped =
        std::ranges::count_if(part.map->bones, [](const auto& each) { return each.node >= 0; });
    const bool all = mapped == static_cast<std::ptrdiff_t>(humanoid::bone_count);
    const std::string bones =
        std::to_string(mapped) + " of " + std::to_string(humanoid::bone_count) + " bones mapped";
    const ShownPose& shown = runtime.shown(workspace);
    double worst = -1.0;
    for (const humanoid::Effector effector : all_effectors)
        if (part.ik.target(effector)) worst = std::max(worst, shown.residual(effector).value_or(-1.0));
    if (const auto deepest = foot_in_ground(shown); deepest && worst < 1e-3)
        return {std::string(deepest->side == 0 ? "Left" : "Right") + " foot " +
                    fixed_text(1000.0 * deepest->depth, 0) + " mm in the ground",
                Verdict::Kind::Bad, why_in_ground(part, *deepest)};
    if (shown.hold && worst < 1e-3) return hold_verdict(*part.ik.hold, *shown.hold);
    if (worst < 0.0 && all) return {"Complete body", Verdict::Kind::Good, bones + '.'};
    if (worst < 0.0)
        return {"Usable body", Verdict::Kind::Good,
                bones + "; optional ones missing: " + comma_list(part.unmapped()) + '.'};
    if (worst < 1e-3) return {"Reached", Verdict::Kind::Good, bones + '.'};
    const std::string off = worst < 0.1 ? fixed_text(1000.0 * worst, 1) + " mm" : fixed_text(worst, 2) + " m";
    return {off + " short", Verdict::Kind::Bad, bones + '.'};
}

}  // namespace tendril::app
