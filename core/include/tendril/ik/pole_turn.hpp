// How a solve turns a chain to its pole: an option, and part of the state.
#pragma once

#include <cstdint>

namespace tendril::ik {

/// How a solve turns a chain to face its pole.
enum class PoleTurn : std::uint8_t {
    WholeChain,  ///< all joints at once about the line from root to tip: smooth
    EachJoint    ///< every middle joint about the line between its neighbours; within limits as WholeChain
};

}  // namespace tendril::ik
