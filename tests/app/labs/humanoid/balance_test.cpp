// Balance in the Humanoid lab: its switch, the panel's message, its file, its code and its picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <tendril/humanoid/balance.hpp>

#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class HumanoidBalanceLab : public HumanoidTest {
  protected:
    Json balance() { return state().at("body").at("balance"); }
    std::string text() { return balance().at("text").get<std::string>(); }
    double margin_now() {
        const ShownPose& shown = shown_pose(workspace);
        Solvers& solvers = humanoid_runtime(workspace).solvers;
        return humanoid::find_support(solvers.feet(part())->soles(), shown.soles)
            .margin(solvers.masses(part())->centre(shown.placed));
    }
    /// Drags a hand from its position, 2 cm at a time for a figure of 1.8 m.
    void drag(const char* effector, glm::dvec3 to) {
        const glm::dvec3 from =
            shown_pose(workspace)
                .placed[*part().node_of(humanoid::bone_of(*humanoid::effector_named(effector)))]
                .position;
        const double stride = 0.011 * part().loaded->height();
        const int steps = static_cast<int>(std::ceil(glm::distance(from, to) / stride)) + 1;
        for (int i = 1; i <= steps; ++i) {
            const glm::dvec3 at = glm::mix(from, to, static_cast<double>(i) / steps);
            run("humanoid.target", {{"effector", effector}, {"to", {at.x, at.y, at.z}}});
        }
    }
};

LABEL(slow, "HumanoidBalanceLab.CharactersThatOthersMadeStandNoWorseWithIt");

TEST_F(HumanoidBalanceLab, ThePanelSaysWhereTheCentreOfMassIs) {
    EXPECT_FALSE(balance().contains("text"));
    run("humanoid.balance", {{"on", true}});
    EXPECT_TRUE(test::says(text(), "cm inside the feet"));
    EXPECT_GT(balance().at("margin").get<double>(), 0.03);
    EXPECT_GE(balance().at("support").size(), 6u);
    const auto where = [&](glm::dvec3 by) {  // the margin of a body that is pulled along by its hips
        run("humanoid.target", {{"effector", "left_foot"}});
        run("humanoid.target", {{"effector", "right_foot"}});
        ShownPose shown = shown_pose(workspace);
        shown.balance->centre += by;
        shown.balance->margin = shown.balance->support.margin(shown.balance->centre);
        return balance_text(part(), shown, humanoid_runtime(workspace).solvers);
    };
    EXPECT_TRUE(test::says(where({0.0, 0.0, 0.3}), "cm ahead of the feet"));
    EXPECT_TRUE(test::says(where({0.0, 0.0, -0.3}), "cm behind the feet"));
    EXPECT_TRUE(test::says(where({0.4, 0.0, 0.0}), "cm left of the feet"));
    EXPECT_TRUE(test::says(where({-4.0, 0.0, 0.0}), "m right of the feet"));
}

TEST_F(HumanoidBalanceLab, TheGroundShowsTheSupportArea) {
    const std::size_t before = drawn().strokes.size();
    run("humanoid.balance", {{"on", true}});
    const std::size_t corners = balance().at("support").size();
    EXPECT_EQ(drawn().strokes.size(), before + corners + 3);  // the outline, a line and its two ends
}

TEST_F(HumanoidBalanceLab, AFootStepsWhileTheSimulationRuns) {
    run("humanoid.balance", {{"on", true}});
    const double ahead = node("LeftFoot").z;
    drag("right_hand", {-0.2, 1.0, 1.6});
    EXPECT_NEAR(std::max(node("LeftFoot").z, node("RightFoot").z), ahead, 0.03);  // no time has passed
    EXPECT_GT(shown_pose(workspace).residual(humanoid::Effector::RightHand).value(), 0.3);
    tick();
    tick();
    EXPECT_TRUE(balance().at("stepping").get<bool>());
    tick(8);
    const Workspace other = reopened();  // in the middle of a step
    EXPECT_EQ(humanoid_part(other).ik_state, part().ik_state);
    EXPECT_TRUE(test::says(lab().code(workspace),
                           "BodyOptions body_options .balance = true .feet = humanoid::FootShift"));
    tick(400);
    EXPECT_FALSE(balance().at("stepping").get<bool>());
    EXPECT_FALSE(lab().moving(workspace));
    EXPECT_LT(shown_pose(workspace).residual(humanoid::Effector::RightHand).value(), 0.03);
    EXPECT_TRUE(test::says(text(), "cm inside the feet"));
    EXPECT_GT(std::max(node("LeftFoot").z, node("RightFoot").z), ahead + 0.3);
    // Released, the feet step back.
    run("humanoid.target", {{"effector", "right_hand"}, {"weight", 0}});
    tick(400);
    EXPECT_FALSE(part().ik_state.steps.away());
    EXPECT_NEAR(node("RightFoot").z, ahead, 1e-6);
}

TEST_F(HumanoidBalanceLab, AStepIsNotAnIncident) {
    run("humanoid.balance", {{"on", true}});
    drag("right_hand", {-0.2, 1.0, 1.6});
    for (int i = 0; i < 400; ++i) {
        tick();
        const ShownPose& shown = shown_pose(workspace);
        if (part().ik_state.steps.stepping()) {
            EXPECT_EQ(text(), "stepping");
            EXPECT_EQ(balance_colour(part(), shown, palette(Theme::Dark)), palette(Theme::Dark).tail);
        } else {
            EXPECT_TRUE(test::says(text(), "inside the feet")) << i << ": " << text();
        }
    }
}

TEST_F(HumanoidBalanceLab, ItExplainsWhyItDoesNotAct) {
    const auto why = [&] { return balance().value("note", std::string()); };
    run("humanoid.balance", {{"on", true}});
    EXPECT_TRUE(test::says(why(), "acts once something has a target"));
    run("humanoid.target", {{"effector", "right_hand"}, {"to", {-0.2, 1.0, 0.5}}});
    EXPECT_EQ(why(), "");
    run("humanoid.hand_ik", {{"on", true}});
    EXPECT_TRUE(test::says(why(), "does not act hand IK moves the arms alone"));
    run("humanoid.target", {{"effector", "head"}});
    EXPECT_EQ(why(), "");
}

TEST_F(HumanoidBalanceLab, CharactersThatOthersMadeStandNoWorseWithIt) {
    const std::filesystem::path folder = test::characters_folder();
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    int read = 0, righted = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending != ".glb" && ending != ".gltf" && ending != ".fbx" && ending != ".bvh") continue;
        run("humanoid.load", {{"path", entry.path().string()}});
        run("humanoid.clip", {{"name", ""}});
        if (humanoid_runtime(workspace).solvers.masses(part()) == nullptr) continue;
        ++read;
        const humanoid::Facing facing = humanoid::facing(part().skeleton(), *part().map);
        const double height = part().loaded->height();
        const glm::dvec3 hand =
            shown_pose(workspace).placed[*part().node_of(humanoid::Bone::RightHand)].position;
        for (const auto& [ahead, left, up] :
             {std::array{0.5, 0.1, -0.1}, std::array{0.3, 0.0, -0.5}, std::array{0.1, -0.4, 0.0}}) {
            const glm::dvec3 to =
                hand + height * (ahead * facing.forward + left * facing.left + glm::dvec3(0.0, up, 0.0));
            std::array<double, 2> margins{};
            for (const bool on : {false, true}) {
                run("humanoid.balance", {{"on", on}, {"steps", false}});
                drag("right_hand", to);
                margins[on ? 1 : 0] = margin_now() / height;
                run("humanoid.target", {{"effector", "right_hand"}, {"weight", 0}});
            }
            EXPECT_GT(margins[1], std::min(margins[0], 0.0) - 0.005)
                << entry.path() << ": " << ahead << ' ' << left << ' ' << up;
            if (margins[0] < 0.0 && margins[1] > 0.0) ++righted;
        }
    }
    EXPECT_GT(read, 5);
    EXPECT_GT(righted, 5);
}

}  // namespace
}  // namespace tendril::app
