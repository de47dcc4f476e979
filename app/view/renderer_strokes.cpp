#include "app/view/renderer_strokes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tendril::app {
namespace {

/// Bits that sort like the float, including negative values.
std::uint32_t ordered_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

constexpr std::uint64_t overlay_bit = 1ull << 63;

/// The scene before the overlay; within the overlay lower ranks first, so that the stroke that picking
/// prefers is on top; then farther ones first.
std::uint64_t drawing_key(const Stroke& stroke, float depth) {
    const std::uint64_t farther_first = ~ordered_bits(depth);
    if (stroke.layer == Layer::Scene) return farther_first;
    const auto rank = static_cast<std::uint64_t>(stroke.rank + 0x8000);
    return overlay_bit | rank << 32 | farther_first;
}

std::uint8_t byte(float value) {
    return static_cast<std::uint8_t>(255.0f * std::clamp(value, 0.0f, 1.0f) + 0.5f);
}

/// The lighting normal of an edge's surface, as in mesh.vert and mesh.frag: rotated by the rotation that
/// takes the line of sight to the view axis, and not facing away from the eye.
std::array<std::int8_t, 4> facing(const Stroke& edge, const Camera& camera) {
    const glm::vec3 right = camera.right(), up = camera.up(), towards = -camera.forward();
    const auto seen = [&](glm::vec3 v) {
        return glm::vec3(glm::dot(v, right), glm::dot(v, up), glm::dot(v, towards));
    };
    glm::vec3 normal = seen(edge.normal);
    if (!camera.pose().orthographic) {
        const glm::vec3 sight = seen(glm::normalize(camera.eye() - 0.5f * (edge.a + edge.b)));
        const glm::vec3 half_way = sight + glm::vec3(0.0f, 0.0f, 1.0f);
        const float along = 2.0f * glm::dot(sight, normal);
        normal -= glm::dot(half_way, normal) / std::max(1.0f + sight.z, 1e-3f) * half_way;
        normal.z += along;
    }
    normal.z = std::max(normal.z, 0.0f);
    normal *= 127.0f / std::max(glm::length(normal), 1.0f);
    const auto rounded = [](float value) {
        return static_cast<std::int8_t>(std::isfinite(value) ? std::lround(value) : 0);
    };
    return {rounded(normal.x), rounded(normal.y), rounded(normal.z), 127};
}

}  // namespace

StrokePass::StrokePass()
    : program_("stroke.vert", "stroke.frag"),
      buffer_(sizeof(Instance), std::array{Attribute{4, GL_FLOAT, offsetof(Instance, a)},
                                           Attribute{4, GL_FLOAT, offsetof(Instance, radius_a)},
                                           Attribute{4, GL_UNSIGNED_BYTE, offsetof(Instance, colour)},
                                           Attribute{2, GL_FLOAT, offsetof(Instance, lit)},
                                           Attribute{4, GL_BYTE, offsetof(Instance, facing)},
                                           Attribute{2, GL_FLOAT, offsetof(Instance, mitre)}}) {}

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
                                          const Frame& frame, const Camera& camera) {
    const bool orthographic = camera.pose().orthographic;
    const float ratio = frame.pixel_ratio, height = static_cast<float>(frame.framebuffer_size.y);
    const auto pixel = [&](glm::vec2 p) { return glm::vec2(ratio * p.x, height - ratio * p.y); };
    Instance out{.a = pixel(outline.a),
                 .b = pixel(outline.b),
                 .radius_a = ratio * outline.radius_a,
                 .radius_b = ratio * outline.radius_b,
                 .depth_a = orthographic ? outline.depth_a : 1.0f / outline.depth_a,
                 .depth_b = orthographic ? outline.depth_b : 1.0f / outline.depth_b,
                 .colour = {},
                 .lit = stroke.shade == Shade::Lit || stroke.shade == Shade::Edge ? 1.0f : 0.0f,
                 .ring = stroke.shade == Shade::Ring ? 0.5f * ratio * stroke.ring_width : 0.0f,
                 .facing = {},
                 .mitre = stroke.mitre};
    if (stroke.shade == Shade::Edge) out.facing = facing(stroke, camera);
    // The shader expects the larger end first.
    if (out.radius_a < out.radius_b) {
        std::swap(out.a, out.b);
        std::swap(out.radius_a, out.radius_b);
        std::swap(out.depth_a, out.depth_b);
        std::swap(out.mitre.x, out.mitre.y);
    }
    // Strokes are at least a pixel wide and fade instead of getting thinner, like the average of a sharper
    // screen.
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
    // The depth buffer's value is linear in the interpolated depth, orthographic or not.
    const float slope = orthographic ? -p[2][2] : p[3][2], offset = orthographic ? p[3][2] : -p[2][2];
    program_.set("to_window_depth", glm::vec2(0.5f * slope, 0.5f + 0.5f * offset));
    // Framebuffer pixels per metre: at a depth of 1 m; orthographic: everywhere.
    const glm::vec3 target = camera.pose().target;
    const float scale = frame.pixel_ratio / camera.metres_per_pixel(target);
    const float pixels_per_metre = orthographic ? scale : scale * camera.depth(target);
    program_.set("pixels_per_metre", pixels_per_metre);
    program_.set("metres_per_pixel", 1.0f / pixels_per_metre);
    // World up in camera space: the direction of the sky's light.
    program_.set("sky", glm::vec3(camera.right().y, camera.up().y, -camera.forward().y));
}

void StrokePass::prepare(const DrawList& list, const Camera& camera, const Frame& frame) {
    sort(list, camera);
    instances_.clear();
    scene_count_ = 0;
    for (const SortEntry& place : order_) {
        instances_.push_back(instance(list.strokes[place.stroke], outlines_[place.outline], frame, camera));
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
