// The built-in figure: 1.8 m tall, in T-pose, facing +Z, with a body, and a computed walk and punch.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <tendril/humanoid/bone_map.hpp>
#include <tendril/humanoid/skeleton.hpp>
#include <vector>

#include "app/io/character/character.hpp"
#include "app/io/character/skin.hpp"

namespace tendril::app {

/// Nodes have the names of bone_map.hpp and no rotation at rest. The clips are "walk", which moves 1.1 m
/// towards +Z in 1.1 s and loops, and "punch", a hook of the right hand that begins and ends in the guard
/// position. Built by the first call, in a tenth of a second.
const Character& stick_figure();

/// Where the sole touches the ground at rest, relative to the ankle; metres.
inline constexpr glm::dvec3 stick_heel{0.0, -0.09, -0.05}, stick_toe{0.0, -0.09, 0.15};

// The body of the built-in figure: a smooth mannequin, computed from the bones.
//
// Rounded cones along the bones are blended into one distance field (I. Quilez, "Smooth minimum"), whose
// surface becomes triangles by surface nets (S. Gibson, "Constrained elastic surface nets", MICCAI 1998). It
// is bound with the arms half lowered, so that shoulders keep their shape in a T-pose and beside the body.

/// A closed surface that follows the mapped bones, for a figure in T-pose facing +Z, Y up. No mesh unless all
/// bones are mapped and have a length.
Skin figure_body(const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map);

// A body as a distance field: chains of rounded cones, blended where they meet, and its surface as
// triangles.

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
    /// The distance from each group by itself; over 1e8 if none of its cones is near.
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
    std::vector<BodyField::Distances> groups{};  ///< the distance from each group by itself, at each position
};

/// The field's surface, closed, from a grid of cubes of that size.
BodySurface body_surface(const BodyField& field, float cell);

}  // namespace tendril::app
