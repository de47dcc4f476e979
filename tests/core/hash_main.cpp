// Prints the hashes of the fixed sessions; with --check, fails unless they equal the committed ones.
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
    const Session sessions[] = {{"chains", session_hash(), golden_session_hash},
                                {"solves", solve_hash(), golden_solve_hash},
                                {"curves", curve_hash(), golden_curve_hash},
                                {"linkages", linkage_hash(), golden_linkage_hash},
                                {"ropes", rope_hash(), golden_rope_hash},
                                {"rigs", rig_hash(), golden_rig_hash},
                                {"rig solves", rig_solve_hash(), golden_rig_solve_hash},
                                {"signals", signal_hash(), golden_signal_hash},
                                {"characters", humanoid_hash(), golden_humanoid_hash}};
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
