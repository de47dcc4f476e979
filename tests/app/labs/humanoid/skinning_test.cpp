// How a character's skin follows twisted arms: a saved setting of the view that is not exported.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

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
    expect_refused("humanoid.view", {{"skinning", "dual_quaternion"}}, {"skinning", "twist_spread"});
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
