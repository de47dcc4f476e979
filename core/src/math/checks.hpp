// Checks of the library's input, and the wording of their errors. Not installed.
//
// Each check returns a Result, success or the error; a function with several checks writes
//
//     if (const Result bad = check_point("forward", "target", target); !bad) return bad;
//
// Nothing here allocates, and no text is built unless a check fails.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "tendril/magnitude.hpp"
#include "tendril/result.hpp"

namespace tendril::detail {

// Each comparison is false for NaN, so NaN is never in range.
inline bool is_length(float value) noexcept {
    return value >= 0.0f && value <= max_magnitude;
}
inline bool is_coordinate(float value) noexcept {
    return std::abs(value) <= max_magnitude;
}
inline bool is_point(const glm::vec3& point) noexcept {
    return is_coordinate(point.x) && is_coordinate(point.y) && is_coordinate(point.z);
}

inline constexpr std::size_t no_index = static_cast<std::size_t>(-1);

/// Index of the first element with this name.
template <class Named>
std::optional<std::size_t> index_of_name(const std::vector<Named>& list, std::string_view name) noexcept {
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].name == name) return i;
    return std::nullopt;
}

/// An argument as messages name it: `target`, `joints[3]`, `segments[3].position`.
struct Argument {
    Argument(const char* what) noexcept : name(what) {}
    Argument(std::string_view what, std::size_t at = no_index, std::string_view part = {}) noexcept
        : name(what), index(at), member(part) {}
    std::string_view name;
    std::size_t index = no_index;
    std::string_view member{};
};

/// A value as shown in a message: the shortest text that reads back as the same number, NaN without a sign.
class Shown {
  public:
    Shown(float value) noexcept;
    Shown(double value) noexcept;
    Shown(int value) noexcept;
    Shown(std::size_t value) noexcept;
    /// `one of length 3`
    Shown(const char* before, double value) noexcept;
    /// Refers to the text, which must outlive this.
    Shown(const char* text) noexcept : text_(text) {}
    Shown(std::string_view text) noexcept : text_(text) {}
    Shown(const Shown&) = delete;
    Shown& operator=(const Shown&) = delete;
    std::string_view text() const noexcept { return text_; }

  private:
    char buffer_[64];
    std::string_view text_;
};

/// Builds `operation: argument must be requirement, got value`; an empty operation is omitted.
Result refused(std::string_view operation, const Argument& argument, std::string_view requirement,
               const Shown& value) noexcept;

// Error messages are built out of line, so that a passing check costs only its comparisons.
Result refused_length(std::string_view operation, const Argument& argument, float value) noexcept;
Result refused_point(std::string_view operation, const Argument& argument, const glm::vec3& value) noexcept;
Result refused_index(std::string_view operation, std::size_t index, std::size_t size, std::string_view whole,
                     std::string_view part) noexcept;
Result refused_count(std::string_view operation, const Argument& argument, std::size_t count,
                     std::size_t wanted) noexcept;

/// `remove: body was removed (slot 7)`, `... is an empty handle`, or `... is not a handle of this world (slot
/// 7)`. `uses`: number of times that the slot was taken and freed; 0 if there is no such slot.
Result refused_handle(std::string_view operation, const Argument& argument, std::uint32_t slot,
                      std::uint32_t generation, std::uint32_t uses, std::string_view whole) noexcept;

/// `solve: the solver has been moved from`
Result moved_from(std::string_view operation, std::string_view what) noexcept;

/// A member of `*held`, or an empty one if `held` has been moved away.
template <class Held, class Owner, class Member>
const Member& held_or_empty(const Held& held, Member Owner::*member) noexcept {
    if (held) return (*held).*member;
    static const Member empty{};
    return empty;
}

/// Metres, finite and 0 to max_magnitude.
inline Result check_length(std::string_view operation, const Argument& argument, float value) noexcept {
    return is_length(value) ? Result() : refused_length(operation, argument, value);
}
/// Metres, each coordinate finite and at most max_magnitude in magnitude.
inline Result check_point(std::string_view operation, const Argument& argument,
                          const glm::vec3& value) noexcept {
    return is_point(value) ? Result() : refused_point(operation, argument, value);
}
/// Checks index < size. `whole` and `part` name what is counted: `the chain has 8 segments`.
inline Result check_index(std::string_view operation, std::size_t index, std::size_t size,
                          std::string_view whole = "the chain", std::string_view part = "segment") noexcept {
    return index < size ? Result() : refused_index(operation, index, size, whole, part);
}
/// Checks that a list has `wanted` elements.
inline Result check_count(std::string_view operation, const Argument& argument, std::size_t count,
                          std::size_t wanted) noexcept {
    return count == wanted ? Result() : refused_count(operation, argument, count, wanted);
}

}  // namespace tendril::detail
