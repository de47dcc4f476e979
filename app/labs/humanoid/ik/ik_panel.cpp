// The panel's rows about IK: targets, hands, gaze, ground and feet.
#include <imgui.h>

#include "app/fields/field_rows.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

void effector_row(const HumanoidPanel& panel, humanoid::Effector effector) {
    const auto& target = panel.part.ik.target(effector);
    const std::string name = title(effector);
    bool on = target.has_value();
    if (holds(panel.part, effector)) {
        reading(name.c_str(), "holds the %s", held_kinds.title(panel.part.ik.hold->kind));
        return;
    }
    if (!on) {
        if (ImGui::Checkbox(name.c_str(), &on))
            panel.emit("humanoid.target", {{"effector", humanoid::name(effector)}});
        explain("Gives it a target at its present position. Dragging its orange ball does the same.");
        return;
    }
    const std::string id = "##has " + name;  // the field beside it has the name
    if (ImGui::Checkbox(id.c_str(), &on))
        panel.emit("humanoid.target", {{"effector", humanoid::name(effector)}, {"weight", 0}});
    explain("Removes the target.");
    ImGui::SameLine();
    auto weight = static_cast<float>(target->weight);
    const auto most = static_cast<float>(field_of<&humanoid::BodyTarget::weight>().range.high);
    if (number_field(name.c_str(), weight, 0.01f, 0.01f, most, "%.2f"))
        panel.emit.continuously("humanoid.target",
                                {{"effector", humanoid::name(effector)}, {"weight", weight}});
    explain("Where targets conflict, the one with more weight gets closer.");
}

void balance_rows(const HumanoidPanel& panel, MoreRows& more) {
    const BalanceSetting& balance = panel.part.ik.balance;
    const FieldRows rows = FieldRows(balance, "humanoid.balance", panel.emit).under(more);
    const bool possible = balance.body.balance || panel.runtime.solvers.masses(panel.part) != nullptr;
    rows.row("on", {.why_not = possible ? std::string()
                                        : "Balance is not possible: " +
                                              panel.runtime.solvers.why_no_feet(panel.part) + "."});
    if (const ShownPose& shown = panel.runtime.shown(panel.workspace); shown.balance) {
        reading("centre of mass", "%s", balance_text(panel.part, shown, panel.runtime.solvers).c_str());
        const std::string why = why_no_balance(panel.part, shown, panel.runtime.solvers);
        if (!why.empty()) note(why);
    }
    if (balance.body.balance) rows.rows("reserve", "steps", "step_seconds");
}

void body_rows(const HumanoidPanel& panel, MoreRows& more) {
    const std::string& why = panel.runtime.solvers.why_no_body(panel.part);
    if (!why.empty()) return note("Full-body IK is off: " + why + ".");
    for (const humanoid::Effector effector : all_effectors) effector_row(panel, effector);
    const IkSettings& ik = panel.part.ik;
    if (row_button("Remove all targets", 1, ik.has_targets(), "Removes the targets of all effectors")) {
        Json all = Json::array();
        for (const humanoid::Effector effector : all_effectors)
            if (ik.target(effector)) all.push_back(humanoid::name(effector));
        panel.emit("humanoid.target", {{"effectors", SharedJson(std::move(all))}, {"weight", 0}});
    }
    end_row();
    bool apart = ik.self_collision;
    if (ImGui::Checkbox("Self-collision", &apart)) panel.emit("humanoid.self_collision", {{"on", apart}});
    explain(
        "Keeps hands and forearms from passing through the body. Outlines show the body's volume, fitted to "
        "the skin if there is one.");
    balance_rows(panel, more);
    limit_rows(panel);
}

}  // namespace

void target_rows(const HumanoidPanel& panel) {
    folding_section(panel.workspace, "Targets", panel.emit, false,
                    [&](MoreRows& more) { body_rows(panel, more); });
}

// Hands moved by a clip, and the look-at target.

namespace {

void hand_row(const HumanoidPanel& panel, std::size_t hand) {
    const humanoid::BodyTarget* const target = panel.part.ik.hand_target(hand);
    if (target == nullptr) return;
    const std::optional<HandCurve>& curve = panel.part.ik.hand_ik.curves[hand];
    bool timed = curve.has_value();
    const std::string side = side_name(hand), title = "Weight over the clip, " + side;
    if (ImGui::Checkbox(title.c_str(), &timed))
        panel.emit("humanoid.hand_ik", {{"hand", side}, {"curve", timed}});
    explain("The hand goes to its target and back as the clip plays.");
    ImGui::PushID(side.c_str());
    if (curve) FieldRows(*curve, "humanoid.hand_ik", panel.emit, {{"hand", side}}).all();
    ImGui::PopID();
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    if (!shown.hands) return;
    const humanoid::HandReport& report = shown.hands->hands[hand];
    reading((side + " weight").c_str(), "%.2f%s", report.weight, report.in_view ? "" : ", out of view");
}

}  // namespace

void hand_rows(const HumanoidPanel& panel) {
    const FoldingSection open(panel.workspace, "Hands and gaze", panel.emit, false);
    if (!open) return;
    hold_rows(panel);
    const IkSettings& ik = panel.part.ik;
    const bool body = panel.runtime.solvers.body(panel.part) != nullptr;
    const std::string no_body = "Full-body IK is off: " + panel.runtime.solvers.why_no_body(panel.part) + ".";
    const FieldRows hands(ik.hand_ik, "humanoid.hand_ik", panel.emit);
    hands.row("on", {.why_not = ik.hand_ik.on || body ? std::string() : no_body});
    if (ik.hand_ik.on) {
        hands.row("view");
        for (std::size_t hand = 0; hand < 2; ++hand) hand_row(panel, hand);
        if (ik.hand_target(0) == nullptr && ik.hand_target(1) == nullptr)
            note("Drag the orange ball of a hand.");
    }
    const FieldRows gaze(ik.look_at, "humanoid.look_at", panel.emit);
    gaze.row("on", {.why_not = ik.look_at.on || body ? std::string() : no_body});
    if (!ik.look_at.on) return;
    gaze.rows("weight", "view");
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    const bool out_of_view = shown.look && !shown.look->in_view;
    kept_note("out of view", out_of_view ? "The target is outside the cone of view." : "", 1);
}

// The ground, and the feet on it.

namespace {

using humanoid::GroundKind;

void shape_rows(const HumanoidPanel& panel) {
    const GroundSetting& ground = panel.part.ik.ground;
    const FieldRows rows(ground, "humanoid.ground", panel.emit);
    if (ground.kind == GroundKind::Slope) rows.row("angle_deg");
    if (ground.kind == GroundKind::Stairs) rows.rows("step_height", "step_depth");
}

/// A foot's state, or why it follows the clip.
void foot_row(const HumanoidPanel& panel, std::size_t side) {
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    if (!shown.feet) return;
    const std::string alone = why_alone(panel.part, shown, side);
    reading(side == 0 ? "left foot" : "right foot", "%s",
            !alone.empty()                   ? "follows the clip"
            : shown.feet->feet[side].planted ? "planted"
                                             : "in the air");
    if (!alone.empty()) note("Not planted: " + alone + ".");
}

void standing_rows(const HumanoidPanel& panel, MoreRows& more) {
    const IkSettings& ik = panel.part.ik;
    RowOptions kinds{.why_not_choices = std::vector<const char*>(std::size(ground_kinds.rows))};
    if (!ik.ground.mesh) kinds.why_not_choices.back() = "type its path under More";
    FieldRows(ik.ground, "humanoid.ground", panel.emit).row("kind", kinds);
    more.add("mesh file", {"humanoid.ground", {"path"}}, ik.ground.mesh != nullptr, [&panel, &ik] {
        std::string path = ik.ground.mesh ? ik.ground.mesh->path : std::string();
        if (path_field("mesh file", path, ".gltf, .glb", "humanoid.ground", panel.emit) && !path.empty())
            panel.emit("humanoid.ground", {{"kind", "mesh"}, {"path", path}});
        explain("A file whose triangles become the ground. Enter loads it.");
    });
    shape_rows(panel);
    const FootIkSetting& feet = ik.foot_ik;
    const FieldRows rows = FieldRows(feet, "humanoid.foot_ik", panel.emit).under(more);
    const std::string& why = panel.runtime.solvers.why_no_feet(panel.part);
    const bool none = !feet.on && !why.empty();
    rows.row("on", {.why_not = none ? "Foot IK is not possible: " + why + "." : ""});
    if (!feet.on) return;  // the greyed switch says why
    if (!why.empty()) return note("Foot IK is not possible: " + why + ".");
    rows.row("max_angle");
    rows.rows("enter_speed", "leave_speed");
    for (std::size_t side = 0; side < 2; ++side) foot_row(panel, side);
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    std::string why_up;
    for (std::size_t side = 0; side < 2 && why_up.empty(); ++side)
        why_up = why_in_air(panel.part, shown, panel.runtime.solvers, side);
    kept_note("why in the air", why_up, 2);
}

}  // namespace

void ground_rows(const HumanoidPanel& panel) {
    folding_section(panel.workspace, "Ground and feet", panel.emit, true,
                    [&](MoreRows& more) { standing_rows(panel, more); });
}

}  // namespace tendril::app
