#include "tests/app/support/counted_memory.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

thread_local bool counts = false;
thread_local std::int64_t live = 0, most = 0;

void count(std::int64_t bytes) noexcept {
    if (!counts) return;
    live += bytes;
    most = std::max(most, live);
}

}  // namespace

// These replace allocation in the whole test program.
void* operator new(std::size_t size) {
    void* const memory = std::malloc(size == 0 ? 1 : size);
    if (!memory) throw std::bad_alloc();
    count(static_cast<std::int64_t>(malloc_usable_size(memory)));
    return memory;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    void* const memory = std::malloc(size == 0 ? 1 : size);
    if (memory) count(static_cast<std::int64_t>(malloc_usable_size(memory)));
    return memory;
}
void operator delete(void* memory) noexcept {
    if (memory) count(-static_cast<std::int64_t>(malloc_usable_size(memory)));
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    operator delete(memory);
}

namespace tendril::test {

CountedMemory::CountedMemory() {
    live = most = 0;
    counts = true;
}
CountedMemory::~CountedMemory() {
    counts = false;
}
std::size_t CountedMemory::peak() const {
    return static_cast<std::size_t>(most);
}

}  // namespace tendril::test
