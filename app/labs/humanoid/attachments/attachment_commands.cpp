// Attachments: their commands, their part of a scene file, and their rows in the panel.
#include <imgui.h>
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <tendril/humanoid/t_pose.hpp>
#include <tendril/magnitude.hpp>

#include "app/fields/field_rows.hpp"
#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"

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

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::NodeFrame>() noexcept {
    using app::NodeFrame;
    static constexpr Field rows[] = {
        field<&NodeFrame::position>("position", {-max_magnitude, max_magnitude}, "m"),
        field<&NodeFrame::turn>("turn", unit_length)};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::AttachmentPin>() noexcept {
    using app::AttachmentPin;
    static constexpr Field rows[] = {
        field<&AttachmentPin::particle>("particle", {0, app::max_attached_particles}),
        field<&AttachmentPin::offset>("offset", {-max_magnitude, max_magnitude}, "m")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Attachment>() noexcept {
    using app::Attachment;
    static constexpr auto kinds = app::attachment_kinds.name_array();
    static constexpr Field rows[] = {field<&Attachment::name>("name"),
                                     field<&Attachment::node>("node"),
                                     field<&Attachment::kind>("kind", kinds),
                                     nested<&Attachment::shape>("shape"),
                                     list<&Attachment::pins>("pins").up_to(app::max_attached_particles),
                                     nested<&Attachment::frame>("frame")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Attachments>() noexcept {
    static constexpr Field rows[] = {list<&app::Attachments::list>("list").up_to(app::max_attachments)};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<AttachmentShape>() {
    static constexpr FieldText texts[] = {
        {.name = "length", .help = "Length from the held end to the free end."},
        {.name = "segments", .help = "Number of segments along its length."},
        {.name = "width", .help = "Width of a cloth, or of the patch that hair grows on."},
        {.name = "thickness", .help = "Thickness of the rope, a hair or the cloth."},
        {.name = "strands", .help = "Number of hairs."},
        {.name = "offset",
         .help = "From the bone to the held end, in the axes of the character at rest; if omitted, just off "
                 "the body."},
        {.name = "direction",
         .help = "The direction it points in at first, in the axes of the character at rest."}};
    return texts;
}

namespace {

/// A mapped bone of the body, or any node, by name.
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

void set_wind(HumanoidPart& part, const Arguments& given) {
    NamedWorld world = *part.attachments.world;
    rope::Settings wanted = world.settings();
    set_fields(given, wanted);
    world.set_settings(wanted);
    part.attachments.world = std::make_shared<const NamedWorld>(std::move(world));
    part.quiet_ticks = 0;
}

/// The wind's direction as the figure feels it: its axes are the scene's.
std::string wind_text(const HumanoidPanel& panel) {
    const glm::dvec3 wind(panel.part.attachments.world->settings().wind);
    const auto hips = panel.part.node_of(humanoid::Bone::Hips);
    if (!hips || wind == glm::dvec3(0.0)) return {};
    const humanoid::Facing at = humanoid::facing(panel.part.skeleton(), *panel.part.map);
    const glm::dquat turn =
        wearer_of(panel.part, panel.runtime.solvers, panel.runtime.shown(panel.workspace)).frame(*hips).turn;
    std::string text;
    const auto add = [&](const glm::dvec3& way, const char* along, const char* against) {
        const double share = glm::dot(glm::normalize(wind), turn * way);
        if (std::abs(share) < 0.38) return;  // within 22 degrees of square to it
        text += std::string(text.empty() ? "Blows " : ", ") + (share > 0.0 ? along : against);
    };
    add(at.forward, "from behind", "from the front");
    add(at.left, "to its left", "to its right");
    add(at.up, "upwards", "downwards");
    return text + '.';
}

void attachment_row(const HumanoidPanel& panel, const Attachment& each) {
    ImGui::PushID(each.name.c_str());
    const std::string kind = attachment_kinds.name(each.kind);
    reading(each.name.c_str(), "%son %s",
            (each.name + ' ').starts_with(kind + ' ') ? "" : (kind + ' ').c_str(),
            panel.part.called(*panel.part.skeleton().find(each.node)).c_str());
    if (row_button("Remove", 1, true, "Removes it from the character"))
        panel.emit("humanoid.detach", {{"name", each.name}});
    end_row();
    ImGui::PopID();
}

/// Bones of the body first, then all other nodes.
void holder_field(const HumanoidPanel& panel) {
    auto& chosen = panel.runtime.panel.attach_to;
    if (!begin_list("bone", &chosen)) return;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const std::string name = humanoid::name(static_cast<humanoid::Bone>(i));
        if (panel.part.map->bones[i].node >= 0 && list_row(name, chosen == name)) chosen = name;
    }
    for (std::size_t i = 0; i < panel.part.skeleton().size(); ++i) {
        const std::string& name = panel.part.skeleton()[i].name;
        if (!panel.part.bone_of(i) && list_row(name, chosen == name)) chosen = name;
    }
    end_list();
}

}  // namespace

void add_attachment_commands(CommandTable& table) {
    std::vector<Argument> arguments{
        node_argument("bone", true, "a mapped bone, or a node, by name"),
        choice_argument("kind", true, "what", attachment_kinds.names()),
        text_argument("name", false, "a new name; if omitted, made from its kind")};
    for (Argument& each : field_arguments<AttachmentShape>()) arguments.push_back(std::move(each));
    table.add({.name = "humanoid.attach",
               .title = "Attach a rope, hair or cloth",
               .arguments = std::move(arguments),
               .help = "Hangs a rope, hair or a cloth on a bone; omitted values fit the bone and the "
                       "character's height",
               .effect = Effect::Edit,
               .apply = attach});
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.wind", "Set the character's wind",
        field_arguments(wind_fields(), wind_texts()),
        "Sets the wind on the character's ropes, hair and cloth; omitted settings are kept", set_wind));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.detach", "Detach a rope, hair or cloth",
        {offering(text_argument("name", true, "of the attachment"),
                  [](const Workspace& w) {
                      return names(humanoid_part(w).attachments.list,
                                   [](const Attachment& each) { return each.name; });
                  })},
        "Removes a rope, hair or a cloth from the character", [](HumanoidPart& part, const Arguments& given) {
            remove_attachment(part.attachments, given.text("name"));
        }));
}

// Attachments in a scene file: their shapes, where they are attached, and the rope world.

namespace {

/// Checks names and counts; the tables check the ranges.
void check_attachment(const JsonPlace& place, const Attachment& attachment,
                      const humanoid::Skeleton& skeleton, const NamedWorld& world) {
    if (!skeleton.find(attachment.node))
        place["node"].fail("the character has no node \"" + attachment.node + "\"");
    const rope::Body* const body = world.find(attachment.name);
    if (body == nullptr) place["name"].fail("its world has no body \"" + attachment.name + "\"");
    const double length = glm::dot(attachment.shape.direction, attachment.shape.direction);
    if (!(length > 0.99 && length < 1.01))
        place["shape"]["direction"].fail("expected a direction of length 1");
    if (attachment.pins.size() > body->count) place["pins"].fail("its body has fewer particles");
    for (std::size_t i = 0; i < attachment.pins.size(); ++i)
        if (attachment.pins[i].particle >= body->count)
            place["pins"].element(i)["particle"].fail("its body has no such particle");
}

}  // namespace

Json attachments_json(const Attachments& attachments) {
    Json json = save_fields(attachments);
    json["world"] = save_world(*attachments.world);
    return json;
}

Attachments read_attachments(const JsonPlace& place, const humanoid::Skeleton& skeleton) {
    Attachments attachments;
    load_known_fields(place, {{attachments, MissingField::Refused}}, {"world"});
    const JsonPlace world_place = place["world"];
    try {
        NamedWorld world = load_world(world_place);
        const rope::Settings& saved = world.settings();
        rope::Settings settings = attachment_settings;
        settings.substep = saved.substep;
        settings.wind = saved.wind, settings.gusts = saved.gusts, settings.still_air = saved.still_air;
        world.set_settings(settings);
        attachments.world = std::make_shared<const NamedWorld>(std::move(world));
    } catch (const std::logic_error& error) {  // the library's message, with the JSON path
        world_place.fail(error.what());
    }
    const NamedWorld& world = *attachments.world;
    if (world.size() > max_attached_particles)
        world_place.fail("expected at most " + std::to_string(max_attached_particles) + " particles, found " +
                         std::to_string(world.size()));
    for (std::size_t i = 0; i < attachments.list.size(); ++i)
        check_attachment(place["list"].element(i), attachments.list[i], skeleton, world);
    if (attachments.list.size() != world.state().bodies.size())
        world_place.fail("expected one body for each attachment");
    return attachments;
}

// The panel's rows about attachments, and their drawing.

void attachment_rows(const HumanoidPanel& panel) {
    const FoldingSection open(panel.workspace, "Attachments and wind", panel.emit, false);
    if (!open) return;
    note("Order in each tick: clip, curves, IK, rig, springs, ropes.");
    explain(
        "Curves bend the clip's pose. Feet, targets and hands are IK; look-at, the rig's Aim, and springs "
        "follow. Ropes, hair and cloth come last, and lie on the resulting pose.");
    HumanoidRuntime::Panel& kept = panel.runtime.panel;
    const auto titles = attachment_kinds.titles();
    const bool chosen =
        choice_field("kind", kept.attach_kind, titles.data(), static_cast<int>(titles.size()));
    const auto kind = static_cast<AttachmentKind>(kept.attach_kind);
    explain(attachment_kinds.help(kind));
    constexpr std::array suits{humanoid::Bone::Hips, humanoid::Bone::Head, humanoid::Bone::Chest};
    const humanoid::Bone suited = suits[static_cast<std::size_t>(kind)];
    if (chosen && panel.part.node_of(suited)) kept.attach_to = humanoid::name(suited);
    holder_field(panel);
    explain(
        "The bone it hangs from. A rope on Hips is a tail, hair on Head a ponytail, a cloth on Chest a "
        "cape.");
    const bool room = panel.part.attachments.list.size() < max_attachments;
    if (row_button("Add", 1, room, room ? "Hangs it on that bone" : "No more can be added"))
        panel.emit("humanoid.attach", {{"bone", kept.attach_to}, {"kind", attachment_kinds.name(kind)}});
    end_row();
    for (const Attachment& each : panel.part.attachments.list) attachment_row(panel, each);
    FieldRows({wind_fields(), &panel.part.attachments.world->settings(), &attachment_settings}, wind_texts(),
              "humanoid.wind", panel.emit)
        .all();
    if (const std::string way = wind_text(panel); !way.empty()) note(way);
}

glm::vec3 attached_colour(const Palette& palette) {
    return cloth_front(palette);
}

void draw_attachments(const View& view, DrawList& list, const Attachments& attachments) {
    constexpr int sides = 16;
    const NamedWorld& world = *attachments.world;
    const std::vector<glm::vec3> positions = world.positions();
    std::vector<glm::vec3> colours = particle_colours(world, view.palette, false);
    for (const rope::Body& body : world.state().bodies)
        if (body.kind == rope::Body::Kind::Rope)  // a tail should not look like a leg
            std::fill_n(colours.begin() + static_cast<std::ptrdiff_t>(body.first), body.count,
                        attached_colour(view.palette));
    for (const rope::Body& body : world.state().bodies) {
        if (body.kind == rope::Body::Kind::Cloth)
            draw_cloth(list, view.camera, world, body, positions, {}, view.palette);
        else
            draw_strands(list, view.camera, body, positions, colours, sides);
    }
}

}  // namespace tendril::app
