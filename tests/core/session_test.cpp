#include "session.hpp"

#include <gtest/gtest.h>

namespace tendril::test {

TEST(Session, EndsInTheSameBitsInEveryBuild) {
    EXPECT_EQ(session_hash(), golden_session_hash);
}

}  // namespace tendril::test
