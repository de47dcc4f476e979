#include <algorithm>

#include "humanoid/input.hpp"
#include "humanoid/lint/cure_foot.hpp"
#include "humanoid/lint/tracks.hpp"
#include "math/checks.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;
using lint_detail::value_at;

constexpr double ease = 0.125;  // seconds before and after a jump over which it is spread

template <class T>
std::size_t width_of(const Track<T>& track) {
    return track.interpolation == Interpolation::Cubic ? 3 : 1;
}

glm::dquat weighted(const glm::dquat& turn, double weight) {
    return rig::blend(glm::dquat(1.0, 0.0, 0.0, 0.0), turn, weight);
}
glm::dvec3 weighted(const glm::dvec3& way, double weight) {
    return times(way, weight);
}
glm::dquat way_between(const glm::dquat& from, const glm::dquat& to) {
    return math::compose(to, conjugate(from));
}
glm::dvec3 way_between(const glm::dvec3& from, const glm::dvec3& to) {
    return minus(to, from);
}
glm::dquat moved(const glm::dquat& value, const glm::dquat& way) {
    return rig::normalised(math::compose(way, value));
}
glm::dvec3 moved(const glm::dvec3& value, const glm::dvec3& way) {
    return plus(value, way);
}

double likeness(const glm::dquat& a, const glm::dquat& b) {
    return dot(a, b);
}
double likeness(const glm::dvec3&, const glm::dvec3&) {
    return 1.0;
}

/// After the keys from `first` to `last` have got new values: gives a cubic track new tangents at these keys
/// and the ones next to them, the slopes between neighbouring keys. Exporters derive the tangents of the
/// neighbours from the bad values, too. Negates quaternions where the sign changes, since a cubic does not
/// take the short way; the rest of the track follows, so that its keys keep their signs relative to each
/// other.
template <class T>
void refit_tangents(Track<T>& track, double first, double last) {
    if (track.interpolation != Interpolation::Cubic) return;
    const auto from = std::lower_bound(track.times.begin(), track.times.end(), first) - track.times.begin();
    const auto to = std::upper_bound(track.times.begin(), track.times.end(), last) - track.times.begin();
    if (from == to) return;
    const std::size_t count = track.times.size();
    const auto begin =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(from - 1, 0));  // with both neighbours
    const std::size_t end = std::min(static_cast<std::size_t>(to) + 1, count);
    const auto key = [&](std::size_t i) -> T& { return track.values[3 * i + 1]; };
    for (std::size_t i = begin + 1; i < end; ++i)
        if (likeness(key(i - 1), key(i)) < 0.0)
            for (std::size_t k = 3 * i; k < track.values.size(); ++k) track.values[k] = -track.values[k];
    for (std::size_t i = begin; i < end; ++i) {
        const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, count - 1);
        const double seconds = track.times[after] - track.times[before];
        if (!(seconds > 0.0)) continue;
        const T slope = (key(after) - key(before)) / seconds;
        track.values[3 * i] = track.values[3 * i + 2] = slope;
    }
}

/// Interpolates the keys from `first` to `last` between the track's values at `before` and `after`.
template <class T>
void bridge(const Channel& was, Track<T>& track, double before, double first, double last, double after) {
    const T from = value_at(was, before, track), to = value_at(was, after, track);
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        const double time = track.times[i];
        if (time < first || time > last) continue;
        const double part = (time - before) / (after - before);
        T& value = track.values[width_of(track) == 3 ? 3 * i + 1 : i];
        value = moved(from, weighted(way_between(from, to), part));
    }
    refit_tangents(track, first, last);
}

/// Spreads the jump between two times over the keys around it: those before it make half of the way early,
/// those after it the other half late.
template <class T>
void spread(const Channel& was, Track<T>& track, double before, double after) {
    const T from = value_at(was, before, track), to = value_at(was, after, track);
    const double middle = 0.5 * (before + after);
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        const double off = track.times[i] - middle, u = std::abs(off) / ease;
        if (u >= 1.0) continue;
        const double weight = 0.5 * (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u);
        T& value = track.values[width_of(track) == 3 ? 3 * i + 1 : i];
        value = moved(value, weighted(off < 0.0 ? way_between(from, to) : way_between(to, from), weight));
    }
    refit_tangents(track, middle - ease, middle + ease);
}

void mend_signs(Track<glm::dquat>& track) {
    const std::size_t width = width_of(track);
    for (std::size_t i = 1; i < track.times.size(); ++i) {
        const std::size_t middle = width == 3 ? 1 : 0;
        const glm::dquat& last = track.values[(i - 1) * width + middle];
        if (dot(last, track.values[i * width + middle]) >= 0.0) continue;
        for (std::size_t k = 0; k < width; ++k) track.values[i * width + k] = -track.values[i * width + k];
    }
}

void mend_jump(const Clip& clip, const Finding& finding, double rate, Channel& channel) {
    const Channel was = channel;
    const double frame = 1.0 / rate;
    const double first = static_cast<double>(finding.first) * frame;
    const double last = static_cast<double>(finding.last) * frame;
    const double before = std::max(first - frame, 0.0), after = std::min(last + frame, clip.duration);
    const bool turns = finding.fault == Fault::KneePop || finding.unit[0] == 'd';
    const auto mend = [&](auto& track) {
        if (track.times.empty()) return;
        if (finding.goes_on)
            spread(was, track, before, first);
        else
            bridge(was, track, before, first - 0.25 * frame, last + 0.25 * frame, after);
    };
    if (turns)
        mend(channel.rotation);
    else
        mend(channel.translation);
}

void scale_by(Clip& clip, double by) {
    for (Channel& channel : clip.channels)
        for (glm::dvec3& value : channel.translation.values) value = times(value, by);
}

void turn_by(const Skeleton& skeleton, Clip& clip, const glm::dquat& turn) {
    for (std::size_t i = 0; i < skeleton.size(); ++i) {
        if (skeleton[i].key_parent() >= 0) continue;
        const auto found = std::find_if(clip.channels.begin(), clip.channels.end(),
                                        [&](const Channel& each) { return each.node == i; });
        Channel& channel =
            found != clip.channels.end() ? *found : clip.channels.emplace_back(Channel{.node = i});
        const rig::Transform& rest = skeleton[i].key_rest();
        if (channel.translation.times.empty())
            channel.translation = {Interpolation::Step, {0.0}, {rest.translation}};
        if (channel.rotation.times.empty()) channel.rotation = {Interpolation::Step, {0.0}, {rest.rotation}};
        for (glm::dvec3& value : channel.translation.values) value = rotated(turn, value);
        for (glm::dquat& value : channel.rotation.values) value = math::compose(turn, value);
    }
}

}  // namespace

Expected<Clip> cure(const Skeleton& skeleton, const BoneMap& map, const Clip& clip, const Finding& finding,
                    const LintSettings& settings) {
    if (!finding.has_cure)
        return tendril::detail::refused("cure", "finding", "one that has a cure", name(finding.fault));
    if (const Result bad = detail::check_map("cure", map, skeleton); !bad) return bad;
    if (finding.node >= static_cast<std::int32_t>(skeleton.size()))
        return tendril::detail::refused("cure", "finding.node", "the index of a node", finding.node);
    LintReport report = lint_detail::blank_report(clip, settings);
    if (finding.first > finding.last || finding.last >= report.frames)
        return tendril::detail::refused("cure", "finding", "one of this clip",
                                        std::string_view(finding.text));
    if (finding.fault == Fault::Skating || finding.fault == Fault::Floating ||
        finding.fault == Fault::Sinking || finding.snaps)
        return lint_detail::cure_foot({skeleton, map, clip, settings, 0.0, report}, finding);
    Clip cured = clip;
    const double rate = report.rate;
    const auto each_of = [&](std::initializer_list<std::int32_t> nodes, auto mend) {
        for (Channel& channel : cured.channels)
            for (const std::int32_t node : nodes)
                if (node >= 0 && channel.node == static_cast<std::size_t>(node)) mend(channel);
    };
    const auto node_of = [&](Bone bone) { return map[bone].node; };
    switch (finding.fault) {
        case Fault::SignFlip:
            each_of({finding.node}, [](Channel& channel) { mend_signs(channel.rotation); });
            break;
        case Fault::Jump:
            each_of({finding.node}, [&](Channel& channel) { mend_jump(clip, finding, rate, channel); });
            break;
        case Fault::KneePop: {
            const bool left = finding.node == node_of(Bone::LeftLowerLeg);
            each_of({node_of(left ? Bone::LeftUpperLeg : Bone::RightUpperLeg), finding.node,
                     node_of(left ? Bone::LeftFoot : Bone::RightFoot)},
                    [&](Channel& channel) { mend_jump(clip, finding, rate, channel); });
            break;
        }
        case Fault::Scale:
            if (const auto size = lint_detail::size_of_clip(skeleton, clip)) scale_by(cured, 1.0 / *size);
            break;
        case Fault::Axis:
            if (const auto turn = lint_detail::upright_turn(skeleton, map, clip))
                turn_by(skeleton, cured, *turn);
            break;
        default:
            break;
    }
    return cured;
}

}  // namespace tendril::humanoid
