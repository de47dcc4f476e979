#include "humanoid/lint/lint.hpp"

#include <algorithm>
#include <cstdio>

#include "humanoid/input.hpp"

namespace tendril::humanoid {
namespace lint_detail {

std::string shown(double value, int decimals) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

double Check::time_of(std::size_t frame) const noexcept {
    return std::min(static_cast<double>(frame) / report.rate, clip.duration);
}

std::string Check::name_of(std::int32_t node) const {
    return node < 0 ? "The figure" : skeleton[static_cast<std::size_t>(node)].name;
}

Finding& Check::add(Fault fault, std::int32_t node, std::size_t frame, std::size_t first, std::size_t last,
                    double amount, const char* unit, const std::string& text) {
    Finding finding{fault, node, frame, first, last, time_of(frame), amount, unit, false, false, false, {}};
    finding.text = name_of(node) + ' ' + text;
    finding.text += first == last ? " (frame " : " (frames ";
    finding.text += std::to_string(first);
    if (first != last) finding.text += " to " + std::to_string(last);
    finding.text += ')';
    report.findings.push_back(std::move(finding));
    return report.findings.back();
}

LintReport blank_report(const Clip& clip, const LintSettings& settings) {
    LintReport report;
    report.rate = settings.rate > 0.0 ? std::min(settings.rate, 1000.0) : frame_rate(clip);
    report.frames = std::min(frames_at(clip, report.rate).count, max_lint_frames);
    return report;
}

namespace {

/// The largest extent of the nodes at rest, which for a lying figure is its length.
double height_of(const Skeleton& skeleton) {
    std::vector<Placement> placements(skeleton.size());
    place(skeleton, rest_pose(skeleton), placements);
    glm::dvec3 low(1e9), high(-1e9);
    for (const Placement& each : placements)
        for (int i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], each.position[i]);
            high[i] = std::max(high[i], each.position[i]);
        }
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z, 0.0});
}

}  // namespace
}  // namespace lint_detail

const char* name(Fault fault) noexcept {
    constexpr const char* names[] = {"skating", "floating", "sinking", "knee_pop", "sign_flip",
                                     "limit",   "jump",     "scale",   "axis"};
    return names[static_cast<std::size_t>(fault)];
}

double frame_rate(const Clip& clip) noexcept {
    constexpr double otherwise = 60.0;
    if (clip.rate >= 20.0 && clip.rate <= 1000.0) return clip.rate;
    const std::vector<double>* densest = nullptr;
    const auto look_at = [&](const std::vector<double>& times) {
        if (times.size() > 1 && (!densest || times.size() > densest->size())) densest = &times;
    };
    for (const Channel& channel : clip.channels) {
        look_at(channel.translation.times);
        look_at(channel.rotation.times);
        look_at(channel.scale.times);
    }
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

LintReport lint(const Skeleton& skeleton, const BoneMap& given, const Clip& clip,
                const LintSettings& settings) {
    const BoneMap& map = detail::map_or_none(given, skeleton);
    LintReport report = lint_detail::blank_report(clip, settings);
    lint_detail::Check check{skeleton, map, clip, settings, lint_detail::height_of(skeleton), report};
    check_signs(check);
    check_sizes(check);
    check_axis(check);
    check_jumps(check);
    check_limits(check);
    check_knees(check);
    check_feet(check);
    std::stable_sort(report.findings.begin(), report.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.frame < b.frame; });
    return report;
}

}  // namespace tendril::humanoid
