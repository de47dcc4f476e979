// What is selected and how it is shown, which leaves no step to undo, and what counts as a flip.
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/name_list.hpp"

namespace tendril::app {
namespace {

void select(HumanoidPart& part, const Arguments& given) {
    const bool add = given.has("add") && given.boolean("add");
    if (!given.has("node") && !given.has("nodes")) {
        if (!add) part.selection.clear();
        return;
    }
    const std::vector<std::size_t> nodes = nodes_named(part, given);
    if (given.has("node") && add)
        part.selection.toggle(nodes.front());
    else
        part.selection.take(nodes, add);
}

void set_view(HumanoidPart& part, const Arguments& given) {
    if (given.has("ghost")) part.view.ghost = given.boolean("ghost");
    if (given.has("skin")) part.view.skin = skin_looks.value(given.text("skin"));
    if (given.has("skinning")) part.view.skinning = skinnings.value(given.text("skinning"));
    if (given.has("limits")) part.view.limits = limits_shown.value(given.text("limits"));
    if (given.has("follow")) part.view.follow = given.boolean("follow");
}

void set_flips(HumanoidPart& part, const Arguments& given) {
    set_flip_rule(part.flips, given);
}

}  // namespace

void add_humanoid_look_commands(CommandTable& table) {
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.select", "Select nodes",
        {node_argument("node", false, "by name; nothing is selected when all are left out"),
         name_list_argument("nodes", "node"),
         switch_argument("add", "true: adds to what is selected, or with node takes out what is")},
        "Selects nodes of the character", select, Effect::Look));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.view", "Set how the character is shown",
        {switch_argument("ghost", "of the pose as it was before anything changed it"),
         choice_argument("skin", false, "how what the character wears is drawn", skin_looks.names()),
         choice_argument("skinning", false, "how it follows twisted arms", skinnings.names()),
         choice_argument("limits", false, "of which joints the limits are drawn", limits_shown.names()),
         switch_argument("follow", "the camera goes along with a walk")},
        "Sets how the character is shown; what is left out stays", set_view, Effect::Look));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.flips", "Set the rule for bone flips", flip_arguments(humanoid_flip_words),
        "Sets what counts as a flip of a bone, from the next tick on", set_flips));
}

}  // namespace tendril::app
