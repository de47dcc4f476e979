// The inspector's numbers match the picture: under the microscope, they belong to the step shown.
#include <glm/common.hpp>

#include "app/io/text.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panel.hpp"
#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class ChainInspector : public ChainTest {
  protected:
    std::string text() { return reader_.inspector(lab(), workspace); }
    void expect_says(const std::string& words) { EXPECT_TRUE(test::has(text(), words)); }
    void expect_silent_about(const std::string& words) { EXPECT_FALSE(test::has(text(), words)); }
    static std::string metres(float value) { return fixed_text(static_cast<double>(value), 3) + " m"; }
    void plain_fabrik(int bones, const Json& target) {
        reach_with(bones);
        run("chain.solver", {{"name", "fabrik_plain"}});
        run("chain.target", {{"to", target}});
    }

  private:
    test::PanelReader reader_;
};

TEST_F(ChainInspector, ShowsTheStepUnderTheMicroscope) {
    plain_fabrik(4, {1.2, 2.1, 0.7});
    run("microscope.open", {{"start", "straight"}});
    run("chain.select", {{"index", 4}});
    const auto shown = shown_chain(workspace).trace;
    const Trace& trace = *shown;
    // The tip was moved to the target and nothing else has moved, so its bone is far too long.
    run("microscope.seek", {{"step", 1}});
    const std::vector<glm::vec3> joints = trace.pose(1);
    const float residual = glm::distance(joints[4], part().target),
                bone = glm::distance(joints[4], joints[3]);
    ASSERT_GT(bone, 2.0f);
    expect_says("tip to target " + si_text(static_cast<double>(residual), "m"));
    expect_says("bone in this step " + metres(bone));
    expect_says("x " + metres(joints[4].x));
    expect_says("y " + metres(joints[4].y));
    expect_silent_about("Reached");
    EXPECT_EQ(state()["microscope"]["residual"], number(residual));
    EXPECT_EQ(state()["microscope"]["lengths"][4], number(bone));
    EXPECT_EQ(state()["microscope"]["lengths"][2], 1.0);

    // On the way, the joints take poses at which no solve ended.
    run("microscope.seek", {{"step", 4}});
    const std::vector<glm::vec3> later = trace.pose(4);
    expect_says("x " + metres(later[4].x));
    expect_says("tip to target " + si_text(static_cast<double>(glm::distance(later[4], part().target)), "m"));

    // The last step is the end of the solve, whose report is shown.
    run("microscope.seek", {{"step", trace.frames()}});
    expect_says("Reached");
    expect_says("tip to target " + si_text(static_cast<double>(part().result->report.residual), "m"));
    expect_says("x " + metres(part().chain.position(4).x));
}

TEST_F(ChainInspector, BeginsWithTheOutcomeForTheTarget) {
    const auto says = [&](const char* verdict) {
        EXPECT_EQ(state().at("verdict"), verdict);
        EXPECT_TRUE(text().starts_with(verdict)) << "it comes first, in:\n" << text();
    };
    says("Tail on the target");
    run("chain.mode", {{"mode", "with_index"}, {"index", 3}});
    says("Joint 3 on the target");
    run("chain.mode", {{"mode", "with_index"}, {"index", 5}});
    says("Joint 5 on the target");
    run("chain.mode", {{"mode", "fixed"}, {"iterations", 100}});
    run("chain.target", {{"to", {3, 2, 0}}});
    says("Head on the target");
    run("chain.clear");
    says("No joints");
    reach_with(2);
    says("Tip on the target");
    run("chain.pull", {{"index", 2}, {"to", {1, 1, 0}}});
    says("Drag the target");
    run("chain.target", {{"to", {0.5, 1.25, 0}}});
    says("Reached");
    run("chain.target", {{"to", {0, 2.25, 0}}});
    says("Out of reach: 0.25 m short");
    run("chain.target", {{"to", {1.5, 1, 0}}});
    run("chain.limit", {{"index", 1}, {"kind", "hinge"}, {"min_deg", 0}, {"max_deg", 90}});
    run("chain.target", {{"to", {0.5, 0, 0}}});
    EXPECT_TRUE(state().at("verdict").get<std::string>().starts_with("Limited: 0.")) << state().at("verdict");
    EXPECT_TRUE(test::says(text(), "Joint 1 (hinge) stops at 90 degrees the target needs"));
    run("chain.select", {{"index", 1}});
    expect_says("Joint 1 is at 90\xc2\xb0; straight is 0");
}

TEST_F(ChainInspector, ExplainsAStalledSolve) {
    // Straight along +X, with the target on that line: the published FABRIK bends nothing.
    plain_fabrik(4, {2.5, 0, 0});
    ASSERT_EQ(part().result->report.status, ik::Status::Stalled);
    expect_says("Folded onto the line to the target");
    plain_fabrik(4, {3.5, 0, 0});
    ASSERT_EQ(part().result->report.status, ik::Status::Stalled);
    expect_says("Straight, and the target is on its line");
    expect_says("pole target");
    expect_silent_about("would change nothing");
    // Following the advice works.
    run("chain.pole", {{"to", {3, 3, 0}}});
    EXPECT_EQ(part().result->report.status, ik::Status::Converged);

    ChainPart bent = part();
    bent.result = {.method = ik::Method::Ccd, .report = {.status = ik::Status::Stalled}, .active_limit = {}};
    EXPECT_TRUE(test::says(status_text(bent), "closer another solver"));
    EXPECT_EQ(status_text(bent).find("restarts"), std::string::npos);
    bent.reach.method = ik::Method::Fabrik;
    bent.result->method = ik::Method::Fabrik;
    bent.reach.limits.resize(4);
    EXPECT_TRUE(test::says(status_text(bent), "closer another solver restarts"));
}

TEST_F(ChainInspector, ShowsTheTableOfTheStep) {
    run("view.fold", {{"section", "chain: Joints, in metres"}, {"folded", false}});
    plain_fabrik(2, {0.5, 1.25, 0});
    run("microscope.open", {{"start", "straight"}});
    const auto trace = shown_chain(workspace).trace;
    for (std::size_t step = 0; step <= trace->frames(); ++step) {
        run("microscope.seek", {{"step", step}});
        const std::string said = text();
        for (const glm::vec3& joint : trace->pose(step)) {
            EXPECT_TRUE(test::has(said, fixed_text(static_cast<double>(joint.y), 2))) << "step " << step;
        }
    }
}

TEST_F(ChainInspector, CountsJointsAndNamesTheEndsRootAndTipWhereTheChainReaches) {
    expect_says("8 joints, 7 bones");
    run("chain.preset", {{"name", "start"}, {"count", 2}});
    expect_says("2 joints, 1 bone\n");
    run("chain.preset", {{"name", "start"}, {"count", 8}});
    run("chain.select", {{"index", 7}});
    expect_says("7 (tail)");
    expect_says("tail to target");
    run("chain.mode", {{"mode", "reach"}});
    expect_says("7 (tip)");
    expect_says("root to target");
    expect_silent_about("tail to target");
}

TEST_F(ChainInspector, CountsTimeFromTheLatestMoment) {
    for (int i = 0; i < 100; ++i) remember();
    workspace.rewind.note({.kind = Incident::Kind::Flip, .tick = 39, .joint = 1, .cause = "it was planted"});
    expect_says("Joint 1 flipped, 1.00 s ago");
    expect_silent_about("discards");
    run("time.incident", {{"number", 0}});
    ASSERT_EQ(workspace.moment, 40u);
    expect_says("Joint 1 flipped, 1.00 s ago");
    EXPECT_TRUE(test::says(text(), "An edit here discards the 1.0 s after it Undo"));
    run("time.seek", {{"ticks_back", 0}});
    expect_silent_about("discards");
}

TEST_F(ChainInspector, AMovingTargetWaitsWhileTheMicroscopeIsOpen) {
    reach_with(4);
    run("chain.target", {{"to", {2, 2, 0}}});
    run("chain.motion", {{"path", "circle"}});
    EXPECT_TRUE(lab().moving(workspace));
    run("microscope.open");
    EXPECT_FALSE(lab().moving(workspace));
    expect_says("The moving target waits while the microscope is open.");
    run("microscope.close");
    EXPECT_TRUE(lab().moving(workspace)) << "and then goes on";
    run("race.open");
    EXPECT_TRUE(lab().moving(workspace)) << "a race is run anew each tick";
}

// The preset Straight, a chain that FABRIK (2011) cannot bend; and the remedies for it and others.

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
