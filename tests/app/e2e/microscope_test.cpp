// The microscope in the running program: the solve that it shows stays the same.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

TEST(Microscope, shows_one_solve_while_the_target_would_move) {
    ScriptText script;
    script.command("chain.mode", {{"mode", "reach"}}).command("chain.target", {{"to", {3, 3, 1}}});
    script.command("chain.motion", {{"path", "circle"}, {"period", 2}}).wait(20);
    script.command("microscope.open").command("microscope.seek", {{"step", 3}});
    const app::Json before = state_after(script);
    const app::Json after = state_after(script.wait(30));
    EXPECT_EQ(after["target"], before["target"]);
    EXPECT_EQ(after["microscope"], before["microscope"]);
    const app::Json closed = state_after(script.command("microscope.close").wait(10));
    EXPECT_NE(closed["target"], before["target"]) << "the target goes on once the microscope is closed";
}

}  // namespace
}  // namespace tendril::test
