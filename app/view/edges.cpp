#include "app/view/edges.hpp"

namespace tendril::app {

void Edges::outline(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour) {
    list_.strokes.push_back({.a = a,
                             .b = b,
                             .radius_a = width,
                             .radius_b = width,
                             .colour = glm::vec4(colour, 1.0f),
                             .normal = normal,
                             .unit = Unit::Pixels,
                             .shade = Shade::Edge});
}

void Edges::crease(glm::vec3 a, glm::vec3 b, glm::vec3 normal, glm::vec3 colour) {
    constexpr float pixels_nearer = 2.0f;
    const auto nearer = [&](glm::vec3 point) {
        const glm::vec3 way = to_eye(point);
        const float length = glm::length(way), step = pixels_nearer * camera_.metres_per_pixel(point);
        return length > step ? point + step / length * way : point;
    };
    outline(nearer(a), nearer(b), normal, colour);
}

}  // namespace tendril::app
