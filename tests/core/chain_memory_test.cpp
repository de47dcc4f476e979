// An edit that runs out of memory leaves the chain unchanged; a pull needs no memory.
#include <cstdlib>

#include "chain_support.hpp"
#include "memory.hpp"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#include <sanitizer/lsan_interface.h>
#define __SANITIZE_ADDRESS__
#endif
#endif

namespace {
std::size_t allocations_left = tendril::test::unlimited;

void* allocated(std::size_t size) noexcept {
    if (allocations_left != tendril::test::unlimited && allocations_left-- == 0) {
        allocations_left = 0;
        return nullptr;
    }
    return std::malloc(size == 0 ? 1 : size);
}
}  // namespace

void tendril::test::allow_allocations(std::size_t count) {
#if defined(__SANITIZE_ADDRESS__)
    if ((count == unlimited) != (allocations_left == unlimited))
        count == unlimited ? __lsan_enable() : __lsan_disable();
#endif
    allocations_left = count;
}

// These replace allocation in the whole test program.
void* operator new(std::size_t size) {
    if (void* memory = allocated(size)) return memory;
    throw std::bad_alloc();
}
// For the nothrow allocations of the standard library (stable_sort), which the operator below frees.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocated(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace tendril::test {
namespace {

TEST(ChainMemory, AFailedEditChangesNothing) {
    Chain chain =
        *Chain::from_segments({{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{2, 0, 0}, 1}});  // no spare capacity
    const Chain before = chain;
    EXPECT_THROW(without_memory([&] { static_cast<void>(chain.add(1.0f)); }), std::bad_alloc);
    EXPECT_THROW(without_memory([&] {
                     static_cast<void>(chain.add(Segment{{5, 5, 5}, 1}));
                 }),
                 std::bad_alloc);
    EXPECT_THROW(without_memory([&] { static_cast<void>(chain.insert(0, 1.0f)); }), std::bad_alloc);
    EXPECT_THROW(without_memory([&] { static_cast<void>(chain.insert(2, 1.0f)); }), std::bad_alloc);
    EXPECT_THROW(without_memory([&] {
                     static_cast<void>(chain.insert(1, Segment{{5, 5, 5}, 1}));
                 }),
                 std::bad_alloc);
    EXPECT_TRUE(same_bits(chain, before));
}

TEST(ChainMemory, PullsAndRemovalsAllocateNothing) {
    Chain chain = straight(50);
    without_memory([&] {
        expect_ok(chain.forward({1, 2, 3}));
        expect_ok(chain.backward({3, 2, 1}));
        expect_ok(chain.fixed({1, 1, 1}, {.iterations = 5}).accepted);
        expect_ok(chain.with_index(20, {0, 9, 0}));
        expect_ok(chain.set_length(3, 2.0f));
        expect_ok(chain.remove(7));
        chain.recalculate();
    });
    EXPECT_TRUE(Holds(chain));
}

}  // namespace
}  // namespace tendril::test
