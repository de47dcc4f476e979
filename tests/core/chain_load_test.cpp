// Chain::from_segments: loads a saved chain unchanged, and repairs any other.
#include "chain_support.hpp"
#include "random.hpp"

namespace tendril::test {
namespace {

std::vector<Segment> copy_of(const Chain& chain) {
    return {chain.segments().begin(), chain.segments().end()};
}

Chain reloaded(const Chain& chain) {
    return *Chain::from_segments(copy_of(chain), chain.default_direction());
}

TEST(ChainLoad, SavedChainsComeBackBitForBit) {
    Random random(7);
    for (const float range : {1.0f, 900.0f, 5e3f, 1e6f, 5e8f}) {
        for (int round = 0; round < 200; ++round) {
            Chain chain = along(glm::vec3(0.577f, 0.577f, -0.577f));
            const std::size_t count = 1 + random.below(64);
            for (std::size_t i = 0; i < count; ++i)
                expect_ok(chain.add(Segment{random.point(range), std::abs(random.around(3))}));
            const std::size_t index = random.below(count);
            expect_ok(chain.with_index(index, random.point(range)));
            expect_ok(chain.fixed(random.point(range), {.iterations = 3}).outcome);
            EXPECT_TRUE(same_bits(reloaded(chain), chain)) << "range " << range << ", round " << round;
        }
    }
}

TEST(ChainLoad, FoldedAndCoincidingLinksThatHoldAreKept) {
    const std::vector<Segment> given{
        {{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0, 0, 0}, 0}, {{0, 0, 2}, 2}};
    EXPECT_EQ(copy_of(*Chain::from_segments(given)), given);
}

TEST(ChainLoad, ALooseLinkIsReLaidFromThereOn) {
    const Chain chain =
        *Chain::from_segments({{{0, 0, 0}, 1}, {{0, 1, 0}, 1}, {{0, 9, 0}, 1}, {{5, 2, 0}, 2}});
    EXPECT_TRUE(same_bits(chain.position(1), {0, 1, 0}));
    expect_positions(chain, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {2, 2, 0}});
}

TEST(ChainLoad, LinksAreLooseBeyondTheInvariantOnly) {
    EXPECT_EQ(Chain::from_segments({{{0, 0, 0}, 0}, {{1.00009f, 0, 0}, 1}})->position(1).x, 1.00009f);
    EXPECT_EQ(Chain::from_segments({{{0, 0, 0}, 0}, {{1.00011f, 0, 0}, 1}})->position(1).x, 1.0f);
    EXPECT_EQ(Chain::from_segments({{{0, 0, 0}, 0}, {{500.04f, 0, 0}, 500}})->position(1).x, 500.04f);
    EXPECT_EQ(Chain::from_segments({{{900, 0, 0}, 0}, {{901.0002f, 0, 0}, 1}})->position(1).x, 901.0f);
}

TEST(ChainLoad, SegmentsAtOnePointMakeAStraightChain) {
    const std::vector<Segment> heap(100'000, Segment{{3, 3, 3}, 0.125f});
    const Chain chain = *Chain::from_segments(heap, {0, 0, 1});
    EXPECT_TRUE(same_bits(chain.position(0), {3, 3, 3}));
    for (std::size_t i = 0; i < chain.size(); i += 999) {
        EXPECT_EQ(chain.position(i), glm::vec3(3, 3, 3.0f + 0.125f * static_cast<float>(i)));
    }
}

TEST(ChainLoad, AHeapAtTheEndGoesStraightOn) {
    std::vector<Segment> given{{{0, 0, 0}, 1}, {{0, 1, 0}, 1}};
    given.insert(given.end(), 3, Segment{{0, 1, 0}, 2});
    expect_positions(*Chain::from_segments(given), {{0, 0, 0}, {0, 1, 0}, {0, 3, 0}, {0, 5, 0}, {0, 7, 0}});
}

TEST(ChainLoad, NothingIsAChainToo) {
    EXPECT_TRUE(Chain::from_segments({})->empty());
    EXPECT_EQ(Chain::from_segments({}, {0, 0, 0}).code(), ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace tendril::test
