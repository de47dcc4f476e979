#include "math/checks.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <initializer_list>

#include "tendril/handle.hpp"

namespace tendril::detail {
namespace {

/// A message under construction; text that does not fit is dropped.
class Message {
  public:
    template <class... Parts>
    explicit Message(const Parts&... parts) noexcept {
        (add(parts), ...);
    }
    Result as(ErrorCode code) const noexcept { return {code, {buffer_, size_}}; }

  private:
    void add(std::string_view text) noexcept {
        const std::size_t size = std::min(text.size(), sizeof buffer_ - size_);
        if (size > 0) std::memcpy(buffer_ + size_, text.data(), size);
        size_ += size;
    }
    void add(const Shown& value) noexcept { add(value.text()); }
    void add(const Argument& argument) noexcept {
        add(argument.name);
        if (argument.index != no_index) add("["), add(Shown(argument.index)), add("]");
        if (!argument.member.empty()) add("."), add(argument.member);
    }
    void add(const char* text) noexcept { add(std::string_view(text)); }

    char buffer_[2 * Result::max_message];
    std::size_t size_ = 0;
};

template <class Number>
std::string_view written(char (&buffer)[64], Number value) noexcept {
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, static_cast<std::size_t>(end.ptr - buffer)};
}

constexpr std::string_view coordinate_range = "finite and at most 1e9 in magnitude";
constexpr std::string_view length_range = "finite, at least 0 and at most 1e9";

}  // namespace

// Never "-nan": a NaN's sign means nothing.
Shown::Shown(float value) noexcept : text_(std::isnan(value) ? "nan" : written(buffer_, value)) {}
Shown::Shown(double value) noexcept : text_(std::isnan(value) ? "nan" : written(buffer_, value)) {}
Shown::Shown(int value) noexcept : text_(written(buffer_, value)) {}
Shown::Shown(std::size_t value) noexcept : text_(written(buffer_, value)) {}

Shown::Shown(const char* before, double value) noexcept {
    const Shown number(static_cast<float>(value));
    const std::size_t size = std::min(std::strlen(before), sizeof buffer_ - 33);
    std::memcpy(buffer_, before, size);
    buffer_[size] = ' ';
    std::memcpy(buffer_ + size + 1, number.text_.data(), number.text_.size());
    text_ = {buffer_, size + 1 + number.text_.size()};
}

Result refused(std::string_view operation, const Argument& argument, std::string_view requirement,
               const Shown& value) noexcept {
    return Message(operation, operation.empty() ? "" : ": ", argument, " must be ", requirement, ", got ",
                   value)
        .as(ErrorCode::InvalidArgument);
}

Result refused_length(std::string_view operation, const Argument& argument, float value) noexcept {
    return refused(operation, argument, length_range, value);
}

Result refused_point(std::string_view operation, const Argument& argument, const glm::vec3& value) noexcept {
    constexpr std::string_view axes[] = {"x", "y", "z"};
    std::size_t axis = 0;
    while (is_coordinate(value[static_cast<int>(axis)])) ++axis;
    const float found = value[static_cast<int>(axis)];
    return Message(operation, ": ", argument, ".", axes[axis], " must be ", coordinate_range, ", got ",
                   Shown(found))
        .as(ErrorCode::InvalidArgument);
}

Result refused_index(std::string_view operation, std::size_t index, std::size_t size, std::string_view whole,
                     std::string_view part) noexcept {
    return Message(operation, ": index ", Shown(index), " is out of range, ", whole, " has ", Shown(size),
                   " ", part, size == 1 ? "" : "s")
        .as(ErrorCode::OutOfRange);
}

Result refused_count(std::string_view operation, const Argument& argument, std::size_t count,
                     std::size_t wanted) noexcept {
    return Message(operation, ": ", argument, " must be ", Shown(wanted), " in number, got ", Shown(count))
        .as(ErrorCode::InvalidArgument);
}

Result refused_handle(std::string_view operation, const Argument& argument, std::uint32_t slot,
                      std::uint32_t generation, std::uint32_t uses, std::string_view whole) noexcept {
    if (slot == Handle<void>::none)
        return Message(operation, ": ", argument, " is an empty handle").as(ErrorCode::OutOfRange);
    const Shown number(static_cast<std::size_t>(slot));
    if (generation <= uses)
        return Message(operation, ": ", argument, " was removed (slot ", number, ")")
            .as(ErrorCode::OutOfRange);
    return Message(operation, ": ", argument, " is not a handle of this ", whole, " (slot ", number, ")")
        .as(ErrorCode::OutOfRange);
}

Result moved_from(std::string_view operation, std::string_view what) noexcept {
    return Message(operation, ": the ", what, " has been moved from").as(ErrorCode::InvalidArgument);
}

}  // namespace tendril::detail
