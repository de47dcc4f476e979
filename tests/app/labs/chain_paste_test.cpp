// chain.paste: the effect of points on the clipboard.
#include "tests/app/labs/chain_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class ChainPaste : public ChainTest {
  protected:
    void paste(const std::string& text) { run("chain.paste", {{"text", text}}); }
};

TEST_F(ChainPaste, RowsBecomeAChainWithItsTargetOnItsTail) {
    run("chain.select", {{"index", 3}});
    const Json before = state();
    paste("0 0 0\n0 2 0\n0 2 1");
    ASSERT_EQ(part().chain.size(), 3u);
    EXPECT_EQ(part().chain.position(1), glm::vec3(0, 2, 0));
    EXPECT_EQ(part().chain.length(1), 2.0f);
    EXPECT_EQ(part().chain.length(2), 1.0f);
    EXPECT_EQ(part().target, glm::vec3(0, 2, 1));
    EXPECT_TRUE(part().selection.empty());
    tells("chain 3 joints clipboard");
    run("undo");
    EXPECT_EQ(state(), before);
}

TEST_F(ChainPaste, OnePointMovesTheSelectionOrElseTheTarget) {
    paste("new Vector3(5f, 2f, 0f)");
    EXPECT_EQ(part().target, glm::vec3(5, 2, 0));
    EXPECT_EQ(part().chain.position(7), glm::vec3(5, 2, 0));
    tells("target 5.000 2.000 0.000");

    run("chain.select", {{"index", 3}});
    paste("(X=1,Y=2,Z=3)");
    EXPECT_EQ(part().chain.position(3), glm::vec3(1, 2, 3));
    tells("joint 1.000 2.000 3.000");

    reach_with(4);
    run("chain.pole", {{"to", {0, 1, 0}}});
    run("chain.select", {{"point", "pole"}});
    const glm::vec3 target = part().target;
    paste("[0, 0, 4]");
    EXPECT_EQ(part().reach.options.pole, glm::vec3(0, 0, 4));
    EXPECT_EQ(part().target, target);
    tells("pole 0.000 0.000 4.000");
    run("chain.select", {{"point", "target"}});
    paste("2 1 1");
    EXPECT_EQ(part().target, glm::vec3(2, 1, 1));
    EXPECT_LT(tip_distance(), 1e-2f);
}

TEST_F(ChainPaste, SeveralSelectedJointsKeepTheirOffsets) {
    run("chain.select", {{"joints", {2, 3}}});
    const glm::vec3 apart = part().chain.position(3) - part().chain.position(2);
    const std::size_t active = *part().selection.active();
    paste("1, 2, 3");
    EXPECT_LT(glm::distance(part().chain.position(active), glm::vec3(1, 2, 3)), 1e-5f);
    EXPECT_LT(glm::distance(part().chain.position(3) - part().chain.position(2), apart), 1e-5f);
}

TEST_F(ChainPaste, JunkIsRefusedWithItsLineAndChangesNothing) {
    std::string rows;
    for (int i = 0; i < 100'000; ++i) rows += "1 2 3\n";
    for (const auto& [text, told] :
         std::vector<std::pair<std::string, std::string>>{{"1 2 3\n4 nan 6", "chain.paste line 2 nan"},
                                                          {"1 2 3\n4 5 inf", "line 2 inf"},
                                                          {"1 2 2e9", "line 1 2e9"},
                                                          {"1 2", "line 1 three two"},
                                                          {"", "line 1 nothing"},
                                                          {"two words", "line 1 two"},
                                                          {std::string(1 << 20, '#'), "line 1"},
                                                          {rows, "line 10001 10000"}})
        refuses("chain.paste", {{"text", text}}, told);
}

}  // namespace
}  // namespace tendril::app
