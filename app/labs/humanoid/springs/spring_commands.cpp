// Springs on the character's own nodes.
#include <stdexcept>

#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/name_list.hpp"

namespace tendril::app {
namespace {

void drop(HumanoidPart& part, std::size_t which) {
    const auto at = static_cast<std::ptrdiff_t>(which);
    part.springs.erase(part.springs.begin() + at);
    if (which < part.ik_state.springs.size()) part.ik_state.springs.erase(part.ik_state.springs.begin() + at);
}

/// The spring from just that node on.
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
    part.springs.push_back({.node = part.skeleton()[node].name});
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
    set_fields(given, part.springs[*which]);
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
        node_argument("node", false, "by name: it and all that hangs on it, no bones of the body"),
        name_list_argument("nodes", "node"), switch_argument("on", "or off")};
    for (Argument& each : field_arguments<SpringSetting>()) arguments.push_back(std::move(each));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.spring", "Let nodes swing on springs", std::move(arguments),
        "Lets ears, antennae or a tail trail behind by springs; what is left out stays", set_springs));
}

}  // namespace tendril::app
