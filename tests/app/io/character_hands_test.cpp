// The figure's punch, aimed at a post.
#include <gtest/gtest.h>

#include <tendril/humanoid/hands.hpp>

#include "app/io/character/stick_figure.hpp"

namespace tendril::app {
namespace {

using namespace humanoid;

TEST(CharacterHands, ThePunchHitsThePostAndIsTheClipBeforeAndAfter) {
    const Character figure = stick_figure();
    const BoneMap map = match_bones(figure.skeleton);
    const Hands hands = *Hands::make(figure.skeleton, map);
    const Clip& punch = figure.clips[1];
    const signal::Curve hook = *weight_curve(0.3, 0.55, 0.62, 0.9);
    const auto node = static_cast<std::size_t>(map[Bone::RightHand].node);
    std::vector<rig::Transform> pose(figure.skeleton.size()), clip(pose);
    std::vector<Placement> placements(pose.size());
    const auto at = [&](const std::vector<rig::Transform>& of) {
        place(figure.skeleton, of, placements);
        return placements[node].position;
    };
    sample(punch, figure.skeleton, 0.58, clip);
    const glm::dvec3 peak = at(clip);
    for (const glm::dvec3& away :
         {glm::dvec3(0.0), glm::dvec3(0.1, 0.05, -0.08), glm::dvec3(-0.12, -0.2, 0.0)}) {
        const glm::dvec3 post = peak + away;
        HandsState state;
        glm::dvec3 before{0.0}, before_clip{0.0};
        for (int frame = 0; frame <= 72; ++frame) {
            const double time = frame / 60.0;
            sample(punch, figure.skeleton, time, pose);
            clip = pose;
            HandTargets targets;
            targets[1] = {.position = post, .weight = signal::evaluate_keys(hook, time)};
            const HandsReport report = hands.step(pose, targets, 1.0 / 60, state);
            const glm::dvec3 now = at(pose), now_clip = at(clip);
            if (report.hands[1].weight == 1.0) {
                EXPECT_LT(glm::distance(now, post), 0.005);
            }
            if (time <= 0.3 || time >= 0.9) {
                EXPECT_EQ(pose, clip);
            }
            if (frame > 0) {
                EXPECT_LT(glm::distance(now - before, now_clip - before_clip), 0.08) << time;
            }
            before = now;
            before_clip = now_clip;
        }
    }
}

}  // namespace
}  // namespace tendril::app
