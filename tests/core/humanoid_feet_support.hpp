// Plays a walk over a ground, and measures how far feet sink, float and skate and legs stretch.
#pragma once

#include <glm/geometric.hpp>
#include <tendril/humanoid/feet.hpp>

#include "humanoid_walk.hpp"
#include "memory.hpp"
#include "tests/says.hpp"

namespace tendril::test {

/// Parameters of a walk.
struct WalkOptions {
    double rate = 60.0, speed = 1.0;  // frames per second; speed relative to the clip's
    double start = 0.0, seconds = 8.0;
    double heading = 0.0;  // about Y
    glm::dvec3 from{0.0};
    FeetOptions options{};
};

/// Maxima over all frames, metres; `stretch` is a fraction of the leg's length.
struct Measured {
    double sink = 0.0, floating = 0.0, skate = 0.0;  // of planted feet
    double beyond = 0.0;  // motion of a joint per frame relative to the clip, at 60 frames/s
    double stretch = 0.0;
    int planted = 0, alone = 0, feet = 0;  // frames, counted per foot
    double climbed = 0.0;

    void add(const Measured& other) {
        for (double Measured::*each : {&Measured::sink, &Measured::floating, &Measured::skate,
                                       &Measured::beyond, &Measured::stretch, &Measured::climbed})
            this->*each = std::max(this->*each, other.*each);
        planted += other.planted, alone += other.alone, feet += other.feet;
    }
};

class Walker {
  public:
    Walker(const Skeleton& skeleton, const Clip& clip)
        : skeleton_(skeleton),
          clip_(clip),
          map_(match_bones(skeleton)),
          feet_(*Feet::make(skeleton, map_)),
          pose_(skeleton.size()),
          now_(skeleton.size()),
          now_clip_(skeleton.size()) {
        loop_ = hips_at(clip.duration) - hips_at(0.0);
        loop_.y = 0.0;
    }

    Measured walk(const Ground& ground, const WalkOptions& walk) {
        Measured worst;
        FeetState state;
        std::vector<Placement> before, before_clip;
        glm::dvec3 locked[2]{};
        bool was_planted[2]{};
        const int frames = static_cast<int>(walk.seconds * walk.rate);
        for (int frame = 0; frame < frames; ++frame) {
            const FeetReport report = step(ground, walk, frame, state);
            for (std::size_t i = 0; i < 2; ++i) {
                const FootReport& foot = report.feet[i];
                ++worst.feet;
                worst.alone += foot.alone != FootAlone::No;
                if (foot.alone == FootAlone::No) worst.stretch = std::max(worst.stretch, stretch(i));
                if (foot.planted) {
                    ++worst.planted;
                    const double gap = std::min(over(ground, foot.heel), over(ground, foot.toe));
                    worst.sink = std::max(worst.sink, -gap);
                    worst.floating = std::max(worst.floating, gap);
                    if (!was_planted[i]) locked[i] = foot.toe;
                    const glm::dvec3 slid = foot.toe - locked[i];
                    worst.skate = std::max(worst.skate, std::hypot(slid.x, slid.z));
                }
                was_planted[i] = foot.planted;
            }
            for (std::size_t i = 0; i < before.size(); ++i) {
                const glm::dvec3 moved = now_[i].position - before[i].position,
                                 moved_clip = now_clip_[i].position - before_clip[i].position;
                worst.beyond = std::max(worst.beyond, glm::length(moved - moved_clip) * walk.rate / 60.0);
            }
            worst.climbed = std::max(worst.climbed, std::abs(report.base));
            before = now_;
            before_clip = now_clip_;
        }
        return worst;
    }

    /// Plays one frame and leaves the corrected pose in pose().
    FeetReport step(const Ground& ground, const WalkOptions& walk, int frame, FeetState& state) {
        const double dt = 1.0 / walk.rate, time = walk.start + frame * dt * walk.speed;
        const double loops = std::floor(time / clip_.duration);
        sample(clip_, skeleton_, time - loops * clip_.duration, pose_);
        FeetOptions options = walk.options;
        options.root.rotation = glm::angleAxis(walk.heading, glm::dvec3(0, 1, 0));
        options.root.translation = walk.from + options.root.rotation * (loop_ * loops);
        place_all(options.root, now_clip_);
        clip_pose_ = pose_;
        const FeetReport report = feet_.step(pose_, ground, dt, state, options);
        place_all(options.root, now_);
        return report;
    }

    const Feet& feet() const { return feet_; }
    const std::vector<rig::Transform>& pose() const { return pose_; }
    const std::vector<rig::Transform>& clip_pose() const { return clip_pose_; }
    const Placement& now(Bone bone) const { return now_[static_cast<std::size_t>(map_[bone].node)]; }
    const Placement& now_clip(Bone bone) const {
        return now_clip_[static_cast<std::size_t>(map_[bone].node)];
    }
    double stretch(std::size_t leg) const {
        constexpr Bone bones[2][3]{{Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot},
                                   {Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot}};
        const auto at = [&](int i) { return now(bones[leg][i]).position; };
        return glm::distance(at(0), at(2)) / (glm::distance(at(0), at(1)) + glm::distance(at(1), at(2)));
    }

  private:
    static double over(const Ground& ground, const glm::dvec3& point) {
        const auto hit = ground.below(point + glm::dvec3(0, 0.5, 0));
        return hit ? point.y - hit->height : 1e9;
    }
    glm::dvec3 hips_at(double time) {
        sample(clip_, skeleton_, time, pose_);
        place_all({}, now_);
        return now(Bone::Hips).position;
    }
    void place_all(const rig::Transform& root, std::vector<Placement>& placements) {
        place(skeleton_, pose_, placements);
        const Placement above = placement(root);
        for (Placement& each : placements) each = above * each;
    }

    const Skeleton& skeleton_;
    Clip clip_;
    BoneMap map_;
    Feet feet_;
    std::vector<rig::Transform> pose_, clip_pose_;
    std::vector<Placement> now_, now_clip_;
    glm::dvec3 loop_{0.0};
};

}  // namespace tendril::test
