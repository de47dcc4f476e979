#include "tendril/humanoid/retarget.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "humanoid/anatomy.hpp"
#include "humanoid/input.hpp"
#include "rig/math.hpp"
#include "tendril/humanoid/lint.hpp"
#include "tendril/humanoid/t_pose.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;

constexpr std::size_t max_retargeted_keys = 100'000;

std::size_t hips_of(const MappedSkeleton& body) noexcept {
    return static_cast<std::size_t>(body.map[Bone::Hips].node);
}

/// A body in its T-pose.
struct Reference {
    std::vector<glm::dquat> rotations{};   // of all nodes, in the character's space
    glm::dvec3 hips{0.0};                  // at rest
    double height = 0.0;                   // of the hips over the lower foot; 0: no foot is mapped
    glm::dquat frame{1.0, 0.0, 0.0, 0.0};  // takes x, y, z to left, up, forward

    explicit Reference(const MappedSkeleton& body) {
        std::vector<Placement> placed(body.skeleton.size());
        place(body.skeleton, rest_pose(body.skeleton), placed);
        hips = placed[hips_of(body)].position;
        place(body.skeleton, t_pose(body.skeleton, body.map), placed);
        for (const Placement& each : placed) rotations.push_back(each.rotation());
        const glm::dvec3& from = placed[hips_of(body)].position;
        for (const Bone foot : {Bone::LeftFoot, Bone::RightFoot})
            if (const std::int32_t node = body.map[foot].node; node >= 0)
                height = std::max(height, from.y - placed[static_cast<std::size_t>(node)].position.y);
        const Facing at = facing(body.skeleton, body.map);
        // Forward may be reversed (Facing): the frame stays right-handed.
        frame = Placement{{cross(at.up, at.forward), at.up, at.forward}, glm::dvec3(0.0)}.rotation();
    }
};

/// Every key of the source and every frame, ascending.
std::vector<double> moments_of(const Clip& clip) {
    std::vector<double> times;
    const double rate = frame_rate(clip);
    const double frames = std::floor(clip.duration * rate + 1e-6);
    for (double i = 0.0; i <= std::min(frames, static_cast<double>(max_retargeted_keys)); ++i)
        times.push_back(std::min(i / rate, clip.duration));
    for (const Channel& each : clip.channels)
        for (const std::vector<double>* own :
             {&each.translation.times, &each.rotation.times, &each.scale.times})
            times.insert(times.end(), own->begin(), own->end());
    times.push_back(clip.duration);
    std::sort(times.begin(), times.end());
    constexpr double same = 1e-6;  // seconds
    times.erase(std::unique(times.begin(), times.end(), [](double a, double b) { return b - a < same; }),
                times.end());
    return times;
}

class Retargeter {
  public:
    Retargeter(const MappedSkeleton& from, const Clip& clip, const MappedSkeleton& to)
        : from_(from), to_(to), clip_(clip), was_(from), now_(to), shared_(to.skeleton.size()) {
        for (std::size_t i = 0; i < bone_count; ++i) {
            const auto bone = static_cast<Bone>(i);
            const std::int32_t a = from.map[bone].node, b = to.map[bone].node;
            if (a >= 0 && b >= 0)
                shared_[static_cast<std::size_t>(b)] = static_cast<std::size_t>(a);
            else if (a >= 0)
                result_.left_out.push_back(bone);
            else if (b >= 0)
                result_.at_rest.push_back(bone);
        }
        turn_ = math::compose(now_.frame, conjugate(was_.frame));
        result_.scale = was_.height > 0.0 && now_.height > 0.0 ? now_.height / was_.height : 1.0;
    }

    Retargeted run(const std::vector<double>& times) {
        result_.clip.name = clip_.name;
        result_.clip.duration = clip_.duration;
        result_.clip.rate = clip_.rate;
        const std::vector<rig::Transform> rest = rest_pose(to_.skeleton);
        std::vector<Channel> channels(to_.skeleton.size());
        std::vector<rig::Transform> pose = rest;
        for (const double time : times) {
            pose_at(time, rest, pose);
            for (std::size_t node = 0; node < shared_.size(); ++node)
                if (moves(node)) add_key(channels[node], time, key_of(to_.skeleton, pose, node), node);
        }
        for (std::size_t node = 0; node < shared_.size(); ++node) {
            if (!moves(node)) continue;
            channels[node].node = node;
            result_.clip.channels.push_back(std::move(channels[node]));
        }
        return std::move(result_);
    }

  private:
    void pose_at(double time, const std::vector<rig::Transform>& rest, std::vector<rig::Transform>& pose) {
        source_pose_.resize(from_.skeleton.size());
        source_.resize(from_.skeleton.size());
        sample(clip_, from_.skeleton, time, source_pose_);
        place(from_.skeleton, source_pose_, source_);
        placed_.resize(to_.skeleton.size());
        for (const std::int32_t each : to_.skeleton.order()) {
            const auto node = static_cast<std::size_t>(each);
            const std::int32_t parent = to_.skeleton[node].parent;
            const Placement above = parent < 0 ? Placement() : placed_[static_cast<std::size_t>(parent)];
            pose[node] = rest[node];
            if (const auto& from = shared_[node]) {
                // From the T-pose to this moment, in the source's frame, then in the target's.
                const glm::dquat moved =
                    math::compose(source_[*from].rotation(), conjugate(was_.rotations[*from]));
                const glm::dquat wanted = math::compose(
                    math::compose(turn_, math::compose(moved, conjugate(turn_))), now_.rotations[node]);
                pose[node].rotation = rig::normalised(math::compose(conjugate(above.rotation()), wanted));
                if (node == hips_of(to_)) {
                    const glm::dvec3 way = minus(source_[*from].position, was_.hips);
                    const glm::dvec3 at = plus(now_.hips, times(rotated(turn_, way), result_.scale));
                    pose[node].translation = relative(above, Placement{glm::dmat3(1.0), at}).translation;
                }
            }
            placed_[node] = above * placement(pose[node]);
        }
    }
    /// A node whose keys are local to another node than its parent (attach.hpp) needs keys to stay where it
    /// is below its parent.
    bool moves(std::size_t node) const { return shared_[node] || to_.skeleton[node].keys; }
    void add_key(Channel& channel, double time, const rig::Transform& key, std::size_t node) const {
        glm::dquat rotation = key.rotation;
        if (!channel.rotation.values.empty() && dot(channel.rotation.values.back(), rotation) < 0.0)
            rotation = glm::dquat(-rotation.w, -rotation.x, -rotation.y, -rotation.z);
        channel.rotation.times.push_back(time);
        channel.rotation.values.push_back(rotation);
        if (node != hips_of(to_) && !to_.skeleton[node].keys) return;
        channel.translation.times.push_back(time);
        channel.translation.values.push_back(key.translation);
        if (!to_.skeleton[node].keys) return;
        channel.scale.times.push_back(time);
        channel.scale.values.push_back(key.scale);
    }

    const MappedSkeleton from_, to_;
    const Clip& clip_;
    const Reference was_, now_;
    std::vector<std::optional<std::size_t>> shared_;  // the source's node of each of the target's
    glm::dquat turn_{1.0, 0.0, 0.0, 0.0};             // from the source's frame to the target's
    Retargeted result_{};
    std::vector<rig::Transform> source_pose_{};
    std::vector<Placement> source_{}, placed_{};
};

}  // namespace

Expected<Retargeted> retarget(const MappedSkeleton& from, const Clip& clip, const MappedSkeleton& to) {
    constexpr const char* operation = "retarget";
    for (const MappedSkeleton* body : {&from, &to})
        if (const Result bad = detail::check_map(operation, body->map, body->skeleton); !bad) return bad;
    if (const Result bad = check(clip, from.skeleton); !bad) return bad;
    if (from.map[Bone::Hips].node < 0) return refused(operation, "from.map", "a map with Hips", "none");
    if (to.map[Bone::Hips].node < 0) return refused(operation, "to.map", "a map with Hips", "none");
    const std::vector<double> times = moments_of(clip);
    if (times.size() > max_retargeted_keys)
        return refused(operation, "clip", "of at most 100000 keys and frames", times.size());
    return Retargeter(from, clip, to).run(times);
}

}  // namespace tendril::humanoid
