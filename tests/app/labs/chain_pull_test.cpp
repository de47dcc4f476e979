// Several joints dragged at once by one gizmo: each follows as far as the bones allow, lengths and limits are
// kept, and one undo step reverts it.
#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/random_numbers.hpp"

namespace tendril::app {
namespace {

class ChainPull : public ChainTest, protected test::RandomNumbers {
  protected:
    ChainPull() : RandomNumbers(11) {}

    glm::vec3 joint(std::size_t i) const { return part().chain.position(i); }
    std::size_t tip() const { return part().chain.size() - 1; }

    /// Bones of random lengths in random directions.
    void random_chain(std::size_t bones) {
        run("chain.clear");
        glm::dvec3 at(0.0);
        for (std::size_t i = 0; i <= bones; ++i) {
            const double length = i == 0 ? 1.0 : uniform(0.3, 1.0);
            run("chain.add", {{"length", length}, {"position", {at.x, at.y, at.z}}});
            at += 0.8 * direction() + glm::dvec3(0.4, 0.0, 0.0);
        }
    }
    std::vector<std::size_t> some_joints(bool with_root) {
        std::vector<std::size_t> joints;
        for (std::size_t i = 0; i <= tip(); ++i)
            if (i == 0 ? with_root : random() % 2 == 0) joints.push_back(i);
        return joints;
    }
    void pull(const std::vector<std::size_t>& joints, const std::vector<glm::vec3>& to) {
        Json points = Json::array();
        for (const glm::vec3& each : to) points.push_back(point(each));
        run("chain.pull", {{"joints", joints}, {"points", points}});
    }
    void expect_lengths_kept() const {
        for (std::size_t i = 1; i <= tip(); ++i)
            EXPECT_NEAR(glm::distance(joint(i), joint(i - 1)), part().chain.length(i), 1e-4f) << i;
    }
};

TEST_F(ChainPull, AllFollowMovesAndRotationsInEveryMode) {
    for (int round = 0; round < 150; ++round) {
        random_chain(3 + random() % 9);
        const auto modes = chain_modes.names();
        const std::string mode = modes[static_cast<std::size_t>(round) % modes.size()];
        if (mode == "curve") continue;  // there the control points move the joints
        run("chain.mode", {{"mode", mode}});
        // In mode Reach the root stays unless it is dragged too: then all joints can follow.
        const auto joints = some_joints(mode == "reach");
        if (joints.size() < 2) continue;
        const std::vector<glm::vec3> before = positions(part().chain);
        const glm::vec3 by = 2.0f * glm::vec3(direction()), about = before[joints.front()];
        const bool turns = round % 3 == 0;
        const glm::quat turn =
            turns ? glm::angleAxis(static_cast<float>(uniform(0.1, 1.0)), glm::vec3(direction()))
                  : glm::quat(1, 0, 0, 0);
        std::vector<glm::vec3> to;
        for (const std::size_t i : joints) to.push_back(about + by + turn * (before[i] - about));
        pull(joints, to);
        for (std::size_t k = 0; k < joints.size(); ++k)
            EXPECT_LT(glm::distance(joint(joints[k]), to[k]), 2e-3f) << mode << " " << joints[k];
        expect_lengths_kept();
        // The joints between them keep their shape.
        for (std::size_t i = joints.front(); !turns && i <= joints.back(); ++i)
            EXPECT_LT(glm::distance(joint(i), before[i] + by), 2e-3f) << mode << " " << i;
    }
}

TEST_F(ChainPull, InReachRootAndTargetStayAndTheTipStaysOnTheTarget) {
    reach_with(9);
    run("chain.target", {{"to", {4, 3, 1}}});
    const glm::vec3 a = joint(3), b = joint(5), by = -0.15f * a;
    pull({3, 5}, {a + by, b + by});
    EXPECT_EQ(joint(0), glm::vec3(0.0f));
    EXPECT_EQ(part().target, glm::vec3(4, 3, 1));
    EXPECT_LT(glm::distance(joint(3), a + by), 1e-3f);
    EXPECT_LT(glm::distance(joint(5), b + by), 1e-3f);
    EXPECT_LT(tip_distance(), 1e-2f);
    expect_lengths_kept();
}

TEST_F(ChainPull, JointsOutOfReachGetAsNearAsTheBonesAllow) {
    reach_with(6);
    pull({2, 4}, {{0, 5, 0}, {0, 9, 0}});
    EXPECT_NEAR(joint(2).y, 2.0f, 1e-3f);
    EXPECT_NEAR(joint(4).y, 4.0f, 1e-3f);
    expect_lengths_kept();
    run("chain.mode", {{"mode", "forward"}});
    pull({2, 4}, {{0, 5, 0}, {0, 9, 0}});
    EXPECT_EQ(joint(2), glm::vec3(0, 5, 0)) << "nothing holds the first one back";
    EXPECT_NEAR(joint(4).y, 7.0f, 1e-3f);
    EXPECT_EQ(part().target, glm::vec3(0, 5, 0));
    expect_lengths_kept();
}

TEST_F(ChainPull, LimitsHoldBetweenAndBeyondThem) {
    for (int round = 0; round < 20; ++round) {
        reach_with(8);
        cones(1, 8, 40);
        run("chain.target", {{"to", {5, 3, 0.5}}});
        const glm::vec3 by = 0.8f * glm::vec3(direction());
        pull({2, 3, 6}, {joint(2) + by, joint(3) + by, joint(6) + by});
        for (std::size_t i = 1; i < 8; ++i) {
            const glm::vec3 in = glm::normalize(joint(i) - joint(i - 1)),
                            out = glm::normalize(joint(i + 1) - joint(i));
            EXPECT_LE(glm::degrees(std::acos(std::min(1.0f, glm::dot(in, out)))), 40.1f) << i;
        }
        EXPECT_EQ(joint(0), glm::vec3(0.0f));
        expect_lengths_kept();
    }
}

TEST_F(ChainPull, TheirOrderDoesNotMatterAndOneStepUndoesIt) {
    reach_with(6);
    const Json before = save_scene(workspace);
    const std::size_t steps = workspace.history.size();
    pull({4, 1, 3}, {{2, 2, 0}, {0.5, 1, 0}, {1.5, 2, 0.5}});
    const auto once = positions(part().chain);
    EXPECT_EQ(workspace.history.size(), steps + 1);
    run("undo");
    EXPECT_EQ(save_scene(workspace), before);
    pull({1, 3, 4}, {{0.5, 1, 0}, {1.5, 2, 0.5}, {2, 2, 0}});
    EXPECT_EQ(positions(part().chain), once);
}

TEST_F(ChainPull, BadListsAreRefusedWithTheReason) {
    reach_with(3);
    const Json two{{1, 0, 0}, {2, 0, 0}};
    const auto says = [&](const Json& arguments, const char* why) { refuses("chain.pull", arguments, why); };
    says(Json::object(), "needs either index or joints");
    says({{"index", 1}}, "index needs the argument to");
    says({{"index", 9}, {"to", {0, 0, 0}}}, "9");
    says({{"index", 1}, {"joints", {1}}, {"to", {0, 0, 0}}}, "needs either index or joints");
    says({{"index", 1}, {"to", {0, 0, 0}}, {"points", two}}, "points is for joints");
    says({{"joints", {1, 2}}}, "joints needs points");
    says({{"joints", {1, 2}}, {"to", {0, 0, 0}}}, "to is for index");
    says({{"joints", {1, 2}}, {"points", {{1, 0, 0}}}}, "points");
    says({{"joints", {1, 1}}, {"points", two}}, "joints: 1 is listed twice");
    says({{"joints", {1, 7}}, {"points", two}}, "7 is out of range");
    says({{"joints", {1, 2}}, {"points", {{1, 0, 0}, {2, "x", 0}}}}, "points.1");
    says({{"joints", Json::array()}, {"points", Json::array()}}, "joints is empty");
}

TEST_F(ChainPull, TheGizmoOfSeveralDragsThemAndStopsTheTarget) {
    reach_with(6);
    run("chain.motion", {{"path", "circle"}});
    run("chain.select", {{"joints", {2, 4}}});
    const auto shown = lab().gizmo(workspace);
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->name, "segment.4");
    EXPECT_TRUE(has(shown->drag, Drag::Position));
    EXPECT_TRUE(has(shown->drag, Drag::Rotation));
    auto handles = lab().together(workspace, Drag::Position).handles;
    ASSERT_EQ(handles.size(), 2u);
    for (Handle& each : handles) each.frame.position += glm::vec3(-0.5f, 0.5f, 0);
    emit([&](Emit& to) { lab().drag_together(workspace, handles, to); }, 7);
    EXPECT_EQ(part().motion.path, Motion::Path::Still);
    EXPECT_NEAR(joint(2).y, 0.5f, 1e-3f);
    EXPECT_NEAR(joint(4).y, 0.5f, 1e-3f);
    for (int i = 0; i < 3; ++i) run("chain.remove", {{"index", 4}});
    Emit left;
    lab().drag_together(workspace, handles, left);
    EXPECT_EQ(left.take().size(), 1u) << "what is left of them";
    run("chain.select", {{"index", 2}});
    EXPECT_TRUE(lab().together(workspace, Drag::Position).handles.empty());
    run("chain.select", {{"joints", {1, 2}}});
    run("microscope.open");
    EXPECT_FALSE(lab().gizmo(workspace)) << "what is studied stays";
}

}  // namespace
}  // namespace tendril::app
