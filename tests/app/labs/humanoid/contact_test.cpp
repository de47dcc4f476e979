// Self-collision in the Humanoid lab: hands that a clip or target would move into the body stay outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

class HumanoidContacts : public HumanoidTest {
  protected:
    /// The depth of hands and lower arms in trunk and head as drawn, metres.
    double penetration() { return penetration(capsules()); }
    std::vector<humanoid::BodyCapsule> capsules() const {
        return humanoid::fitted_capsules(part().skeleton(), *part().map,
                                         skin_points(part().loaded->character.skin, part().loaded->rest));
    }
    double penetration(const std::vector<humanoid::BodyCapsule>& capsules) {
        const auto& placed = shown_pose(workspace).placed;
        double deepest = 0.0;
        for (const auto& arm : capsules) {
            using humanoid::Bone;
            if (arm.bone != Bone::LeftHand && arm.bone != Bone::RightHand && arm.bone != Bone::LeftLowerArm &&
                arm.bone != Bone::RightLowerArm)
                continue;
            for (const auto& other : capsules)
                if (other.bone <= Bone::Head)
                    deepest = std::max(
                        deepest, -gap(place(arm, *part().map, placed), place(other, *part().map, placed)));
        }
        return deepest;
    }
};

TEST_F(HumanoidContacts, WornObjectsAreKeptApart) {
    run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/body.glb")}});
    run("humanoid.self_collision", {{"on", true}});
    const std::vector<humanoid::BodyCapsule> capsules = humanoid_runtime(workspace).solvers.capsules(part());
    const auto usual = humanoid::default_capsules(part().skeleton(), *part().map);
    ASSERT_EQ(capsules.size(), usual.size());
    EXPECT_NE(capsules, usual);
    const Json before = state().at("character").at("nodes");
    run("humanoid.self_collision", {{"on", false}});
    EXPECT_EQ(state().at("character").at("nodes"), before) << "nothing is pushed at rest";
    run("humanoid.self_collision", {{"on", true}});
    for (int i = 0; i <= 60; ++i) {
        run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.1, 1.15, 0.5 - 0.01 * i}}});
        ASSERT_LT(penetration(capsules), 5e-3) << i;
    }
    // A fist through the waist and back, by hand IK.
    run("humanoid.target", {{"effector", "left_hand"}, {"weight", 0}});
    run("humanoid.hand_ik", {{"on", true}});
    for (int i = 0; i <= 120; ++i) {
        const double part_of_way = 0.5 - 0.5 * std::cos(2.0 * 3.14159265 * i / 120.0);
        run("humanoid.target", {{"effector", "right_hand"}, {"to", {-0.05, 1.12, 0.5 - 0.5 * part_of_way}}});
        tick();
        ASSERT_LT(penetration(capsules), 5e-3) << i;
    }
}

TEST_F(HumanoidContacts, SwitchedOffItLeavesNoTrace) {
    for (const char* command : {"humanoid.self_collision", "humanoid.balance"}) {
        workspace = make_blank_workspace(labs);
        run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.3, 1.3, 0.4}}});
        const Json before = state();
        run(command, {{"on", true}});
        run(command, {{"on", false}});
        EXPECT_EQ(state(), before) << command;
    }
}

}  // namespace
}  // namespace tendril::app
