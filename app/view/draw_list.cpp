#include "app/view/draw_list.hpp"

namespace tendril::app {

Stroke& DrawList::sphere(glm::vec3 centre, float radius, Unit unit, glm::vec4 colour) {
    return strokes.emplace_back(Stroke{
        .a = centre, .b = centre, .radius_a = radius, .radius_b = radius, .colour = colour, .unit = unit});
}

Stroke& DrawList::line(glm::vec3 a, glm::vec3 b, float width_pixels, glm::vec4 colour) {
    const float radius = 0.5f * width_pixels;
    return strokes.emplace_back(Stroke{.a = a,
                                       .b = b,
                                       .radius_a = radius,
                                       .radius_b = radius,
                                       .colour = colour,
                                       .unit = Unit::Pixels,
                                       .shade = Shade::Flat});
}

Stroke& DrawList::bone(glm::vec3 a, glm::vec3 b, float radius_a, float radius_b, glm::vec4 colour) {
    return strokes.emplace_back(
        Stroke{.a = a, .b = b, .radius_a = radius_a, .radius_b = radius_b, .colour = colour});
}

Stroke& DrawList::ring(glm::vec3 centre, float radius_pixels, float width_pixels, glm::vec4 colour) {
    return strokes.emplace_back(Stroke{.a = centre,
                                       .b = centre,
                                       .radius_a = radius_pixels,
                                       .radius_b = radius_pixels,
                                       .colour = colour,
                                       .ring_width = width_pixels,
                                       .unit = Unit::Pixels,
                                       .shade = Shade::Ring});
}

}  // namespace tendril::app
