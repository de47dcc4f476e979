// Result and Expected: refusals and their messages.
#include "ik_many_support.hpp"
#include "jobs.hpp"

namespace tendril::test {
namespace {

TEST(Result, IsOkUnlessAnErrorIsSet) {
    const Result fine;
    EXPECT_TRUE(fine);
    EXPECT_EQ(fine.code(), ErrorCode::None);
    EXPECT_STREQ(fine.message(), "");
    const Result bad(ErrorCode::OutOfRange, "index 9");
    EXPECT_FALSE(bad);
    EXPECT_EQ(bad.code(), ErrorCode::OutOfRange);
    EXPECT_STREQ(bad.message(), "index 9");
    EXPECT_STREQ(name(bad.code()), "OutOfRange");
}

TEST(Result, ReasonIsTheMessageWithoutTheOperation) {
    for (const auto& [message, reason] : {std::pair{"linkage_from: bar \"bc\": no", "bar \"bc\": no"},
                                          {"index 9", "index 9"},
                                          {"", ""},
                                          {"set:x", "set:x"},
                                          {"LeftLowerArm: the hinge's min", "LeftLowerArm: the hinge's min"},
                                          {"a b: c", "a b: c"}}) {
        EXPECT_STREQ(Result(ErrorCode::NotFound, message).reason(), reason);
        EXPECT_STREQ(Expected<int>(Result(ErrorCode::NotFound, message)).reason(), reason);
    }
}

TEST(Result, CopiesItsMessage) {
    const Result bad(ErrorCode::NotFound, "no such body");
    Result copy;
    copy = bad;
    EXPECT_EQ(copy.code(), bad.code());
    EXPECT_STREQ(copy.message(), "no such body");
    const Result& itself = copy;
    copy = itself;
    EXPECT_STREQ(copy.message(), "no such body");
    copy = Result();
    EXPECT_TRUE(copy);
    EXPECT_STREQ(copy.message(), "");
}

TEST(Result, CutsALongMessageBetweenCharacters) {
    std::string text(Result::max_message - 1, 'a');
    text += "\xc3\xa9 and more";  // a two-byte character across the limit
    const Result bad(ErrorCode::InvalidArgument, text);
    EXPECT_EQ(std::string(bad.message()), std::string(Result::max_message - 1, 'a'));
    const std::string whole(Result::max_message, 'b');
    EXPECT_EQ(Result(ErrorCode::InvalidArgument, whole).message(), whole);
}

TEST(Expected, HoldsAValueOrAnError) {
    Expected<std::unique_ptr<int>> value(std::make_unique<int>(7));
    ASSERT_TRUE(value);
    EXPECT_TRUE(value.error().ok());
    EXPECT_STREQ(value.message(), "");
    EXPECT_EQ(**value, 7);
    const std::unique_ptr<int> taken = std::move(value).value();
    EXPECT_EQ(*taken, 7);

    const Expected<int> none(Result(ErrorCode::AlreadyExists, "twice"));
    EXPECT_FALSE(none);
    EXPECT_EQ(none.code(), ErrorCode::AlreadyExists);
    EXPECT_STREQ(none.message(), "twice");
    EXPECT_STREQ(none.error().message(), "twice");
}

TEST(ExpectedDeathTest, ReadingAMissingValueEndsTheProgram) {
    const Expected<int> none(Result(ErrorCode::AlreadyExists, "twice"));
    EXPECT_DEATH(static_cast<void>(*none), "a value was read from an error: twice");
}

TEST(Says, FindsNamesAndValuesInOrder) {
    const std::string message = "rope.pin: particle must be 0 to 99999, got -1";
    EXPECT_TRUE(says(message, "rope.pin particle 0 99999 -1"));
    EXPECT_TRUE(says(message, "-1"));
    EXPECT_FALSE(says(message, "particle rope.pin"));
    EXPECT_FALSE(says(message, "rope.pin particle 0 99999 2"));
    EXPECT_FALSE(says(message, "1")) << "it is -1";
    EXPECT_FALSE(says(message, "9999"));
    EXPECT_FALSE(says(message, "part"));
    EXPECT_FALSE(says("1.5", "1"));
    EXPECT_FALSE(says("-1.5", "-1"));
    EXPECT_FALSE(says("1.5", "5"));
    EXPECT_TRUE(says("from 1 to 5.", "1 5")) << "a full stop is no decimal point";
    EXPECT_TRUE(says("joints[3].length", "joints[3].length"));
    EXPECT_FALSE(says(message, "")) << "names nothing";
}

// The task callback: every piece runs once, on the program's workers if any, with the same bits in any order.

TEST(Tasks, SolveManyUsesTheProgramsWorkersAndGivesTheSameBits) {
    Random random(41);
    const Crowd crowd = some_crowd(5000, 10, random, 0.05f, 1.1f);
    const Answer expected = solve_many(crowd, {});
    for (const bool backwards : {false, true})
        for (const bool threaded : {false, true}) {
            Jobs jobs{.backwards = backwards, .threaded = threaded};
            const Answer answer = solve_many(crowd, {.tasks = {run_on_jobs, &jobs}}, 4);
            EXPECT_EQ(jobs.calls, 1u);
            EXPECT_EQ(jobs.pieces, 4u);
            EXPECT_EQ(difference(answer, expected), "");
        }
}

TEST(Tasks, ASingleThreadNeedsNoCallback) {
    Random random(42);
    const Crowd crowd = some_crowd(500, 10, random);
    Jobs jobs;
    solve_many(crowd, {.tasks = {run_on_jobs, &jobs}});
    EXPECT_EQ(jobs.calls, 0u);
}

}  // namespace
}  // namespace tendril::test
