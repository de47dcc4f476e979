#include "app/labs/humanoid/humanoid_lab.hpp"

#include <glm/trigonometric.hpp>

#include "app/io/character/map_file.hpp"
#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/springs/springs.hpp"

namespace tendril::app {
CameraPose HumanoidLab::first_view() const {
    return {.target = {0.0f, 0.92f, 0.0f},
            .yaw = glm::radians(28.0f),
            .pitch = glm::radians(9.0f),
            .distance = 3.6f};
}

void HumanoidLab::add_commands(CommandTable& table) const {
    CommandTable own;
    add_character_commands(own);
    add_clip_commands(own);
    add_motion_commands(own);
    add_ik_commands(own);
    add_spring_commands(own);
    add_bone_curve_commands(own);
    add_attachment_commands(own);
    add_humanoid_look_commands(own);
    add_humanoid_file_commands(own);
    for (Command command : own.all()) table.add(carrying(std::move(command)));
}

bool HumanoidLab::moving(const Workspace& workspace) const {
    const HumanoidPart& part = humanoid_part(workspace);
    constexpr int until_rest = 120;
    const bool eases = part.ik.look_at.on || (part.ik.hand_ik.on && part.ik.has_targets());
    const bool steps =
        part.ik.balance.body.balance && part.ik.balance.steps && body_acts(part, part.ik_state);
    const bool swings = !part.springs.empty() || !part.attachments.list.empty();
    return goes_on(part.playback, *part.loaded) || part.ik_state.release.left > 0.0 ||
           ((eases || steps || swings) && part.quiet_ticks < until_rest);
}

void HumanoidLab::step(Workspace& workspace) const {
    const bool modified = workspace.modified();
    const glm::vec3 before = followed_at(workspace);
    HumanoidPart& part = workspace.document.edit<HumanoidPart>(humanoid_lab);
    const double seconds = tick_seconds * static_cast<double>(workspace.clock.speed);
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const bool quiet = !part.ik_state.steps.stepping() && !goes_on(part.playback, *part.loaded) &&
                       at_rest(part.attachments) && at_rest(part.ik_state.springs);
    part.quiet_ticks = quiet ? part.quiet_ticks + 1 : 0;
    const Playback playback = part.playback;
    advance(part.playback, *part.loaded, seconds);
    carry_targets(part, playback);
    const ShownPose shown = solve_pose(part, runtime.solvers, seconds, part.ik_state);
    advance(part.attachments, wearer_of(part, runtime.solvers, shown), runtime.ropes, seconds);
    workspace.camera.target += followed_at(workspace) - before;
    if (!modified) workspace.saved = workspace.document;  // playing does not modify the scene
}

std::string HumanoidLab::code(const Workspace& workspace) const {
    return humanoid_code(humanoid_part(workspace), humanoid_runtime(workspace).solvers);
}

bool HumanoidLab::working(const Workspace& workspace) const {
    return humanoid_runtime(workspace).loading.running() || past_plot_waits(workspace, humanoid_past());
}

void HumanoidLab::work(Workspace& workspace) const {
    if (!humanoid_runtime(workspace).loading.done()) return;
    try {
        finish_loading(workspace);
    } catch (const Refused& refusal) {
        workspace.toast(refusal.what(), ToastKind::Refusal);
    }
}

std::vector<FileKind> HumanoidLab::files() const {
    return {{"characters", {".gltf", ".glb", ".vrm", ".fbx"}, "humanoid.load"},
            {"motions", {".bvh", ".vrma"}, "humanoid.load"},
            {"bone maps", {".json"}, "humanoid.map.load", {}, begins_map}};
}

/// Up the stairs, in a cape. Continues when the user takes over: it does not get in the way.
std::vector<CommandCall> HumanoidLab::opening() const {
    return {{"humanoid.view", {{"skin", "solid"}, {"ghost", false}}},
            {"humanoid.attach", {{"bone", "UpperChest"}, {"kind", "cloth"}, {"name", "cape"}}},
            {"humanoid.ground", {{"kind", "stairs"}, {"step_height", 0.16}, {"step_depth", 0.4}}},
            {"humanoid.foot_ik", {{"on", true}}},
            {"humanoid.clip", {{"name", "walk"}, {"play", true}}},
            {"camera.set",
             {{"target", glm::vec3(0.0f, 0.95f, 0.0f)},
              {"yaw_deg", 112.0f},
              {"pitch_deg", 12.0f},
              {"distance", 3.9f}}}};
}

}  // namespace tendril::app
