// The Rig lab's picture: bones with their axes, nulls, figures, what is selected and what is pending.
#include <algorithm>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/labs/rig/control_shape.hpp"
#include "app/labs/rig/draw_walks.hpp"
#include "app/labs/rig/past.hpp"
#include "app/labs/rig/picture.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/settings.hpp"

namespace tendril::app {
namespace {

constexpr glm::vec4 unseen{0.0f};  ///< of strokes that can be caught, but are drawn otherwise
constexpr std::size_t max_labels = 2000;
constexpr float gizmo_clearance = 84.0f;  ///< a name stands beyond the gizmo
constexpr const char* before_units = "before any unit";

/// Whether units move an element from where its gizmo sets it.
bool starts_elsewhere(const RigPart& part, const rig::Hierarchy& elements, std::size_t i) {
    const rig::ElementId id = part.rig.id(i);
    if (elements.kind(id) == rig::ElementKind::Control) return false;
    const rig::Transform input = part.rig.start_pose(part.state, i),
                         now = *elements.known(id, rig::Space::Global);
    return glm::distance(input.translation, now.translation) >= 1e-6 ||
           std::abs(glm::dot(input.rotation, now.rotation)) <= 1.0 - 1e-10;
}

class Drawing {
  public:
    Drawing(const RigPicture& picture, const Settings& settings)
        : p_(picture),
          axes_(rig_axes_setting().chosen(settings) == 0),
          pending_(rig_pending_setting().chosen(settings) == 1),
          figures_(rig_figures_setting().chosen(settings) == 0) {}

    void run() {
        const std::size_t count = p_.part.state.controls.size();
        for (std::size_t i = 0; i < count; ++i) {
            switch (p_.elements.kind(p_.part.rig.id(i))) {
                case rig::ElementKind::Bone:
                    bone(i);
                    break;
                case rig::ElementKind::Null:
                    null(i);
                    break;
                case rig::ElementKind::Control:
                    draw_control(p_, i);
                    break;
            }
            if (pending_) pending(i);
        }
        if (const auto element = p_.part.selected.only_element()) input_pose(*element);
        labels();
    }

  private:
    void bone(std::size_t i) {
        const rig::ElementId id = p_.part.rig.id(i);
        const rig::Transform pose = p_.pose(i);
        const auto from = glm::vec3(pose.translation);
        const PickId pick = element_pick(i);
        const glm::vec4 paint(p_.marked(p_.view.palette.joint, i), 1.0f);
        const bool head = figures_ && figure_of(p_.part, i) == Figure::Head;
        if (head)
            draw_head(p_.view, p_.list, pose, head_radius(p_.elements, id),
                      p_.marked(p_.view.palette.joint, i), pick);
        float thickest = 0.0f;
        for (const glm::dvec3& end : bone_ends(p_.elements, id)) {
            const auto to = glm::vec3(end);
            const float thick = std::min(0.13f * glm::distance(from, to), 0.16f);
            thickest = std::max(thickest, thick);
            Stroke& stroke = p_.list.bone(from, to, thick, 0.35f * thick, paint);
            stroke.shadow = true;
            stroke.pick = pick;
        }
        const float ball = p_.at_least(0.85f * thickest, 3.0f, from);
        if (!head) {
            Stroke& joint = p_.list.sphere(from, ball, Unit::Metres, paint);
            joint.shadow = true;
            joint.pick = pick;
            joint.rank = 1;
        }
        const auto length = static_cast<float>(bone_size(p_.elements, id));
        if (axes_ && length > p_.metres(14.0f, from))
            p_.axes(pose, std::clamp(0.36f * length, ball, 0.3f), 2.0f, Layer::Overlay);
        ring(i, from, ball / p_.view.camera.metres_per_pixel(from));
    }

    void null(std::size_t i) {
        const rig::Transform pose = p_.pose(i);
        const auto at = glm::vec3(pose.translation);
        if (figures_ && figure_of(p_.part, i) == Figure::Blob) {
            const float tinted = p_.is_active(i) ? 0.25f : p_.is_selected(i) || p_.is_lit(i) ? 0.12f : 0.0f;
            draw_blob(p_.view, p_.list, pose, p_.part,
                      p_.is_selected(i) ? p_.view.palette.selection : glm::vec3(1.0f), tinted,
                      element_pick(i));
        }
        const float size = p_.at_least(0.09f, 9.0f, at);
        p_.axes(pose, 1.5f * size, 2.0f, Layer::Overlay);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 along(0.0);
            along[axis] = 1.0;
            const glm::vec3 arm = size * glm::vec3(pose.rotation * along);
            p_.line(at, at - arm, 2.0f, p_.marked(p_.view.palette.neutral, i)).layer = Layer::Overlay;
        }
        Stroke& grip = p_.list.sphere(at, p_.px(10.0f), Unit::Pixels, unseen);
        grip.pick = element_pick(i);
        grip.rank = 2;
        ring(i, at, p_.px(5.0f));
    }

    void ring(std::size_t i, glm::vec3 at, float clear) {
        if (!p_.is_selected(i) && !p_.is_lit(i)) return;
        const glm::vec4 paint = p_.is_selected(i) ? glm::vec4(p_.view.palette.selection, 1.0f)
                                                  : glm::vec4(p_.view.palette.text, 0.55f);
        const float width = p_.px(p_.is_active(i) ? 2.5f : 1.5f);
        p_.list.ring(at, clear + p_.px(4.0f), width, paint).layer = Layer::Overlay;
    }

    /// Of the state as it is kept, not as it is drawn: what the picture shows has been worked out for it.
    void pending(std::size_t i) {
        const rig::Pending what = p_.part.state.elements.pending(p_.part.rig.id(i));
        if (what == rig::Pending::None) return;
        const glm::vec3 colour = what == rig::Pending::Global ? p_.view.palette.accent : p_.view.palette.tail;
        p_.list.ring(p_.point(i), p_.px(13.0f), p_.px(2.0f), glm::vec4(colour, 1.0f)).layer = Layer::Overlay;
    }

    /// Where the selected element begins before any unit moves it, with the bones that lead there and go on
    /// from it: this is what its gizmo sets.
    void input_pose(std::size_t i) {
        if (!starts_elsewhere(p_.part, p_.elements, i)) return;
        const rig::ElementId id = p_.part.rig.id(i);
        std::vector<std::size_t> places(p_.part.state.controls.size());  // in the definition, by handle
        for (std::size_t each = 0; each < places.size(); ++each) places[p_.part.rig.id(each).index] = each;
        const auto ghost_of = [&](rig::ElementId at) {
            const rig::ElementId parent = p_.elements.parent(at);
            const bool bone = parent && p_.elements.kind(parent) == rig::ElementKind::Bone;
            ghost(start_of(places[at.index]),
                  bone ? std::optional(start_of(places[parent.index])) : std::nullopt);
        };
        for (auto at = p_.elements.first_child(id); at; at = p_.elements.first_child(at)) ghost_of(at);
        for (auto at = id; at && p_.elements.kind(at) == rig::ElementKind::Bone; at = p_.elements.parent(at))
            ghost_of(at);
        if (lies_elsewhere(i))
            p_.label(start_of(i), p_.name(i) + " " + before_units, p_.view.palette.text, gizmo_clearance, 3);
    }
    /// Not only turned: two names have room.
    bool lies_elsewhere(std::size_t i) const { return glm::distance(start_of(i), p_.point(i)) > 1e-4f; }
    glm::vec3 start_of(std::size_t i) const {
        return glm::vec3(p_.part.rig.start_pose(p_.part.state, i).translation);
    }
    /// Of one bone, and of the one that leads to it.
    void ghost(glm::vec3 to, std::optional<glm::vec3> from) {
        const glm::vec4 paint(p_.view.palette.ghost, 1.0f);
        p_.list.sphere(to, p_.px(4.0f), Unit::Pixels, paint).layer = Layer::Overlay;
        if (!from) return;
        const float thick = 0.06f * glm::distance(*from, to);
        p_.list.bone(*from, to, thick, 0.35f * thick, paint).layer = Layer::Overlay;
    }

    void labels() {
        const bool always = p_.view.workspace.settings.labels == LabelMode::Always;
        const std::size_t count = p_.part.state.controls.size(), stride = count / max_labels + 1;
        for (std::size_t i = 0; i < count; ++i) {
            if (p_.part.rig.definition().elements[i].control) continue;  // has its own
            const bool marked = p_.is_lit(i) || p_.is_active(i);
            if (!marked && !(always && i % stride == 0)) continue;
            const bool has_gizmo = p_.has_gizmo(i) && !lies_elsewhere(i);
            p_.label(p_.point(i), p_.name(i), p_.view.palette.text, has_gizmo ? gizmo_clearance : 14.0f,
                     marked ? 3 : 0);
        }
    }

    const RigPicture& p_;
    bool axes_, pending_, figures_;
};

}  // namespace

glm::vec3 RigPicture::marked(glm::vec3 colour, std::size_t i) const {
    if (is_selected(i)) return glm::mix(colour, view.palette.selection, is_active(i) ? 0.75f : 0.5f);
    return is_lit(i) ? glm::mix(colour, view.palette.text, 0.45f) : colour;
}

Stroke& RigPicture::line(glm::vec3 a, glm::vec3 b, float width, glm::vec3 colour, PickId pick) const {
    Stroke& stroke = list.line(a, b, px(width), glm::vec4(colour, 1.0f));
    stroke.pick = pick;
    return stroke;
}

void RigPicture::axes(const rig::Transform& pose, float length, float width, Layer layer) const {
    const glm::vec3 colours[]{view.palette.axis_x, view.palette.axis_y, view.palette.axis_z};
    const auto at = glm::vec3(pose.translation);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0.0);
        along[axis] = 1.0;
        line(at, at + length * glm::vec3(pose.rotation * along), width, colours[axis]).layer = layer;
    }
}

void RigPicture::label(glm::vec3 at, std::string text, glm::vec3 colour, float clearance, int rank) const {
    list.labels.push_back(
        {.at = at, .clearance = px(clearance), .text = std::move(text), .colour = colour, .rank = rank});
}

void RigLab::draw(const View& view, DrawList& list) const {
    const RigPart& part = rig_part(view.workspace);
    const rig::Hierarchy& elements = view.workspace.runtimes.of<RigRuntime>(rig_lab).resolved(view.workspace);
    const RigPicture picture{view, list, part, elements};
    Drawing(picture, view.workspace.settings).run();
    draw_walks(view, list);
    draw_past_ghosts(view, rig_past(), rig_lines, list);
    draw_incident(picture);
}

std::vector<LegendRow> RigLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    std::vector<LegendRow> rows{{"bone", colours.joint},
                                {"control", colours.target},
                                {"at its limit", colours.limit},
                                {"selection", colours.selection, true}};
    const auto selected = rig_part(workspace).selected.only_element();
    if (selected &&
        starts_elsewhere(rig_part(workspace), workspace.runtimes.of<RigRuntime>(rig_lab).resolved(workspace),
                         *selected))
        rows.push_back({before_units, colours.ghost});
    if (workspace.ui.incident) rows.push_back({"before it happened", colours.ghost});
    if (rig_past().shows_ghosts(workspace.settings)) rows.push_back({ghost_legend, colours.ghost});
    if (rig_pending_setting().chosen(workspace.settings) == 1) {
        rows.push_back({"global pose pending", colours.accent, true});
        rows.push_back({"local pose pending", colours.tail, true});
    }
    return rows;
}

}  // namespace tendril::app
