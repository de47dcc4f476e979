// The panel's rows and the commands about springs on the character's own nodes.
#include <imgui.h>
#include <algorithm>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"
#include "app/fields/field_rows.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/lists.hpp"

namespace tendril::app {
namespace {

void spring_row(const HumanoidPanel& panel, std::size_t which) {
    const SpringSetting& each = panel.part.springs[which];
    ImGui::PushID(each.node.c_str());
    reading(each.node.c_str(), "%.0f\u00b0",
            glm::degrees(panel.runtime.shown(panel.workspace).springs[which].angle));
    explain("The largest angle between its bones and the clip now.");
    settings_row(panel, each.node, "humanoid.spring", "node", "Only the clip moves it again");
    ImGui::PopID();
}

/// A chooser of the nodes that can have a spring.
void add_row(const HumanoidPanel& panel) {
    const std::string none = "choose a node";
    if (!begin_list("add spring", &none)) {
        explain("The first node of an ear, an antenna or a tail. Everything below it swings too.");
        return;
    }
    bool any = false;
    for (std::size_t i = 0; i < panel.part.skeleton().size(); ++i) {
        if (!why_no_spring(panel.part, i).empty()) continue;
        any = true;
        const std::string& name = panel.part.skeleton()[i].name;
        if (list_row(name, false)) panel.emit("humanoid.spring", {{"node", name}});
    }
    if (!any) note("Every node is a bone of the body or already swings.");
    end_list();
}

void put_on_springs_row(const HumanoidPanel& panel) {
    std::vector<std::string> nodes;
    for (const std::size_t node : selected_for_springs(panel.part))
        nodes.push_back(panel.part.skeleton()[node].name);
    if (nodes.empty()) return;
    const bool free = panel.part.springs.size() + nodes.size() <= max_springs;
    const std::string too_many = "At most " + std::to_string(max_springs) + " springs";
    if (row_button(nodes.size() == 1 ? "Put on a spring" : "Put on springs", 1, free,
                   free ? "It and everything below it then trail behind the clip" : too_many.c_str()))
        panel.emit("humanoid.spring", {one_or_list("node", "nodes", nodes)});
    end_row();
}

/// Shows one spring; editing sets all.
void setting_rows(const HumanoidPanel& panel, const SpringSetting& spring,
                  const std::vector<std::string>& nodes) {
    const FieldRows rows(spring.options, "humanoid.spring", panel.emit,
                         {one_or_list("node", "nodes", nodes)});
    rows.rows("strength", "critical_damping", "weight", "max_angle");
    if (colliding(panel.part, spring) != nullptr) rows.row("hit_radius");
}

}  // namespace

void settings_row(const HumanoidPanel& panel, const std::string& node, const char* command,
                  const char* argument, const char* help) {
    const bool shown =
        !panel.part.selection.several() && active_name(panel.part.selection, panel.part.skeleton()) == node;
    if (row_button("Settings", 2, !shown, "Selects it and shows its settings on the right"))
        panel.emit("humanoid.select", {{"node", node}});
    if (row_button("Remove", 2, true, help)) panel.emit(command, {{argument, node}, {"on", false}});
    end_row();
}

void spring_rows(const HumanoidPanel& panel) {
    if (panel.part.springs.empty())
        note("Makes ears, antennae or a tail of the character trail behind its head or hips.");
    for (std::size_t i = 0; i < panel.part.springs.size(); ++i) spring_row(panel, i);
    if (panel.part.springs.size() < max_springs) add_row(panel);
}

void spring_inspector(const HumanoidPanel& panel) {
    const HumanoidPart& part = panel.part;
    put_on_springs_row(panel);
    const std::vector<std::size_t> selected = selected_springs(part);
    if (selected.empty()) return;
    const std::size_t shown = spring_on(part, *part.selection.active()).value_or(selected.back());
    const SpringSetting& spring = part.springs[shown];
    std::vector<std::string> nodes;
    for (const std::size_t each : selected) nodes.push_back(part.springs[each].node);
    const PanelSection ids(nodes.size() == 1 ? ("Spring: " + spring.node).c_str()
                                             : (count_text(nodes.size(), "spring") + " selected").c_str());
    const bool alike = std::ranges::all_of(
        selected, [&](std::size_t each) { return part.springs[each].options == spring.options; });
    if (nodes.size() > 1)
        note((alike ? "Showing the one from " : "They differ. Showing the one from ") + spring.node +
             " down; changes apply to all.");
    setting_rows(panel, spring, nodes);
    if (const NamedSpring* file = colliding(part, spring)) {
        reading("colliders", "%.0f", static_cast<double>(file->colliders.size()));
        explain("Spheres and capsules of the file that keep its bones out.");
    }
    const SpringChains& chains = panel.runtime.solvers.springs(part);
    for (const std::size_t each : selected)
        if (chains[each] == nullptr)
            note("The bone map has turned a node of the spring from " + part.springs[each].node +
                 " down into a bone of the body: it follows the clip.");
}

// Commands on springs.

namespace {

void drop(HumanoidPart& part, std::size_t which) {
    const auto at = static_cast<std::ptrdiff_t>(which);
    part.springs.erase(part.springs.begin() + at);
    if (which < part.ik_state.springs.size()) part.ik_state.springs.erase(part.ik_state.springs.begin() + at);
}

/// The spring that starts at that node.
std::optional<std::size_t> spring_from(const HumanoidPart& part, std::size_t from) {
    const std::string& node = part.skeleton()[from].name;
    for (std::size_t i = 0; i < part.springs.size(); ++i)
        if (part.springs[i].node == node) return i;
    return std::nullopt;
}

std::size_t added(HumanoidPart& part, std::size_t node) {
    if (const std::string why = why_no_spring(part, node); !why.empty()) throw std::invalid_argument(why);
    if (const auto chain = humanoid::SpringChain::make(part.skeleton(), *part.map, node); !chain)
        throw std::invalid_argument(chain.error().message());
    if (part.springs.size() >= max_springs)
        throw std::invalid_argument("there are " + std::to_string(max_springs) + " springs already");
    part.springs.push_back(usual_spring(part, node));
    part.ik_state.springs.resize(part.springs.size());
    return part.springs.size() - 1;
}

void set_spring(HumanoidPart& part, std::size_t node, const Arguments& given) {
    std::optional<std::size_t> which = spring_from(part, node);
    if (given.has("on") && !given.boolean("on")) {
        if (which) drop(part, *which);
        return;
    }
    if (!which) which = added(part, node);
    set_fields(given, part.springs[*which].options);
}

void set_springs(HumanoidPart& part, const Arguments& given) {
    const std::vector<std::size_t> nodes = nodes_named(part, given);
    if (nodes.empty()) throw Refused("nodes is empty");
    const std::vector<SpringSetting> before = part.springs;
    for (const std::size_t node : nodes) set_spring(part, node, given);
    const bool removes = given.has("on") && !given.boolean("on");
    if (!removes && part.springs != before) part.quiet_ticks = 0;
}

}  // namespace

void add_spring_commands(CommandTable& table) {
    std::vector<Argument> arguments{
        node_argument("node", false,
                      "by name: it and everything below it, which must not be bones of the body"),
        name_list_argument("nodes", "node"), switch_argument("on", "false: takes them off")};
    for (Argument& each : field_arguments<humanoid::SpringOptions>()) arguments.push_back(std::move(each));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.spring", "Let nodes swing on springs", std::move(arguments),
        "Lets ears, antennae or a tail trail behind on springs; anything omitted stays as it is",
        set_springs));
}

}  // namespace tendril::app
