#include "app/view/surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace tendril::app {
namespace {

/// A face of the box.
struct Face {
    glm::vec3 centre{0.0f}, normal{0.0f}, u{0.0f},
        v{0.0f};  ///< u and v: from the centre to its edges; u x v ~ normal
    bool front = false;
};

void shadow_of_box(DrawList& list, glm::vec3 centre, std::array<glm::vec3, 3> axes) {
    // Bars along the longest axis, side by side along the second.
    std::sort(axes.begin(), axes.end(),
              [](glm::vec3 a, glm::vec3 b) { return glm::length(a) > glm::length(b); });
    const float lengths[]{glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2])};
    const float radius = std::max(lengths[2], lengths[1] / 8.0f);
    const int bars = lengths[1] > 1.5f * radius ? static_cast<int>(std::ceil(lengths[1] / radius)) : 1;
    const float inner = 1.0f - std::min(radius / std::max(lengths[0], 1e-30f), 1.0f);
    for (int i = 0; i < bars; ++i) {
        const float across = (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(bars) - 1.0f;
        const glm::vec3 middle = centre + across * axes[1];
        cast(list, middle - inner * axes[0], middle + inner * axes[0], radius);
    }
}

constexpr std::uint32_t rows = 38, columns = 64;  ///< rows and columns of points, without the two poles

using Triangle = std::array<std::uint32_t, 3>;

glm::vec3 on_ball(std::uint32_t row, std::uint32_t column) {
    const float down = glm::pi<float>() * static_cast<float>(row + 1) / static_cast<float>(rows + 1);
    const float round = glm::two_pi<float>() * static_cast<float>(column) / static_cast<float>(columns);
    return {std::sin(down) * std::cos(round), std::cos(down), std::sin(down) * std::sin(round)};
}

std::uint32_t at(std::uint32_t row, std::uint32_t column) {
    return row * columns + column % columns;
}

/// Counter-clockwise from outside.
const std::vector<Triangle>& triangles() {
    static const std::vector<Triangle> list = [] {
        constexpr std::uint32_t top = rows * columns, bottom = top + 1;
        std::vector<Triangle> made;
        for (std::uint32_t c = 0; c < columns; ++c) {
            made.push_back({top, at(0, c + 1), at(0, c)});
            for (std::uint32_t r = 0; r + 1 < rows; ++r) {
                made.push_back({at(r, c), at(r, c + 1), at(r + 1, c)});
                made.push_back({at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)});
            }
            made.push_back({bottom, at(rows - 1, c), at(rows - 1, c + 1)});
        }
        return made;
    }();
    return list;
}

/// Each edge with the two triangles that share it: (a, b, one, other).
const std::vector<std::array<std::uint32_t, 4>>& edges_of_triangles() {
    static const std::vector<std::array<std::uint32_t, 4>> list = [] {
        std::vector<std::array<std::uint32_t, 3>> sides;  // low vertex, high vertex, triangle
        for (std::uint32_t t = 0; t < triangles().size(); ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = triangles()[t][i], b = triangles()[t][(i + 1) % 3];
                sides.push_back({std::min(a, b), std::max(a, b), t});
            }
        std::sort(sides.begin(), sides.end());
        std::vector<std::array<std::uint32_t, 4>> made;
        for (std::size_t i = 0; i + 1 < sides.size(); i += 2)
            made.push_back({sides[i][0], sides[i][1], sides[i][2], sides[i + 1][2]});
        return made;
    }();
    return list;
}

/// The derivative at p1 over the knot interval from p1 to p2.
glm::vec3 slope_between(glm::vec3 p0, glm::vec3 p1, glm::vec3 p2) {
    const float before = std::sqrt(glm::distance(p0, p1)), after = std::sqrt(glm::distance(p1, p2));
    const glm::vec3 velocity = (p1 - p0) / before - (p2 - p0) / (before + after) + (p2 - p1) / after;
    return velocity * after;
}

float angle(glm::vec3 a, glm::vec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// `vector` rotated by the smallest rotation that takes `from` to `to`; both unit, not opposite.
glm::vec3 turned(glm::vec3 vector, glm::vec3 from, glm::vec3 to) {
    const glm::vec3 half_way = from + to;
    return vector - glm::dot(half_way, vector) / (1.0f + glm::dot(from, to)) * half_way +
           2.0f * glm::dot(from, vector) * to;
}

glm::vec3 first_normal(glm::vec3 tangent) {
    // No rule is continuous for all tangents. This one is discontinuous only opposite `pole`, an unlikely
    // direction for a rope.
    const glm::vec3 pole(0.60f, 0.64f, 0.48f), across(-0.80f, 0.48f, 0.36f);
    if (glm::dot(pole, tangent) < -0.9999f) return across;
    return turned(across, pole, tangent);
}

/// The unit vector perpendicular to `tangent` that is nearest to `normal`.
glm::vec3 straightened(glm::vec3 normal, glm::vec3 tangent) {
    normal -= glm::dot(normal, tangent) * tangent;
    const float length = glm::length(normal);
    return length > 1e-3f ? normal / length : first_normal(tangent);
}

}  // namespace

void box(DrawList& list, const Camera& camera, glm::vec3 centre, glm::vec3 half_extents, glm::quat rotation,
         glm::vec3 colour) {
    const float turn = glm::length(rotation);
    if (!can_be_built(centre) || !can_be_built(half_extents) || !(turn > 1e-6f && turn < 1e6f)) return;
    rotation /= turn;
    Edges edges(list, camera);
    const float inset = edges.metres(centre);
    std::array<glm::vec3, 3> axes{}, whole{};
    for (int i = 0; i < 3; ++i) {
        const float half = std::abs(half_extents[i]);
        glm::vec3 axis(0.0f);
        axis[i] = 1.0f;
        axis = rotation * axis;
        axes[static_cast<std::size_t>(i)] = std::max(half - inset, 0.1f * half) * axis;
        whole[static_cast<std::size_t>(i)] = half * axis;
    }
    shadow_of_box(list, centre, whole);

    std::array<Face, 6> faces{};
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const std::size_t axis = f / 2;
        const float side = f % 2 == 0 ? 1.0f : -1.0f;
        Face& face = faces[f];
        face.centre = centre + side * axes[axis];
        face.u = side * axes[(axis + 1) % 3];
        face.v = axes[(axis + 2) % 3];
        glm::vec3 normal(0.0f);
        normal[static_cast<int>(axis)] = side;
        face.normal = rotation * normal;
        face.front = edges.front(face.normal, face.centre);
        const std::uint32_t first = list.mesh.next();
        for (const glm::vec2 corner :
             {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
            list.mesh.vertices.push_back({.position = face.centre + corner.x * face.u + corner.y * face.v,
                                          .normal = face.normal,
                                          .colour = colour,
                                          .back = colour});
        }
        list.mesh.triangle(first, first + 1, first + 2);
        list.mesh.triangle(first, first + 2, first + 3);
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t g = f + 1; g < faces.size(); ++g) {
            if (f / 2 == g / 2 || (!faces[f].front && !faces[g].front)) continue;
            // The faces meet along the third axis.
            const glm::vec3 along = axes[3 - f / 2 - g / 2];
            const glm::vec3 middle = faces[f].centre + faces[g].centre - centre;
            const bool both = faces[f].front && faces[g].front;
            if (both) {
                edges.crease(middle - along, middle + along, faces[f].normal + faces[g].normal, colour);
            } else {
                const Face& seen = faces[f].front ? faces[f] : faces[g];
                edges.outline(middle - along, middle + along, seen.normal, colour);
            }
        }
    }
}

namespace {

/// A two-sided disc: its rim, and lines across it.
class Patch {
  public:
    Patch(DrawList& list, const Camera& camera, glm::vec3 point, glm::vec3 normal, float radius)
        : list_(list), edges_(list, camera), point_(point), normal_(normal), radius_(radius) {
        // Make one axis horizontal, like a contour line.
        u_ = unit_or(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), normal), {1.0f, 0.0f, 0.0f});
        if (std::abs(normal.y) > 0.999f) u_ = glm::normalize(glm::vec3(1, 0, 0) - normal.x * normal);
        v_ = glm::cross(normal, u_);
        seen_ = edges_.front(normal, point) ? normal : -normal;
    }

    void fill(glm::vec3 colour) {
        const std::uint32_t first = list_.mesh.next();
        list_.mesh.vertices.push_back({point_, normal_, colour, colour});
        for (std::uint32_t i = 0; i < corners; ++i) {
            list_.mesh.vertices.push_back({rim(i), normal_, colour, colour});
            list_.mesh.triangle(first, first + 1 + i, first + 1 + (i + 1) % corners);
        }
    }
    void outline(glm::vec3 colour) {
        for (std::uint32_t i = 0; i < corners; ++i) edges_.crease(rim(i), rim(i + 1), seen_, colour);
    }
    void lines(glm::vec3 colour) {
        constexpr int each_way = 3;
        for (int i = -each_way; i <= each_way; ++i) {
            const float off = static_cast<float>(i) / static_cast<float>(each_way + 1);
            const float reach = std::sqrt(1.0f - off * off);
            edges_.crease(at(off, -reach), at(off, reach), seen_, colour);
            edges_.crease(at(-reach, off), at(reach, off), seen_, colour);
        }
    }

  private:
    static constexpr std::uint32_t corners = 96;

    glm::vec3 at(float u, float v) const { return point_ + radius_ * (u * u_ + v * v_); }
    glm::vec3 rim(std::uint32_t i) const {
        const float angle =
            glm::two_pi<float>() * static_cast<float>(i % corners) / static_cast<float>(corners);
        return at(std::cos(angle), std::sin(angle));
    }

    DrawList& list_;
    Edges edges_;
    glm::vec3 point_, normal_, u_, v_, seen_;
    float radius_;
};

}  // namespace

void plane_patch(DrawList& list, const Camera& camera, glm::vec3 point, glm::vec3 normal, float radius,
                 glm::vec3 colour) {
    if (!can_be_built(point) || !can_be_built(normal) || !(radius > 0.0f && radius <= farthest_built)) return;
    normal = unit_or(normal, {0.0f, 1.0f, 0.0f});
    Patch patch(list, camera, point, normal, radius);
    const bool ground = std::abs(normal.y) > 0.99999f && std::abs(point.y) < 1e-3f * radius;
    if (ground) {
        patch.outline(colour);
        return;
    }
    // Lines have some contrast in either theme.
    const float lightness = glm::dot(colour, glm::vec3(0.30f, 0.59f, 0.11f));
    const glm::vec3 line = glm::mix(colour, glm::vec3(lightness < 0.5f ? 1.0f : 0.0f), 0.16f);
    patch.fill(colour);
    patch.lines(glm::mix(colour, line, 0.5f));
    patch.outline(line);
}

void globe(DrawList& list, const Camera& camera, const std::function<glm::vec3(glm::vec3)>& surface,
           glm::vec3 colour) {
    std::vector<glm::vec3> points;
    points.reserve(rows * columns + 2);
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c) points.push_back(surface(on_ball(r, c)));
    points.push_back(surface({0.0f, 1.0f, 0.0f}));
    points.push_back(surface({0.0f, -1.0f, 0.0f}));
    if (!std::all_of(points.begin(), points.end(), can_be_built)) return;

    std::vector<glm::vec3> normals(points.size(), glm::vec3(0.0f));
    for (const auto& [a, b, c] : triangles()) {
        const glm::vec3 area = glm::cross(points[b] - points[a], points[c] - points[a]);
        normals[a] += area, normals[b] += area, normals[c] += area;
    }
    Edges edges(list, camera);
    const std::uint32_t first = list.mesh.next();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 normal = unit_or(normals[i], {0.0f, 1.0f, 0.0f});
        // The outline adds half a pixel all around.
        points[i] -= edges.metres(points[i]) * normal;
        list.mesh.vertices.push_back({points[i], normal, colour, colour});
    }
    std::vector<bool> front;
    front.reserve(triangles().size());
    for (const auto& [a, b, c] : triangles()) {
        front.push_back(edges.front(glm::cross(points[b] - points[a], points[c] - points[a]), points[a]));
        if (front.back()) list.mesh.triangle(first + a, first + b, first + c);
    }
    for (const auto& [a, b, one, other] : edges_of_triangles()) {
        if (front[one] == front[other]) continue;
        const glm::vec3 normal = list.mesh.vertices[first + a].normal + list.mesh.vertices[first + b].normal;
        const glm::vec3 sight = unit_or(edges.to_eye(points[a]), normal);
        edges.outline(first + a, first + b, normal - glm::dot(normal, sight) * sight, colour);
    }
    edges.join();
}

glm::vec3 CurveSpan::at(float t) const {
    const float s = 1.0f - t;
    return s * s * (1.0f + 2.0f * t) * a + t * t * (1.0f + 2.0f * s) * b + s * s * t * slope_a -
           t * t * s * slope_b;
}

glm::vec3 CurveSpan::slope(float t) const {
    const float s = 1.0f - t;
    return 6.0f * s * t * (b - a) + s * (s - 2.0f * t) * slope_a + t * (t - 2.0f * s) * slope_b;
}

float CurveSpan::turn() const {
    return angle(slope_a, b - a) + angle(b - a, slope_b);
}

CurveSpan curve_span(std::span<const glm::vec3> points, std::size_t i) {
    const glm::vec3 a = points[i], b = points[i + 1];
    const bool first = i == 0, last = i + 2 == points.size();
    CurveSpan span{.a = a, .b = b, .slope_a = b - a, .slope_b = b - a};
    if (!first) span.slope_a = slope_between(points[i - 1], a, b);
    if (!last) span.slope_b = -slope_between(points[i + 2], b, a);
    // The first and last spans are parabolas: minimum bending for one given end direction.
    if (first && !last) span.slope_a = 2.0f * (b - a) - span.slope_b;
    if (last && !first) span.slope_b = 2.0f * (b - a) - span.slope_a;
    return span;
}

void set_frames(std::span<CurvePoint> points) {
    if (points.empty()) return;
    points[0].normal = straightened(first_normal(points[0].tangent), points[0].tangent);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const CurvePoint& from = points[i - 1];
        CurvePoint& to = points[i];
        glm::vec3 normal = from.normal, tangent = from.tangent;
        // Reflected in the plane halfway between the two points, then in the plane that maps its tangent to
        // the next one.
        const glm::vec3 step = to.at - from.at;
        if (const float squared = glm::dot(step, step); squared > 0.0f) {
            normal -= 2.0f / squared * glm::dot(step, normal) * step;
            tangent -= 2.0f / squared * glm::dot(step, tangent) * step;
        }
        const glm::vec3 rest = to.tangent - tangent;
        if (const float squared = glm::dot(rest, rest); squared > 1e-12f)
            normal -= 2.0f / squared * glm::dot(rest, normal) * rest;
        to.normal = straightened(normal, to.tangent);
    }
}

Stroke& Edges::add(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour) {
    return list_.strokes.emplace_back(Stroke{.a = a,
                                             .b = b,
                                             .radius_a = width,
                                             .radius_b = width,
                                             .colour = glm::vec4(colour, 1.0f),
                                             .normal = normal,
                                             .unit = Unit::Pixels,
                                             .shade = Shade::Edge});
}

void Edges::outline(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour) {
    add(a, b, unit_or(normal, to_eye(a)), colour);
}

void Edges::crease(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour) {
    constexpr float pixels_nearer = 2.0f;
    const auto nearer = [&](glm::vec3 point) {
        const glm::vec3 way = to_eye(point);
        const float length = glm::length(way), step = pixels_nearer * camera_.metres_per_pixel(point);
        return length > step ? point + step / length * way : point;
    };
    outline(nearer(a), nearer(b), normal, colour);
}

void Edges::outline(std::uint32_t a, std::uint32_t b, glm::vec3 normal, glm::vec3 colour) {
    outline(list_.mesh.vertices[a].position, list_.mesh.vertices[b].position, normal, colour);
    joined_.push_back({a, b, list_.strokes.size() - 1});
}

void Edges::meet(std::uint32_t vertex, std::uint32_t other) {
    std::uint32_t& slot = slots_[vertex - first_];
    if (slot == 0) {
        const glm::vec3 at = list_.mesh.vertices[vertex].position;
        // Points behind the eye are invisible, so their cuts do not matter.
        joints_.push_back({.pixel = camera_.project(at).value_or(glm::vec2(0.0f))});
        slot = static_cast<std::uint32_t>(joints_.size());
    }
    Joint& joint = joints_[slot - 1];
    if (joint.count < 2) joint.others[joint.count] = other;
    ++joint.count;
}

float Edges::mitre_at(std::uint32_t vertex, std::uint32_t other) const {
    const Joint& here = joint(vertex);
    if (here.count != 2) return 0.0f;
    const std::uint32_t third = here.others[0] == other ? here.others[1] : here.others[0];
    const glm::vec2 to = joint(other).pixel - here.pixel, from = here.pixel - joint(third).pixel;
    const float lengths = glm::length(to) * glm::length(from);
    if (!(lengths > 1e-6f)) return 0.0f;
    // The tangent of half the angle between the two.
    const float cosine = glm::dot(from, to) / lengths, sine = (from.x * to.y - from.y * to.x) / lengths;
    return cosine > -0.6f ? -sine / (1.0f + cosine) : 0.0f;
}

void Edges::join() {
    slots_.assign(list_.mesh.next() - first_, 0);
    joints_.clear();
    for (const Joined& outline : joined_) {
        meet(outline.a, outline.b);
        meet(outline.b, outline.a);
    }
    for (const Joined& outline : joined_) {
        // Seen from b, left and right are swapped, and forwards and backwards too: the lean keeps its sign.
        list_.strokes[outline.stroke].mitre = {mitre_at(outline.a, outline.b),
                                               mitre_at(outline.b, outline.a)};
    }
    joined_.clear();
}

/// The mitre of a line of that direction for a cut perpendicular to `tangent` on the screen.
float Edges::mitre(glm::vec3 point, glm::vec3 tangent, glm::vec3 direction) const {
    constexpr float most = 2.0f;
    const float pixel = camera_.metres_per_pixel(point);
    const auto at = camera_.project(point), on = camera_.project(point + pixel * direction),
               turned = camera_.project(point + pixel * tangent);
    if (!at || !on || !turned) return 0.0f;
    const glm::vec2 line = *on - *at, curve = *turned - *at;
    const float along = glm::dot(line, curve);
    // Pixels count downwards, which swaps left and right.
    const float lean = (line.x * curve.y - line.y * curve.x) / along;
    return along > 0.0f && std::abs(lean) < most ? lean : 0.0f;
}

void Edges::thread(glm::vec3 a, glm::vec3 b, glm::vec3 tangent_a, glm::vec3 tangent_b, float radius,
                   glm::vec3 colour) {
    const glm::vec3 along = unit_or(b - a, glm::vec3(0.0f)), way = to_eye(0.5f * (a + b));
    const glm::vec3 across = unit_or(way - glm::dot(way, along) * along, glm::vec3(0.0f));
    // The mean of the normals across a round rod. Lighting is linear in it as in a normal.
    Stroke& stroke = add(a, b, 0.25f * glm::pi<float>() * across, colour);
    stroke.radius_a = stroke.radius_b = radius;
    stroke.unit = Unit::Metres;
    stroke.mitre = {mitre(a, tangent_a, along), mitre(b, tangent_b, along)};
}

}  // namespace tendril::app
