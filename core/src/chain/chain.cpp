// Reading and editing. The modes are in modes.cpp, bulk loading in load.cpp.
#include "tendril/chain/chain.hpp"

#include <algorithm>

#include "chain/checks.hpp"
#include "chain/pull.hpp"

namespace tendril {

float Chain::reach() const noexcept {
    double sum = 0.0;  // in double: a float would lose a million short lengths
    for (std::size_t i = 1; i < size(); ++i) sum += static_cast<double>(segments_[i].length);
    return static_cast<float>(sum);
}

Result Chain::set_default_direction(glm::vec3 direction) {
    if (const Result bad = detail::check_point("set_default_direction", "direction", direction); !bad)
        return bad;
    const double x = direction.x, y = direction.y, z = direction.z;
    const double length = std::sqrt(x * x + y * y + z * z);
    if (std::abs(length - 1.0) > 1e-3) {
        return detail::refused("set_default_direction", "direction", "a unit vector",
                               {"one of length", length});
    }
    // Kept if it is a unit vector to float precision: a saved direction must load unchanged.
    if (std::abs(length - 1.0) > 2e-7) {
        direction = {static_cast<float>(x / length), static_cast<float>(y / length),
                     static_cast<float>(z / length)};
    }
    default_direction_ = direction;
    return {};
}

bool Chain::has_point_at(glm::vec3 position) const noexcept {
    return std::any_of(segments_.begin(), segments_.end(),
                       [&](const Segment& segment) { return detail::coincide(segment.position, position); });
}

glm::vec3 Chain::bone_direction(std::size_t from, std::size_t to) const noexcept {
    return detail::direction(segments_[from].position, segments_[to].position, default_direction_);
}

void Chain::recalculate() noexcept {
    if (!empty()) detail::pull_towards_tail(segments_, 0, segments_.front().position, default_direction_);
}

Result Chain::add(float length) {
    if (const Result bad = detail::check_length("add", "length", length); !bad) return bad;
    glm::vec3 position{0.0f};
    if (!empty()) {
        const std::size_t tail = size() - 1;
        const glm::vec3 along = tail > 0 ? bone_direction(tail - 1, tail) : default_direction_;
        position = detail::moved(segments_[tail].position, along, length);
    }
    segments_.push_back({position, length});
    return {};
}

Result Chain::add(const Segment& segment) {
    if (const Result bad = detail::check_segment("add", "segment", segment); !bad) return bad;
    if (has_point_at(segment.position)) return add(segment.length);
    segments_.push_back(segment);
    recalculate();
    return {};
}

Result Chain::insert(std::size_t index, const Segment& segment) {
    if (const Result bad = detail::check_index("insert", index, size()); !bad) return bad;
    if (const Result bad = detail::check_segment("insert", "segment", segment); !bad) return bad;
    if (has_point_at(segment.position)) return insert(index, segment.length);
    segments_.insert(segments_.begin() + static_cast<std::ptrdiff_t>(index), segment);
    recalculate();
    return {};
}

Result Chain::insert(std::size_t index, float length) {
    if (const Result bad = detail::check_index("insert", index, size()); !bad) return bad;
    if (const Result bad = detail::check_length("insert", "length", length); !bad) return bad;
    if (index == 0) {
        const glm::vec3 along = size() > 1 ? bone_direction(0, 1) : default_direction_;
        const Segment& head = segments_.front();
        segments_.insert(segments_.begin(),
                         Segment{detail::moved(head.position, along, -head.length), length});
        return {};
    }
    const glm::vec3 along = bone_direction(index - 1, index);
    const glm::vec3 position = detail::moved(segments_[index - 1].position, along, length);
    segments_.insert(segments_.begin() + static_cast<std::ptrdiff_t>(index), Segment{position, length});
    for (std::size_t i = index + 1; i < size(); ++i) {
        segments_[i].position = detail::moved(segments_[i].position, along, length);
    }
    recalculate();
    return {};
}

Result Chain::remove(std::size_t index) {
    if (const Result bad = detail::check_index("remove", index, size()); !bad) return bad;
    segments_.erase(segments_.begin() + static_cast<std::ptrdiff_t>(index));
    recalculate();
    return {};
}

Result Chain::set_length(std::size_t index, float length) {
    if (const Result bad = detail::check_index("set_length", index, size()); !bad) return bad;
    if (const Result bad = detail::check_length("set_length", "length", length); !bad) return bad;
    segments_[index].length = length;
    recalculate();
    return {};
}

}  // namespace tendril
