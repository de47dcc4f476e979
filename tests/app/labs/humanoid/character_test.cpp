// Loading a character, its bone map and its rest pose, by the lab's commands and --state.
#include <fstream>

#include "app/io/character/export.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"

namespace tendril::app {
namespace {

class HumanoidCharacter : public HumanoidTest {};

LABEL(slow, "HumanoidCharacter.ThatOthersMadeAreShownAsTheyStand");

TEST_F(HumanoidCharacter, IsTheStickFigureAtFirst) {
    const Json now = state();
    EXPECT_EQ(now.at("character").at("file"), "");
    EXPECT_EQ(now.at("character").at("rest"), "T");
    EXPECT_EQ(now.at("clips"), Json({"walk", "punch"}));
    EXPECT_TRUE(now.at("clip").is_null());
    EXPECT_EQ(now.at("character").at("bones").size(), humanoid::bone_count);
    EXPECT_TRUE(now.at("character").at("unmatched").empty());
    EXPECT_NEAR(node("HeadTop_End").y, 1.8, 1e-12);
    EXPECT_EQ(now.at("character").at("nodes")[1].at("parent"), "Hips");
    ASSERT_EQ(now.at("chains").size(), 7u);
    for (const Json& chain : now.at("chains")) {
        EXPECT_EQ(chain.at("bones").back(), chain.at("end"));
        EXPECT_EQ(chain.at("layer"), chain.at("end") == "Hips" ? 0
                                     : chain.at("end") == "LeftHand" || chain.at("end") == "RightHand" ||
                                             chain.at("end") == "Head"
                                         ? 2
                                         : 1)
            << chain;
    }
}

TEST_F(HumanoidCharacter, LoadsFromAFileWithItsOnlyClip) {
    const std::string path = write("figure.bvh", bvh_figure());
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    run("humanoid.load", {{"path", path}});
    const Json now = state();
    EXPECT_EQ(now.at("character").at("file"), path);
    EXPECT_DOUBLE_EQ(now.at("character").at("scale").get<double>(), 0.01);
    EXPECT_EQ(now.at("character").at("rest"), "A");
    EXPECT_EQ(now.at("clip").at("name"), "motion") << "the only one";
    EXPECT_TRUE(now.at("body").at("usable").get<bool>());
    EXPECT_NEAR(bone("Hips").y, 0.95, 1e-12);
    EXPECT_NEAR(bone("LeftHand").x, 0.53, 1e-12);
    EXPECT_TRUE(lab().moving(workspace)) << "it plays";
    run("humanoid.load");
    EXPECT_FALSE(part().clip()) << "of two clips, a user chooses one";
    run("undo");
    run("undo");
    EXPECT_EQ(state().at("clip").at("name"), "walk");
    EXPECT_EQ(state().at("character").at("file"), "");
}

TEST_F(HumanoidCharacter, WithoutAHandIsNotSolvedAndReportsIt) {
    run("humanoid.load", {{"path", write("figure.bvh", bvh_figure("LeftHand"))}});
    const Json now = state();
    // The node at the end of the forearm may be matched as the hand, but only with low confidence.
    if (now.at("body").at("usable").get<bool>()) {
        EXPECT_LT(now.at("character").at("bones").at("LeftHand").at("confidence").get<double>(), 0.8);
    } else {
        EXPECT_EQ(now.at("body").at("why_not"), "LeftHand is missing");
        EXPECT_TRUE(now.at("chains").empty());
    }
    run("humanoid.map", {{"bone", "LeftHand"}});
    EXPECT_EQ(state().at("body").at("why_not"), "LeftHand is missing");
    EXPECT_EQ(state().at("character").at("unmatched").front(), "UpperChest");
    run("humanoid.map", {{"bone", "RightHand"}});
    EXPECT_TRUE(test::says(state().at("body").at("why_not"), "LeftHand RightHand"));
}

TEST_F(HumanoidCharacter, KeepsThePresentOneIfAFileCannotBeRead) {
    expect_refused("humanoid.load", {{"path", "nowhere.glb"}}, {"nowhere.glb", "no such file"});
    expect_refused("humanoid.load", {{"path", write("a.obj", "v 0 0 0")}}, {"a.obj", ".bvh"});
    expect_refused("humanoid.load", {{"path", write("b.bvh", "HIERARCHY\nROOT")}}, {"b.bvh"});
    expect_refused("humanoid.load", {{"path", write("c.glb", "glTF")}}, {"c.glb"});
    expect_refused("humanoid.load", {{"path", ""}}, {"path is empty"});
}

TEST_F(HumanoidCharacter, HasTheBonesThatTheUserPicks) {
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand_End"}});
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand_End");
    EXPECT_EQ(bones().at("LeftHand").at("confidence"), 1.0);
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand"}});
    EXPECT_EQ(bones(), HumanoidLab().state(make_blank_workspace(labs)).at("character").at("bones"))
        << "as matched again";
    run("undo");
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand_End");
}

TEST_F(HumanoidCharacter, ANodeBelongsToASingleBone) {
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", "RightHand"}});
    EXPECT_EQ(bones().at("LeftHand").at("node"), "RightHand");
    EXPECT_FALSE(bones().contains("RightHand"));
    EXPECT_EQ(state().at("character").at("unmatched"), Json({"RightHand"}));
    expect_refused("humanoid.map", {{"bone", "LeftLowerArm"}, {"node", "LeftShoulder"}},
                   {"LeftLowerArm must be a node that is not above any of its parent bones"});
    expect_refused("humanoid.map", {{"bone", "LeftHand"}, {"node", "Tail"}}, {"no node \"Tail\""});
}

TEST_F(HumanoidCharacter, RestsInTPoseOnRequest) {
    run("humanoid.load", {{"path", write("figure.bvh", bvh_figure())}});
    run("humanoid.clip", {{"name", ""}});
    const glm::dvec3 shoulder = bone("LeftUpperArm"), leg = bone("LeftFoot");
    const double arm =
        glm::distance(shoulder, bone("LeftLowerArm")) + glm::distance(bone("LeftLowerArm"), bone("LeftHand"));
    run("humanoid.t_pose", {{"on", true}});
    EXPECT_LT(glm::distance(bone("LeftHand"), shoulder + glm::dvec3(arm, 0.0, 0.0)), 1e-9);
    EXPECT_LT(glm::distance(bone("RightHand"), bone("RightUpperArm") - glm::dvec3(arm, 0.0, 0.0)), 1e-9);
    EXPECT_LT(glm::distance(bone("LeftFoot"), leg), 1e-9);
    run("humanoid.clip", {{"index", 0}});
    EXPECT_NEAR(bone("LeftHand").x, 0.53, 1e-9) << "a clip is shown as it is";
    run("humanoid.clip", {{"name", ""}});
    run("humanoid.t_pose", {{"on", false}});
    for (const char* bone : {"LeftUpperArm", "RightUpperArm", "LeftUpperLeg", "RightUpperLeg"})
        run("humanoid.map", {{"bone", bone}});
    expect_refused("humanoid.t_pose", {{"on", true}}, {"no arm or leg is mapped"});
    run("humanoid.t_pose", {{"on", false}});
}

TEST_F(HumanoidCharacter, HasTheSizeOfItsUnit) {
    run("humanoid.load", {{"path", write("figure.bvh", bvh_figure())}});
    run("humanoid.scale", {{"metres", 0.0254}});
    EXPECT_NEAR(bone("Hips").y, 95 * 0.0254, 1e-9);
    run("humanoid.clip", {{"index", 0}, {"time", 0.5}});
    EXPECT_NEAR(bone("Hips").z, 50 * 0.0254, 1e-9);
    EXPECT_DOUBLE_EQ(state().at("character").at("scale").get<double>(), 0.0254);
    EXPECT_EQ(lab().state(reopened()), state());
    run("humanoid.load");
    expect_refused("humanoid.scale", {{"metres", 0.5}}, {"stick figure"});
}

TEST_F(HumanoidCharacter, StandsAlongTheAxisThatTheUserPicks) {
    run("humanoid.load", {{"path", write("figure.bvh", bvh_figure())}});
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand end"}});
    EXPECT_EQ(state().at("character").at("up"), "y");
    const glm::dvec3 hand = bone("RightHand");
    run("humanoid.up", {{"axis", "z"}});
    EXPECT_EQ(state().at("character").at("up"), "z");
    EXPECT_LT(glm::distance(bone("RightHand"), glm::dvec3(hand.x, hand.z, -hand.y)), 1e-12);
    EXPECT_EQ(bones().at("LeftHand").at("node"), "LeftHand end") << "corrections stay";
    run("humanoid.clip", {{"index", 0}, {"time", 0.5}});
    EXPECT_NEAR(bone("Hips").y, 0.5, 1e-12);
    run("humanoid.load");
    expect_refused("humanoid.up", {{"axis", "z"}}, {"stick figure"});
}

TEST_F(HumanoidCharacter, HasItsRootWhereTheFilePutsIt) {
    run("humanoid.load", {{"path", write("figure.bvh", bvh_figure())}});
    run("humanoid.clip", {{"index", 0}});
    EXPECT_EQ(state().at("character").at("root_positions"), "add");
    EXPECT_NEAR(bone("Hips").y, 0.95, 1e-12);
    run("humanoid.root", {{"positions", "replace"}});
    EXPECT_EQ(state().at("character").at("root_positions"), "replace");
    EXPECT_NEAR(bone("Hips").y, 0.0, 1e-12);
    EXPECT_EQ(lab().state(reopened()), state());
    run("undo");
    EXPECT_NEAR(bone("Hips").y, 0.95, 1e-12);
    std::string no_offset = bvh_figure();
    no_offset.replace(no_offset.find("0 95 0"), 6, "0 0 0");
    run("humanoid.load", {{"path", write("none.bvh", no_offset)}});
    EXPECT_TRUE(state().at("character").at("root_positions").is_null());
    expect_refused("humanoid.root", {{"positions", "add"}}, {"no root with both an OFFSET and positions"});
}

TEST_F(HumanoidCharacter, AnImplausibleHeightIsReportedWithTheUnitThatFixesIt) {
    Character giant = stick_figure();
    const humanoid::Clip clip = giant.clips[0];
    read_as(giant, 100.0, {});
    const std::string path = write("giant.glb", "");
    export_clip({giant, {}, clip, clip, 60.0}, path);
    run("humanoid.load", {{"path", path}});
    run("humanoid.clip", {{"name", ""}});
    const auto last_note = [&] {
        const Json notes = state().at("character").at("notes");
        return notes.empty() ? std::string() : notes.back().get<std::string>();
    };
    EXPECT_TRUE(test::says(last_note(), "180.00 m tall centimetres 1.80 m"));
    const auto doubt = part().loaded->doubted_unit(*part().map);
    ASSERT_TRUE(doubt);
    EXPECT_EQ(doubt->unit.metres, 0.01);
    run("humanoid.scale", {{"metres", doubt->unit.metres}});
    EXPECT_EQ(last_note(), "");
    EXPECT_NEAR(node("HeadTop_End").y, 1.8, 1e-5);
    for (const bool all : {false, true}) {
        run("humanoid.export", {{"path", (folder_ / (all ? "all.glb" : "one.glb")).string()}, {"all", all}});
        EXPECT_TRUE(test::says(workspace.ui.toasts.back().text, "keeps its unit read 1 m as 100 m"));
    }
    run("humanoid.load");
    EXPECT_EQ(last_note(), "");
}

TEST_F(HumanoidCharacter, ThatOthersMadeAreShownAsTheyStand) {
    const std::filesystem::path folder = tendril::test::characters_folder();
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending != ".glb" && ending != ".gltf" && ending != ".fbx" && ending != ".bvh") continue;
        ++read;
        run("humanoid.load", {{"path", entry.path().string()}});
        EXPECT_EQ(lab().state(reopened()), state()) << entry.path();
        for (std::size_t i = 0; i < part().loaded->clips().size(); ++i)
            run("humanoid.clip", {{"index", i}, {"play", true}});
        tick(3);
        EXPECT_EQ(lab().state(reopened()), state()) << entry.path();
    }
    EXPECT_GT(read, 5);
}

// How a character's skin follows twisted arms: a saved setting of the view that is not exported.

class HumanoidSkinning : public HumanoidTest {
  protected:
    HumanoidSkinning() {
        run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/body.glb")}});
        run("humanoid.clip", {{"name", "twist"}, {"time", 1}});
    }
    SkinDraw drawn() const {
        DrawList list;
        const Camera camera(lab().first_view(), {{0.0f, 0.0f}, {800.0f, 600.0f}});
        lab().draw({workspace, camera, palette(Theme::Dark)}, list);
        EXPECT_EQ(list.skins.size(), 1u);
        return list.skins.at(0);
    }
    /// The minimum distance of the forearm's vertices at the wrist from the arm's line, metres.
    static float girth(const SkinDraw& draw) {
        float least = 1.0f;
        for (std::size_t i = 0; i < draw.mesh->positions.size(); ++i) {
            const glm::vec3 at = draw.mesh->positions[i];
            if (at.x < 0.66f || at.x > 0.75f || std::hypot(at.y - 1.42f, at.z) < 0.01f) continue;
            const glm::vec3 now = skinned(draw, i);
            least = std::min(least, std::hypot(now.y - 1.42f, now.z));
        }
        return least;
    }
};

TEST_F(HumanoidSkinning, SpreadsTwistUnlessLinearBlendingIsChosen) {
    EXPECT_EQ(state().at("view").at("skinning"), "twist_spread");
    run("humanoid.clip", {{"time", 0}});
    const float untwisted = girth(drawn());
    run("humanoid.clip", {{"time", 1}});
    const float spread = girth(drawn());
    run("humanoid.view", {{"skinning", "linear"}});
    EXPECT_EQ(state().at("view").at("skinning"), "linear");
    EXPECT_EQ(drawn().weights, nullptr);
    EXPECT_LT(girth(drawn()), 0.6f * untwisted);
    EXPECT_GT(spread, 0.95f * untwisted);
    run("humanoid.view", {{"skin", "solid"}});
    EXPECT_EQ(state().at("view").at("skinning"), "linear");
    run("humanoid.view", {{"skinning", "twist_spread"}});
    EXPECT_EQ(girth(drawn()), spread);
}

TEST_F(HumanoidSkinning, FollowsTheBoneMap) {
    EXPECT_NE(drawn().weights, nullptr);
    for (const char* bone : {"LeftHand", "RightHand", "LeftLowerArm", "RightLowerArm"})
        run("humanoid.map", {{"bone", bone}, {"node", ""}});
    EXPECT_EQ(drawn().weights, nullptr) << "there is no arm to spread along";
    run("humanoid.load");
    run("undo");
    EXPECT_EQ(drawn().weights, nullptr);
}

}  // namespace
}  // namespace tendril::app
