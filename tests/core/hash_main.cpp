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
                                {"solves", solve_hash(), 0x3f3a3d35f788b568u},
                                {"curves", curve_hash(), 0x091f8043d68a5fe2u},
                                {"linkages", linkage_hash(), 0x9f277fbe0ecdff6cu},
                                {"ropes", rope_hash(), 0x58e6200fc183a8cau},
                                {"rigs", rig_hash(), 0x179dea8ccf0e5998u},
                                {"rig solves", rig_solve_hash(), 0x96ff544984897dfdu},
                                {"signals", signal_hash(), 0x7deaff7769b479feu},
                                {"characters", humanoid_hash(), 0x9269190ede25ef29u}};
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
