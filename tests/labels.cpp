#include "tests/labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace tendril::test {
namespace {

double effort() {
    const char* const given = std::getenv("TENDRIL_TEST_EFFORT");
    return given != nullptr ? std::atof(given) : sanitizer_factor > 1 ? 0.05 : 0.3;
}

}  // namespace

std::vector<Label>& labels() {
    static std::vector<Label> all;
    return all;
}

int rounds(int all) {
    return std::max(static_cast<int>(effort() * all), 1);
}

bool is_sampled(int round) {
    return round % (10 / std::min(rounds(10), 10)) == 0;
}

bool is_thorough() {
    return effort() > 1.0;
}

std::uint64_t given_seed(std::uint64_t usual) {
    const char* const given = std::getenv("TENDRIL_SEED");
    const std::uint64_t value = given != nullptr ? std::strtoull(given, nullptr, 0) : usual;
    std::printf("seed %llu\n", static_cast<unsigned long long>(value));
    return value;
}

}  // namespace tendril::test

/// --labels lists a label and a pattern of tests in each line.
int main(int count, char** arguments) {
    testing::InitGoogleTest(&count, arguments);
    if (count < 2 || std::string_view(arguments[1]) != "--labels") return RUN_ALL_TESTS();
    for (const auto& [name, tests] : tendril::test::labels())
        std::printf("%.*s %.*s\n", static_cast<int>(name.size()), name.data(), static_cast<int>(tests.size()),
                    tests.data());
}
