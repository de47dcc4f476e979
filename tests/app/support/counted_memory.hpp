// The memory that a piece of code takes: allocations of the test program's own objects.
#pragma once

#include <cstddef>

namespace tendril::test {

/// Counts while it lives, on its thread. Only one at a time.
class CountedMemory {
  public:
    CountedMemory();
    ~CountedMemory();
    CountedMemory(const CountedMemory&) = delete;
    CountedMemory& operator=(const CountedMemory&) = delete;

    /// Bytes: the most that was allocated at a time, of what was allocated since the beginning.
    std::size_t peak() const;
};

}  // namespace tendril::test
