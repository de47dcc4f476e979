// Springs on a character's nodes: they trail its motion, and are values of the document like everything else.
#include "app/io/character/character.hpp"
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

// A tail or the spine of the character along a curve: the bending bones, the followers, and kept targets.

/// A dancer with two antennae and a tail of six joints.
class HumanoidCurves : public HumanoidTest {
  protected:
    HumanoidCurves() {
        run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/antennae.bvh")}});
        run("humanoid.clip", {{"name", ""}});
    }

    Json curve(std::size_t which = 0) const { return state().at("curves").at(which); }
    std::vector<glm::vec3> points(std::size_t which = 0) const { return part().curves[which].shape.points; }
    void move_point(std::size_t at, glm::vec3 by) {
        std::vector<glm::vec3> all = points();
        all[at] += by;
        run("humanoid.curve", {{"first", part().curves[0].first}, {"points", points_json(all)}});
    }
    std::optional<Handle> handle(const std::string& name) const {
        for (const Handle& each : lab().handles(workspace))
            if (each.name == name) return each;
        return std::nullopt;
    }
    /// The maximum length error of the first curve's bones relative to the clip, metres.
    double length_error() const {
        const ShownPose& shown = shown_pose(workspace);
        const auto chain = humanoid_runtime(workspace).solvers.curves(part())[0]->nodes();
        double worst = 0.0;
        for (std::size_t i = 1; i < chain.size() && !shown.before.empty(); ++i) {
            const auto length = [&](const std::vector<humanoid::Placement>& at) {
                return glm::distance(at[chain[i]].position, at[chain[i - 1]].position);
            };
            worst = std::max(worst, std::abs(length(shown.placed) - length(shown.before)));
        }
        return worst;
    }
};

TEST_F(HumanoidCurves, BeginThroughThePoseAndBendIt) {
    const glm::dvec3 tip = node("tail_6"), hand = bone("LeftHand");
    run("humanoid.curve", {{"first", "tail_1"}});
    EXPECT_EQ(part().curves[0].first, "tail_1");
    EXPECT_EQ(points().size(), new_curve_points);
    EXPECT_LT(glm::distance(node("tail_6"), tip), 0.01) << "the tail is where it was";
    EXPECT_LT(curve().at("past_end").get<double>(), 0.01) << "the curve cuts corners";
    EXPECT_EQ(curve().at("jumped"), nullptr);
    move_point(new_curve_points - 1, {0.4f, 0.1f, 0.0f});
    EXPECT_GT(glm::distance(node("tail_6"), tip), 0.05);
    EXPECT_EQ(bone("LeftHand"), hand) << "nothing else moves";
    EXPECT_LT(length_error(), 1e-6);
    // The handle is at the point: dragged there, the curve stays.
    const auto last = handle("curve.tail_1.3");
    ASSERT_TRUE(last);
    const std::vector<glm::vec3> before = points();
    emit([&](Emit& to) { lab().drag(workspace, last->pick, last->frame, to); });
    EXPECT_LT(glm::distance(points().back(), before.back()), 1e-5f);
    // Weight 0 gives the clip's pose to the bit, and fit puts the tip on the last point.
    run("humanoid.curve", {{"first", "tail_1"}, {"weight", 0}});
    EXPECT_TRUE(shown_pose(workspace).before.empty());
    run("humanoid.curve", {{"first", "tail_1"}, {"weight", 1}, {"fit", true}, {"max_factor", 10}});
    const std::string end = part().curves[0].last;
    EXPECT_LT(glm::distance(node(end), glm::dvec3(handle("curve.tail_1.3")->frame.position)), 1e-4);
    EXPECT_NE(curve().at("factor"), 1.0);
}

TEST_F(HumanoidCurves, FollowTheHipsThroughClipAndIk) {
    run("humanoid.curve", {{"first", "tail_1"}});
    move_point(3, {0.5f, 0.2f, 0.1f});
    const auto seen = [&] {  // the tip in the hips' frame
        const ShownPose& shown = shown_pose(workspace);
        const auto chain = humanoid_runtime(workspace).solvers.curves(part())[0].get();
        const humanoid::Placement at = chain->space(shown.placed);
        const glm::dvec3 tip = shown.placed[*part().skeleton().find("tail_6")].position;
        return glm::conjugate(at.rotation()) * (tip - at.position);
    };
    const glm::dvec3 at_rest = seen();
    run("humanoid.clip", {{"index", 0}, {"play", true}});
    for (int i = 0; i < 40; ++i) {
        tick();
        ASSERT_LT(glm::distance(seen(), at_rest), 1e-4) << i;
    }
    run("humanoid.target", {{"effector", "hips"}, {"to", {0.3, 0.8, 0.1}}});
    EXPECT_LT(glm::distance(seen(), at_rest), 1e-4);
}

/// Hands reach from a bent spine, to which arms and head are attached.
TEST_F(HumanoidCurves, LetHandsReachFromABentSpine) {
    run("humanoid.load");
    const glm::dvec3 head = bone("Head"), foot = bone("LeftFoot");
    run("humanoid.curve", {{"first", "Spine"}, {"last", "Neck"}});
    EXPECT_LT(glm::distance(bone("Head"), head), 0.02);
    move_point(points().size() - 1, {0.25f, -0.05f, 0.0f});
    EXPECT_GT(bone("Head").x - head.x, 0.1);
    EXPECT_EQ(bone("LeftFoot"), foot);
    const glm::dvec3 to = bone("LeftHand") + glm::dvec3(-0.1, 0.2, 0.2);
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {to.x, to.y, to.z}}});
    EXPECT_LT(glm::distance(bone("LeftHand"), to), 1e-3);
    move_point(points().size() - 1, {-0.05f, 0.0f, 0.1f});
    EXPECT_LT(glm::distance(bone("LeftHand"), to), 1e-3) << "it holds its target while the spine bends";
}

TEST_F(HumanoidCurves, RefuseChainsThatTheyCannotBend) {
    run("humanoid.curve", {{"first", "tail_2"}});
    expect_refused("humanoid.curve", {{"first", "wing"}}, {"no node \"wing\""});
    expect_refused("humanoid.curve", {{"first", "tail_1"}}, {"tail_2", "already bends along the curve"});
    expect_refused("humanoid.curve", {{"first", "antenna_l_1"}, {"last", "Hips"}}, {"below first", "Hips"});
    expect_refused("humanoid.curve", {{"first", "tail_2"}, {"points", Json::array()}}, {"control point"});
    expect_refused("humanoid.curve", {{"first", "tail_2"}, {"points", {{0, 1}}}}, {"points.0"});
    expect_refused("humanoid.curve", {{"first", "tail_2"}, {"points", {{0, 1, 1e20}}}}, {"points.0"});
    const Json many(max_bone_curve_points + 1, Json{0.0, 0.0, 0.0});
    expect_refused("humanoid.curve", {{"first", "tail_2"}, {"points", many}}, {"64"});
    EXPECT_EQ(part().curves.size(), 1u);
    // All points at one position, and far away.
    const glm::vec3 start = handle("curve.tail_2.0")->frame.position;
    for (const glm::vec3 at : {start, glm::vec3(0.0f), glm::vec3(1e6f)}) {
        run("humanoid.curve", {{"first", "tail_2"}, {"points", points_json(std::vector<glm::vec3>(3, at))}});
        for (const humanoid::Placement& each : shown_pose(workspace).placed)
            ASSERT_TRUE(std::isfinite(glm::dot(each.position, each.position)));
        EXPECT_LT(length_error(), 1e-6);
    }
    run("humanoid.curve", {{"first", "tail_2"}, {"points", {{0, 0, 0.001}}}});
    EXPECT_GT(curve().at("bones_past_end"), 0);
}

/// A hairpin whose bend comes nearer than the first bone is long: its joint goes on to the way back.
TEST_F(HumanoidCurves, AJumpingJointIsReported) {
    run("humanoid.curve", {{"first", "tail_1"}});
    const glm::vec3 start(glm::conjugate(shown_pose(workspace).placed[0].rotation()) *
                          (node("tail_1") - bone("Hips")));
    const float length = static_cast<float>(glm::distance(node("tail_1"), node("tail_2")));
    int jumps = 0, marks = 0;
    for (int i = 0; i < 40; ++i) {
        const glm::vec3 bend = start + glm::vec3(0.0f, 0.0f, -0.05f * static_cast<float>(40 - i) * length);
        const std::vector<glm::vec3> hairpin{bend, start + glm::vec3(0.0f, 0.02f, 2.0f)};
        const auto told =
            incidents_of("humanoid.curve", {{"first", "tail_1"}, {"points", points_json(hairpin)}});
        if (!part().curves[0].jumped) continue;
        ++jumps;
        for (const Incident& each : told) {
            if (each.kind != Incident::Kind::Jump) continue;
            ++marks;
            EXPECT_EQ(each.name, curve().at("jumped").get<std::string>()) << "the joint itself";
        }
        EXPECT_TRUE(curve().at("jumped").is_string());
        EXPECT_EQ(humanoid_part(reopened()).curves, part().curves);
    }
    EXPECT_GT(jumps, 0);
    EXPECT_EQ(marks, jumps);
    EXPECT_LT(jumps, 20) << "only where a joint does jump";
}

TEST_F(HumanoidCurves, AreCopied) {
    run("humanoid.curve", {{"first", "tail_1"}, {"roll_start_deg", 20}, {"falloff", 0.3}});
    const std::string code = lab().code(workspace);
    for (const char* text : {"bent_chain.hpp", "BentChain::make", "curve_0_points",
                             ".roll_start = ", "curve_0_weights", "curve_0->bend(pose"})
        EXPECT_NE(code.find(text), std::string::npos) << text;
}

TEST_F(HumanoidCurves, KeepTheirPositionInAnotherUnit) {
    run("humanoid.curve", {{"first", "tail_1"}});
    move_point(3, {0.5f, 0.2f, 0.1f});
    const double height = part().loaded->height();
    const glm::dvec3 tip = node("tail_6");
    run("humanoid.scale", {{"metres", 0.005}});
    const double scale = part().loaded->height() / height;
    EXPECT_LT(glm::distance(node("tail_6"), scale * tip), 1e-3 * scale);
}

TEST_F(HumanoidCurves, OfferTheChainsThatCanBend) {
    std::vector<std::string> titles;
    for (const BoneChain& each : bendable_chains(part())) titles.push_back(title_of(part(), each));
    const auto offers = [&](const char* from) {
        return std::ranges::any_of(titles, [&](const std::string& each) { return each.starts_with(from); });
    };
    EXPECT_TRUE(offers("tail_1 to "));
    EXPECT_TRUE(offers("antenna_l_1 to "));
    EXPECT_TRUE(offers("Spine"));
    EXPECT_FALSE(offers("tail_2"));
    for (const BoneChain& each : bendable_chains(part()))
        EXPECT_TRUE(humanoid::BentChain::make(part().skeleton(), each.first, each.last));
}

TEST_F(HumanoidCurves, AreBentByTheMouse) {
    run("humanoid.curve", {{"first", "tail_1"}});
    std::optional<PickId> on_curve;
    const DrawList list = drawn();
    for (const Stroke& each : list.strokes)
        if (const auto picked = picked_curve(part(), each.pick);
            picked && !picked->control && picked->at > 2.5f)
            on_curve = each.pick;
    ASSERT_TRUE(on_curve);
    ASSERT_TRUE(lab().handle(workspace, *on_curve));
    const glm::dvec3 tip = node("tail_6");
    emit([&](Emit& to) { lab().click(workspace, *on_curve, to); });
    EXPECT_EQ(points().size(), new_curve_points + 1);
    EXPECT_LT(glm::distance(node("tail_6"), tip), 0.02) << "the shape stays";
    EXPECT_EQ(state().at("selected"), "tail_1") << "its settings are shown";
    EXPECT_FALSE(lab().hint(workspace, *on_curve).empty());
    while (points().size() > 1)
        emit([&](Emit& to) { lab().double_click(workspace, handle("curve.tail_1.0")->pick, to); });
    EXPECT_EQ(lab().hint(workspace, handle("curve.tail_1.0")->pick).find("double click"), std::string::npos);
    Emit last;
    lab().double_click(workspace, handle("curve.tail_1.0")->pick, last);
    const std::vector<Emitted> emitted = last.take();
    ASSERT_EQ(emitted.size(), 1u);
    expect_refused("humanoid.curve", *emitted[0].arguments, {"a curve needs a control point", "on: false"});
}

}  // namespace
}  // namespace tendril::app
