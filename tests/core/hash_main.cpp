// Prints the number that the fixed session ends in; with --check it fails unless that is the committed one.
#include <cinttypes>
#include <cstdio>
#include <string_view>

#include "session.hpp"

int main(int count, char** arguments) {
    const std::uint64_t hash = tendril::test::session_hash();
    std::printf("%016" PRIx64 "\n", hash);
    if (count < 2 || std::string_view(arguments[1]) != "--check") return 0;
    if (hash == tendril::test::golden_session_hash) return 0;
    std::printf("expected %016" PRIx64 "\n", tendril::test::golden_session_hash);
    return 1;
}
