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
std::int64_t bytes_of(void* memory) noexcept {
    return memory ? static_cast<std::int64_t>(malloc_usable_size(memory)) : 0;
}
void* added(void* memory) noexcept {
    count(bytes_of(memory));
    return memory;
}

}  // namespace

// The linker replaces the C library's functions by these (CMakeLists.txt), in the program's own objects and
// those of stb.
extern "C" {
void* __real_malloc(std::size_t size) noexcept;
void* __real_calloc(std::size_t count, std::size_t size) noexcept;
void* __real_realloc(void* memory, std::size_t size) noexcept;
void __real_free(void* memory) noexcept;

void* __wrap_malloc(std::size_t size) noexcept {
    return added(__real_malloc(size));
}
void* __wrap_calloc(std::size_t count, std::size_t size) noexcept {
    return added(__real_calloc(count, size));
}
void* __wrap_realloc(void* memory, std::size_t size) noexcept {
    const std::int64_t before = bytes_of(memory);
    void* const moved = __real_realloc(memory, size);
    if (moved) count(bytes_of(moved) - before);
    return moved;
}
void __wrap_free(void* memory) noexcept {
    count(-bytes_of(memory));
    __real_free(memory);
}
}

void* operator new(std::size_t size) {
    void* const memory = std::malloc(size == 0 ? 1 : size);
    if (!memory) throw std::bad_alloc();
    return memory;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
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
