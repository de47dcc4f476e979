// Runs code without memory: meanwhile, every `new` in the test program throws std::bad_alloc.
#pragma once

namespace tendril::test {

/// Read by the operators that chain_memory_test.cpp replaces for the whole program.
extern bool memory_is_out;

template <class Call>
void without_memory(Call call) {
    memory_is_out = true;
    try {
        call();
    } catch (...) {
        memory_is_out = false;
        throw;
    }
    memory_is_out = false;
}

}  // namespace tendril::test
