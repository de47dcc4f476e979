// Motions of other characters, retargeted to the lab's.
#include <random>

#include "app/io/character/character.hpp"
#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/app/io/gltf_text.hpp"
#include "tests/app/support/random_numbers.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

/// A VRM motion at half a man's size, facing -Z, whose left arm rises while it walks 1 m ahead in a second.
/// `extension`: the one that names the bones.
std::string vrma(const char* extension = "VRMC_vrm_animation", bool has_toes = true, bool has_pole = false,
                 bool moves = true) {
    struct Joint {
        const char* bone;
        int parent;
        float x, y, z;
    };
    constexpr Joint joints[]{{"", -1, 0, 0, 0},
                             {"hips", 0, 0, 0.5f, 0},
                             {"spine", 1, 0, 0.05f, 0},
                             {"head", 2, 0, 0.25f, 0},
                             {"leftUpperArm", 2, -0.1f, 0.2f, 0},
                             {"leftLowerArm", 4, -0.15f, 0, 0},
                             {"leftHand", 5, -0.15f, 0, 0},
                             {"rightUpperArm", 2, 0.1f, 0.2f, 0},
                             {"rightLowerArm", 7, 0.15f, 0, 0},
                             {"rightHand", 8, 0.15f, 0, 0},
                             {"leftUpperLeg", 1, -0.05f, 0, 0},
                             {"leftLowerLeg", 10, 0, -0.22f, 0},
                             {"leftFoot", 11, 0, -0.22f, 0},
                             {"rightUpperLeg", 1, 0.05f, 0, 0},
                             {"rightLowerLeg", 13, 0, -0.22f, 0},
                             {"rightFoot", 14, 0, -0.22f, 0},
                             {"", 12, 0, -0.03f, -0.08f},
                             {"", 15, 0, -0.03f, -0.08f}};
    std::string nodes, bones;
    const int count = static_cast<int>(std::size(joints)) - (has_toes ? 0 : 2);
    for (int i = 0; i < count; ++i) {
        std::string children;
        for (int k = 0; k < count; ++k)
            if (joints[k].parent == i) children += (children.empty() ? "" : ",") + std::to_string(k);
        if (i == 0 && has_pole) children += "," + std::to_string(count);
        nodes += (i > 0 ? "," : "") + std::string(R"({"translation":[)") + std::to_string(joints[i].x) + "," +
                 std::to_string(joints[i].y) + "," + std::to_string(joints[i].z) + "]" +
                 (children.empty() ? "" : R"(,"children":[)" + children + "]") + "}";
        if (joints[i].bone[0] != '\0')
            bones += (bones.empty() ? "" : ",") + std::string("\"") + joints[i].bone + R"(":{"node":)" +
                     std::to_string(i) + "}";
    }
    if (has_pole) nodes += R"(,{"name":"pole","translation":[0.1,0.3,-0.6]})";
    test_gltf::GltfText file;
    const float half = std::sqrt(0.5f);
    const std::vector<float> turned{0, 0, 0, 1, 0, 0, -half, half}, at{0, 0.5f, 0, 0, 0.5f, -1};
    const auto keys = [&](std::vector<float> of, std::size_t width) {
        if (!moves) of.resize(width);
        return of;
    };
    const std::string times = file.scalars(keys({0, 1}, 1)), turns = file.quaternions(keys(turned, 4)),
                      ways = file.vectors(keys(at, 3));
    file.members = R"("nodes":[)" + nodes + R"(],"animations":[{"name":"wave","samplers":[{"input":)" +
                   times + R"(,"output":)" + turns + R"(},{"input":)" + times + R"(,"output":)" + ways +
                   R"(}],"channels":[{"sampler":0,"target":{"node":4,"path":"rotation"}},)"
                   R"({"sampler":1,"target":{"node":1,"path":"translation"}}]}],"extensionsUsed":[")" +
                   extension + R"("],"extensions":{")" + extension + R"(":{"humanoid":{"humanBones":{)" +
                   bones + "}}}}";
    return file.glb();
}

class HumanoidMotions : public HumanoidTest {
  protected:
    HumanoidMotions() {
        write("wave.vrma", vrma());
        write("body.vrm", vrma("VRMC_vrm"));
    }
};

TEST_F(HumanoidMotions, AVrmaPlaysOnAnotherCharacter) {
    const double clips = static_cast<double>(part().loaded->clips().size());
    const glm::dvec3 hips = bone("Hips");
    run("humanoid.motion.load", {{"path", path("wave.vrma")}});
    EXPECT_EQ(part().loaded->clips().size(), clips + 1);
    EXPECT_EQ(part().clip()->name, "wave");
    EXPECT_TRUE(part().playback.playing);
    ASSERT_FALSE(workspace.ui.toasts.empty());

    run("humanoid.clip", {{"time", 1.0}, {"play", false}, {"loop", false}});
    const glm::dvec3 arm = bone("LeftLowerArm") - bone("LeftUpperArm");
    EXPECT_GT(arm.y / glm::length(arm), 0.999) << "up, though the figures face opposite ways";
    const glm::dvec3 other = bone("RightLowerArm") - bone("RightUpperArm");
    EXPECT_LT(std::abs(other.y) / glm::length(other), 1e-3);
    const glm::dvec3 way = bone("Hips") - hips;
    EXPECT_GT(way.z, 1.5) << "ahead, in proportion to the legs";
    EXPECT_NEAR(way.x, 0.0, 1e-6);

    // Undone in one step; named again.
    run("humanoid.motion.load", {{"path", path("wave.vrma")}, {"clip", "wave"}});
    EXPECT_EQ(part().clip()->name, "wave_2");
    for (int i = 0; i < 3; ++i) run("undo");
    EXPECT_EQ(part().loaded->clips().size(), clips);
}

TEST_F(HumanoidMotions, APoseOfOneKeyIsAMotionToo) {
    for (const char* to : {"", "body.vrm"}) {
        if (*to != '\0') run("humanoid.load", {{"path", path(to)}});
        write("pose.vrma", vrma("VRMC_vrm_animation", true, false, false));
        run("humanoid.motion.load", {{"path", path("pose.vrma")}});
        run("humanoid.ground", {{"kind", "stairs"}});
        run("humanoid.foot_ik", {{"on", true}});
        for (const bool loops : {true, false}) {
            run("humanoid.clip", {{"time", 0.0}, {"play", true}, {"loop", loops}});
            tick(20);
        }
        EXPECT_EQ(part().clip()->duration, 0.0);
        const glm::dvec3 arm = bone("LeftLowerArm") - bone("LeftUpperArm");
        EXPECT_LT(std::abs(arm.y) / glm::length(arm), 1e-3);
        run("humanoid.export", {{"path", path("pose.bvh")}});
    }
}

TEST_F(HumanoidMotions, ItIsAClipLikeOthers) {
    run("humanoid.load", {{"path", path("body.vrm")}});
    EXPECT_EQ(bones().at("Hips").at("confidence"), 1.0);
    run("humanoid.motion.load", {{"path", path("wave.vrma")}});
    EXPECT_EQ(part().clip()->name, "wave_2") << "it has one of that name";
    run("humanoid.export", {{"path", path("out.glb")}});
    run("humanoid.scale", {{"metres", 2.0}});
    EXPECT_EQ(part().loaded->edits.size(), 1u);
    run("humanoid.load", {{"path", path("out.glb")}});
    ASSERT_EQ(part().loaded->clips().size(), 1u);
    EXPECT_EQ(part().loaded->clips()[0].name, "wave_2");
    EXPECT_NEAR(part().loaded->clips()[0].duration, 1.0, 1e-6);
}

TEST_F(HumanoidMotions, TheRootIsIncludedAndOnlyBonesAreDrawnAsBones) {
    write("no_toes.vrm", vrma("VRMC_vrm", false));
    run("humanoid.load", {{"path", path("no_toes.vrm")}});
    run("humanoid.motion.load", {{"path", path("wave.vrma")}});
    run("humanoid.clip", {{"time", 1.0}, {"play", false}, {"loop", false}});
    const std::vector<humanoid::Placement>& placed = shown_pose(workspace).placed;
    EXPECT_LT(glm::distance(placed[0].position, glm::dvec3(0, 0, -1)), 1e-6);
    const DrawList list = drawn({.target = {0.0f, 0.5f, -1.0f}, .distance = 3.0f});
    const std::size_t foot = *part().node_of(Bone::LeftFoot);
    glm::dvec3 end(0.0);
    for (const Stroke& each : list.strokes) {
        const bool line = glm::distance(each.a, each.b) > 1e-5f;
        EXPECT_FALSE(line && each.pick == node_pick(0)) << "from the root to the hips";
        if (line && each.pick == node_pick(foot)) end = each.b;
    }
    const glm::dvec3 way = end - placed[foot].position;
    EXPECT_LT(way.z, -0.05) << "the foot points ahead, not on along the shin";
    EXPECT_GT(way.y, -0.08);
}

TEST_F(HumanoidMotions, GuessesAboutItsFileAreReported) {
    // A BVH states neither its unit nor its up axis.
    run("humanoid.load", {{"path", path("body.vrm")}});
    run("humanoid.export", {{"path", path("wave.bvh")}});
    run("humanoid.load");
    const auto notes = [&] { return state().at("character").at("notes").dump(); };
    const std::string before = notes();
    run("humanoid.motion.load", {{"path", path("wave.bvh")}});
    EXPECT_TRUE(test::says(notes(), "At rest: Chest hips scaled unit"));
    const Workspace again = reopened();
    EXPECT_TRUE(humanoid_part(again).loaded->edits.at(0).what == part().loaded->edits.at(0).what);
    run("humanoid.clip", {{"index", 0}});
    EXPECT_EQ(notes(), before) << "of a clip of its own there is nothing to say";
}

TEST_F(HumanoidMotions, UnretargetableMotionsAreRefusedOrReported) {
    write("still.gltf",
          R"({"asset":{"version":"2.0"},"nodes":[{"children":[1]},{}],"skins":[{"joints":[0,1]}]})");
    refuses("humanoid.motion.load", {{"path", path("still.gltf")}}, "still.gltf no clips");
    refuses("humanoid.motion.load", {{"path", path("gone.vrma")}}, "gone.vrma no such file");
    refuses("humanoid.motion.load", {{"path", path("wave.vrma")}, {"clip", "run"}}, "wave.vrma no clip run");
    run("humanoid.motion.load", {{"path", path("wave.vrma")}});
    const std::string said = workspace.ui.toasts.back().text;
    EXPECT_TRUE(test::says(said, "Clip wave wave.vrma At rest: Chest, UpperChest, Neck, Shoulder, Toes."));
    EXPECT_EQ(said.find("hips"), said.npos) << "a line; the rest is in the panel";
    run("humanoid.load", {{"path", path("body.vrm")}});
    run("humanoid.motion.load", {{"path", path("wave.vrma")}});
    tells("wave_2 Every bone");
    // A root and a control beside the body.
    write("rig.vrm", vrma("VRMC_vrm", true, true));
    run("humanoid.load", {{"path", path("rig.vrm")}});
    run("humanoid.motion.load", {{"path", path("wave.vrma")}});
    tells("wave_2 Not retargeted: pole.");
    run("humanoid.map", {{"bone", "Hips"}});
    refuses("humanoid.motion.load", {{"path", path("wave.vrma")}}, "wave.vrma to.map Hips");
}

/// The choice is offered between a character that has a skin and a motion, whichever is opened first.
TEST_F(HumanoidMotions, OpeningAFileAsksWhetherTheMotionPlaysOnTheFigure) {
    const std::string figure = tendril::test::source_path("tests/app/golden/body.glb"),
                      motion = path("wave.vrma");
    const auto ways = [&](const std::string& file) {
        std::string commands;
        for (const FileWay& each : lab().file_ways(workspace, file)) commands += each.command + ' ';
        return commands;
    };
    EXPECT_EQ(ways(motion), "") << "nothing was loaded";
    run("humanoid.load", {{"path", figure}});
    EXPECT_EQ(ways(figure) + ways(path("gone.glb")) + ways(path("map.json")), "");
    EXPECT_EQ(ways(motion), "humanoid.motion.load humanoid.load ");
    const Json before = saved();
    run("file.open", {{"path", motion}, {"ask", true}});
    EXPECT_EQ(workspace.ui.file_question.path, motion);
    EXPECT_EQ(saved(), before);
    expect_refused("file.open", {{"path", motion}, {"by", "humanoid.export"}}, {"by", "humanoid.export"});
    run("file.open", {{"path", motion}, {"by", "humanoid.motion.load"}});
    EXPECT_TRUE(workspace.ui.file_question.ways.empty());
    EXPECT_EQ(part().clip()->name, "wave_2") << "the figure has a wave of its own";
    run("undo");
    EXPECT_EQ(saved(), before);
    run("file.open", {{"path", motion}});
    EXPECT_EQ(part().loaded->file, motion) << "scripts are not asked";
    EXPECT_EQ(ways(motion), "");
    EXPECT_EQ(ways(figure), "humanoid.motion.take humanoid.load ");
}

TEST_F(HumanoidMotions, FixesGoAlongToAnotherCharacter) {
    const std::string figure = treadmill_figure(folder_.path());
    run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/faulty_walk.bvh")}});
    run("humanoid.motion.take", {{"path", figure}});
    const humanoid::Clip unfixed = *part().clip();
    run("undo");
    run("humanoid.cure");
    const HumanoidPart fixed = part();
    run("humanoid.motion.take", {{"path", figure}});
    tells("motion from faulty_walk.bvh with its fixes");
    EXPECT_EQ(workspace.ui.toasts.back().text.find("Discarded"), std::string::npos);
    EXPECT_FALSE(*part().clip() == unfixed);
    EXPECT_TRUE(part().loaded->clip_unfixed(*part().playback.clip) == unfixed) << "for ghost and export";
    LoadedCharacter bare = *part().loaded;
    for (ClipEdit& each : bare.edits) each.unfixed.reset();
    HumanoidPart with = part(), without = part();
    with.loaded = std::make_shared<const LoadedCharacter>(*part().loaded);
    without.loaded = std::make_shared<const LoadedCharacter>(bare);
    EXPECT_LT(without.bytes(), with.bytes()) << "the unfixed motion is counted";
    const HumanoidPart other(load_character(figure));
    EXPECT_TRUE(*part().clip() == with_motion(other, fixed, "motion").loaded->clips().back());
    EXPECT_TRUE(humanoid_part(reopened()).loaded->clips() == part().loaded->clips());
    run("undo");
    run("humanoid.load", {{"path", figure}});
    tells("Discarded 1 fix of a clip");
    run("humanoid.clip", {{"name", ""}});
    expect_refused("humanoid.motion.take", {{"path", figure}}, {"no clip"});
}

/// Motions and fixes keep the unit, axes, bones and limits that they were made with.
TEST_F(HumanoidMotions, OpenAsSavedForAnyOrderOfEdits) {
    const std::string faulty = tendril::test::source_path("tests/app/golden/faulty_walk.bvh");
    const std::string figure = treadmill_figure(folder_.path());
    write("figure.bvh", bvh_figure());
    const std::vector<std::pair<const char*, Json>> edits{
        {"humanoid.motion.load", {{"path", path("wave.vrma")}}},
        {"humanoid.motion.load", {{"path", faulty}}},
        {"humanoid.motion.take", {{"path", figure}}},
        {"humanoid.up", {{"axis", "z"}}},
        {"humanoid.up", {{"axis", "y"}}},
        {"humanoid.scale", {{"metres", 0.7}}},
        {"humanoid.scale", {{"metres", 0.013}}},
        {"humanoid.root", {{"positions", "replace"}}},
        {"humanoid.map", {{"bone", "Spine"}}},
        {"humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand_End"}}},
        {"humanoid.map", {{"bone", "LeftFoot"}, {"node", "LeftToes"}}},
        {"humanoid.limits", {{"from", "motion"}}},
        {"humanoid.limits", {{"from", "none"}}},
        {"humanoid.cure", {{"clip", "motion"}}},
        {"humanoid.cure", {{"clip", "motion_2"}}},
        {"humanoid.cure", Json::object()}};
    test::RandomNumbers random(6);
    for (int scene = 0; scene < 12 && !HasFailure(); ++scene) {
        run("humanoid.load", {{"path", scene % 2 == 0 ? faulty : path("figure.bvh")}});
        std::string made;
        for (int i = 0; i < 12; ++i) {
            const auto& [name, arguments] = edits[random.random() % edits.size()];
            try {
                run(name, arguments);
                made += std::string(name) + ' ' + arguments.dump() + '\n';
            } catch (const Refused&) {
            }
        }
        SCOPED_TRACE(made);
        EXPECT_TRUE(humanoid_part(reopened()).loaded->clips() == part().loaded->clips());
        expect_goes_on_the_same(300);
    }
}

/// As of version 1: all motions, then all cures, made with the settings of the scene.
TEST_F(HumanoidMotions, OfOlderScenesAreMadeWithTheSettingsOfTheScene) {
    run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/faulty_walk.bvh")}});
    run("humanoid.up", {{"axis", "z"}});
    run("humanoid.motion.load", {{"path", path("wave.vrma")}});
    run("humanoid.cure", {{"clip", "motion"}});
    Json scene = save_scene(workspace);
    Json& lab = scene["labs"][humanoid_lab];
    const auto without = [](Json edit) {
        for (const char* key : {"scale", "space", "bones", "limits"}) edit.erase(key);
        return edit;
    };
    lab["motions"] = {without(lab["edits"][0])};
    lab["cures"] = {without(lab["edits"][1])};
    lab.erase("edits");
    Workspace old = make_blank_workspace(labs);
    load_scene(old, scene);
    EXPECT_EQ(save_scene(old), save_scene(workspace));
    EXPECT_TRUE(humanoid_part(old).loaded->clips() == part().loaded->clips());
}

// Targets that are released, or change weight or rotation: nothing else jumps.

using Places = std::vector<glm::dvec3>;

class HumanoidRelease : public HumanoidTest {
  protected:
    void begin_anew(bool walking) {
        workspace = make_blank_workspace(labs);
        if (!walking) return;
        run("humanoid.clip", {{"name", "walk"}, {"play", true}});
        tick(static_cast<int>(any(10.0, 60.0)));
    }
    void target(const char* effector, const Json& to) {
        run("humanoid.target", {{"effector", effector}, {"to", to}});
    }
    void let_go(const char* effector) { run("humanoid.target", {{"effector", effector}, {"weight", 0}}); }
    /// A random point within `size` of the clip's hips plus `from`.
    Json near(const glm::dvec3& from, double size) {
        const glm::dvec3 at = bone("Hips") + from;
        const double x = any(-size, size), y = any(-size, size), z = any(-size, size);
        return {at.x + x, at.y + y, at.z + z};
    }
    void reach_with_both_hands() {
        target("left_hand", near({0.35, 0.3, 0.4}, 0.25));
        target("right_hand", near({-0.35, 0.1, 0.5}, 0.45));
        tick(10);
    }
    Places places() const {
        Places all;
        for (const humanoid::Placement& each : shown_pose(workspace).placed) all.push_back(each.position);
        return all;
    }
    Places clip_places() const {
        const ShownPose& shown = shown_pose(workspace);
        Places all;
        for (const humanoid::Placement& each : shown.before.empty() ? shown.placed : shown.before)
            all.push_back(each.position);
        return all;
    }
    double leap(const Places& before, const Places& now, const char* without = nullptr) const {
        const std::size_t limb = without ? node_named(part(), without) : before.size();
        double most = 0.0;
        for (std::size_t i = 0; i < now.size(); ++i)
            if (i != limb && !(without && part().skeleton().is_below(i, limb)))
                most = std::max(most, glm::distance(before[i], now[i]));
        return most;
    }
    double left(const char* effector) const {
        return state().at("body").at("targets").at(effector).at("residual").get<double>();
    }
    double any(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }

    std::mt19937 engine{11};
};

TEST_F(HumanoidRelease, WhilePausedMovesOnlyTheReleasedLimb) {
    for (int i = 0; i < 25; ++i) {
        begin_anew(false);
        if (i % 2) run("humanoid.clip", {{"name", "walk"}, {"time", any(0.0, 1.0)}});
        reach_with_both_hands();
        if (left("left_hand") > 1e-4 || left("right_hand") > 1e-4) continue;
        const Places before = places();
        let_go("right_hand");
        EXPECT_FALSE(state().at("body").at("targets").contains("right_hand"));
        EXPECT_LT(leap(before, places(), "RightUpperArm"), 5e-3) << i;
        EXPECT_GT(leap(before, places()), 0.05) << "the arm is the clip's at once";
        EXPECT_LT(left("left_hand"), 1e-3);
    }
}

TEST_F(HumanoidRelease, TheRestOfTheBodyReturnsWhileTimeRuns) {
    target("left_hand", {0.3, 1.2, 0.4});
    const glm::dvec3 alone = bone("Head");
    target("right_hand", {-0.2, 0.8, 0.9});
    let_go("right_hand");
    EXPECT_GT(glm::distance(bone("Head"), alone), 0.2) << "still bent down";
    Places before = places();
    int ticks = 0;
    for (; lab().moving(workspace) && ticks < 200; ++ticks) {
        tick();
        ASSERT_LT(leap(before, places()), 0.05) << ticks;
        ASSERT_LT(left("left_hand"), 1e-3) << ticks;
        before = places();
    }
    EXPECT_LT(ticks, 70) << "then nothing moves any more";
    EXPECT_LT(glm::distance(bone("Head"), alone), 0.06);
}

TEST_F(HumanoidRelease, EasesBackIntoAPlayingClip) {
    for (int i = 0; i < 25; ++i) {
        begin_anew(true);
        reach_with_both_hands();
        const bool both = i % 3 == 0;
        const Places held = places();
        if (both) let_go("left_hand");
        let_go("right_hand");
        EXPECT_LT(leap(held, places()), 1e-9) << "not in the moment itself";
        double way = leap(clip_places(), held);
        // Metres that the other hand moves when the walk takes its target along to the next round.
        constexpr double along = 1.3;
        bool goes_along = false;
        Places before = held, clip = clip_places();
        double walked = 0.0;
        for (int k = 0; k < 70; ++k) {
            const std::int64_t rounds = part().playback.rounds;
            tick();
            if (part().playback.rounds > rounds && !both) way = std::max(way, along), goes_along = true;
            const Places now = places(), now_clip = clip_places();
            walked = leap(clip, now_clip);
            ASSERT_LT(leap(before, now), walked + 0.16 * way + 0.01) << i << ' ' << k;
            before = now, clip = now_clip;
        }
        if (!goes_along) {
            EXPECT_EQ(part().ik_state.release, Release());
        }
        if (both) {
            EXPECT_EQ(leap(places(), clip_places()), 0.0) << "the clip's to the bit";
        } else {
            EXPECT_LT(left("left_hand"), 0.4);
        }
    }
}

TEST_F(HumanoidRelease, OfAHandMovedByHandIkEasesToo) {
    begin_anew(true);
    run("humanoid.hand_ik", {{"on", true}});
    target("right_hand", near({-0.35, 0.1, 0.45}, 0.05));
    tick(3);
    Places before = places();
    let_go("right_hand");
    EXPECT_LT(leap(before, places()), 1e-9);
    for (int k = 0; k < 70; ++k) {
        before = places();
        tick();
        ASSERT_LT(leap(before, places()), 0.15) << k;
    }
    EXPECT_EQ(leap(places(), clip_places()), 0.0);
}

TEST_F(HumanoidRelease, ANewTargetOfTheSameHandIsReachedAtOnce) {
    begin_anew(true);
    reach_with_both_hands();
    let_go("right_hand");
    tick(2);
    const glm::dvec3 wanted = bone("RightHand") + glm::dvec3(0.05, 0.05, 0.05);
    target("right_hand", {wanted.x, wanted.y, wanted.z});
    EXPECT_LT(glm::distance(bone("RightHand"), wanted), 1e-3);
}

}  // namespace
}  // namespace tendril::app
