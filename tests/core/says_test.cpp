#include "tests/says.hpp"

namespace tendril::test {
namespace {

TEST(Says, NamesAndValuesInTheirOrderWhateverIsBetween) {
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

}  // namespace
}  // namespace tendril::test
