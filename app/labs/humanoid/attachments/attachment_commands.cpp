// What hangs on the character: ropes, hair, cloth.
#include <glm/geometric.hpp>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/labs/humanoid/attachments/wearing.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/ik/ik_command.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

/// A bone of the body, as it is mapped, or any node.
std::size_t holder_named(const HumanoidPart& part, const std::string& name) {
    const auto bone = humanoid::bone_named(name);
    if (bone)
        if (const auto node = part.node_of(*bone)) return *node;
    if (const auto node = part.skeleton().find(name)) return *node;
    throw std::invalid_argument(bone ? name + " is not mapped, and no node has that name"
                                     : "the character has no bone and no node \"" + name + "\"");
}

void take_shape(AttachmentShape& shape, const Arguments& given) {
    if (given.has("length")) shape.length = given.real("length");
    if (given.has("width")) shape.width = given.real("width");
    if (given.has("thickness")) shape.thickness = given.real("thickness");
    if (given.has("segments")) shape.segments = given.integer("segments");
    if (given.has("strands")) shape.strands = given.integer("strands");
    if (given.has("offset")) shape.offset = exact_point(given.json("offset"));
    if (!given.has("direction")) return;
    const glm::dvec3 direction = exact_point(given.json("direction"));
    if (!(glm::length(direction) > 1e-9))
        throw std::invalid_argument("direction must be longer than 0, got [0, 0, 0]");
    shape.direction = glm::normalize(direction);
}

void attach(Workspace& workspace, const Arguments& given) {
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const ShownPose& shown = shown_pose(workspace);
    change_part<HumanoidPart>(workspace, humanoid_lab, [&](HumanoidPart& part, const HumanoidPart&) {
        const Wearer wearer = wearer_of(part, runtime.solvers, shown);
        const std::size_t node = holder_named(part, given.text("bone"));
        Attachment wanted{.name = given.has("name") ? given.text("name") : std::string(),
                          .node = part.skeleton()[node].name,
                          .kind = attachment_kinds.value(given.text("kind"))};
        wanted.shape = default_shape(wearer, wanted.kind, node);
        take_shape(wanted.shape, given);
        add_attachment(part.attachments, wearer, std::move(wanted));
        part.quiet_ticks = 0;
    });
}

void detach(HumanoidPart& part, const Arguments& given) {
    remove_attachment(part.attachments, given.text("name"));
}

}  // namespace

void add_attachment_commands(CommandTable& table) {
    const auto metres = [](const char* name, const char* help) {
        return number_argument(name, help, shortest_attachment, longest_attachment);
    };
    table.add(
        {.name = "humanoid.attach",
         .title = "Attach a rope, hair or cloth",
         .arguments = {node_argument("bone", true, "a bone, as it is mapped, or a node, by name"),
                       choice_argument("kind", true, "what", attachment_kinds.names()),
                       text_argument("name", false, "a new one; after its kind when left out"),
                       metres("length", "metres"),
                       integer_argument("segments", "along its length", 1, most_attached_segments),
                       metres("width", "of a cloth, or the patch that hair grows on, metres"),
                       metres("thickness", "of the rope, a hair, the cloth, metres"),
                       integer_argument("strands", "of hair", 1, most_attached_strands),
                       point_argument("offset", false,
                                      "from the bone to where it is held, along the axes of the character "
                                      "at rest, metres; off the body when left out"),
                       point_argument("direction", false, "that it leads in at first, along the same axes")},
         .help = "Hangs a rope, hair or a cloth on a bone; what is left out fits the bone and the "
                 "character's height",
         .effect = Effect::Edit,
         .apply = attach});
    table.add(part_command<HumanoidPart>(humanoid_lab, "humanoid.detach", "Detach a rope, hair or cloth",
                                         {offering(text_argument("name", true, "of the attachment"),
                                                   [](const Workspace& w) {
                                                       return names(
                                                           humanoid_part(w).attachments.list,
                                                           [](const Attachment& each) { return each.name; });
                                                   })},
                                         "Takes a rope, hair or a cloth off the character", detach));
}

}  // namespace tendril::app
