// A body as a distance field: chains of rounded cones, blended where they meet, and its surface as
// triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace tendril::app {

/// An ellipse across a chain.
struct BodySection {
    glm::vec3 at{0.0f};
    glm::vec3 flat{0.0f, 0.0f, 1.0f};  ///< unit; the direction of `depth`
    float width = 0.1f, depth = 0.1f;  ///< radii
};

class BodyField {
  public:
    static constexpr std::size_t max_groups = 5;
    using Distances = std::array<float, max_groups>;

    float blend = 0.03f;  ///< cones closer than this melt into one
    float floor = -1e9f;  ///< cuts off everything lower

    /// Adds a smooth tube through the sections. Chains of one group must be added one after the other.
    void add_chain(std::size_t group, std::span<const BodySection> sections);

    /// The approximate distance from the surface, negative inside. `near`: the cones that matter here.
    float distance(const glm::vec3& point, std::span<const std::uint16_t> near) const;
    /// The distance from each group alone; over 1e8 if none of its cones is near.
    Distances groups(const glm::vec3& point, std::span<const std::uint16_t> near) const;
    std::span<const std::uint16_t> all() const { return all_; }
    /// Collects the cones of `among` that matter within `radius` of the point; returns the distance there.
    float near(const glm::vec3& point, float radius, std::span<const std::uint16_t> among,
               std::vector<std::uint16_t>& cones) const;
    /// A box around everything.
    void bounds(glm::vec3& low, glm::vec3& high) const;

  private:
    struct Cone {
        glm::vec3 from, way, flat;
        float inverse_square, from_radius, to_radius, ratio;
        std::uint16_t chain, group;
    };
    static float cone_distance(const Cone& cone, const glm::vec3& point);
    static float smooth_min(float a, float b, float over);

    std::vector<Cone> cones_{};
    std::vector<std::uint16_t> all_{};
    std::uint16_t chains_ = 0;
};

struct BodySurface {
    std::vector<glm::vec3> positions{}, normals{};
    std::vector<std::uint32_t> indices{};        ///< counter-clockwise, seen from outside
    std::vector<BodyField::Distances> groups{};  ///< the distance from each group alone, at each position
};

/// The field's surface, closed, from a grid of cubes of that size.
BodySurface body_surface(const BodyField& field, float cell);

}  // namespace tendril::app
