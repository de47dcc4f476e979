#include "app/io/json_place.hpp"

#include <cmath>
#include <stdexcept>

#include "app/io/json_complete.hpp"

namespace tendril::app {

void JsonPlace::fail(const std::string& what) const {
    throw std::runtime_error(where_.empty() ? what : where_ + ": " + what);
}

bool JsonPlace::has(const char* key) const {
    return json_->is_object() && json_->contains(key);
}

JsonPlace JsonPlace::operator[](const char* key) const {
    return {json_member(*json_, key, where_), where_.empty() ? key : where_ + "." + key};
}

std::optional<JsonPlace> JsonPlace::optional(const char* key) const {
    if (!has(key) || (*json_)[key].is_null()) return std::nullopt;
    return (*this)[key];
}

JsonPlace JsonPlace::element(std::size_t index) const {
    return {(*json_)[index], where_ + "." + std::to_string(index)};
}

std::size_t JsonPlace::list_size(const char* what, std::size_t most) const {
    if (!json_->is_array()) fail("expected a list, found " + json_summary(*json_));
    if (json_->size() > most) {
        fail("has " + std::to_string(json_->size()) + " " + what + "; the maximum is " +
             std::to_string(most));
    }
    return json_->size();
}

void JsonPlace::check_size(std::size_t size, const char* of) const {
    if (json_->is_array() && json_->size() == size) return;
    fail("expected a list of " + std::to_string(size) + " " + of + ", found " + json_summary(*json_));
}

glm::quat JsonPlace::rotation() const {
    if (!json_->is_array() || json_->size() != 4)
        fail("expected a quaternion [x, y, z, w], found " + json_summary(*json_));
    const auto at = [&](std::size_t i) { return element(i).number(); };
    const glm::quat q(at(3), at(0), at(1), at(2));
    if (!(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0f) <= 1e-3f))
        fail("expected a unit quaternion, found " + json_summary(*json_));
    return q;
}

glm::dquat JsonPlace::drotation() const {
    check_size(4, "numbers: x, y, z, w");
    const auto at = [&](std::size_t i) { return element(i).real(-1.001, 1.001); };
    const double x = at(0), y = at(1), z = at(2), w = at(3);
    const double squared = x * x + y * y + z * z + w * w;
    if (squared < 0.99 || squared > 1.01)
        fail("expected a quaternion [x, y, z, w] of length 1, found " + json_summary(*json_));
    return {w, x, y, z};
}

}  // namespace tendril::app
