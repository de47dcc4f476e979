#include "app/view/renderer_strokes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tendril::app {
namespace {

/// Sorts as the float does, also below zero.
std::uint32_t ordered_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

constexpr std::uint64_t overlay_bit = 1ull << 63;

/// The scene before the overlay; within the overlay the lower rank first, so that what picking prefers is on
/// top; then the farther first.
std::uint64_t drawing_key(const Stroke& stroke, float depth) {
    const std::uint64_t farther_first = ~ordered_bits(depth);
    if (stroke.layer == Layer::Scene) return farther_first;
    const auto rank = static_cast<std::uint64_t>(stroke.rank + 0x8000);
    return overlay_bit | rank << 32 | farther_first;
}

std::uint8_t byte(float value) {
    return static_cast<std::uint8_t>(255.0f * std::clamp(value, 0.0f, 1.0f) + 0.5f);
}

}  // namespace

StrokePass::StrokePass()
    : program_("stroke.vert", "stroke.frag"),
      buffer_(sizeof(Instance), std::array{Attribute{4, GL_FLOAT, offsetof(Instance, a)},
                                           Attribute{4, GL_FLOAT, offsetof(Instance, radius_a)},
                                           Attribute{4, GL_UNSIGNED_BYTE, offsetof(Instance, colour)},
                                           Attribute{2, GL_FLOAT, offsetof(Instance, lit)}}) {}

void StrokePass::sort(const DrawList& list, const Camera& camera) {
    const StrokeProjector projector(camera);
    outlines_.clear();
    order_.clear();
    ProjectedStroke outline;
    for (std::size_t i = 0; i < list.strokes.size(); ++i) {
        const Stroke& stroke = list.strokes[i];
        if (!(stroke.colour.a > 0.0f) || !projector.project(stroke, outline)) continue;
        order_.push_back({drawing_key(stroke, outline.depth()), static_cast<std::uint32_t>(i),
                          static_cast<std::uint32_t>(outlines_.size())});
        outlines_.push_back(outline);
    }
    std::sort(order_.begin(), order_.end());
}

StrokePass::Instance StrokePass::instance(const Stroke& stroke, const ProjectedStroke& outline,
                                          const Frame& frame, bool orthographic) {
    const float ratio = frame.pixel_ratio, height = static_cast<float>(frame.framebuffer_size.y);
    const auto pixel = [&](glm::vec2 p) { return glm::vec2(ratio * p.x, height - ratio * p.y); };
    Instance out{.a = pixel(outline.a),
                 .b = pixel(outline.b),
                 .radius_a = ratio * outline.radius_a,
                 .radius_b = ratio * outline.radius_b,
                 .depth_a = orthographic ? outline.depth_a : 1.0f / outline.depth_a,
                 .depth_b = orthographic ? outline.depth_b : 1.0f / outline.depth_b,
                 .colour = {},
                 .lit = stroke.shade == Shade::Lit ? 1.0f : 0.0f,
                 .ring = stroke.shade == Shade::Ring ? 0.5f * ratio * stroke.ring_width : 0.0f};
    // The shader wants the larger end first.
    if (out.radius_a < out.radius_b) {
        std::swap(out.a, out.b);
        std::swap(out.radius_a, out.radius_b);
        std::swap(out.depth_a, out.depth_b);
    }
    // Nothing is drawn thinner than a pixel; it fades instead, which is what a sharper screen would average
    // to.
    constexpr float thinnest = 0.5f;
    const float wanted = out.radius_a + out.radius_b;
    out.radius_a = std::max(out.radius_a, thinnest);
    out.radius_b = std::max(out.radius_b, thinnest);
    float opacity = wanted / (out.radius_a + out.radius_b);
    if (out.a == out.b) opacity *= opacity;  // a ball is thin both ways
    if (out.ring > 0.0f && out.ring < thinnest) {
        opacity *= out.ring / thinnest;
        out.ring = thinnest;
    }
    out.colour = {byte(stroke.colour.r), byte(stroke.colour.g), byte(stroke.colour.b),
                  byte(stroke.colour.a * opacity)};
    return out;
}

void StrokePass::set_uniforms(const Camera& camera, const Frame& frame) const {
    const glm::mat4& p = camera.projection();
    const bool orthographic = camera.pose().orthographic;
    program_.set("framebuffer_size", glm::vec2(frame.framebuffer_size));
    program_.set("orthographic", orthographic ? 1.0f : 0.0f);
    // Depth in the buffer is a straight line in the interpolated one, orthographic or not.
    const float slope = orthographic ? -p[2][2] : p[3][2], offset = orthographic ? p[3][2] : -p[2][2];
    program_.set("to_window_depth", glm::vec2(0.5f * slope, 0.5f + 0.5f * offset));
    // Framebuffer pixels to a metre: at a depth of 1 m, or everywhere.
    const glm::vec3 target = camera.pose().target;
    const float scale = frame.pixel_ratio / camera.metres_per_pixel(target);
    const float pixels_per_metre = orthographic ? scale : scale * camera.depth(target);
    program_.set("pixels_per_metre", pixels_per_metre);
    program_.set("metres_per_pixel", 1.0f / pixels_per_metre);
    // World up, seen by the camera: where the sky's light comes from.
    program_.set("sky", glm::vec3(camera.right().y, camera.up().y, -camera.forward().y));
}

void StrokePass::prepare(const DrawList& list, const Camera& camera, const Frame& frame) {
    sort(list, camera);
    instances_.clear();
    scene_count_ = 0;
    for (const Place& place : order_) {
        instances_.push_back(instance(list.strokes[place.stroke], outlines_[place.outline], frame,
                                      camera.pose().orthographic));
        if ((place.key & overlay_bit) == 0) ++scene_count_;
    }
    buffer_.send(instances_.data(), instances_.size() * sizeof(Instance));
    program_.use();
    set_uniforms(camera, frame);
}

int StrokePass::draw(Layer layer) const {
    const bool scene = layer == Layer::Scene;
    const std::size_t first = scene ? 0 : scene_count_;
    const std::size_t count = scene ? scene_count_ : instances_.size() - scene_count_;
    if (count == 0) return 0;
    program_.use();
    (scene ? glEnable : glDisable)(GL_DEPTH_TEST);
    glDepthMask(scene ? GL_TRUE : GL_FALSE);
    glDepthFunc(GL_LEQUAL);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    buffer_.draw(first, count);
    return 1;
}

}  // namespace tendril::app
