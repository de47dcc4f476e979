#include "app/view/renderer_ground.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::app {
namespace {

/// The shadows' picture has one pixel for this many of the frame's, each way.
constexpr int coarseness = 2;

/// A plane to draw a grid on: two axes of the world, by number.
struct GridPlane {
    int u = 0, v = 2;
    float strength = 1.0f;
};

/// The ground; but looking level along an axis, in parallel projection, the ground is a line, and the grid
/// stands up behind the scene instead.
GridPlane grid_plane(const Camera& camera) {
    const glm::vec3 f = glm::abs(camera.forward());
    if (!camera.pose().orthographic) return {};
    const float level = std::max(f.x, f.z);
    const float aligned = std::clamp((level - 0.9990f) / 0.0009f, 0.0f, 1.0f);
    if (aligned <= 0.0f) return {};
    return f.z > f.x ? GridPlane{0, 1, aligned} : GridPlane{2, 1, aligned};
}

}  // namespace

GroundPass::GroundPass()
    : shadow_program_("shadow.vert", "shadow.frag"),
      grid_program_("grid.vert", "grid.frag"),
      buffer_(sizeof(Shadow), std::array{Attribute{4, GL_FLOAT, offsetof(Shadow, ends)},
                                         Attribute{4, GL_FLOAT, offsetof(Shadow, heights)}}),
      whole_(0, {}) {
    glGenFramebuffers(1, &framebuffer_);
    glGenTextures(1, &texture_);
}

GroundPass::~GroundPass() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
}

void GroundPass::allocate(glm::ivec2 size) {
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

void GroundPass::collect(const DrawList& list, const Camera& camera) {
    shadows_.clear();
    if (camera.eye().y <= 0.0f || camera.forward().y > -0.01f) return;  // the ground is not seen from above
    for (const Stroke& stroke : list.strokes) {
        if (!stroke.shadow) continue;
        float radius_a = stroke.radius_a, radius_b = stroke.radius_b;
        if (stroke.unit == Unit::Pixels) {
            radius_a *= camera.metres_per_pixel(stroke.a);
            radius_b *= camera.metres_per_pixel(stroke.b);
        }
        const float above = std::max(stroke.a.y + radius_a, stroke.b.y + radius_b);
        if (!(above > 0.0f) || !std::isfinite(above)) continue;
        shadows_.push_back(
            {{stroke.a.x, stroke.a.z, stroke.b.x, stroke.b.z}, {stroke.a.y, stroke.b.y, radius_a, radius_b}});
    }
}

int GroundPass::draw_shadows(const DrawList& list, const Camera& camera, float darkness, PixelRect viewport) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    allocate(glm::max((viewport.size + coarseness - 1) / coarseness, glm::ivec2(1)));
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, size_.x, size_.y);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    collect(list, camera);
    if (shadows_.empty()) return 0;

    glEnable(GL_BLEND);
    glBlendEquation(GL_MAX);
    shadow_program_.use();
    shadow_program_.set("to_clip", camera.projection() * camera.view());
    shadow_program_.set("darkness", darkness);
    buffer_.send(shadows_.data(), shadows_.size() * sizeof(Shadow));
    buffer_.draw(0, shadows_.size());
    glBlendEquation(GL_FUNC_ADD);
    return 1;
}

int GroundPass::draw_ground(const Camera& camera, const Palette& palette, const Frame& frame,
                            PixelRect viewport) const {
    const GridPlane plane = grid_plane(camera);
    const glm::vec3 target = camera.pose().target;
    // Ten metres away the lines are one metre apart; with every factor of ten both grow by ten.
    const float scale = std::max(camera.pose().distance, 0.5f * std::abs(camera.eye().y));
    const float decade = std::log10(scale / 10.0f), whole = std::floor(decade);
    const float spacing = std::pow(10.0f, whole);
    // Counted from a crossing of the coarsest lines nearby, as coordinates lose their fine digits far from
    // the origin.
    const float coarsest = 100.0f * spacing;
    glm::vec3 centre{0.0f};
    centre[plane.u] = coarsest * std::round(target[plane.u] / coarsest);
    centre[plane.v] = coarsest * std::round(target[plane.v] / coarsest);
    glm::vec3 axis_u{0.0f}, axis_v{0.0f};
    axis_u[plane.u] = 1.0f;
    axis_v[plane.v] = 1.0f;
    const std::array<glm::vec3, 3> axis_colours{palette.axis_x, palette.axis_y, palette.axis_z};

    grid_program_.use();
    grid_program_.set("to_clip", camera.projection() * camera.view());
    grid_program_.set("centre", centre);
    grid_program_.set("axis_u", axis_u);
    grid_program_.set("axis_v", axis_v);
    grid_program_.set("target",
                      glm::vec2(target[plane.u] - centre[plane.u], target[plane.v] - centre[plane.v]));
    grid_program_.set("reach", 16.0f * scale);
    grid_program_.set("spacing", spacing);
    grid_program_.set("finer_gone", decade - whole);
    grid_program_.set("origin", glm::vec2(-centre[plane.u], -centre[plane.v]));
    grid_program_.set("line_width", std::max(1.0f, frame.pixel_ratio));
    grid_program_.set("line_strength", frame.grid ? plane.strength : 0.0f);
    grid_program_.set("line_colour", palette.grid);
    grid_program_.set("u_colour", axis_colours[static_cast<std::size_t>(plane.u)]);
    grid_program_.set("v_colour", axis_colours[static_cast<std::size_t>(plane.v)]);
    grid_program_.set("shadows", 0);
    grid_program_.set("shadow_rect", glm::vec4(viewport.min, viewport.size));
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    whole_.draw(0, 1);
    return 1;
}

}  // namespace tendril::app
