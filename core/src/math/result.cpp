#include "tendril/result.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace tendril {
namespace {

/// True for the first byte of a UTF-8 character, false for a continuation byte.
bool begins_character(char byte) noexcept {
    return (static_cast<unsigned char>(byte) & 0xc0u) != 0x80u;
}

}  // namespace

const char* name(ErrorCode code) noexcept {
    switch (code) {
        case ErrorCode::None:
            return "None";
        case ErrorCode::InvalidArgument:
            return "InvalidArgument";
        case ErrorCode::OutOfRange:
            return "OutOfRange";
        case ErrorCode::NotFound:
            return "NotFound";
        case ErrorCode::AlreadyExists:
            return "AlreadyExists";
    }
    return "";
}

Result::Result(ErrorCode code, std::string_view message) noexcept : code_(code) {
    std::size_t size = std::min(message.size(), max_message);
    while (size < message.size() && size > 0 && !begins_character(message[size])) --size;
    if (size > 0) std::memcpy(message_, message.data(), size);
    message_[size] = '\0';
}

/// The operation is a function's name before ": ".
const char* Result::reason() const noexcept {
    const std::size_t end = std::strspn(message_, "abcdefghijklmnopqrstuvwxyz_");
    return end > 0 && message_[end] == ':' && message_[end + 1] == ' ' ? message_ + end + 2 : message_;
}

Result::Result(const Result& other) noexcept {
    *this = other;
}

/// Copying a success, which every report holds, costs two bytes.
Result& Result::operator=(const Result& other) noexcept {
    code_ = other.code_;
    if (ok())
        message_[0] = '\0';
    else if (this != &other)
        std::memcpy(message_, other.message_, std::strlen(other.message_) + 1);
    return *this;
}

bool Result::operator==(const Result& other) const noexcept {
    return code_ == other.code_ && std::strcmp(message_, other.message_) == 0;
}

namespace detail {

void no_value(const char* message) noexcept {
    std::fprintf(stderr, "tendril: a value was read from an error: %s\n", message);
    std::abort();
}

}  // namespace detail
}  // namespace tendril
