// Rotations in scene files, [x, y, z, w], with all their digits.
#pragma once

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"

namespace tendril::app {

inline Json quaternion(const glm::dquat& q) {
    return Json::array({q.x, q.y, q.z, q.w});
}

inline glm::dquat read_quaternion(const JsonPlace& place) {
    place.check_size(4, "numbers: x, y, z, w");
    const auto at = [&](std::size_t i) { return place.element(i).real(-1.001, 1.001); };
    const double x = at(0), y = at(1), z = at(2), w = at(3);
    const double length = x * x + y * y + z * z + w * w;
    if (length < 0.99 || length > 1.01) place.fail("expected a quaternion [x, y, z, w] of length 1");
    return {w, x, y, z};
}

}  // namespace tendril::app
