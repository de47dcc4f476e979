// Editing: each row of the table on the chain's page, with cases computed by hand.
#include <cstdint>

#include "chain_support.hpp"
#include "random.hpp"

namespace tendril::test {
namespace {

const float root_half = std::sqrt(0.5f);

TEST(ChainEdit, StartsEmpty) {
    const Chain chain;
    EXPECT_TRUE(chain.empty());
    EXPECT_EQ(chain.size(), 0u);
    EXPECT_TRUE(chain.segments().empty());
    EXPECT_EQ(chain.reach(), 0.0f);
    EXPECT_EQ(chain.default_direction(), glm::vec3(1, 0, 0));
}

TEST(ChainEdit, AddLengthStartsAtTheOriginAndGoesAlongTheDefaultDirection) {
    Chain chain = along(glm::vec3(0, 0, -1));
    expect_ok(chain.add(5.0f));
    expect_ok(chain.add(2.0f));
    expect_ok(chain.add(0.5f));
    expect_positions(chain, {{0, 0, 0}, {0, 0, -2}, {0, 0, -2.5f}});
    EXPECT_EQ(chain.length(0), 5.0f);
    EXPECT_EQ(chain.reach(), 2.5f);
}

TEST(ChainEdit, AddLengthGoesOnAlongTheLastSegment) {
    Chain chain;
    expect_ok(chain.add(Segment{{0, 0, 0}, 1}));
    expect_ok(chain.add(Segment{{3, 3, 0}, 1}));
    expect_ok(chain.add(2.0f));
    expect_positions(chain, {{0, 0, 0}, {root_half, root_half, 0}, {3 * root_half, 3 * root_half, 0}});
}

TEST(ChainEdit, AddLengthAfterALinkWithoutDirectionTakesTheDefaultOne) {
    Chain chain;
    expect_ok(chain.add(Segment{{0, 0, 0}, 1}));
    expect_ok(chain.add(Segment{{0, 4, 0}, 2}));
    expect_ok(chain.add(0.0f));
    expect_ok(chain.add(1.0f));
    expect_positions(chain, {{0, 0, 0}, {0, 2, 0}, {0, 2, 0}, {1, 2, 0}});
}

TEST(ChainEdit, AddSegmentLiesTowardsItsPosition) {
    Chain chain;
    expect_ok(chain.add(Segment{{1, 1, 1}, 9}));
    expect_ok(chain.add(Segment{{1, 1, 8}, 2}));
    expect_ok(chain.add(Segment{{1, 9, 3}, 1}));
    expect_positions(chain, {{1, 1, 1}, {1, 1, 3}, {1, 2, 3}});
}

TEST(ChainEdit, SegmentsAtOnePointMakeAStraightChain) {
    Chain chain = along(glm::vec3(0, 1, 0));
    for (int i = 0; i < 6; ++i) expect_ok(chain.add(Segment{{2, 2, 2}, 1}));
    expect_positions(chain, {{2, 2, 2}, {2, 3, 2}, {2, 4, 2}, {2, 5, 2}, {2, 6, 2}, {2, 7, 2}});
}

TEST(ChainEdit, ASegmentGivenAtAnyPointOfTheChainCarriesNoDirection) {
    Chain chain = straight(4);
    expect_ok(chain.add(Segment{{1, 0, 0}, 2}));  // where segment 1 is: continues straight, no fold
    expect_positions(chain, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {5, 0, 0}});
    expect_ok(chain.add(Segment{{1, 0.001f, 0}, 1}));  // a millimetre off is another position
    EXPECT_LT(chain.position(5).x, chain.position(4).x);
}

TEST(ChainEdit, InsertSegmentAtATakenPointIsInsertLength) {
    for (const std::size_t index : {0u, 1u, 3u}) {
        Chain given = straight(4), by_length = straight(4);
        expect_ok(given.insert(index, Segment{{2, 0, 0}, 0.5f}));
        expect_ok(by_length.insert(index, 0.5f));
        EXPECT_TRUE(same_bits(given, by_length)) << index;
    }
}

TEST(ChainEdit, InsertSegmentIsReLaid) {
    Chain chain = straight(3);
    expect_ok(chain.insert(1, Segment{{0, 7, 0}, 1}));
    // From (0,1,0) towards (1,0,0) by 1, then from there towards (2,0,0) by 1.
    const glm::vec3 second(root_half, 1 - root_half, 0);
    const glm::vec3 step = glm::vec3(2, 0, 0) - second;
    const float scale = 1.0f / std::sqrt(step.x * step.x + step.y * step.y);
    expect_positions(chain, {{0, 0, 0}, {0, 1, 0}, second, second + step * scale});
}

TEST(ChainEdit, InsertSegmentAsHeadTiesTheOldHeadByItsOwnLength) {
    Chain chain;
    expect_ok(chain.add(Segment{{0, 0, 0}, 3}));
    expect_ok(chain.add(Segment{{1, 0, 0}, 1}));
    expect_ok(chain.insert(0, Segment{{-9, 0, 0}, 5}));
    expect_positions(chain, {{-9, 0, 0}, {-6, 0, 0}, {-5, 0, 0}});
    EXPECT_EQ(chain.length(0), 5.0f);
    EXPECT_EQ(chain.length(1), 3.0f);
}

TEST(ChainEdit, InsertLengthCarriesTheRestAlongAndKeepsTheShape) {
    Chain chain;
    expect_ok(chain.add(Segment{{0, 0, 0}, 1}));
    expect_ok(chain.add(Segment{{1, 0, 0}, 1}));
    expect_ok(chain.add(Segment{{1, 5, 0}, 2}));
    expect_ok(chain.insert(1, 0.5f));
    expect_positions(chain, {{0, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}, {1.5f, 2, 0}});
    expect_ok(chain.insert(3, 1.0f));
    expect_positions(chain, {{0, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}, {1.5f, 1, 0}, {1.5f, 3, 0}});
}

TEST(ChainEdit, InsertLengthAsHeadMovesNothingElse) {
    Chain chain;
    expect_ok(chain.add(Segment{{4, 4, 4}, 2}));
    expect_ok(chain.add(Segment{{4, 9, 4}, 1}));
    Random random(3);
    for (int i = 0; i < 40; ++i) expect_ok(chain.add(Segment{random.point(50.0f), 1.3f}));
    const Chain before = chain;
    expect_ok(chain.insert(0, 7.0f));
    ASSERT_EQ(chain.size(), 43u);
    EXPECT_LE(distance(chain.position(0), {4, 2, 4}), 1e-6);
    EXPECT_EQ(chain.length(0), 7.0f);
    for (std::size_t i = 0; i < 42; ++i)
        EXPECT_TRUE(same_bits(chain.segments()[i + 1], before.segments()[i])) << i;
    EXPECT_TRUE(Holds(chain));
}

TEST(ChainEdit, InsertLengthDoesNotPileUpRounding) {
    Chain chain;  // spans 512 m, where the spacing of floats doubles
    for (int i = 0; i < 8; ++i) expect_ok(chain.add(Segment{{505 + 2 * i, 3 * (i % 2), 126 + i}, 2.0f}));
    for (int i = 0; i < 2000; ++i) expect_ok(chain.insert(1, 0.0005f * static_cast<float>(1 + i % 7)));
    EXPECT_TRUE(lies_within(chain, 1e3));
    EXPECT_TRUE(Holds(chain));
}

TEST(ChainEdit, InsertLengthBeforeASingleSegmentUsesTheDefaultDirection) {
    Chain chain = along(glm::vec3(0, 1, 0));
    expect_ok(chain.add(2.0f));
    expect_ok(chain.insert(0, 1.0f));
    expect_positions(chain, {{0, -2, 0}, {0, 0, 0}});
}

TEST(ChainEdit, RemoveReLaysFromTheHead) {
    Chain chain = straight(4);
    expect_ok(chain.remove(1));
    expect_positions(chain, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    expect_ok(chain.remove(0));
    expect_positions(chain, {{1, 0, 0}, {2, 0, 0}});
    expect_ok(chain.remove(1));
    expect_ok(chain.remove(0));
    EXPECT_TRUE(chain.empty());
}

TEST(ChainEdit, SetLengthReLays) {
    Chain chain = straight(4);
    expect_ok(chain.set_length(2, 3.0f));
    expect_positions(chain, {{0, 0, 0}, {1, 0, 0}, {4, 0, 0}, {3, 0, 0}});  // towards its old point, so back
    expect_ok(chain.set_length(0, 8.0f));
    expect_positions(chain, {{0, 0, 0}, {1, 0, 0}, {4, 0, 0}, {3, 0, 0}});
    EXPECT_EQ(chain.length(0), 8.0f);
    EXPECT_EQ(chain.reach(), 5.0f);
}

TEST(ChainEdit, LengthZeroIsLegal) {
    Chain chain = straight(3);
    expect_ok(chain.set_length(1, 0.0f));
    expect_positions(chain, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}});
    expect_ok(chain.set_length(1, 2.0f));  // the two coincide: use the default direction
    expect_positions(chain, {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}});
}

TEST(ChainEdit, RecalculateLeavesAChainThatHolds) {
    Chain chain;
    chain.recalculate();
    for (int i = 0; i < 5; ++i) expect_ok(chain.add(Segment{glm::vec3(i * i, 3 - i, i), 1.0f}));
    const Chain before = chain;
    chain.recalculate();
    for (std::size_t i = 0; i < chain.size(); ++i)
        EXPECT_LE(distance(chain.position(i), before.position(i)), 1e-5);
    EXPECT_TRUE(same_bits(chain.position(0), before.position(0)));
}

TEST(ChainEdit, AcceptsItsOwnSegments) {
    Chain chain = straight(4);
    for (int i = 0; i < 20; ++i) expect_ok(chain.add(chain.segments()[2]));
    for (int i = 0; i < 20; ++i) expect_ok(chain.insert(1, chain.segments()[3]));
    EXPECT_EQ(chain.size(), 44u);
    EXPECT_TRUE(Holds(chain));
}

TEST(ChainEdit, AHundredThousandAddsAreQuick) {
    const Chain chain = straight(100'000, 0.01f);  // quadratic work would take minutes
    EXPECT_EQ(chain.size(), 100'000u);
    EXPECT_NEAR(chain.reach(), 999.99f, 1e-3f);
    EXPECT_TRUE(Holds(chain));
}

TEST(ChainEdit, DefaultDirectionMayBeAlmostAUnitVector) {
    const Chain chain = along(glm::vec3(0.577f, 0.577f, 0.577f));
    EXPECT_NEAR(distance(chain.default_direction(), glm::vec3(0)), 1.0, 1e-7);
}

TEST(ChainEdit, ADefaultDirectionThatIsAUnitVectorStaysBitForBit) {
    Random random(5);  // so that a saved direction loads unchanged
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 any = random.point(1.0f);
        const Chain chain = along(any / static_cast<float>(distance(any, glm::vec3(0))));
        EXPECT_TRUE(
            same_bits(along(chain.default_direction()).default_direction(), chain.default_direction()));
    }
}

TEST(ChainEdit, DefaultDirectionMovesNothing) {
    Chain chain = straight(3);
    expect_ok(chain.set_default_direction({0, 1, 0}));
    expect_positions(chain, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    EXPECT_NE(chain, straight(3));
}

TEST(ChainEdit, SetPositionsKeepsAPoseBitForBit) {
    Chain chain = straight(4);
    const std::vector<glm::vec3> pose{{1, 1, 1}, {1, 2, 1}, {1, 2.00005f, 2}, {0, 2.00005f, 2}};
    expect_ok(chain.set_positions(pose));
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(same_bits(chain.position(i), pose[i])) << i;
        EXPECT_EQ(chain.length(i), 1.0f);
    }
}

TEST(ChainEdit, SetPositionsLaysFromTheFirstThatIsNotAtItsLength) {
    Chain chain = straight(4);
    expect_ok(chain.set_positions(std::vector<glm::vec3>{{0, 0, 0}, {0, 1, 0}, {0, 1, 3}, {0, 1, 3}}));
    expect_positions(chain, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 1, 2}});
}

TEST(ChainEdit, SetPositionsRefusesAndChangesNothing) {
    Chain chain = straight(2);
    const Chain before = chain;
    for (const std::size_t count : {3u, 1u, 0u}) {
        EXPECT_EQ(chain.set_positions(std::vector<glm::vec3>(count)).code(), ErrorCode::InvalidArgument);
    }
    for (const float bad : {nan, infinity, 1.1e9f}) {
        const std::vector<glm::vec3> pose{{0, 0, 0}, {0, bad, 0}};
        const std::string message = chain.set_positions(pose).message();
        EXPECT_NE(message.find("positions[1]"), std::string::npos) << message;
    }
    EXPECT_TRUE(same_bits(chain, before));
    Chain empty;
    expect_ok(empty.set_positions({}));
}

}  // namespace
}  // namespace tendril::test
