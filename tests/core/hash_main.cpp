// Prints the hashes of the fixed sessions; with --check, fails unless they equal these. If one changes, saved
// scenes and recordings play differently.
#include <cinttypes>
#include <cstdio>
#include <string_view>

#include "session.hpp"

int main(int count, char** arguments) {
    using namespace tendril::test;
    struct Session {
        const char* name;
        std::uint64_t hash, golden;
    };
    const Session sessions[] = {{"chains", session_hash(), 0xf7b7c11b0c7f4723u},
                                {"solves", solve_hash(), 0x3e2a0f3abfa96d25u},
                                {"curves", curve_hash(), 0xc984494022b79a60u},
                                {"linkages", linkage_hash(), 0x6c5a5599856d4789u},
                                {"ropes", rope_hash(), 0xed9df244451ffe5fu},
                                {"rigs", rig_hash(), 0xa096d19a1c0f4457u},
                                {"rig solves", rig_solve_hash(), 0xc444cb318688c5e9u},
                                {"signals", signal_hash(), 0x013ce1f6e58deff3u},
                                {"characters", humanoid_hash(), 0xa33d26d97e39aa3au}};
    const bool check = count > 1 && std::string_view(arguments[1]) == "--check";
    int different = 0;
    for (const auto& [name, hash, golden] : sessions) {
        std::printf("%s %016" PRIx64 "\n", name, hash);
        if (!check || hash == golden) continue;
        std::printf("expected %016" PRIx64 "\n", golden);
        different = 1;
    }
    return different;
}
