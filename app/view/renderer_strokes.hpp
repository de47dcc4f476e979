// The strokes of a DrawList: one instanced draw for each layer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/view/gl_objects.hpp"
#include "app/view/renderer.hpp"
#include "app/view/stroke_projection.hpp"

namespace tendril::app {

class StrokePass {
  public:
    StrokePass();

    /// Projects, sorts and sends the list, for draw() to draw a layer of it.
    void prepare(const DrawList& list, const Camera& camera, const Frame& frame);
    /// How many draw calls that took: none for an empty layer, else one.
    int draw(Layer layer) const;

  private:
    /// One stroke as the shader takes it: framebuffer pixels from the bottom left.
    struct Instance {
        glm::vec2 a, b;
        float radius_a, radius_b;
        float depth_a, depth_b;  ///< in the form that changes evenly across the screen
        std::array<std::uint8_t, 4> colour;
        float lit;                          ///< 1: a solid in the light, 0: flat
        float ring;                         ///< half the ring's width; 0: not a ring
        std::array<std::int8_t, 4> facing;  ///< of an edge: the surface's normal as it is lit, and 1
        glm::vec2 mitre;
    };
    /// What is drawn first comes first.
    struct Place {
        std::uint64_t key;
        std::uint32_t stroke, outline;
        bool operator<(const Place& other) const {
            return key != other.key ? key < other.key : stroke < other.stroke;
        }
    };

    void sort(const DrawList& list, const Camera& camera);
    static Instance instance(const Stroke& stroke, const ProjectedStroke& outline, const Frame& frame,
                             const Camera& camera);
    void set_uniforms(const Camera& camera, const Frame& frame) const;

    Program program_;
    Instances buffer_;
    // Kept from frame to frame, so that their memory is.
    std::vector<ProjectedStroke> outlines_;
    std::vector<Place> order_;
    std::vector<Instance> instances_;
    std::size_t scene_count_ = 0;
};

}  // namespace tendril::app
