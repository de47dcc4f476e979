// The panel's rows of springs on the character's own nodes.
#include <imgui.h>

#include <glm/trigonometric.hpp>

#include "app/labs/humanoid/panels.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

void spring_row(const HumanoidPanel& panel, std::size_t which) {
    const SpringSetting& each = panel.part.springs[which];
    ImGui::PushID(each.node.c_str());
    reading(each.node.c_str(), "%.0f\u00b0",
            glm::degrees(panel.runtime.shown(panel.workspace).springs[which].angle));
    explain("How far the bone that swings farthest is turned from the clip now.");
    if (row_button("Settings", 2, panel.part.selected != each.node, "Selects it: they are in the inspector"))
        panel.emit("humanoid.select", {{"node", each.node}});
    if (row_button("Remove", 2, true, "It follows the clip alone again"))
        panel.emit("humanoid.spring", {{"node", each.node}, {"on", false}});
    end_row();
    ImGui::PopID();
}

/// A chooser of the nodes that can have one.
void add_row(const HumanoidPanel& panel) {
    const std::string none = "choose a node";
    SearchText& typed = panel.runtime.panel.spring;
    if (!begin_search("add", &none, typed)) {
        explain("An ear, an antenna, a tail: the node that it begins with. All that hangs on it swings too.");
        return;
    }
    bool any = false;
    for (std::size_t i = 0; i < panel.part.skeleton().size(); ++i) {
        if (!why_no_spring(panel.part, i).empty()) continue;
        any = true;
        const std::string& name = panel.part.skeleton()[i].name;
        if (search_row(name, false, typed)) panel.emit("humanoid.spring", {{"node", name}});
    }
    if (!any) note("All of its nodes are bones of the body, or swing.");
    end_search();
}

}  // namespace

void spring_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Springs", panel.emit)) return;
    if (panel.part.springs.empty())
        note("Ears, antennae and tails that the file has trail behind the head or the hips.");
    for (std::size_t i = 0; i < panel.part.springs.size(); ++i) spring_row(panel, i);
    if (panel.part.springs.size() < most_springs) add_row(panel);
}

void spring_inspector(const HumanoidPanel& panel, std::size_t node) {
    const auto there = spring_on(panel.part, node);
    if (!there) {
        if (why_no_spring(panel.part, node).empty() && panel.part.springs.size() < most_springs &&
            row_button("Put on a spring", 1, true, "It and all that hangs on it trail behind the clip"))
            panel.emit("humanoid.spring", {{"node", panel.part.skeleton()[node].name}});
        end_row();
        return;
    }
    const SpringSetting& spring = panel.part.springs[*there];
    section(("Spring from " + spring.node + " on").c_str());
    const auto set = [&](const char* argument, float value) {
        panel.emit.continuously("humanoid.spring", {{"node", spring.node}, {argument, value}});
    };
    auto strength = static_cast<float>(spring.strength),
         damping = static_cast<float>(spring.critical_damping), weight = static_cast<float>(spring.weight),
         angle = static_cast<float>(spring.max_angle_deg);
    if (number_field("strength", strength, 0.02f, static_cast<float>(softest_spring), stiffest_spring,
                     "%.2f Hz"))
        set("strength", strength);
    explain("How often a second its tip would swing. The base is stiffer.");
    if (number_field("damping", damping, 0.005f, 0.0f, most_spring_damping, "%.2f"))
        set("critical_damping", damping);
    explain("0 swings for ever, 1 comes to rest without swinging past.");
    if (number_field("spring weight", weight, 0.01f, 0.0f, 1.0f, "%.2f")) set("weight", weight);
    explain("0: as in the clip. 1: the whole swing.");
    if (number_field("at most", angle, 0.5f, 0.0f, widest_swing_deg, "%.0f\u00b0"))
        set("max_angle_deg", angle);
    explain("By which a bone turns against the clip at most.");
    if (panel.runtime.solvers.springs(panel.part)[*there] == nullptr)
        note("The bone map has made one of its nodes a bone of the body: it follows the clip.");
}

}  // namespace tendril::app
