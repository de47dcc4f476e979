// Shared by all fuzz targets: their registration, and a check that ends the program with its claim.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace tendril::fuzz {

/// Makes `run` the target called `name`. The list of targets is in main.cpp.
struct Target {
    Target(const char* name, void (*run)(std::string_view));

    const char* name;
    void (*run)(std::string_view);
    const Target* next;
};

/// Ends the program with the claim that does not hold; the fuzzer then saves the input.
inline void check(bool holds, const char* claim) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", claim);
    std::abort();
}

/// Writes the labs' scenes that are small enough, for the fuzzer to start with.
void write_scenes(const std::filesystem::path& folder);

}  // namespace tendril::fuzz

#define FUZZ_TARGET(name)                                                 \
    static void fuzz_##name(std::string_view text);                       \
    static const tendril::fuzz::Target target_##name(#name, fuzz_##name); \
    static void fuzz_##name(std::string_view text)
