// A character in the Rope lab: its capsules collide, and follow its clip.
#include "app/labs/rope/rope_time.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

class RopeWalker : public RopeTest {
  protected:
    RopeWalker() { run("rope.clear"); }
    /// The maximum distance of a collider from its position in the clip at this time, metres.
    float off() const {
        float most = 0.0f;
        for (const WalkerCapsule& each : walker_capsules(part().walker, part().time)) {
            const auto shown = std::get<rope::Capsule>(world().shape(*world().find_collider(each.name)));
            most =
                std::max({most, glm::distance(shown.a, each.shape.a), glm::distance(shown.b, each.shape.b)});
        }
        return most;
    }
};

TEST_F(RopeWalker, ItsCapsulesFollowItsClip) {
    for (const double factor : {1.0, 0.37}) {
        run("rope.character");
        run("time.speed", {{"factor", factor}});
        EXPECT_EQ(part().walker.clip, "walk");
        const glm::vec3 before = rope::centre(world().find_collider("LeftLowerLeg")->shape);
        for (int i = 0; i < 200; ++i) {  // over more than one round
            wait(1);
            const double ticks = part().time / tick_seconds;
            if (std::abs(ticks - std::round(ticks)) > 1e-6) continue;
            ASSERT_LT(off(), 1e-4f) << factor << ", tick " << i;
        }
        EXPECT_GT(glm::distance(before, rope::centre(world().find_collider("LeftLowerLeg")->shape)), 0.01f);
        EXPECT_FALSE(at_rest(part()));
    }
}

TEST_F(RopeWalker, WalksThroughACurtain) {
    run("rope.cloth.add",
        {{"corner", {-0.6, 2, 0.5}}, {"along", {1.2, 0, 0}}, {"down", {0, -1.6, 0}}, {"pins", "row"}});
    run("rope.character");
    float pushed = 0.0f;
    for (int i = 0; i < 60; ++i) {
        wait(1);
        for (std::size_t p = 0; p < world().size(); ++p) pushed = std::max(pushed, world().position(p).z);
    }
    EXPECT_GT(pushed, 0.8f) << "the body carries it along";
}

TEST_F(RopeWalker, IsSavedUndoneAndRemoved) {
    run("rope.character", {{"clip", "punch"}, {"at", {1, 0, 2}}});
    const std::size_t capsules = world().state().colliders.size();
    EXPECT_GT(capsules, 10u);
    EXPECT_EQ(state().at("character").at("clip"), "punch");
    const Workspace opened = reopened();
    EXPECT_EQ(save_scene(opened).at("labs"), save_scene(workspace).at("labs"));
    EXPECT_EQ(rope_part(opened).walker.at, glm::vec3(1, 0, 2));
    run("rope.character.remove");
    EXPECT_TRUE(world().state().colliders.empty());
    run("undo");
    EXPECT_EQ(world().state().colliders.size(), capsules);
    EXPECT_TRUE(part().walker.figure);
    run("rope.clear");
    EXPECT_FALSE(part().walker.figure);
    expect_refused("rope.character.remove", Json::object(), {"no character"});
}

TEST_F(RopeWalker, ComesFromAFile) {
    run("rope.character", {{"path", test::source_path("tests/app/golden/faulty_walk.bvh")}});
    EXPECT_GT(world().state().colliders.size(), 5u);
    wait(10);
    EXPECT_LT(off(), 1e-4f);
    run("rope.preset", {{"name", "drape"}});
    EXPECT_FALSE(part().walker.figure);
}

TEST_F(RopeWalker, RefusesWhatItCannotRead) {
    expect_refused("rope.character", {{"path", "nowhere.bvh"}}, {"nowhere.bvh"});
    expect_refused("rope.character", {{"clip", "dance"}}, {"dance"});
    run("rope.collider.add", {{"name", "Head"}, {"kind", "sphere"}, {"centre", {0, 0, 0}}, {"radius", 1}});
    expect_refused("rope.character", Json::object(), {"Head"});
}

}  // namespace
}  // namespace tendril::app
