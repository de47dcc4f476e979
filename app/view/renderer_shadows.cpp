#include "app/view/renderer_shadows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tendril::app {
namespace {

/// Frame pixels per pixel of the shadows' buffer, each way.
constexpr int coarseness = 4;
/// Above this many window pixels of shadow in total, see drop_faint().
constexpr float max_pixels = 3e7f;
/// Shadows with a strength below this are faint.
constexpr float faint = 0.4f;

/// How far a shadow extends from the axis's projection on the ground, and how dark it is there; as in
/// shadow.vert and shadow.frag.
float reach(float radius, float clearance) {
    return 2.6f * radius + 0.8f * clearance;
}
float strength(float radius, float clearance) {
    return radius / (radius + 0.35f * clearance);
}

/// The window pixels covered by the patch of ground around the line from `a` to `b`; the whole viewport if
/// part of it is beside or behind the eye.
Rect patch_on_screen(const Camera& camera, glm::vec3 a, glm::vec3 b, float extent) {
    const glm::vec3 axis = b - a;
    const float length = glm::length(axis);
    const glm::vec3 along = extent * (length > 1e-6f ? axis / length : glm::vec3(1.0f, 0.0f, 0.0f));
    const glm::vec3 across(-along.z, 0.0f, along.x);
    Rect box{glm::vec2(1e9f), glm::vec2(-1e9f)};
    for (const glm::vec3 corner :
         {a - along - across, a - along + across, b + along - across, b + along + across}) {
        if (camera.depth(corner) < camera.near_plane()) return camera.viewport();
        const std::optional<glm::vec2> pixel = camera.project(corner);
        if (!pixel) return camera.viewport();
        box = {glm::min(box.min, *pixel), glm::max(box.max, *pixel)};
    }
    return box;
}

}  // namespace

ShadowPass::ShadowPass()
    : buffer_(sizeof(Shadow), std::array{Attribute{4, GL_FLOAT, offsetof(Shadow, ends)},
                                         Attribute{4, GL_FLOAT, offsetof(Shadow, heights)}}) {
    glGenFramebuffers(1, &framebuffer_);
    glGenTextures(1, &texture_);
}

ShadowPass::~ShadowPass() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
}

void ShadowPass::allocate(glm::ivec2 size) {
    if (size == size_) return;
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, size.x, size.y, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    size_ = size;
}

void ShadowPass::add(const Stroke& stroke, const Camera& camera, float darkness) {
    glm::vec2 radius(stroke.radius_a, stroke.radius_b);
    if (stroke.unit == Unit::Pixels) {
        radius *= glm::vec2(camera.metres_per_pixel(stroke.a), camera.metres_per_pixel(stroke.b));
    }
    const glm::vec2 height(stroke.a.y, stroke.b.y);
    if (std::max(height.x + radius.x, height.y + radius.y) <= 0.0f) return;  // all below the ground
    const glm::vec2 clearance = glm::max(height - radius, glm::vec2(0.0f));
    const float darkest = std::max(strength(radius.x, clearance.x), strength(radius.y, clearance.y));
    if (!(darkness * darkest > 2.0f / 255.0f)) return;  // too faint to see
    const float extent = std::max(reach(radius.x, clearance.x), reach(radius.y, clearance.y));
    const glm::vec3 foot_a(stroke.a.x, 0.0f, stroke.a.z), foot_b(stroke.b.x, 0.0f, stroke.b.z);
    if (!std::isfinite(extent + foot_a.x + foot_a.z + foot_b.x + foot_b.z)) return;

    Rect box = patch_on_screen(camera, foot_a, foot_b, extent);
    box = {glm::max(box.min, camera.viewport().min), glm::min(box.max, camera.viewport().max)};
    const glm::vec2 size = box.size();
    if (size.x <= 0.0f || size.y <= 0.0f) return;

    shadows_.push_back({{foot_a.x, foot_a.z, foot_b.x, foot_b.z}, {height, radius}, darkest});
    bounds_ = {glm::min(bounds_.min, box.min), glm::max(bounds_.max, box.max)};
    area_ += size.x * size.y;
}

void ShadowPass::collect(const DrawList& list, const Camera& camera, float darkness) {
    shadows_.clear();
    bounds_ = {camera.viewport().max, camera.viewport().min};
    area_ = 0.0f;
    if (camera.eye().y <= 0.0f || camera.forward().y > -0.01f) return;  // the ground is not seen from above
    for (const Stroke& stroke : list.strokes) {
        if (stroke.shadow) add(stroke, camera, darkness);
    }
    drop_faint();
}

/// Thousands of faint shadows overlap, and only the darkest shows, so a few of them look the same. Keeps all
/// shadows of strokes close to the ground.
void ShadowPass::drop_faint() {
    constexpr std::size_t few = 500;
    const auto step = static_cast<std::size_t>(area_ / max_pixels) + 1;
    if (step == 1 || shadows_.size() <= few) return;
    std::size_t seen = 0;
    std::erase_if(shadows_,
                  [&](const Shadow& shadow) { return shadow.darkest < faint && seen++ % step != 0; });
}

int ShadowPass::prepare(const DrawList& list, const Camera& camera, float darkness, PixelRect viewport) {
    collect(list, camera, darkness);
    if (shadows_.empty()) return 0;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    allocate(glm::max((viewport.size + coarseness - 1) / coarseness, glm::ivec2(1)));
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glViewport(0, 0, size_.x, size_.y);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendEquation(GL_MAX);
    program_.use();
    program_.set("to_clip", camera.projection() * camera.view());
    program_.set("darkness", darkness);
    buffer_.send(shadows_.data(), shadows_.size() * sizeof(Shadow));
    buffer_.draw(0, shadows_.size());
    glBlendEquation(GL_FUNC_ADD);
    return 1;
}

int ShadowPass::draw(const Camera& camera) const {
    if (shadows_.empty()) return 0;
    over_program_.use();
    over_program_.set("shadows", 0);
    const glm::vec2 whole = camera.viewport().size();
    const glm::vec2 low = (bounds_.min - camera.viewport().min) / whole,
                    high = (bounds_.max - camera.viewport().min) / whole;
    over_program_.set("part", glm::vec4(low.x, 1.0f - high.y, high.x, 1.0f - low.y));
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    whole_.draw(0, 1);
    glBindTexture(GL_TEXTURE_2D, 0);
    return 1;
}

}  // namespace tendril::app
