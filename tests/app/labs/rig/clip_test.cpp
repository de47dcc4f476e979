// Clips in the Rig lab: recording, and the frames that the rig can express.
#include <random>
#include <tendril/rig/explain.hpp>

#include "app/io/character/character.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/values.hpp"
#include "rig_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/app/support/temp_folder.hpp"

namespace tendril::app {
namespace {

class RigClips : public RigTest {
  protected:
    /// Runs the whole solve tick by tick.
    int solve_clip() {
        run("rig.clip.solve");
        int ticks = 0;
        for (; lab().working(workspace); ++ticks) lab().work(workspace);
        return ticks;
    }
    const ClipSolve& left() const { return *part().clip_left; }
    void walking_head() {
        run("rig.preset", {{"name", "secondary"}});
        run("rig.motion", {{"name", "head"}, {"path", "circle"}, {"radius", 0.5}, {"period", 1}});
    }
};

TEST_F(RigClips, ADialThatTurnsIsExpressedInEveryFrame) {
    run("rig.preset", {{"name", "fk"}});
    wait(1);
    for (int i = 0; i < 60; ++i) {
        set("dial", 0.5 - 0.5 * std::cos(0.1 * i));
        wait(1);
    }
    run("rig.clip.record");
    EXPECT_EQ(part().clip->frames(), 62u);
    EXPECT_EQ(part().clip->bones.size(), 6u);
    EXPECT_NE(part().clip->poses[1], part().clip->poses[40 * 6 + 1]) << "it moves";
    EXPECT_GT(solve_clip(), 1) << "not in one tick";
    ASSERT_EQ(left().done(), 62u);
    for (const FrameLeft& each : left().left) {
        EXPECT_LT(each.mm, 0.1f);
        EXPECT_LT(each.degrees, 0.0057f);
    }
    EXPECT_TRUE(state().at("clip").at("not_expressed").empty());
}

/// The antennae lag behind, which no value of the head's control can produce.
TEST_F(RigClips, SpringMotionCannotBeExpressed) {
    walking_head();
    run("rig.clip.record", {{"seconds", 1}});
    solve_clip();
    ASSERT_EQ(left().done(), 61u);
    EXPECT_TRUE(left().left.front().expressed()) << "at rest";
    const Json runs = state().at("clip").at("not_expressed");
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_LE(runs[0].at("from"), 5);
    EXPECT_EQ(runs[0].at("to"), 60);
    const std::string bone = runs[0].at("bone");
    EXPECT_TRUE(bone.starts_with("left") || bone.starts_with("right")) << bone;
    EXPECT_GT(runs[0].at("mm"), 10.0);
    EXPECT_GT(runs[0].at("degrees"), 1.0);
}

TEST_F(RigClips, IsExportedAsItWasRecorded) {
    const test::TempFolder folder;
    const std::string path = (folder / "head.glb").string();
    expect_refused("rig.clip.record", {{"seconds", 1}}, {"no bones"});
    expect_refused("rig.clip.start", Json::object(), {"no bones"});
    run("rig.preset", {{"name", "fk"}});
    expect_refused("rig.clip.record", Json::object(), {"nothing has been played"});
    walking_head();
    expect_refused("rig.clip.export", {{"path", path}}, {"no clip"});
    run("rig.clip.record", {{"seconds", 0.5}});
    run("rig.clip.export", {{"path", path}});
    const Character read = read_character(path);
    std::vector<rig::Transform> pose(read.skeleton.size());
    sample(read.clips.front(), read.skeleton, 0.25, pose);
    const std::size_t bones = part().clip->bones.size();
    for (std::size_t i = 0; i < bones; ++i)
        expect_near(pose[*read.skeleton.find(part().clip->bones[i])].translation,
                    part().clip->poses[15 * bones + i].translation, 1e-5);
    tells("bones read back within mm, worst at");
    EXPECT_FALSE(test::says(workspace.ui.toasts.back().text, "unequally"));
    run("rig.clear");
    element("arm", "", {{"scale", {1, 2, 1}}});
    element("hand", "arm", {{"rotation", {0, 0, 0.6, 0.8}}});
    element("tip", "hand", transform(1, 0, 0));
    run("rig.clip.record", {{"seconds", 0.1}});
    run("rig.clip.export", {{"path", (folder / "arm.glb").string()}});
    tells("bones scaled unequally: tip is off");
}

TEST_F(RigClips, HoldsOnlyTheTicksBetweenRecordAndStop) {
    walking_head();
    wait(90);
    run("rig.clip.start");
    EXPECT_TRUE(workspace.clock.playing);
    EXPECT_EQ(part().take.began, 90u);
    expect_refused("rig.clip.record", Json::object(), {"played since"});
    wait(24);
    set_folded(workspace.settings, rig_lab, false);
    EXPECT_TRUE(test::says(test::PanelReader().panel(lab(), workspace), "Stop Clear 0.4 s recorded"));
    EXPECT_EQ(rig_part(reopened()).take, part().take);
    run("rig.clip.record");
    EXPECT_EQ(part().clip->began, 90u);
    EXPECT_EQ(part().clip->frames(), 25u);
    EXPECT_FALSE(part().take.recording);
    run("undo");
    EXPECT_TRUE(part().take.recording);
    run("rig.motion", {{"name", "head"}, {"path", "still"}});
    EXPECT_FALSE(part().take.recording);
    EXPECT_EQ(part().clip->frames(), 25u);
    tells("ended the recording 0.4 s are kept as the clip");
    run("undo");
    EXPECT_TRUE(part().take.recording);
    run("rig.clip.clear");
    EXPECT_FALSE(part().take.recording);
    EXPECT_EQ(part().clip, nullptr);
}

TEST_F(RigClips, HoldsTheEndAndSaysWhatItLacks) {
    run("rig.element.add", {{"name", "away"}, {"kind", "null"}, {"local", transform(1e9, 0, 0)}});
    element("far", "away", transform(1e9, 1, 0));
    run("rig.clip.start");
    wait(3900);
    set_folded(workspace.settings, rig_lab, false);
    EXPECT_TRUE(test::says(test::PanelReader().panel(lab(), workspace), "will hold the last 60.0 s"));
    run("rig.clip.record");
    EXPECT_EQ(part().clip->frames(), 3601u);
    EXPECT_EQ(part().clip->began, part().take.began + 300);
    EXPECT_EQ(part().clip->poses.front().translation, glm::vec3(1e9f, 1, 0));
    tells("it holds only the last 60.0 s of 65.0 s; from 0.0 s on, far is held within 1e9 m");
}

TEST_F(RigClips, IsUndoneCancelledAndCleared) {
    walking_head();
    expect_refused("rig.clip.solve", Json::object(), {"no clip"});
    expect_refused("rig.clip.cancel", Json::object(), {"no backward solve"});
    run("rig.clip.record", {{"seconds", 1}});
    run("rig.clip.solve");
    lab().work(workspace);
    const std::size_t done = left().done();
    EXPECT_GT(done, 0u);
    run("rig.clip.cancel");
    EXPECT_FALSE(lab().working(workspace));
    EXPECT_EQ(left().done(), done);
    run("rig.clip.clear");
    EXPECT_TRUE(state().at("clip").is_null());
    run("undo");
    EXPECT_EQ(left().done(), done);
}

TEST_F(RigClips, AScaleThatTheRigLacksIsNotExpressed) {
    run("rig.preset", {{"name", "loop"}});
    const auto scale = [&](double by) {
        run("rig.element.set", {{"name", "arm 2 joint 6"}, {"transform", {{"scale", {1, by, 1}}}}});
        wait(2);
    };
    scale(1.25);
    run("rig.clip.record");
    scale(1.0);
    solve_clip();
    for (const FrameLeft& each : left().left) {
        EXPECT_FALSE(each.expressed());
        EXPECT_LT(each.mm, 0.1f);
        EXPECT_LT(each.degrees, 0.01f);
        EXPECT_NEAR(each.scale, 0.25f, 1e-4f);
        EXPECT_EQ(part().clip->bones[each.bone], "arm 2 joint 6");
    }
    const Json runs = state().at("clip").at("not_expressed");
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_NEAR(runs[0].at("scale").get<double>(), 0.25, 1e-4);
    EXPECT_EQ(runs[0].at("stopped"), false);
    EXPECT_EQ(Workspace(reopened()).document.get<RigPart>(rig_lab).clip_left->left, left().left);
    // As written by versions without scales.
    Json scene = save_scene(workspace);
    for (Json& each : scene["labs"]["rig"]["state"]["clip"]["solve"]["left"]) each.erase(4), each.erase(3);
    load_scene(workspace, scene);
    EXPECT_EQ(left().left.front().scale, 0.0f);
}

TEST_F(RigClips, AClipForOtherBonesIsRefused) {
    walking_head();
    run("rig.clip.record", {{"seconds", 0.2}});
    run("rig.clip.solve");
    run("rig.element.add", {{"name", "tail"}, {"parent", "skull"}});
    EXPECT_FALSE(lab().working(workspace)) << "it was of the rig as it was";
    expect_refused("rig.clip.solve", Json::object(), {"bones have changed"});
    run("rig.element.remove", {{"name", "tail"}});
    run("rig.clip.solve");
    EXPECT_TRUE(lab().working(workspace));
}

TEST_F(RigClips, OtherFilesAreRefused) {
    walking_head();
    wait(20);
    set("head", {{"translation", {0.1, 1, 0}}});
    wait(20);
    set("head", {{"translation", {0.2, 1, 0}}});
    wait(5);
    run("rig.motion", {{"name", "head"}, {"path", "circle"}});
    wait(5);
    run("rig.clip.record");
    run("rig.clip.solve");
    lab().work(workspace);
    const auto expect_place = [&](const std::string& at, const Json& value, const std::string& place) {
        expect_scene_refused("/state" + at, value, "labs.rig.state." + place);
    };
    expect_place("/take/tick", 6, "take.tick");
    expect_place("/take/last", 1e9, "take.last");
    expect_place("/take/start", 7, "take.start");
    expect_place("/take/start/poses", {{"nobody", {}}}, "take.start.poses");
    expect_place("/take/keys", {{1, "nobody", 0}}, "take.keys.0.1");
    expect_place("/take/keys", {{1, "head"}}, "take.keys.0");
    expect_place("/take/keys", {{2, "head", Json::object()}, {1, "head", Json::object()}}, "take.keys");
    expect_place("/take/began", -1, "take.began");
    expect_place("/motions/head/period", 0, "motions.head.period");
    expect_place("/motions/head/path", "still", "motions.head.path");
    expect_place("/motions/skull", saved()["state"]["motions"]["head"], "motions.skull");
    expect_place("/clip/frames", 0, "clip");
    expect_place("/clip/frames", 1e6, "clip.frames");
    expect_place("/clip/bones", Json::object(), "clip.bones");
    expect_place("/clip/bones/skull/rotation", {0, 0, 0, 2}, "clip.bones.skull.rotation");
    expect_place("/clip/bones/skull/translation", {0, 0}, "clip.bones.skull.translation");
    expect_place("/clip/solve/left/0", {0, 0, 99}, "clip.solve.left.0.2");
    expect_place("/clip/bones/another", {{"translation", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}},
                 "clip.solve");
}

// ------------------------------------------------------------------ single poses, there and back

class RigBackward : public RigTest {
  protected:
    double random(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 8) / static_cast<double>(1u << 24);
    }
    void set_number(const char* name) { set(name, random(0.0, 1.0)); }
    void set_rotation(const std::string& name) {
        Json q = Json::array();
        for (int i = 0; i < 3; ++i) q.push_back(random(-0.4, 0.4));
        q.push_back(1.0);
        run("rig.control.set", {{"name", name}, {"value", q}});
    }
    /// The bones keep their poses and the controls are reset; a backward solve must restore the poses.
    void expect_there_and_back(int i) {
        solve();
        rig::State wanted = part().state;
        auto& now = workspace.document.edit<RigPart>(rig_lab);
        now.state.edit().controls = now.rig.initial_state().controls;
        solve("backward");
        const Json left = state().at("backward");
        EXPECT_LT(left.at("worst_mm"), 0.1) << i;
        EXPECT_LT(left.at("worst_degrees"), 0.0057) << i;
        rig::State found = part().state;
        for (const rig::Residual& each : rig::residuals(part().rig, found, wanted)) {
            ASSERT_LT(each.metres, 1e-4) << i;
            ASSERT_LT(each.radians, 1e-4) << i;
        }
    }
    std::mt19937 random_{17};
};

TEST_F(RigBackward, AimFkAndLoopRestoreEveryPose) {
    for (const char* const preset : {"aim", "fk", "loop"}) {
        SCOPED_TRACE(preset);
        run("rig.preset", {{"name", preset}});
        for (int i = 0; i < 150; ++i) {
            if (preset == std::string("aim")) {
                set("look", {random(-1, 1), random(-1, 1)});
                set("tilt", {random(-0.8, 0.8), random(0.2, 1.2), 0.0});
                run("rig.control.set", {{"name", "math form"}, {"value", i % 2 == 0}});
            } else {
                set_number("dial");
            }
            for (int k = 1; k <= 6 && preset == std::string("fk"); ++k)
                set_rotation("control " + std::to_string(k));
            expect_there_and_back(i);
        }
    }
}

/// One bone of a tentacle is pulled away, which no value of any control can produce.
TEST_F(RigBackward, AnInexpressiblePoseIsReportedWithBoneAndAmount) {
    run("rig.preset", {{"name", "loop"}});
    for (int i = 0; i < 100; ++i) {
        set_number("dial");
        solve();
        const int arm = 1 + i % 5;
        const std::string bone = "arm " + std::to_string(arm) + " joint 6";
        const double off = random(0.02, 0.2);
        auto& now = workspace.document.edit<RigPart>(rig_lab);
        const rig::ElementId id = now.rig.id(*now.rig.element(bone));
        rig::Transform pose = now.state.edit().elements.get(id, rig::Space::Global);
        pose.translation.y += off;
        now.state.edit().elements.put(id, rig::Space::Global, pose);
        solve("backward");
        const Json left = state().at("backward");
        EXPECT_EQ(left.at("bone"), bone) << i;
        EXPECT_GT(left.at("worst_mm"), 700.0 * off) << i;
        EXPECT_LT(left.at("worst_mm"), 1001.0 * off) << i;
    }
}

// The explanation of a bone's pose: the contributions of all units add up to it.

class RigWhy : public RigTest {
  protected:
    void select(const std::string& element) { run("rig.select", {{"element", element}}); }
    /// A value of the control's kind, inside or outside of its limits, which the control enforces.
    Json any_value(const rig::Element& element) {
        std::uniform_real_distribution<double> some(-1.2, 1.2);
        const double a = some(random_), b = some(random_), c = some(random_), d = some(random_);
        switch (element.control->kind) {
            case rig::ControlKind::Float:
                return a;
            case rig::ControlKind::Bool:
                return a > 0.0;
            case rig::ControlKind::Vector2d:
                return {a, b};
            case rig::ControlKind::Position:
                return {a, b, c};
            case rig::ControlKind::Rotation:
                return {a, b, c, d};
            case rig::ControlKind::Transform:
                break;
        }
        return {{"translation", {a, b, c}}, {"rotation", {b, c, d, a}}};
    }
    static rig::Transform read(const Json& json) {
        return read_transform(JsonPlace(json, ""), {}, max_reached);
    }
    static void expect_same(const rig::Transform& a, const rig::Transform& b, const std::string& what) {
        EXPECT_LT(glm::length(a.translation - b.translation), 1e-5) << what;
        EXPECT_GT(std::abs(glm::dot(a.rotation, b.rotation)), 1.0 - 1e-10) << what;
        EXPECT_LT(glm::length(a.scale - b.scale), 1e-5) << what;
    }

    std::mt19937 random_{9};
};

TEST_F(RigWhy, ContributionsAddUpToThePoseInEveryScene) {
    for (const RigPreset& preset : rig_presets()) {
        run("rig.preset", {{"name", preset.name}});
        for (int round = 0; round < 3; ++round) {
            const std::vector<rig::Element> elements = part().rig.definition().elements;
            for (const rig::Element& each : elements)
                if (each.control) run("rig.control.set", {{"name", each.name}, {"value", any_value(each)}});
            tick(1 + 20 * round);
            for (const rig::Element& each : elements) {
                const std::string what = preset.name + std::string(": ") + each.name;
                select(each.name);
                const Json why = state().at("why");
                EXPECT_EQ(why.at("element"), each.name);
                ASSERT_EQ(why.at("units").size(), part().rig.definition().units.size());
                rig::Transform pose = read(why.at("input"));
                for (const Json& unit : why.at("units")) pose = rig::compose(pose, read(unit.at("change")));
                expect_same(pose, read(why.at("result")), what);
                expect_same(pose, read(named("elements", each.name).at("global")), what + ", as it is shown");
            }
        }
    }
}

TEST_F(RigWhy, AMutedUnitAddsNothing) {
    run("rig.preset", {{"name", "fk"}});
    set("dial", 0.5);
    select("bone 2");
    tick();
    const auto added = [&](std::size_t unit) {
        return state().at("why").at("units")[unit]["degrees"].get<double>();
    };
    ASSERT_EQ(state().at("why").at("units")[2].at("name"), "follow 2");
    EXPECT_NEAR(added(2), 12.5, 1e-6);
    run("rig.unit.enable", {{"name", "follow 2"}, {"on", false}});
    tick();
    EXPECT_EQ(added(2), 0.0);
    EXPECT_EQ(state().at("why").at("units").size(), 7u) << "it is still listed";
    run("rig.select");
    EXPECT_TRUE(state().at("why").is_null());
}

TEST_F(RigWhy, IsComputedOncePerChange) {
    run("rig.preset", {{"name", "loop"}});
    auto& runtime = workspace.runtimes.of<RigRuntime>(rig_lab);
    const rig::Contribution* first = runtime.explanation(workspace, 8).units.data();
    EXPECT_EQ(runtime.explanation(workspace, 8).units.data(), first);
    const rig::Transform before = runtime.explanation(workspace, 8).result;
    set("dial", 0.7);
    EXPECT_FALSE(runtime.explanation(workspace, 8).result == before);
}

TEST_F(RigWhy, ThePanelFoldsUnitsWithoutEffectAndKeepsMutedOnes) {
    run("rig.preset", {{"name", "fk"}});
    set("dial", 0.5);
    select("bone 2");
    tick();
    test::PanelReader reader;
    const auto says = [&](const char* what) {
        return reader.inspector(lab(), workspace).find(what) != std::string::npos;
    };
    EXPECT_TRUE(says("Why is this bone here?"));
    EXPECT_TRUE(says("follow 2"));
    EXPECT_FALSE(says("follow 5")) << "bones below do not move it";
    EXPECT_TRUE(says("5 units did not change it"));
    run("rig.unit.enable", {{"name", "follow 2"}, {"on", false}});
    tick();
    EXPECT_TRUE(says("follow 2"));
    EXPECT_TRUE(says("muted"));
}

}  // namespace
}  // namespace tendril::app
