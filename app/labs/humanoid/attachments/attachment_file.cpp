// What hangs on a character, in a scene file: how each was made, where it is held, and the rope world.
#include <algorithm>

#include "app/document/json_complete.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/quaternion_json.hpp"
#include "app/labs/kit/world_file.hpp"

namespace tendril::app {
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
    attachment.frame = {place["frame"]["position"].dpoint(), read_quaternion(place["frame"]["turn"])};
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
             {"frame", {{"position", dpoint(each.frame.position)}, {"turn", quaternion(each.frame.turn)}}}});
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
    } catch (const std::logic_error& error) {  // the core's own words, told where in the file
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
