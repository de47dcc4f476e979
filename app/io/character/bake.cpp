#include "app/io/character/bake.hpp"

#include <algorithm>
#include <stdexcept>

namespace tendril::app {
namespace {

using humanoid::Channel;
using humanoid::Clip;
using humanoid::Skeleton;

/// A node's keys at every frame, and whether `step` ever changed it.
struct Recording {
    bool is_changed = false;
    Channel channel{};
};

void add_key(Channel& channel, double time, const rig::Transform& local) {
    glm::dquat rotation = local.rotation;
    if (!channel.rotation.values.empty() && glm::dot(channel.rotation.values.back(), rotation) < 0.0)
        rotation = -rotation;
    channel.translation.times.push_back(time);
    channel.translation.values.push_back(local.translation);
    channel.rotation.values.push_back(rotation);
    channel.scale.values.push_back(local.scale);
}

/// Drops the keys of a track that always equals the rest pose.
template <class T>
void drop_constant(humanoid::Track<T>& track, const T& rest) {
    if (std::ranges::all_of(track.values, [&](const T& each) { return each == rest; })) track = {};
}

Channel finished(Channel channel, const rig::Transform& rest) {
    channel.rotation.times = channel.scale.times = channel.translation.times;
    drop_constant(channel.translation, rest.translation);
    drop_constant(channel.rotation, rest.rotation);
    drop_constant(channel.scale, rest.scale);
    return channel;
}

}  // namespace

Clip baked(const Skeleton& skeleton, const Clip& clip, double rate, const PoseStep& step) {
    constexpr double max_keys = 50'000'000;
    if (clip.duration * rate * static_cast<double>(skeleton.size()) > max_keys)
        throw std::runtime_error("clip " + clip.name + " would have more than 50000000 keys");
    std::vector<Recording> nodes(skeleton.size());
    std::vector<rig::Transform> before(skeleton.size()), pose;
    const humanoid::Frames frames = frames_at(clip, rate);
    const bool ends_between = clip.duration - frames.time(frames.count - 1) > 0.06 * frames.step;
    double last = 0.0;
    for (std::size_t i = 0; i < frames.count + ends_between; ++i) {
        const double time = std::min(frames.time(i), clip.duration);
        sample(clip, skeleton, time, before);
        pose = before;
        step(pose, time, time - last);
        last = time;
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            const rig::Transform key = key_of(skeleton, pose, node);
            nodes[node].is_changed |= !(key == key_of(skeleton, before, node));
            add_key(nodes[node].channel, time, key);
        }
    }
    Clip result{.name = clip.name, .duration = clip.duration, .channels = {}, .rate = clip.rate};
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        const auto own = std::find_if(clip.channels.begin(), clip.channels.end(),
                                      [&](const Channel& each) { return each.node == node; });
        if (!nodes[node].is_changed) {
            if (own != clip.channels.end()) result.channels.push_back(*own);
            continue;
        }
        nodes[node].channel.node = node;
        result.channels.push_back(finished(std::move(nodes[node].channel), skeleton[node].key_rest()));
    }
    return result;
}

humanoid::Clip travelling(const humanoid::Skeleton& skeleton, const humanoid::Clip& clip,
                          const glm::dvec3& velocity, double rate) {
    return baked(skeleton, clip, rate, [&](std::span<rig::Transform> pose, double time, double) {
        for (std::size_t i = 0; i < pose.size(); ++i)
            if (skeleton[i].parent < 0) pose[i].translation += time * velocity;
    });
}

Clip with_feet_on(const humanoid::Ground& ground, const Skeleton& skeleton, const humanoid::BoneMap& map,
                  const Clip& clip, double rate) {
    const auto soles = humanoid::find_soles(skeleton, map);
    if (!soles) throw std::runtime_error(soles.message());
    const auto feet = humanoid::Feet::make(skeleton, map, humanoid::clip_soles(skeleton, map, *soles, clip));
    if (!feet) throw std::runtime_error(feet.message());
    humanoid::FeetState state;
    humanoid::FeetOptions options;
    options.floor = clip_floor(skeleton, feet->soles(), clip);
    return baked(skeleton, clip, rate, [&](std::span<rig::Transform> pose, double, double dt) {
        feet->step(pose, ground, dt, state, options);
    });
}

}  // namespace tendril::app
