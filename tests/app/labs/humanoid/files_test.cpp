// Saving and loading bone maps, exporting clips as shown, finding and fixing faults.
#include <fstream>
#include <tuple>

#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/map_file.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/labels.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

class HumanoidFiles : public HumanoidTest {
  protected:
    const humanoid::LintReport& report() {
        const humanoid::LintReport* const found =
            humanoid_runtime(workspace).lint.report(part(), humanoid_runtime(workspace).solvers);
        EXPECT_NE(found, nullptr);
        static const humanoid::LintReport none;
        return found ? *found : none;
    }
    /// The figure with its walk, in which the right knee pops in frame 20.
    std::string faulty(bool numbered = false) const {
        Character figure = stick_figure();
        humanoid::Clip clip = figure.clips[0];
        for (humanoid::Channel& channel : clip.channels) {
            const std::string& name = figure.skeleton[channel.node].name;
            auto& keys = channel.rotation.values;
            if (name == "RightLowerLeg") keys[20] = keys[20] * glm::angleAxis(0.6, glm::dvec3(1, 0, 0));
        }
        std::vector<humanoid::Node> nodes = figure.skeleton.nodes();
        for (std::size_t i = 0; i < nodes.size() && numbered; ++i)
            nodes[i].name = "Node_" + std::to_string(i);
        figure.skeleton = skeleton_of(std::move(nodes));
        export_clip({figure, {}, clip, clip, 60.0}, folder_ / "faulty.glb");
        return path("faulty.glb");
    }
};

TEST_F(HumanoidFiles, AMapIsSavedAndLoaded) {
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand_End"}});
    run("humanoid.map.save", {{"path", path("map.json")}});
    EXPECT_EQ(read_map(path("map.json")).bones[static_cast<std::size_t>(Bone::LeftHand)], "LeftHand_End");
    run("humanoid.load");
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand");
    run("humanoid.map.load", {{"path", path("map.json")}});
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand_End");
    run("undo");
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand");
}

TEST_F(HumanoidFiles, AClipIsExportedAsItCame) {
    for (const char* name : {"walk.glb", "walk.gltf", "walk.bvh"}) {
        run("humanoid.export", {{"path", path(name)}, {"clip", "punch"}});
        EXPECT_NEAR(read_character(path(name)).clips.at(0).duration, 1.2, 1e-6);
        tells("read back within mm, worst at");
    }
    run("humanoid.clip", {{"name", "walk"}});
    run("humanoid.export", {{"path", path("chosen.glb")}});
    EXPECT_EQ(read_character(path("chosen.glb")).clips.at(0).name, "walk");
    expect_refused("humanoid.export", {{"path", path("walk.fbx")}}, {"walk.fbx"});
    expect_refused("humanoid.export", {{"path", path("a.glb")}, {"clip", "run"}}, {"run"});
}

/// The faults of the clip, of the result, and those that an export reports.
TEST_F(HumanoidFiles, TheResultIsLintedAndAnExportReportsNewFindings) {
    run("humanoid.clip", {{"name", "walk"}, {"time", 0}});
    EXPECT_TRUE(report().findings.empty());
    // A target behind the left foot for the whole clip: it is dragged along, above the floor.
    run("humanoid.target", {{"effector", "left_foot"}, {"to", {0.1, 0.05, 0.3}}});
    EXPECT_TRUE(report().findings.empty()) << "the clip has none";
    run("humanoid.view", {{"judged", "result"}});
    ASSERT_FALSE(report().findings.empty());
    for (const humanoid::Finding& each : report().findings) EXPECT_FALSE(each.has_cure) << each.text;
    refuses("humanoid.cure", Json::object(), "walk 0 faults fixed LeftFoot no fix not in the clip IK");
    const std::size_t count = report().findings.size();
    run("humanoid.export", {{"path", path("out.glb")}});
    const std::string told = workspace.ui.toasts.back().text;
    EXPECT_TRUE(test::says(told, std::to_string(count) + " in the written clip, " + std::to_string(count) +
                                     " of them new " + report().findings[0].text.substr(0, 15)));
    // Reopened, the file has the reported findings.
    run("humanoid.load", {{"path", path("out.glb")}});
    run("humanoid.clip", {{"index", 0}});
    EXPECT_EQ(report().findings.size(), count);
    EXPECT_EQ(report().rate, 60.0);
    // A fault that the clip had before is not new, and is fixed in the clip.
    run("humanoid.load", {{"path", faulty()}});
    run("humanoid.clip", {{"index", 0}});
    ASSERT_TRUE(report().findings.size() == 1 && report().findings[0].has_cure);
    run("humanoid.cure");
    EXPECT_TRUE(report().findings.empty());
    run("undo");
    run("humanoid.export", {{"path", path("again.glb")}});
    tells("1 finding in the written clip none of them new");
    const std::string panel = [&] {
        run("view.fold", {{"section", "humanoid: Motion lint"}, {"folded", false}});
        run("humanoid.clip", {{"index", 0}});
        return test::PanelReader().panel(lab(), workspace);
    }();
    EXPECT_NE(panel.find("the result"), panel.npos) << panel;
}

/// On stairs the floor is where the ground is: feet that stand on them neither float nor sink.
TEST_F(HumanoidFiles, TheResultIsLintedOnItsGround) {
    run("humanoid.ground", {{"kind", "stairs"}, {"step_height", 0.16}, {"step_depth", 0.36}});
    run("humanoid.clip", {{"name", "walk"}, {"time", 0}});
    run("humanoid.view", {{"judged", "result"}});
    for (const humanoid::Finding& each : report().findings) {
        EXPECT_NE(each.fault, humanoid::Fault::Sinking) << each.text;
        EXPECT_NE(each.fault, humanoid::Fault::Floating) << each.text;
    }
    run("humanoid.ground", {{"kind", "slope"}, {"angle_deg", 18}});
    EXPECT_TRUE(report().findings.empty()) << report().findings[0].text;
    // Without foot IK, the clip walks into the slope, but it is no longer judged on it.
    run("humanoid.foot_ik", {{"on", false}});
    EXPECT_TRUE(report().findings.empty());
}

TEST_F(HumanoidFiles, AnExportReportsTheGroundThatItWasJudgedOn) {
    run("humanoid.clip", {{"name", "walk"}, {"time", 0}});
    run("humanoid.target", {{"effector", "left_foot"}, {"to", {0.1, 0.05, 0.3}}});
    for (const char* const ground : {"flat", "stairs"}) {
        run("humanoid.ground", {{"kind", ground}});
        run("humanoid.foot_ik", {{"on", true}});
        run("humanoid.export", {{"path", path("out.glb")}});
        const std::string told = workspace.ui.toasts.back().text;
        EXPECT_TRUE(test::says(told, "in the written clip"));
        EXPECT_EQ(test::says(told, "in the written clip on this ground"), ground == std::string("stairs"))
            << told;
    }
}

TEST_F(HumanoidFiles, AnExportReportsOtherClipsAndWritesThemAll) {
    run("humanoid.export", {{"path", path("one.glb")}, {"clip", "punch"}});
    tells("one.glb 1 of 2 clips: punch");
    run("view.fold", {{"section", "humanoid: Export"}, {"folded", false}});
    const std::string panel = test::PanelReader().panel(lab(), workspace);
    EXPECT_TRUE(test::says(panel, "figure_walk.glb Export clip Export all 1 of 2 clips: walk"));
    run("humanoid.export", {{"path", path("all.bvh")}, {"all", true}});
    tells("all_walk.bvh others 2 clips read back within");
    for (const char* const name : {"walk", "punch"}) {
        const humanoid::Clip& clip = *std::ranges::find(part().loaded->clips(), name, &humanoid::Clip::name);
        const Character read = read_character(path((std::string("all_") + name + ".bvh").c_str()));
        EXPECT_NEAR(read.clips.at(0).duration, clip.duration, 0.02) << name;
    }
    expect_refused("humanoid.export", {{"path", path("x.glb")}, {"all", true}, {"clip", "walk"}}, {"clip"});
    run("humanoid.attach", {{"bone", "Head"}, {"kind", "hair"}});
    run("humanoid.hold", {{"kind", "rifle"}});
    run("humanoid.export", {{"path", path("bones.bvh")}});
    tells("bones.bvh Left out: hair, rifle");
    run("humanoid.copy");
    EXPECT_TRUE(workspace.ui.toasts.back().text.ends_with("C++. Left out: hair"));
    // A file with one clip is not reported as "1 of 1".
    run("humanoid.load", {{"path", path("all_walk.bvh")}});
    run("humanoid.export", {{"path", path("again.bvh")}});
    EXPECT_FALSE(test::says(workspace.ui.toasts.back().text, "1 of")) << workspace.ui.toasts.back().text;
}

TEST_F(HumanoidFiles, LoadingAnotherCharacterReportsWhatItDiscards) {
    const std::string walk = tendril::test::source_path("tests/app/golden/faulty_walk.bvh");
    run("humanoid.load", {{"path", walk}});
    EXPECT_TRUE(workspace.ui.toasts.empty()) << "nothing to discard";
    run("humanoid.cure", Json::object());
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.5, 1.2, 0.3}}});
    run("humanoid.ground", {{"kind", "flat"}});
    run("humanoid.curve", {{"first", "Spine"}});
    const HumanoidPart before = part();
    run("humanoid.load");
    tells("Discarded 1 fix 1 target 1 curve IK settings Undo");
    run("undo");
    EXPECT_TRUE(part() == before);
}

TEST_F(HumanoidFiles, ClipsWithTheSameNameAreDistinguished) {
    run("humanoid.export", {{"path", path("one.gltf")}, {"clip", "walk"}});
    std::ifstream file(path("one.gltf"));
    Json json = Json::parse(file);
    json["animations"].push_back(json["animations"][0]);
    test::write(path("two.gltf"), json.dump());
    run("humanoid.load", {{"path", path("two.gltf")}});
    ASSERT_EQ(part().loaded->clips().size(), 2u);
    EXPECT_EQ(part().loaded->clips()[0].name, "walk");
    EXPECT_EQ(part().loaded->clips()[1].name, "walk_2");
    run("humanoid.clip", {{"name", "walk_2"}});
    EXPECT_EQ(part().playback.clip, 1u);
}

/// The hand goes to its target and back within the clip, however long that is.
TEST_F(HumanoidFiles, TheWeightOfAHandFitsTheClip) {
    for (const char* clip : {"walk", "punch"}) {
        run("humanoid.load");
        run("humanoid.clip", {{"name", clip}});
        run("humanoid.hand_ik", {{"on", true}, {"hand", "left"}, {"curve", true}});
        const HandCurve curve = *part().ik.hand_ik.curves[0];
        const double whole = part().clip()->duration;
        EXPECT_NEAR(curve.begin, 0.25 * whole, 0.01);
        EXPECT_NEAR(curve.end, 0.71 * whole, 0.01);
    }
    EXPECT_TRUE(part().ik.hand_ik.curves[0] == HandCurve()) << "of a punch";
}

TEST_F(HumanoidFiles, FaultsAreFoundAndFixed) {
    run("humanoid.load", {{"path", faulty()}});
    run("humanoid.clip", {{"name", "walk"}});
    ASSERT_EQ(report().findings.size(), 1u);
    EXPECT_EQ(report().findings[0].fault, humanoid::Fault::KneePop);
    EXPECT_EQ(report().findings[0].frame, 20u);
    const humanoid::Clip as_read = *part().clip();
    run("humanoid.clip", {{"time", report().findings[0].time}});
    EXPECT_TRUE(shown_pose(workspace).ghost.empty());
    expect_refused("humanoid.cure", {{"kind", "sign_flip"}}, {"walk"});
    expect_refused("humanoid.cure", {{"kind", "knee_pop"}, {"node", "Tail"}}, {"Tail"});
    expect_refused("humanoid.cure", {{"kind", "knee_pop"}, {"frame", 40}}, {"walk"});
    run("humanoid.cure", {{"kind", "knee_pop"}, {"node", "RightLowerLeg"}, {"frame", 20}});
    EXPECT_TRUE(report().findings.empty());
    EXPECT_TRUE(part().loaded->clip_unfixed(*part().playback.clip) == as_read) << "what an export compares";
    EXPECT_FALSE(shown_pose(workspace).ghost.empty()) << "before the fix";
    run("undo");
    EXPECT_EQ(report().findings.size(), 1u);
}

/// A scene in which everything is on.
class HumanoidScenes : public HumanoidFiles {
  protected:
    HumanoidScenes() {
        run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/antennae.bvh")}});
        run("humanoid.clip", {{"index", 0}, {"play", true}});
        run("humanoid.map", {{"bone", "LeftToes"}});
        run("humanoid.ground", {{"kind", "slope"}});
        run("humanoid.target", {{"effector", "left_foot"}, {"rotation", {0, 0, 0, 1}}});
        run("humanoid.hold", {{"kind", "box"}, {"hands", "left"}});
        run("humanoid.hand_ik", {{"on", true}, {"hand", "right"}, {"curve", true}});
        run("humanoid.look_at", {{"on", true}});
        run("humanoid.limits", {{"bone", "LeftHand"}, {"from", "none"}});
        run("humanoid.spring", {{"nodes", {"antenna_l_1", "antenna_r_1"}}});
        run("humanoid.curve", {{"first", "tail_1"}});
        run("humanoid.curve", {{"first", "Spine"}});
        for (const char* const name : {"tail", "rope"})
            run("humanoid.attach", {{"bone", "Hips"}, {"kind", "rope"}, {"name", name}});
        run("humanoid.select", {{"nodes", {"Hips", "Head"}}});
        run("humanoid.flips", {{"degrees", 33}});
        run("humanoid.target", {{"effector", "right_hand"}});
        wait(3);
        run("humanoid.target", {{"effector", "right_hand"}, {"weight", 0}});
    }
};

/// Of whatever object. Those of bones, effectors and nodes say that there is none of that name.
TEST_F(HumanoidScenes, WithAMemberThatThereIsNotAreRefused) {
    EXPECT_EQ(opened_with("", saved()), "");
    int objects = 0;
    const std::function<void(const std::string&, const Json&)> each = [&](const std::string& at,
                                                                          const Json& json) {
        if (at.ends_with("/world") || !json.is_structured()) return;
        if (json.is_object()) {
            std::string path = "labs.humanoid" + at;
            std::ranges::replace(path, '/', '.');
            const std::string why = opened_with(at + "/misspelt", 1);
            EXPECT_TRUE(why.starts_with(path) && why.find("misspelt") != why.npos) << path << ": " << why;
            ++objects;
        }
        for (const auto& [name, value] : json.items()) each(at + '/' + name, value);
    };
    each("", saved());
    EXPECT_GT(objects, 35);
}

TEST_F(HumanoidScenes, ThatWereBrokenAreRefusedWithThePlace) {
    const Json scene = saved();
    Json fewer = scene["attachments"]["list"], particles = scene["attachments"]["world"]["particles"];
    fewer.erase(0), particles.erase(0);
    const std::tuple<const char*, Json, const char*> faults[] = {
        {"/bones", {{"Tail", "Hips"}}, "no bone \"Tail\""},
        {"/bones", {{"Head", "Tail"}}, "labs.humanoid.bones.Head"},
        {"/clip/name", "run", "no clip \"run\""},
        {"/clip/time", 1e4, "labs.humanoid.clip.time"},
        {"/ik/targets/tail", 1, "no effector \"tail\""},
        {"/ik/targets/left_foot/position", {0, 1}, "labs.humanoid.ik.targets.left_foot.position"},
        {"/ik/targets/left_foot/rotation", {0, 0, 0, 0}, "length 1"},
        {"/ik/limits", "dreams", "labs.humanoid.ik.limits: expected one of defaults, motion, none"},
        {"/ik/body/turns/0", {0, 0, 0}, "labs.humanoid.ik.body.turns"},
        {"/ik/joint_limits", {{"Tail", "motion"}}, "there is no bone \"Tail\""},
        {"/ik/joint_limits", {{"Head", "dreams"}}, "unknown source of limits \"dreams\""},
        {"/ik/release/left", 1e9, "ik.release.left"},
        {"/ik/release/turns/fin", {0, 0, 0, 1}, "no node \"fin\""},
        {"/selected", {{"active", "Head"}}, "labs.humanoid.selected"},
        {"/selected", {{"all", {"Head"}}}, "labs.humanoid.selected"},
        {"/selected/all", {"Hips"}, "labs.humanoid.selected.active"},
        {"/selected/all/1", 1, "labs.humanoid.selected.all"},
        {"/springs/0/node", "wing", "no node \"wing\""},
        {"/springs/1/node", "antenna_l_3", "springs.1.node"},
        {"/curves/0/first", "wing", "no node \"wing\""},
        {"/curves/0/last", "Hips", "curves.0.last"},
        {"/curves/1", scene["curves"][0], "curves.1.first"},
        {"/curves/1/points", Json::array(), "curves.1.points"},
        {"/curves/1/points/0/1", "up", "curves.1.points.0"},
        {"/curves/1/jumped", 99, "curves.1.jumped"},
        {"/attachments/list/0/node", "Wing", "no node \"Wing\""},
        {"/attachments/list/0/name", "rope", "list.1.name: there is another \"rope\""},
        {"/attachments/list", fewer, "one body for each"},
        {"/attachments/list/1/pins/0/particle", 4000, "attachments.list.1.pins.0.particle"},
        {"/attachments/list/1/frame/turn", {0, 0, 0, 0}, "quaternion"},
        {"/attachments/list/1/shape/direction", {0, 2, 0}, "list.1.shape.direction"},
        {"/attachments/world/particles", particles, "attachments.world"}};
    for (const auto& [at, value, says] : faults) expect_scene_refused(at, value, says);
    EXPECT_EQ(opened_with("/curves/0/jumped", 2), "");
    run("humanoid.clip", {{"name", ""}});
    for (const Json& wrong : {Json("x"), Json::array(), Json(-1e300)}) {
        expect_scene_refused("/clip/time", wrong, "labs.humanoid.clip.time");
        expect_scene_refused("/clip/rounds", wrong, "labs.humanoid.clip.rounds");
    }
}

TEST_F(HumanoidFiles, AllFaultsAreFixedInOneStep) {
    run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/faulty_walk.bvh")}});
    run("humanoid.clip", {{"name", "motion"}});
    const HumanoidPart before = part();
    const std::size_t steps = workspace.history.size();
    run("humanoid.cure", Json::object());
    EXPECT_TRUE(report().findings.empty());
    EXPECT_EQ(workspace.history.size(), steps + 1);
    tells("motion 2 faults fixed none left");
    expect_refused("humanoid.cure", Json::object(), {"motion"});
    run("undo");
    EXPECT_TRUE(part() == before);
}

LABEL(slow, "HumanoidFiles.AllFaultsOfALongClipAreFixed");

/// The faulty walk, forwards and backwards until it is long.
TEST_F(HumanoidFiles, AllFaultsOfALongClipAreFixed) {
    const std::size_t length = tendril::test::is_thorough() ? 10'000 : 1'500;
    const std::string walk = test::read(tendril::test::source_path("tests/app/golden/faulty_walk.bvh"));
    const std::size_t count = walk.find("Frames:"), keys = walk.find('\n', walk.find("Frame Time:")) + 1;
    std::istringstream rest(walk.substr(keys));
    std::vector<std::string> frames;
    for (std::string line; std::getline(rest, line) && !line.empty();) frames.push_back(line + '\n');
    std::string text = walk.substr(0, count) + "Frames: " + std::to_string(length) +
                       walk.substr(walk.find('\n', count), keys - walk.find('\n', count));
    const std::size_t last = frames.size() - 1;
    for (std::size_t i = 0; i < length; ++i) text += frames[i / last % 2 == 0 ? i % last : last - i % last];
    test::write(path("long.bvh"), text);
    run("humanoid.load", {{"path", path("long.bvh")}});
    run("humanoid.clip", {{"index", 0}});
    const humanoid::LintReport before = lint(part().skeleton(), *part().map, *part().clip());
    EXPECT_GT(before.findings.size(), length / 125);
    run("humanoid.cure", Json::object());
    const humanoid::LintReport after = lint(part().skeleton(), *part().map, *part().clip());
    EXPECT_TRUE(after.findings.empty());
    EXPECT_TRUE(new_findings(before, after).empty());
}

LABEL(slow, "HumanoidFiles.AfterAllFixesTheRestIsExplained");

TEST_F(HumanoidFiles, AfterAllFixesTheRestIsExplained) {
    const auto robot = tendril::test::characters_folder() / "robot.glb";
    if (!std::filesystem::exists(robot)) GTEST_SKIP() << robot << " is not there";
    run("humanoid.load", {{"path", robot.string()}});
    run("humanoid.clip", {{"name", "Robot_Dance"}});
    run("view.fold", {{"section", "humanoid: Motion lint"}, {"folded", false}});
    const std::string text = test::PanelReader().panel(lab(), workspace);
    EXPECT_TRUE(test::says(text, "2 findings Fix all"));
    run("humanoid.cure", Json::object());
    tells("1 fault fixed 1 left Head limit no fix");
}

TEST_F(HumanoidFiles, FindingsNameANodeByItsBone) {
    run("humanoid.load", {{"path", faulty(true)}});
    run("humanoid.clip", {{"name", "walk"}});
    ASSERT_FALSE(report().findings.empty());
    run("view.fold", {{"section", "humanoid: Motion lint"}, {"folded", false}});
    const std::string text = test::PanelReader().panel(lab(), workspace);
    EXPECT_NE(text.find(", RightLowerLeg"), text.npos) << text;
    EXPECT_EQ(text.find(", Node_"), text.npos) << text;
}

// Bone maps corrected by the user: stored for a character's node names, offered again, never applied unasked.

namespace fs = std::filesystem;

class HumanoidKeptMaps : public HumanoidTest {
  protected:
    HumanoidKeptMaps() {
        workspace.config = config_.path();
        test::write(config_ / "figure.bvh", bvh_figure());
    }
    void load() { run("humanoid.load", {{"path", (config_ / "figure.bvh").string()}}); }
    Json kept() const { return state().at("character").at("kept_map"); }
    std::string left_hand() const { return bones().at("LeftHand").at("node"); }
    fs::path file() const { return kept_map(config_.path(), part().skeleton()); }
    void correct() { run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand end"}}); }

    test::TempFolder config_;
};

TEST_F(HumanoidKeptMaps, AreOfferedForTheSameNamesAndAppliedOnRequest) {
    load();
    correct();
    EXPECT_FALSE(fs::exists(file())) << "nothing is written without being told";
    run("humanoid.map.keep");
    EXPECT_TRUE(fs::exists(file()));
    EXPECT_TRUE(kept().is_null()) << "it is in use";
    load();
    EXPECT_EQ(left_hand(), "LeftHand") << "it is not taken unasked";
    EXPECT_EQ(kept(), Json({{"changes", {{"LeftHand", "LeftHand end"}}}}));
    run("humanoid.load");
    EXPECT_TRUE(kept().is_null()) << "the stick figure has other names";
    load();
    run("humanoid.map.use");
    EXPECT_EQ(left_hand(), "LeftHand end");
    EXPECT_TRUE(kept().is_null());
    run("undo");
    EXPECT_EQ(left_hand(), "LeftHand");
    EXPECT_FALSE(kept().is_null());
    run("humanoid.map.forget");
    EXPECT_TRUE(kept().is_null());
    EXPECT_FALSE(fs::exists(file()));
    expect_refused("humanoid.map.use", {}, {"no map is kept"});
    expect_refused("humanoid.map.forget", {}, {"no map is kept"});
}

TEST_F(HumanoidKeptMaps, AreKeptAutomaticallyInAWindow) {
    workspace.keeps = true;
    load();
    EXPECT_FALSE(fs::exists(file())) << "nothing is corrected";
    correct();
    EXPECT_EQ(find_kept_map(config_.path(), part().skeleton()), saved_map(*part().map, part().skeleton()));
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand"}});
    EXPECT_FALSE(fs::exists(file())) << "it is as it was matched";
    // A read-only folder does not prevent the correction.
    test::write(config_ / "no folder", "");
    workspace.config = config_ / "no folder";
    correct();
    EXPECT_EQ(left_hand(), "LeftHand end");
    EXPECT_TRUE(test::has(workspace.ui.toasts.back().text, "The bone map is not kept: cannot write"));
}

TEST_F(HumanoidKeptMaps, InvalidOnesAreSkippedWithAMessage) {
    load();
    correct();
    run("humanoid.map.keep");
    const std::string good = test::read(file());
    SavedMap other = read_map(file());
    other.bones[3] = "nobody";
    for (const std::string& bad : {std::string("{"), std::string(9000, '['), std::string(), map_text(other),
                                   std::string("{\"tendril\": \"bone map\", \"version\": 2}")}) {
        test::write(file(), bad);
        load();
        EXPECT_EQ(left_hand(), "LeftHand");
        EXPECT_TRUE(test::has(kept().at("refused").get<std::string>(), "the kept bone map is ignored: "));
        EXPECT_EQ(workspace.ui.toasts.back().text, kept().at("refused").get<std::string>());
        expect_refused("humanoid.map.use", {}, {"is ignored"});
    }
    test::write(file(), good);
    load();
    EXPECT_TRUE(kept().contains("changes"));
    workspace.config.clear();
    EXPECT_TRUE(kept().is_null());
    expect_refused("humanoid.map.keep", {}, {"no folder"});
}

}  // namespace
}  // namespace tendril::app
