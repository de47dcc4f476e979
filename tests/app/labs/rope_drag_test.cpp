// Quasi-static drags in the Rope lab use the lab's own runtime, and no bit depends on it.
#include <random>

#include "app/labs/rope/panel.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class RopeDrag : public RopeTest {};

TEST_F(RopeDrag, DiscardingTheRuntimeChangesNoBitOfAPausedDrag) {
    std::vector<rope::State> ends;
    for (const bool thrown_away : {false, true}) {
        run("rope.preset", {{"name", "drape"}});
        wait(40);
        run("time.pause");
        for (int i = 0; i < 12; ++i) {
            if (thrown_away) workspace.runtimes.clear();
            const float by = 0.05f * static_cast<float>(i);
            run("rope.hold", {{"rope", "short 2"}, {"particle", 3}, {"at", {1.2f + by, 1.5f, 0.3f}}}, 7);
            if (thrown_away) workspace.runtimes.clear();
            run("rope.collider.move", {{"name", "ball"}, {"to", {-0.65f + by, 1.0f, 0.0f}}}, 8);
        }
        ends.push_back(world().state());
        run("time.play");
        wait(3);
        ends.push_back(world().state());
    }
    EXPECT_TRUE(ends[0] == ends[2]);
    EXPECT_TRUE(ends[1] == ends[3]) << "and time goes on the same";
}

// Several particles dragged by one gizmo: pins move, free particles are held until released.

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

// The gizmo of the selected collider: arrows move it, rings rotate shapes that have a direction.

class RopeGizmo : public RopeTest {
  protected:
    RopeGizmo() {
        run("rope.clear");
        run("rope.collider.add",
            {{"name", "ball"}, {"kind", "sphere"}, {"centre", {1, 1, 0}}, {"radius", 0.3}});
        run("rope.collider.add",
            {{"name", "bar"}, {"kind", "capsule"}, {"a", {0, 1, 0}}, {"b", {0, 1, 2}}, {"radius", 0.1}});
        run("rope.collider.add",
            {{"name", "crate"}, {"kind", "box"}, {"centre", {2, 1, 0}}, {"half_extents", {0.2, 0.3, 0.4}}});
        run("rope.collider.add",
            {{"name", "wall"}, {"kind", "plane"}, {"point", {3, 0, 0}}, {"normal", {-1, 0, 0}}});
    }
    std::optional<Handle> gizmo() const { return lab().gizmo(workspace); }
    void select(const char* name) { run("rope.select", {{"collider", name}}); }
    void drag(const Handle::Frame& to) {
        emit([&](Emit& by) { lab().drag(workspace, gizmo()->pick, to, by); });
    }
    const rope::Shape& shape(const char* name) const { return world().find_collider(name)->shape; }
};

TEST_F(RopeGizmo, CollidersAndPinsHaveOneAndFreeParticlesNone) {
    EXPECT_FALSE(gizmo());
    for (const char* name : {"ball", "bar", "crate", "wall"}) {
        select(name);
        ASSERT_TRUE(gizmo()) << name;
        EXPECT_EQ(gizmo()->name, std::string("collider.") + name);
        EXPECT_EQ(has(gizmo()->drag, Drag::Rotation), std::string(name) != "ball");
    }
    run("rope.add", {{"name", "line"}, {"from", {0, 3, 0}}, {"to", {1, 3, 0}}, {"segments", 4}});
    run("rope.select", {{"rope", "line"}, {"particle", 1}});
    EXPECT_FALSE(gizmo());
    run("rope.pin", {{"rope", "line"}, {"particle", 1}});
    ASSERT_TRUE(gizmo());
    EXPECT_EQ(gizmo()->name, "line.1");
    EXPECT_FALSE(has(gizmo()->drag, Drag::Rotation)) << "a point has no rotation";
    run("time.pause");
    drag({glm::vec3(0.25f, 3.2f, 0.1f)});
    EXPECT_LT(glm::distance(gizmo()->frame.position, glm::vec3(0.25f, 3.2f, 0.1f)), 1e-4f);
    run("rope.unpin", {{"rope", "line"}, {"particle", 1}});
    EXPECT_FALSE(gizmo());
}

TEST_F(RopeGizmo, AParticleThatMovesWithAColliderHasNone) {
    run("rope.preset", {{"name", "hair"}});
    run("rope.select", {{"rope", state()["hair"][0]["name"]}, {"particle", 0}});
    EXPECT_FALSE(gizmo());
}

TEST_F(RopeGizmo, RotationsContinueFromWhereTheyAreWithoutDrift) {
    std::mt19937 random(3);
    std::normal_distribution<float> any;
    for (const char* name : {"bar", "crate", "wall"}) {
        select(name);
        const glm::vec3 middle = rope::centre(shape(name));
        for (int i = 0; i < 200; ++i) {
            Handle::Frame to = gizmo()->frame;
            const float x = any(random), y = any(random), z = any(random), w = any(random);
            to.rotation = glm::normalize(glm::quat(w, x, y, z));
            drag(to);
            const glm::vec3 axis = std::string(name) == "wall" ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            EXPECT_LT(glm::distance(gizmo()->frame.rotation * axis, to.rotation * axis), 1e-3f) << name;
        }
        EXPECT_LT(glm::distance(rope::centre(shape(name)), middle), 1e-3f) << name;
    }
    const auto& bar = std::get<rope::Capsule>(shape("bar"));
    EXPECT_NEAR(glm::distance(bar.a, bar.b), 2.0f, 1e-3f);
}

TEST_F(RopeGizmo, OppositeAndEqualDirectionsRotateToo) {
    for (const glm::vec3 direction :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)}) {
        run("rope.collider.set", {{"name", "bar"}, {"a", point(-direction)}, {"b", point(direction)}});
        select("bar");
        EXPECT_LT(glm::distance(gizmo()->frame.rotation * glm::vec3(1, 0, 0), direction), 1e-3f);
        run("rope.collider.set", {{"name", "wall"}, {"normal", point(direction)}});
        select("wall");
        EXPECT_LT(glm::distance(gizmo()->frame.rotation * glm::vec3(0, 1, 0), direction), 1e-3f);
    }
}

TEST_F(RopeGizmo, AnArrowMovesWithoutRotating) {
    select("crate");
    const glm::quat before = std::get<rope::Box>(shape("crate")).rotation;
    Handle::Frame to = gizmo()->frame;
    to.position.y += 0.5f;
    drag(to);
    wait(5);
    EXPECT_NEAR(rope::centre(shape("crate")).y, 1.5f, 1e-3f);
    EXPECT_EQ(std::get<rope::Box>(shape("crate")).rotation, before);
}

// Moving a rope, cloth or hair as a whole, and the placement of new ones.

class RopeMove : public RopeTest {
  protected:
    RopeMove() {
        run("rope.clear");
        add_cloth("sheet", {0, 2, 0}, {1, 0, 0}, {0, -0.8, 0.6}, 6, 6, "corners");
        wait(20);
    }
    const rope::Body& body(const char* name) const { return *world().find(name); }
    /// Drags the gizmo by this offset.
    void drag(glm::vec3 by, Gesture gesture) {
        Handle handle = *lab().gizmo(workspace);
        handle.frame.position += by;
        emit([&](Emit& to) { lab().drag(workspace, handle.pick, handle.frame, to); }, gesture);
    }
};

TEST_F(RopeMove, ADoubleClickSelectsAllOfItAndItsArrowsMoveIt) {
    EXPECT_FALSE(lab().gizmo(workspace));
    const PickId pick = particle_pick(body("sheet").first + 14);
    emit([&](Emit& to) { lab().click(workspace, pick, to); });
    emit([&](Emit& to) { lab().double_click(workspace, pick, to); });
    EXPECT_EQ(state()["selected"]["particles"].size(), 36u);
    const auto gizmo = lab().gizmo(workspace);
    ASSERT_TRUE(gizmo);
    EXPECT_EQ(gizmo->name, "sheet");
    EXPECT_LT(glm::distance(gizmo->frame.position, glm::vec3(0.5f, 2, 0)), 1e-6f) << "between its pins";
    EXPECT_TRUE(lab().together(workspace, Drag::Position).handles.empty());
    EXPECT_EQ(lab().together(workspace, Drag::Rotation).handles.size(), 36u);
    const rope::State was = world().state();
    for (int i = 0; i < 10; ++i) drag({0.1f, 0, 0}, 7);
    emit([&](Emit& to) { lab().drop(workspace, gizmo->pick, to); }, 7);
    EXPECT_LT(glm::distance(world().state().position[20], was.position[20] + glm::dvec3(1, 0, 0)), 1e-5);
    EXPECT_EQ(world().state().displacement, was.displacement);
    run("undo");
    EXPECT_EQ(world().state().position, was.position) << "one step";
}

TEST_F(RopeMove, AHintSaysWhatAClickWouldDo) {
    run("rope.add", {{"name", "bar"}, {"from", {0, 1, 0}}, {"to", {1, 1, 0}}, {"segments", 1}});
    for (const auto& [tool, on, words] : {std::tuple("cut", "bar", "bar, particle 0: click cuts here"),
                                          {"cut", "sheet", "sheet click end of the cut"},
                                          {"pin", "bar", "bar click pins or unpins"},
                                          {"tie", "bar", "bar click then the particle to tie it to"},
                                          {"move", "bar", "bar drag pulls it"},
                                          {"move", "sheet", "sheet pinned drag moves its pin"}}) {
        run("rope.tool", {{"name", tool}});
        EXPECT_TRUE(test::says(lab().hint(workspace, particle_pick(body(on).first)), words)) << tool;
    }
}

TEST_F(RopeMove, WithoutPinsItIsHeldUntilItIsDropped) {
    run("rope.add", {{"name", "line"}, {"from", {0, 1, 0}}, {"to", {1, 1, 0}}, {"segments", 4}});
    run("rope.select", {{"rope", "line"}});
    const PickId pick = lab().gizmo(workspace)->pick;
    drag({0, 0.5f, 0}, 7);
    wait(30);
    EXPECT_NEAR(world().position(body("line").first).y, 1.5f, 1e-5f);
    emit([&](Emit& to) { lab().drop(workspace, pick, to); }, 7);
    EXPECT_EQ(world().state().pins.size(), 2u);
    wait(10);
    EXPECT_LT(world().position(body("line").first).y, 1.49f);
}

TEST_F(RopeMove, TiesPullItBack) {
    run("rope.add", {{"name", "line"}, {"from", {0.5, 1, 0}}, {"to", {0.5, 0.5, 0}}, {"segments", 4}});
    run("rope.tie", {{"a", "sheet"}, {"a_particle", 33}, {"b", "line"}, {"b_particle", 0}});
    wait(120);
    const auto gap = [&] {
        const rope::Tie& tie = world().state().ties.at(0);
        return static_cast<double>(glm::distance(world().position(tie.a), world().position(tie.b)));
    };
    EXPECT_LT(gap(), 1e-5);
    run("rope.move", {{"rope", "line"}, {"by", {0.4, 0, 0}}});
    EXPECT_NEAR(gap(), 0.4, 1e-5);
    wait(3);
    EXPECT_NEAR(gap(), 0.3, 0.01) << "at 2 m/s";
}

TEST_F(RopeMove, IsInThePanel) {
    run("rope.select", {{"rope", "sheet"}});
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "particles 36 of 36 at x"));
    run("rope.select", {{"rope", "sheet"}, {"particle", 3}});
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "Select all"));
}

TEST_F(RopeMove, Refusals) {
    expect_refused("rope.move", {{"rope", "none"}, {"by", {1, 0, 0}}}, {"none"});
    run("rope.preset", {{"name", "hair"}});
    expect_refused("rope.move", {{"rope", "hair"}, {"by", {1, 0, 0}}}, {"attached", "collider"});
}

/// Every kind that the panel adds, in every preset: it must neither overlap other things nor hide them.
TEST_F(RopeMove, ThereIsSpaceForAddedThings) {
    for (const char* preset : {"drape", "bridge", "curtain", "line"}) {
        run("rope.preset", {{"name", preset}});
        wait(30);
        const Space cloth{{-0.5f, -0.2f, -0.3f}, {0.5f, 0.8f, 0.3f}};
        const glm::vec3 at = free_place(workspace, cloth);
        const Space here = cloth.moved(at);
        for (std::size_t i = 0; i < world().size(); ++i) {
            const glm::vec3 particle = world().position(i);
            const bool inside =
                glm::all(glm::lessThan(here.low, particle)) && glm::all(glm::lessThan(particle, here.high));
            ASSERT_FALSE(inside) << preset << ", particle " << i;
        }
        EXPECT_LE(at.z, workspace.camera.target.z + 1e-4f) << preset;
        EXPECT_GT(glm::distance(at, workspace.camera.target), 0.3f) << preset;
    }
}

}  // namespace
}  // namespace tendril::app
