// Several joints dragged at once by one gizmo: each follows as far as the bones allow, lengths and limits are
// kept, and one undo step reverts it.
#include <glm/trigonometric.hpp>

#include "app/labs/chain/chain_part.hpp"
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

// The pole's memory in the program: while the target crosses the line through root and pole, joints stay
// within their speed limit; across saving and loading, undo and redo, and with any runtime of the lab.

constexpr float radius = 3.0f;           ///< metres, of the target's arc about the root
constexpr float from = 0.2f, to = 0.7f;  ///< radians; the pole (2, 1, 0) is at 0.46

/// Target positions, `step` metres of arc apart.
std::vector<glm::vec3> arc(float step) {
    std::vector<glm::vec3> points;
    for (int i = 0; from + static_cast<float>(i) * step / radius < to; ++i) {
        const float angle = from + static_cast<float>(i) * step / radius;
        points.push_back(radius * glm::vec3(std::cos(angle), std::sin(angle), 0.0f));
    }
    return points;
}

float furthest_move(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    float furthest = 0.0f;
    for (std::size_t i = 0; i < a.size(); ++i) furthest = std::max(furthest, glm::distance(a[i], b[i]));
    return furthest;
}

class ChainPole : public ChainTest {
  protected:
    void start(int bones, bool limited = false) {
        reach_with(bones);
        if (limited) cones(0, bones, 100, {{"twist_min_deg", -180}, {"twist_max_deg", 180}});
        run("chain.target", {{"to", point(arc(0.025f).front())}});
        run("chain.pole", {{"to", {2, 1, 0}}});
    }
    void reach(glm::vec3 target) { run("chain.target", {{"to", point(target)}}); }
    /// The maximum ratio of a joint's motion to the target's in a tick.
    float worst_ratio(float step) {
        float worst = 0.0f;
        const std::vector<glm::vec3> path = arc(step);
        std::vector<glm::vec3> before = positions(part().chain);
        for (std::size_t i = 1; i < path.size(); ++i) {
            reach(path[i]);
            std::vector<glm::vec3> now = positions(part().chain);
            worst = std::max(worst, furthest_move(before, now) / glm::distance(path[i], path[i - 1]));
            before = std::move(now);
        }
        return worst;
    }
};

TEST_F(ChainPole, ATargetThatCrossesItsLineMovesNoJointOver50TimesAsFar) {
    for (const float step : {0.025f, 0.0005f}) {
        start(6);
        EXPECT_LT(worst_ratio(step), 50.0f) << "steps of " << step << " m";
    }
}

TEST_F(ChainPole, ContinuesFromASavedSceneWithTheSameBits) {
    for (const bool limited : {false, true}) {
        start(6, limited);
        const std::vector<glm::vec3> path = arc(0.025f);
        Workspace other = make_blank_workspace(labs);
        for (std::size_t i = 0; i < path.size(); ++i) {
            reach(path[i]);
            // The other workspace was saved, closed and opened before each step.
            if (i > 0) {
                table.run(other, "chain.target", {{"to", point(path[i])}});
                ASSERT_EQ(save_scene(other), save_scene(workspace)) << "step " << i;
            }
            Workspace opened = make_blank_workspace(labs);
            load_scene(opened, parse_json(json_to_text(save_scene(workspace))));
            other = opened;
        }
    }
}

/// A typical session in mode Reach, with and without limits, with dragged joints and studies.
void play_session(const CommandTable& table, Workspace& workspace, const Labs& labs,
                  const std::function<void()>& after_each) {
    const auto run = [&](const char* name, Json arguments = Json::object()) {
        table.run(workspace, name, arguments);
        after_each();
    };
    run("chain.preset", {{"name", "start"}, {"count", 7}});
    run("chain.mode", {{"mode", "reach"}});
    run("chain.target", {{"to", point(arc(0.025f).front())}});
    run("chain.pole", {{"to", {2, 1, 0}}});
    for (const glm::vec3& target : arc(0.05f)) run("chain.target", {{"to", point(target)}});
    run("chain.pull", {{"index", 3}, {"to", {1, 1, 1}}});
    run("chain.target", {{"to", {2, 2, 1}}});
    run("chain.limit", {{"index", 2}, {"kind", "hinge"}, {"axis", {0, 0, 1}}, {"max_deg", 100}});
    run("chain.limit", {{"index", 4}, {"kind", "saddle"}});
    for (const glm::vec3& target : arc(0.1f)) run("chain.target", {{"to", point(target)}});
    run("chain.pull", {{"index", 4}, {"to", {2, 1, 1}}});
    run("chain.insert", {{"index", 2}, {"length", 0.5}});
    run("chain.target", {{"to", {1, 3, 0}}});
    run("chain.set_length", {{"index", 3}, {"length", 1.5}});
    run("chain.target", {{"to", {1, 2.5, 1}}});
    run("microscope.open");
    run("chain.target", {{"to", {2, 2.5, 1}}});
    run("microscope.close");
    run("chain.solver", {{"name", "dls"}});
    run("chain.motion", {{"path", "circle"}});
    for (int tick = 0; tick < 20; ++tick) {
        labs.find(chain_lab)->step(workspace);
        after_each();
    }
    run("undo");
    run("chain.target", {{"to", {2, 1, -1}}});
}

TEST_F(ChainPole, NoBitDependsOnTheRuntime) {
    std::vector<Json> kept, thrown_away;
    play_session(table, workspace, labs, [&] { kept.push_back(save_scene(workspace)); });
    Workspace other = make_blank_workspace(labs);
    play_session(table, other, labs, [&] {
        other.runtimes.clear();
        thrown_away.push_back(save_scene(other));
    });
    EXPECT_TRUE(kept == thrown_away) << "after command "
                                     << std::ranges::mismatch(kept, thrown_away).in1 - kept.begin();
}

TEST_F(ChainPole, SolversAreMadeOncePerChain) {
    start(6);
    ChainRuntime& runtime = workspace.runtimes.of<ChainRuntime>(chain_lab);
    const std::size_t made = runtime.made();
    for (const glm::vec3& target : arc(0.025f)) reach(target);
    EXPECT_EQ(runtime.made(), made);
    for (int i = 0; i < 10; ++i) run("chain.pull", {{"index", 2}, {"to", {1.5, 0.1 * i, 0.5}}});
    EXPECT_EQ(runtime.made(), made + 2) << "one for each side of the dragged joint";
}

}  // namespace
}  // namespace tendril::app
