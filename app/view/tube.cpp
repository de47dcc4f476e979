#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "app/view/edges.hpp"
#include "app/view/spline.hpp"
#include "app/view/surface_support.hpp"
#include "app/view/surfaces.hpp"

namespace tendril::app {
namespace {

constexpr int most_sides = 64;

/// One circle of the tube. The half balls at its ends are circles too, which lean towards their poles.
struct Ring {
    glm::vec3 centre{0.0f};
    glm::vec3 axis{0.0f}, u{0.0f}, v{0.0f};  ///< unit; the circle runs from u to v
    float radius = 0.0f;
    float lean = 0.0f;     ///< radians that the surface's normal leans towards the axis
    float pixels = 0.0f;   ///< the tube's radius here
    unsigned outside = 0;  ///< which borders of the view it is beyond, one bit each
    glm::vec3 colour{1.0f};
};

class Tube {
  public:
    Tube(DrawList& list, const Camera& camera, float radius, int sides)
        : list_(list),
          camera_(camera),
          edges_(list, camera),
          radius_(radius),
          sides_(static_cast<std::uint32_t>(std::clamp(sides, 3, most_sides))) {
        for (std::uint32_t j = 0; j < sides_; ++j) {
            const float angle = glm::two_pi<float>() * static_cast<float>(j) / static_cast<float>(sides_);
            circle_[j] = {std::cos(angle), std::sin(angle)};
        }
    }

    void build(std::span<const glm::vec3> centres, std::span<const glm::vec3> colours) {
        keep(centres, colours);
        if (points_.empty()) return;
        divide();
        set_frames(curve_);
        shadows();
        rings();
        skin();
    }

  private:
    /// The centres without those that are not finite or so near to the one before that they tell nothing new.
    void keep(std::span<const glm::vec3> centres, std::span<const glm::vec3> colours) {
        for (std::size_t i = 0; i < centres.size(); ++i) {
            const glm::vec3 centre = centres[i];
            if (!can_be_built(centre)) continue;
            const glm::vec3 colour =
                colours.empty() ? glm::vec3(1.0f) : colours[std::min(i, colours.size() - 1)];
            const float least = std::max({0.25f * radius_, 0.5f * camera_.metres_per_pixel(centre),
                                          1e-6f * glm::length(centre), 1e-9f});
            if (points_.empty() || glm::distance(points_.back(), centre) >= least) {
                points_.push_back(centre);
                colours_.push_back(colour);
            } else if (points_.size() > 1 && i + 1 == centres.size()) {
                points_.back() = centre;  // the tube ends where it ends
            }
        }
    }

    /// Pieces that a span needs so that nobody sees its corners.
    int pieces(const CurveSpan& span) const {
        constexpr float pixels_off = 0.1f, radians = 0.45f;
        constexpr int most = 24;
        const float turn = span.turn();
        const float per_metre = 1.0f / camera_.metres_per_pixel(0.5f * (span.a + span.b));
        const float length = per_metre * glm::distance(span.a, span.b), thick = per_metre * radius_;
        // A chord of an arc is off it by an eighth of its length times its turn.
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
                  .pixels = radius_ * Edges::width / half_pixel,
                  .colour = colours_[i] + t * (colours_[next] - colours_[i])};
        ring.outside = outside(ring.centre, ring.pixels);
        return ring;
    }

    /// Half a ball from its pole to where the tube begins or back.
    void cap(const Ring& end, float side) {
        const int count = std::clamp(static_cast<int>(sides_) / 4, 2, 12);
        for (int k = 0; k < count; ++k) {
            const int step = side < 0.0f ? count - k : k + 1;
            Ring ring = end;
            ring.lean = side * glm::half_pi<float>() * static_cast<float>(step) / static_cast<float>(count);
            ring.centre += end.radius * std::sin(ring.lean) * end.axis;
            ring.radius = step == count ? 0.0f : end.radius * std::cos(ring.lean);
            rings_.push_back(ring);
        }
    }

    void rings() {
        const Ring first = ring(curve_.front()), last = ring(curve_.back());
        cap(first, -1.0f);
        for (const CurvePoint& point : curve_) rings_.push_back(ring(point));
        cap(last, 1.0f);
    }

    /// Appends a ring's corners, and tells where they begin.
    std::uint32_t corners(const Ring& ring) {
        const std::uint32_t first = list_.mesh.next();
        const float up = std::sin(ring.lean), out = std::cos(ring.lean);
        for (std::uint32_t j = 0; j < sides_; ++j) {
            const glm::vec3 away = circle_[j].x * ring.u + circle_[j].y * ring.v;
            list_.mesh.vertices.push_back({.position = ring.centre + ring.radius * away,
                                           .normal = out * away + up * ring.axis,
                                           .colour = ring.colour,
                                           .back = ring.colour});
        }
        return first;
    }

    /// From each ring to the next: nothing outside the view, a stroke where it is thin, else a band.
    void skin() {
        constexpr float thin = 1.0f;
        bool joined = false;  // the last ring's corners are there, and the band before it
        std::uint32_t from = 0;
        for (std::size_t i = 0; i + 1 < rings_.size(); ++i) {
            const Ring &a = rings_[i], &b = rings_[i + 1];
            const bool seen = (a.outside & b.outside) == 0;
            if (!seen || (a.pixels < thin && b.pixels < thin)) {
                if (seen && a.lean == 0.0f && b.lean == 0.0f) stroke(a, b);
                joined = false;
                continue;
            }
            if (!joined) from = corners(a);
            const std::uint32_t to = corners(b);
            band(from, to, joined);
            from = to;
            joined = true;
        }
        if (curve_.size() == 1 && rings_[0].pixels < thin) stroke(rings_[0], rings_[0]);
    }

    void stroke(const Ring& a, const Ring& b) {
        list_.bone(a.centre, b.centre, radius_, radius_, glm::vec4(0.5f * (a.colour + b.colour), 1.0f));
    }

    void band(std::uint32_t from, std::uint32_t to, bool joined) {
        std::array<bool, most_sides> front{};
        for (std::uint32_t j = 0; j < sides_; ++j) {
            const std::uint32_t k = j + 1 == sides_ ? 0 : j + 1;
            list_.mesh.triangle(from + j, from + k, to + j);
            list_.mesh.triangle(to + j, from + k, to + k);
            const glm::vec3 corner = at(from + j);
            front[j] = edges_.front(glm::cross(at(to + k) - corner, at(to + j) - at(from + k)), corner);
        }
        for (std::uint32_t j = 0; j < sides_; ++j) {
            const std::uint32_t k = j + 1 == sides_ ? 0 : j + 1;
            if (front[j] != front[k]) edge(from + k, to + k);
            if (joined && front[j] != front_before_[j]) edge(from + j, from + k);
        }
        front_before_ = front;
    }

    glm::vec3 at(std::uint32_t vertex) const { return list_.mesh.vertices[vertex].position; }

    void edge(std::uint32_t a, std::uint32_t b) {
        const Vertex &p = list_.mesh.vertices[a], &q = list_.mesh.vertices[b];
        edges_.outline(p.position, q.position, p.normal + q.normal, 0.5f * (p.colour + q.colour));
    }

    DrawList& list_;
    const Camera& camera_;
    Edges edges_;
    float radius_;
    std::uint32_t sides_;
    std::array<glm::vec2, most_sides> circle_{};
    std::array<bool, most_sides> front_before_{};
    std::vector<glm::vec3> points_, colours_;
    std::vector<CurvePoint> curve_;
    std::vector<Ring> rings_;
};

}  // namespace

void tube(DrawList& list, const Camera& camera, std::span<const glm::vec3> centres, float radius, int sides,
          std::span<const glm::vec3> colours) {
    if (!(radius > 0.0f && radius <= farthest_built)) return;
    Tube(list, camera, radius, sides).build(centres, colours);
}

}  // namespace tendril::app
