// One call through the C interface: its first refusal, and the error for the caller.
//
// Functions that read arguments cannot fail: they return a harmless value and note the first refusal here. So
// a generated function reads all its arguments, checks refused() once, and calls the library.
#pragma once

#include <algorithm>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <span>

#include "tendril/c.h"
#include "tendril/result.hpp"

namespace tendril::door {

/// Maximum number of elements in a list. A larger number is refused as a mistake before anything is read.
inline constexpr std::size_t most_elements = 1'000'001;

/// A message under construction; text that does not fit is cut off.
class Text {
  public:
    Text(char* text, std::size_t size) noexcept : text_(text), left_(size) { *text = '\0'; }
    [[gnu::format(printf, 2, 3)]] void add(const char* format, ...) noexcept {
        std::va_list values;
        va_start(values, format);
        add(format, values);
        va_end(values);
    }
    [[gnu::format(printf, 2, 0)]] void add(const char* format, std::va_list values) noexcept {
        const int wanted = std::vsnprintf(text_, left_, format, values);
        const std::size_t used = std::min(static_cast<std::size_t>(wanted), left_ - 1);
        text_ += used;
        left_ -= used;
    }

  private:
    char* text_;
    std::size_t left_;
};

/// An argument, member or element as messages name it: "options.limits[2].kind".
struct Place {
    const char* name;
    const Place* above = nullptr;
    std::size_t index = TENDRIL_NONE;

    void write(Text& text) const noexcept {
        if (above != nullptr) above->write(text);
        if (index != TENDRIL_NONE)
            text.add("[%zu]", index);
        else
            text.add(above != nullptr ? ".%s" : "%s", name);
    }
};

class Call {
  public:
    Call(const char* operation, tendril_error* error) noexcept : operation_(operation), error_(error) {}
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    bool refused() const noexcept { return code_ != TENDRIL_OK; }
    tendril_code code() const noexcept { return code_; }

    /// Only the first refusal counts. The message: "ik_solve: joints is NULL".
    [[gnu::format(printf, 4, 5)]] void refuse(tendril_code code, const Place& place, const char* format,
                                              ...) noexcept {
        if (refused()) return;
        code_ = code;
        if (error_ == nullptr) return;
        error_->code = code;
        Text text(error_->message, sizeof error_->message);
        text.add("%s: ", operation_);
        place.write(text);
        text.add(" ");
        std::va_list values;
        va_start(values, format);
        text.add(format, values);
        va_end(values);
    }
    /// Passes on the library's own message.
    void refuse(const Result& result) noexcept {
        if (result || refused()) return;
        static_assert(static_cast<int>(ErrorCode::AlreadyExists) == TENDRIL_ALREADY_EXISTS);
        code_ = static_cast<tendril_code>(result.code());
        if (error_ == nullptr) return;
        error_->code = code_;
        Text(error_->message, sizeof error_->message).add("%s", result.message());
    }
    void no_memory() noexcept { refuse(TENDRIL_NO_MEMORY, {"memory"}, "ran out; nothing has changed"); }

    const char* operation() const noexcept { return operation_; }

  private:
    const char* operation_;
    tendril_error* error_;
    tendril_code code_ = TENDRIL_OK;
};

/// Runs `body` and catches its exceptions. The library throws only when memory runs out.
template <class Body>
tendril_code call(const char* operation, tendril_error* error, Body&& body) noexcept {
    Call made(operation, error);
    try {
        body(made);
    } catch (const std::bad_alloc&) {
        made.no_memory();
    }
    return made.code();
}

/// A list from a pointer and a count. Points and rotations have the same memory layout in C and C++.
template <class Cpp, class C>
std::span<Cpp> list(Call& call, const Place& place, C* elements, std::size_t count,
                    bool may_be_null) noexcept {
    static_assert(sizeof(Cpp) == sizeof(C) && alignof(Cpp) == alignof(C));
    if (elements == nullptr) {
        if (count > 0 || !may_be_null) call.refuse(TENDRIL_NULL_ARGUMENT, place, "is NULL");
        return {};
    }
    constexpr std::size_t most = sizeof(Cpp) == 1 ? most_elements * 1024 : most_elements;
    if (count > most) {
        call.refuse(TENDRIL_INVALID_ARGUMENT, place, "has %zu elements; the maximum is %zu", count, most);
        return {};
    }
    return {reinterpret_cast<Cpp*>(elements), count};
}

/// An enumeration as a number, which may be none of its values.
template <class C>
std::uint32_t number_of(const C& given) noexcept {
    static_assert(sizeof(C) == sizeof(std::uint32_t));
    std::uint32_t number;
    std::memcpy(&number, &given, sizeof number);
    return number;
}
template <class Cpp, class C>
void read_choice(Call& call, const Place& place, const C& given, Cpp& to,
                 std::span<const char* const> names) noexcept {
    const std::uint32_t number = number_of(given);
    if (number < names.size())
        to = static_cast<Cpp>(number);
    else
        call.refuse(TENDRIL_INVALID_ARGUMENT, place, "must be one of %s to %s, got %u", names.front(),
                    names.back(), number);
}

/// Sets the source of memory. Only this library's own `operator new` uses it.
void set_allocator(Call& call, const tendril_allocator* allocator) noexcept;

}  // namespace tendril::door
