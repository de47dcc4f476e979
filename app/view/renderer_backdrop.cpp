#include "app/view/renderer_backdrop.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tendril::app {

PixelRect pixel_rect(const Rect& viewport, const Frame& frame) {
    const glm::vec2 limit(frame.framebuffer_size);
    const glm::vec2 low = glm::clamp(glm::round(viewport.min * frame.pixel_ratio), glm::vec2(0.0f), limit);
    const glm::vec2 high = glm::clamp(glm::round(viewport.max * frame.pixel_ratio), low, limit);
    return {glm::ivec2(low.x, limit.y - high.y), glm::ivec2(high - low)};
}

Backdrop::Backdrop() {
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(1, &colour_);
}

Backdrop::~Backdrop() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &colour_);
}

int Backdrop::draw_into_cache(const Key& key, const Palette& palette, const Frame& frame) const {
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, frame.framebuffer_size.x, frame.framebuffer_size.y);
    int calls = background_.draw(palette, frame);
    if (!frame.grid) return calls;
    glEnable(GL_SCISSOR_TEST);
    for (const Rect& each : key.viewports) {
        const PixelRect viewport = pixel_rect(each, frame);
        if (viewport.size.x <= 0 || viewport.size.y <= 0) continue;
        glScissor(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
        glViewport(viewport.min.x, viewport.min.y, viewport.size.x, viewport.size.y);
        calls += grid_.draw(Camera(key.pose, each), palette, frame);
    }
    return calls;
}

void Backdrop::cache(const Key& key, const Palette& palette, const Frame& frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    if (size_ != frame.framebuffer_size) {
        size_ = frame.framebuffer_size;
        glBindRenderbuffer(GL_RENDERBUFFER, colour_);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size_.x, size_.y);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    }
    cached_calls_ = draw_into_cache(key, palette, frame);
}

int Backdrop::draw(const CameraPose& pose, std::span<const Rect> viewports, const Palette& palette,
                   const Frame& frame) {
    const Key key{pose,
                  {viewports.begin(), viewports.end()},
                  {palette.background_top, palette.background_bottom, palette.grid, palette.axis_x,
                   palette.axis_y, palette.axis_z},
                  frame.framebuffer_size,
                  frame.pixel_ratio,
                  frame.grid,
                  frame.dither};
    if (cached_ != key) cache(key, palette, frame);
    cached_ = key;
    const glm::ivec2 size = frame.framebuffer_size;
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, frame.framebuffer);
    glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    return cached_calls_;
}

namespace {

/// The plane of the grid: two world axes, by number.
struct GridPlane {
    int u = 0, v = 2;
    float strength = 1.0f;
};

/// The ground plane. In parallel projection, looking horizontally along an axis, the ground is a line; then
/// the grid is vertical, behind the scene.
GridPlane grid_plane(const Camera& camera) {
    if (!camera.pose().orthographic) return {};
    const glm::vec3 f = glm::abs(camera.forward());
    const float aligned = std::clamp((std::max(f.x, f.z) - 0.9990f) / 0.0009f, 0.0f, 1.0f);
    if (aligned <= 0.0f) return {};
    return f.z > f.x ? GridPlane{0, 1, aligned} : GridPlane{2, 1, aligned};
}

glm::vec3 axis_direction(int axis) {
    glm::vec3 result{0.0f};
    result[axis] = 1.0f;
    return result;
}

/// Strengths of the three line sizes once the finest have faded by `faded`, 0 to 1.
glm::vec3 line_strengths(float faded, float all) {
    constexpr float minor = 0.34f, major = 0.62f;
    const float soft = faded * faded * (3.0f - 2.0f * faded);
    return all * glm::vec3(minor * (1.0f - soft), major + soft * (minor - major), major);
}

}  // namespace

int BackgroundPass::draw(const Palette& palette, const Frame& frame) const {
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    program_.use();
    program_.set("top", palette.background_top);
    program_.set("bottom", palette.background_bottom);
    program_.set("height", static_cast<float>(frame.framebuffer_size.y));
    program_.set("dither", frame.dither ? 1.0f : 0.0f);
    whole_.draw(0, 1);
    return 1;
}

int GridPass::draw(const Camera& camera, const Palette& palette, const Frame& frame) const {
    const GridPlane plane = grid_plane(camera);
    const glm::vec3 target = camera.pose().target;
    // At ten metres the lines are one metre apart; every factor of ten in distance makes the spacing ten
    // times larger.
    const float scale = std::max(camera.pose().distance, 0.5f * std::abs(camera.eye().y));
    const float decade = std::log10(scale / 10.0f), whole = std::floor(decade);
    const float spacing = std::pow(10.0f, whole);
    // Coordinates are relative to a nearby crossing of the coarsest lines, since those far from the origin
    // lack precision.
    const float coarsest = 100.0f * spacing;
    const glm::vec2 looked_at(target[plane.u], target[plane.v]);
    const glm::vec2 crossing = coarsest * glm::round(looked_at / coarsest);
    const std::array<glm::vec3, 3> axis_colours{palette.axis_x, palette.axis_y, palette.axis_z};

    program_.use();
    program_.set("to_clip", camera.projection() * camera.view());
    program_.set("centre", crossing.x * axis_direction(plane.u) + crossing.y * axis_direction(plane.v));
    program_.set("axis_u", axis_direction(plane.u));
    program_.set("axis_v", axis_direction(plane.v));
    program_.set("target", looked_at - crossing);
    program_.set("reach", 16.0f * scale);
    program_.set("per_metre", 1.0f / spacing);
    program_.set("strengths", line_strengths(decade - whole, plane.strength));
    program_.set("origin", -crossing);
    program_.set("half_width", 0.5f * std::max(1.0f, frame.pixel_ratio) + 0.5f);
    program_.set("line_colour", palette.grid);
    program_.set("u_colour", axis_colours[static_cast<std::size_t>(plane.u)]);
    program_.set("v_colour", axis_colours[static_cast<std::size_t>(plane.v)]);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    whole_.draw(0, 1);
    return 1;
}

}  // namespace tendril::app
