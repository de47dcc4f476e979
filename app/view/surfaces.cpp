#include "app/view/surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "app/view/edges.hpp"
#include "app/view/surface_support.hpp"

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

}  // namespace tendril::app
