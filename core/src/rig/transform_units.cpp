#include "tendril/rig/transform_units.hpp"

#include "rig/math.hpp"

namespace tendril::rig {

using namespace detail;

Transform offset_transform(const Transform& item, const Transform& offset, double weight) noexcept {
    return blend(item, compose(item, offset), weight);
}

Transform set_transform(const Transform& item, const Transform& value, double weight) noexcept {
    return blend(item, value, weight);
}

Transform set_rotation(const Transform& item, const glm::dquat& rotation, double weight) noexcept {
    return {item.translation, blend(item.rotation, rotation, weight), item.scale};
}

Transform project_to_parent(const Transform& child, const Transform& old_parent,
                            const Transform& new_parent) noexcept {
    return compose(new_parent, relative(old_parent, child));
}

Transform project_to_parent(const Transform& item, const Transform& child, const Transform& old_parent,
                            const Transform& new_parent, double weight) noexcept {
    return blend(item, project_to_parent(child, old_parent, new_parent), weight);
}

glm::dquat from_two_vectors(const glm::dvec3& from, const glm::dvec3& to) noexcept {
    constexpr double shortest = 1e-9;
    const auto a = direction_of(from, shortest), b = direction_of(to, shortest);
    return a && b ? minimal_rotation(*a, *b) : glm::dquat{1.0, 0.0, 0.0, 0.0};
}

glm::dvec3 transform_location(const Transform& transform, const glm::dvec3& location) noexcept {
    return compose(transform, {.translation = location}).translation;
}

glm::dvec3 transform_direction(const Transform& transform, const glm::dvec3& direction) noexcept {
    return rotated(transform.rotation, direction);
}

}  // namespace tendril::rig
