// The list of things to draw, free of GL. Labs fill a list each frame; the renderer draws it, picking reads
// it, and tests inspect it.
//
// Nearly everything is one shape, a *stroke*: two balls and the hull between them. A sphere is a stroke whose
// ends coincide, a line has constant width, a bone tapers. So one instanced call draws them all, and one
// distance function picks them. Surfaces of other shapes are triangles of one mesh, built by
// app/view/surfaces.hpp. They cannot be picked: cover them with transparent strokes for that.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "app/io/character/skinned_mesh.hpp"

namespace tendril::app {

/// Identifies a stroke for picking; the lab defines its meaning. no_pick: not pickable.
using PickId = std::int32_t;
inline constexpr PickId no_pick = -1;

enum class Unit : std::uint8_t { Metres, Pixels };
/// Ring: a flat circle outline facing the eye. Edge: a line along the edge of a surface, with the surface's
/// light.
enum class Shade : std::uint8_t { Lit, Flat, Ring, Edge };
enum class Layer : std::uint8_t { Scene, Overlay };  ///< Overlay is drawn over the scene, regardless of depth

struct Stroke {
    glm::vec3 a{0.0f}, b{0.0f};
    float radius_a = 1.0f, radius_b = 1.0f;
    glm::vec4 colour{1.0f};  ///< alpha 0: not drawn, but still picked and casting a shadow
    glm::vec3 normal{0.0f};  ///< the surface's unit normal, or the mean of several; only for Shade::Edge
    /// Shift of the cuts at a and b along the line, per pixel to its left; only for Shade::Edge.
    glm::vec2 mitre{0.0f};
    float ring_width = 0.0f;  ///< pixels; only for Shade::Ring
    Unit unit = Unit::Metres;
    Shade shade = Shade::Lit;
    Layer layer = Layer::Scene;
    bool shadow = false;  ///< casts a contact shadow on the ground
    PickId pick = no_pick;
    std::int16_t rank = 0;  ///< of overlapping pickable strokes the higher rank wins, then the nearer
};

/// Text beside a point. If two labels would overlap, only the higher `rank` is drawn.
struct Label {
    glm::vec3 at{0.0f};
    float clearance = 10.0f;  ///< pixels from the point to keep free
    std::string text;
    glm::vec3 colour{1.0f};
    int rank = 0;
};

struct Vertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};  ///< unit, to the front
    glm::vec3 colour{1.0f};              ///< the front's
    glm::vec3 back{1.0f};                ///< the back's
};

/// All solids that are not strokes, so that one call draws them. Triangles have two sides; seen from the
/// front, their corners run counter-clockwise.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;  ///< three to a triangle

    void clear() { vertices.clear(), indices.clear(); }
    /// The index that the next vertex will have.
    std::uint32_t next() const { return static_cast<std::uint32_t>(vertices.size()); }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        indices.insert(indices.end(), {a, b, c});
    }
};

struct DrawList {
    std::vector<Stroke> strokes;
    std::vector<Label> labels;
    Mesh mesh{};
    std::vector<SkinDraw> skins{};  ///< drawn with the mesh, or over the scene's strokes if transparent
    Mesh veil{};                    ///< transparent surfaces, through which the scene shows
    Mesh overlay{};                 ///< drawn over the scene, under the overlay strokes

    void clear() {
        strokes.clear(), labels.clear(), mesh.clear(), skins.clear(), veil.clear(), overlay.clear();
    }

    /// Each returns the appended stroke, for setting its rarer fields.
    Stroke& sphere(glm::vec3 centre, float radius, Unit unit, glm::vec4 colour);
    /// Lines keep their width on the screen, and end behind the balls they join.
    Stroke& line(glm::vec3 a, glm::vec3 b, float width_pixels, glm::vec4 colour);
    Stroke& bone(glm::vec3 a, glm::vec3 b, float radius_a, float radius_b, glm::vec4 colour);
    /// `radius_pixels` is the radius of the line's centre.
    Stroke& ring(glm::vec3 centre, float radius_pixels, float width_pixels, glm::vec4 colour);
};

}  // namespace tendril::app
