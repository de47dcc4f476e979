#include "app/labs/rope/lock_roots.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace tendril::app {
namespace {

glm::vec3 unit(glm::vec3 direction) {
    const float length = glm::length(direction);
    if (!(length > 0.0f && std::isfinite(length))) throw std::invalid_argument("direction must not be zero");
    return direction / length;
}

/// A point of the patch: how far from its middle, and which way.
struct Seat {
    float distance = 0.0f;
    glm::vec3 outwards{1.0f, 0.0f, 0.0f};  ///< unit, across the direction
};

/// Seats in the order of a sunflower's seeds, which leave no gap at any number (H. Vogel, "A better way to
/// construct the sunflower head", 1979).
std::vector<Seat> seats(const LockPatch& patch, glm::vec3 direction) {
    constexpr float golden_angle = 2.3999632f;
    const glm::vec3 least = std::abs(direction.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 first = glm::normalize(glm::cross(direction, least));
    const glm::vec3 second = glm::cross(direction, first);
    std::vector<Seat> found;
    found.reserve(static_cast<std::size_t>(patch.strands));
    for (int i = 0; i < patch.strands; ++i) {
        const float part = (static_cast<float>(i) + 0.5f) / static_cast<float>(patch.strands);
        const float angle = golden_angle * static_cast<float>(i);
        found.push_back({patch.spread * std::sqrt(part), std::cos(angle) * first + std::sin(angle) * second});
    }
    return found;
}

}  // namespace

std::vector<rope::LockShape::Root> roots_around(const LockPatch& patch) {
    const glm::vec3 direction = unit(patch.direction.value_or(glm::vec3(0, -1, 0)));
    std::vector<rope::LockShape::Root> roots;
    for (const Seat& seat : seats(patch, direction))
        roots.push_back({patch.centre + seat.distance * seat.outwards, direction});
    return roots;
}

std::vector<rope::LockShape::Root> roots_on(const rope::Shape& shape, const LockPatch& patch, float lift) {
    const auto* plane = std::get_if<rope::Plane>(&shape);
    const glm::vec3 otherwise = plane != nullptr ? plane->normal : glm::vec3(0, 1, 0);
    const glm::vec3 direction = unit(patch.direction.value_or(otherwise));
    const glm::vec3 centre = rope::centre(shape);
    const float size = plane != nullptr ? 0.0f : rope::size(shape);
    std::vector<rope::LockShape::Root> roots;
    for (const Seat& seat : seats(patch, direction)) {
        // A round way along a ball of the collider's size, and from there to its surface.
        const float angle = size > 0.0f ? seat.distance / size : 0.0f;
        const glm::vec3 from =
            size > 0.0f ? centre + size * (std::cos(angle) * direction + std::sin(angle) * seat.outwards)
                        : centre + seat.distance * seat.outwards;
        const rope::SurfaceDistance surface = rope::surface_distance(shape, from);
        const glm::vec3 normal(surface.normal);
        roots.push_back({from + (lift - static_cast<float>(surface.distance)) * normal, normal});
    }
    return roots;
}

}  // namespace tendril::app
