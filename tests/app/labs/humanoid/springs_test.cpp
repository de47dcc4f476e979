// Springs on a character's nodes: they trail its motion, and are values of the document like everything else.
#include "app/io/character/read.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/app/io/posed.hpp"

namespace tendril::app {
namespace {

/// A dancer with two antennae of five joints and a tail of six.
class HumanoidSprings : public HumanoidTest {
  protected:
    HumanoidSprings() {
        run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/antennae.bvh")}});
        run("humanoid.clip", {{"name", ""}});
    }

    void put_on_springs() {
        for (const char* node : {"antenna_l_1", "antenna_r_1", "tail_1"})
            run("humanoid.spring", {{"node", node}});
    }
    void load_hair() { run("humanoid.load", {{"path", write("hair.vrm", vrm_with_hair)}}); }
    void dance() { run("humanoid.clip", {{"index", 0}, {"play", true}}); }
    /// The distance of a node from its position in the clip, metres.
    double aside(const std::string& name) const {
        const ShownPose& shown = shown_pose(workspace);
        const std::size_t node = *part().skeleton().find(name);
        if (shown.before.empty()) return 0.0;
        return glm::distance(shown.placed[node].position, shown.before[node].position);
    }
    double farthest(const std::string& name, int ticks) {
        double far = 0.0;
        for (int i = 0; i < ticks; ++i) {
            tick();
            far = std::max(far, aside(name));
        }
        return far;
    }
};

TEST_F(HumanoidSprings, TrailTheClipsMotion) {
    put_on_springs();
    const Json springs = state().at("springs");
    ASSERT_EQ(springs.size(), 3u);
    EXPECT_EQ(springs[0].at("node"), "antenna_l_1");
    EXPECT_EQ(springs[2].at("bones").size(), 7u) << "six joints and the end";
    EXPECT_EQ(springs[2].at("strength"), 2.0);
    EXPECT_EQ(aside("antenna_l_5"), 0.0);
    dance();
    EXPECT_LT(farthest("LeftHand", 120), 1e-12) << "the body is the clip's";
    EXPECT_GT(farthest("antenna_l_5", 120), 0.02);
    EXPECT_GT(aside("tail_6"), 0.0);
    EXPECT_GT(farthest("antenna_l_5", 60), 1.5 * farthest("antenna_l_2", 60));
}

TEST_F(HumanoidSprings, ComeToRestAndVanishWhenSwitchedOff) {
    put_on_springs();
    run("humanoid.clip", {{"index", 0}, {"play", true}, {"loop", false}});
    int ticks = 0;
    for (; ticks < 3000 && lab().moving(workspace); ++ticks) tick();
    EXPECT_GT(ticks, 130) << "the clip takes two seconds";
    EXPECT_LT(ticks, 1000) << "it never comes to rest";
    EXPECT_LT(aside("antenna_l_5"), 1e-3);
    run("humanoid.clip", {{"time", 0.4}, {"play", true}});
    tick(10);
    for (const char* node : {"antenna_l_1", "antenna_r_1", "tail_1"})
        run("humanoid.spring", {{"node", node}, {"on", false}});
    run("humanoid.spring", {{"node", "Head"}, {"on", false}});
    EXPECT_TRUE(state().at("springs").empty());
    EXPECT_TRUE(shown_pose(workspace).before.empty()) << "the clip's pose, to the bit";
}

TEST_F(HumanoidSprings, SwingWithADragAndAreCarriedByAJump) {
    put_on_springs();
    run("time.play");
    tick(30);
    run("humanoid.target", {{"effector", "hips"}, {"to", {0.3, 0.95, 0.0}}});
    const double head = bone("Head").x;
    EXPECT_GT(head, 0.15);
    EXPECT_GT(farthest("tail_6", 60), 0.03) << "a drag swings it";
    tick(600);
    EXPECT_LT(aside("tail_6"), 0.4);
    run("humanoid.target", {{"effector", "hips"}, {"weight", 0}});
    for (int i = 0; i < 1000 && lab().moving(workspace); ++i) tick();
    // A jump of the clip, and a drag while paused.
    run("time.pause");
    const double still = aside("tail_6");
    run("humanoid.target", {{"effector", "hips"}, {"to", {0.3, 0.95, 0.0}}});
    const ShownPose& there = shown_pose(workspace);
    for (const humanoid::SpringReport& each : there.springs) EXPECT_LT(each.angle, 0.02);
    run("time.play");
    for (int i = 0; i < 30; ++i) {
        tick();
        for (const humanoid::SpringReport& each : shown_pose(workspace).springs) ASSERT_LT(each.angle, 0.02);
    }
    EXPECT_LT(still, 0.02);
}

TEST_F(HumanoidSprings, RefuseInvalidNodesAndValues) {
    run("humanoid.spring", {{"node", "antenna_l_2"}});
    expect_refused("humanoid.spring", {{"node", "wing"}}, {"no node \"wing\""});
    expect_refused("humanoid.spring", {{"node", "Head"}}, {"Head is the Head of the body"});
    expect_refused("humanoid.spring", {{"node", "Hips"}}, {"Hips"});
    expect_refused("humanoid.spring", {{"node", "antenna_l_3"}}, {"antenna_l_3", "antenna_l_2"});
    expect_refused("humanoid.spring", {{"node", "antenna_l_1"}}, {"antenna_l_2", "is below antenna_l_1"});
    EXPECT_EQ(part().springs.size(), 1u);
    // A spring node that becomes a bone of the body no longer swings.
    dance();
    tick(20);
    EXPECT_GT(aside("antenna_l_5"), 0.0);
    run("humanoid.map", {{"bone", "LeftToes"}, {"node", "antenna_l_3"}});
    tick(5);
    EXPECT_EQ(aside("antenna_l_5"), 0.0);
    EXPECT_TRUE(state().at("springs")[0].at("bones").empty());
    const Workspace other = reopened();
    EXPECT_EQ(humanoid_part(other).springs, part().springs) << "what can be saved can be opened";
    expect_refused("humanoid.spring", {{"node", "HeadTop"}}, {"HeadTop"});
}

/// Commands that do not move the pose neither disturb the springs nor leave an undo step.
TEST_F(HumanoidSprings, KeepSwingingUnderCommands) {
    put_on_springs();
    dance();
    tick(50);
    const IkState before = part().ik_state;
    run("humanoid.spring", {{"node", "Head"}, {"on", false}});
    EXPECT_TRUE(part().ik_state == before);
    run("undo");
    EXPECT_EQ(part().playback.clip, std::nullopt) << "the clip was the last change";
    run("redo");
    Workspace other = reopened();
    double angle = 0.0;
    for (int i = 0; i < 40; ++i) {
        run("humanoid.spring", {{"node", "tail_1"}, {"weight", i % 2 == 0 ? 0.9 : 1.0}});
        tick();
        lab().step(other);
        ASSERT_TRUE(part().ik_state == humanoid_part(other).ik_state) << i;
        angle = std::max(angle, shown_pose(workspace).springs[2].angle);
    }
    EXPECT_GT(angle, 0.02);
}

TEST_F(HumanoidSprings, AreNotDisturbedByAnotherUnit) {
    put_on_springs();
    dance();
    tick(50);
    run("humanoid.scale", {{"metres", 0.0005}});
    EXPECT_EQ(part().springs.size(), 3u);
    for (int i = 0; i < 5; ++i) {
        tick();
        for (const humanoid::SpringReport& each : shown_pose(workspace).springs) EXPECT_LT(each.angle, 0.3);
    }
}

TEST_F(HumanoidSprings, StayFiniteAfterADamagedFile) {
    put_on_springs();
    dance();
    tick(9);
    const Json scene = save_scene(workspace);
    for (const char* thrown : {"velocity", "position", ""}) {
        Json changed = scene;
        Json& masses = changed["labs"]["humanoid"]["springs"][1]["masses"];
        if (*thrown == '\0')
            masses.erase(0);
        else
            masses[1][thrown] = {1e9, -1e9, 0};
        Workspace other = make_blank_workspace(labs);
        load_scene(other, changed);
        for (int i = 0; i < 20; ++i) lab().step(other);
        for (const humanoid::Placement& each : shown_pose(other).placed)
            EXPECT_TRUE(std::isfinite(glm::dot(each.position, each.position)));
    }
}

TEST_F(HumanoidSprings, AreBakedIntoAClip) {
    put_on_springs();
    run("humanoid.clip", {{"index", 0}});
    const std::string file = path("dance.bvh");
    double swung = 0.0;
    for (const int fps : {60, 30}) {
        run("humanoid.export", {{"path", file}, {"fps", fps}});
        const Character read = read_character(file);
        HumanoidPart shown = part();
        shown.playback = {.clip = 0, .loop = false};
        IkState state;
        const std::size_t tip = *part().skeleton().find("antenna_r_5");
        for (int frame = 0; frame < 100; ++frame) {  // at a lower rate they swing alike
            shown.playback.time = frame / 60.0;
            const ShownPose seen =
                solve_pose(shown, humanoid_runtime(workspace).solvers, frame == 0 ? 0.0 : 1.0 / 60.0, state);
            if (frame % (60 / fps) != 0) continue;
            const glm::dvec3 there = test_posed::at(read, "antenna_r_5", 0, shown.playback.time);
            EXPECT_LT(glm::distance(there, seen.placed[tip].position), 1e-4) << frame;
            if (!seen.before.empty())
                swung = std::max(swung, glm::distance(seen.before[tip].position, seen.placed[tip].position));
        }
    }
    EXPECT_GT(swung, 0.02);
}

TEST_F(HumanoidSprings, OfAVrmArePresentOnceItIsLoaded) {
    load_hair();
    ASSERT_EQ(part().springs.size(), 1u);
    EXPECT_EQ(part().springs[0].node, "hair");
    EXPECT_NEAR(part().springs[0].options.strength, part().loaded->character.springs[0].strength, 0.0);
    EXPECT_EQ(aside("tip"), 0.0);
    run("humanoid.spring", {{"node", "hair"}, {"strength", 5.0}});
    EXPECT_EQ(humanoid_part(reopened()).springs[0].options.strength, 5.0) << "the scene's, and only once";
    EXPECT_EQ(humanoid_part(reopened()).springs.size(), 1u);
    Json older = save_scene(workspace);
    older["labs"]["humanoid"]["springs"][0].erase("hit_radius");
    Workspace other = make_blank_workspace(labs);
    load_scene(other, older);
    EXPECT_EQ(humanoid_part(other).springs, part().springs) << "the radius is the file's";
    run("humanoid.scale", {{"metres", 0.5}});
    EXPECT_EQ(part().springs[0].options.hit_radius, 0.01);
    for (int i = 0; i < 3; ++i) run("undo");
    EXPECT_TRUE(part().springs.empty());
}

/// Hair is held at the surface of the sphere and comes to rest there.
TEST_F(HumanoidSprings, AreKeptOutOfTheCollidersOfTheirFile) {
    load_hair();
    EXPECT_EQ(state().at("springs")[0].at("colliders"), 1);
    run("humanoid.spring", {{"node", "hair"}, {"strength", 2.0}});
    run("time.play");
    const auto apart = [&] {
        return glm::distance(shown_pose(workspace).placed[*part().skeleton().find("tip")].position,
                             glm::dvec3(0.0, 0.8, 0.0));
    };
    int ticks = 0;
    for (; ticks < 1000 && lab().moving(workspace); ++ticks) {
        tick();
        ASSERT_GE(apart(), 0.12 - 1e-6);
    }
    EXPECT_LT(ticks, 1000) << "it never comes to rest";
    EXPECT_NEAR(apart(), 0.12, 1e-6);
    EXPECT_GT(aside("tip"), 0.06);
    EXPECT_EQ(lab().state(reopened()), state());
    EXPECT_NE(lab().code(workspace).find("spring_0_colliders"), std::string::npos);
    // Its outline is drawn while the spring is selected.
    const std::size_t before = drawn().strokes.size();
    run("humanoid.select", {{"node", "hair"}});
    EXPECT_GT(drawn().strokes.size(), before + 20);
    run("humanoid.spring", {{"node", "hair"}, {"hit_radius", 0.05}});
    tick(1000);
    EXPECT_NEAR(apart(), 0.15, 1e-6);
}

}  // namespace
}  // namespace tendril::app
