// The four modes: what moves, what stays, and degenerate directions.
#include "chain_support.hpp"

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
    expect_ok(chain.backward({3, 4, 0}));  // the tail was at (3,0,0), the middle at (1,0,0)
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

TEST(ChainModes, FixedComesToATargetWithinReach) {
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

TEST(ChainModes, ThePinnedPointIsBitwiseOnTheTarget) {
    for (const glm::vec3 target : targets) {
        Chain chain = straight(7);
        expect_ok(chain.forward(target));
        EXPECT_TRUE(same_bits(chain.position(0), target));
        EXPECT_TRUE(Holds(chain));
        expect_ok(chain.backward(target));
        EXPECT_TRUE(same_bits(chain.position(6), target));
        EXPECT_TRUE(Holds(chain));
        expect_ok(chain.with_index(3, target));
        EXPECT_TRUE(same_bits(chain.position(3), target));
        EXPECT_TRUE(Holds(chain));
        const glm::vec3 tail = chain.position(6);
        expect_ok(chain.fixed(target, {.iterations = 4}).outcome);
        EXPECT_TRUE(same_bits(chain.position(6), tail));
        EXPECT_TRUE(Holds(chain));
    }
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

TEST(ChainModes, AChainOfZeroLengthsGathersOnTheTarget) {
    Chain chain = straight(5, 0.0f);
    for (const glm::vec3 target : targets) {
        expect_ok(chain.forward(target));
        for (const Segment& segment : chain.segments()) EXPECT_EQ(segment.position, target);
        expect_ok(chain.with_index(2, -target));
        for (const Segment& segment : chain.segments()) EXPECT_EQ(segment.position, -target);
    }
}

TEST(ChainModes, ComesBackWholeFromFarAway) {
    Chain chain = straight(32, 0.75f);
    const Chain start = chain;
    for (const float far : {1e4f, 1e6f, 1e9f}) {
        expect_ok(chain.forward({far, -far, far}));
        EXPECT_TRUE(Holds(chain));
        expect_ok(chain.backward({0, 0, 0}));
        EXPECT_TRUE(lies_within(chain, 1e3));
        EXPECT_TRUE(Holds(chain));
    }
}

TEST(ChainModes, HugeLengthsStayFinite) {
    Chain chain;
    for (int i = 0; i < 2000; ++i) expect_ok(chain.add(1e9f));
    EXPECT_TRUE(Holds(chain));
    expect_ok(chain.with_index(1000, {-1e9f, 1e9f, 1e9f}));
    EXPECT_TRUE(Holds(chain));
    expect_ok(chain.fixed({1e9f, 1e9f, 1e9f}, {.iterations = 3}).outcome);
    EXPECT_TRUE(Holds(chain));
    for (std::size_t i = 0; i < chain.size(); ++i) expect_ok(chain.set_length(i, 0.25f));
    expect_ok(chain.forward({0, 0, 0}));
    EXPECT_TRUE(lies_within(chain, 1e3));
    EXPECT_TRUE(Holds(chain));
}

}  // namespace
}  // namespace tendril::test
