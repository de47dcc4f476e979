// Clips of the built-in figure with a planted fault, and clips without any.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <tendril/humanoid/lint.hpp>

#include "app/io/character/stick_figure.hpp"
#include "tests/app/io/posed.hpp"

namespace tendril::app {

using namespace humanoid;

/// The poses of all frames: edit them and convert them back to a clip.
class Frames {
  public:
    Frames(const Skeleton& skeleton, const Clip& clip, double rate, double seconds)
        : skeleton_(skeleton), rate_(rate), name_(clip.name) {
        const glm::dvec3 way = end_of(clip) - begin_of(clip);
        const auto count = static_cast<std::size_t>(seconds * rate + 1e-6) + 1;
        for (std::size_t i = 0; i < count; ++i) {
            const double time = static_cast<double>(i) / rate;
            const double cycles = clip.duration > 0.0 ? std::floor(time / clip.duration + 1e-9) : 0.0;
            std::vector<rig::Transform> pose(skeleton.size());
            sample(clip, skeleton, time - cycles * clip.duration, pose);
            pose[0].translation += cycles * glm::dvec3(way.x, 0.0, way.z);
            poses.push_back(std::move(pose));
        }
    }
    std::vector<std::vector<rig::Transform>> poses{};

    rig::Transform& at(std::size_t frame, const char* node) { return poses[frame][*skeleton_.find(node)]; }
    /// Calls `act` with each frame and its time.
    void edit(const std::function<void(std::size_t, double)>& act) {
        for (std::size_t k = 0; k < poses.size(); ++k) act(k, static_cast<double>(k) / rate_);
    }
    std::vector<Placement> placed(std::size_t frame) const {
        return test_posed::placed_as(skeleton_, poses[frame]);
    }
    /// Moves an ankle by rotating thigh and shin; the foot keeps its rotation.
    void move_foot(std::size_t frame, const std::string& side, const glm::dvec3& by) {
        const auto node = [&](const char* bone) { return *skeleton_.find(side + bone); };
        const std::size_t upper = node("UpperLeg"), lower = node("LowerLeg"), foot = node("Foot");
        std::vector<Placement> now = placed(frame);
        const glm::dquat kept = now[foot].rotation();
        const glm::dvec3 hip = now[upper].position, target = now[foot].position + by;
        const double a = glm::distance(hip, now[lower].position),
                     b = glm::distance(now[lower].position, now[foot].position);
        const double far = std::min(glm::distance(hip, target), 0.9999 * (a + b));
        // First the knee's angle, then the whole leg towards the target.
        const glm::dvec3 thigh = now[lower].position - hip, shin = now[foot].position - now[lower].position;
        const glm::dvec3 hinge = glm::normalize(glm::cross(thigh, shin));
        const double bent = std::acos(glm::dot(thigh, shin) / (a * b));
        const double wanted = 3.14159265358979 - std::acos((a * a + b * b - far * far) / (2.0 * a * b));
        turn(frame, lower, glm::angleAxis(wanted - bent, hinge));
        now = placed(frame);
        const glm::dvec3 from = glm::normalize(now[foot].position - hip), to = glm::normalize(target - hip);
        turn(frame, upper, glm::normalize(glm::dquat(1.0 + glm::dot(from, to), glm::cross(from, to))));
        now = placed(frame);
        turn(frame, foot, kept * glm::conjugate(now[foot].rotation()));
    }
    /// Rotates a node in the figure's space.
    void turn(std::size_t frame, std::size_t node, const glm::dquat& by) {
        const glm::dquat parent = placed(frame)[static_cast<std::size_t>(skeleton_[node].parent)].rotation();
        glm::dquat& local = poses[frame][node].rotation;
        local = glm::normalize(glm::conjugate(parent) * by * parent * local);
    }
    Clip clip() const {
        Clip result{.name = name_, .duration = static_cast<double>(poses.size() - 1) / rate_, .channels = {}};
        for (std::size_t node = 0; node < skeleton_.size(); ++node) {
            Channel channel{.node = node};
            for (std::size_t i = 0; i < poses.size(); ++i) {
                const double time = std::min(static_cast<double>(i) / rate_, result.duration);
                glm::dquat rotation = poses[i][node].rotation;
                if (i > 0 && glm::dot(rotation, channel.rotation.values.back()) < 0.0) rotation = -rotation;
                channel.rotation.times.push_back(time);
                channel.rotation.values.push_back(rotation);
                if (node > 0) continue;
                channel.translation.times.push_back(time);
                channel.translation.values.push_back(poses[i][node].translation);
            }
            result.channels.push_back(std::move(channel));
        }
        return result;
    }

  private:
    static const Channel& root_of(const Clip& clip) { return clip.channels.front(); }
    static glm::dvec3 begin_of(const Clip& clip) { return root_of(clip).translation.values.front(); }
    static glm::dvec3 end_of(const Clip& clip) { return root_of(clip).translation.values.back(); }

    const Skeleton& skeleton_;
    double rate_;
    std::string name_;
};

inline std::string texts(const LintReport& report) {
    std::string all;
    for (const Finding& each : report.findings) all += each.text + '\n';
    return all;
}

class LintFigure : public ::testing::Test {
  protected:
    const Character figure = stick_figure();
    const Skeleton& skeleton = figure.skeleton;
    const BoneMap map = match_bones(skeleton);

    Frames walk(double rate = 60.0, double seconds = 3.3) const {
        return {skeleton, figure.clips[0], rate, seconds};
    }
    LintReport run(const Clip& clip) const {
        EXPECT_TRUE(check(clip, skeleton)) << check(clip, skeleton).message();
        return lint(skeleton, map, clip);
    }
};

}  // namespace tendril::app
