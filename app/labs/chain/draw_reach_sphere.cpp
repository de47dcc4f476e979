#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "app/labs/chain/draw.hpp"

namespace tendril::app {
namespace {

/// A circle as short lines; `across` and `up` are of length 1 and at right angles.
void circle(const View& view, DrawList& list, glm::vec3 centre, float radius, glm::vec3 across, glm::vec3 up,
            float width, float strength) {
    constexpr int sides = 128;
    const glm::vec4 colour = faded(view.palette, view.palette.ghost, strength);
    glm::vec3 from = centre + radius * across;
    for (int i = 1; i <= sides; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / sides;
        const glm::vec3 to = centre + radius * (std::cos(angle) * across + std::sin(angle) * up);
        list.line(from, to, width * view.scale, colour);
        from = to;
    }
}

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
    circle(view, list, middle, seen, across, glm::cross(towards, across), 1.5f, 0.38f);
}

}  // namespace

LabSetting reach_sphere() {
    return {.key = "reach sphere",
            .command = "view.reach_sphere",
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
    circle(view, list, foot, std::sqrt(reach * reach - high * high), {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f},
           1.0f, 0.3f);
}

}  // namespace tendril::app
