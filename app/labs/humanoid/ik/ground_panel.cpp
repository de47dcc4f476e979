// The panel's rows of the ground, and of the feet on it.
#include <imgui.h>

#include <array>

#include "app/labs/humanoid/panels.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

using humanoid::GroundKind;

void shape_rows(const HumanoidPanel& panel) {
    const GroundSetting& ground = panel.part.ik.ground;
    const auto set = [&](const char* argument, float value) {
        panel.emit.continuously("humanoid.ground", {{argument, value}});
    };
    if (ground.kind == GroundKind::Slope) {
        auto angle = static_cast<float>(ground.angle_deg);
        if (number_field("angle", angle, 0.1f, static_cast<float>(-steepest_deg),
                         static_cast<float>(steepest_deg), "%.1f\xC2\xB0"))
            set("angle_deg", angle);
        explain("Of the slope, which rises along +Z from 0 on.");
    }
    if (ground.kind != GroundKind::Stairs) return;
    auto height = static_cast<float>(100.0 * ground.step_height),
         depth = static_cast<float>(100.0 * ground.step_depth);
    if (number_field("step height", height, 0.1f, -200.0f, 200.0f, "%.1f cm"))
        set("step_height", 0.01f * height);
    explain("How high each stair rises above the one before; stairs go down where it is negative.");
    if (number_field("step depth", depth, 0.1f, 5.0f, 1000.0f, "%.1f cm")) set("step_depth", 0.01f * depth);
    explain("How long each stair is, along +Z.");
}

/// What each foot does, or why it is left alone.
void foot_row(const HumanoidPanel& panel, std::size_t side) {
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    if (!shown.feet) return;
    const std::string alone = why_alone(panel.part, shown, side);
    reading(side == 0 ? "left foot" : "right foot", "%s",
            !alone.empty()                   ? "follows the clip"
            : shown.feet->feet[side].planted ? "planted"
                                             : "in the air");
    if (!alone.empty()) note("Left alone: " + alone + ".");
}

}  // namespace

void ground_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Ground and feet", panel.emit)) return;
    const IkSettings& ik = panel.part.ik;
    int kind = static_cast<int>(ik.ground.kind);
    const auto titles = ground_kinds.titles();
    std::array<const char*, titles.size()> why_not{};
    if (!ik.ground.mesh) why_not.back() = "type its path below";
    if (choice_field("ground", kind, titles.data(), static_cast<int>(titles.size()), why_not.data()))
        panel.emit("humanoid.ground", {{"kind", ground_kinds.name(static_cast<GroundKind>(kind))}});
    explain(ground_kinds.help(ik.ground.kind));
    std::string path = ik.ground.mesh ? ik.ground.mesh->path : std::string();
    if (text_field("mesh file", path, "a .gltf or .glb file") && !path.empty())
        panel.emit("humanoid.ground", {{"kind", "mesh"}, {"path", path}});
    explain("A file whose triangles become the ground. Enter reads it.");
    shape_rows(panel);
    bool on = ik.foot_ik.on;
    const std::string& why = panel.runtime.solvers.why_no_feet(panel.part);
    ImGui::BeginDisabled(!on && !why.empty());
    if (ImGui::Checkbox("Foot IK", &on)) panel.emit("humanoid.foot_ik", {{"on", on}});
    ImGui::EndDisabled();
    explain("Feet are planted on the ground and turned by it, knees bend, hips ride its height.");
    if (!why.empty()) return note("The feet are left alone: " + why + ".");
    if (!ik.foot_ik.on) return;
    auto angle = static_cast<float>(ik.foot_ik.max_angle_deg);
    if (number_field("foot angle", angle, 0.1f, 0.0f, static_cast<float>(largest_foot_angle), "%.0f\xC2\xB0"))
        panel.emit.continuously("humanoid.foot_ik", {{"max_angle_deg", angle}});
    explain("The ground turns a foot by at most this.");
    auto enter = static_cast<float>(ik.foot_ik.enter_speed),
         leave = static_cast<float>(ik.foot_ik.leave_speed);
    if (number_field("plant under", enter, 0.01f, 0.0f, leave, "%.2f m/s"))
        panel.emit.continuously("humanoid.foot_ik", {{"enter_speed", enter}});
    explain("A foot that is low and slower than this is planted.");
    if (number_field("let go over", leave, 0.01f, enter, static_cast<float>(fastest_foot), "%.2f m/s"))
        panel.emit.continuously("humanoid.foot_ik", {{"leave_speed", leave}});
    explain("A planted foot that the clip moves faster than this is let go.");
    for (std::size_t side = 0; side < 2; ++side) foot_row(panel, side);
}

}  // namespace tendril::app
