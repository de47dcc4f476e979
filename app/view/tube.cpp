#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <span>
#include <vector>

#include "app/view/surfaces.hpp"

namespace tendril::app {
namespace {

/// One circle of a tube. The hemispheres at its ends consist of circles whose normals lean towards the poles.
struct Ring {
    glm::vec3 centre{0.0f};
    glm::vec3 axis{0.0f}, u{0.0f}, v{0.0f};  ///< unit; the circle runs from u to v
    float radius = 0.0f;                     ///< the circle's, metres
    float lean = 0.0f;                       ///< radians that the surface's normal leans towards the axis
    float tube_radius = 0.0f;                ///< metres
    float pixels = 0.0f;                     ///< the tube's radius in pixels
    unsigned outside = 0;  ///< the view's borders that the ring is beyond, one bit per border
    bool first = false;    ///< no band connects it to the previous ring
    glm::vec3 colour{1.0f};
};

class TubeSkin {
  public:
    static constexpr int max_sides = 64;

    TubeSkin(DrawList& list, const Camera& camera, int sides);

    /// Omits sides that face away from the eye: the tube is closed, so they cannot be seen.
    void cover(std::span<const Ring> rings);

  private:
    /// Inside: in bends sharper than the tube's radius, the inner side lies within the tube.
    enum class Facing : std::uint8_t { Away, Front, Inside };
    using PerSide = std::array<Facing, max_sides>;

    std::uint32_t corners(const Ring& ring);
    void band(std::uint32_t from, std::uint32_t to, bool joined);
    Facing facing(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void edge(Facing one, Facing other, std::uint32_t a, std::uint32_t b);
    glm::vec3 at(std::uint32_t vertex) const { return list_.mesh.vertices[vertex].position; }
    std::uint32_t after(std::uint32_t side) const { return side + 1 == sides_ ? 0 : side + 1; }

    DrawList& list_;
    Edges edges_;
    std::uint32_t sides_;
    std::array<glm::vec2, max_sides> circle_{};
    PerSide last_{};         ///< the last band's
    float outwards_ = 1.0f;  ///< radius of the outline's centre line, relative to the last ring's
};

class Tube {
  public:
    Tube(DrawList& list, const Camera& camera, float radius)
        : list_(list), camera_(camera), edges_(list, camera), radius_(radius) {}

    void build(std::span<const glm::vec3> centres, int sides, std::span<const glm::vec3> colours) {
        keep(centres, colours);
        if (points_.empty()) return;
        divide();
        set_frames(curve_);
        shadows();
        skin(sides);
    }

  private:
    /// Keeps the centres that are finite and far enough from the previous one to matter.
    void keep(std::span<const glm::vec3> centres, std::span<const glm::vec3> colours) {
        for (std::size_t i = 0; i < centres.size(); ++i) {
            const glm::vec3 centre = centres[i];
            if (!can_be_built(centre)) continue;
            const glm::vec3 colour =
                colours.empty() ? glm::vec3(1.0f) : colours[std::min(i, colours.size() - 1)];
            const float min_step = std::max(
                {0.25f * radius_, camera_.metres_per_pixel(centre), 1e-6f * glm::length(centre), 1e-9f});
            if (points_.empty() || glm::distance(points_.back(), centre) >= min_step) {
                points_.push_back(centre);
                colours_.push_back(colour);
            } else if (points_.size() > 1 && i + 1 == centres.size()) {
                points_.back() = centre;  // keep the tube's exact end
            }
        }
    }

    /// Number of pieces that make a span look smooth.
    int pieces(const CurveSpan& span) const {
        constexpr float pixels_off = 0.1f, radians = 0.45f;
        constexpr int most = 24;
        const float turn = span.turn();
        const float per_metre = 1.0f / camera_.metres_per_pixel(0.5f * (span.a + span.b));
        const float length = per_metre * glm::distance(span.a, span.b), thick = per_metre * radius_;
        // A chord deviates from its arc by an eighth of its length times its turn.
        const float needed =
            std::max({std::sqrt(length * turn / (8.0f * pixels_off)),
                      turn * std::sqrt(thick / (8.0f * pixels_off)), thick > 1.0f ? turn / radians : 0.0f});
        return static_cast<int>(std::ceil(std::clamp(needed, 1.0f, static_cast<float>(most))));
    }

    void divide() {
        glm::vec3 tangent(1.0f, 0.0f, 0.0f);
        const auto add = [&](glm::vec3 at, glm::vec3 slope, float along) {
            tangent = unit_or(slope, tangent);
            curve_.push_back({.at = at, .tangent = tangent, .normal = {}, .along = along});
        };
        if (points_.size() == 1) add(points_[0], tangent, 0.0f);
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const CurveSpan span = curve_span(points_, i);
            const int count = pieces(span);
            if (i == 0) add(span.a, span.slope_a, 0.0f);
            for (int k = 1; k <= count; ++k) {
                const float t = static_cast<float>(k) / static_cast<float>(count);
                add(span.at(t), span.slope(t), static_cast<float>(i) + t);
            }
        }
    }

    void shadows() {
        if (points_.size() == 1) cast(list_, points_[0], points_[0], radius_);
        for (std::size_t i = 1; i < points_.size(); ++i) cast(list_, points_[i - 1], points_[i], radius_);
    }

    unsigned outside(glm::vec3 centre, float pixels) const {
        const std::optional<glm::vec2> at = camera_.project(centre);
        if (!at || (!camera_.pose().orthographic && camera_.depth(centre) < camera_.near_plane())) return 16u;
        const Rect& view = camera_.viewport();
        const float margin = pixels + 2.0f;
        return (at->x < view.min.x - margin ? 1u : 0u) | (at->x > view.max.x + margin ? 2u : 0u) |
               (at->y < view.min.y - margin ? 4u : 0u) | (at->y > view.max.y + margin ? 8u : 0u);
    }

    Ring ring(const CurvePoint& point) const {
        const auto i = std::min(static_cast<std::size_t>(point.along), points_.size() - 1);
        const std::size_t next = std::min(i + 1, points_.size() - 1);
        const float t = point.along - static_cast<float>(i);
        const float half_pixel = edges_.metres(point.at);
        Ring ring{.centre = point.at,
                  .axis = point.tangent,
                  .u = point.normal,
                  .v = glm::cross(point.tangent, point.normal),
                  .radius = std::max(radius_ - half_pixel, 0.1f * radius_),
                  .tube_radius = radius_,
                  .pixels = radius_ * Edges::width / half_pixel,
                  .colour = colours_[i] + t * (colours_[next] - colours_[i])};
        ring.outside = outside(ring.centre, ring.pixels);
        return ring;
    }

    /// A hemisphere, from its pole to the tube's start, or from the tube's end to the pole.
    void cap(const Ring& end, float side, int sides) {
        const int count = std::clamp(sides / 4, 2, 12);
        for (int k = 0; k < count; ++k) {
            const int step = side < 0.0f ? count - k : k + 1;
            Ring ring = end;
            ring.first = side < 0.0f && k == 0;
            ring.lean = side * glm::half_pi<float>() * static_cast<float>(step) / static_cast<float>(count);
            ring.centre += end.radius * std::sin(ring.lean) * end.axis;
            ring.radius = step == count ? 0.0f : end.radius * std::cos(ring.lean);
            rings_.push_back(ring);
        }
    }

    /// The number of sides beyond which the tube looks round, but at most `wanted`.
    int sides(int wanted) const {
        constexpr float pixels_off = 0.08f;
        float widest = 0.0f;
        for (const Ring& ring : circles_)
            if (ring.outside == 0) widest = std::max(widest, ring.pixels);
        // The middle of a side deviates from the circle by 1 - cos(pi / n) of the radius.
        const float needed = glm::pi<float>() * std::sqrt(widest / (2.0f * pixels_off));
        return std::min(wanted, std::max(static_cast<int>(std::min(needed, 1000.0f)) + 1, 6));
    }

    void skin(int wanted) {
        // Where the tube reverses it ends and restarts, since a circle cannot follow.
        constexpr float reversal_cosine = -0.2f;
        for (const CurvePoint& point : curve_) circles_.push_back(ring(point));
        const int count = sides(wanted);
        for (std::size_t i = 0; i < circles_.size(); ++i) {
            const bool last = i + 1 == circles_.size();
            if (i == 0 || glm::dot(circles_[i - 1].axis, circles_[i].axis) < reversal_cosine)
                cap(circles_[i], -1.0f, count);
            rings_.push_back(circles_[i]);
            if (last || glm::dot(circles_[i].axis, circles_[i + 1].axis) < reversal_cosine)
                cap(circles_[i], 1.0f, count);
        }
        TubeSkin(list_, camera_, count).cover(rings_);
        constexpr float thin = 1.0f;  // pixels; below this the skin has no caps
        if (circles_.size() == 1 && circles_[0].pixels < thin)
            list_.sphere(circles_[0].centre, radius_, Unit::Metres, glm::vec4(circles_[0].colour, 1.0f));
    }

    DrawList& list_;
    const Camera& camera_;
    Edges edges_;
    float radius_;
    std::vector<glm::vec3> points_, colours_;
    std::vector<CurvePoint> curve_;
    std::vector<Ring> circles_, rings_;  ///< along the curve; the same with caps
};

/// The ball's normal at the point in line with the point of `normal` on a concentric ball `part` times as
/// large. The mesh is smaller than the tube by its outline, which the shading must not show.
glm::vec3 within(glm::vec3 normal, glm::vec3 sight, float part) {
    const float towards = glm::dot(normal, sight);
    const glm::vec3 across = part * (normal - towards * sight);
    // Since sides are flat, corners slightly behind the outline count as on it.
    constexpr float behind = -0.3f;
    const float raised =
        std::sqrt(std::max(1.0f - glm::dot(across, across), 0.0f)) + 2.0f * std::min(towards - behind, 0.0f);
    return unit_or(across + raised * sight, normal);
}

}  // namespace

void tube(DrawList& list, const Camera& camera, std::span<const glm::vec3> centres, float radius, int sides,
          std::span<const glm::vec3> colours) {
    if (!(radius > 0.0f && radius <= farthest_built)) return;
    Tube(list, camera, radius).build(centres, std::clamp(sides, 3, TubeSkin::max_sides), colours);
}

TubeSkin::TubeSkin(DrawList& list, const Camera& camera, int sides)
    : list_(list), edges_(list, camera), sides_(static_cast<std::uint32_t>(std::clamp(sides, 3, max_sides))) {
    for (std::uint32_t j = 0; j < sides_; ++j) {
        const float angle = glm::two_pi<float>() * static_cast<float>(j) / static_cast<float>(sides_);
        circle_[j] = {std::cos(angle), std::sin(angle)};
    }
}

void TubeSkin::cover(std::span<const Ring> rings) {
    constexpr float thin = 1.0f;
    bool joined = false;  // the previous band exists, with the corners at which this one begins
    std::uint32_t from = 0;
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
        const Ring &a = rings[i], &b = rings[i + 1];
        const bool seen = (a.outside & b.outside) == 0 && !b.first;
        const bool is_thin = a.pixels < thin && b.pixels < thin;
        if (!seen || is_thin) {
            if (seen && a.lean == 0.0f && b.lean == 0.0f)
                edges_.thread(a.centre, b.centre, a.axis, b.axis, a.tube_radius,
                              0.5f * (a.colour + b.colour));
            joined = false;
            continue;
        }
        if (!joined) from = corners(a);
        const std::uint32_t to = corners(b);
        band(from, to, joined);
        from = to;
        joined = true;
    }
    edges_.join();
}

/// Appends a ring's corners and returns the index of the first one.
std::uint32_t TubeSkin::corners(const Ring& ring) {
    const std::uint32_t first = list_.mesh.next();
    const float up = std::sin(ring.lean), out = std::cos(ring.lean);
    const glm::vec3 sight = unit_or(edges_.to_eye(ring.centre), ring.u);
    const float pixels = std::max(ring.pixels, 2.0f * Edges::width);
    const float part = 1.0f - Edges::width / pixels;
    // The outline's mean position: most of it is within the tube, its paler part beyond.
    outwards_ = (1.0f - 0.3f * Edges::width / pixels) / part;
    for (std::uint32_t j = 0; j < sides_; ++j) {
        const glm::vec3 away = circle_[j].x * ring.u + circle_[j].y * ring.v;
        list_.mesh.vertices.push_back({.position = ring.centre + ring.radius * away,
                                       .normal = within(out * away + up * ring.axis, sight, part),
                                       .colour = ring.colour,
                                       .back = ring.colour});
    }
    return first;
}

/// The facing of the quadrilateral a b d c.
TubeSkin::Facing TubeSkin::facing(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    const glm::vec3 normal = glm::cross(at(d) - at(a), at(c) - at(b));
    const std::vector<Vertex>& vertices = list_.mesh.vertices;
    if (glm::dot(normal, vertices[a].normal + vertices[d].normal) < 0.0f) return Facing::Inside;
    return edges_.front(normal, at(a)) ? Facing::Front : Facing::Away;
}

/// Appends a triangle whose front is on the side of its normals. In bends too sharp for the tube some
/// triangles are inside out; single pixels of them may show between the others.
void TubeSkin::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::vector<Vertex>& v = list_.mesh.vertices;
    const bool front = edges_.front(glm::cross(at(b) - at(a), at(c) - at(a)), at(a));
    const bool wanted = edges_.front(v[a].normal + v[b].normal + v[c].normal, at(a));
    list_.mesh.triangle(a, front == wanted ? b : c, front == wanted ? c : b);
}

void TubeSkin::band(std::uint32_t from, std::uint32_t to, bool joined) {
    PerSide here{};
    for (std::uint32_t j = 0; j < sides_; ++j) {
        const std::uint32_t k = after(j);
        here[j] = facing(from + j, from + k, to + j, to + k);
        if (here[j] == Facing::Away) continue;
        triangle(from + j, from + k, to + j);
        triangle(to + j, from + k, to + k);
    }
    for (std::uint32_t j = 0; j < sides_; ++j) {
        const std::uint32_t k = after(j);
        edge(here[j], here[k], from + k, to + k);
        if (joined) edge(here[j], last_[j], from + j, from + k);
    }
    last_ = here;
}

void TubeSkin::edge(Facing one, Facing other, std::uint32_t a, std::uint32_t b) {
    if (one == other || one == Facing::Inside || other == Facing::Inside) return;
    const Vertex &p = list_.mesh.vertices[a], &q = list_.mesh.vertices[b];
    const glm::vec3 sight = unit_or(edges_.to_eye(p.position), p.normal);
    edges_.outline(a, b, within(0.5f * (p.normal + q.normal), sight, outwards_),
                   0.5f * (p.colour + q.colour));
}

}  // namespace tendril::app
