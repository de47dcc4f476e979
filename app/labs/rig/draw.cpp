#include "app/labs/rig/draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <tendril/ik/curve.hpp>

#include "app/io/text.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/rig/controls.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/take.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "app/view/surfaces.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {

// Bones with their axes, nulls, figures, selection and pending marks.

namespace {

constexpr glm::vec4 unseen{0.0f};  ///< for invisible strokes that only catch the pointer
constexpr std::size_t max_labels = 2000;
constexpr float gizmo_clearance = 84.0f;  ///< keeps a name clear of the gizmo
constexpr const char* before_units = "before any unit";

/// True if units move an element away from its input pose, which its gizmo sets.
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
        const std::size_t count = p_.part.state->controls.size();
        for (std::size_t i = 0; i < count; ++i) {
            switch (p_.elements.kind(p_.part.rig.id(i))) {
                case rig::ElementKind::Bone:
                    bone(i);
                    break;
                case rig::ElementKind::Null:
                    null(i);
                    break;
                case rig::ElementKind::Control:
                    if (p_.view.handles) draw_control(p_, i);
                    break;
            }
            if (pending_) pending(i);
        }
        curves();
        if (const auto element = p_.part.selected.only_element(); element && p_.view.handles)
            input_pose(*element);
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
            draw_head(p_.view, p_.list, pose, head_radius(p_.elements, id), face_of(p_.part),
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
        if (!p_.view.handles) return;
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

    /// Draws the curves that splines follow, with their points after the last unit.
    void curves() {
        for (const UnitRow& row : unit_rows(p_.part)) {
            const auto* spline = std::get_if<rig::Spline>(&row.unit->operation);
            if (spline == nullptr || !row.unit->enabled) continue;
            std::vector<glm::vec3> points;
            for (const std::string& each : spline->points)
                points.push_back(p_.point(*p_.part.rig.element(each)));
            const bool chosen = p_.part.selected.unit == row.unit->name;
            curve(points, is_b_spline(*row.unit), chosen ? 2.5f : 1.5f);
        }
    }
    bool is_b_spline(const rig::Unit& unit) const {
        for (const UnitInput& input : unit_inputs(p_.part, p_.elements, unit))
            if (input.value && input.path == "/b_spline") return *input.value == rig::Value(true);
        return false;
    }
    void curve(const std::vector<glm::vec3>& points, bool b_spline, float width) {
        const ik::CurveKind kind = b_spline ? ik::CurveKind::BSpline : ik::CurveKind::Hermite;
        const std::size_t pieces = points.size() - 1, each = std::clamp<std::size_t>(512 / pieces, 1, 24);
        glm::vec3 from = points.front();
        for (std::size_t i = 1; i <= each * pieces; ++i) {
            const glm::vec3 to =
                ik::curve_point(points, kind, static_cast<float>(i) / static_cast<float>(each));
            p_.line(from, to, width, p_.view.palette.target).layer = Layer::Overlay;
            from = to;
        }
    }

    /// Marks the stored state; everything else is drawn from a copy with nothing pending.
    void pending(std::size_t i) {
        const rig::Pending what = p_.part.state->elements.pending(p_.part.rig.id(i));
        if (what == rig::Pending::None) return;
        const glm::vec3 colour = what == rig::Pending::Global ? p_.view.palette.accent : p_.view.palette.tail;
        p_.list.ring(p_.point(i), p_.px(13.0f), p_.px(2.0f), glm::vec4(colour, 1.0f)).layer = Layer::Overlay;
    }

    /// Draws the input pose of the selected element, which its gizmo sets, with the bones above and below it.
    void input_pose(std::size_t i) {
        if (!starts_elsewhere(p_.part, p_.elements, i)) return;
        const rig::ElementId id = p_.part.rig.id(i);
        std::vector<std::size_t> places(p_.part.state->controls.size());  // definition index by handle
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
    /// At a different position, not merely rotated: there is room for two names.
    bool lies_elsewhere(std::size_t i) const { return glm::distance(start_of(i), p_.point(i)) > 1e-4f; }
    glm::vec3 start_of(std::size_t i) const {
        return glm::vec3(p_.part.rig.start_pose(p_.part.state, i).translation);
    }
    /// Draws one bone, and the bone that leads to it.
    void ghost(glm::vec3 to, std::optional<glm::vec3> from) {
        const glm::vec4 paint(p_.view.palette.ghost, 1.0f);
        p_.list.sphere(to, p_.px(4.0f), Unit::Pixels, paint).layer = Layer::Overlay;
        if (!from) return;
        const float thick = 0.06f * glm::distance(*from, to);
        p_.list.bone(*from, to, thick, 0.35f * thick, paint).layer = Layer::Overlay;
    }

    void labels() {
        const bool always = p_.view.workspace.settings.labels == LabelMode::Always;
        const std::size_t count = p_.part.state->controls.size(), stride = count / max_labels + 1;
        for (std::size_t i = 0; i < count; ++i) {
            if (p_.part.rig.definition().elements[i].control) continue;  // controls draw their own
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
    draw_past_ghosts(view, rig_past(), list);
    draw_incident(picture);
}

std::vector<LegendRow> RigLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    std::vector<LegendRow> rows{
        {"bone", colours.joint},
        {.name = "control", .colour = colours.target, .handle = true},
        {"at its limit", colours.limit},
        {.name = "selection", .colour = colours.selection, .ring = true, .handle = true}};
    const auto selected = rig_part(workspace).selected.only_element();
    if (selected &&
        starts_elsewhere(rig_part(workspace), workspace.runtimes.of<RigRuntime>(rig_lab).resolved(workspace),
                         *selected))
        rows.push_back({.name = before_units, .colour = colours.ghost, .handle = true});
    if (workspace.ui.incident) rows.push_back({"before it happened", colours.ghost});
    add_ghost_legend(workspace, rig_past(), rows);
    if (rig_pending_setting().chosen(workspace.settings) == 1) {
        rows.push_back({"global pose pending", colours.accent, true});
        rows.push_back({"local pose pending", colours.tail, true});
    }
    return rows;
}

namespace {

constexpr float blob_radius = 0.45f;  ///< metres, undeformed

double curve_value(const RigPart& part, const char* name) {
    const auto at = part.rig.curve(name);
    return at ? part.state->curves[*at] : 0.0;
}

/// Rainbow colours of even strength; the hue repeats with period 1.
glm::vec3 of_hue(double hue) {
    const auto wrapped = static_cast<float>(6.0 * (hue - std::floor(hue)));
    const glm::vec3 full =
        glm::clamp(glm::vec3(std::abs(wrapped - 3.0f) - 1.0f, 2.0f - std::abs(wrapped - 2.0f),
                             2.0f - std::abs(wrapped - 4.0f)),
                   0.0f, 1.0f);
    return 0.88f * glm::mix(glm::vec3(1.0f), full, 0.68f);
}

glm::vec3 placed(const rig::Transform& pose, glm::vec3 point) {
    return glm::vec3(pose.translation + pose.rotation * (pose.scale * glm::dvec3(point)));
}

double mean_scale(const rig::Transform& pose) {
    return (std::abs(pose.scale.x) + std::abs(pose.scale.y) + std::abs(pose.scale.z)) / 3.0;
}

}  // namespace

Figure figure_of(const RigPart& part, std::size_t element) {
    const rig::Element& made = part.rig.definition().elements[element];
    if (made.kind == rig::ElementKind::Bone && (made.name == "head" || made.name == "skull"))
        return Figure::Head;
    const bool blob = made.kind == rig::ElementKind::Null && made.name == "blob" &&
                      part.rig.curve("stretch") && part.rig.curve("bulge") && part.rig.curve("hue");
    return blob ? Figure::Blob : Figure::None;
}

std::vector<glm::dvec3> bone_ends(const rig::Hierarchy& elements, rig::ElementId bone) {
    std::vector<glm::dvec3> ends;
    for (auto child = elements.first_child(bone); child; child = elements.next_sibling(child))
        if (elements.kind(child) == rig::ElementKind::Bone)
            ends.push_back(elements.known(child, rig::Space::Global)->translation);
    if (!ends.empty()) return ends;
    // A last bone continues in the direction of its parent bone; a single bone points up.
    const rig::Transform pose = *elements.known(bone, rig::Space::Global);
    const rig::Transform local = *elements.known(bone, rig::Space::Local);
    const double length = glm::length(local.translation);
    const rig::ElementId parent = elements.parent(bone);
    const bool goes_on = parent && elements.kind(parent) == rig::ElementKind::Bone && length > 1e-9;
    const glm::dvec3 way = goes_on ? 0.4 * local.translation : glm::dvec3(0.0, 0.25, 0.0);
    return {pose.translation + pose.rotation * (pose.scale * way)};
}

double bone_size(const rig::Hierarchy& elements, rig::ElementId bone) {
    const glm::dvec3 from = elements.known(bone, rig::Space::Global)->translation;
    const std::vector<glm::dvec3> ends = bone_ends(elements, bone);
    double sum = 0.0;
    for (const glm::dvec3& end : ends) sum += glm::distance(from, end);
    return sum / static_cast<double>(ends.size());
}

double head_radius(const rig::Hierarchy& elements, rig::ElementId bone) {
    // Elements that turn with the bone keep their distance, so turning the head does not change its size.
    const double scale = mean_scale(*elements.known(bone, rig::Space::Global));
    return scale > 1e-9 ? 0.8 * bone_size(elements, bone) / scale : 0.0;
}

Bounds figure_bounds(const RigPart& part, const rig::Hierarchy& elements, std::size_t element) {
    const rig::Transform pose = *elements.known(part.rig.id(element), rig::Space::Global);
    const auto at = glm::vec3(pose.translation);
    const auto scale = static_cast<float>(mean_scale(pose));
    switch (figure_of(part, element)) {
        case Figure::Head:
            return {at, scale * static_cast<float>(head_radius(elements, part.rig.id(element)))};
        case Figure::Blob: {
            const auto stretch = static_cast<float>(std::clamp(curve_value(part, "stretch"), 0.0, 3.0));
            return {at, scale * blob_radius * (1.0f + stretch)};
        }
        case Figure::None:
            break;
    }
    return {at, 0.0f};
}

Face face_of(const RigPart& part) {
    const auto share = [&](const char* curve) {
        return static_cast<float>(std::clamp(curve_value(part, curve), 0.0, 1.0));
    };
    return {share("blink"), share("mouth")};
}

void draw_head(const View& view, DrawList& list, const rig::Transform& pose, double radius, const Face& face,
               glm::vec3 colour, PickId pick) {
    // On the light theme's dark joints the face would be invisible.
    if (view.palette.theme == Theme::Light) colour = glm::mix(colour, glm::vec3(1.0f), 0.5f);
    const auto size = static_cast<float>(radius);
    globe(
        list, view.camera,
        [&](glm::vec3 p) {
            // Narrower than deep, and narrower still towards the chin.
            const float chin = 0.16f * std::max(-p.y, 0.0f);
            return placed(pose, size * glm::vec3((0.86f - chin) * p.x, p.y, (0.94f - chin) * p.z));
        },
        colour);
    const float scale = size * static_cast<float>(mean_scale(pose));
    const glm::vec3 white = rgb(0xF5F7FA);
    const auto ball = [&](glm::vec3 at, float wide, glm::vec3 paint) {
        list.sphere(placed(pose, size * at), wide * scale, Unit::Metres, glm::vec4(paint, 1.0f)).pick = pick;
    };
    for (const float side : {-1.0f, 1.0f}) {
        ball({0.33f * side, 0.17f, 0.76f}, 0.19f, white);
        ball({0.34f * side, 0.17f, 0.885f}, 0.105f, rgb(0x20262E));
    }
    const glm::vec3 skin = glm::mix(colour, rgb(0xD98E73), 0.55f);
    list.bone(placed(pose, size * glm::vec3(0.0f, 0.0f, 0.86f)),
              placed(pose, size * glm::vec3(0.0f, -0.12f, 1.06f)), 0.07f * scale, 0.12f * scale,
              glm::vec4(skin, 1.0f))
        .pick = pick;
    if (face.blink > 0.0f) {  // a lid closes over each eye, from inside the head
        const glm::vec3 lid = glm::mix(colour, skin, 0.35f);
        const float up = 1.0f - face.blink;
        for (const float side : {-1.0f, 1.0f})
            ball({0.335f * side, 0.17f + 0.13f * up, 0.8f - 0.1f * up}, 0.215f - 0.02f * up, lid);
    }
    // The mouth: the upper lip, and the lower lip that opens it.
    const auto on_face = [&](float across, float y) {
        const float chin = 0.16f * -y;
        const float front = (0.94f - chin) * std::sqrt((1.0f - y * y) * (1.0f - across * across));
        return placed(pose, size * glm::vec3(across, y, front + 0.006f));
    };
    constexpr int half = 3;
    std::array<glm::vec3, 2 * half + 1> upper{}, lower{};
    for (int i = -half; i <= half; ++i) {
        const float across = 0.09f * static_cast<float>(i), u = static_cast<float>(i) / half;
        const float line = -0.46f + 0.9f * across * across, open = face.mouth * (1.0f - u * u);
        const auto at = static_cast<std::size_t>(i + half);
        upper[at] = on_face(across, line + 0.03f * open);
        lower[at] = on_face(across, line - 0.2f * open);
    }
    const auto stretch = [&](glm::vec3 a, glm::vec3 b, float wide, glm::vec3 paint) {
        list.bone(a, b, wide * scale, wide * scale, glm::vec4(paint, 1.0f)).pick = pick;
    };
    const glm::vec3 lips = rgb(0x7A4A46);
    for (std::size_t i = 0; i < upper.size(); ++i) {
        if (face.mouth > 0.0f) stretch(upper[i], lower[i], 0.05f, rgb(0x3A1E22));
        if (i == 0) continue;
        stretch(upper[i - 1], upper[i], 0.035f, lips);
        if (face.mouth > 0.0f) stretch(lower[i - 1], lower[i], 0.035f, lips);
    }
    const auto centre = glm::vec3(pose.translation);
    cast(list, centre, centre, 0.9f * scale);
    list.sphere(centre, 0.9f * scale, Unit::Metres, glm::vec4(0.0f)).pick = pick;
}

void draw_blob(const View& view, DrawList& list, const rig::Transform& pose, const RigPart& part,
               glm::vec3 tint, float tinted, PickId pick) {
    const auto stretch = static_cast<float>(std::clamp(curve_value(part, "stretch"), -0.8, 3.0));
    const auto bulge = static_cast<float>(std::clamp(curve_value(part, "bulge"), -0.8, 3.0));
    const float tall = 1.0f + stretch,
                wide = 1.0f / std::sqrt(tall);  // preserves the volume
    const auto shape = [&](glm::vec3 p) {
        const float off = (p.y + 0.25f) / 0.45f;
        const float out =
            wide *
            (1.0f + 0.65f * bulge * static_cast<float>(math::exponential(static_cast<double>(-off * off))));
        return placed(pose, blob_radius * glm::vec3(out * p.x, tall * p.y, out * p.z));
    };
    globe(list, view.camera, shape, glm::mix(of_hue(curve_value(part, "hue")), tint, tinted));
    const float scale = blob_radius * static_cast<float>(mean_scale(pose));
    const float belly = std::min(wide * (1.0f + 0.5f * bulge), 1.2f * tall);
    const glm::vec3 top = placed(pose, {0.0f, blob_radius * std::max(tall - belly, 0.0f), 0.0f});
    const glm::vec3 bottom = placed(pose, {0.0f, -blob_radius * std::max(tall - belly, 0.0f), 0.0f});
    cast(list, top, bottom, belly * scale);
    list.bone(top, bottom, belly * scale, belly * scale, glm::vec4(0.0f)).pick = pick;
}

void draw_walks(const View& view, DrawList& list) {
    const RigPart& part = rig_part(view.workspace);
    const rig::Hierarchy& elements = view.workspace.runtimes.of<RigRuntime>(rig_lab).resolved(view.workspace);
    for (const RigWalk& walk : part.walks) {
        const rig::ElementId parent = elements.parent(part.rig.id(*part.rig.element(walk.control)));
        const rig::Transform space = parent ? *elements.known(parent, rig::Space::Global) : rig::Transform();
        constexpr int sides = 96;
        const auto at = [&](int side) {
            const double ticks = static_cast<double>(ticks_per_round(walk.motion)) * side / sides;
            const rig::Transform point{.translation = walk_point(walk.motion, ticks)};
            return glm::vec3(rig::compose(space, point).translation);
        };
        for (int side = 0; side < sides; ++side)
            list.line(at(side), at(side + 1), 1.5f * view.scale, glm::vec4(view.palette.target, 0.3f));
    }
}

// The skeleton before an incident, over the current one.

namespace {

constexpr std::size_t max_ghosts = 5000;  ///< in bones

/// Draws only the bones.
void draw_skeleton(const RigPicture& picture, const rig::Hierarchy& elements, const glm::vec4& paint) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.part.state->controls.size() && count < max_ghosts; ++i) {
        const rig::ElementId id = picture.part.rig.id(i);
        if (elements.kind(id) != rig::ElementKind::Bone) continue;
        ++count;
        const glm::vec3 from(elements.known(id, rig::Space::Global)->translation);
        picture.list.sphere(from, picture.px(4.5f), Unit::Pixels, paint).layer = Layer::Overlay;
        for (const glm::dvec3& end : bone_ends(elements, id))
            picture.list.line(from, glm::vec3(end), picture.px(2.5f), paint).layer = Layer::Overlay;
    }
}

/// Axes of the bone that flipped: it may have turned about its own axis.
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
    if (incident->joint >= picture.part.state->controls.size()) return;
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

LabSetting rig_axes_setting() {
    return {.key = "bone_axes",
            .command = "view.bone_axes",
            .title = "Show or hide bone axes",
            .argument = "show",
            .help = "Shows or hides the axes of every bone",
            .choices = {{"shown", "Axes at every bone"}, {"hidden", "No axes at bones"}}};
}

LabSetting rig_pending_setting() {
    return {
        .key = "pending_rings",
        .command = "view.pending_rings",
        .title = "Show or hide pending rings",
        .argument = "show",
        .help = "Draws a ring around what the last edit or solve left pending",
        .choices = {{"hidden", "No rings around pending poses"}, {"shown", "Rings around pending poses"}}};
}

LabSetting rig_figures_setting() {
    return {.key = "figures",
            .command = "view.figures",
            .title = "Show or hide heads and blobs",
            .argument = "show",
            .help = "Shows or hides heads and blobs, so that the bones within are seen",
            .choices = {{"shown", "Heads and blobs drawn"}, {"hidden", "Bones only"}}};
}

LabSetting rig_strip_setting() {
    return {.key = "rig_strip",
            .command = "view.rig_strip",
            .title = "Show the take or the past",
            .argument = "of",
            .help = "Shows the take below the scene of the Rig lab, or its last ten seconds",
            .choices = {{"take", "The take below the scene"}, {"past", "The last ten seconds below it"}}};
}

std::vector<LabSetting> RigLab::settings() const {
    return {rig_axes_setting(), rig_figures_setting(), rig_pending_setting(), rig_strip_setting()};
}

}  // namespace tendril::app
