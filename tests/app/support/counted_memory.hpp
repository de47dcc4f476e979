// The memory that code uses: allocations of the test program's own objects.
#pragma once

#include <cstddef>

namespace tendril::test {

/// Counts on its thread while it exists. Only one at a time.
class CountedMemory {
  public:
    CountedMemory();
    ~CountedMemory();
    CountedMemory(const CountedMemory&) = delete;
    CountedMemory& operator=(const CountedMemory&) = delete;

    /// The peak of the bytes allocated since the beginning.
    std::size_t peak() const;
};

}  // namespace tendril::test
