// The handle of an object that can be removed: the index of its slot, and a generation that counts how often
// the slot was taken and freed. The handle of a removed object finds nothing, even if its slot has been
// reused. Objects have no names; the program keeps its own.
#pragma once

#include <cstdint>

namespace tendril {

template <class Kind>
struct Handle {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t index = none;
    std::uint32_t generation = 0;  ///< odd while the slot is in use

    /// True if it was ever issued. The object may have been removed since.
    explicit operator bool() const noexcept { return index != none; }
    bool operator==(const Handle&) const = default;
};

}  // namespace tendril
