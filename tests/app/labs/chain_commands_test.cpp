// The Chain lab's commands: effects, refusals, and that a refusal changes nothing.
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "tests/app/labs/chain_support.hpp"

namespace tendril::app {
namespace {

class ChainCommands : public ChainTest {};

TEST_F(ChainCommands, TargetAppliesTheModeOnceAndModeAloneMovesNothing) {
    run("chain.target", {{"to", {5, 2, 0}}});
    EXPECT_EQ(part().chain.position(7), glm::vec3(5, 2, 0));
    const Chain before = part().chain;
    run("chain.mode", {{"mode", "forward"}});
    EXPECT_EQ(part().chain, before);
    run("chain.target", {{"to", {0, 3, 1}}});
    EXPECT_EQ(part().chain.position(0), glm::vec3(0, 3, 1));
    const glm::vec3 tail = part().chain.position(7);
    run("chain.mode", {{"mode", "fixed"}, {"iterations", 20}});
    run("chain.target", {{"to", {1, 1, 1}}});
    EXPECT_EQ(part().chain.position(7), tail);
    run("chain.mode", {{"mode", "with_index"}, {"index", 3}});
    run("chain.target", {{"to", {2, 2, 2}}});
    EXPECT_EQ(part().chain.position(3), glm::vec3(2, 2, 2));
    run("chain.mode", {{"mode", "with_index"}, {"index", 5}});
    EXPECT_EQ(part().chain.position(5), glm::vec3(2, 2, 2)) << "at once";
}

TEST_F(ChainCommands, EachModeKeepsItsOwnIterations) {
    run("chain.mode", {{"mode", "fixed"}, {"iterations", 7}, {"tolerance", 0.01}});
    run("chain.mode", {{"mode", "forward"}, {"iterations", 3}});
    EXPECT_EQ(part().tolerance, 0.01f);
    run("chain.mode", {{"mode", "fixed"}});
    EXPECT_EQ(state().at("iterations"), 7);
    run("chain.mode", {{"mode", "with_index"}, {"index", 5}});
    run("chain.mode", {{"mode", "backward"}});
    EXPECT_EQ(part().index, 5u);
}

TEST_F(ChainCommands, EditsAreAppliedAndTheSelectionStaysWithItsSegment) {
    run("chain.select", {{"index", 4}});
    run("chain.insert", {{"index", 2}, {"length", 0.5}});
    EXPECT_EQ(part().chain.size(), 9u);
    EXPECT_EQ(part().selection.active(), 5u);
    run("chain.remove", {{"index", 0}});
    EXPECT_EQ(part().selection.active(), 4u);
    run("chain.remove", {{"index", 7}});
    run("chain.set_length", {{"index", 1}, {"length", 0.25}});
    EXPECT_EQ(part().chain.length(1), 0.25f);
    run("chain.add", {{"length", 2}, {"position", {0, 9, 0}}});
    EXPECT_NEAR(glm::distance(part().chain.position(7), part().chain.position(6)), 2.0f, 1e-4f);
    while (!part().chain.empty()) run("chain.remove", {{"index", part().chain.size() - 1}});
    EXPECT_TRUE(part().selection.empty());
    run("chain.target", {{"to", {1, 2, 3}}});  // an empty chain: only the target moves
    EXPECT_EQ(part().target, glm::vec3(1, 2, 3));
    run("chain.add", {{"length", 1}});
    EXPECT_EQ(part().chain.size(), 1u);
}

TEST_F(ChainCommands, ClearTakesADirectionForBonesWithoutOne) {
    run("chain.mode", {{"mode", "reach"}, {"tolerance", 0.5}});
    run("chain.pole", {{"to", {0, 0, 9}}});
    run("chain.motion", {{"path", "circle"}});
    run("chain.clear", {{"default_direction", {0, 1, 0}}});
    EXPECT_EQ(part().reach, ReachSettings()) << "the settings go too";
    EXPECT_EQ(part().motion, Motion());
    EXPECT_EQ(part().mode, ChainMode::Reach);
    EXPECT_TRUE(part().chain.empty());
    for (int i = 0; i < 5; ++i) run("chain.add", {{"length", 1}, {"position", {1, 1, 1}}});
    EXPECT_EQ(part().chain.position(4), glm::vec3(1, 5, 1));
    refused("chain.clear", {{"default_direction", {0, 0, 0}}});
    refused("chain.clear", {{"default_direction", {0, 5, 0}}});
}

TEST_F(ChainCommands, PresetsAreValidAtEverySize) {
    for (const char* name : {"start", "arm", "snake", "coil", "random", "tentacle", "spine", "tail"}) {
        for (const int count : {1, 2, 3, 50, 3000}) {
            run("chain.preset", {{"name", name}, {"count", count}, {"seed", 7}});
            const Chain& chain = part().chain;
            ASSERT_EQ(chain.size(), static_cast<std::size_t>(count));
            const bool curved = part().mode == ChainMode::Curve;
            ASSERT_EQ(curved, preset_named(name).curved());
            if (!curved) {
                EXPECT_EQ(part().target, chain.position(chain.size() - 1));
            } else if (count > 1) {
                EXPECT_EQ(part().target, part().curve.points.back());
                ASSERT_TRUE(part().along.report) << name;
                EXPECT_NE(part().along.report->status, ik::Status::InvalidInput) << name;
            }
            for (std::size_t i = 0; i < chain.size(); ++i) {
                EXPECT_TRUE(std::isfinite(glm::length(chain.position(i))));
                EXPECT_GT(chain.length(i), 0.0f);
                EXPECT_LE(length_error(chain, i), 1e-4f * std::max(1.0f, chain.length(i)))
                    << name << " " << i;
            }
        }
    }
}

TEST_F(ChainCommands, AMovingTargetStartsWhereItIsAndPullsTheChain) {
    EXPECT_FALSE(lab().moving(workspace));
    for (const char* path : {"circle", "figure_eight", "sweep"}) {
        run("chain.motion", {{"path", path}, {"radius", 1.5}, {"period", 2}});
        EXPECT_TRUE(lab().moving(workspace));
        EXPECT_NEAR(glm::distance(motion_point(part().motion, 0), part().target), 0.0f, 1e-5f);
        const glm::vec3 first = part().target;
        float farthest = 0.0f;
        for (int i = 0; i < 120; ++i) {
            wait(1);
            EXPECT_EQ(part().chain.position(7), part().target);
            farthest = std::max(farthest, glm::distance(first, part().target));
        }
        EXPECT_GT(farthest, 1.0f) << path;
        EXPECT_NEAR(glm::distance(first, part().target), 0.0f, 1e-5f) << path << " does not close";
    }
    run("chain.seek", {{"tick", 30}});
    EXPECT_EQ(part().motion.ticks, 30u);
    run("chain.motion", {{"path", "still"}});
    EXPECT_FALSE(lab().moving(workspace));
}

TEST_F(ChainCommands, CommandsWithoutEffectLeaveNoUndoStep) {
    run("chain.mode", {{"mode", "backward"}});
    run("chain.set_length", {{"index", 3}, {"length", 1}});
    EXPECT_EQ(workspace.history.size(), 0u);
    EXPECT_FALSE(workspace.modified());
    run("chain.select", {{"index", 3}});
    EXPECT_FALSE(workspace.modified()) << "choosing something is nothing that wants saving";
    run("chain.motion", {{"path", "circle"}});
    run("chain.seek", {{"tick", 40}}, 5);
    run("chain.seek", {{"tick", 41}}, 5);
    EXPECT_EQ(workspace.history.size(), 2u);
}

TEST_F(ChainCommands, TheIndexFollowsItsSegment) {
    run("chain.mode", {{"mode", "with_index"}, {"index", 3}});
    run("chain.insert", {{"index", 1}, {"length", 1}});
    EXPECT_EQ(part().index, 4u);
    for (const int removed : {0, 6}) {
        run("chain.remove", {{"index", removed}});
        EXPECT_EQ(part().index, 3u) << removed;
    }
}

TEST_F(ChainCommands, NothingLeavesTheRangeThatAFileCanHold) {
    run("chain.add", {{"length", 1e9}});
    refused("chain.add", {{"length", 1e9}});
    run("chain.reset");
    run("chain.target", {{"to", {1e9, 0, 0}}});
    refused("chain.motion", {{"path", "sweep"}, {"radius", 10000}});
    run("chain.motion", {{"path", "sweep"}, {"radius", 0}});
    wait(300);
    const Json scene = save_scene(workspace);
    run("chain.clear");
    load_scene(workspace, parse_json(scene.dump()));
    EXPECT_EQ(save_scene(workspace), scene);
}

TEST_F(ChainCommands, ResetConcernsThisLabAndKeepsTheFile) {
    const Json first = part().save();
    workspace.path = "walk.json";
    run("chain.preset", {{"name", "coil"}});
    run("chain.reset");
    EXPECT_EQ(part().save(), first);
    EXPECT_EQ(workspace.path, "walk.json");
}

TEST_F(ChainCommands, UndoAndRedoNameTheLabThatWasNotOpen) {
    const auto told = [&] { return workspace.ui.toasts.empty() ? "" : workspace.ui.toasts.back().text; };
    run("chain.preset", {{"name", "arm"}});
    run("undo");
    EXPECT_EQ(told(), "");
    run("lab.open", {{"name", "rope"}});
    run("redo");
    EXPECT_EQ(told(), "Redone in the Chain lab.");
    EXPECT_EQ(workspace.lab, "chain");
    run("lab.open", {{"name", "rope"}});
    run("undo");
    EXPECT_EQ(told(), "Undone in the Chain lab.");
}

// chain.paste: the effect of points on the clipboard.

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

// Several joints at once: selecting, limiting, lengthening, removing.

class ChainSelection : public ChainTest {
  protected:
    using Indices = std::vector<std::size_t>;
    const Indices& selected() const { return part().selection.all(); }
    ik::JointKind kind(std::size_t joint) const { return limit_of(part().reach, joint).kind; }
};

TEST_F(ChainSelection, LimitsApplyToAllAndEachKeepsOmittedValues) {
    reach_with(6);
    run("chain.limit",
        {{"index", 1}, {"kind", "hinge"}, {"axis", {0, 0, 1}}, {"min_deg", -10}, {"max_deg", 90}});
    run("chain.limit",
        {{"index", 3}, {"kind", "hinge"}, {"axis", {0, 1, 0}}, {"min_deg", 0}, {"max_deg", 120}});
    run("chain.limit", {{"joints", {1, 3}}, {"max_deg", 45}});
    EXPECT_EQ(kind(1), ik::JointKind::Hinge);
    EXPECT_EQ(limit_of(part().reach, 1).axis, glm::vec3(0, 0, 1));
    EXPECT_EQ(limit_of(part().reach, 3).axis, glm::vec3(0, 1, 0));
    EXPECT_EQ(kind(2), ik::JointKind::Free);
    EXPECT_FLOAT_EQ(limit_of(part().reach, 1).max, glm::radians(45.0f));
    EXPECT_FLOAT_EQ(limit_of(part().reach, 3).max, glm::radians(45.0f));
    EXPECT_FLOAT_EQ(limit_of(part().reach, 1).min, glm::radians(-10.0f));
    run("chain.limit", {{"joints", {0, 2, 4}}, {"kind", "hinge"}});
    for (const std::size_t joint : {0u, 1u, 2u, 3u, 4u})
        EXPECT_EQ(kind(joint), ik::JointKind::Hinge) << joint;
    run("undo");
    EXPECT_EQ(kind(2), ik::JointKind::Free) << "one step for all";
    EXPECT_EQ(kind(1), ik::JointKind::Hinge);
}

TEST_F(ChainSelection, DeleteRemovesAllOfThem) {
    const std::size_t size = part().chain.size();
    run("chain.set_length", {{"index", 4}, {"length", 0.5}});
    run("chain.select", {{"joints", {1, 3, 6}}});
    run("chain.remove_selected");
    EXPECT_EQ(part().chain.size(), size - 3);
    EXPECT_FLOAT_EQ(part().chain.length(2), 0.5f) << "the fourth is the second now";
    EXPECT_TRUE(selected().empty());
    expect_refused("chain.remove_selected", Json::object(), {"no joint is selected"});
    run("undo");
    EXPECT_EQ(part().chain.size(), size);
    run("chain.select", {{"joints", {0, 1, 2, 3, 4, 5, 6, 7}}});
    run("chain.remove_selected");
    EXPECT_TRUE(part().chain.empty());
}

/// One by one this would take hours and run out of time.
TEST_F(ChainSelection, ThousandsAreSetAtOnce) {
    run("chain.preset", {{"name", "start"}, {"count", 100'000}});
    run("chain.mode", {{"mode", "reach"}});
    Json most = Json::array();
    for (std::size_t i = part().chain.size() - 1; i-- > 10;) most.push_back(i);
    run("chain.set_length", {{"joints", most}, {"length", 0.5}});
    EXPECT_FLOAT_EQ(part().chain.length(50'000), 0.5f);
    EXPECT_FLOAT_EQ(part().chain.length(5), 1.0f);
    run("chain.limit", {{"joints", most}, {"kind", "free"}});
    EXPECT_TRUE(part().reach.limits.empty());
    run("chain.limit", {{"joints", most}, {"kind", "hinge"}});
    EXPECT_EQ(kind(99'998), ik::JointKind::Hinge);
    run("chain.limit", {{"joints", most}, {"kind", "free"}});
    EXPECT_TRUE(part().reach.limits.empty());
    run("chain.select", {{"joints", most}});
    run("chain.remove_selected");
    EXPECT_EQ(part().chain.size(), 11u) << "the first ten, and the tail";
}

TEST_F(ChainSelection, RemovedTogetherOrOneByOneTheSameLimitsStay) {
    for (const std::vector<std::size_t>& gone :
         {std::vector<std::size_t>{1, 3}, {0, 2, 5}, {6, 7}, {0, 7}, {2, 3, 4}}) {
        std::vector<Json> left;
        for (const bool together : {true, false}) {
            reach_with(7);
            for (int i = 0; i < 7; ++i)
                run("chain.limit",
                    {{"index", i}, {"kind", "hinge"}, {"axis", {0, 0, 1}}, {"max_deg", 10 + i}});
            run("chain.mode", {{"mode", "with_index"}, {"index", 4}});
            if (together) run("chain.select", {{"joints", gone}});
            if (together) run("chain.remove_selected");
            for (std::size_t i = gone.size(); !together && i-- > 0;)
                run("chain.remove", {{"index", gone[i]}});
            Json& found = left.emplace_back(Json{part().index, part().chain.size()});
            for (const ik::Limit& limit : part().reach.limits) found.push_back(limit.max);
            run("chain.mode", {{"mode", "reach"}});
        }
        EXPECT_EQ(left[0], left[1]) << gone.front();
    }
}

TEST_F(ChainSelection, OtherIndicesAreRefusedAndChangeNothing) {
    reach_with(4);
    run("chain.select", {{"joints", {1, 2}}});
    const Json joints_that_are_none = Json::array({{0, 9}, {-1}, {0.5}, {"tip"}, {nullptr}, {{0}}, {1e300}});
    for (const Json& joints : joints_that_are_none)
        for (const char* command : {"chain.select", "chain.limit", "chain.set_length"}) {
            Json arguments{{"joints", joints}};
            if (std::string(command) == "chain.set_length") arguments["length"] = 1;
            EXPECT_FALSE(refused(command, arguments).empty()) << command << joints;
        }
    expect_refused("chain.limit", {{"joints", {1, 4}}, {"kind", "hinge"}}, {"tail"});
    refused("chain.limit", {{"joints", Json::array()}, {"kind", "hinge"}});
    refused("chain.set_length", {{"joints", Json::array()}, {"length", 1}});
    expect_refused("chain.limit", {{"kind", "hinge"}}, {"either index or joints"});
    expect_refused("chain.select", {{"index", 1}, {"joints", {1}}}, {"either index or joints"});
    expect_refused("chain.select", {{"point", "pole"}}, {"no pole"});
    refused("chain.select", {{"point", "target"}, {"index", 1}});
}

TEST_F(ChainSelection, TheTargetOrThePoleInsteadOfJoints) {
    reach_with(3);
    run("chain.pole", {{"to", {0, 2, 0}}});
    EXPECT_FALSE(lab().gizmo(workspace));
    run("chain.select", {{"joints", {1, 2}}});
    EXPECT_EQ(lab().gizmo(workspace)->name, "segment.2") << "of several, at the active one";
    run("chain.select", {{"index", 1}});
    EXPECT_EQ(lab().gizmo(workspace)->name, "segment.1");
    run("chain.select", {{"point", "target"}});
    EXPECT_TRUE(selected().empty());
    EXPECT_EQ(state()["selected"], "target");
    EXPECT_EQ(lab().gizmo(workspace)->name, "target");
    run("chain.select", {{"point", "pole"}});
    EXPECT_EQ(lab().gizmo(workspace)->name, "pole");
    run("chain.mode", {{"mode", "forward"}});
    EXPECT_FALSE(lab().gizmo(workspace)) << "the pole is for mode reach";
    run("chain.mode", {{"mode", "reach"}});
    run("chain.pole", {{"off", true}});
    EXPECT_FALSE(lab().gizmo(workspace));
    EXPECT_TRUE(state()["selected"].is_null());
    run("chain.pole", {{"to", {0, 3, 0}}});
    run("chain.preset", {{"name", "snake"}});
    EXPECT_FALSE(part().reach.options.pole) << "a preset begins without one";
}

TEST_F(ChainSelection, AMomentWithFewerJointsKeepsTheRestOfTheSelection) {
    ChainPart then = part();
    then.chain = Chain();
    ChainPart now = part();
    now.selection.take({0, 5}, false);
    const auto shown = now.at_moment(std::make_shared<ChainPart>(then));
    EXPECT_TRUE(dynamic_cast<const ChainPart&>(*shown).selection.empty());
}

}  // namespace
}  // namespace tendril::app
