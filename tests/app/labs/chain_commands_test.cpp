// The Chain lab's commands: effects, refusals, and that a refusal changes nothing.
#include <cmath>
#include <glm/geometric.hpp>

#include "app/labs/chain/presets.hpp"
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

}  // namespace
}  // namespace tendril::app
