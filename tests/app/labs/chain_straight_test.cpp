// The preset Straight: a chain that FABRIK (2011) cannot bend, and what helps.
#include "app/labs/chain/panel.hpp"
#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class StraightChain : public ChainTest {
  protected:
    std::string inspector() { return reader_.inspector(lab(), workspace); }

  private:
    test::PanelReader reader_;
};

TEST_F(StraightChain, StaysAsItIsWhateverItsLength) {
    run("chain.preset", {{"name", "straight"}});
    EXPECT_EQ(part().chain.size(), 5u);
    for (int count = 3; count <= 64; ++count) {
        run("chain.preset", {{"name", "straight"}, {"count", count}});
        const ik::Report& report = part().result->report;
        EXPECT_EQ(report.status, ik::Status::Stalled) << count;
        EXPECT_EQ(part().result->method, ik::Method::FabrikPlain);
        EXPECT_LT(part().target.x, part().chain.position(part().chain.size() - 1).x);
        for (std::size_t i = 0; i < part().chain.size(); ++i)
            EXPECT_EQ(part().chain.position(i), glm::vec3(static_cast<float>(i), 0, 0)) << count;
        EXPECT_TRUE(test::says(status_text(part()), "Straight target on its line")) << status_text(part());
    }
    EXPECT_TRUE(test::says(inspector(), "Stalled: 0.75 m short Straight line pole FABRIK (2011)"));
}

TEST_F(StraightChain, OfTooFewOrTooManyJointsTellsTheTruth) {
    run("chain.preset", {{"name", "straight"}, {"count", 1}});
    EXPECT_EQ(chain_verdict(part()).text, "One joint");
    run("chain.preset", {{"name", "straight"}, {"count", 2}});
    EXPECT_TRUE(test::says(chain_verdict(part()).text, "Too close")) << "one bone cannot fold";
    run("chain.preset", {{"name", "straight"}, {"count", 800}});
    EXPECT_EQ(chain_verdict(part()).text, "Reached") << "three quarters of a bone are within the tolerance";
}

/// The other solvers would stall too, so they perturb the chain first, and say so.
TEST_F(StraightChain, MovesByAPerturbationOfWhichTheReportTells) {
    run("chain.preset", {{"name", "straight"}});
    run("chain.solver", {{"name", "fabrik"}});
    run("chain.target", {{"to", {3.25, 0, 0}}});
    EXPECT_EQ(chain_verdict(part()).text, "Reached");
    EXPECT_TRUE(test::says(inspector(), "FABRIK, accelerated, 1 perturbation"));
    // From a bent pose there is nothing to perturb.
    run("chain.target", {{"to", {3.0, 0.5, 0}}});
    EXPECT_EQ(inspector().find("perturbation"), std::string::npos) << inspector();
}

}  // namespace
}  // namespace tendril::app
