// A refusal of the library becomes one of the program: the message is what the person reads.
#pragma once

#include <stdexcept>
#include <tendril/result.hpp>
#include <utility>

namespace tendril::app {

/// Throws std::invalid_argument with the result's message, unless all is fine.
inline void require_ok(const Result& result) {
    if (!result) throw std::invalid_argument(result.message());
}

/// The value, or std::invalid_argument with the message that says why there is none.
template <class T>
T require_value(Expected<T> expected) {
    if (!expected) throw std::invalid_argument(expected.message());
    return std::move(expected).value();
}

}  // namespace tendril::app
