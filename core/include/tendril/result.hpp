// The result of an editing call: success, or an error code and a message that names the argument and its
// value.
//
// Nothing in the library throws, and it can be compiled without exceptions and RTTI. A refused call changes
// nothing. Neither type allocates: the message is stored inline and truncated if it is too long.
//
//     if (const Result result = chain.insert(9, 1.0f); !result) log(result.message());
//     // "insert: index 9 is out of range, the chain has 4 segments"
//
//     Expected<ik::Solver> solver = ik::Solver::make(lengths);
//     if (!solver) return log(solver.message());
//     solver->solve(...);
//
// A broken precondition is not a refusal: reading `*expected` without a value is a bug in the calling
// program, which ends with the message on stderr.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>

namespace tendril {

enum class ErrorCode : std::uint8_t {
    None,             ///< success
    InvalidArgument,  ///< a number that is not finite or out of its range, a list of the wrong size
    OutOfRange,       ///< an index out of range, or the handle of a removed object
    NotFound,         ///< an unknown name
    AlreadyExists     ///< a name that is in use
};
/// "InvalidArgument"
const char* name(ErrorCode code) noexcept;

/// The outcome of a call that may be refused.
class [[nodiscard]] Result {
  public:
    /// Longest message in bytes; longer ones are cut between characters.
    static constexpr std::size_t max_message = 199;

    /// Success.
    Result() noexcept { message_[0] = '\0'; }
    /// Refused; `code` is not None.
    Result(ErrorCode code, std::string_view message) noexcept;
    Result(const Result& other) noexcept;
    Result& operator=(const Result& other) noexcept;

    bool ok() const noexcept { return code_ == ErrorCode::None; }
    explicit operator bool() const noexcept { return ok(); }
    ErrorCode code() const noexcept { return code_; }
    /// `insert: index 9 is out of range, the chain has 4 segments`; empty on success.
    const char* message() const noexcept { return message_; }
    /// The message without the operation: `index 9 is out of range, the chain has 4 segments`.
    const char* reason() const noexcept;
    bool operator==(const Result& other) const noexcept;

  private:
    ErrorCode code_ = ErrorCode::None;
    char message_[max_message + 1];
};

namespace detail {
/// Writes the message to stderr and ends the program.
[[noreturn]] void no_value(const char* message) noexcept;
}  // namespace detail

/// A T, or the reason why there is none.
template <class T>
class [[nodiscard]] Expected {
  public:
    Expected(T value) : held_(std::in_place_index<0>, std::move(value)) {}
    /// `error` is not ok().
    Expected(const Result& error) noexcept : held_(std::in_place_index<1>, error) {}

    bool ok() const noexcept { return held_.index() == 0; }
    explicit operator bool() const noexcept { return ok(); }
    /// Success if there is a value.
    Result error() const noexcept {
        const Result* error = std::get_if<1>(&held_);
        return error ? *error : Result();
    }
    ErrorCode code() const noexcept { return ok() ? ErrorCode::None : std::get_if<1>(&held_)->code(); }
    /// Empty if there is a value.
    const char* message() const noexcept { return ok() ? "" : std::get_if<1>(&held_)->message(); }

    const char* reason() const noexcept { return ok() ? "" : std::get_if<1>(&held_)->reason(); }

    /// The value, which must exist.
    T& value() & noexcept { return *held(); }
    const T& value() const& noexcept { return *held(); }
    T&& value() && noexcept { return std::move(*held()); }
    T& operator*() & noexcept { return *held(); }
    const T& operator*() const& noexcept { return *held(); }
    T&& operator*() && noexcept { return std::move(*held()); }
    T* operator->() noexcept { return held(); }
    const T* operator->() const noexcept { return held(); }

  private:
    T* held() noexcept {
        if (!ok()) detail::no_value(message());
        return std::get_if<0>(&held_);
    }
    const T* held() const noexcept {
        if (!ok()) detail::no_value(message());
        return std::get_if<0>(&held_);
    }

    std::variant<T, Result> held_;
};

}  // namespace tendril
