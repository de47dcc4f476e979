// How bodies and colliders of a rope world are pointed at: by the number of a slot and by how often the slot
// has been used. A handle of something that was removed finds nothing, even where its slot has a new tenant.
// A name for it is the program's business.
#pragma once

#include <cstdint>

namespace tendril::rope {

template <class Kind>
struct Handle {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t index = none;
    std::uint32_t generation = 0;  ///< odd of what there is

    /// Whether it was ever given out; what it points at may be gone.
    explicit operator bool() const noexcept { return index != none; }
    bool operator==(const Handle&) const = default;
};

using BodyId = Handle<struct BodyKind>;
using ColliderId = Handle<struct ColliderKind>;

}  // namespace tendril::rope
