// Feet that pass through the ground: planted soles stand on treads, and steps that are too fast are reported.
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "humanoid_support.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class FootDepth : public HumanoidTest {
  protected:
    const ShownPose& shown() const { return shown_pose(workspace); }
    /// The depth of points along the line from heel to toe.
    double depth(std::size_t side, int points) {
        const humanoid::SolePoints& sole = shown().soles[side];
        const humanoid::Ground& ground = humanoid_runtime(workspace).solvers.ground(part());
        double deepest = 0.0;
        for (int i = 0; i <= points; ++i) {
            const glm::dvec3 at = glm::mix(sole.heel, sole.toe, static_cast<double>(i) / points);
            if (const auto hit = ground.below(at + glm::dvec3(0.0, 0.5, 0.0)))
                deepest = std::max(deepest, hit->height - at.y);
        }
        return deepest;
    }
    void stairs(double height, double deep) {
        run("humanoid.ground", {{"kind", "stairs"}, {"step_height", height}, {"step_depth", deep}});
        run("humanoid.foot_ik", {{"on", true}});
    }
};

TEST_F(FootDepth, IsReportedWithItsCause) {
    stairs(0.2, 0.25);
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    bool told = false;
    for (int i = 0; i < 400 && !told; ++i) {
        tick();
        const Verdict verdict = humanoid_verdict(workspace);
        told = test::says(verdict.text, "foot mm in the ground") &&
               test::says(verdict.why, "too fast for the stairs");
    }
    EXPECT_TRUE(told);
    run("humanoid.ground", {{"kind", "flat"}});
    tick(100);
    EXPECT_EQ(humanoid_verdict(workspace).text, "Complete body");
}

TEST_F(FootDepth, IsZeroInTheOpening) {
    for (const CommandCall& each : lab().opening()) run(each.name.c_str(), to_json(each.arguments));
    for (int i = 0; i < 600; ++i) {
        tick();
        if (i % 10 == 0) {
            ASSERT_EQ(humanoid_verdict(workspace).text, "Complete body") << "tick " << i;
        }
    }
}

/// Ten third-party clips, if present: no foot is deeper in the ground than the verdict says.
TEST_F(FootDepth, OfThirdPartyClipsIsAlwaysReported) {
    const auto folder = test::characters_folder();
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    const std::vector<std::pair<std::string, std::size_t>> clips{
        {"cmu_01_01.bvh", 0},    {"cmu_12_01_walk.bvh", 0}, {"human_clip.glb", 0}, {"robot.glb", 6},
        {"robot.glb", 10},       {"robot.glb", 11},         {"pab_walk.fbx", 0},   {"cesium_man.gltf", 0},
        {"mixed_orders.bvh", 0}, {"rigify_names.glb", 0}};
    for (const auto& [file, clip] : clips) {
        if (!std::filesystem::exists(folder / file)) continue;
        SCOPED_TRACE(file);
        run("humanoid.load", {{"path", (folder / file).string()}});
        if (humanoid_runtime(workspace).solvers.feet(part()) == nullptr ||
            part().loaded->clips().size() <= clip)
            continue;
        for (const char* kind : {"slope", "stairs"}) {
            run("humanoid.ground", {{"kind", kind}});
            run("humanoid.foot_ik", {{"on", true}});
            run("humanoid.clip", {{"index", clip}, {"time", 0.0}, {"play", true}});
            for (int i = 0; i < 240; ++i) {
                tick();
                if (!shown().feet) continue;
                for (std::size_t side = 0; side < 2; ++side)
                    if (shown().feet->feet[side].alone == humanoid::FootAlone::No &&
                        depth(side, 1) > max_depth + 1e-6) {
                        EXPECT_TRUE(test::says(humanoid_verdict(workspace).text, "foot mm in the ground"))
                            << kind << " tick " << i << ": " << humanoid_verdict(workspace).text;
                    }
            }
        }
    }
}

}  // namespace
}  // namespace tendril::app
