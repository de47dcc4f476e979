#include "app/labs/rig/controls.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/rig/draw.hpp"
#include "app/labs/rig/values.hpp"
#include "app/view/surfaces.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

glm::dvec3 along(int axis) {
    glm::dvec3 v(0.0);
    v[axis] = 1.0;
    return v;
}

}  // namespace

double Rail::place(double value) const {
    const double range = high - low;
    return range > 0.0 ? ((value - low) / range - 0.5) * length : 0.0;
}
double Rail::value(double place) const {
    return low + (place / length + 0.5) * (high - low);
}

Rail rail_of(const rig::Control& control) {
    constexpr double unlimited = 2.0;
    Rail rail{.open_low = !control.minimum, .open_high = !control.maximum};
    if (control.minimum) rail.low = control.minimum->x;
    if (control.maximum) rail.high = control.maximum->x;
    if (rail.open_low && !rail.open_high) rail.low = rail.high - unlimited;
    if (rail.open_high && !rail.open_low) rail.high = rail.low + unlimited;
    return rail;
}

HandleFrame frame_of(const rig::Transform& pose) {
    return {glm::vec3(pose.translation), glm::quat(pose.rotation), glm::vec3(pose.scale)};
}

rig::Transform transform_of(const HandleFrame& frame) {
    return {glm::dvec3(frame.position), glm::dquat(frame.rotation), glm::dvec3(frame.scale)};
}

Json changed_transform(const rig::Transform& transform, const HandleFrame& from, const HandleFrame& to) {
    const Json all = transform_json(transform);
    Json changed = Json::object();
    if (to.position != from.position) changed["translation"] = all["translation"];
    if (to.rotation != from.rotation) changed["rotation"] = all["rotation"];
    if (to.scale != from.scale) changed["scale"] = all["scale"];
    return changed;
}

std::optional<ControlShape> ControlShape::of(const RigPart& part, const rig::Hierarchy& elements,
                                             std::size_t element) {
    const rig::Element& made = part.rig.definition().elements[element];
    if (!made.control) return std::nullopt;
    ControlShape shape(*made.control, part.state->controls[element], made.initial);
    const rig::ElementId id = part.rig.id(element), parent = elements.parent(id);
    if (parent) shape.space_ = *elements.known(parent, rig::Space::Global);
    shape.rest_ = *elements.known(id, rig::Space::Local, rig::Pose::Input);
    shape.now_ = *elements.known(id, rig::Space::Global);
    return shape;
}

rig::Transform ControlShape::pose() const {
    if (kind() != rig::ControlKind::Float) return now_;
    rig::Transform knob = now_;
    knob.translation += knob.rotation * glm::dvec3(rail_of(control_).place(number()), 0.0, 0.0);
    return knob;
}

glm::dvec3 ControlShape::placed(const glm::dvec3& value) const {
    glm::dvec3 local = value;
    if (kind() == rig::ControlKind::Vector2d)
        local = rest_.translation +
                rest_.rotation * (value.x * along(control_.axes[0]) + value.y * along(control_.axes[1]));
    return rig::compose(space_, {.translation = local}).translation;
}

bool ControlShape::ends_at(std::size_t part, double value) const {
    const auto i = static_cast<glm::length_t>(part);
    const bool low = control_.minimum && value <= (*control_.minimum)[i];
    const bool high = control_.maximum && value >= (*control_.maximum)[i];
    return low || high;
}

bool ControlShape::at_limit() const {
    if (!control_.minimum && !control_.maximum) return false;
    const rig::Value first = rig::clamped(control_, rig::rest_value(control_, initial_));
    if (value_ == first) return false;
    if (kind() == rig::ControlKind::Float) return ends_at(0, number());
    const auto part = [&](const glm::dvec3& now, const glm::dvec3& then, std::size_t parts) {
        for (std::size_t i = 0; i < parts; ++i) {
            const auto at = static_cast<glm::length_t>(i);
            if (now[at] != then[at] && ends_at(i, now[at])) return true;
        }
        return false;
    };
    if (const auto* point = std::get_if<glm::dvec3>(&value_))
        return part(*point, std::get<glm::dvec3>(first), kind() == rig::ControlKind::Vector2d ? 2 : 3);
    if (const auto* transform = std::get_if<rig::Transform>(&value_))
        return part(transform->translation, std::get<rig::Transform>(first).translation, 3);
    return false;
}

Drag ControlShape::drag() const {
    const Drag drags[] = {Drag::Position | Drag::Rotation | Drag::Scale,
                          Drag::Position,
                          Drag::Rotation,
                          Drag::Position,
                          Drag::Nothing,
                          Drag::Position};
    return drags[static_cast<std::size_t>(kind())];
}

std::optional<GizmoPart> ControlShape::part() const {
    if (kind() == rig::ControlKind::Float) return GizmoPart::MoveX;
    if (kind() != rig::ControlKind::Vector2d) return std::nullopt;
    const int upright = 3 - control_.axes[0] - control_.axes[1];
    return upright == 0 ? GizmoPart::MoveYZ : upright == 1 ? GizmoPart::MoveZX : GizmoPart::MoveXY;
}

Json ControlShape::value_at(const HandleFrame& from, const HandleFrame& to) const {
    if (kind() == rig::ControlKind::Float) {
        const glm::dvec3 by = glm::dvec3(to.position) - now_.translation;
        return rail_of(control_).value((glm::inverse(now_.rotation) * by).x);
    }
    rig::Transform wanted = now_;
    if (to.position != from.position) wanted.translation = glm::dvec3(to.position);
    if (to.rotation != from.rotation) wanted.rotation = rig::normalised(glm::dquat(to.rotation));
    if (to.scale != from.scale) wanted.scale = glm::dvec3(to.scale);
    const rig::Transform local = rig::relative(space_, wanted);
    if (kind() == rig::ControlKind::Position) return value_json(local.translation);
    if (kind() == rig::ControlKind::Rotation) return value_json(local.rotation);
    if (kind() != rig::ControlKind::Vector2d) return changed_transform(local, from, to);
    const glm::dvec3 by = glm::inverse(rest_.rotation) * (local.translation - rest_.translation);
    return Json::array({by[control_.axes[0]], by[control_.axes[1]]});
}

std::string ControlShape::text() const {
    if (kind() == rig::ControlKind::Float) return fixed_text(number(), 2);
    if (kind() == rig::ControlKind::Bool) return on() ? "on" : "off";
    if (const auto* point = std::get_if<glm::dvec3>(&value_)) {
        const std::string two = fixed_text(point->x, 2) + ", " + fixed_text(point->y, 2);
        return kind() == rig::ControlKind::Vector2d ? two : two + ", " + fixed_text(point->z, 2);
    }
    return {};
}

// Controls are drawn as shapes that show their kind: a cube, a cross, three circles, a slider, a switch, a
// rectangle. The end of a range that a value has reached is drawn in the limit colour.

namespace {

constexpr glm::vec4 catch_only{0.0f};  ///< for invisible strokes that only catch the pointer
constexpr float shape_size = 0.14f, switch_size = 0.075f;  ///< half extents, metres
constexpr float smallest = 11.0f;                          ///< pixels

class ControlDrawing {
  public:
    ControlDrawing(const RigPicture& picture, std::size_t element, const ControlShape& shape)
        : p_(picture),
          i_(element),
          shape_(shape),
          pose_(shape.pose()),
          at_(pose_.translation),
          limit_(shape.at_limit()),
          size_(p_.at_least(shape_size, smallest, at_)),
          pick_(element_pick(element)) {}

    void run() {
        switch (shape_.kind()) {
            case rig::ControlKind::Transform:
                cube();
                limit_box();
                break;
            case rig::ControlKind::Position:
                cross();
                limit_box();
                break;
            case rig::ControlKind::Rotation:
                circles();
                break;
            case rig::ControlKind::Float:
                slider();
                break;
            case rig::ControlKind::Bool:
                toggle();
                break;
            case rig::ControlKind::Vector2d:
                rectangle();
                break;
        }
        label();
    }

  private:
    glm::vec3 colour() const {
        const glm::vec3 plain = limit_ ? p_.view.palette.limit : p_.view.palette.target;
        return limit_ ? plain : p_.marked(plain, i_);
    }
    glm::vec3 pale() const {
        return glm::vec3(faded(p_.view.palette, p_.marked(p_.view.palette.target, i_), 0.55f));
    }
    float width() const { return p_.is_lit(i_) || p_.is_selected(i_) ? 3.0f : 2.0f; }
    glm::vec3 along(int axis) const {
        glm::dvec3 v(0.0);
        v[axis] = 1.0;
        return glm::vec3(pose_.rotation * v);
    }
    Stroke& line(glm::vec3 a, glm::vec3 b, float wide, glm::vec3 paint) {
        Stroke& stroke = p_.line(a, b, wide, paint, pick_);
        stroke.rank = 2;
        return stroke;
    }

    /// `corner` maps -1 or 1 per axis to a point; `draw` gets an edge's two ends, first corner and axis.
    template <class Corner, class Draw>
    void twelve_edges(Corner corner, Draw draw) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int k = 0; k < 4; ++k) {
                glm::vec3 a(0.0f);
                a[axis] = -1.0f;
                a[(axis + 1) % 3] = (k & 1) != 0 ? 1.0f : -1.0f;
                a[(axis + 2) % 3] = (k & 2) != 0 ? 1.0f : -1.0f;
                glm::vec3 b = a;
                b[axis] = 1.0f;
                draw(corner(a), corner(b), a, axis);
            }
        }
    }

    /// Large enough to enclose the head of a child bone at the same position.
    float cube_size() const {
        float size = size_;
        const rig::ElementId id = p_.part.rig.id(i_);
        for (auto child = p_.elements.first_child(id); child; child = p_.elements.next_sibling(child)) {
            const rig::Transform local = *p_.elements.known(child, rig::Space::Local);
            if (p_.elements.kind(child) == rig::ElementKind::Bone && glm::length(local.translation) < 1e-6)
                size = std::max(size, 1.08f * static_cast<float>(head_radius(p_.elements, child)));
        }
        return size;
    }

    void cube() {
        const float half = cube_size();
        const auto corner = [&](glm::vec3 sides) {
            return at_ + glm::vec3(pose_.rotation * (pose_.scale * glm::dvec3(half * sides)));
        };
        twelve_edges(corner,
                     [&](glm::vec3 a, glm::vec3 b, glm::vec3, int) { line(a, b, width(), colour()); });
        if (half > size_) {  // leave the contents visible, but let the middle be grabbed
            Stroke& grip = p_.list.sphere(at_, p_.px(14.0f), Unit::Pixels, catch_only);
            grip.pick = pick_;
            grip.rank = 3;
            return;
        }
        p_.axes(pose_, 0.45f * half, 2.0f, Layer::Overlay);
        knob(6.0f);
    }

    void cross() {
        for (int axis = 0; axis < 3; ++axis) {
            const glm::vec3 arm = size_ * along(axis);
            line(at_ - arm, at_ + arm, width(), colour());
            if (p_.has_gizmo(i_)) continue;  // the gizmo has arrows
            for (const float side : {-1.0f, 1.0f}) {
                Stroke& head = p_.list.bone(at_ + 0.72f * side * arm, at_ + 1.06f * side * arm, 0.14f * size_,
                                            0.01f * size_, glm::vec4(colour(), 1.0f));
                head.pick = pick_;
                head.rank = 2;
            }
        }
        knob(6.0f);
    }

    /// Draws the range of a control with a position, if it has both limits.
    void limit_box() {
        const rig::Control& control = shape_.control();
        if (!control.minimum || !control.maximum) return;
        const glm::dvec3 low = *control.minimum, high = *control.maximum;
        const bool transform = shape_.kind() == rig::ControlKind::Transform;
        const glm::dvec3 now = transform ? std::get<rig::Transform>(shape_.value()).translation
                                         : std::get<glm::dvec3>(shape_.value());
        const auto corner = [&](glm::vec3 sides) {
            return glm::vec3(shape_.placed(0.5 * (low + high) + 0.5 * glm::dvec3(sides) * (high - low)));
        };
        twelve_edges(corner, [&](glm::vec3 a, glm::vec3 b, glm::vec3 sides, int axis) {
            bool reached = false;
            for (int other = 0; other < 3; ++other)
                if (other != axis) reached |= now[other] == (sides[other] > 0.0f ? high[other] : low[other]);
            const bool marked = limit_ && reached;
            p_.line(a, b, marked ? 2.5f : 1.0f, marked ? p_.view.palette.limit : pale());
        });
    }

    /// Each circle is grabbed separately and turns about its own axis. They fade while the gizmo is shown.
    void circles() {
        constexpr int sides = 48;
        const glm::vec3 colours[]{p_.view.palette.axis_x, p_.view.palette.axis_y, p_.view.palette.axis_z};
        for (int axis = 0; axis < 3; ++axis) {
            const PickId ring = element_pick(i_, axis);
            const bool lit = p_.view.hovered == ring;
            const glm::vec3 u = size_ * along((axis + 1) % 3), v = size_ * along((axis + 2) % 3);
            const glm::vec3 own = lit ? p_.view.palette.selection : colours[axis];
            const float by = p_.is_active(i_) ? 0.5f : p_.is_selected(i_) ? 0.35f : 0.0f;
            const glm::vec3 paint = glm::mix(own, p_.view.palette.selection, by);
            for (int k = 0; k < sides; ++k) {
                const auto on = [&](int step) {
                    const float angle = glm::two_pi<float>() * static_cast<float>(step) / sides;
                    return at_ + math::cosine(angle) * u + math::sine(angle) * v;
                };
                Stroke& stroke = p_.line(on(k), on(k + 1), lit ? 4.0f : 2.5f, paint, ring);
                stroke.rank = 2;
            }
        }
        knob(5.0f);
    }

    void knob(float pixels) {
        const bool marked = p_.is_lit(i_) || p_.is_selected(i_);
        Stroke& ball = p_.list.sphere(at_, p_.px(marked ? pixels + 1.5f : pixels), Unit::Pixels,
                                      glm::vec4(colour(), 1.0f));
        ball.pick = pick_;
        ball.rank = 3;
        ball.layer = Layer::Overlay;
        if (!p_.is_selected(i_)) return;
        p_.list
            .ring(at_, p_.px(pixels + 5.5f), p_.px(p_.is_active(i_) ? 2.0f : 1.25f),
                  glm::vec4(p_.view.palette.selection, 1.0f))
            .layer = Layer::Overlay;
    }

    glm::vec3 on_rail(double place) const {
        return glm::vec3(shape_.rail_pose().translation) + static_cast<float>(place) * along(0);
    }

    void slider() {
        const Rail rail = rail_of(shape_.control());
        const glm::vec3 y = along(1);
        const auto middle = glm::vec3(shape_.rail_pose().translation);
        const auto on = [&](double place) { return on_rail(place); };
        const double half = 0.5 * Rail::length, knob_at = rail.place(shape_.number());
        const float stop = p_.at_least(0.05f, 5.0f, middle);
        const auto reached = [&](double end) { return limit_ && std::abs(knob_at - end) < 1e-9; };
        line(on(-half), on(half), 3.0f, pale());
        // From 0 to the knob, or from the end nearest to 0: shows the amount.
        const double zero = rail.place(std::clamp(0.0, rail.low, rail.high));
        line(on(zero), on(knob_at), 4.0f, colour());
        for (const double side : {-1.0, 1.0}) {
            const double end = side * half;
            const bool open = side < 0.0 ? rail.open_low : rail.open_high;
            if (open) {
                // An open end is an arrow; a limit has a stop.
                const glm::vec3 tip = on(end + 1.6 * side * static_cast<double>(stop));
                Stroke& head = p_.list.bone(on(end), tip, 0.8f * stop, 0.01f, glm::vec4(pale(), 1.0f));
                head.pick = pick_;
                continue;
            }
            const bool marked = reached(end);
            line(on(end) - stop * y, on(end) + stop * y, marked ? 5.0f : 3.0f,
                 marked ? p_.view.palette.limit : pale());
        }
        for (int tenth = -4; tenth <= 4; ++tenth) {
            const glm::vec3 at = on(0.1 * tenth * Rail::length);
            p_.line(at - 0.45f * stop * y, at + 0.45f * stop * y, 1.0f, pale());
        }
        knob(9.0f);
    }

    void toggle() {
        const float half = p_.at_least(switch_size, 8.0f, at_);
        const auto corner = [&](glm::vec3 sides) {
            return at_ + half * (sides.x * along(0) + sides.y * along(1) + sides.z * along(2));
        };
        if (shape_.on())
            box(p_.list, p_.view.camera, at_, glm::vec3(half), glm::quat(pose_.rotation), colour());
        twelve_edges(corner, [&](glm::vec3 a, glm::vec3 b, glm::vec3, int) {
            if (!shape_.on() || p_.is_selected(i_)) line(a, b, width(), colour());
        });
        Stroke& grip = p_.list.sphere(at_, 1.3f * half, Unit::Metres, catch_only);
        grip.pick = pick_;
        grip.rank = 2;
    }

    /// The ends of the rectangle. An end without a limit is drawn two metres from the other.
    std::pair<glm::dvec3, glm::dvec3> ends() const {
        const rig::Control& control = shape_.control();
        glm::dvec3 low(-1.0), high(1.0);
        if (control.minimum) low = *control.minimum;
        if (control.maximum) high = *control.maximum;
        if (!control.minimum && control.maximum) low = high - 2.0;
        if (!control.maximum && control.minimum) high = low + 2.0;
        return {low, high};
    }
    /// The corner nearest the upper right of the view.
    glm::vec3 corner_of_rectangle() const {
        const auto [low, high] = ends();
        glm::vec3 best = at_;
        float farthest = -1e30f;
        for (const double a : {low.x, high.x}) {
            for (const double b : {low.y, high.y}) {
                const auto corner = glm::vec3(shape_.placed({a, b, 0.0}));
                const float far = glm::dot(corner, p_.view.camera.right() + 2.0f * p_.view.camera.up());
                if (far > farthest) farthest = far, best = corner;
            }
        }
        return best;
    }

    void rectangle() {
        const rig::Control& control = shape_.control();
        const glm::dvec3 now = std::get<glm::dvec3>(shape_.value());
        const auto [low, high] = ends();
        const auto at = [&](double a, double b) { return glm::vec3(shape_.placed({a, b, 0.0})); };
        const auto side = [&](glm::vec3 from, glm::vec3 to, bool there, bool reached) {
            const bool marked = limit_ && there && reached;
            if (there)
                line(from, to, marked ? 4.0f : width(), marked ? p_.view.palette.limit : pale());
            else
                p_.line(from, to, 1.0f, glm::vec3(faded(p_.view.palette, p_.view.palette.text_dim, 0.5f)));
        };
        side(at(low.x, low.y), at(low.x, high.y), control.minimum.has_value(), now.x <= low.x);
        side(at(low.x, low.y), at(high.x, low.y), control.minimum.has_value(), now.y <= low.y);
        side(at(high.x, low.y), at(high.x, high.y), control.maximum.has_value(), now.x >= high.x);
        side(at(low.x, high.y), at(high.x, high.y), control.maximum.has_value(), now.y >= high.y);
        // Cross hairs show both numbers at a glance.
        const glm::vec3 hair = glm::vec3(faded(p_.view.palette, p_.view.palette.target, 0.4f));
        p_.line(at(low.x, now.y), at(high.x, now.y), 1.0f, hair);
        p_.line(at(now.x, low.y), at(now.x, high.y), 1.0f, hair);
        knob(9.0f);
    }

    /// Sliders, switches and rectangles work like a panel, so they always show their name.
    void label() {
        const bool marked = p_.is_lit(i_) || p_.is_active(i_);
        const rig::ControlKind kind = shape_.kind();
        const bool panel = kind == rig::ControlKind::Float || kind == rig::ControlKind::Bool ||
                           kind == rig::ControlKind::Vector2d;
        const bool always = p_.view.workspace.settings.labels == LabelMode::Always;
        if (!marked && !panel && !always && !limit_) return;
        std::string text = p_.name(i_);
        if (panel || (marked && p_.view.dragged != no_pick)) {
            const std::string value = shape_.text();
            if (!value.empty()) text += "  " + value;
        }
        if (kind == rig::ControlKind::Float && !shape_.control().minimum && !shape_.control().maximum)
            text += ", no limits";
        if (limit_) text += ", at its limit";
        // Beside the shape, clear of the gizmo.
        glm::vec3 at = at_;
        if (kind == rig::ControlKind::Float) at = on_rail(0.5 * Rail::length);
        if (kind == rig::ControlKind::Vector2d) at = corner_of_rectangle();
        float clearance = panel && kind != rig::ControlKind::Bool ? 7.0f : 15.0f;
        if (p_.has_gizmo(i_) && !panel) clearance = 84.0f;
        const int rank = marked ? 4 : panel ? 2 : 1;
        p_.label(at, std::move(text), limit_ ? p_.view.palette.limit : p_.view.palette.text, clearance, rank);
    }

    const RigPicture& p_;
    std::size_t i_;
    const ControlShape& shape_;
    rig::Transform pose_;
    glm::vec3 at_;
    bool limit_;
    float size_;  ///< metres
    PickId pick_;
};

}  // namespace

void draw_control(const RigPicture& picture, std::size_t element) {
    if (const auto shape = ControlShape::of(picture.part, picture.elements, element))
        ControlDrawing(picture, element, *shape).run();
}

}  // namespace tendril::app
