// The panel's rows about attachments, and their drawing.
#include "app/labs/humanoid/draw.hpp"

#include <imgui.h>
#include <algorithm>
#include <array>

#include "app/fields/field_rows.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/world_drawing.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/lists.hpp"

namespace tendril::app {
namespace {

void attachment_row(const HumanoidPanel& panel, const Attachment& each) {
    ImGui::PushID(each.name.c_str());
    const std::string kind = attachment_kinds.title(each.kind);
    reading(each.name.c_str(), "%son %s",
            (each.name + ' ').starts_with(kind + ' ') ? "" : (kind + ' ').c_str(),
            panel.part.called(*panel.part.skeleton().find(each.node)).c_str());
    if (row_button("Remove", 1, true, "Takes it off the character"))
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

void attachment_rows(const HumanoidPanel& panel) {
    const FoldingSection open(panel.workspace, "Attachments and wind", panel.emit, false);
    if (!open) return;
    note("Order in each tick: clip, curves, IK, rig, springs, ropes.");
    explain(
        "Curves bend the clip's pose. Feet, targets and hands are IK; look-at, the rig's Aim, and springs "
        "follow. Ropes, hair and cloth come last, and lie on the body as it is then.");
    for (const Attachment& each : panel.part.attachments.list) attachment_row(panel, each);
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
        "What it hangs from. A rope on Hips is a tail, hair on Head a ponytail, a cloth on Chest a cape.");
    const bool room = panel.part.attachments.list.size() < max_attachments;
    if (row_button("Add", 1, room, room ? "Hangs it on that bone" : "No more can be added"))
        panel.emit("humanoid.attach", {{"bone", kept.attach_to}, {"kind", attachment_kinds.name(kind)}});
    end_row();
    FieldRows({wind_fields(), &panel.part.attachments.world->settings(), &attachment_settings}, wind_texts(),
              "humanoid.wind", panel.emit)
        .all();
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
