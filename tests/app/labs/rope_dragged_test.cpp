// Several particles dragged by one gizmo: pins move, free particles are held until released.
#include <random>

#include "app/document/json_complete.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeDragged : public RopeTest {
  protected:
    glm::vec3 at(std::size_t index) const { return world().position(world().find("rope")->first + index); }
    bool pinned(std::size_t index) const { return world().pinned(world().find("rope")->first + index); }
    void select(const Json& particles) { run("rope.select", {{"rope", "rope"}, {"particles", particles}}); }
    Together together() const { return lab().together(workspace, Drag::Position); }
    void drag(const std::vector<Handle>& handles, Gesture gesture = 7) {
        emit([&](Emit& to) { lab().drag_together(workspace, handles, to); }, gesture);
    }
    void drop(Gesture gesture = 7) {
        emit([&](Emit& to) { lab().drop(workspace, no_pick, to); }, gesture);
    }
    std::vector<Handle> moved(glm::vec3 by) const {
        std::vector<Handle> handles = together().handles;
        for (Handle& each : handles) each.frame.position += by;
        return handles;
    }
};

TEST_F(RopeDragged, PinsAndFreeParticlesMoveTogetherInOneStep) {
    for (const char* time : {"time.pause", "time.play"}) {
        single_rope(8);
        run("rope.pin", {{"rope", "rope"}, {"particles", {0, 8}}});
        run(time);
        wait(2);
        select({0, 3, 4, 8});
        EXPECT_EQ(lab().gizmo(workspace)->name, "rope.8") << "on the one selected last";
        std::vector<glm::vec3> before;
        for (const std::size_t i : {0u, 3u, 4u, 8u}) before.push_back(at(i));
        const std::size_t history = workspace.history.size();
        const std::vector<Handle> goals = moved({0.02f, 0.05f, 0.03f});
        drag(goals);
        if (workspace.clock.playing) wait(1);
        std::size_t which = 0;
        for (const std::size_t i : {0u, 3u, 4u, 8u}) {
            EXPECT_LT(glm::distance(at(i), before[which++] + glm::vec3(0.02f, 0.05f, 0.03f)), 1e-4f)
                << time << i;
            EXPECT_TRUE(pinned(i)) << i;
        }
        EXPECT_EQ(state()["held"]["particles"], Json({3, 4}));
        drag(goals);
        EXPECT_EQ(state()["held"]["particles"], Json({3, 4})) << "those that are held are no pins";
        drop();
        EXPECT_TRUE(pinned(0) && pinned(8));
        EXPECT_FALSE(pinned(3) || pinned(4));
        EXPECT_EQ(workspace.history.size(), history + 1);
        run("undo");
        EXPECT_LT(glm::distance(at(0), before[0]), 1e-4f);
        EXPECT_FALSE(pinned(3) || pinned(4));
        EXPECT_TRUE(state()["held"].is_null());
    }
}

TEST_F(RopeDragged, ParticlesOnAColliderStayAndAreReported) {
    run("rope.preset", {{"name", "hair"}});
    const std::string hair = state()["hair"][0]["name"];
    run("rope.select", {{"rope", hair}, {"particles", {0, 1, 2, 3}}});
    EXPECT_EQ(together().handles.size(), 2u) << "a hair is held by two particles at its root";
    EXPECT_TRUE(test::says(together().staying, "2 collider"));
    run("rope.select", {{"rope", hair}, {"particles", {3, 2, 1, 0}}});
    EXPECT_EQ(lab().gizmo(workspace)->name, hair + ".3") << "the last one that moves";
}

TEST_F(RopeDragged, AnyParticlesFollowAnyWayAndNothingElseIsHeldAfterwards) {
    std::mt19937 random(11);
    run("time.pause");
    for (int round = 0; round < 20; ++round) {
        single_rope(12);
        std::vector<std::size_t> pins, chosen;
        for (std::size_t i = 0; i <= 12; ++i) {
            if (random() % 3 == 0) pins.push_back(i);
            if (random() % 2 == 0) chosen.push_back(i);
        }
        if (chosen.size() < 2) chosen = {1, 2};
        if (!pins.empty()) run("rope.pin", {{"rope", "rope"}, {"particles", pins}});
        std::shuffle(chosen.begin(), chosen.end(), random);
        select(chosen);
        for (int step = 0; step < 3; ++step) {
            std::vector<Handle> goals = together().handles;
            for (Handle& each : goals) each.frame.position.y += 0.01f * static_cast<float>(step + 1);
            drag(goals);
            for (const Handle& each : goals)
                ASSERT_LT(
                    glm::distance(world().position(static_cast<std::size_t>(each.pick)), each.frame.position),
                    1e-4f);
        }
        drop();
        EXPECT_EQ(world().state().pins.size(), pins.size());
        EXPECT_TRUE(state()["held"].is_null());
    }
}

/// With any solver: particles between a pin and a free one move along with them.
TEST_F(RopeDragged, WhilePausedParticlesBetweenMoveAlong) {
    for (const char* solver : {"direct", "xpbd", "relaxation"}) {
        single_rope(10);
        run("time.pause");
        run("rope.settings", {{"solver", solver}});
        run("rope.pin", {{"rope", "rope"}, {"particle", 0}});
        select({0, 10});
        std::vector<glm::vec3> before;
        for (std::size_t i = 0; i <= 10; ++i) before.push_back(at(i));
        drag(moved({0.0f, 0.3f, 0.0f}));
        for (std::size_t i = 0; i < 10; ++i)
            EXPECT_NEAR(glm::distance(at(i), at(i + 1)), glm::distance(before[i], before[i + 1]), 1e-3f)
                << solver << i;
    }
}

TEST_F(RopeDragged, ACutThroughAHeldParticleReleasesIt) {
    single_rope(8);
    const auto hold = [&](const Json& particles) {
        run("rope.hold",
            {{"rope", "rope"}, {"particles", particles}, {"points", {{0.2, 2.1, 0}, {0.8, 2.1, 0}}}});
    };
    hold({2, 6});
    run("rope.cut", {{"rope", "rope"}, {"segment", 4}});
    EXPECT_TRUE(state()["held"].is_null());
    EXPECT_TRUE(world().state().pins.empty());
    run("undo");
    run("undo");
    hold({6, 7});
    run("rope.cut", {{"rope", "rope"}, {"segment", 4}});
    EXPECT_EQ(state()["held"]["rope"], "rope 2");
    EXPECT_EQ(state()["held"]["particles"], Json({1, 2}));
}

TEST_F(RopeDragged, IncompatibleArgumentsAreRefused) {
    single_rope(8);
    run("rope.pin", {{"rope", "rope"}, {"particle", 0}});
    const Json at{0, 0, 0};
    const auto refuses = [&](const char* command, Json arguments, const char* what) {
        arguments["rope"] = "rope";
        const std::string why = refused(command, arguments);
        EXPECT_NE(why.find(what), std::string::npos) << why;
    };
    refuses("rope.hold", {{"particle", 0}, {"at", at}}, "particle 0 of \"rope\" is pinned");
    refuses("rope.hold", {{"particles", {2, 3}}, {"points", Json::array({at})}},
            "2 points, one for each of particles");
    refuses("rope.hold", {{"particles", {2, 3}}, {"at", at}}, "particles and points");
    refuses("rope.hold", {{"particle", 2}, {"points", Json::array({at})}}, "particles and points");
    refuses("rope.hold", {{"particle", 2}}, "particle and at");
    refuses("rope.pin", {{"particles", {3, 4, 3}}, {"points", {at, at, at}}}, "particles: 3 is listed twice");
    refuses("rope.pin", {{"particles", {3, 99}}, {"points", {at, at}}}, "99");
    refuses("rope.pin", {{"particle", 3}, {"points", Json::array({at})}}, "points needs particles");
    refuses("rope.pin", {{"particles", {3, 4}}, {"points", {at, {1, 2}}}}, "points.1");
}

}  // namespace
}  // namespace tendril::app
