#include "app/labs/humanoid/springs/springs.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"

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

/// Which other spring would turn the same nodes; empty if none would.
std::string overlap(const HumanoidPart& part, std::size_t node) {
    const std::string& name = part.skeleton()[node].name;
    if (const auto there = spring_on(part, node))
        return name + " already swings, on the spring from " + part.springs[*there].node + " down";
    for (const SpringSetting& each : part.springs)
        if (const auto root = part.skeleton().find(each.node); root && part.skeleton().is_below(*root, node))
            return "there is a spring from " + each.node + " down, which is below " + name;
    return {};
}

}  // namespace

std::optional<std::size_t> spring_on(const HumanoidPart& part, std::size_t node) {
    for (std::size_t i = 0; i < part.springs.size(); ++i)
        if (const auto root = part.skeleton().find(part.springs[i].node);
            root && part.skeleton().is_below(node, *root))
            return i;
    return std::nullopt;
}

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

SpringSetting usual_spring(const HumanoidPart& part, std::size_t node) {
    SpringSetting setting{.node = part.skeleton()[node].name};
    for (const NamedSpring& each : part.loaded->character.springs)
        if (each.node == node && !each.colliders.empty())
            setting.options.hit_radius = std::min(each.hit_radius, max_hit_radius());
    return setting;
}

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

}  // namespace tendril::app
