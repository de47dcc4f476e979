#include "session.hpp"

#include <gtest/gtest.h>

namespace tendril::test {

TEST(Session, EndsInTheSameBitsInEveryBuild) {
    EXPECT_EQ(session_hash(), golden_session_hash);
}

TEST(Session, SolvesEndInTheSameBitsInEveryBuild) {
    EXPECT_EQ(solve_hash(), golden_solve_hash);
}

TEST(Session, CurvesEndInTheSameBitsInEveryBuild) {
    EXPECT_EQ(curve_hash(), golden_curve_hash);
}

TEST(Session, LinkagesEndInTheSameBitsInEveryBuild) {
    EXPECT_EQ(linkage_hash(), golden_linkage_hash);
}

TEST(Session, RopesEndInTheSameBitsInEveryBuild) {
    EXPECT_EQ(rope_hash(), golden_rope_hash);
}

TEST(Session, RigsEndInTheSameBitsInEveryBuild) {
    EXPECT_EQ(rig_hash(), golden_rig_hash);
}

TEST(Session, RigSolvesEndInTheSameBitsInEveryBuild) {
    EXPECT_EQ(rig_solve_hash(), golden_rig_solve_hash);
}

TEST(Session, SignalsEndInTheSameBitsInEveryBuild) {
    EXPECT_EQ(signal_hash(), golden_signal_hash);
}

TEST(Session, CharactersEndInTheSameBitsInEveryBuild) {
    EXPECT_EQ(humanoid_hash(), golden_humanoid_hash);
}

}  // namespace tendril::test
