// The skeleton as it was before an incident, over what came of it.
#include <glm/geometric.hpp>
#include <memory>

#include "app/document/units.hpp"
#include "app/labs/kit/incident_pen.hpp"
#include "app/labs/rig/picture.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_ghosts = 5000;  ///< bones

/// The bones and nothing else.
void draw_skeleton(const RigPicture& picture, const rig::Hierarchy& elements, const glm::vec4& paint) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.part.state.controls.size() && count < max_ghosts; ++i) {
        const rig::ElementId id = picture.part.rig.id(i);
        if (elements.kind(id) != rig::ElementKind::Bone) continue;
        ++count;
        const glm::vec3 from(elements.known(id, rig::Space::Global)->translation);
        picture.list.sphere(from, picture.px(4.5f), Unit::Pixels, paint).layer = Layer::Overlay;
        for (const glm::dvec3& end : bone_ends(elements, id))
            picture.list.line(from, glm::vec3(end), picture.px(2.5f), paint).layer = Layer::Overlay;
    }
}

/// Of the bone that flipped: it may have turned about itself.
void draw_axes(const RigPicture& picture, const rig::Transform& pose, float length) {
    const glm::vec3 colours[]{picture.view.palette.axis_x, picture.view.palette.axis_y,
                              picture.view.palette.axis_z};
    const glm::vec3 at(pose.translation);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0.0);
        along[axis] = 1.0;
        picture.list
            .line(at, at + 0.36f * length * glm::vec3(pose.rotation * along), picture.px(2.0f),
                  faded(picture.view.palette, colours[axis], 0.45f))
            .layer = Layer::Overlay;
    }
}

}  // namespace

void draw_incident(const RigPicture& picture) {
    const auto& incident = picture.view.workspace.ui.incident;
    if (!incident) return;
    const auto before =
        std::dynamic_pointer_cast<const RigPart>(picture.view.workspace.around(*incident).before);
    if (!before || &before->rig.definition() != &picture.part.rig.definition()) return;
    rig::Hierarchy was = before->solved_state().elements;
    was.resolve_all();
    draw_skeleton(picture, was, faded(picture.view.palette, picture.view.palette.ghost, 0.9f));
    if (incident->joint >= picture.part.state.controls.size()) return;
    const rig::ElementId id = picture.part.rig.id(incident->joint);
    const glm::vec3 at = picture.point(incident->joint);
    if (incident->kind != Incident::Kind::Flip)
        return draw_incident_mark(picture.view, *incident, at, picture.list);
    const rig::Transform pose = *was.known(id, rig::Space::Global);
    draw_axes(picture, pose, static_cast<float>(bone_size(was, id)));
    const auto from = bone_ends(was, id), to = bone_ends(picture.elements, id);
    for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i)
        draw_turn(picture.view, glm::vec3(from[i]), glm::vec3(to[i]), at, picture.list);
    draw_incident_mark(picture.view, *incident, at, picture.list);
}

}  // namespace tendril::app
