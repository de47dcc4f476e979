#include "app/io/character/fbx/clip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <stdexcept>

#include "tendril/elementary.hpp"

namespace tendril::app::fbx {
namespace {

using humanoid::Interpolation;
using humanoid::Track;

/// Two keys this close together are a jump: files that store times as floats need two different ones.
double jump_seconds(double time) {
    return std::max(1e-7, std::abs(time) / 4194304.0);
}
/// Where a track is compared with its curves between two keys; avoids simple fractions of whole turns.
constexpr std::array<double, 5> compared{0.1273, 0.3119, 0.5041, 0.6971, 0.8667};
constexpr double max_angle = 0.02 / 57.29577951308232;

glm::dvec3 toward(const glm::dvec3& value, const glm::dvec3&) {
    return value;
}
/// The quaternion for this rotation, `value` or -`value`, that is closer to `other`.
glm::dquat toward(const glm::dquat& value, const glm::dquat& other) {
    return glm::dot(value, other) < 0.0 ? -value : value;
}
glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double part) {
    return glm::mix(a, b, part);
}
glm::dquat between(const glm::dquat& a, const glm::dquat& b, double part) {
    return rig::blend(a, b, part);
}
glm::dvec3 unit_if_rotation(const glm::dvec3& value) {
    return value;
}
glm::dquat unit_if_rotation(const glm::dquat& value) {
    return rig::normalised(value);
}
template <class T>
T hermite(const T& a, const T& leaving, const T& b, const T& arriving, double span, double u) {
    const double u2 = u * u, u3 = u2 * u;
    return unit_if_rotation(a * (2.0 * u3 - 3.0 * u2 + 1.0) + leaving * (span * (u3 - 2.0 * u2 + u)) +
                            b * (3.0 * u2 - 2.0 * u3) + arriving * (span * (u3 - u2)));
}
double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat apart = glm::conjugate(a) * b;
    return 2.0 * math::arctangent(std::sqrt(apart.x * apart.x + apart.y * apart.y + apart.z * apart.z),
                                  std::abs(apart.w));
}

/// The times of the curves' keys within the stack; `with_jumps`: also times beside constant curves' jumps.
std::vector<double> key_times(const Stack& stack, const std::vector<const Curve*>& curves, bool with_jumps) {
    std::set<double> times;
    for (const Curve* curve : curves) {
        for (std::size_t i = 0; i < curve->keys.size(); ++i) {
            const CurveKey& key = curve->keys[i];
            times.insert(key.time());
            if (!with_jumps || i + 1 == curve->keys.size() || curve->keys[i + 1].value == key.value) continue;
            const double next = curve->keys[i + 1].time(),
                         ago = std::min(jump_seconds(next), 0.5 * (next - key.time()));
            if (key.shape == CurveKey::Shape::Constant) times.insert(next - ago);
            if (key.shape == CurveKey::Shape::ConstantNext) times.insert(key.time() + ago);
        }
    }
    if (times.empty()) return {stack.begin};
    const bool before = *times.begin()<stack.begin, after = *times.rbegin()> stack.end;
    times.erase(times.begin(), times.lower_bound(stack.begin));
    times.erase(times.upper_bound(stack.end), times.end());
    if (before || times.empty()) times.insert(stack.begin);
    if (after) times.insert(stack.end);
    return {times.begin(), times.end()};
}
bool all_constant(const std::vector<const Curve*>& curves) {
    return std::ranges::all_of(curves, [](const Curve* curve) {
        return curve->keys.size() < 2 ||
               std::ranges::all_of(curve->keys.begin(), curve->keys.end() - 1, [](const CurveKey& key) {
                   return key.shape == CurveKey::Shape::Constant;
               });
    });
}

/// A key between two cubics, with the slopes on both sides.
template <class T>
struct Knot {
    double time;
    T value, arriving, leaving;
};

/// Cubics between the times, halved until each is close enough.
template <class T, class Value, class Error>
class CubicSpans {
  public:
    CubicSpans(const Value& value, const Error& error, std::size_t& keys_left)
        : value_(value), error_(error), keys_left_(keys_left) {}

    std::vector<Knot<T>> fit(const std::vector<double>& times) {
        const T first = value_(times.front());
        add({times.front(), first, first * 0.0, first * 0.0});
        for (std::size_t i = 1; i < times.size(); ++i) span_to(times[i]);
        return std::move(knots_);
    }

  private:
    void add(const Knot<T>& knot) {
        if (keys_left_ == 0) throw std::runtime_error("has too many keys for its size");
        --keys_left_;
        knots_.push_back(knot);
    }
    void span_to(double end) {
        const Knot<T> from = knots_.back();
        const double span = end - from.time, step = 1e-3 * span;
        const auto at = [&](double time) { return toward(value_(time), from.value); };
        Knot<T> to{end, at(end), from.value, from.value * 0.0};
        T leaving = (to.value - from.value) * (1.0 / span);
        to.arriving = leaving;
        if (span > 2.0 * jump_seconds(end)) {
            const auto near = [&](double time, const T& by) { return toward(value_(time), by); };
            leaving = (near(from.time + step, from.value) * 4.0 - from.value * 3.0 -
                       near(from.time + 2.0 * step, from.value)) *
                      (0.5 / step);
            to.arriving =
                (to.value * 3.0 - near(end - step, to.value) * 4.0 + near(end - 2.0 * step, to.value)) *
                (0.5 / step);
            for (const double u : compared) {
                const T fitted = hermite(from.value, leaving, to.value, to.arriving, span, u);
                if (error_(fitted, at(from.time + u * span))) {
                    span_to(from.time + 0.5 * span);
                    return span_to(end);
                }
            }
        }
        knots_.back().leaving = leaving;
        add(to);
    }

    const Value& value_;
    const Error& error_;
    std::size_t& keys_left_;
    std::vector<Knot<T>> knots_{};
};

/// 0.005 mm for a figure of 1.8 m, at least 0.001 mm: the errors of a chain of nodes add up. `metres` per
/// unit of the file.
Tolerance tolerance_for(const Body& body, double metres) {
    std::vector<rig::Transform> locals;
    for (const Node& node : body.nodes) locals.push_back(local_of(node, node.rest()));
    const std::vector<Place> all = places(body.nodes, locals);
    glm::dvec3 low(1e300), high(-1e300);
    for (const Bone& bone : body.bones) {
        low = glm::min(low, all[bone.node].position);
        high = glm::max(high, all[bone.node].position);
    }
    Tolerance result;
    const double size = glm::length(high - low);
    result.length = std::max(2.5e-6 * size, 1e-6 / metres);
    result.levers.assign(body.bones.size(), std::max(0.02 * size, 0.01 / metres));
    for (std::size_t i = body.bones.size(); i-- > 0;) {
        const Bone& bone = body.bones[i];
        if (bone.parent < 0) continue;
        const auto parent = static_cast<std::size_t>(bone.parent);
        const double away = glm::length(all[bone.node].position - all[body.bones[parent].node].position);
        result.levers[parent] = std::max(result.levers[parent], away + result.levers[i]);
    }
    return result;
}

}  // namespace

ClipWriter::ClipWriter(const Body& body, double metres, std::size_t max_clip_keys)
    : body_(body), tolerance_(tolerance_for(body, metres)), keys_left_(max_clip_keys) {}

ClipWriter::Sources ClipWriter::translation_sources(std::size_t index) const {
    const Bone& bone = body_.bones[index];
    const Node& node = body_.nodes[bone.node];
    Sources sources{{bone.node, Animated::Translation}};
    if (node.has_pivots()) {
        sources.push_back({bone.node, Animated::Rotation});
        sources.push_back({bone.node, Animated::Scale});
    }
    if (is_apart(node) && body_.is_split[static_cast<std::size_t>(node.parent)])
        for (const std::size_t each : body_.scale_chain(static_cast<std::size_t>(node.parent)))
            sources.push_back({each, Animated::Scale});
    return sources;
}
ClipWriter::Sources ClipWriter::scale_sources(std::size_t index) const {
    Sources sources;
    for (const std::size_t each : body_.scale_chain(body_.bones[index].node))
        sources.push_back({each, Animated::Scale});
    return sources;
}

template <class T, class Value, class Error>
Track<T> ClipWriter::track(const Stack& stack, const std::vector<const Curve*>& curves, const Value& value,
                           const Error& error, bool is_set) {
    Track<T> result;
    if (!is_set) return result;
    const bool is_step = all_constant(curves);
    const std::vector<double> times = key_times(stack, curves, !is_step);
    if (times.size() > keys_left_) throw std::runtime_error("has too many keys for its size");
    const auto seconds = [&](double time) { return std::min(time, stack.end) - stack.begin; };
    for (const double time : times) {
        const T at = value(time);
        result.values.push_back(result.values.empty() ? at : toward(at, result.values.back()));
        result.times.push_back(seconds(time));
    }
    keys_left_ -= times.size();
    if (is_step) {
        result.interpolation = Interpolation::Step;
        return result;
    }
    const auto is_linear = [&](std::size_t i) {
        const double span = times[i] - times[i - 1];
        return span <= 2.0 * jump_seconds(times[i]) || std::ranges::none_of(compared, [&](double u) {
                   return error(between(result.values[i - 1], result.values[i], u),
                                value(times[i - 1] + u * span));
               });
    };
    bool linear = true;
    for (std::size_t i = 1; i < times.size() && linear; ++i) linear = is_linear(i);
    if (linear) return result;
    const std::vector<Knot<T>> knots = CubicSpans<T, Value, Error>(value, error, keys_left_).fit(times);
    result = {.interpolation = Interpolation::Cubic};
    for (const Knot<T>& knot : knots) {
        result.times.push_back(seconds(knot.time));
        result.values.insert(result.values.end(), {knot.arriving, knot.value, knot.leaving});
    }
    return result;
}

void ClipWriter::add_channel(const Stack& stack, std::size_t bone, humanoid::Clip& clip) {
    const auto transform_at = [&](double time) {
        return body_.transform(bone, [&](std::size_t node) {
            return local_of(body_.nodes[node], stack.at(body_.nodes[node], node, time));
        });
    };
    bool is_set = false;
    const auto curves_of = [&](const Sources& sources) {
        std::vector<const Curve*> curves;
        is_set = false;
        for (const auto& source : sources) {
            stack.each_curve(source.first, source.second,
                             [&](const Curve& curve) { curves.push_back(&curve); });
            for (const Layer& layer : stack.layers)
                if (const auto found = layer.nodes.find(source.first); found != layer.nodes.end())
                    is_set = is_set || found->second[static_cast<std::size_t>(source.second)].has_value();
        }
        return curves;
    };
    humanoid::Channel channel{.node = bone};
    const double length = tolerance_.length, lever = tolerance_.levers[bone];
    const bool is_scale = body_.bones[bone].is_scale;
    if (!is_scale) {
        const auto moves = curves_of(translation_sources(bone));
        channel.translation = track<glm::dvec3>(
            stack, moves, [&](double time) { return transform_at(time).translation; },
            [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) > length; }, is_set);
        const auto turns = curves_of({{body_.bones[bone].node, Animated::Rotation}});
        channel.rotation = track<glm::dquat>(
            stack, turns, [&](double time) { return transform_at(time).rotation; },
            [&](const glm::dquat& a, const glm::dquat& b) {
                return angle_between(a, b) > std::min(max_angle, length / lever);
            },
            is_set);
    }
    const auto scales = curves_of(scale_sources(bone));
    channel.scale = track<glm::dvec3>(
        stack, scales, [&](double time) { return transform_at(time).scale; },
        [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) * lever > length; },
        is_set);
    if (!channel.translation.times.empty() || !channel.rotation.times.empty() || !channel.scale.times.empty())
        clip.channels.push_back(std::move(channel));
}

humanoid::Clip ClipWriter::clip(const Stack& stack) {
    humanoid::Clip clip;
    clip.name = stack.name;
    clip.duration = stack.end - stack.begin;
    for (std::size_t bone = 0; bone < body_.bones.size(); ++bone) add_channel(stack, bone, clip);
    return clip;
}

Track<glm::dvec3> ClipWriter::morph(const Stack& stack, std::size_t object, double percent) {
    std::vector<const Curve*> curves;
    bool is_set = false;
    for (const Layer& layer : stack.layers) {
        const auto found = layer.morphs.find(object);
        if (found == layer.morphs.end()) continue;
        is_set = true;
        if (const auto& curve = found->second.curves[0]) curves.push_back(curve.get());
        if (const auto& curve = layer.weight.curves[0]) curves.push_back(curve.get());
    }
    return track<glm::dvec3>(
        stack, curves,
        [&](double time) { return glm::dvec3(stack.morph_at(object, percent, time), 0.0, 0.0); },
        [](const glm::dvec3& a, const glm::dvec3& b) { return std::abs(a.x - b.x) > 0.1; }, is_set);
}

}  // namespace tendril::app::fbx
