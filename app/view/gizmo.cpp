#include "app/view/gizmo.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "app/view/surfaces.hpp"

namespace tendril::app {
namespace {

// Pixels from the centre, which is left free for the object.
constexpr float ring_radius = 78.0f;
constexpr float middle_radius = 9.0f;
constexpr float arrow_from = 16.0f, cone_length = 17.0f, cone_radius = 6.0f;
constexpr float tip_alone = 92.0f, tip_beyond_rings = 112.0f;
constexpr float box_half = 5.0f, box_alone = 82.0f, box_within = 56.0f;
constexpr float plane_low = 22.0f, plane_high = 38.0f;
constexpr std::int16_t gizmo_rank = 200;
constexpr int ring_sides = 96;
constexpr glm::vec4 transparent{0.0f};  ///< for strokes that only serve picking

constexpr std::array<const char*, gizmo_parts> names{"move_x",   "move_y",  "move_z",   "move_yz",
                                                     "move_zx",  "move_xy", "rotate_x", "rotate_y",
                                                     "rotate_z", "scale_x", "scale_y",  "scale_z"};

glm::vec3 axis_of(const HandleFrame& frame, int axis) {
    glm::vec3 v(0.0f);
    v[axis % 3] = 1.0f;
    return glm::normalize(frame.rotation) * v;
}

glm::vec3 sight_to(glm::vec3 point, const Camera& camera) {
    return camera.pose().orthographic ? camera.forward() : glm::normalize(point - camera.eye());
}

glm::vec3 on_ring(const HandleFrame& frame, int axis, float radius, float angle) {
    return frame.position +
           radius * (std::cos(angle) * axis_of(frame, axis + 1) + std::sin(angle) * axis_of(frame, axis + 2));
}

float ring_angle(int side) {
    return glm::two_pi<float>() * static_cast<float>(side) / static_cast<float>(ring_sides);
}

constexpr float min_slant = 0.1f;   ///< sine of the slant below which an axis or plane drag is linear
constexpr float ring_slant = 0.3f;  ///< sine of the slant below which a ring is pulled like a rope
constexpr float min_factor = 0.01f;

bool finite(glm::vec3 v) {
    return std::isfinite(v.x + v.y + v.z) && glm::dot(v, v) < 1e30f;
}

glm::quat valid_rotation(const glm::quat& rotation) {
    const float length = glm::length(rotation);
    return length > 1e-6f && length < 1e6f ? rotation / length : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
}

glm::vec3 unit_axis(int axis) {
    glm::vec3 v(0.0f);
    v[axis] = 1.0f;
    return v;
}

std::string formatted(const char* format, double a, double b = 0.0) {
    const auto clean = [](double value) { return std::abs(value) < 5e-4 ? 0.0 : value; };  // no "-0.00"
    char text[64];
    std::snprintf(text, sizeof text, format, clean(a), clean(b));
    return text;
}

}  // namespace

const char* name(GizmoPart part) {
    return names[static_cast<std::size_t>(part)];
}
Drag changed_by(GizmoPart part) {
    return part <= GizmoPart::MoveXY    ? Drag::Position
           : part <= GizmoPart::RotateZ ? Drag::Rotation
                                        : Drag::Scale;
}
bool is_plane(GizmoPart part) {
    return part >= GizmoPart::MoveYZ && part <= GizmoPart::MoveXY;
}
int axis_of(GizmoPart part) {
    return static_cast<int>(part) % 3;
}
std::optional<GizmoPart> picked_part(PickId pick) {
    if (pick < first_gizmo_pick || pick >= first_gizmo_pick + gizmo_parts) return std::nullopt;
    return static_cast<GizmoPart>(pick - first_gizmo_pick);
}

float Gizmo::reach(Drag of, const Camera& camera) const {
    float pixels = ring_radius;
    if (of == Drag::Position) pixels = has(what, Drag::Rotation) ? tip_beyond_rings : tip_alone;
    if (of == Drag::Scale) pixels = what == Drag::Scale ? box_alone : box_within;
    return pixels * scale * camera.metres_per_pixel(frame.position);
}

std::vector<GizmoPart> Gizmo::parts(const Camera& camera) const {
    constexpr float thinnest = 0.17f;  // sine of the angle to the line of sight
    std::vector<GizmoPart> list;
    const glm::vec3 sight = sight_to(frame.position, camera);
    for (int i = 0; i < gizmo_parts; ++i) {
        const auto part = static_cast<GizmoPart>(i);
        if (!has(what, changed_by(part))) continue;
        const float along = std::abs(glm::dot(sight, axis_of(frame, app::axis_of(part))));
        const float across = std::sqrt(std::max(1.0f - along * along, 0.0f));
        if (changed_by(part) == Drag::Rotation || (is_plane(part) ? along : across) >= thinnest)
            list.push_back(part);
    }
    return list;
}

std::vector<glm::vec3> Gizmo::grips(GizmoPart part, const Camera& camera) const {
    const float pixel = scale * camera.metres_per_pixel(frame.position);
    const int axis = app::axis_of(part);
    if (is_plane(part)) {
        const float half_way = 0.5f * (plane_low + plane_high) * pixel;
        return {frame.position + half_way * (axis_of(frame, axis + 1) + axis_of(frame, axis + 2))};
    }
    const float far = reach(changed_by(part), camera);
    if (changed_by(part) == Drag::Position)
        return {frame.position + (far - 0.6f * cone_length * pixel) * axis_of(frame, axis)};
    if (changed_by(part) == Drag::Scale) return {frame.position + far * axis_of(frame, axis)};
    // For a ring, the half that faces the eye, from its middle to its ends.
    const glm::vec3 sight = sight_to(frame.position, camera);
    std::vector<glm::vec3> points;
    for (int i = 0; i < ring_sides; ++i) points.push_back(on_ring(frame, axis, far, ring_angle(i) + 0.02f));
    std::erase_if(points, [&](glm::vec3 p) { return glm::dot(p - frame.position, sight) > 0.0f; });
    std::sort(points.begin(), points.end(),
              [&](glm::vec3 a, glm::vec3 b) { return glm::dot(a, sight) < glm::dot(b, sight); });
    return points;
}

namespace {

class Drawing {
  public:
    Drawing(DrawList& list, const Gizmo& gizmo, const Camera& camera, const Palette& palette,
            std::optional<GizmoPart> lit, const GizmoDrag* drag)
        : list_(list),
          gizmo_(gizmo),
          camera_(camera),
          palette_(palette),
          lit_(lit),
          drag_(drag),
          centre_(gizmo.frame.position),
          pixel_(gizmo.scale * camera.metres_per_pixel(centre_)) {}

    void run() {
        if (drag_ != nullptr) {
            dragged();
            return;
        }
        if (has(gizmo_.what, Drag::Rotation)) {
            Stroke& rim = list_.ring(centre_, gizmo_.scale * ring_radius, px(1.0f),
                                     faded(palette_, palette_.text_dim, 0.35f));
            rim.layer = Layer::Overlay;
            rim.rank = gizmo_rank - 20;
        }
        for (const GizmoPart part : gizmo_.parts(camera_)) draw(part);
        Stroke& middle = list_.sphere(centre_, px(middle_radius), Unit::Pixels, transparent);
        middle.pick = gizmo_.middle;
        middle.layer = Layer::Overlay;
        middle.rank = gizmo_rank + 20;
    }

  private:
    float px(float pixels) const { return pixels * gizmo_.scale; }
    glm::vec3 axis(int of) const { return axis_of(gizmo_.frame, of); }
    bool lit(GizmoPart part) const { return lit_ == part; }
    glm::vec3 colour(GizmoPart part) const {
        const std::array<glm::vec3, 3> axes{palette_.axis_x, palette_.axis_y, palette_.axis_z};
        return lit(part) ? palette_.selection : axes[static_cast<std::size_t>(app::axis_of(part))];
    }

    Stroke& over(Stroke& stroke, GizmoPart part, int rank) {
        stroke.layer = Layer::Overlay;
        stroke.rank = static_cast<std::int16_t>(gizmo_rank + rank);
        stroke.pick = gizmo_pick(part);
        return stroke;
    }

    void draw(GizmoPart part) {
        if (is_plane(part)) {
            plane(part);
        } else if (changed_by(part) == Drag::Position) {
            arrow(part);
        } else if (changed_by(part) == Drag::Rotation) {
            ring(part);
        } else {
            box_at_end(part);
        }
    }

    void arrow(GizmoPart part) {
        const glm::vec3 along = axis(app::axis_of(part));
        const float tip = gizmo_.reach(Drag::Position, camera_), cone = tip - cone_length * pixel_;
        // If the axis also has a scale box, the box is picked inside the rings and the arrow outside.
        const float from = has(gizmo_.what, Drag::Scale) ? ring_radius : arrow_from;
        const glm::vec4 paint(colour(part), 1.0f);
        const float width = px(lit(part) ? 4.0f : 3.0f);
        over(list_.line(centre_ + arrow_from * pixel_ * along, centre_ + cone * along, width, paint), part, 4)
            .pick = no_pick;
        over(list_.line(centre_ + from * pixel_ * along, centre_ + cone * along, px(9.0f), transparent), part,
             4);
        Stroke& head = list_.bone(centre_ + cone * along, centre_ + tip * along,
                                  px(lit(part) ? cone_radius + 1.0f : cone_radius), px(0.5f), paint);
        head.unit = Unit::Pixels;
        over(head, part, 6);
    }

    void ring(GizmoPart part) {
        const int about = app::axis_of(part);
        const float radius = gizmo_.reach(Drag::Rotation, camera_);
        const glm::vec3 sight = sight_to(centre_, camera_);
        const glm::vec4 near_side(colour(part), 1.0f), far_side = faded(palette_, colour(part), 0.4f);
        for (int i = 0; i < ring_sides; ++i) {
            const glm::vec3 a = on_ring(gizmo_.frame, about, radius, ring_angle(i));
            const glm::vec3 b = on_ring(gizmo_.frame, about, radius, ring_angle(i + 1));
            // With this tolerance, a ring that faces the eye counts as near all round.
            const bool hidden = glm::dot(0.5f * (a + b) - centre_, sight) > 0.02f * radius;
            Stroke& stroke = list_.line(a, b,
                                        px(hidden      ? 1.5f
                                           : lit(part) ? 4.0f
                                                       : 3.0f),
                                        hidden ? far_side : near_side);
            over(stroke, part, hidden ? -10 : 2);
            if (hidden) stroke.pick = no_pick;
        }
    }

    void box_at_end(GizmoPart part) {
        const glm::vec3 along = axis(app::axis_of(part)),
                        at = centre_ + gizmo_.reach(Drag::Scale, camera_) * along;
        const glm::vec4 paint(colour(part), 1.0f);
        if (!has(gizmo_.what, Drag::Position))
            over(list_.line(centre_ + arrow_from * pixel_ * along, at, px(3.0f), paint), part, 4);
        solid(at, (lit(part) ? box_half + 1.0f : box_half) * pixel_, colour(part));
        over(list_.sphere(at, px(box_half + 3.0f), Unit::Pixels, transparent), part, 6);
    }

    /// A cube in the overlay, with the same soft edges as in the scene.
    void solid(glm::vec3 at, float half, glm::vec3 paint) {
        DrawList cube;
        box(cube, camera_, at, glm::vec3(half), gizmo_.frame.rotation, paint);
        const std::uint32_t first = list_.overlay.next();
        list_.overlay.vertices.insert(list_.overlay.vertices.end(), cube.mesh.vertices.begin(),
                                      cube.mesh.vertices.end());
        for (const std::uint32_t index : cube.mesh.indices) list_.overlay.indices.push_back(first + index);
        for (Stroke& edge : cube.strokes) {
            if (edge.shade != Shade::Edge) continue;
            edge.layer = Layer::Overlay;
            edge.rank = gizmo_rank + 5;
            list_.strokes.push_back(edge);
        }
    }

    void plane(GizmoPart part) {
        const int upright = app::axis_of(part);
        const glm::vec3 u = pixel_ * axis(upright + 1), v = pixel_ * axis(upright + 2);
        const auto at = [&](float a, float b) { return centre_ + a * u + b * v; };
        const std::array<glm::vec3, 4> corners{at(plane_low, plane_low), at(plane_high, plane_low),
                                               at(plane_high, plane_high), at(plane_low, plane_high)};
        const std::uint32_t first = list_.overlay.next();
        const glm::vec3 fill = glm::vec3(faded(palette_, colour(part), 0.6f));
        for (const glm::vec3 corner : corners)
            list_.overlay.vertices.push_back({corner, axis(upright), fill, fill});
        list_.overlay.triangle(first, first + 1, first + 2);
        list_.overlay.triangle(first, first + 2, first + 3);
        for (std::size_t i = 0; i < corners.size(); ++i)
            over(list_.line(corners[i], corners[(i + 1) % 4], px(lit(part) ? 2.5f : 1.5f),
                            glm::vec4(colour(part), 1.0f)),
                 part, 8);
        const float middle = 0.5f * (plane_low + plane_high);
        const float radius = 0.5f * (plane_high - plane_low);
        over(list_.sphere(at(middle, middle), px(radius), Unit::Pixels, transparent), part, 8);
    }

    void dragged() {
        const GizmoPart part = drag_->part();
        lit_ = part;
        if (changed_by(part) == Drag::Rotation) {
            ring(part);
            swept(part);
            return;
        }
        const int upright = app::axis_of(part);
        if (!is_plane(part)) drawn_out(upright);
        if (is_plane(part)) drawn_out(upright + 1), drawn_out(upright + 2);
        draw(part);
    }

    /// A line along the whole axis, through the drag's start.
    void drawn_out(int of) {
        const std::array<glm::vec3, 3> axes{palette_.axis_x, palette_.axis_y, palette_.axis_z};
        const glm::vec3 along = 2000.0f * pixel_ * axis(of);
        Stroke& line = list_.line(drag_->from().position - along, drag_->from().position + along, px(1.0f),
                                  glm::vec4(axes[static_cast<std::size_t>(of % 3)], 1.0f));
        line.layer = Layer::Overlay;
        line.rank = gizmo_rank - 20;
    }

    /// Two spokes, where the ring was caught and where that point is now, and the arc between them.
    void swept(GizmoPart part) {
        const int about = app::axis_of(part);
        const float radius = gizmo_.reach(Drag::Rotation, camera_);
        HandleFrame still = drag_->from();
        still.position = centre_;
        const auto from = static_cast<float>(drag_->caught_at());
        const auto round = static_cast<double>(glm::two_pi<float>());
        const auto by = static_cast<float>(std::clamp(drag_->turned(), -round, round));
        const auto line = [&](glm::vec3 a, glm::vec3 b, float width, glm::vec4 paint) {
            over(list_.line(a, b, px(width), paint), part, 8);
        };
        const glm::vec4 pale = faded(palette_, palette_.selection, 0.7f), full(palette_.selection, 1.0f);
        line(centre_, on_ring(still, about, radius, from), 1.5f, pale);
        line(centre_, on_ring(still, about, radius, from + by), 2.0f, full);
        constexpr int steps = 64;
        for (int i = 0; i < steps; ++i) {
            const float a = from + by * static_cast<float>(i) / steps;
            const float b = from + by * static_cast<float>(i + 1) / steps;
            line(on_ring(still, about, 0.35f * radius, a), on_ring(still, about, 0.35f * radius, b), 2.5f,
                 full);
        }
    }

    DrawList& list_;
    const Gizmo& gizmo_;
    const Camera& camera_;
    const Palette& palette_;
    std::optional<GizmoPart> lit_;
    const GizmoDrag* drag_;
    glm::vec3 centre_;
    float pixel_;  ///< metres
};

}  // namespace

void draw_gizmo(DrawList& list, const Gizmo& gizmo, const Camera& camera, const Palette& palette,
                std::optional<GizmoPart> lit, const GizmoDrag* drag) {
    const glm::vec3 at = gizmo.frame.position;
    if (!(glm::dot(at, at) < 1e18f) || !camera.project(at)) return;
    Drawing(list, gizmo, camera, palette, lit, drag).run();
}

GizmoDrag::GizmoDrag(GizmoPart part, const HandleFrame& frame, const Ray& caught, float reach,
                     bool orthographic)
    : part_(part), from_(frame), reach_(reach > 1e-9f && std::isfinite(reach) ? reach : 1.0f) {
    from_.rotation = valid_rotation(frame.rotation);
    if (!finite(from_.position)) from_.position = glm::vec3(0.0f);
    last_ = from_;
    const int axis = axis_of(part);
    axis_ = from_.rotation * unit_axis(axis);
    u_ = from_.rotation * unit_axis((axis + 1) % 3);
    v_ = from_.rotation * unit_axis((axis + 2) % 3);
    const glm::vec3 way = from_.position - caught.origin;
    const float direction = glm::length(caught.direction);
    sight_ = finite(caught.direction) && direction > 1e-6f ? caught.direction / direction
                                                           : glm::vec3(0.0f, 0.0f, -1.0f);
    if (!orthographic && finite(way) && glm::length(way) > 1e-6f) {
        distance_ = glm::length(way);
        inverse_distance_ = 1.0f / distance_;
        sight_ = way / distance_;
    }
    edge_on_ = std::abs(glm::dot(sight_, axis_)) < ring_slant;
    const glm::vec3 at = facing(caught).value_or(glm::vec3(0.0f));
    caught_ = measured(at);
    last_angle_ = caught_.x;
    const glm::vec3 nearest = -(sight_ - glm::dot(sight_, axis_) * axis_);
    caught_at_ = edge_on_ ? std::atan2(glm::dot(nearest, v_), glm::dot(nearest, u_)) : caught_.x;
}

/// The point where a line of sight meets the plane that faces the eye, relative to the centre.
std::optional<glm::vec3> GizmoDrag::facing(const Ray& ray) const {
    if (!finite(ray.origin) || !finite(ray.direction)) return std::nullopt;
    glm::vec3 at;
    if (inverse_distance_ == 0.0f) {
        at = ray.origin - from_.position;
        at -= glm::dot(at, sight_) * sight_;
    } else {
        const float towards = glm::dot(ray.direction, sight_);
        if (!(towards > 0.05f * glm::length(ray.direction))) return std::nullopt;
        at = distance_ * (ray.direction / towards - sight_);
    }
    return finite(at) ? std::optional(at) : std::nullopt;
}

/// A point at distance t along an axis of slant p appears at m = t p / (1 + t a / d) in the plane that faces
/// the eye; a is the axis's component away from the eye, d the distance to the eye. Solves for t.
float GizmoDrag::along_axis(glm::vec3 at, glm::vec3 axis) const {
    const float away = glm::dot(axis, sight_);
    const glm::vec3 across = axis - away * sight_;
    const float slant = glm::length(across);
    if (slant < 1e-6f) return 0.0f;
    const float seen = glm::dot(at, across) / slant;
    return seen / std::max(slant - seen * away * inverse_distance_, min_slant);
}

/// The point where the line of sight through `at` meets the part's plane.
glm::vec2 GizmoDrag::in_plane(glm::vec3 at) const {
    const float height = glm::dot(at, axis_), upright = glm::dot(sight_, axis_);
    const float side = upright < 0.0f ? -1.0f : 1.0f;
    const float slant = side * std::max(side * (upright + height * inverse_distance_), min_slant);
    const glm::vec3 met = at - height / slant * (sight_ + inverse_distance_ * at);
    return {glm::dot(met, u_), glm::dot(met, v_)};
}

/// Radians about the axis. An edge-on ring rotates by as much as its near side is pulled.
float GizmoDrag::about_axis(glm::vec3 at) const {
    if (!edge_on_) {
        const glm::vec2 met = in_plane(at);
        return glm::length(met) > 1e-6f * reach_ ? std::atan2(met.y, met.x) : last_angle_;
    }
    const glm::vec3 nearest = -(sight_ - glm::dot(sight_, axis_) * axis_);
    return glm::dot(at, glm::normalize(glm::cross(axis_, nearest))) / reach_;
}

glm::vec2 GizmoDrag::measured(glm::vec3 at) const {
    if (is_plane(part_)) return in_plane(at);
    return {changed_by(part_) == Drag::Rotation ? about_axis(at) : along_axis(at, axis_), 0.0f};
}

HandleFrame GizmoDrag::changed(const HandleFrame& now, const HandleFrame& dragged) const {
    HandleFrame frame = now;
    const glm::vec3 by = dragged.position - now.position;
    if (is_plane(part_))
        frame.position += glm::dot(by, u_) * u_ + glm::dot(by, v_) * v_;
    else if (changed_by(part_) == Drag::Position)
        frame.position += glm::dot(by, axis_) * axis_;
    else if (changed_by(part_) == Drag::Scale)
        frame.scale[axis_of(part_)] = dragged.scale[axis_of(part_)];
    else
        frame.rotation = dragged.rotation;
    return frame;
}

HandleFrame GizmoDrag::to(const Ray& ray) {
    const auto at = facing(ray);
    if (!at) return last_;
    const glm::vec2 now = measured(*at), by = now - caught_;
    if (!std::isfinite(now.x + now.y)) return last_;
    HandleFrame frame = from_;
    if (is_plane(part_)) {
        frame.position += by.x * u_ + by.y * v_;
    } else if (changed_by(part_) == Drag::Position) {
        frame.position += by.x * axis_;
    } else if (changed_by(part_) == Drag::Scale) {
        frame.scale[axis_of(part_)] *= std::max(1.0f + by.x / reach_, min_factor);
    } else {
        constexpr double round = 2.0 * glm::pi<double>();
        const double step = static_cast<double>(now.x) - static_cast<double>(last_angle_);
        turned_ += edge_on_ ? step : std::remainder(step, round);
        last_angle_ = now.x;
        const auto angle = static_cast<float>(std::remainder(turned_, round));
        frame.rotation = glm::normalize(from_.rotation * glm::angleAxis(angle, unit_axis(axis_of(part_))));
    }
    if (finite(frame.position) && finite(frame.scale)) last_ = frame;
    return last_;
}

std::string GizmoDrag::text(const HandleFrame& now) const {
    constexpr const char* axes[] = {"X", "Y", "Z"};
    constexpr const char* planes[] = {"YZ", "ZX", "XY"};
    const int axis = axis_of(part_);
    const glm::vec3 by = now.position - from_.position;
    if (is_plane(part_))
        return formatted("%.2f, %.2f m in ", glm::dot(by, u_), glm::dot(by, v_)) + planes[axis];
    switch (changed_by(part_)) {
        case Drag::Position:
            return formatted("%.2f m along ", glm::dot(by, axis_)) + axes[axis];
        case Drag::Rotation:
            return formatted("%.1f\u00b0 about ", glm::degrees(turned_)) + axes[axis];
        default:
            return formatted("%.2f times along ", now.scale[axis] / from_.scale[axis]) + axes[axis];
    }
}

}  // namespace tendril::app
