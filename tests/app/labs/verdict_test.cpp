// Each lab's verdict, in the inspector and in --state.
#include <numeric>
#include <random>
#include <set>

#include "app/document/runtime.hpp"
#include "app/labs/kit/selection.hpp"
#include "app/labs/rope/panel.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class RopeVerdict : public RopeTest {
  protected:
    std::string said() const { return state()["verdict"]; }
};

class VerdictTest : public LabTest {
  protected:
    using LabTest::LabTest;
    std::string said() const { return state()["verdict"]; }
};

TEST_F(RopeVerdict, SaysWhetherLengthsHold) {
    run("rope.clear");
    EXPECT_EQ(said(), "No ropes");
    run("rope.preset", {{"name", "pendulum"}});
    EXPECT_EQ(said(), "Lengths hold") << "before it has moved";
    wait(60);
    EXPECT_EQ(said(), "Lengths hold");
    // A solver that does not keep lengths, with few iterations.
    run("rope.preset", {{"name", "bridge"}});
    run("rope.settings", {{"solver", "relaxation"}, {"iterations", 1}});
    wait(60);
    EXPECT_TRUE(said().starts_with("Lengths off by ")) << said();
}

TEST_F(RopeVerdict, OfElasticRopesAsksForNothing) {
    for (const char* how : {"compliance", "stretch"}) {
        run("rope.clear");
        run("rope.settings", {{"compliance", 0}});
        run("rope.add", {{"name", "line"}, {"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"pin_start", true}});
        if (how == std::string("compliance"))
            run("rope.settings", {{"compliance", 0.05}});
        else
            run("rope.set", {{"rope", "line"}, {"stretch", 0.005}});
        wait(120);
        EXPECT_TRUE(said().starts_with("Stretched by ")) << how << ": " << said();
        EXPECT_TRUE(test::says(state()["why"], "line stretch compliance"));
        workspace.document.edit<RopePart>(rope_lab).samples.clear();
        run("rope.set", {{"rope", "line"}, {"length", 2}});
        EXPECT_TRUE(said().starts_with("Squeezed by ")) << how << ": " << said();
    }
}

TEST_F(RopeVerdict, SaysWhenPinsAreFurtherApartThanABodyReaches) {
    run("rope.clear");
    add_rope("line", {0, 1, 0}, {1, 1, 0}, {{"pin_start", true}, {"pin_end", true}});
    run("rope.pin", {{"rope", "line"}, {"particle", 32}, {"at", {1.5, 1, 0}}});
    wait(60);
    EXPECT_TRUE(test::says(state()["why"], "The pins of line 1.50 m apart 1.00 m long"));
    run("rope.hold", {{"rope", "line"}, {"particle", 16}, {"at", {0.5, 1, 0}}}, 7);
    EXPECT_TRUE(test::says(state()["why"], "drag of line")) << state()["why"];
    run("rope.clear");
    add_cloth("sheet", {0, 1, 0}, {1, 0, 0}, {0, -1, 0}, 5, 5, "corners");
    run("rope.pin", {{"rope", "sheet"}, {"particle", 4}, {"at", {1.6, 1, 0}}});
    wait(60);
    EXPECT_TRUE(test::says(state()["why"], "pins sheet 1.60 m apart 1.00 m long"));
    EXPECT_TRUE(said().starts_with("Lengths off by ")) << said();
}

/// The path runs from a pin along one rope, over the tie, and along the other to its pin.
TEST_F(RopeVerdict, SaysWhenPinsAreFurtherApartThanTiedBodiesReach) {
    run("rope.clear");
    add_rope("left", {0, 1, 0}, {0.6, 1, 0}, {{"segments", 8}, {"pin_start", true}});
    add_rope("right", {1.3, 1, 0}, {2.1, 1, 0}, {{"segments", 8}, {"pin_end", true}});
    run("rope.tie", {{"a", "left"}, {"a_particle", 8}, {"b", "right"}, {"b_particle", 0}, {"length", 0.3}});
    wait(200);
    EXPECT_TRUE(said().starts_with("Lengths off by ")) << said();
    EXPECT_TRUE(test::says(state()["why"], "pins left and right 2.10 m apart tied reach 1.70 m"));
    // With a tie as long as the gap, nothing is pulled.
    run("rope.tie.set", {{"name", "tie"}, {"length", 0.72}});
    wait(400);
    EXPECT_EQ(said(), "Lengths hold") << state()["why"];
    // The shortest of several paths counts: over a tie between the middles, along half of each rope.
    run("rope.tie", {{"a", "left"}, {"a_particle", 4}, {"b", "right"}, {"b_particle", 4}, {"length", 0.7}});
    wait(200);
    EXPECT_TRUE(test::says(state()["why"], "2.10 m apart tied reach 1.40 m"));
    // A tie between two pins.
    run("rope.tie", {{"a", "left"}, {"a_particle", 0}, {"b", "right"}, {"b_particle", 8}, {"length", 0.1}});
    EXPECT_EQ(said(), "A tie cannot close");
    EXPECT_TRUE(test::says(state()["why"], "pins 2.10 m apart 0.10 m long Unpin"));
    // Along a row of a cloth, from a tie to its corner.
    run("rope.clear");
    add_rope("line", {0, 2, 0}, {0.5, 2, 0}, {{"segments", 4}, {"pin_start", true}});
    add_cloth("sheet", {0.8, 2, 0}, {1, 0, 0}, {0, -1, 0}, 5, 5);
    run("rope.pin", {{"rope", "sheet"}, {"particle", 4}});
    run("rope.tie", {{"a", "line"}, {"a_particle", 4}, {"b", "sheet"}, {"b_particle", 0}});
    wait(120);
    EXPECT_TRUE(test::says(state()["why"], "pins line and sheet 1.80 m apart tied reach 1.50 m"));
}

/// Elastic ropes are not too short: the verdict says how far they are stretched.
TEST_F(RopeVerdict, OfElasticRopesBetweenPinsBlamesNoPin) {
    run("rope.clear");
    add_rope("line", {0, 1, 0}, {1, 1, 0}, {{"pin_start", true}, {"pin_end", true}});
    run("rope.set", {{"rope", "line"}, {"stretch", 0.01}});
    run("rope.pin", {{"rope", "line"}, {"particle", 32}, {"at", {1.5, 1, 0}}});
    wait(120);
    EXPECT_TRUE(said().starts_with("Stretched by ")) << said() << state()["why"];
}

/// No more iterations and no shorter steps can help there, so it recommends none.
TEST_F(RopeVerdict, NamesThePinsForAnySolverAndAnyError) {
    for (const char* solver : {"direct", "xpbd", "relaxation"}) {
        for (const double apart : {1.004, 1.5}) {
            run("rope.clear");
            run("rope.settings", {{"solver", solver}, {"iterations", 1}});
            add_rope("line", {0, 1, 0}, {1, 1, 0}, {{"pin_start", true}, {"pin_end", true}});
            run("rope.pin", {{"rope", "line"}, {"particle", 32}, {"at", {apart, 1, 0}}});
            wait(60);
            const std::string text = test::PanelReader().inspector(lab(), workspace);
            const std::string where = std::string(solver) + " at " + std::to_string(apart) + ":\n" + text;
            EXPECT_TRUE(said().starts_with("Lengths off by ")) << where;
            EXPECT_TRUE(test::says(state()["why"], "pins line apart m long")) << where;
            EXPECT_EQ(text.find("iterations"), text.npos) << where;
            EXPECT_EQ(text.find("horter"), text.npos) << where;
        }
    }
}

TEST_F(RopeVerdict, SaysHowMuchTimeIsDropped) {
    run("rope.preset", {{"name", "pendulum"}});
    run("rope.settings", {{"longest_frame", 0.5 * tick_seconds}});
    wait(120);
    EXPECT_EQ(said(), "Lengths hold, at 50 % of real time");
    run("rope.settings", {{"longest_frame", 0.25}});
    wait(61);
    EXPECT_EQ(said(), "Lengths hold");
}

TEST_F(RopeVerdict, ReportsFloatingInsideOrUnsolvedBodies) {
    RopePart part = rope_part(workspace);
    part.samples = {RopeSample{.report = {.suspended = 1}}};
    EXPECT_EQ(rope_verdict(part).text, "Neither held nor falling");
    part.samples.push_back({});
    EXPECT_EQ(rope_verdict(part).text, "Lengths hold");
    part.samples.insert(part.samples.end(), 59, {.report = {.unconverged = 2}});
    part.samples.push_back({});
    const Verdict said_of_second = rope_verdict(part);
    EXPECT_TRUE(test::says(said_of_second.text, "Did not converge"));
    EXPECT_NE(said_of_second.why.find("118 steps"), std::string::npos) << said_of_second.why;
    EXPECT_TRUE(said_of_second.cure);
    Pace& pace = pace_of(workspace.runtimes);
    pace.kept = 0.5;
    workspace.clock.playing = true;
    EXPECT_FALSE(paced_verdict(said_of_second, workspace).cure) << "half the substep would be slower still";
    const auto slow = [&](float cost) {
        workspace.document.edit<RopePart>(rope_lab).samples = {RopeSample{.cost = cost, .report = {}}};
        return paced_verdict({"Lengths hold", Verdict::Kind::Good}, workspace).why;
    };
    EXPECT_TRUE(test::says(slow(2e4f), "20.0 ms fewer particles"));
    EXPECT_TRUE(test::says(slow(163.0f), "163 drawing"));
    pace.kept = 1.0;
    EXPECT_TRUE(paced_verdict(said_of_second, workspace).cure);
    part.samples.back().report.dropped = 1;
    EXPECT_FALSE(rope_verdict(part).cure) << "a tick drops substeps already";
    part.samples.insert(part.samples.end(), 60, {});
    EXPECT_EQ(rope_verdict(part).text, "Lengths hold") << "that was more than a second ago";
    run("rope.clear");
    run("rope.add", {{"name", "line"}, {"from", {0, 0, 0}}, {"to", {1, 0, 0}}});
    run("rope.collider.add",
        {{"name", "roof"}, {"kind", "plane"}, {"point", {0, -5, 0}}, {"normal", {0, -1, 0}}});
    run("rope.collider.add",
        {{"name", "floor"}, {"kind", "plane"}, {"point", {0, 5, 0}}, {"normal", {0, 1, 0}}});
    wait(2);
    EXPECT_EQ(said(), "Inside a collider");
    EXPECT_TRUE(state()["why"].get<std::string>().starts_with("33 particles ")) << state()["why"];
}

TEST_F(RopeVerdict, ReportsTheEffectOfContacts) {
    run("rope.preset", {{"name", "bars"}});
    double lost = 0.0;
    for (int i = 0; i < 3; ++i) {
        wait(60);
        lost += state()["last_second"]["contact_loss"].get<double>();
    }
    EXPECT_GT(lost, 1.0);
}

class SignalVerdict : public VerdictTest {
  protected:
    SignalVerdict() : VerdictTest("signal") {}
};

TEST_F(SignalVerdict, SaysHowTheChainFollows) {
    run("signal.filter.add", {{"kind", "one_euro"}, {"beside", true}});
    run("signal.filter.enable", {{"at", 1}, {"on", false}});
    EXPECT_TRUE(said().starts_with("Settles in ")) << said() << ", as the filter that is on";
    run("signal.preset", {{"name", "spring_that_explodes"}});
    EXPECT_EQ(said(), "Runs away");
    while (!state()["filters"].empty()) run("signal.filter.remove", {{"at", 0}});
    EXPECT_EQ(said(), "No filter is on");
}

class RigVerdict : public VerdictTest {
  protected:
    RigVerdict() : VerdictTest("rig") {}
};

TEST_F(RigVerdict, SaysWhetherEveryUnitRan) {
    run("rig.solve");
    EXPECT_EQ(said(), "All units ran");
    // Aiming an item at its own position: there is no direction.
    run("rig.clear");
    EXPECT_EQ(said(), "No elements");
    run("rig.element.add", {{"name", "a"}});
    run("rig.element.add", {{"name", "b"}});
    EXPECT_EQ(said(), "No units");
    run("rig.unit.add", {{"unit", "aim"}, {"item", "a"}, {"primary", {{"target", "b"}}}});
    run("rig.solve");
    EXPECT_EQ(said(), "1 unit with problems");
}

class HumanoidVerdict : public VerdictTest {
  protected:
    HumanoidVerdict() : VerdictTest("humanoid") {}
};

TEST_F(HumanoidVerdict, NamesTheOptionalBonesThatAreMissing) {
    run("humanoid.map", {{"bone", "Chest"}});
    run("humanoid.map", {{"bone", "LeftToes"}});
    EXPECT_EQ(said(), "Usable body");
    const std::string text = test::PanelReader().inspector(lab(), workspace);
    EXPECT_TRUE(test::says(text, "20 of 22 bones mapped optional missing Chest LeftToes"));
}

TEST_F(HumanoidVerdict, SaysWhetherItReaches) {
    EXPECT_EQ(said(), "Complete body");
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.5, 1.2, 0.2}}});
    EXPECT_EQ(said(), "Reached");
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {9, 1.2, 0.2}}});
    EXPECT_TRUE(said().ends_with(" short")) << said();
}

// A selection among items that are inserted and removed.

using Indices = std::vector<std::size_t>;

Selection loaded(const Json& json, std::size_t count) {
    return Selection::load({json, "selected"}, count);
}

TEST(Selection, TheLastOneAddedIsActive) {
    Selection selection;
    EXPECT_FALSE(selection.active());
    selection.take({5, 2, 9, 2}, false);
    EXPECT_EQ(selection.all(), (Indices{2, 5, 9}));
    EXPECT_EQ(selection.active(), 2u);
    selection.toggle(7);
    EXPECT_EQ(selection.active(), 7u);
    selection.toggle(5);
    EXPECT_EQ(selection.active(), 7u) << "another that goes leaves it";
    selection.toggle(7);
    EXPECT_EQ(selection.active(), 9u);
    selection.take({1}, true);
    EXPECT_EQ(selection.all(), (Indices{1, 2, 9}));
    selection.only(3);
    EXPECT_EQ(selection.all(), Indices{3});
    selection.toggle(3);
    EXPECT_EQ(selection, Selection());
}

/// Compares it with a set of names, which insertions and removals do not change.
TEST(Selection, FollowsInsertionsAndRemovals) {
    std::mt19937 random(11);
    for (int round = 0; round < 300; ++round) {
        std::vector<int> things(12);
        std::iota(things.begin(), things.end(), 0);
        int next = 100;
        std::set<int> wanted;
        int active = -1;
        Selection selection;
        for (int step = 0; step < 60; ++step) {
            const std::size_t size = things.size();
            const std::size_t at = random() % (size + 1);
            const unsigned kind = random() % 4;
            if (kind == 0) {
                things.insert(things.begin() + static_cast<std::ptrdiff_t>(at), next++);
                selection.inserted(at);
            } else if (kind == 1 && at < size) {
                const bool was_active = things[at] == active;
                wanted.erase(things[at]);
                things.erase(things.begin() + static_cast<std::ptrdiff_t>(at));
                selection.removed(at);
                if (was_active) active = selection.active() ? things[*selection.active()] : -1;
            } else if (kind == 2 && at < size) {
                if (wanted.contains(things[at])) {
                    wanted.erase(things[at]);
                    selection.toggle(at);
                    if (things[at] == active) active = selection.active() ? things[*selection.active()] : -1;
                } else {
                    wanted.insert(active = things[at]);
                    selection.toggle(at);
                }
            }
            std::set<int> found;
            for (const std::size_t index : selection.all()) {
                ASSERT_LT(index, things.size());
                found.insert(things[index]);
            }
            ASSERT_EQ(found, wanted);
            ASSERT_TRUE(std::is_sorted(selection.all().begin(), selection.all().end()));
            ASSERT_EQ(selection.active() ? things[*selection.active()] : -1, active);
            ASSERT_EQ(selection.empty(), !selection.active());
            ASSERT_EQ(loaded(selection.save(), std::max<std::size_t>(things.size(), 1)), selection);
        }
    }
}

TEST(Selection, KeepsItemsThatStillExist) {
    Selection selection;
    selection.take({8, 1, 6}, false);
    selection.keep_below(7);
    EXPECT_EQ(selection.all(), (Indices{1, 6}));
    EXPECT_EQ(selection.active(), 6u);
    selection.keep_below(0);
    EXPECT_EQ(selection, Selection());
}

TEST(Selection, AnInvalidFileIsRefusedWithItsPath) {
    const auto says = [](const Json& json, const std::string& what) {
        EXPECT_TRUE(test::has(test::message_of([&] { loaded(json, 5); }), what)) << json;
    };
    says(5, "selected");
    says(-1, "selected");
    says("all", "selected");
    says({{"active", 1}}, "\"all\" is missing");
    says({{"active", 1}, {"all", {2, 3}}}, "selected.active");
    says({{"active", 1}, {"all", {1, 7}}}, "selected.all");
    says({{"active", 1}, {"all", {1, 1, 1, 1, 1, 1}}}, "maximum is 5");
    says({{"active", 1}, {"all", 1}}, "selected.all");
}

}  // namespace
}  // namespace tendril::app
