// Saving and loading bone maps, exporting clips as shown, finding and fixing faults.
#include "app/io/character/export.hpp"
#include "app/io/character/map_file.hpp"
#include "app/io/character/read.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

class HumanoidFiles : public HumanoidTest {
  protected:
    std::string path(const char* name) const { return (folder_ / name).string(); }
    const humanoid::LintReport& report() {
        const humanoid::LintReport* const found = humanoid_runtime(workspace).lint.report(part());
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
    test::TempFolder folder_;
};

TEST_F(HumanoidFiles, AMapIsSavedAndLoaded) {
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand_End"}});
    run("humanoid.map.save", {{"path", path("map.json")}});
    EXPECT_EQ(read_map(path("map.json")).bones[static_cast<std::size_t>(Bone::LeftHand)], "LeftHand_End");
    run("humanoid.load");
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand");
    run("humanoid.map.load", {{"path", path("map.json")}});
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand_End");
    const Workspace other = reopened();
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        EXPECT_EQ(humanoid_part(other).map->bones[i].node, part().map->bones[i].node);
    EXPECT_EQ(save_scene(other), save_scene(workspace));
    run("undo");
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand");
}

TEST_F(HumanoidFiles, AMapOfAnotherCharacterIsRefused) {
    SavedMap map = saved_map(*part().map, part().skeleton());
    map.bones[0] = "mixamorig:Hips";
    test::write(path("map.json"), map_text(map));
    expect_refused("humanoid.map.load", {{"path", path("map.json")}}, {"Hips", "mixamorig:Hips"});
    expect_refused("humanoid.map.load", {{"path", path("none.json")}}, {"none.json"});
    expect_refused("humanoid.map.save", {}, {"path"});
    expect_refused("humanoid.map.save", {{"path", path("nowhere/map.json")}}, {"cannot write"});
}

TEST_F(HumanoidFiles, AClipIsExportedAsItCame) {
    for (const char* name : {"walk.glb", "walk.gltf", "walk.bvh"}) {
        run("humanoid.export", {{"path", path(name)}, {"clip", "punch"}});
        EXPECT_NEAR(read_character(path(name)).clips.at(0).duration, 1.2, 1e-6);
        EXPECT_NE(workspace.ui.toasts.back().text.find("worst joint"), std::string::npos);
    }
    run("humanoid.clip", {{"name", "walk"}});
    run("humanoid.export", {{"path", path("chosen.glb")}});
    EXPECT_EQ(read_character(path("chosen.glb")).clips.at(0).name, "walk");
    expect_refused("humanoid.export", {{"path", path("walk.fbx")}}, {"walk.fbx"});
    expect_refused("humanoid.export", {{"path", path("a.glb")}, {"clip", "run"}}, {"run"});
}

TEST_F(HumanoidFiles, AClipIsExportedWithWhatIkDoesToIt) {
    run("humanoid.ground", {{"kind", "stairs"}, {"step_height", 0.15}, {"step_depth", 0.3}});
    run("humanoid.foot_ik", {{"on", true}});
    run("humanoid.clip", {{"name", "walk"}, {"play", false}});
    run("humanoid.export", {{"path", path("stairs.glb")}});
    // Played from the start, the lab shows the file's poses frame by frame.
    const Character read = read_character(path("stairs.glb"));
    const humanoid::Clip& clip = read.clips.at(0);
    std::vector<rig::Transform> pose(read.skeleton.size());
    std::vector<humanoid::Placement> placed(read.skeleton.size());
    HumanoidPart shown = part();
    shown.playback = {.clip = 0, .loop = false};
    IkState state;
    double climbed = 0.0;
    for (int frame = 0; frame <= 66; ++frame) {
        shown.playback.time = std::min(frame / 60.0, clip.duration);
        const ShownPose seen =
            solve_pose(shown, humanoid_runtime(workspace).solvers, frame == 0 ? 0.0 : 1.0 / 60.0, state);
        sample(clip, read.skeleton, shown.playback.time, pose);
        place(read.skeleton, pose, placed);
        for (std::size_t i = 0; i < placed.size(); ++i)
            EXPECT_LT(glm::distance(placed[i].position, seen.placed[i].position), 1e-4) << frame;
        climbed = placed[0].position.y;
    }
    EXPECT_GT(climbed, 1.2);
}

TEST_F(HumanoidFiles, FaultsAreFoundAndMendedAndTheCuresAreSaved) {
    run("humanoid.load", {{"path", faulty()}});
    run("humanoid.clip", {{"name", "walk"}});
    ASSERT_EQ(report().findings.size(), 1u);
    EXPECT_EQ(report().findings[0].fault, humanoid::Fault::KneePop);
    EXPECT_EQ(report().findings[0].frame, 20u);
    expect_refused("humanoid.cure", {{"kind", "sign_flip"}}, {"walk"});
    expect_refused("humanoid.cure", {{"kind", "knee_pop"}, {"node", "Tail"}}, {"Tail"});
    expect_refused("humanoid.cure", {{"kind", "knee_pop"}, {"frame", 40}}, {"walk"});
    run("humanoid.cure", {{"kind", "knee_pop"}, {"node", "RightLowerLeg"}, {"frame", 20}});
    EXPECT_TRUE(report().findings.empty());
    const Workspace other = reopened();
    EXPECT_EQ(humanoid_part(other).loaded->clips(), part().loaded->clips());
    EXPECT_EQ(save_scene(other), save_scene(workspace));
    run("undo");
    EXPECT_EQ(report().findings.size(), 1u);
}

TEST_F(HumanoidFiles, AFootThatSlidesStandsAfterTheClick) {
    run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/faulty_walk.bvh")}});
    run("humanoid.clip", {{"name", "motion"}});
    ASSERT_EQ(report().findings.size(), 2u);
    EXPECT_EQ(report().findings[0].fault, humanoid::Fault::Skating);
    EXPECT_GT(report().skating, 0.05);
    run("humanoid.cure", {{"kind", "skating"}, {"node", "LeftFoot"}, {"frame", 7}});
    EXPECT_LT(report().skating, 0.02);
    run("humanoid.cure", {{"kind", "knee_pop"}});
    EXPECT_TRUE(report().findings.empty());
}

TEST_F(HumanoidFiles, FindingsCallANodeByItsBone) {
    run("humanoid.load", {{"path", faulty(true)}});
    run("humanoid.clip", {{"name", "walk"}});
    ASSERT_FALSE(report().findings.empty());
    run("view.fold", {{"section", "humanoid: Motion lint"}, {"folded", false}});
    const std::string text = test::PanelReader().panel(lab(), workspace);
    EXPECT_NE(text.find(", RightLowerLeg"), text.npos) << text;
    EXPECT_EQ(text.find(", Node_"), text.npos) << text;
}

TEST_F(HumanoidFiles, CleanClipsHaveNoFindings) {
    for (const char* name : {"walk", "punch"}) {
        run("humanoid.clip", {{"name", name}});
        EXPECT_TRUE(report().findings.empty()) << name;
    }
}

}  // namespace
}  // namespace tendril::app
