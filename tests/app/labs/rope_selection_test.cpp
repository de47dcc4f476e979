// Several particles at once: selecting, pinning, cutting.
#include "tests/app/labs/rope_support.hpp"

namespace tendril::app {
namespace {

class RopeSelectionTest : public RopeTest {
  protected:
    using Indices = std::vector<std::size_t>;
    Indices selected() const { return part().selection ? part().selection->particles.all() : Indices(); }
    bool pinned(const char* body, std::size_t index) const {
        return world().pinned(world().find(body)->first + index);
    }
    void select(const std::vector<PickId>& picks, bool add = false) {
        emit([&](Emit& to) { lab().select(workspace, picks, add, to); });
    }
};

TEST_F(RopeSelectionTest, ParticlesOfOneRopeAreAddedAndRemoved) {
    single_rope(8);
    run("rope.select", {{"rope", "rope"}, {"particle", 2}});
    run("rope.select", {{"rope", "rope"}, {"particle", 5}, {"add", true}});
    EXPECT_EQ(selected(), (Indices{2, 5}));
    EXPECT_EQ(state()["selected"]["particle"], 5);
    EXPECT_EQ(state()["selected"]["particles"], Json({2, 5}));
    run("rope.select", {{"rope", "rope"}, {"particle", 2}, {"add", true}});
    EXPECT_EQ(selected(), Indices{5});
    run("rope.select", {{"rope", "rope"}, {"particle", 5}, {"add", true}});
    EXPECT_FALSE(part().selection);
    // Selecting on another rope replaces the selection.
    run("rope.add", {{"name", "other"}, {"from", {0, 3, 0}}, {"to", {1, 3, 0}}, {"segments", 4}});
    run("rope.select", {{"rope", "rope"}, {"particles", {1, 3}}});
    run("rope.select", {{"rope", "other"}, {"particle", 4}, {"add", true}});
    EXPECT_EQ(part().selection->body, "other");
    EXPECT_EQ(selected(), Indices{4});
}

TEST_F(RopeSelectionTest, PinsAndUnpinsAllInOneStep) {
    single_rope(8);
    run("rope.pin", {{"rope", "rope"}, {"particles", {1, 4, 6}}});
    for (const std::size_t i : {1u, 4u, 6u}) EXPECT_TRUE(pinned("rope", i)) << i;
    EXPECT_FALSE(pinned("rope", 3));
    run("rope.unpin", {{"rope", "rope"}, {"particles", {4, 5, 6}}});
    EXPECT_TRUE(pinned("rope", 1));
    EXPECT_FALSE(pinned("rope", 4));
    run("undo");
    EXPECT_TRUE(pinned("rope", 4));
    run("undo");
    EXPECT_FALSE(pinned("rope", 1));
}

TEST_F(RopeSelectionTest, ABoxTakesTheRopeWithMostParticlesInIt) {
    single_rope(8);
    run("rope.add", {{"name", "other"}, {"from", {0, 3, 0}}, {"to", {1, 3, 0}}, {"segments", 4}});
    const auto first = static_cast<PickId>(world().find("other")->first);
    EXPECT_EQ(lab().selectable(workspace, 0).size(), world().size());
    select({first + 3, 2, first + 1, first, 7});
    EXPECT_EQ(part().selection->body, "other");
    EXPECT_EQ(selected(), (Indices{0, 1, 3}));
    // Adding keeps the selected body, even if another has more particles in the box.
    select({first + 2, 1, 2, 3, 4, 5}, true);
    EXPECT_EQ(selected(), (Indices{0, 1, 2, 3}));
    select({}, true);
    EXPECT_EQ(selected().size(), 4u);
    select({});
    EXPECT_FALSE(part().selection);
}

/// A box selects the particles that it shows, not those at the same pixels of the first pane.
TEST_F(RopeSelectionTest, ABoxInARacesOtherPaneSelectsThatPanesParticles) {
    single_rope(8);
    race_aside();
    const auto box = [&](std::size_t pane, float from, float to) {
        std::vector<PickId> picks;
        for (const Handle& each : lab().selectable(workspace, pane))
            if (each.frame.position.x > from && each.frame.position.x < to) picks.push_back(each.pick);
        select(picks);
    };
    box(1, 2.1f, 2.4f);
    EXPECT_EQ(selected(), (Indices{1, 2, 3}));
    box(2, 0.6f, 0.7f);
    EXPECT_EQ(selected(), (Indices{5}));
    box(1, 0.1f, 0.4f);
    EXPECT_FALSE(part().selection);
}

TEST_F(RopeSelectionTest, ACutKeepsTheSelectionOnTheActiveOnesPart) {
    single_rope(8);
    run("rope.select", {{"rope", "rope"}, {"particles", {1, 7, 3, 6}}});
    run("rope.cut", {{"rope", "rope"}, {"segment", 4}});
    EXPECT_NE(part().selection->body, "rope");
    EXPECT_EQ(selected(), (Indices{1, 2})) << "6 and 7, counted in the new rope";
    EXPECT_EQ(part().selection->particle(), 1u);
    run("rope.select", {{"rope", "rope"}, {"particles", {0, 4, 2}}});
    run("rope.cut", {{"rope", "rope"}, {"segment", 2}});
    EXPECT_EQ(part().selection->body, "rope");
    EXPECT_EQ(selected(), (Indices{0, 2}));
}

TEST_F(RopeSelectionTest, OtherIndicesAreRefusedAndChangeNothing) {
    single_rope(8);
    run("rope.select", {{"rope", "rope"}, {"particles", {1, 2}}});
    for (const char* command : {"rope.select", "rope.pin", "rope.unpin"})
        EXPECT_FALSE(refused(command, {{"rope", "rope"}, {"particles", {0, 9}}}).empty()) << command;
    refused("rope.pin", {{"rope", "rope"}, {"particles", {1, 2}}, {"at", {0, 0, 0}}});
    refused("rope.pin", {{"rope", "rope"}});
    refused("rope.select", {{"rope", "rope"}, {"particle", 1}, {"particles", {2}}});
}

}  // namespace
}  // namespace tendril::app
