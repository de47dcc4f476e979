// Draws the strokes of a DrawList, with one instanced draw per layer.
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

    /// Projects, sorts and sends the list; then draw() draws one layer of it.
    void prepare(const DrawList& list, const Camera& camera, const Frame& frame);
    /// Returns the number of draw calls: 0 for an empty layer, else 1.
    int draw(Layer layer) const;

  private:
    /// One stroke, as the shader reads it: framebuffer pixels from the bottom left.
    struct Instance {
        glm::vec2 a, b;
        float radius_a, radius_b;
        float depth_a, depth_b;  ///< in the form that is linear across the screen
        std::array<std::uint8_t, 4> colour;
        float lit;                          ///< 1: lit, 0: flat
        float ring;                         ///< half the ring's width; 0: not a ring
        std::array<std::int8_t, 4> facing;  ///< an edge's: the lighting normal of its surface, and 1
        glm::vec2 mitre;
    };
    /// Sorts in drawing order.
    struct SortEntry {
        std::uint64_t key;
        std::uint32_t stroke, outline;
        bool operator<(const SortEntry& other) const {
            return key != other.key ? key < other.key : stroke < other.stroke;
        }
    };

    void sort(const DrawList& list, const Camera& camera);
    static Instance instance(const Stroke& stroke, const ProjectedStroke& outline, const Frame& frame,
                             const Camera& camera);
    void set_uniforms(const Camera& camera, const Frame& frame) const;

    Program program_;
    Instances buffer_;
    // Members only to reuse their memory from frame to frame.
    std::vector<ProjectedStroke> outlines_;
    std::vector<SortEntry> order_;
    std::vector<Instance> instances_;
    std::size_t scene_count_ = 0;
};

}  // namespace tendril::app
