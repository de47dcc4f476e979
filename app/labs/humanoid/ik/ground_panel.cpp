// The panel's rows of the ground, and of the feet on it.
#include <imgui.h>

#include <array>

#include "app/fields/field_rows.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

using humanoid::GroundKind;

void shape_rows(const HumanoidPanel& panel) {
    const GroundSetting& ground = panel.part.ik.ground;
    const FieldRows rows(ground, "humanoid.ground", panel.emit);
    if (ground.kind == GroundKind::Slope) rows.row("angle_deg");
    if (ground.kind == GroundKind::Stairs) rows.rows("step_height", "step_depth");
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
    const FootIkSetting& feet = ik.foot_ik;
    const FieldRows rows(feet, "humanoid.foot_ik", panel.emit);
    const std::string& why = panel.runtime.solvers.why_no_feet(panel.part);
    const bool none = !feet.on && !why.empty();
    rows.row("on", {.why_not = none ? "The feet are left alone: " + why + "." : ""});
    if (!why.empty()) return note("The feet are left alone: " + why + ".");
    if (!feet.on) return;
    rows.row("max_angle_deg");
    rows.row("enter_speed", {.within = FieldRange{0.0, feet.leave_speed}});
    rows.row("leave_speed", {.within = FieldRange{feet.enter_speed, fastest_foot}});
    for (std::size_t side = 0; side < 2; ++side) foot_row(panel, side);
}

}  // namespace tendril::app
