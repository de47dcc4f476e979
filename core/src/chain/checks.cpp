#include "chain/checks.hpp"

#include <charconv>
#include <stdexcept>

namespace tendril::detail {

Result check_segment(std::string_view operation, const Argument& argument, const Segment& value) noexcept {
    if (const Result bad =
            check_point(operation, {argument.name, argument.index, "position"}, value.position);
        !bad) {
        return bad;
    }
    return check_length(operation, {argument.name, argument.index, "length"}, value.length);
}

std::string text(float value) {
    if (std::isnan(value)) return "nan";  // never "-nan": the sign of a NaN says nothing
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end.ptr};
}

void refuse(std::string_view operation, std::string_view argument, std::string_view requirement,
            std::string_view value) {
    std::string message;
    message.append(operation).append(": ").append(argument).append(" must be ").append(requirement);
    throw std::invalid_argument(message.append(", got ").append(value));
}

void require_length(std::string_view operation, std::string_view argument, float value) {
    if (!is_length(value)) refuse(operation, argument, "finite, at least 0 and at most 1e9", text(value));
}

void require_point(std::string_view operation, std::string_view argument, const glm::vec3& value) {
    constexpr std::string_view axes[] = {".x", ".y", ".z"};
    for (int axis = 0; axis < 3; ++axis) {
        if (is_coordinate(value[axis])) continue;
        refuse(operation, std::string(argument).append(axes[axis]), "finite and at most 1e9 in magnitude",
               text(value[axis]));
    }
}

void require_segment(std::string_view operation, std::string_view argument, const Segment& value) {
    if (is_point(value.position) && is_length(value.length)) return;  // builds no text where nothing is wrong
    require_point(operation, std::string(argument).append(".position"), value.position);
    require_length(operation, std::string(argument).append(".length"), value.length);
}

void require_index(std::string_view operation, std::size_t index, std::size_t size) {
    if (index < size) return;
    std::string message(operation);
    message.append(": index ").append(std::to_string(index)).append(" is out of range, the chain has ");
    message.append(std::to_string(size)).append(size == 1 ? " segment" : " segments");
    throw std::out_of_range(message);
}

}  // namespace tendril::detail
