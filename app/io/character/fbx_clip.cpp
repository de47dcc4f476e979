#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "app/io/character/fbx_scene.hpp"

namespace tendril::app {
namespace {

using humanoid::Channel;
using humanoid::Clip;
using humanoid::Placement;

template <class Key>
bool between(const Key* keys, unsigned count, double time, unsigned& before, double& part) {
    if (count == 0) return false;
    const Key* after =
        std::upper_bound(keys, keys + count, time, [](double t, const Key& key) { return t < key.mTime; });
    before = after == keys ? 0 : static_cast<unsigned>(after - keys - 1);
    part = after == keys || after == keys + count
               ? 0.0
               : (time - keys[before].mTime) / (after->mTime - keys[before].mTime);
    return true;
}
glm::dvec3 vector_at(const aiVectorKey* keys, unsigned count, double time, const glm::dvec3& otherwise) {
    unsigned i = 0;
    double part = 0.0;
    if (!between(keys, count, time, i, part)) return otherwise;
    const auto value = [&](unsigned k) {
        return glm::dvec3(keys[k].mValue.x, keys[k].mValue.y, keys[k].mValue.z);
    };
    return part > 0.0 ? value(i) * (1.0 - part) + value(i + 1) * part : value(i);
}
glm::dquat rotation_at(const aiQuatKey* keys, unsigned count, double time) {
    unsigned i = 0;
    double part = 0.0;
    if (!between(keys, count, time, i, part)) return {1.0, 0.0, 0.0, 0.0};
    const auto value = [&](unsigned k) {
        return rig::normalised({keys[k].mValue.w, keys[k].mValue.x, keys[k].mValue.y, keys[k].mValue.z});
    };
    return part > 0.0 ? rig::blend(value(i), value(i + 1), part) : value(i);
}
rig::Transform transform_at(const aiNodeAnim& channel, double time) {
    rig::Transform local;
    local.translation = vector_at(channel.mPositionKeys, channel.mNumPositionKeys, time, glm::dvec3(0.0));
    local.rotation = rotation_at(channel.mRotationKeys, channel.mNumRotationKeys, time);
    local.scale = vector_at(channel.mScalingKeys, channel.mNumScalingKeys, time, glm::dvec3(1.0));
    return local;
}

template <class Key>
void add_times(const Key* keys, unsigned count, std::set<double>& times) {
    for (unsigned i = 0; i < count; ++i) {
        if (!std::isfinite(keys[i].mTime) || (i > 0 && keys[i].mTime < keys[i - 1].mTime))
            throw std::runtime_error("key " + std::to_string(i) + " is not after the one before it");
        times.insert(keys[i].mTime);
    }
}
void add_times(const aiNodeAnim& channel, std::set<double>& times) {
    try {
        add_times(channel.mPositionKeys, channel.mNumPositionKeys, times);
        add_times(channel.mRotationKeys, channel.mNumRotationKeys, times);
        add_times(channel.mScalingKeys, channel.mNumScalingKeys, times);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("animation of " + plain_name(channel.mNodeName.C_Str()) + ": " +
                                 error.what());
    }
}
using Channels = std::map<std::string, const aiNodeAnim*>;
/// If only translation, rotation and scale are animated, Assimp puts everything, including the pre-rotation,
/// into one channel of the node itself, although it splits the node: that channel then replaces the whole
/// chain.
Placement local_at(const FbxJoint& joint, const Channels& channels, double time) {
    const auto channel_of = [&](const aiNode* part) {
        const auto found = channels.find(name_of(*part));
        return found == channels.end() ? nullptr : found->second;
    };
    const bool parts_move = std::any_of(joint.chain.begin(), joint.chain.end() - 1, channel_of);
    if (const aiNodeAnim* whole = channel_of(joint.chain.back()); whole && !parts_move) {
        rig::Transform local = transform_at(*whole, time);
        // That channel contains the post-rotation itself, of which a transform needs the inverse.
        for (const aiNode* part : joint.chain) {
            if (!name_of(*part).ends_with("_PostRotation")) continue;
            const glm::dquat inverse = placement_of(part->mTransformation).rotation();
            local.rotation = local.rotation * inverse * inverse;
        }
        return humanoid::placement(local);
    }
    Placement local;
    for (const aiNode* part : joint.chain) {
        const aiNodeAnim* channel = channel_of(part);
        local = local * (channel ? humanoid::placement(transform_at(*channel, time))
                                 : placement_of(part->mTransformation));
    }
    return local;
}
void cut(std::set<double>& times, double begin, double end) {
    const bool before = *times.begin()<begin, after = *times.rbegin()> end;
    times.erase(times.begin(), times.lower_bound(begin));
    times.erase(times.upper_bound(end), times.end());
    if (before || times.empty()) times.insert(begin);
    if (after) times.insert(end);
}

}  // namespace

Clip fbx_clip(const aiAnimation& animation, unsigned index, const std::vector<FbxJoint>& joints) {
    Clip clip;
    clip.name = animation.mName.length > 0 ? animation.mName.C_Str() : "clip_" + std::to_string(index);
    const double rate = animation.mTicksPerSecond > 0.0 ? animation.mTicksPerSecond : 25.0;
    Channels channels;
    std::set<double> all;
    for (unsigned i = 0; i < animation.mNumChannels; ++i) {
        channels[animation.mChannels[i]->mNodeName.C_Str()] = animation.mChannels[i];
        add_times(*animation.mChannels[i], all);
    }
    // Assimp counts time from the file's start of the animation. Keys before that and after the end are cut
    // off.
    const double end = animation.mDuration > 0.0 ? animation.mDuration : all.empty() ? 0.0 : *all.rbegin();
    clip.duration = std::max(end, 0.0) / rate;
    for (std::size_t node = 0; node < joints.size(); ++node) {
        std::set<double> times;
        for (const aiNode* part : joints[node].chain)
            if (const auto found = channels.find(name_of(*part)); found != channels.end())
                add_times(*found->second, times);
        if (times.empty()) continue;
        cut(times, 0.0, std::max(end, 0.0));
        Channel channel{.node = node};
        for (const double time : times) {
            const Placement local = local_at(joints[node], channels, time);
            const rig::Transform value = transform_of(local);
            const double seconds = std::min(time / rate, clip.duration);
            channel.translation.times.push_back(seconds);
            channel.translation.values.push_back(value.translation);
            channel.rotation.values.push_back(value.rotation);
            channel.scale.values.push_back(value.scale);
        }
        channel.rotation.times = channel.scale.times = channel.translation.times;
        clip.channels.push_back(std::move(channel));
    }
    return clip;
}

}  // namespace tendril::app
