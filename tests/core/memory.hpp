// Runs code with little or no memory: `new` in the test program then throws std::bad_alloc.
#pragma once

#include <cstddef>
#include <new>

namespace tendril::test {

inline constexpr std::size_t unlimited = ~std::size_t{0};
/// Sets how many more allocations succeed, for the operators in chain_memory_test.cpp. Code built without
/// exceptions may leak when one fails; the test does not count that.
void allow_allocations(std::size_t count);

/// Returns false if an allocation failed.
template <class Call>
bool with_allocations(std::size_t count, Call call) {
    allow_allocations(count);
    try {
        call();
    } catch (const std::bad_alloc&) {
        allow_allocations(unlimited);
        return false;
    } catch (...) {
        allow_allocations(unlimited);
        throw;
    }
    allow_allocations(unlimited);
    return true;
}
template <class Call>
void without_memory(Call call) {
    if (!with_allocations(0, call)) throw std::bad_alloc();
}

}  // namespace tendril::test
