// The shared library's own `operator new` and `delete`. It exports only tendril_* and has its own copy of the
// C++ library, so no other library's `delete` releases its blocks.

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

#include "call.hpp"

namespace tendril::door {
namespace {

void* plain_allocate(void*, std::size_t size, std::size_t alignment) {
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
void plain_release(void*, void* memory, std::size_t, std::size_t) {
    std::free(memory);
}

constexpr tendril_allocator plain{plain_allocate, plain_release, nullptr};
constinit tendril_allocator current = plain;
constinit std::atomic<std::size_t> live_blocks{0};

/// Stored before each block: the arguments of `release`. The block begins `alignment` bytes into its memory.
struct Head {
    std::size_t size, alignment;
};

[[maybe_unused]] void* allocate(std::size_t size, std::size_t alignment) noexcept {
    if (alignment < sizeof(Head)) alignment = sizeof(Head);
    if (size > std::numeric_limits<std::size_t>::max() / 2) return nullptr;
    void* const memory = current.allocate(current.user, size + alignment, alignment);
    if (memory == nullptr) return nullptr;
    ++live_blocks;
    std::byte* const block = static_cast<std::byte*>(memory) + alignment;
    new (block - sizeof(Head)) Head{size + alignment, alignment};
    return block;
}
[[maybe_unused]] void release(void* block) noexcept {
    if (block == nullptr) return;
    const Head head = *(static_cast<Head*>(block) - 1);
    --live_blocks;
    current.release(current.user, static_cast<std::byte*>(block) - head.alignment, head.size, head.alignment);
}
[[maybe_unused]] void* allocate_or_throw(std::size_t size, std::size_t alignment) {
    void* const block = allocate(size, alignment);
    if (block == nullptr) throw std::bad_alloc();
    return block;
}

}  // namespace

void set_allocator(Call& call, const tendril_allocator* allocator) noexcept {
#ifdef TENDRIL_C_ALLOCATOR
    if (allocator != nullptr && (allocator->allocate == nullptr || allocator->release == nullptr))
        call.refuse(TENDRIL_NULL_ARGUMENT, {"allocator"}, "must have both functions");
    else if (live_blocks > 0)
        call.refuse(TENDRIL_ALREADY_EXISTS, {"allocator"}, "must be set before the first object");
    if (!call.refused()) current = allocator != nullptr ? *allocator : plain;
#else
    static_cast<void>(allocator);
    call.refuse(TENDRIL_INVALID_ARGUMENT, {"allocator"}, "was left out of this build of the library");
#endif
}

}  // namespace tendril::door

#ifdef TENDRIL_C_ALLOCATOR
using tendril::door::allocate;
using tendril::door::allocate_or_throw;
using tendril::door::release;

void* operator new(std::size_t size) {
    return allocate_or_throw(size, 1);
}
void* operator new[](std::size_t size) {
    return allocate_or_throw(size, 1);
}
void* operator new(std::size_t size, std::align_val_t to) {
    return allocate_or_throw(size, std::size_t(to));
}
void* operator new[](std::size_t size, std::align_val_t to) {
    return allocate_or_throw(size, std::size_t(to));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, 1);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size, 1);
}
void* operator new(std::size_t size, std::align_val_t to, const std::nothrow_t&) noexcept {
    return allocate(size, std::size_t(to));
}
void* operator new[](std::size_t size, std::align_val_t to, const std::nothrow_t&) noexcept {
    return allocate(size, std::size_t(to));
}
void operator delete(void* block) noexcept {
    release(block);
}
void operator delete[](void* block) noexcept {
    release(block);
}
void operator delete(void* block, std::size_t) noexcept {
    release(block);
}
void operator delete[](void* block, std::size_t) noexcept {
    release(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
    release(block);
}
void operator delete[](void* block, std::align_val_t) noexcept {
    release(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
    release(block);
}
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
    release(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept {
    release(block);
}
void operator delete[](void* block, const std::nothrow_t&) noexcept {
    release(block);
}
void operator delete(void* block, std::align_val_t, const std::nothrow_t&) noexcept {
    release(block);
}
void operator delete[](void* block, std::align_val_t, const std::nothrow_t&) noexcept {
    release(block);
}
#endif
