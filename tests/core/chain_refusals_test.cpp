// What is refused, with which message, and that a refusal changes nothing.
#include <cstdint>
#include <stdexcept>

#include "chain_support.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

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
    return result.outcome.message();
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
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.insert(0, length); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.insert(2, length); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.insert(2, segment); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.set_length(0, length); });
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.set_length(3, length); });
        EXPECT_EQ(Chain::from_segments({segment}).code(), ErrorCode::InvalidArgument);
    }
}

TEST(ChainRefusals, BadCoordinates) {
    Chain chain = straight(4);
    for (const float bad : bad_coordinates) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 point(0.5f);
            point[axis] = bad;
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.add(Segment{point, 1}); });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] {
                return chain.insert(1, Segment{point, 1});
            });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.forward(point); });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.backward(point); });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.fixed(point).outcome; });
            expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.with_index(1, point); });
            expect_refused(ErrorCode::InvalidArgument, chain,
                           [&] { return chain.set_default_direction(point); });
            EXPECT_EQ(Chain::from_segments({{}, {point, 1}}).code(), ErrorCode::InvalidArgument);
        }
    }
    Chain empty;  // an empty chain does nothing, but still refuses invalid input
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

TEST(ChainRefusals, AnEmptyChainTakesAddOnly) {
    Chain chain;
    expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.insert(0, 1.0f); });
    expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.insert(0, Segment{}); });
    expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.remove(0); });
    expect_refused(ErrorCode::OutOfRange, chain, [&] { return chain.set_length(0, 1.0f); });
    EXPECT_THROW(static_cast<void>(chain.position(0)), std::out_of_range);
}

TEST(ChainRefusals, BadOptions) {
    Chain chain = straight(4);
    for (const int iterations : {0, -1, INT32_MIN, 100'001, INT32_MAX}) {
        expect_refused(ErrorCode::InvalidArgument, chain, [&] {
            return chain.fixed({1, 1, 1}, {.iterations = iterations}).outcome;
        });
    }
    for (const float tolerance : bad_lengths) {
        expect_refused(ErrorCode::InvalidArgument, chain, [&] {
            return chain.fixed({1, 1, 1}, {.tolerance = tolerance}).outcome;
        });
    }
}

TEST(ChainRefusals, BadDirections) {
    Chain chain = straight(2);
    for (const glm::vec3 bad : {glm::vec3(0), glm::vec3(1), glm::vec3(2, 0, 0), glm::vec3(0.99f, 0, 0),
                                glm::vec3(1e9f, 0, 0), glm::vec3(1e-20f)}) {
        expect_refused(ErrorCode::InvalidArgument, chain, [&] { return chain.set_default_direction(bad); });
    }
}

TEST(ChainRefusals, TheLimitsThemselvesAreAccepted) {
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
    EXPECT_TRUE(test::says(message_of(chain.set_length(2, -1.0f)), "set_length length finite 0 1e9 -1"));
    EXPECT_TRUE(test::says(message_of(chain.add(-0.25f)), "add length finite 0 1e9 -0.25"));
    EXPECT_TRUE(test::says(message_of(chain.add(Segment{{0, 0, -infinity}, 1})),
                           "add segment.position.z finite 1e9 -inf"));
    EXPECT_TRUE(test::says(message_of(chain.insert(0, Segment{{9, 9, 9}, 1e10f})),
                           "insert segment.length finite 0 1e9 1e+10"));
    EXPECT_TRUE(test::says(message_of(chain.forward({0, -nan, 0})), "forward target.y finite 1e9 nan"));
    EXPECT_TRUE(
        test::says(message_of(chain.fixed({}, {.iterations = 0})), "fixed options.iterations 1 100000 0"));
    EXPECT_TRUE(test::says(message_of(chain.fixed({}, {.tolerance = infinity})),
                           "fixed options.tolerance finite 0 1e9 inf"));
    EXPECT_TRUE(test::says(message_of(chain.set_default_direction({0, 3, 0})),
                           "set_default_direction direction unit vector length 3"));
    EXPECT_TRUE(test::says(message_of(Chain::from_segments({{}, {{0, 0, 0}, nan}})),
                           "from_segments segments[1].length finite 0 1e9 nan"));
    EXPECT_TRUE(test::says(message_of(chain.insert(9, 1.0f)), "insert index 9 8"));
    EXPECT_TRUE(test::says(message_of(straight(1).remove(1)), "remove index 1 1"));
}

}  // namespace
}  // namespace tendril::test
