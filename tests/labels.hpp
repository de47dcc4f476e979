// Labels of tests, declared beside them, and how much a test does.
//
//     LABEL(slow, "RopeGain.*");  // names as GoogleTest lists them, with * and ?
//
// slow: takes seconds, here or under the sanitizers. Starts first, and does not run under the sanitizers: others run
// the same code there.
// nightly: runs in .ci/nightly alone.
// pictures, window: compare pictures; start the program in a window, and run beside the others.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace tendril::test {

struct Label {
    std::string_view name, tests;
};
std::vector<Label>& labels();
inline int add_label(std::string_view name, std::string_view tests) {
    labels().push_back({name, tests});
    return 0;
}
#define TENDRIL_JOINED(a, b) a##b
#define TENDRIL_LABEL(name, tests, line) \
    [[maybe_unused]] static const int TENDRIL_JOINED(label_, line) = ::tendril::test::add_label(name, tests)
#define LABEL(name, tests) TENDRIL_LABEL(#name, tests, __COUNTER__)

/// How much more time and memory a program may take under the sanitizers.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr int sanitizer_factor = 6;
#else
inline constexpr int sanitizer_factor = 1;
#endif
#elif defined(__SANITIZE_ADDRESS__)
inline constexpr int sanitizer_factor = 6;
#else
inline constexpr int sanitizer_factor = 1;
#endif

/// A test's number of rounds: `all` times TENDRIL_TEST_EFFORT, which is 0.3 by day and 0.05 under the
/// sanitizers. At least 1.
int rounds(int all);
/// Whether a round of a sweep runs: one in three, or one in ten under the sanitizers.
bool is_sampled(int round);
/// TENDRIL_TEST_EFFORT asks for more than all, as .ci/nightly does.
bool is_thorough();
/// TENDRIL_SEED, or else the usual one; prints it.
std::uint64_t given_seed(std::uint64_t usual = 20'260'301u);

}  // namespace tendril::test
