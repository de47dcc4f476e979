// The pole's memory in the program: while the target crosses the line through root and pole, joints stay
// within their speed limit; across saving and loading, undo and redo, and with any runtime of the lab.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "app/document/command.hpp"
#include "app/labs/chain/chain_runtime.hpp"
#include "tests/app/labs/chain_support.hpp"

namespace tendril::app {
namespace {

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
    for (const int bones : {5, 6}) {
        for (const float step : {0.025f, 0.005f, 0.0005f}) {
            start(bones);
            EXPECT_LT(worst_ratio(step), 50.0f) << bones << " bones, steps of " << step << " m";
        }
    }
}

TEST_F(ChainPole, TheBendFacesItInTheEnd) {
    start(6);
    for (const glm::vec3& target : arc(0.005f)) reach(target);
    // Past the pole's direction the bend must be on the other side of the line to the target.
    const glm::vec3 line = glm::normalize(part().target), pole(2, 1, 0);
    const glm::vec3 side = pole - line * glm::dot(pole, line);
    const glm::vec3 bend = part().chain.position(3) - line * glm::dot(part().chain.position(3), line);
    EXPECT_GT(glm::dot(glm::normalize(side), glm::normalize(bend)), 0.99f);
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
    EXPECT_TRUE(kept == thrown_away) << "after command " << std::ranges::mismatch(kept, thrown_away).in1 - kept.begin();
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
