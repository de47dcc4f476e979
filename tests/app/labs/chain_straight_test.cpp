// The preset Straight, a chain that FABRIK (2011) cannot bend; and the remedies for it and others.
#include <glm/common.hpp>

#include "app/labs/chain/cures.hpp"
#include "app/labs/chain/panel.hpp"
#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class StraightChain : public ChainTest {
  protected:
    std::string inspector() { return reader_.inspector(lab(), workspace); }

    void apply(const std::optional<Cure>& cure) {
        ASSERT_TRUE(cure);
        for (const CommandCall& call : cure->calls) run(call.name.c_str(), to_json(call.arguments), 77);
    }

  private:
    test::PanelReader reader_;
};

TEST_F(StraightChain, KeepsItsPoseWhateverItsLength) {
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

TEST_F(StraightChain, WithTooFewOrTooManyJointsReportsCorrectly) {
    run("chain.preset", {{"name", "straight"}, {"count", 1}});
    EXPECT_EQ(chain_verdict(part()).text, "One joint");
    run("chain.preset", {{"name", "straight"}, {"count", 2}});
    EXPECT_TRUE(test::says(chain_verdict(part()).text, "Too close")) << "one bone cannot fold";
    run("chain.preset", {{"name", "straight"}, {"count", 800}});
    EXPECT_EQ(chain_verdict(part()).text, "Reached") << "three quarters of a bone are within the tolerance";
}

/// The other solvers would stall too, so they perturb the chain first and report it.
TEST_F(StraightChain, MovesByAPerturbationThatTheReportMentions) {
    run("chain.preset", {{"name", "straight"}});
    run("chain.solver", {{"name", "fabrik"}});
    run("chain.target", {{"to", {3.25, 0, 0}}});
    EXPECT_EQ(chain_verdict(part()).text, "Reached");
    EXPECT_TRUE(test::says(inspector(), "FABRIK, accelerated, 1 perturbation"));
    // From a bent pose there is nothing to perturb.
    run("chain.target", {{"to", {3.0, 0.5, 0}}});
    EXPECT_EQ(inspector().find("perturbation"), std::string::npos) << inspector();
}

TEST_F(StraightChain, IsCuredByOneButtonInOneStep) {
    for (const int count : {3, 5, 8, 33, 64}) {
        run("chain.preset", {{"name", "straight"}, {"count", count}});
        const std::size_t steps = workspace.history.size();
        EXPECT_TRUE(test::says(inspector(), "Straight FABRIK (2011) Add a pole target"));
        apply(reach_cure(part()));
        EXPECT_EQ(chain_verdict(part()).text, "Reached") << count;
        EXPECT_FALSE(reach_cure(part())) << "nothing is left to cure";
        EXPECT_EQ(workspace.history.size(), steps + 1);
    }
}

TEST_F(StraightChain, OtherShortfallsHaveTheirOwnCures) {
    run("chain.preset", {{"name", "start"}, {"count", 9}});
    run("chain.mode", {{"mode", "reach"}});
    run("chain.solver", {{"name", "jacobian_transpose"}, {"iterations", 2}});
    run("chain.target", {{"to", {1, 5, 2}}});
    ASSERT_EQ(part().result->report.status, ik::Status::IterationLimit);
    EXPECT_EQ(reach_cure(part())->title, "More iterations");
    const float before = part().result->report.residual;
    apply(reach_cure(part()));
    EXPECT_EQ(part().reach.options.max_iterations, 4);
    EXPECT_LT(part().result->report.residual, before);

    ChainPart stalled = part();
    stalled.result->report.status = ik::Status::Stalled;
    stalled.result->method = stalled.reach.method = ik::Method::Ccd;
    EXPECT_EQ(reach_cure(stalled)->title, "Another solver");
    stalled.result->method = stalled.reach.method = ik::Method::Fabrik;
    EXPECT_FALSE(reach_cure(stalled)) << "without limits there are no restarts";
    stalled.reach.limits.resize(stalled.chain.size() - 1);
    EXPECT_EQ(reach_cure(stalled)->title, "More restarts");
    for (const ik::Status status : {ik::Status::Converged, ik::Status::Stretched, ik::Status::TooClose}) {
        stalled.result->report.status = status;
        EXPECT_FALSE(reach_cure(stalled));
    }
}

/// The drag of the card's third step, over the pole target and back again.
TEST_F(StraightChain, AFlipOverThePoleIsPreventedByItsButton) {
    run("chain.preset", {{"name", "reaching_arm"}});
    const glm::vec3 from(1.6f, 2.2f, -0.605f), over(0.3f, 2.95f, -0.605f), to(-1.0f, 2.2f, -0.605f);
    const auto drag = [&](glm::vec3 a, glm::vec3 b) {
        std::vector<Incident> flips;
        for (int i = 0; i <= 60; ++i) {
            const glm::vec3 at = glm::mix(a, b, static_cast<float>(i) / 60.0f);
            for (const Incident& each : incidents_of("chain.target", {{"to", point(at)}}))
                if (each.kind == Incident::Kind::Flip && i > 0) flips.push_back(each);
        }
        return flips;
    };
    drag(from, from);
    std::vector<Incident> flips = drag(from, over);
    for (const Incident& each : drag(over, to)) flips.push_back(each);
    ASSERT_FALSE(flips.empty());
    EXPECT_TRUE(test::says(flips.back().cause, "line the pole"));
    ASSERT_EQ(flips.back().buttons.size(), 1u);
    EXPECT_EQ(flips.back().buttons[0].title, "Move the pole");
    apply(flips.back().buttons[0]);
    EXPECT_TRUE(drag(to, over).empty());
    EXPECT_TRUE(drag(over, from).empty());
}

TEST_F(StraightChain, AFlipOfAStraightChainOffersAPoleUnlessThereIsOne) {
    run("chain.preset", {{"name", "straight"}});
    const ChainPart before = part();
    const auto pole = flip_cure(FlipCure::AddPole, before, before);
    ASSERT_TRUE(pole);
    EXPECT_EQ(pole->calls.front().name, "chain.pole");
    run("chain.pole", {{"to", {2, 2, 0}}});
    EXPECT_FALSE(flip_cure(FlipCure::AddPole, before, part()));
    EXPECT_EQ(flip_cure(FlipCure::NoRestarts, before, part())->calls.front().name, "chain.solver");
    EXPECT_FALSE(flip_cure(FlipCure::ByHand, before, part()));
}

}  // namespace
}  // namespace tendril::app
