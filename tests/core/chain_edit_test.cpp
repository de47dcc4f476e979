// Editing: each row of the table on the chain's page, with cases computed by hand.
#include <stdexcept>

#include "chain_support.hpp"
#include "random.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

const float root_half = std::sqrt(0.5f);

LABEL(slow, "ChainEdit.AHundredThousandAddsAreQuick");

TEST(ChainEdit, AddLengthStartsAtTheOriginAndGoesAlongTheDefaultDirection) {
    Chain chain = along(glm::vec3(0, 0, -1));
    expect_ok(chain.add(5.0f));
    expect_ok(chain.add(2.0f));
    expect_ok(chain.add(0.5f));
    expect_positions(chain, {{0, 0, 0}, {0, 0, -2}, {0, 0, -2.5f}});
    EXPECT_EQ(chain.length(0), 5.0f);
    EXPECT_EQ(chain.reach(), 2.5f);
}

TEST(ChainEdit, AddLengthContinuesTheLastSegment) {
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

TEST(ChainEdit, AddSegmentPointsAtItsPosition) {
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

TEST(ChainEdit, ASegmentPlacedOnAPointOfTheChainHasNoDirection) {
    Chain chain = straight(4);
    expect_ok(chain.add(Segment{{1, 0, 0}, 2}));  // on segment 1: continues straight, no fold
    expect_positions(chain, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {5, 0, 0}});
    expect_ok(chain.add(Segment{{1, 0.001f, 0}, 1}));  // a millimetre off is another position
    EXPECT_LT(chain.position(5).x, chain.position(4).x);
}

TEST(ChainEdit, InsertSegmentOnAnExistingPointIsInsertLength) {
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

TEST(ChainEdit, InsertSegmentAtTheHeadKeepsTheOldHeadsLength) {
    Chain chain;
    expect_ok(chain.add(Segment{{0, 0, 0}, 3}));
    expect_ok(chain.add(Segment{{1, 0, 0}, 1}));
    expect_ok(chain.insert(0, Segment{{-9, 0, 0}, 5}));
    expect_positions(chain, {{-9, 0, 0}, {-6, 0, 0}, {-5, 0, 0}});
    EXPECT_EQ(chain.length(0), 5.0f);
    EXPECT_EQ(chain.length(1), 3.0f);
}

TEST(ChainEdit, InsertLengthShiftsTheRestAndKeepsTheShape) {
    Chain chain;
    expect_ok(chain.add(Segment{{0, 0, 0}, 1}));
    expect_ok(chain.add(Segment{{1, 0, 0}, 1}));
    expect_ok(chain.add(Segment{{1, 5, 0}, 2}));
    expect_ok(chain.insert(1, 0.5f));
    expect_positions(chain, {{0, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}, {1.5f, 2, 0}});
    expect_ok(chain.insert(3, 1.0f));
    expect_positions(chain, {{0, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}, {1.5f, 1, 0}, {1.5f, 3, 0}});
}

TEST(ChainEdit, InsertLengthAtTheHeadMovesNothingElse) {
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

TEST(ChainEdit, RecalculateLeavesAValidChainUnchanged) {
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

TEST(ChainEdit, DefaultDirectionMayBeSlightlyOffUnitLength) {
    const Chain chain = along(glm::vec3(0.577f, 0.577f, 0.577f));
    EXPECT_NEAR(distance(chain.default_direction(), glm::vec3(0)), 1.0, 1e-7);
}

TEST(ChainEdit, AUnitDefaultDirectionStaysBitForBit) {
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

TEST(ChainEdit, SetPositionsReLaysFromTheFirstWrongLength) {
    Chain chain = straight(4);
    expect_ok(chain.set_positions(std::vector<glm::vec3>{{0, 0, 0}, {0, 1, 0}, {0, 1, 3}, {0, 1, 3}}));
    expect_positions(chain, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 1, 2}});
}

TEST(ChainEdit, ARefusedSetPositionsChangesNothing) {
    Chain chain = straight(2);
    const Chain before = chain;
    for (const std::size_t count : {3u, 1u, 0u})
        EXPECT_EQ(chain.set_positions(std::vector<glm::vec3>(count)).code(), ErrorCode::InvalidArgument);
    for (const float bad : {nan, infinity, 1.1e9f}) {
        const std::vector<glm::vec3> pose{{0, 0, 0}, {0, bad, 0}};
        const std::string message = chain.set_positions(pose).message();
        EXPECT_NE(message.find("positions[1]"), std::string::npos) << message;
    }
    EXPECT_TRUE(same_bits(chain, before));
    Chain empty;
    expect_ok(empty.set_positions({}));
}

// Chain::from_segments: loads a saved chain unchanged, and repairs any other.

std::vector<Segment> copy_of(const Chain& chain) {
    return {chain.segments().begin(), chain.segments().end()};
}

TEST(ChainLoad, ValidFoldedAndCoincidingLinksAreKept) {
    const std::vector<Segment> given{
        {{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{0, 0, 0}, 1}, {{0, 0, 0}, 0}, {{0, 0, 2}, 2}};
    EXPECT_EQ(copy_of(*Chain::from_segments(given)), given);
}

TEST(ChainLoad, ABrokenLinkIsReLaidFromThereOn) {
    const Chain chain =
        *Chain::from_segments({{{0, 0, 0}, 1}, {{0, 1, 0}, 1}, {{0, 9, 0}, 1}, {{5, 2, 0}, 2}});
    EXPECT_TRUE(same_bits(chain.position(1), {0, 1, 0}));
    expect_positions(chain, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {2, 2, 0}});
}

TEST(ChainLoad, LinksAreBrokenOnlyBeyondTheInvariant) {
    EXPECT_EQ(Chain::from_segments({{{0, 0, 0}, 0}, {{1.00009f, 0, 0}, 1}})->position(1).x, 1.00009f);
    EXPECT_EQ(Chain::from_segments({{{0, 0, 0}, 0}, {{1.00011f, 0, 0}, 1}})->position(1).x, 1.0f);
    EXPECT_EQ(Chain::from_segments({{{0, 0, 0}, 0}, {{0.01009f, 0, 0}, 0.01f}})->position(1).x, 0.01009f);
    EXPECT_EQ(Chain::from_segments({{{0, 0, 0}, 0}, {{500.04f, 0, 0}, 500}})->position(1).x, 500.04f);
    EXPECT_EQ(Chain::from_segments({{{900, 0, 0}, 0}, {{901.0002f, 0, 0}, 1}})->position(1).x, 901.0f);
}

TEST(ChainLoad, SegmentsAtOnePointMakeAStraightChain) {
    const std::vector<Segment> heap(100'000, Segment{{3, 3, 3}, 0.125f});
    const Chain chain = *Chain::from_segments(heap, {0, 0, 1});
    EXPECT_TRUE(same_bits(chain.position(0), {3, 3, 3}));
    for (std::size_t i = 0; i < chain.size(); i += 999)
        EXPECT_EQ(chain.position(i), glm::vec3(3, 3, 3.0f + 0.125f * static_cast<float>(i)));
}

TEST(ChainLoad, CoincidingPointsAtTheEndGoStraightOn) {
    std::vector<Segment> given{{{0, 0, 0}, 1}, {{0, 1, 0}, 1}};
    given.insert(given.end(), 3, Segment{{0, 1, 0}, 2});
    expect_positions(*Chain::from_segments(given), {{0, 0, 0}, {0, 1, 0}, {0, 3, 0}, {0, 5, 0}, {0, 7, 0}});
}

TEST(ChainLoad, NoSegmentsAreAValidChain) {
    EXPECT_TRUE(Chain::from_segments({})->empty());
    EXPECT_EQ(Chain::from_segments({}, {0, 0, 0}).code(), ErrorCode::InvalidArgument);
}

// Refused calls: each gives its message and changes nothing.

const float bad_lengths[] = {-1.0f, -1e-30f, nan, infinity, -infinity, 1e10f, 1000000064.0f};
const float bad_coordinates[] = {nan, infinity, -infinity, 1e10f, -1e10f, 1000000064.0f};

/// Expects `call` to fail with `code` and to leave the chain bitwise unchanged.
template <class Call>
void expect_refused(ErrorCode code, Chain& chain, Call call) {
    const Chain before = chain;
    EXPECT_EQ(call().code(), code);
    EXPECT_TRUE(same_bits(chain, before));
}

std::string message_of(const Result& result) {
    return result.message();
}
std::string message_of(const FixedResult& result) {
    return result.accepted.message();
}
std::string message_of(const Expected<Chain>& chain) {
    return chain.message();
}

TEST(ChainRefusals, BadLengths) {
    Chain chain = straight(4);
    for (const float length : bad_lengths) {
        const Segment segment{{5, 5, 5}, length}, taken{{1, 0, 0}, length};
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.add(length); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.add(segment); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.add(taken); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.insert(2, length); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.insert(2, segment); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.set_length(3, length); });
        EXPECT_EQ(Chain::from_segments({segment}).code(), ErrorCode::InvalidArgument);
    }
}

TEST(ChainRefusals, BadCoordinates) {
    Chain chain = straight(4);
    for (const float bad : bad_coordinates)
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 point(0.5f);
            point[axis] = bad;
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.add(Segment{point, 1}); });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] {
                return chain.insert(1, Segment{point, 1});
            });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.forward(point); });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.backward(point); });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.fixed(point).accepted; });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.with_index(1, point); });
            expect_refused(ErrorCode::InvalidArgument, chain,
                           [&] { return chain.set_default_direction(point); });
            EXPECT_EQ(Chain::from_segments({{}, {point, 1}}).code(), ErrorCode::InvalidArgument);
        }
    Chain empty;  // a call on an empty chain does nothing, but still refuses invalid input
    EXPECT_EQ(empty.forward(glm::vec3(nan)).code(), ErrorCode::InvalidArgument);
    EXPECT_EQ(empty.with_index(0, glm::vec3(nan)).code(), ErrorCode::InvalidArgument);
}

TEST(ChainRefusals, BadIndices) {
    Chain chain = straight(4);
    for (const std::size_t index : {std::size_t{4}, std::size_t{5}, SIZE_MAX, SIZE_MAX / 2}) {
        expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.insert(index, 1.0f); });
        expect_refused(ErrorCode::OutOfRange, chain, [&] {
            return chain.insert(index, Segment{{9, 9, 9}, 1});
        });
        expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.remove(index); });
        expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.set_length(index, 1.0f); });
        expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.with_index(index, {1, 2, 3}); });
        EXPECT_THROW(static_cast<void>(chain.length(index)), std::out_of_range);
        EXPECT_THROW(static_cast<void>(chain.position(index)), std::out_of_range);
    }
}

TEST(ChainRefusals, AnEmptyChainAcceptsAddOnly) {
    Chain chain;
    expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.insert(0, 1.0f); });
    expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.insert(0, Segment{}); });
    expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.remove(0); });
    expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.set_length(0, 1.0f); });
    EXPECT_THROW(static_cast<void>(chain.position(0)), std::out_of_range);
}

TEST(ChainRefusals, BadDirections) {
    Chain chain = straight(2);
    for (const glm::vec3 bad : {glm::vec3(0), glm::vec3(1), glm::vec3(2, 0, 0), glm::vec3(0.99f, 0, 0),
                                glm::vec3(1.0012f, 0, 0), glm::vec3(1e9f, 0, 0), glm::vec3(1e-20f)})
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.set_default_direction(bad); });
}

TEST(ChainRefusals, LimitValuesAreAccepted) {
    Chain chain;
    expect_ok(chain.add(Segment{glm::vec3(1e9f, -1e9f, 1e9f), 1e9f}));
    expect_ok(chain.add(1e9f));
    expect_ok(chain.add(0.0f));
    expect_ok(chain.insert(1, 1e9f));
    expect_ok(chain.set_length(2, 1e9f));
    expect_ok(chain.forward(glm::vec3(-1e9f)));
    EXPECT_TRUE(Holds(chain));
}

TEST(ChainRefusals, MessagesNameTheOperationTheArgumentAndTheValue) {
    Chain chain = straight(8);
    EXPECT_TRUE(says(message_of(chain.set_length(2, -1.0f)), "set_length length finite 0 1e9 -1"));
    EXPECT_TRUE(says(message_of(chain.add(-0.25f)), "add length finite 0 1e9 -0.25"));
    EXPECT_TRUE(
        says(message_of(chain.add(Segment{{0, 0, -infinity}, 1})), "add segment.position.z finite 1e9 -inf"));
    EXPECT_TRUE(says(message_of(chain.insert(0, Segment{{9, 9, 9}, 1e10f})),
                     "insert segment.length finite 0 1e9 1e+10"));
    EXPECT_TRUE(says(message_of(chain.forward({0, -nan, 0})), "forward target.y finite 1e9 nan"));
    EXPECT_TRUE(says(message_of(chain.fixed({}, {.iterations = 0})), "fixed options.iterations 1 1e5 0"));
    EXPECT_TRUE(
        says(message_of(chain.fixed({}, {.tolerance = infinity})), "fixed options.tolerance 0 1e9 inf"));
    EXPECT_TRUE(says(message_of(chain.set_default_direction({0, 3, 0})),
                     "set_default_direction direction unit vector length 3"));
    EXPECT_TRUE(says(message_of(Chain::from_segments({{}, {{0, 0, 0}, nan}})),
                     "from_segments segments[1].length finite 0 1e9 nan"));
    EXPECT_TRUE(says(message_of(chain.insert(9, 1.0f)), "insert index 9 8"));
    EXPECT_TRUE(says(message_of(straight(1).remove(1)), "remove index 1 1"));
}

}  // namespace
}  // namespace tendril::test
