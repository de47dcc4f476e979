// The checksum of saved states.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tendril::door {

/// FNV-1a: changing any one byte changes it.
inline std::uint64_t checksum(const std::byte* bytes, std::size_t size, std::uint64_t kind) noexcept {
    std::uint64_t sum = 14695981039346656037u ^ kind;
    for (std::size_t i = 0; i < size; ++i)
        sum = (sum ^ static_cast<std::uint64_t>(bytes[i])) * 1099511628211u;
    return sum;
}

}  // namespace tendril::door
