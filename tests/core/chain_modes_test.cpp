// The four modes: moving and fixed joints, and degenerate directions.
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "chain_support.hpp"
#include "random.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace {

const glm::vec3 targets[] = {
    {0.3f, -7.1f, 2.9f}, {1e-30f, 0, -0.0f}, {1e9f, -1e9f, 1e9f}, {2, 0, 0}, {0, 0, 0}};

TEST(ChainModes, ForwardPullsFromTheHead) {
    Chain chain = straight(3);
    expect_ok(chain.forward({0, 2, 0}));
    const glm::vec3 p1 = glm::vec3(0, 2, 0) + glm::vec3(1, -2, 0) / std::sqrt(5.0f);
    const glm::vec3 to = glm::vec3(2, 0, 0) - p1;
    expect_positions(chain, {{0, 2, 0}, p1, p1 + to / std::sqrt(to.x * to.x + to.y * to.y)});
}

TEST(ChainModes, BackwardPullsFromTheTail) {
    Chain chain;
    for (const float length : {9.0f, 1.0f, 2.0f}) expect_ok(chain.add(length));
    expect_ok(chain.backward({3, 4, 0}));  // the tail was at (3,0,0), the middle joint at (1,0,0)
    const glm::vec3 p1 = glm::vec3(3, 4, 0) + glm::vec3(-2, -4, 0) * (2.0f / std::sqrt(20.0f));
    const glm::vec3 to = -p1;
    expect_positions(chain, {p1 + to / std::sqrt(to.x * to.x + to.y * to.y), p1, {3, 4, 0}});
}

TEST(ChainModes, FixedIsForwardThenBackwardToTheTail) {
    Chain chain = straight(5), by_hand = straight(5);
    const FixedResult result = chain.fixed({1, 2, 3});
    expect_ok(by_hand.forward({1, 2, 3}));
    expect_ok(by_hand.backward({4, 0, 0}));
    EXPECT_TRUE(same_bits(chain, by_hand));
    EXPECT_EQ(result.iterations, 1);
    EXPECT_NEAR(result.residual, distance(chain.position(0), {1, 2, 3}), 1e-6);
}

TEST(ChainModes, FixedReachesATargetWithinReach) {
    Chain chain = straight(6);
    const FixedResult result = chain.fixed({2, 3, 0.5f}, {.iterations = 500, .tolerance = 1e-3f});
    EXPECT_LE(result.residual, 1e-3f);
    EXPECT_GT(result.iterations, 1);
    EXPECT_LT(result.iterations, 500);
    EXPECT_TRUE(same_bits(chain.position(5), {5, 0, 0}));
    EXPECT_TRUE(Holds(chain));
}

TEST(ChainModes, FixedStretchesTowardsATargetOutOfReach) {
    Chain chain = straight(4);
    const FixedResult result = chain.fixed({3, 10, 0}, {.iterations = 50});
    EXPECT_EQ(result.iterations, 50);
    EXPECT_NEAR(result.residual, 7.0f, 1e-3f);
    EXPECT_TRUE(same_bits(chain.position(3), {3, 0, 0}));
}

TEST(ChainModes, WithIndexPullsBothSides) {
    Chain chain = straight(5);
    expect_ok(chain.with_index(2, {2, 3, 0}));
    const float s = 1 / std::sqrt(10.0f);
    expect_positions(chain, {{}, {2 - s, 3 - 3 * s, 0}, {2, 3, 0}, {2 + s, 3 - 3 * s, 0}, {}}, 10.0);
    EXPECT_LE(distance(chain.position(1), {2 - s, 3 - 3 * s, 0}), 1e-5);
    EXPECT_LE(distance(chain.position(3), {2 + s, 3 - 3 * s, 0}), 1e-5);
    EXPECT_NEAR(chain.position(0).x, 4 - chain.position(4).x, 1e-5f);  // a mirror image
    EXPECT_NEAR(chain.position(0).y, chain.position(4).y, 1e-5f);
}

TEST(ChainModes, WithIndexAtTheEndsIsForwardAndBackward) {
    Chain a = straight(4), b = straight(4), c = straight(4), d = straight(4);
    expect_ok(a.with_index(0, {1, 5, 2}));
    expect_ok(b.forward({1, 5, 2}));
    expect_ok(c.with_index(3, {1, 5, 2}));
    expect_ok(d.backward({1, 5, 2}));
    EXPECT_TRUE(same_bits(a, b));
    EXPECT_TRUE(same_bits(c, d));
}

TEST(ChainModes, AnEmptyChainStaysEmpty) {
    Chain chain;
    expect_ok(chain.forward({1, 2, 3}));
    expect_ok(chain.backward({1, 2, 3}));
    const FixedResult result = chain.fixed({1, 2, 3}, {.iterations = 9});
    expect_ok(chain.with_index(0, {1, 2, 3}));
    EXPECT_TRUE(chain.empty());
    EXPECT_EQ(result.iterations, 0);
    EXPECT_EQ(result.residual, 0.0f);
}

TEST(ChainModes, ASingleSegmentMovesInAllButFixed) {
    Chain chain = straight(1);
    expect_ok(chain.forward({1, 2, 3}));
    EXPECT_TRUE(same_bits(chain.position(0), {1, 2, 3}));
    expect_ok(chain.backward({4, 5, 6}));
    EXPECT_TRUE(same_bits(chain.position(0), {4, 5, 6}));
    expect_ok(chain.with_index(0, {7, 8, 9}));
    EXPECT_TRUE(same_bits(chain.position(0), {7, 8, 9}));
    const FixedResult result = chain.fixed({7, 8, 19}, {.iterations = 9});
    EXPECT_TRUE(same_bits(chain.position(0), {7, 8, 9}));
    EXPECT_EQ(result.iterations, 0);
    EXPECT_EQ(result.residual, 10.0f);
}

TEST(ChainModes, AStepBetweenCoincidingPointsGoesAlongTheDefaultDirection) {
    Chain chain = along(glm::vec3(0, 1, 0));
    expect_ok(chain.add(Segment{{0, 0, 0}, 1}));
    expect_ok(chain.add(Segment{{1, 0, 0}, 1}));
    expect_ok(chain.forward({1, 0, 0}));  // onto its neighbour
    expect_positions(chain, {{1, 0, 0}, {1, 1, 0}});
    expect_ok(chain.backward({1, 0.0003f, 0}));  // nearer to the head than the root of FLT_EPSILON
    expect_positions(chain, {{1, 1.0003f, 0}, {1, 0.0003f, 0}});
    expect_ok(chain.forward({1, 0.0007f, 0}));  // and further
    expect_positions(chain, {{1, 0.0007f, 0}, {1, -0.9993f, 0}});
}

TEST(ChainModes, AChainOfZeroLengthsCollapsesOntoTheTarget) {
    Chain chain = straight(5, 0.0f);
    for (const glm::vec3 target : targets) {
        expect_ok(chain.forward(target));
        for (const Segment& segment : chain.segments()) EXPECT_EQ(segment.position, target);
        expect_ok(chain.with_index(2, -target));
        for (const Segment& segment : chain.segments()) EXPECT_EQ(segment.position, -target);
    }
}

TEST(ChainModes, HugeLengthsStayFinite) {
    Chain chain;
    for (int i = 0; i < 2000; ++i) expect_ok(chain.add(1e9f));
    EXPECT_TRUE(Holds(chain));
    expect_ok(chain.with_index(1000, {-1e9f, 1e9f, 1e9f}));
    EXPECT_TRUE(Holds(chain));
    expect_ok(chain.fixed({1e9f, 1e9f, 1e9f}, {.iterations = 3}).accepted);
    EXPECT_TRUE(Holds(chain));
    for (std::size_t i = 0; i < chain.size(); ++i) expect_ok(chain.set_length(i, 0.25f));
    expect_ok(chain.forward({0, 0, 0}));
    EXPECT_TRUE(lies_within(chain, 1e3));
    EXPECT_TRUE(Holds(chain));
}

// Random operations: the invariant holds after every one, a refusal leaves the chain bitwise unchanged, and a
// pinned point is bitwise at its pin. Prints the seed; TENDRIL_SEED=<number> sets it.

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
    return random.below(chain.size() + 1);  // one past the end at times
}

/// The exact position that a pull must give a point.
struct Pin {
    bool set = false;
    Result outcome{};  ///< the call's; if refused, nothing has moved
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
                chain.fixed(target, {.iterations = iterations, .tolerance = some_length(random)}).accepted;
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

/// Whether saving and loading keeps every bit; true if the chain is outside the range that can be loaded.
bool round_trips(const Chain& chain) {
    const auto segments = chain.segments();
    for (const Segment& segment : segments)
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(segment.position[axis]) > max_magnitude) return true;
        }
    return same_bits(*Chain::from_segments({segments.begin(), segments.end()}, chain.default_direction()),
                     chain);
}

LABEL(slow, "ChainProperty.AHundredThousandHostileOperations");

TEST(ChainProperty, AHundredThousandHostileOperations) {
    Random random(given_seed(20'260'101u));
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
        ASSERT_TRUE(round_trips(chain)) << "operation " << i;
        longest = std::max(longest, chain.size());
        near += !chain.empty() && lies_within(chain, 1e3);
    }
    std::printf("%d refused, %d pulled, %d ended within 1e3 m, at most %zu segments\n", refused, pinned, near,
                longest);
    EXPECT_GT(refused, 5'000);  // enough of each for a fair test
    EXPECT_GT(pinned, 20'000);
    EXPECT_GT(near, 30'000);
}

// Numeric cases from an independent implementation in double precision. Skipped if the files are missing; the
// other tests do not need them.

using Json = nlohmann::json;

glm::vec3 point(const Json& json) {
    return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

Result apply(Chain& chain, const Json& op) {
    const std::string name = op.at("op");
    const auto index = [&] { return op.at("index").get<std::size_t>(); };
    const auto length = [&] { return op.at("length").get<float>(); };
    const auto target = [&] { return point(op.at("target")); };
    if (name == "add" && op.contains("position")) return chain.add(Segment{point(op["position"]), length()});
    if (name == "add") return chain.add(length());
    if (name == "insert" && op.contains("position"))
        return chain.insert(index(), Segment{point(op["position"]), length()});
    if (name == "insert") return chain.insert(index(), length());
    if (name == "remove") return chain.remove(index());
    if (name == "set_length") return chain.set_length(index(), length());
    if (name == "forward") return chain.forward(target());
    if (name == "backward") return chain.backward(target());
    if (name == "with_index") return chain.with_index(index(), target());
    if (name == "fixed") return chain.fixed(target(), {.iterations = op.value("iterations", 1)}).accepted;
    return {ErrorCode::NotFound, "no operation is called " + name};
}

TEST(ChainReference, AgreesWithAnIndependentImplementation) {
    const std::filesystem::path path = reference_path("chain.json");
    std::ifstream file(path);
    if (!file) GTEST_SKIP() << path << " is not there";

    double worst = 0.0;
    const Json cases = Json::parse(file);
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        Chain chain;
        expect_ok(chain.set_default_direction(point(example.at("default_direction"))));
        for (const Json& op : example.at("ops")) {
            expect_ok(apply(chain, op));
            EXPECT_TRUE(Holds(chain));
        }
        const Json& expected = example.at("expect");
        ASSERT_EQ(chain.size(), expected.at("positions").size());
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const double off = distance(chain.position(i), point(expected["positions"][i]));
            EXPECT_LE(off, example.value("tolerance", 1e-4)) << "segment " << i;
            EXPECT_EQ(chain.length(i), expected.at("lengths").at(i).get<float>()) << "segment " << i;
            worst = std::max(worst, off);
        }
    }
    std::printf("%zu cases, worst deviation %.2g m\n", cases.size(), worst);
    EXPECT_FALSE(cases.empty());
}

}  // namespace
}  // namespace tendril::test
