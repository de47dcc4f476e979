#include "app/labs/humanoid/springs/springs.hpp"

#include <imgui.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "app/fields/field_rows.hpp"
#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<humanoid::SpringOptions>() {
    static constexpr FieldText texts[] = {
        {.name = "strength",
         .label = "strength",
         .help = "How many times a second its tip would swing. The base is stiffer.",
         .step = 0.02f},
        {.name = "critical_damping",
         .label = "damping",
         .help = "0 swings for ever, 1 comes to rest without overshooting.",
         .step = 0.005f},
        {.name = "weight", .label = "spring weight", .help = "0: as in the clip. 1: the whole swing."},
        {.name = "max_angle",
         .label = "max angle",
         .help = "The largest angle by which a bone turns away from the clip.",
         .step = 0.5f,
         .decimals = 0},
        {.name = "hit_radius",
         .label = "hit radius",
         .help = "How far its bones' ends keep outside the spheres and capsules of the file.",
         .step = 0.05f,
         .decimals = 1,
         .scale = 100.0,
         .unit = "cm"}};
    return texts;
}

namespace {

/// The index of the part's spring that turns the node; empty if none does.
std::optional<std::size_t> spring_on(const HumanoidPart& part, std::size_t node) {
    for (std::size_t i = 0; i < part.springs.size(); ++i)
        if (const auto root = part.skeleton().find(part.springs[i].node);
            root && part.skeleton().is_below(node, *root))
            return i;
    return std::nullopt;
}

/// The other spring that would turn the same nodes; empty if there is none.
std::string overlap(const HumanoidPart& part, std::size_t node) {
    const std::string& name = part.skeleton()[node].name;
    if (const auto there = spring_on(part, node))
        return name + " already swings, on the spring from " + part.springs[*there].node + " down";
    for (const SpringSetting& each : part.springs)
        if (const auto root = part.skeleton().find(each.node); root && part.skeleton().is_below(*root, node))
            return "there is a spring from " + each.node + " down, which is below " + name;
    return {};
}

void spring_row(const HumanoidPanel& panel, std::size_t which) {
    const SpringSetting& each = panel.part.springs[which];
    ImGui::PushID(each.node.c_str());
    reading(each.node.c_str(), "%.0f\u00b0",
            glm::degrees(panel.runtime.shown(panel.workspace).springs[which].angle));
    explain("The largest angle between its bones and the clip now.");
    settings_row(panel, each.node, "humanoid.spring", "node",
                 "Removes the spring: only the clip moves the bones");
    ImGui::PopID();
}

/// Why the node cannot have a spring: another spring is in the way, or it belongs to the body or has no
/// parent. Empty if it can; it must also have some length.
std::string why_no_spring(const HumanoidPart& part, std::size_t node) {
    const std::string& name = part.skeleton()[node].name;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const std::int32_t mapped = part.map->bones[i].node;
        if (mapped >= 0 && part.skeleton().is_below(static_cast<std::size_t>(mapped), node))
            return (static_cast<std::size_t>(mapped) == node ? name + " is the "
                                                             : "below " + name + " is the ") +
                   std::string(humanoid::name(static_cast<humanoid::Bone>(i))) +
                   " of the body, which the clip and IK move";
    }
    if (part.skeleton()[node].parent < 0) return name + " has no parent";
    return overlap(part, node);
}

/// A list of the nodes that can have a spring.
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

/// The initial setting of a spring on the node.
SpringSetting usual_spring(const HumanoidPart& part, std::size_t node) {
    SpringSetting setting{.node = part.skeleton()[node].name};
    for (const NamedSpring& each : part.loaded->character.springs)
        if (each.node == node && !each.colliders.empty())
            setting.options.hit_radius = std::min(each.hit_radius, max_hit_radius());
    return setting;
}

}  // namespace

void take_springs(HumanoidPart& part) {
    for (const NamedSpring& each : part.loaded->character.springs) {
        if (part.springs.size() == max_springs || !why_no_spring(part, each.node).empty()) continue;
        SpringSetting& spring = part.springs.emplace_back(usual_spring(part, each.node));
        spring.options.strength = each.strength, spring.options.critical_damping = each.critical_damping;
    }
    part.ik_state.springs.resize(part.springs.size());
}

std::vector<std::size_t> selected_for_springs(const HumanoidPart& part) {
    std::vector<std::size_t> nodes;
    const auto taken = [&](std::size_t node) {
        return std::ranges::any_of(nodes,
                                   [&](std::size_t above) { return part.skeleton().is_below(node, above); });
    };
    for (const std::int32_t each : part.skeleton().order()) {
        const auto node = static_cast<std::size_t>(each);
        if (part.selection.has(node) && !taken(node) && why_no_spring(part, node).empty())
            nodes.push_back(node);
    }
    return nodes;
}

std::vector<std::size_t> selected_springs(const HumanoidPart& part) {
    std::vector<std::size_t> springs;
    for (std::size_t i = 0; i < part.springs.size(); ++i)
        if (const auto root = part.skeleton().find(part.springs[i].node);
            root && std::ranges::any_of(part.selection.all(), [&](std::size_t node) {
                return part.skeleton().is_below(node, *root);
            }))
            springs.push_back(i);
    return springs;
}

Json springs_json(const HumanoidPart& part) {
    Json list = Json::array();
    const humanoid::SpringChainState none;
    for (std::size_t i = 0; i < part.springs.size(); ++i) {
        const SpringSetting& each = part.springs[i];
        Json json{{"node", each.node}};
        json.update(save_fields(each.options));
        json.update(save_fields(i < part.ik_state.springs.size() ? part.ik_state.springs[i] : none));
        list.push_back(std::move(json));
    }
    return list;
}

void read_springs(const JsonPlace& place, HumanoidPart& part) {
    place.for_each("springs", max_springs, [&](const JsonPlace& each) {
        const std::string name = each["node"].text();
        const auto node = part.skeleton().find(name);
        if (!node) each["node"].fail("the character has no node \"" + name + "\"");
        // A spring whose nodes now belong to the body stays, without effect.
        if (const std::string why = overlap(part, *node); !why.empty()) each["node"].fail(why);
        SpringSetting spring = usual_spring(part, *node);
        humanoid::SpringChainState state;
        load_known_fields(each, {{spring.options}, {state, MissingField::Refused, {"masses", "held"}}},
                          {"node"});
        part.springs.push_back(std::move(spring));
        part.ik_state.springs.push_back(std::move(state));
    });
}

const NamedSpring* colliding(const HumanoidPart& part, const SpringSetting& setting) {
    for (const NamedSpring& each : part.loaded->character.springs)
        if (!each.colliders.empty() && part.skeleton()[each.node].name == setting.node) return &each;
    return nullptr;
}

humanoid::PlacedCapsule place(const SpringCollider& collider,
                              const std::vector<humanoid::Placement>& placed) {
    const humanoid::Placement& at = placed[collider.node];
    return {at.apply(collider.from), at.apply(collider.to), collider.radius};
}

std::vector<humanoid::SpringReport> swing(const HumanoidPart& part, const SpringChains& chains, double dt,
                                          std::vector<rig::Transform>& pose, SpringStates& states) {
    std::vector<humanoid::SpringReport> reports(chains.size());
    std::vector<humanoid::Placement> placed;
    states.resize(chains.size());
    for (std::size_t i = 0; i < chains.size(); ++i) {
        if (chains[i] == nullptr) {
            states[i] = {};
            continue;
        }
        std::vector<humanoid::PlacedCapsule> colliders;
        if (const NamedSpring* file = colliding(part, part.springs[i])) {
            if (placed.empty()) {
                placed.resize(pose.size());
                humanoid::place(part.skeleton(), pose, placed);
            }
            for (const SpringCollider& each : file->colliders) colliders.push_back(place(each, placed));
        }
        reports[i] = chains[i]->step(pose, part.springs[i].options, dt, states[i], colliders);
    }
    return reports;
}

void carry(const std::vector<SpringSetting>& settings, const SpringChains& chains,
           std::vector<rig::Transform> pose, SpringStates& states) {
    states.resize(chains.size());
    for (std::size_t i = 0; i < chains.size(); ++i)
        if (chains[i] != nullptr) chains[i]->teleport(pose, settings[i].options, states[i]);
}

bool at_rest(const SpringStates& states) {
    constexpr double resting_speed = 5e-3, resting_way = 1e-3;  // m/s, metres
    for (const humanoid::SpringChainState& each : states)
        for (const humanoid::SpringMass& mass : each.masses)
            if (glm::length(mass.velocity) > resting_speed ||
                (!mass.held && glm::distance(mass.position, mass.target) > resting_way))
                return false;
    return true;
}

// Panel rows and commands for springs on the character's own nodes.

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
        name_list_argument("nodes", "node"), switch_argument("on", "false: removes them")};
    for (Argument& each : field_arguments<humanoid::SpringOptions>()) arguments.push_back(std::move(each));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.spring", "Let nodes swing on springs", std::move(arguments),
        "Lets ears, antennae or a tail trail behind on springs; omitted settings are kept", set_springs));
}

}  // namespace tendril::app
