// Commands on attachments, and attachments in a scene file.
#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <tendril/magnitude.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/ik_commands.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/world_file.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::AttachmentShape>() noexcept {
    using namespace app;
    constexpr FieldRange size{min_attachment, max_attachment};
    constexpr FieldRange anywhere{-max_magnitude, max_magnitude};
    static constexpr Field rows[] = {
        field<&AttachmentShape::length>("length", size, "m"),
        field<&AttachmentShape::width>("width", size, "m"),
        field<&AttachmentShape::thickness>("thickness", size, "m"),
        field<&AttachmentShape::segments>("segments", {1, max_attached_segments}),
        field<&AttachmentShape::strands>("strands", {1, max_attached_strands}),
        field<&AttachmentShape::offset>("offset", anywhere, "m"),
        field<&AttachmentShape::direction>("direction", anywhere)};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<AttachmentShape>() {
    static constexpr FieldText texts[] = {
        {.name = "length", .label = "length", .help = "From the held end to the free end."},
        {.name = "segments", .label = "segments", .help = "How many along its length."},
        {.name = "width", .label = "width", .help = "Of a cloth, or of the patch that hair grows on."},
        {.name = "thickness", .label = "thickness", .help = "Of the rope, a hair or the cloth."},
        {.name = "strands", .label = "strands", .help = "How many hairs there are."},
        {.name = "offset",
         .label = "offset",
         .help = "From the bone to where it is held, in the axes of the character at rest; if omitted, "
                 "just off the body."},
        {.name = "direction",
         .label = "direction",
         .help = "The direction it points in at first, in the axes of the character at rest."}};
    return texts;
}

namespace {

/// A mapped bone of the body, or any node.
std::size_t holder_named(const HumanoidPart& part, const std::string& name) {
    const auto bone = humanoid::bone_named(name);
    if (bone)
        if (const auto node = part.node_of(*bone)) return *node;
    if (const auto node = part.skeleton().find(name)) return *node;
    throw std::invalid_argument(bone ? name + " is not mapped, and no node has that name"
                                     : "the character has no bone and no node \"" + name + "\"");
}

void take_shape(AttachmentShape& shape, const Arguments& given) {
    set_fields(given, shape);
    if (!given.has("direction")) return;
    if (!(glm::length(shape.direction) > 1e-9))
        throw std::invalid_argument("direction must be longer than 0, got [0, 0, 0]");
    shape.direction = glm::normalize(shape.direction);
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
    std::vector<Argument> arguments{node_argument("bone", true, "a mapped bone, or a node, by name"),
                                    choice_argument("kind", true, "what", attachment_kinds.names()),
                                    text_argument("name", false, "a new one; if omitted, after its kind")};
    for (Argument& each : field_arguments<AttachmentShape>()) arguments.push_back(std::move(each));
    table.add({.name = "humanoid.attach",
               .title = "Attach a rope, hair or cloth",
               .arguments = std::move(arguments),
               .help = "Hangs a rope, hair or a cloth on a bone; omitted values fit the bone and the "
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

// Attachments in a scene file: their shapes, where they are attached, and the rope world.

namespace {

AttachmentShape read_shape(const JsonPlace& place) {
    AttachmentShape shape;
    load_fields(place, shape);
    const double length = glm::dot(shape.direction, shape.direction);
    if (!(length > 0.99 && length < 1.01)) place["direction"].fail("expected a direction of length 1");
    return shape;
}

Json pins_json(const std::vector<AttachmentPin>& pins) {
    Json list = Json::array();
    for (const AttachmentPin& pin : pins)
        list.push_back({{"particle", pin.particle}, {"offset", dpoint(pin.offset)}});
    return list;
}

Attachment read_attachment(const JsonPlace& place, const humanoid::Skeleton& skeleton,
                           const NamedWorld& world) {
    Attachment attachment{.name = place["name"].text(), .node = place["node"].text()};
    if (!skeleton.find(attachment.node))
        place["node"].fail("the character has no node \"" + attachment.node + "\"");
    attachment.kind = place["kind"].choice(attachment_kinds);
    const rope::Body* const body = world.find(attachment.name);
    if (body == nullptr) place["name"].fail("its world has no body \"" + attachment.name + "\"");
    attachment.shape = read_shape(place["shape"]);
    place["pins"].for_each("pins", body->count, [&](const JsonPlace& each) {
        attachment.pins.push_back({each["particle"].index(body->count - 1), each["offset"].dpoint()});
    });
    attachment.frame = {place["frame"]["position"].dpoint(), place["frame"]["turn"].drotation()};
    return attachment;
}

}  // namespace

Json attachments_json(const Attachments& attachments) {
    Json list = Json::array();
    for (const Attachment& each : attachments.list)
        list.push_back(
            {{"name", each.name},
             {"node", each.node},
             {"kind", attachment_kinds.name(each.kind)},
             {"shape", save_fields(each.shape)},
             {"pins", pins_json(each.pins)},
             {"frame", {{"position", dpoint(each.frame.position)}, {"turn", dquaternion(each.frame.turn)}}}});
    return Json{{"list", std::move(list)}, {"world", save_world(*attachments.world)}};
}

Attachments read_attachments(const JsonPlace& place, const humanoid::Skeleton& skeleton) {
    Attachments attachments;
    const JsonPlace world_place = place["world"];
    try {
        NamedWorld world = load_world(world_place);
        rope::Settings settings = attachment_settings;
        settings.substep = world.settings().substep;
        world.set_settings(settings);
        attachments.world = std::make_shared<const NamedWorld>(std::move(world));
    } catch (const std::logic_error& error) {  // the library's message, with the JSON path
        world_place.fail(error.what());
    }
    const NamedWorld& world = *attachments.world;
    if (world.size() > max_attached_particles)
        world_place.fail("expected at most " + std::to_string(max_attached_particles) + " particles, found " +
                         std::to_string(world.size()));
    place["list"].for_each("attachments", max_attachments, [&](const JsonPlace& each) {
        Attachment attachment = read_attachment(each, skeleton, world);
        if (attachments.find(attachment.name) != nullptr)
            each["name"].fail("another attachment has the name \"" + attachment.name + "\"");
        attachments.list.push_back(std::move(attachment));
    });
    if (attachments.list.size() != world.state().bodies.size())
        world_place.fail("expected one body for each attachment");
    return attachments;
}

}  // namespace tendril::app
