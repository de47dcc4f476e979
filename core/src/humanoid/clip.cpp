#include "tendril/humanoid/clip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "rig/checks.hpp"
#include "rig/math.hpp"
#include "tendril/humanoid/lint.hpp"

namespace tendril::humanoid {
namespace {

using tendril::detail::Argument;
using tendril::detail::refused;

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

/// The first key that is after `time` by more than the float rounding of key times and of the clip's
/// duration. Without that margin a step would come a frame late.
std::size_t next_key(const std::vector<double>& times, double time) noexcept {
    constexpr double rounded = 2.0 * std::numeric_limits<float>::epsilon();
    return static_cast<std::size_t>(
        std::upper_bound(times.begin(), times.end(), time + rounded * std::abs(time)) - times.begin());
}

template <class T>
void sample_track(const Track<T>& track, double time, T& value) noexcept {
    const std::vector<double>& times = track.times;
    if (times.empty()) return;
    const bool is_cubic = track.interpolation == Interpolation::Cubic;
    const auto key = [&](std::size_t i) -> const T& { return track.values[is_cubic ? 3 * i + 1 : i]; };
    const std::size_t next = next_key(times, time);
    if (next == 0 || next == times.size() || track.interpolation == Interpolation::Step) {
        value = finished(key(next == 0 ? 0 : next - 1));
        return;
    }
    const std::size_t last = next - 1;
    const double span = times[next] - times[last], u = std::max(time - times[last], 0.0) / span;
    if (!is_cubic)
        value = linear(finished(key(last)), finished(key(next)), u);
    else
        value = finished(
            cubic_of(key(last), track.values[3 * last + 2], key(next), track.values[3 * next], span, u));
}

/// The placement of a single node, from those above it; -1: the character's space.
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

/// Maximum distance of a key's time from its frame, as a fraction of a step: files round times. Three
/// decimals of a sixtieth of a second are off by 0.03.
constexpr double rounded_frame = 0.06;

/// Key times of the track with the most keys; null if no track has two.
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

/// The frames of a clip whose densest track has a key at each, from 0 to the clip's end.
std::optional<Frames> own_frames(const Clip& clip) noexcept {
    const std::vector<double>* const own = densest_times(clip);
    if (!own || own->front() != 0.0 || !(clip.duration - own->back() < 1e-9)) return std::nullopt;
    const double step = clip.duration / static_cast<double>(own->size() - 1);
    for (std::size_t i = 0; i < own->size(); ++i)
        if (std::abs((*own)[i] - static_cast<double>(i) * step) > rounded_frame * step) return std::nullopt;
    return Frames{.count = own->size(), .step = step};
}

/// The exact rate for a rate that a file has rounded: the nearest integer, or 1000/1001 of one as in
/// television (SMPTE 12M). Four decimals of a thirtieth of a second are 0.1 % off.
double snap_rate(double rate) noexcept {
    constexpr double television = 1000.0 / 1001.0;
    const double whole = std::floor(rate + 0.5), slow = std::floor(rate / television + 0.5) * television;
    const double nearest = std::abs(rate - whole) <= std::abs(rate - slow) ? whole : slow;
    return std::abs(rate - nearest) < 1.1e-3 * nearest ? nearest : rate;
}

bool has_curves(const Clip& clip) noexcept {
    return std::any_of(clip.channels.begin(), clip.channels.end(), [](const Channel& each) {
        return each.translation.interpolation == Interpolation::Cubic ||
               each.rotation.interpolation == Interpolation::Cubic ||
               each.scale.interpolation == Interpolation::Cubic;
    });
}

/// The mean of the steps that are about as long as the median one: missing keys make some longer, keys
/// between frames some shorter. 0 for fewer than two keys.
double usual_step(const Clip& clip) {
    const std::vector<double>* const densest = densest_times(clip);
    if (!densest) return 0.0;
    std::vector<double> steps;
    for (std::size_t i = 1; i < densest->size(); ++i) steps.push_back((*densest)[i] - (*densest)[i - 1]);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    const double median = *middle;
    std::erase_if(steps, [&](double each) { return !(std::abs(each - median) < rounded_frame * median); });
    return std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
}

}  // namespace

double frame_rate(const Clip& clip) noexcept {
    double rate = clip.rate;
    if (!(rate >= 1.0 && rate <= 1000.0)) {
        const auto own = own_frames(clip);
        rate = 1.0 / (own ? own->step : usual_step(clip));
        // Slower keys are frames if they are evenly spaced and none is on a curve, which needs more frames.
        const double slowest = own && !has_curves(clip) ? 5.0 : 20.0;
        if (!(rate > slowest * 0.999 && rate <= 1000.0)) return 60.0;
    }
    const double nearest = snap_rate(rate);
    return nearest == std::floor(nearest) ? nearest : rate;
}

Frames frames_at(const Clip& clip, double rate) noexcept {
    if (const auto own = own_frames(clip); own && snap_rate(1.0 / own->step) == snap_rate(rate)) return *own;
    return {static_cast<std::size_t>(std::floor(clip.duration * rate + rounded_frame)) + 1, 1.0 / rate};
}

std::vector<double> with_frames(const std::vector<double>& times, const Frames& frames) {
    if (times.empty() || !(frames.step > 0.0)) return times;
    std::vector<double> all{times.front()};
    const double near = rounded_frame * frames.step;
    auto frame = static_cast<std::size_t>(std::ceil(times.front() / frames.step));
    for (std::size_t i = 1; i < times.size(); all.push_back(times[i++]))
        for (; frame < frames.count && frames.time(frame) < times[i] - near; ++frame)
            if (frames.time(frame) > times[i - 1] + near) all.push_back(frames.time(frame));
    return all;
}

rig::Transform key_of(const Skeleton& skeleton, std::span<const rig::Transform> pose,
                      std::size_t node) noexcept {
    if (!skeleton[node].keys) return pose[node];
    return relative(placed_node(skeleton, pose, skeleton[node].keys->parent),
                    placed_node(skeleton, pose, skeleton[node].parent) * placement(pose[node]));
}

}  // namespace tendril::humanoid
