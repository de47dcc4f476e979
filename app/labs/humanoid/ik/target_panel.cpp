// The panel's rows of what the body reaches for.
#include <imgui.h>

#include "app/document/json_complete.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

void effector_row(const HumanoidPanel& panel, humanoid::Effector effector) {
    const auto& target = panel.part.ik.target(effector);
    const std::string name = title(effector);
    bool on = target.has_value();
    if (!on) {
        if (ImGui::Checkbox(name.c_str(), &on))
            panel.emit("humanoid.target", {{"effector", humanoid::name(effector)}});
        explain("Gives it a target where it is now. To drag its orange ball does so too.");
        return;
    }
    const std::string id = "##" + name;
    if (ImGui::Checkbox(id.c_str(), &on))
        panel.emit("humanoid.target", {{"effector", humanoid::name(effector)}, {"weight", 0}});
    explain("Lets it go.");
    ImGui::SameLine();
    auto weight = static_cast<float>(target->weight);
    if (number_field(name.c_str(), weight, 0.01f, 0.01f, static_cast<float>(heaviest_target), "%.2f"))
        panel.emit.continuously("humanoid.target",
                                {{"effector", humanoid::name(effector)}, {"weight", weight}});
    explain("Its weight against other targets: where they disagree, the heavier one is nearer.");
}

}  // namespace

void target_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Targets", panel.emit)) return;
    const std::string& why = panel.runtime.solvers.why_no_body(panel.part);
    if (!why.empty()) return note("The body solve is off: " + why + ".");
    for (const humanoid::Effector effector : all_effectors) effector_row(panel, effector);
    const IkSettings& ik = panel.part.ik;
    if (row_button("Let all go", 1, ik.has_targets(), "No effector has a target then")) {
        Json all = Json::array();
        for (const humanoid::Effector effector : all_effectors)
            if (ik.target(effector)) all.push_back(humanoid::name(effector));
        panel.emit("humanoid.target", {{"effectors", SharedJson(std::move(all))}, {"weight", 0}});
    }
    end_row();
    bool apart = ik.self_collision;
    if (ImGui::Checkbox("Self-collision", &apart)) panel.emit("humanoid.self_collision", {{"on", apart}});
    explain(
        "Hands and lower arms do not pass through the body; its outlines show what they keep out of, fitted "
        "to the "
        "skin where the character has one.");
    limit_rows(panel);
}

}  // namespace tendril::app
