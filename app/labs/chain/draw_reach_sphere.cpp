#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "app/labs/chain/draw.hpp"

namespace tendril::app {
namespace {

/// What the eye sees of a sphere is smaller than its great circle, and nearer.
void outline(const View& view, DrawList& list, glm::vec3 centre, float radius) {
    const Camera& camera = view.camera;
    glm::vec3 middle = centre;
    float seen = radius;
    glm::vec3 towards = -camera.forward();
    if (!camera.pose().orthographic) {
        const float distance = glm::distance(camera.eye(), centre);
        if (!(distance > 1.001f * radius)) return;  // seen from within it has no outline
        towards = (camera.eye() - centre) / distance;
        const float share = radius / distance;
        middle = centre + towards * (radius * share);
        seen = radius * std::sqrt(1.0f - share * share);
    }
    const glm::vec3 across = glm::normalize(glm::cross(camera.up(), towards));
    draw_circle(list, middle, seen, across, glm::cross(towards, across), 1.5f * view.scale,
                faded(view.palette, view.palette.ghost, 0.38f));
}

}  // namespace

void draw_circle(DrawList& list, glm::vec3 centre, float radius, glm::vec3 across, glm::vec3 up, float pixels,
                 glm::vec4 colour) {
    constexpr int sides = 128;
    glm::vec3 from = centre + radius * across;
    for (int i = 1; i <= sides; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / sides;
        const glm::vec3 to = centre + radius * (std::cos(angle) * across + std::sin(angle) * up);
        list.line(from, to, pixels, colour);
        from = to;
    }
}

LabSetting reach_sphere() {
    return {.key = "reach sphere",
            .command = "view.reach_sphere",
            .title = "Show or hide sphere of reach",
            .argument = "show",
            .help = "Shows the sphere of what the chain can reach, in mode reach",
            .choices = {{"off", "hidden"}, {"on", "shown"}}};
}

void draw_reach_sphere(const View& view, const ShownChain& shown, DrawList& list) {
    if (shown.part.chain.size() < 2) return;
    const glm::vec3 root = shown.part.chain.position(0);
    const float reach = shown.part.chain.reach();
    if (!(reach > 0.0f)) return;
    outline(view, list, root, reach);
    const float high = std::abs(root.y);
    if (high >= reach) return;
    const glm::vec3 foot(root.x, 0.0f, root.z);
    draw_circle(list, foot, std::sqrt(reach * reach - high * high), {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f},
                view.scale, faded(view.palette, view.palette.ghost, 0.3f));
}

}  // namespace tendril::app
