// Several selected nodes of a character: by command, and edits of all of them.
#include <imgui_internal.h>

#include <set>

#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "humanoid_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using Names = std::vector<std::string>;

class HumanoidSelection : public HumanoidTest {
  protected:
    void select(const Names& nodes) { run("humanoid.select", {{"nodes", nodes}}); }
    /// The selected nodes in alphabetical order.
    Names selected() const {
        Names names = names_of(part().selection, part().skeleton());
        std::sort(names.begin(), names.end());
        return names;
    }
    std::string active() const { return state().at("selected"); }
    std::string inspector() { return reader_.inspector(lab(), workspace); }
    void expect_says(const std::string& text, const Names& all) {
        for (const std::string& each : all)
            EXPECT_NE(text.find(each), std::string::npos) << each << " is not in:\n" << text;
    }
    LimitsFrom from(Bone bone) const { return part().ik.limits_of(bone); }

    test::PanelReader reader_;
};

TEST_F(HumanoidSelection, AddsRemovesAndListsTheFirstEight) {
    select({"LeftHand", "RightFoot"});
    run("humanoid.select", {{"nodes", {"Head", "Hips"}}, {"add", true}});
    EXPECT_EQ(selected(), (Names{"Head", "Hips", "LeftHand", "RightFoot"})) << "by name";
    EXPECT_EQ(active(), "Hips") << "the last one";
    run("humanoid.select", {{"node", "Head"}, {"add", true}});
    run("humanoid.select", {{"add", true}});
    EXPECT_EQ(selected(), (Names{"Hips", "LeftHand", "RightFoot"})) << "added again, it goes";
    EXPECT_EQ(state().at("selection").size(), 3u);
    select({"Hips", "Spine", "Head", "LeftHand", "RightHand", "LeftFoot", "RightFoot", "LeftLowerArm",
            "RightLowerArm", "LeftLowerLeg"});
    expect_says(inspector(), {" and 2 more"});
    run("humanoid.select");
    EXPECT_TRUE(selected().empty());
    EXPECT_EQ(active(), "");
}

TEST_F(HumanoidSelection, OtherNamesAreRefusedAndChangeNothing) {
    select({"Head", "Hips"});
    expect_refused("humanoid.select", {{"nodes", {"Head", "Tail"}}}, {"Tail"});
    expect_refused("humanoid.select", {{"nodes", {"Head", 3}}}, {"nodes", "3"});
    expect_refused("humanoid.select", {{"node", "Head"}, {"nodes", Json::array({"Hips"})}},
                   {"needs either node or nodes"});
    expect_refused("humanoid.limits", {{"from", "none"}, {"bones", {"Head", "Tail"}}}, {"Tail"});
    expect_refused("humanoid.limits", {{"from", "none"}, {"bones", {"Head", "Hips"}}},
                   {"the Hips joint has no limits"});
    expect_refused("humanoid.limits", {{"from", "none"}, {"bones", Json::array({nullptr})}},
                   {"bones", "null"});
    expect_refused("humanoid.limits", {{"from", "none"}, {"bones", Json::array()}}, {"bones is empty"});
    expect_refused("humanoid.limits", {{"from", "none"}, {"bone", "Head"}, {"bones", Json::array({"Neck"})}},
                   {"needs either bone or bones"});
    expect_refused("humanoid.spring", {{"nodes", {"HeadTop_End", "LeftHand"}}}, {"LeftHand"});
    expect_refused("humanoid.spring", {{"nodes", Json::array()}}, {"nodes is empty"});
    expect_refused("humanoid.spring", {{"strength", 2}}, {"needs either node or nodes"});
}

TEST_F(HumanoidSelection, ALimitIsSetOnAllAboutTheirOwnAxes) {
    const Names arms{"LeftUpperArm", "RightUpperArm", "LeftLowerArm"};
    const humanoid::BodyLimits adult = humanoid::default_limits(part().skeleton(), *part().map);
    const humanoid::BodyLimits clips =
        humanoid::learned_limits(part().skeleton(), *part().map, part().loaded->clips(), adult);
    run("humanoid.limits", {{"from", "motion"}, {"bones", arms}});
    humanoid::Body* const body = humanoid_runtime(workspace).solvers.body(part());
    for (const std::string& name : arms) {
        const Bone bone = *humanoid::bone_named(name);
        const auto at = static_cast<std::size_t>(bone);
        EXPECT_EQ(from(bone), LimitsFrom::Motion);
        EXPECT_EQ(body->joints().limit(bone), clips[at]) << name;
        EXPECT_NE(clips[at], adult[at]) << name;
    }
    EXPECT_NE(clips[static_cast<std::size_t>(Bone::LeftUpperArm)],
              clips[static_cast<std::size_t>(Bone::RightUpperArm)])
        << "a range of its own each";
    EXPECT_EQ(from(Bone::RightLowerArm), LimitsFrom::Defaults);
    EXPECT_EQ(part().ik.joint_limits.size(), 3u);
    EXPECT_EQ(lab().state(reopened()).at("body"), state().at("body"));
    run("undo");
    EXPECT_TRUE(part().ik.joint_limits.empty()) << "one step for all";
}

TEST_F(HumanoidSelection, TheInspectorShowsTheNumberAndTheActiveOne) {
    select({"LeftUpperArm", "RightUpperArm", "Head"});
    expect_says(inspector(),
                {"3", "Showing Head.", "Limits of 3 joints", "Showing Head; changes apply to all."});
    run("humanoid.limits", {{"from", "none"}, {"bone", "LeftUpperArm"}});
    expect_says(inspector(), {"They differ. Showing Head"});
    // The active one has no limits: another is shown, here and in --state.
    select({"LeftUpperArm", "RightUpperArm", "Hips"});
    expect_says(inspector(), {"Showing Hips.", "1 selected node has no limits.", "Limits of 2 joints",
                              "Showing RightUpperArm; changes apply"});
    EXPECT_EQ(state().at("body").at("joint").at("bone"), "RightUpperArm");
    select({"Hips", "HeadTop_End"});
    EXPECT_EQ(inspector().find("Limits of"), std::string::npos);
    EXPECT_TRUE(state().at("body").at("joint").is_null());
    EXPECT_EQ(lab().gizmo(workspace)->name, "hips") << "the last that it can drag";
    select({"Spine", "HeadTop_End"});
    EXPECT_FALSE(lab().gizmo(workspace));
    select({"LeftHand", "RightHand"});
    EXPECT_EQ(lab().gizmo(workspace)->name, "right_hand") << "of several, on the last one";
    select({"LeftHand"});
    EXPECT_TRUE(lab().gizmo(workspace));
    EXPECT_EQ(inspector().find("set on all"), std::string::npos);
}

/// The number of strengths of the selection colour behind rows.
TEST_F(HumanoidSelection, SelectedRowsOfTheBoneMapAreHighlighted) {
    const auto filled = [&](glm::vec3 colour) {
        const ImU32 wanted = ImGui::ColorConvertFloat4ToU32({colour.r, colour.g, colour.b, 0.0f});
        const ImGuiWindow* const window = ImGui::FindWindowByName("panel");
        std::set<ImU32> strengths;
        for (const ImDrawVert& each : window->DrawList->VtxBuffer) {
            const ImU32 alpha = each.col >> IM_COL32_A_SHIFT;
            if ((each.col & ~IM_COL32_A_MASK) == wanted && alpha > 40 && alpha < 128) strengths.insert(alpha);
        }
        return strengths.size();
    };
    const glm::vec3 colour = palette(workspace.settings.theme).selection;
    run("view.fold", {{"section", "humanoid: Bones"}, {"folded", false}});
    reader_.panel(lab(), workspace);
    EXPECT_EQ(filled(colour), 0u);
    select({"LeftHand"});
    reader_.panel(lab(), workspace);
    EXPECT_EQ(filled(colour), 1u);
    select({"LeftHand", "RightHand"});
    reader_.panel(lab(), workspace);
    EXPECT_EQ(filled(colour), 2u) << "the active one stronger";
}

TEST_F(HumanoidSelection, AllAreMarkedAndTheActiveOneMost) {
    const auto share = [&](const char* node) {
        const DrawList list = drawn({.target = {0.0f, 0.9f, 0.0f}, .distance = 3.6f});
        const auto pick = static_cast<PickId>(*part().skeleton().find(node));
        for (const Stroke& each : list.strokes)
            if (each.pick == pick && each.shade != Shade::Ring)
                return glm::distance(glm::vec3(each.colour), palette(Theme::Dark).selection);
        ADD_FAILURE() << node << " is not drawn";
        return 0.0f;
    };
    select({"LeftHand", "RightHand"});
    EXPECT_LT(share("RightHand"), share("LeftHand"));
    EXPECT_LT(share("LeftHand"), share("Head"));
}

TEST_F(HumanoidSelection, SpringsAreSetOnAll) {
    run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/antennae.bvh")}});
    // The body, and nodes below another selected node, get none.
    select({"Head", "antenna_l_1", "antenna_l_3", "antenna_r_2", "tail_1"});
    const auto names = [&](const std::vector<std::size_t>& nodes) {
        Names all;
        for (const std::size_t node : nodes) all.push_back(part().skeleton()[node].name);
        std::sort(all.begin(), all.end());
        return all;
    };
    EXPECT_EQ(names(selected_for_springs(part())), (Names{"antenna_l_1", "antenna_r_2", "tail_1"}));
    expect_says(inspector(), {"Put on springs"});
    run("humanoid.spring", {{"nodes", names(selected_for_springs(part()))}});
    ASSERT_EQ(part().springs.size(), 3u);
    EXPECT_TRUE(selected_for_springs(part()).empty());
    run("humanoid.spring", {{"node", "tail_1"}, {"strength", 0.8}});
    EXPECT_EQ(selected_springs(part()), (std::vector<std::size_t>{0, 1, 2}));
    expect_says(inspector(), {"3 springs selected", "They differ. Showing the one from tail_1 down"});
    select({"antenna_l_3", "antenna_r_2", "Head"});
    EXPECT_EQ(selected_springs(part()).size(), 2u);
    expect_says(inspector(), {"2 springs selected", "Showing the one from antenna_r_2 down; changes"});
    run("humanoid.spring", {{"nodes", {"antenna_l_1", "antenna_r_2"}}, {"weight", 0.25}});
    for (const SpringSetting& each : part().springs)
        EXPECT_EQ(each.options.weight, each.node == "tail_1" ? 1.0 : 0.25) << each.node;
    run("undo");
    for (const SpringSetting& each : part().springs)
        EXPECT_EQ(each.options.weight, 1.0) << "one step for all";
    run("humanoid.spring", {{"nodes", {"antenna_l_1", "antenna_r_2", "tail_1"}}, {"on", false}});
    EXPECT_TRUE(part().springs.empty());
}

TEST_F(HumanoidSelection, IsRestoredFromAFile) {
    select({"Head", "LeftFoot", "HeadTop_End"});
    EXPECT_EQ(humanoid_part(reopened()).selection, part().selection);
    const auto loaded = [&](const Json& json) {
        Json scene = save_scene(workspace);
        scene.at("labs").at(humanoid_lab)["selected"] = json;
        Workspace other = make_blank_workspace(labs);
        load_scene(other, scene);
        return names_of(humanoid_part(other).selection, humanoid_part(other).skeleton());
    };
    EXPECT_EQ(loaded("Head"), Names{"Head"}) << "as older files have it";
    EXPECT_TRUE(loaded("").empty());
    EXPECT_TRUE(loaded(nullptr).empty());
    EXPECT_TRUE(loaded("Tail").empty()) << "another character lies where that of the scene was";
    EXPECT_EQ(loaded({{"active", "Tail"}, {"all", {"Head", "Tail"}}}), Names{"Head"});
}

TEST_F(HumanoidSelection, OnAnotherCharacterExistingNodesStaySelected) {
    select({"HeadTop_End", "LeftHand", "Head"});
    const Selection before = part().selection;
    run("humanoid.load", {{"path", write("figure.bvh", bvh_figure())}});
    for (const std::string& name : selected()) EXPECT_TRUE(name == "Head" || name == "LeftHand") << name;
    EXPECT_EQ(selected().size(), 2u);
    EXPECT_EQ(active(), "Head");
    run("undo");
    EXPECT_EQ(part().selection, before);
    run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/antennae.bvh")}});
    select({"antenna_l_1", "tail_1"});
    run("humanoid.load");
    EXPECT_TRUE(selected().empty());
    EXPECT_EQ(active(), "");
}

TEST_F(HumanoidSelection, PersistsThroughTimeAndOtherCharacters) {
    const auto then = std::make_shared<HumanoidPart>(part());
    select({"Head", "LeftHand"});
    const auto shown = part().at_moment(then);
    EXPECT_EQ(dynamic_cast<const HumanoidPart&>(*shown).selection, part().selection);
    const HumanoidPart other(load_character(tendril::test::source_path("tests/app/golden/antennae.bvh")));
    HumanoidPart now = other;
    now.selection.take({*now.skeleton().find("Head"), *now.skeleton().find("tail_1")}, false);
    const auto earlier = now.at_moment(then);
    const auto& figure = dynamic_cast<const HumanoidPart&>(*earlier);
    EXPECT_EQ(names_of(figure.selection, figure.skeleton()), Names{"Head"});
}

}  // namespace
}  // namespace tendril::app
