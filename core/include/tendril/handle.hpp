// What names a thing that can go away: the index of a slot and its generation, which counts how often the
// slot was taken and freed. A handle of something that was removed finds nothing, even where its slot is in
// use again. Names are up to the program.
#pragma once

#include <cstdint>

namespace tendril {

template <class Kind>
struct Handle {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t index = none;
    std::uint32_t generation = 0;  ///< odd of what there is

    /// Whether it was ever given out; what it points at may be gone.
    explicit operator bool() const noexcept { return index != none; }
    bool operator==(const Handle&) const = default;
};

}  // namespace tendril
