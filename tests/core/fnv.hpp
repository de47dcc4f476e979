// The hash of a fixed session: 64-bit FNV-1a (Fowler, Noll, Vo 1991) over the bits of its results.
#pragma once

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <glm/vec3.hpp>

#include "tendril/result.hpp"

namespace tendril::test {

/// Sessions make no refused calls; a refusal would change the session.
inline void require(const Result& result) {
    if (result) return;
    std::fprintf(stderr, "%s\n", result.message());
    std::abort();
}

class Fnv {
  public:
    void add(float value) { add_bytes(std::bit_cast<std::uint32_t>(value), 32); }
    void add(double value) { add_bytes(std::bit_cast<std::uint64_t>(value), 64); }
    void add(const glm::vec3& point) {
        for (int axis = 0; axis < 3; ++axis) add(point[axis]);
    }
    std::uint64_t value() const { return hash_; }

  private:
    void add_bytes(std::uint64_t bits, int count) {
        for (int shift = 0; shift < count; shift += 8)
            hash_ = (hash_ ^ ((bits >> shift) & 0xffu)) * 0x100000001b3u;
    }

    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace tendril::test
