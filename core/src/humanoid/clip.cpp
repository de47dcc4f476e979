#include "tendril/humanoid/clip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "rig/checks.hpp"
#include "rig/math.hpp"
#include "tendril/humanoid/lint.hpp"

namespace tendril::humanoid {
namespace {

using tendril::detail::Argument;
using tendril::detail::refused;

/// The components of a value.
std::span<const double> numbers(const glm::dvec3& value) noexcept {
    return {&value.x, 3};
}
std::span<const double> numbers(const glm::dquat& value) noexcept {
    return {&value.x, 4};
}
bool is_value(const glm::dvec3&) noexcept {
    return true;
}
bool is_value(const glm::dquat& value) noexcept {
    return std::abs(rig::detail::dot(value, value) - 1.0) <= 2e-3;
}

template <class T>
Result check_track(const std::string& operation, const std::string& path, const Track<T>& track,
                   double duration) {
    const bool cubic = track.interpolation == Interpolation::Cubic;
    const std::size_t wanted = track.times.size() * (cubic ? 3 : 1);
    const auto place = [&](const char* list) { return path + list; };
    if (track.values.size() != wanted)
        return tendril::detail::refused_count(operation, place("values").c_str(), track.values.size(),
                                              wanted);
    const std::string times = place("times"), values = place("values");
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        const double time = track.times[i];
        if (!(time >= 0.0 && time <= duration))
            return refused(operation, Argument(times, i), "from 0 to the duration", time);
        if (i > 0 && !(time > track.times[i - 1]))
            return refused(operation, Argument(times, i), "later than the time before it", time);
    }
    for (std::size_t i = 0; i < track.values.size(); ++i) {
        for (const double number : numbers(track.values[i]))
            if (const Result bad = rig::detail::check_number(operation, Argument(values, i), number); !bad)
                return bad;
        if ((!cubic || i % 3 == 1) && !is_value(track.values[i]))
            return refused(operation, Argument(values, i), "a unit quaternion", "one of another length");
    }
    return {};
}

glm::dvec3 linear(const glm::dvec3& a, const glm::dvec3& b, double part) noexcept {
    return rig::detail::mix(a, b, part);
}
glm::dquat linear(const glm::dquat& a, const glm::dquat& b, double part) noexcept {
    return rig::blend(a, b, part);
}
/// One component of Hermite's cubic; `leaving` and `arriving` are slopes times the interval.
double cubic(double from, double leaving, double to, double arriving, double u) noexcept {
    const double u2 = u * u, u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * from + (u3 - 2.0 * u2 + u) * leaving + (3.0 * u2 - 2.0 * u3) * to +
           (u3 - u2) * arriving;
}
template <class T>
T cubic_of(const T& from, const T& leaving, const T& to, const T& arriving, double span, double u) noexcept {
    T result = from;
    for (int i = 0; i < T::length(); ++i)
        result[i] = cubic(from[i], leaving[i] * span, to[i], arriving[i] * span, u);
    return result;
}
glm::dvec3 finished(const glm::dvec3& value) noexcept {
    return value;
}
glm::dquat finished(const glm::dquat& value) noexcept {
    return rig::normalised(value);
}

template <class T>
void sample_track(const Track<T>& track, double time, T& value) noexcept {
    const std::vector<double>& times = track.times;
    if (times.empty()) return;
    const bool is_cubic = track.interpolation == Interpolation::Cubic;
    const auto key = [&](std::size_t i) -> const T& { return track.values[is_cubic ? 3 * i + 1 : i]; };
    const auto next =
        static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (next == 0 || next == times.size() || track.interpolation == Interpolation::Step) {
        value = finished(key(next == 0 ? 0 : next - 1));
        return;
    }
    const std::size_t last = next - 1;
    const double span = times[next] - times[last], u = (time - times[last]) / span;
    if (!is_cubic)
        value = linear(finished(key(last)), finished(key(next)), u);
    else
        value = finished(
            cubic_of(key(last), track.values[3 * last + 2], key(next), track.values[3 * next], span, u));
}

/// A single node, from those above it; -1: the character's space.
Placement placed_node(const Skeleton& skeleton, std::span<const rig::Transform> pose,
                      std::int32_t node) noexcept {
    Placement result;
    for (; node >= 0; node = skeleton[static_cast<std::size_t>(node)].parent)
        result = placement(pose[static_cast<std::size_t>(node)]) * result;
    return result;
}

}  // namespace

const char* name(Interpolation interpolation) noexcept {
    constexpr const char* names[] = {"step", "linear", "cubic"};
    return names[static_cast<std::size_t>(interpolation)];
}

Result check(const Clip& clip, const Skeleton& skeleton) {
    std::string operation = "Clip";
    if (!clip.name.empty()) operation += ' ' + clip.name;
    if (!(clip.duration >= 0.0 && clip.duration <= 1e9))
        return refused(operation, "duration", "from 0 to 1e9 s", clip.duration);
    std::vector<bool> seen(skeleton.size());
    for (std::size_t i = 0; i < clip.channels.size(); ++i) {
        const Channel& channel = clip.channels[i];
        const Argument node("channels", i, "node");
        if (channel.node >= skeleton.size())
            return refused(operation, node, "the index of a node", channel.node);
        if (seen[channel.node])
            return refused(operation, node, "a node without an earlier channel", channel.node);
        seen[channel.node] = true;
        std::string path = "channels[";
        path += std::to_string(i);
        if (const Result bad =
                check_track(operation, path + "].translation.", channel.translation, clip.duration);
            !bad)
            return bad;
        if (const Result bad = check_track(operation, path + "].rotation.", channel.rotation, clip.duration);
            !bad)
            return bad;
        if (const Result bad = check_track(operation, path + "].scale.", channel.scale, clip.duration); !bad)
            return bad;
    }
    return {};
}

void sample(const Channel& channel, double time, rig::Transform& local) noexcept {
    sample_track(channel.translation, time, local.translation);
    sample_track(channel.rotation, time, local.rotation);
    sample_track(channel.scale, time, local.scale);
}

void sample(const Clip& clip, const Skeleton& skeleton, double time,
            std::span<rig::Transform> pose) noexcept {
    for (std::size_t i = 0; i < skeleton.size(); ++i) pose[i] = skeleton[i].key_rest();
    for (const Channel& channel : clip.channels) sample(channel, time, pose[channel.node]);
    for (const std::size_t node : skeleton.moved())
        pose[node] =
            relative(placed_node(skeleton, pose, skeleton[node].parent),
                     placed_node(skeleton, pose, skeleton[node].keys->parent) * placement(pose[node]));
}

namespace {

/// Of the track with the most keys; null if none has two.
const std::vector<double>* densest_times(const Clip& clip) noexcept {
    const std::vector<double>* densest = nullptr;
    const auto look_at = [&](const std::vector<double>& times) {
        if (times.size() > 1 && (!densest || times.size() > densest->size())) densest = &times;
    };
    for (const Channel& channel : clip.channels) {
        look_at(channel.translation.times);
        look_at(channel.rotation.times);
        look_at(channel.scale.times);
    }
    return densest;
}

}  // namespace

double frame_rate(const Clip& clip) noexcept {
    constexpr double otherwise = 60.0;
    if (clip.rate >= 20.0 && clip.rate <= 1000.0) return clip.rate;
    const std::vector<double>* const densest = densest_times(clip);
    if (!densest) return otherwise;
    // The median step: missing keys make some longer, and a clip's end may make one shorter.
    std::vector<double> steps;
    for (std::size_t i = 1; i < densest->size(); ++i) steps.push_back((*densest)[i] - (*densest)[i - 1]);
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                     steps.end());
    double step = steps[steps.size() / 2];
    // Times in files are rounded: the whole range gives a better step, if it is a whole number of steps.
    const double whole = densest->back() - densest->front(), count = std::floor(whole / step + 0.5);
    if (count > 0.0 && std::abs(whole / count - step) < 0.01 * step) step = whole / count;
    const double rate = 1.0 / step;
    if (!(rate > 20.0 * 0.999 && rate <= 1000.0)) return otherwise;
    const double nearest = std::floor(rate + 0.5);
    return std::abs(rate - nearest) < 1e-3 * nearest ? nearest : rate;
}

Frames frames_at(const Clip& clip, double rate) noexcept {
    const std::vector<double>* const own = densest_times(clip);
    constexpr double same_rate = 1e-3;
    if (own && own->front() == 0.0 && clip.duration - own->back() < 1e-9) {
        const double steps = static_cast<double>(own->size() - 1), step = clip.duration / steps;
        if (std::abs(step * rate - 1.0) < same_rate) return {own->size(), step};
    }
    return {static_cast<std::size_t>(std::floor(clip.duration * rate + 1e-6)) + 1, 1.0 / rate};
}

rig::Transform key_of(const Skeleton& skeleton, std::span<const rig::Transform> pose,
                      std::size_t node) noexcept {
    if (!skeleton[node].keys) return pose[node];
    return relative(placed_node(skeleton, pose, skeleton[node].keys->parent),
                    placed_node(skeleton, pose, skeleton[node].parent) * placement(pose[node]));
}

}  // namespace tendril::humanoid
