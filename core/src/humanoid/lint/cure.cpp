#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "humanoid/input.hpp"
#include "humanoid/lint/lint.hpp"
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
glm::dvec3 weighted(const glm::dvec3& offset, double weight) {
    return times(offset, weight);
}
glm::dquat difference(const glm::dquat& from, const glm::dquat& to) {
    return math::compose(to, conjugate(from));
}
glm::dvec3 difference(const glm::dvec3& from, const glm::dvec3& to) {
    return minus(to, from);
}
glm::dquat moved(const glm::dquat& value, const glm::dquat& offset) {
    return rig::normalised(math::compose(offset, value));
}
glm::dvec3 moved(const glm::dvec3& value, const glm::dvec3& offset) {
    return plus(value, offset);
}

double alignment(const glm::dquat& a, const glm::dquat& b) {
    return dot(a, b);
}
double alignment(const glm::dvec3&, const glm::dvec3&) {
    return 1.0;
}

/// Call after changing the keys from `first` to `last`. Gives a cubic track new tangents at these keys and
/// their neighbours: the slopes between neighbouring keys, since exporters derive the neighbours' tangents
/// from the bad values too. Negates quaternions where the sign changes, since a cubic does not take the short
/// way; the rest of the track is negated with them, so that its keys keep their relative signs.
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
        if (alignment(key(i - 1), key(i)) < 0.0)
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
void fill_gap(const Channel& was, Track<T>& track, double before, double first, double last, double after) {
    const T from = value_at(was, before, track), to = value_at(was, after, track);
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        const double time = track.times[i];
        if (time < first || time > last) continue;
        const double part = (time - before) / (after - before);
        T& value = track.values[width_of(track) == 3 ? 3 * i + 1 : i];
        value = moved(from, weighted(difference(from, to), part));
    }
    refit_tangents(track, first, last);
}

/// Spreads the jump between two times over the keys around it: the keys before it make half of it early,
/// those after it the other half late.
template <class T>
void spread_jump(const Channel& was, Track<T>& track, double before, double after) {
    const T from = value_at(was, before, track), to = value_at(was, after, track);
    const double middle = 0.5 * (before + after);
    for (std::size_t i = 0; i < track.times.size(); ++i) {
        const double off = track.times[i] - middle, u = std::abs(off) / ease;
        if (u >= 1.0) continue;
        const double weight = 0.5 * lint_detail::falloff(u);
        T& value = track.values[width_of(track) == 3 ? 3 * i + 1 : i];
        value = moved(value, weighted(off < 0.0 ? difference(from, to) : difference(to, from), weight));
    }
    refit_tangents(track, middle - ease, middle + ease);
}

void fix_signs(Track<glm::dquat>& track) {
    if (track.interpolation == Interpolation::Step) return;
    const std::size_t width = width_of(track);
    for (std::size_t i = 1; i < track.times.size(); ++i) {
        const std::size_t middle = width == 3 ? 1 : 0;
        const glm::dquat& last = track.values[(i - 1) * width + middle];
        if (dot(last, track.values[i * width + middle]) >= 0.0) continue;
        for (std::size_t k = 0; k < width; ++k) track.values[i * width + k] = -track.values[i * width + k];
    }
}

void fix_jump(const Clip& clip, const Finding& finding, double rate, Channel& channel) {
    const Channel was = channel;
    const double frame = 1.0 / rate;
    const double first = static_cast<double>(finding.first) * frame;
    const double last = static_cast<double>(finding.last) * frame;
    const double before = std::max(first - frame, 0.0), after = std::min(last + frame, clip.duration);
    const bool turns = finding.fault == Fault::KneePop || finding.unit[0] == 'd';
    const auto fix = [&](auto& track) {
        if (track.times.empty()) return;
        if (finding.goes_on)
            spread_jump(was, track, before, first);
        else
            fill_gap(was, track, before, first - 0.25 * frame, last + 0.25 * frame, after);
    };
    if (turns)
        fix(channel.rotation);
    else
        fix(channel.translation);
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

bool is_of_foot(const Finding& finding) {
    return finding.fault == Fault::Skating || finding.fault == Fault::Floating ||
           finding.fault == Fault::Sinking || finding.snaps;
}

/// The clip with the keys around the finding changed.
Clip repaired(const Skeleton& skeleton, const BoneMap& map, const Clip& clip, const Finding& finding,
              double rate) {
    Clip cured = clip;
    const auto each_of = [&](std::initializer_list<std::int32_t> nodes, auto fix) {
        for (Channel& channel : cured.channels)
            for (const std::int32_t node : nodes)
                if (node >= 0 && channel.node == static_cast<std::size_t>(node)) fix(channel);
    };
    const auto node_of = [&](Bone bone) { return map[bone].node; };
    switch (finding.fault) {
        case Fault::SignFlip:
            for (Channel& channel : cured.channels) fix_signs(channel.rotation);
            break;
        case Fault::Jump:
            each_of({finding.node}, [&](Channel& channel) { fix_jump(clip, finding, rate, channel); });
            break;
        case Fault::KneePop: {
            const bool left = finding.node == node_of(Bone::LeftLowerLeg);
            each_of({node_of(left ? Bone::LeftUpperLeg : Bone::RightUpperLeg), finding.node,
                     node_of(left ? Bone::LeftFoot : Bone::RightFoot)},
                    [&](Channel& channel) { fix_jump(clip, finding, rate, channel); });
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

/// The frames of a clip in which findings are judged and cured.
struct Window {
    const Skeleton& skeleton;
    const BoneMap& map;
    const LintSettings& settings;
    LintReport blank;  ///< of these frames
    std::size_t begin = 0;

    LintReport judged(const Clip& clip) const {
        LintReport report = blank;
        lint_detail::Check check{skeleton, map, clip, settings, 0.0, report, begin};
        judge(check);
        return report;
    }
    Expected<Clip> cured(const Clip& clip, const Finding& finding,
                         const lint_detail::FootCure& options) const {
        LintReport report = blank;
        if (!is_of_foot(finding)) return repaired(skeleton, map, clip, finding, report.rate);
        return cure_foot({skeleton, map, clip, settings, 0.0, report, begin}, finding, options);
    }
};

/// The maximum turn of a node from one frame to the next, degrees.
double fastest_turn(const Clip& clip, std::int32_t node, const Window& window) {
    const auto channel = std::ranges::find_if(
        clip.channels, [&](const Channel& each) { return static_cast<std::int32_t>(each.node) == node; });
    if (channel == clip.channels.end()) return 0.0;
    double worst = 0.0;
    rig::Transform last, next;
    for (std::size_t i = 0; i < window.blank.frames; ++i) {
        const double time = static_cast<double>(window.begin + i) / window.blank.rate;
        sample(*channel, std::min(time, clip.duration), next);
        if (i > 0) worst = std::max(worst, length(lint_detail::step_between(last.rotation, next.rotation)));
        last = next;
    }
    return worst;
}

/// True if a leg joint turns faster than before, and faster than the lint tolerates.
bool turns_faster(const Window& window, const Clip& before, const Clip& after) {
    const LintSettings& settings = window.settings;
    for (const Bone bone : {Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot, Bone::RightUpperLeg,
                            Bone::RightLowerLeg, Bone::RightFoot}) {
        const bool is_knee = bone == Bone::LeftLowerLeg || bone == Bone::RightLowerLeg;
        const std::int32_t node = window.map[bone].node;
        const double now = fastest_turn(after, node, window);
        if (now > (is_knee ? settings.knee : settings.turn) * lint_detail::fps_scale(window.blank.rate) &&
            now > fastest_turn(before, node, window))
            return true;
    }
    return false;
}

/// Cures to try in turn, until the clip has no new finding and no joint turns faster.
constexpr lint_detail::FootCure foot_cures[]{{.ease = 0.15, .nearer = 0.005},
                                             {.ease = 0.3, .nearer = 0.005},
                                             {.ease = 0.15, .nearer = 0.0025},
                                             {.ease = 0.3, .nearer = 0.0025},
                                             {.ease = 0.6, .nearer = 0.0025}};
/// Seconds before and after a finding that are judged with it, if the clip's report is known.
constexpr double seconds_around = 1.5;
/// Maximum number of further faults cured with the first: a foot brought down to the floor may slide there.
constexpr std::size_t max_follow_ups = 4;

bool is_same(const Finding& a, const Finding& b, double rate) {
    constexpr double moved = 0.05;  // seconds by which a finding may move
    const auto near = static_cast<std::size_t>(std::ceil(moved * rate));
    return a.fault == b.fault && a.node == b.node && a.first <= b.last + near && b.first <= a.last + near;
}

/// Judges no frame outside the window.
Expected<Clip> cured_in(const Window& window, const Clip& clip, const Finding& finding) {
    const LintReport before = window.judged(clip);
    std::optional<Clip> fallback;  // a cure that turns a joint faster
    for (const lint_detail::FootCure& options : foot_cures) {
        Expected<Clip> cured = window.cured(clip, finding, options);
        if (!cured) return cured;
        for (std::size_t more = 0; more < max_follow_ups; ++more) {
            const LintReport after = window.judged(*cured);
            const auto is_left = [&](const Finding& each) {
                return each.has_cure && is_same(each, finding, after.rate);
            };
            std::vector<Finding> wrong = new_findings(before, after);
            if (wrong.empty() && after.findings.size() < before.findings.size()) {
                if (!turns_faster(window, clip, *cured)) return cured;
                if (!fallback) fallback = std::move(*cured);
                break;
            }
            if (wrong.empty()) std::ranges::copy_if(after.findings, std::back_inserter(wrong), is_left);
            if (wrong.empty() || !wrong.front().has_cure) break;
            cured = window.cured(*cured, wrong.front(), options);
            if (!cured) break;
        }
        if (!is_of_foot(finding)) break;
    }
    if (fallback) return std::move(*fallback);
    return tendril::detail::refused("cure", "finding", "one whose cure makes no new fault",
                                    std::string_view(finding.text));
}

}  // namespace

std::vector<Finding> new_findings(const LintReport& before, const LintReport& after) {
    std::vector<Finding> found;
    for (const Finding& each : after.findings) {
        const bool is_old = std::ranges::any_of(
            before.findings, [&](const Finding& one) { return is_same(one, each, after.rate); });
        if (!is_old) found.push_back(each);
    }
    return found;
}

Expected<Clip> cure(const Skeleton& skeleton, const BoneMap& map, const Clip& clip, const Finding& finding,
                    const LintSettings& settings, const LintReport* report) {
    if (!finding.has_cure)
        return tendril::detail::refused("cure", "finding", "one that has a cure", name(finding.fault));
    if (const Result bad = detail::check_map("cure", map, skeleton); !bad) return bad;
    if (finding.node >= static_cast<std::int32_t>(skeleton.size()))
        return tendril::detail::refused("cure", "finding.node", "the index of a node", finding.node);
    Window window{skeleton, map, settings, lint_detail::blank_report(clip, settings)};
    const std::size_t frames = window.blank.frames;
    if (finding.first > finding.last || finding.last >= frames)
        return tendril::detail::refused("cure", "finding", "one of this clip",
                                        std::string_view(finding.text));
    const bool is_local =
        is_of_foot(finding) || finding.fault == Fault::Jump || finding.fault == Fault::KneePop;
    if (report && report->rate == window.blank.rate && is_local) {
        const auto around = static_cast<std::size_t>(std::ceil(seconds_around * report->rate));
        Window near = window;
        near.begin = finding.first - std::min(finding.first, around);
        near.blank.frames = std::min(finding.last + around + 1, frames) - near.begin;
        near.blank.feet = report->feet;
        Expected<Clip> cured = cured_in(near, clip, finding);
        if (cured || cured.code() != ErrorCode::OutOfRange) return cured;
    }
    return cured_in(window, clip, finding);
}

}  // namespace tendril::humanoid
