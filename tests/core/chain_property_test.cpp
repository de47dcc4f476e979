// Random operations: the invariant holds after every operation, a refusal leaves the chain bitwise unchanged,
// and a pinned point is bitwise at its pin. Prints the seed; TENDRIL_SEED=<number> sets it.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "chain_support.hpp"
#include "random.hpp"

namespace tendril::test {
namespace {

std::uint64_t seed() {
    const char* given = std::getenv("TENDRIL_SEED");
    const std::uint64_t value = given ? std::strtoull(given, nullptr, 0) : 20'260'101u;
    std::printf("seed %llu\n", static_cast<unsigned long long>(value));
    return value;
}

float hostile_number(Random& random) {
    constexpr float numbers[] = {nan,    infinity, -infinity, 1e9f,   -1e9f,   1e10f,  -1e10f,
                                 -1.0f,  -0.0f,    0.0f,      1e-40f, -1e-40f, 1e-45f, 3e38f,
                                 1e-30f, 3.4e-4f,  3.5e-4f,   5e8f,   1e-7f};
    return numbers[random.below(std::size(numbers))];
}

float some_length(Random& random) {
    if (random.chance(25)) return hostile_number(random);
    if (random.chance(10)) return 0.0f;
    const float scale[] = {0.001f, 1.0f, 4.0f, 10.0f};
    return std::abs(random.around(scale[random.below(4)]));
}

glm::vec3 some_point(const Chain& chain, Random& random) {
    if (!chain.empty() && random.chance(10)) return chain.segments()[random.below(chain.size())].position;
    glm::vec3 point = random.point(random.chance(30) ? 1e9f : 200.0f);
    if (random.chance(25)) point[static_cast<int>(random.below(3))] = hostile_number(random);
    return point;
}

std::size_t some_index(const Chain& chain, Random& random) {
    constexpr std::size_t hostile[] = {SIZE_MAX, SIZE_MAX - 1, SIZE_MAX / 2, SIZE_MAX / 16, 1u << 31};
    if (random.chance(25)) return hostile[random.below(std::size(hostile))];
    return random.below(chain.size() + 1);  // sometimes one too many
}

/// The exact position that a pull must give a point.
struct Pin {
    bool set = false;
    Result outcome{};  ///< of the call; if refused, nothing has moved
    std::size_t index = 0;
    glm::vec3 position{0.0f};
};

Pin pull(Chain& chain, Random& random) {
    const bool empty = chain.empty();
    const std::size_t tail = empty ? 0 : chain.size() - 1;
    const glm::vec3 target = some_point(chain, random);
    switch (random.below(4)) {
        case 0:
            return {!empty, chain.forward(target), 0, target};
        case 1:
            return {!empty, chain.backward(target), tail, target};
        case 2: {
            Pin pin{!empty, {}, tail, empty ? target : chain.position(tail)};
            const bool negative = random.chance(20);
            const int iterations = static_cast<int>(random.below(6)) - (negative ? 3 : -1);
            pin.outcome =
                chain.fixed(target, {.iterations = iterations, .tolerance = some_length(random)}).outcome;
            return pin;
        }
        default: {
            const std::size_t index = some_index(chain, random);
            return {!empty, chain.with_index(index, target), index, target};
        }
    }
}

Pin operate(Chain& chain, Random& random) {
    if (random.chance(2)) return pull(chain, random);
    const Segment segment{some_point(chain, random), some_length(random)};
    const std::size_t index = some_index(chain, random);
    switch (random.below(chain.size() > 64 ? 1 : 8)) {
        case 0:
            return {.outcome = chain.remove(index)};
        case 1:
            return {.outcome = chain.set_length(index, segment.length)};
        case 2:
            return {.outcome = chain.insert(index, segment.length)};
        case 3:
            return {.outcome = chain.insert(index, segment)};
        case 4:
            return {.outcome = chain.add(segment.length)};
        case 5:
            return {.outcome = chain.add(segment)};
        case 6:
            chain.recalculate();
            break;
        default:
            return {.outcome = chain.set_default_direction(random.chance(2) ? segment.position
                                                                            : glm::vec3(0, 1, 0))};
    }
    return {};
}

/// Saving and loading keeps every bit, unless the chain is outside the range that can be loaded.
bool comes_back(const Chain& chain) {
    const auto segments = chain.segments();
    for (const Segment& segment : segments) {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(segment.position[axis]) > max_magnitude) return true;
        }
    }
    return same_bits(*Chain::from_segments({segments.begin(), segments.end()}, chain.default_direction()),
                     chain);
}

TEST(ChainProperty, AHundredThousandHostileOperations) {
    Random random(seed());
    Chain chain, before;
    std::size_t longest = 0;
    int refused = 0, near = 0, pinned = 0;
    for (int i = 0; i < 100'000; ++i) {
        if (random.chance(250)) chain = Chain();  // a length of 1e9 would otherwise keep it far out
        before = chain;
        const Pin pin = operate(chain, random);
        if (!pin.outcome) {
            ++refused;
            ASSERT_TRUE(same_bits(chain, before)) << "operation " << i << ": " << pin.outcome.message();
        } else if (pin.set) {
            ++pinned;
            ASSERT_TRUE(same_bits(chain.position(pin.index), pin.position)) << "operation " << i;
        }
        ASSERT_TRUE(Holds(chain)) << "operation " << i;
        ASSERT_TRUE(comes_back(chain)) << "operation " << i;
        longest = std::max(longest, chain.size());
        near += !chain.empty() && lies_within(chain, 1e3);
    }
    std::printf("%d refused, %d pulled, %d ended within 1e3 m, at most %zu segments\n", refused, pinned, near,
                longest);
    EXPECT_GT(refused, 5'000);  // enough of each to be a test
    EXPECT_GT(pinned, 20'000);
    EXPECT_GT(near, 30'000);
}

TEST(ChainProperty, TenThousandRandomChains) {
    Random random(seed() + 1);
    for (int i = 0; i < 10'000; ++i) {
        Chain chain;
        const std::size_t count = 1 + random.below(64);
        for (std::size_t k = 0; k < count; ++k) {
            const float length = std::abs(random.around(5.0f));
            expect_ok(random.chance(3) ? chain.add(length)
                                       : chain.add(Segment{random.point(200.0f), length}));
        }
        ASSERT_TRUE(Holds(chain)) << "chain " << i;
        const glm::vec3 target = random.point(500.0f);
        const std::size_t index = random.below(count);

        expect_ok(chain.forward(target));
        ASSERT_TRUE(same_bits(chain.position(0), target) && Holds(chain)) << "chain " << i << ", forward";
        expect_ok(chain.backward(-target));
        ASSERT_TRUE(same_bits(chain.position(count - 1), -target) && Holds(chain))
            << "chain " << i << ", backward";
        expect_ok(chain.fixed(target, {.iterations = 4}).outcome);
        ASSERT_TRUE(same_bits(chain.position(count - 1), -target) && Holds(chain))
            << "chain " << i << ", fixed";
        expect_ok(chain.with_index(index, target));
        ASSERT_TRUE(same_bits(chain.position(index), target) && Holds(chain))
            << "chain " << i << ", with index";
    }
}

}  // namespace
}  // namespace tendril::test
