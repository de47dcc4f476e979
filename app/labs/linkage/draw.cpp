#include "app/labs/linkage/draw.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/linkage/measures.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

/// The colour of a speed: `share` is 0 (slow) to 1 (fast).
glm::vec3 speed_colour(const Palette& palette, double share) {
    return glm::mix(palette.head, palette.target, static_cast<float>(std::clamp(share, 0.0, 1.0)));
}

class LinkageDrawing {
  public:
    LinkageDrawing(const View& view, DrawList& list)
        : view_(view),
          list_(list),
          part_(linkage_part(view.workspace)),
          runtime_(view.workspace.runtimes.of<LinkageRuntime>(linkage_lab)),
          size_(static_cast<float>(runtime_.solver(part_.shape).size())) {
        if (part_.linkage().links.empty())  // all floats
            for (std::size_t i = 0; i < part_.linkage().points.size(); ++i)
                size_ = std::max(size_, glm::distance(at(0), at(i)));
    }

    void run() {
        path();
        if (part_.shape->in_plane())
            bars(), walker();
        else
            links();
        open_closures();
        dead_point();
        for (std::size_t i = 0; i < part_.linkage().points.size(); ++i) point(i);
        motors();
        targets();
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    glm::vec3 at(std::size_t point) const { return in_scene(part_, part_.at(point)); }
    glm::vec4 opaque(const glm::vec3& colour) const { return glm::vec4(colour, 1.0f); }
    float thick() const { return std::max(0.012f * size_, 1e-4f); }

    void path() {
        const std::vector<PathPoint> path = runtime_.path(part_);
        const double fast = path_speed(path).fast;
        for (std::size_t i = 0; i < path.size(); ++i) {
            const std::size_t next = (i + 1) % path.size();
            if (next == 0 && !runtime_.turn(part_).whole) break;
            const double share = fast > 0.0 ? path[next].speed / fast : 0.0;
            list_.line(in_scene(part_, path[i].at), in_scene(part_, path[next].at), px(2.5f),
                       opaque(speed_colour(view_.palette, share)));
        }
    }

    glm::vec3 motor_colour(const std::string& joint) const {
        const LinkageDrive* const drive = part_.find_drive(joint);
        return drive != nullptr && is_stalled(part_, *drive) ? view_.palette.limit : view_.palette.head;
    }
    /// A bar that a motor turns has the motor's colour.
    glm::vec3 bar_colour(std::size_t bar) const {
        const LinkageShape& shape = *part_.shape;
        if (shape.floating[bar]) return view_.palette.ghost;
        for (const ik::SketchMotor& motor : shape.sketch.motors)
            if (motor.bar == bar) return motor_colour(motor.name);
        return view_.palette.neutral;
    }

    void body(const std::vector<glm::vec3>& places, const glm::vec3& colour) {
        const std::size_t count = places.size();
        const auto rod = [&](std::size_t a, std::size_t b) {
            list_.bone(places[a], places[b], thick(), thick(), opaque(colour)).shadow = true;
        };
        if (count == 2) rod(0, 1);
        if (count < 3) return;
        for (std::size_t i = 0; i < count; ++i) rod(i, (i + 1) % count);
        const std::uint32_t first = list_.veil.next();
        for (const glm::vec3& each : places)
            list_.veil.vertices.push_back(
                {.position = each, .normal = {0, 0, 1}, .colour = colour, .back = colour});
        for (std::uint32_t i = 1; i + 1 < count; ++i) list_.veil.triangle(first, first + i, first + i + 1);
    }

    void bars() {
        const ik::LinkageSketch& sketch = part_.shape->sketch;
        for (std::size_t b = 0; b < sketch.bars.size(); ++b) {
            std::vector<glm::vec3> places;
            for (const std::size_t each : sketch.bars[b].points) places.push_back(at(each));
            body(places, bar_colour(b));
        }
        for (std::size_t i = 0; i < sketch.points.size(); ++i) {
            const ik::SketchPoint& point = sketch.points[i];
            if (point.hold == ik::SketchHold::Pinned) pin(at(i));
            if (point.hold == ik::SketchHold::Guided) rail(at(i), guide_direction(point));
        }
    }

    /// The other legs, and the marks on the ground that move beneath them.
    void walker() {
        if (part_.copies.empty()) return;
        for (const LinkageCopy& copy : part_.copies)
            for (const ik::SketchBar& bar : part_.shape->sketch.bars) {
                std::vector<glm::vec3> places;
                for (const std::size_t each : bar.points)
                    places.push_back(in_scene(part_, part_.at(each, copy)));
                body(places, copy.mirrored ? view_.palette.tail : view_.palette.neutral);
            }
        const auto back = static_cast<float>(part_.copies.back().depth);
        const float apart = 0.5f * size_, shift = static_cast<float>(std::fmod(part_.walked, double(apart)));
        for (int i = -6; i <= 6; ++i) {
            const float x = apart * static_cast<float>(i) - shift;
            list_.line({x, 0, back - 0.3f * size_}, {x, 0, 0.3f * size_}, px(1.5f),
                       opaque(view_.palette.grid));
        }
    }

    /// The usual ground symbol of mechanism drawings: a triangle on a line.
    void pin(const glm::vec3& at) {
        const float unit = px(9.0f) * view_.camera.metres_per_pixel(at);
        const glm::vec3 left = at + unit * glm::vec3(-1.0f, -1.7f, 0),
                        right = at + unit * glm::vec3(1, -1.7f, 0);
        const glm::vec4 colour = opaque(view_.palette.target);
        list_.line(at, left, px(2.0f), colour);
        list_.line(at, right, px(2.0f), colour);
        list_.line(left - glm::vec3(0.6f * unit, 0, 0), right + glm::vec3(0.6f * unit, 0, 0), px(2.0f),
                   colour);
    }
    void rail(const glm::vec3& at, const glm::dvec2& along) {
        const glm::vec3 way(along, 0.0f), side(-way.y, way.x, 0.0f);
        const float unit = px(9.0f) * view_.camera.metres_per_pixel(at);
        const glm::vec4 colour = opaque(view_.palette.target);
        for (const float by : {-1.0f, 1.0f})
            list_.line(at + by * unit * side - 4.0f * unit * way, at + by * unit * side + 4.0f * unit * way,
                       px(1.5f), colour);
    }

    void links() {
        for (std::size_t i = 0; i < part_.linkage().links.size(); ++i) {
            const std::string& name = part_.linkage().links[i].name;
            body(places_on(part_, i),
                 part_.find_drive(name) != nullptr ? motor_colour(name) : view_.palette.neutral);
        }
        body(places_on(part_, ik::ground_link), view_.palette.target);
    }

    void dead_point() {
        if (part_.result.report.status != ik::LinkageStatus::DeadPoint) return;
        if (const auto found = app::dead_point(part_, runtime_))
            for (const auto& [from, to] : found->lines)
                list_.line(at(from), at(to), px(2.0f), opaque(view_.palette.limit)).layer = Layer::Overlay;
    }

    void open_closures() {
        for (const std::size_t each : part_.result.open_closures) {
            const ik::Closure& closure = part_.linkage().closures[each];
            const auto end = [&](std::size_t link, const glm::dvec3& drawn) {
                return in_scene(part_, link == ik::ground_link ? drawn : part_.links[link].point(drawn));
            };
            const glm::vec3 a = end(closure.first, closure.first_at),
                            b = end(closure.second, closure.second_at);
            list_.line(a, b, px(2.0f), opaque(view_.palette.limit)).layer = Layer::Overlay;
            for (const glm::vec3& ring : {a, b})
                list_.ring(ring, px(10.0f), px(2.0f), opaque(view_.palette.limit)).layer = Layer::Overlay;
        }
    }

    void point(std::size_t i) {
        const ik::LinkPoint& of = part_.linkage().points[i];
        const PickId pick = linkage_pick(i);
        const bool lit = view_.hovered == pick || view_.dragged == pick,
                   selected = view_.handles && part_.selected == of.name;
        const bool plane = part_.shape->in_plane();  // floating points are on the ground link, unpinned
        const bool held =
            plane ? part_.shape->sketch.points[i].hold == ik::SketchHold::Pinned : of.link == ik::ground_link;
        const glm::vec3 colour = selected ? view_.palette.selection
                                 : held   ? view_.palette.target
                                          : view_.palette.joint;
        Stroke& ball = list_.sphere(at(i), px(lit ? 7.5f : 6.0f), Unit::Pixels, opaque(colour));
        ball.pick = pick;
        ball.rank = held ? 1 : 2;
        // Messages and the card refer to joints by name, so the picture names them too if there is room.
        constexpr std::size_t few = 8;
        const bool room = part_.copies.empty() && part_.linkage().points.size() <= few;
        const bool named = lit || room || view_.workspace.settings.labels == LabelMode::Always;
        const std::string speed = lit ? point_speed_text(part_, of.name, runtime_) : "";
        if (named)
            list_.labels.push_back({.at = at(i),
                                    .clearance = px(12.0f),
                                    .text = of.name + (speed.empty() ? "" : ", " + speed),
                                    .colour = view_.palette.text,
                                    .rank = lit ? 1 : 0});
    }

    void motors() {
        for (const LinkageDrive& each : part_.drives) {
            const std::size_t link = *part_.linkage().find_link(each.joint);
            const ik::Link& of = part_.linkage().links[link];
            const glm::dvec3 drawn =
                of.parent == ik::ground_link ? of.at : part_.links[of.parent].point(of.at);
            list_.ring(in_scene(part_, drawn), px(13.0f), px(each.rate != 0.0 ? 3.5f : 2.0f),
                       opaque(motor_colour(each.joint)));
        }
        for (const ik::SketchMotor& each : part_.shape->sketch.motors)
            if (each.against != ik::ground_link && part_.find_drive(each.name) != nullptr)
                driven_angle(each, opaque(motor_colour(each.name)));
    }

    /// The arc between a motor's two bars.
    void driven_angle(const ik::SketchMotor& motor, const glm::vec4& colour) {
        const ik::LinkageSketch& sketch = part_.shape->sketch;
        const glm::vec3 about = at(motor.point);
        const auto direction = [&](std::size_t bar) {
            const auto& points = sketch.bars[bar].points;
            const glm::vec3 along = at(points[0] == motor.point ? points[1] : points[0]) - about;
            return math::arctangent(along.y, along.x);
        };
        constexpr int sides = 32;
        const float radius = px(26.0f) * view_.camera.metres_per_pixel(about),
                    from = direction(motor.against);
        float angle = direction(motor.bar) - from;
        if (angle < 0.0f) angle += glm::radians(360.0f);
        const auto end = [&](int i) {
            const float turned = from + angle * static_cast<float>(i) / sides;
            return about + radius * glm::vec3(math::cosine(turned), math::sine(turned), 0.0f);
        };
        for (int i = 0; i < sides; ++i) list_.line(end(i), end(i + 1), px(2.0f), colour);
    }

    void targets() {
        const auto draw = [&](const LinkageTarget& target, PickId pick) {
            const glm::vec3 to = in_scene(part_, target.to);
            list_.line(at(*part_.linkage().find_point(target.point)), to, px(1.5f),
                       opaque(view_.palette.target));
            Stroke& ball = list_.sphere(to, px(view_.hovered == pick ? 8.5f : 7.0f), Unit::Pixels,
                                        opaque(view_.palette.target));
            ball.pick = pick;
            ball.rank = 3;
        };
        if (part_.drag) draw(*part_.drag, no_pick);
        for (std::size_t i = 0; i < part_.targets.size(); ++i) draw(part_.targets[i], linkage_target_pick(i));
    }

    const View& view_;
    DrawList& list_;
    const LinkagePart& part_;
    LinkageRuntime& runtime_;
    float size_ = 1.0f;
};

}  // namespace

PathSpeed path_speed(const std::vector<PathPoint>& path) {
    double highest = 0.0, length = 0.0, seconds = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        if (!(path[i].speed > 0.0)) continue;
        const double far = glm::distance(path[i].at, path[i - 1].at);
        highest = std::max(highest, path[i].speed);
        length += far;
        seconds += far / path[i].speed;
    }
    if (!(seconds > 0.0)) return {};
    const double most = 3.0 * length / seconds;
    return {std::min(highest, most), highest > most};
}

glm::vec3 in_scene(const LinkagePart& part, const glm::dvec3& at) {
    if (!part.shape->in_plane()) return glm::vec3(at.x, at.z, -at.y);
    return glm::vec3(at.x, at.y - part.lowest_foot(), at.z);  // a walker stands on the ground
}

glm::vec3 from_scene(const LinkagePart& part, const glm::vec3& at) {
    if (!part.shape->in_plane()) return {at.x, -at.z, at.y};
    return at + glm::vec3(0.0f, static_cast<float>(part.lowest_foot()), 0.0f);
}

std::vector<glm::vec3> places_on(const LinkagePart& part, std::size_t link) {
    const ik::Linkage& linkage = part.linkage();
    std::vector<glm::vec3> places;
    const auto add = [&](const glm::dvec3& drawn) {
        const glm::vec3 at = in_scene(part, link == ik::ground_link ? drawn : part.links[link].point(drawn));
        const auto same = [&](const glm::vec3& other) { return glm::distance(at, other) < 1e-6f; };
        if (std::ranges::none_of(places, same)) places.push_back(at);
    };
    if (link != ik::ground_link) {
        const ik::Link& own = linkage.links[link];
        // A slider's link begins at the point it slides from.
        if (own.joint == ik::LinkJoint::Slider) {
            const bool grounded = own.parent == ik::ground_link;
            places.push_back(in_scene(part, grounded ? own.at : part.links[own.parent].point(own.at)));
        }
        add(own.at);
    }
    for (const ik::Link& each : linkage.links)
        if (each.parent == link) add(each.at);
    for (const ik::Closure& each : linkage.closures) {
        if (each.first == link) add(each.first_at);
        if (each.second == link) add(each.second_at);
    }
    return places;
}

Bounds linkage_bounds(const Workspace& workspace) {
    const LinkagePart& part = linkage_part(workspace);
    glm::vec3 low(1e30f), high(-1e30f);
    const auto take = [&](const glm::dvec3& point) {
        const glm::vec3 at = in_scene(part, point);
        low = glm::min(low, at), high = glm::max(high, at);
    };
    const std::size_t count = part.linkage().points.size();
    for (std::size_t i = 0; i < count; ++i) take(part.at(i));
    for (const LinkageCopy& copy : part.copies)
        for (std::size_t i = 0; i < count; ++i) take(part.at(i, copy));
    PartInTurn in_turn(part);
    LinkageRuntime fresh;  // depends only on the pose, since the camera follows it
    for (const LinkageTurn::Pose& pose : fresh.turn(part).poses)
        for (std::size_t i = 0; i < count; ++i) take(in_turn.at(pose)->at(i));
    for (const LinkageTarget& each : part.targets) take(each.to);
    if (low.x > high.x) low = glm::vec3(-2.0f), high = glm::vec3(2.0f);
    return bounds_of(low, high, 0.1f);
}

namespace {

constexpr float room_to_move = 1.1f;

CameraPose& linkage_camera(Workspace& workspace) {
    return workspace.lab == linkage_lab ? workspace.camera : workspace.cameras[linkage_lab];
}

Rect linkage_view(const Workspace& workspace) {
    return {glm::vec2(0.0f), workspace.ui.view_size};
}

}  // namespace

void look_at_linkage(Workspace& workspace) {
    const LinkagePart& part = linkage_part(workspace);
    const Bounds all = linkage_bounds(workspace);
    CameraPose from;
    if (part.shape->in_plane() && part.copies.empty()) {
        from.orthographic = true;
    } else {
        from.yaw = 0.6f, from.pitch = 0.3f;
    }
    linkage_camera(workspace) = framed(from, linkage_view(workspace), all.centre, room_to_move * all.radius);
}

void keep_linkage_in_view(Workspace& workspace) {
    const Bounds all = linkage_bounds(workspace);
    CameraPose& pose = linkage_camera(workspace);
    const Rect view = linkage_view(workspace);
    const Camera camera(pose, view);
    const auto centre = camera.project(all.centre);
    const glm::vec2 reach(all.radius / camera.metres_per_pixel(all.centre));
    if (centre && view.contains(*centre - reach) && view.contains(*centre + reach)) return;
    pose = framed(pose, view, all.centre, room_to_move * all.radius);
}

void LinkageLab::draw(const View& view, DrawList& list) const {
    draw_past_ghosts(view, linkage_past(), list);
    LinkageDrawing(view, list).run();
}

std::vector<LegendRow> LinkageLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    std::vector<LegendRow> rows{{"pinned", colours.target}, {"motor", colours.head, true}};
    const LinkagePart& part = linkage_part(workspace);
    auto& runtime = workspace.runtimes.of<LinkageRuntime>(linkage_lab);
    const PathSpeed speed = path_speed(runtime.path(part));
    if (speed.fast > 0.0) {
        rows.push_back({"path, slow", speed_colour(colours, 0.0)});
        rows.push_back({(speed.exceeded ? "path, over " : "path, ") + speed_text(part, speed.fast, runtime),
                        speed_colour(colours, 1.0)});
    }
    add_ghost_legend(workspace, linkage_past(), rows);
    return rows;
}

}  // namespace tendril::app
