// Texts of exported C++.
#include "app/labs/kit/code_text.hpp"

#include <gtest/gtest.h>

#include "app/labs/humanoid/code.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"

namespace tendril::app {
namespace {

/// A name with a newline would end the literal, or a comment, and go on as code.
TEST(CodeText, EscapesWhatALiteralCannotHold) {
    EXPECT_EQ(string_text("a\"b\\c"), R"("a\"b\\c")");
    EXPECT_EQ(string_text(std::string_view("a\n\r\0\x7f"
                                           "1",
                                           6)),
              R"("a\012\015\000\1771")");
    EXPECT_EQ(string_text("Bär"), "\"Bär\"");
}

TEST(HumanoidCode, AnEmptyListIsClosed) {
    HumanoidPart part;
    part.ik.target(humanoid::Effector::LeftHand) = TargetSetting{.position = {0.3, 1.2, 0.4}};
    part.ik_state.body.pace = 0.1;  // and no turns
    Solvers solvers;
    EXPECT_NE(humanoid_code(part, solvers).find("body_state.turns = {};"), std::string::npos);
}

}  // namespace
}  // namespace tendril::app
