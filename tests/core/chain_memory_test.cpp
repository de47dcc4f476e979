// An edit that runs out of memory leaves the chain unchanged; a pull needs no memory.
#include <cstdlib>
#include <new>

#include "chain_support.hpp"
#include "memory.hpp"

namespace tendril::test {
bool memory_is_out = false;
}

// These replace allocation in the whole test program; they fail only inside without_memory.
void* operator new(std::size_t size) {
    if (!tendril::test::memory_is_out) {
        if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    }
    throw std::bad_alloc();
}
// For the nothrow allocations of the standard library (stable_sort), which the operator below frees.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return tendril::test::memory_is_out ? nullptr : std::malloc(size == 0 ? 1 : size);
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

TEST(ChainMemory, PullsAndRemovalsNeedNone) {
    Chain chain = straight(50);
    without_memory([&] {
        expect_ok(chain.forward({1, 2, 3}));
        expect_ok(chain.backward({3, 2, 1}));
        expect_ok(chain.fixed({1, 1, 1}, {.iterations = 5}).outcome);
        expect_ok(chain.with_index(20, {0, 9, 0}));
        expect_ok(chain.set_length(3, 2.0f));
        expect_ok(chain.remove(7));
        chain.recalculate();
    });
    EXPECT_TRUE(Holds(chain));
}

}  // namespace
}  // namespace tendril::test
