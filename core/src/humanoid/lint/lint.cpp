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
    return std::min(static_cast<double>(begin + frame) / report.rate, clip.duration);
}

std::string Check::name_of(std::int32_t node) const {
    return node < 0 ? "The figure" : skeleton[static_cast<std::size_t>(node)].name;
}

Finding& Check::add(Fault fault, std::int32_t node, std::size_t frame, std::size_t first, std::size_t last,
                    double amount, const char* unit, const std::string& text) {
    Finding finding{.fault = fault,
                    .node = node,
                    .frame = begin + frame,
                    .first = begin + first,
                    .last = begin + last,
                    .time = time_of(frame),
                    .amount = amount,
                    .unit = unit};
    finding.text = name_of(node) + ' ' + text;
    finding.text += first == last ? " (frame " : " (frames ";
    finding.text += std::to_string(finding.first);
    if (first != last) finding.text += " to " + std::to_string(finding.last);
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

/// The largest extent of the nodes at rest; for a lying figure, its length.
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

void judge(Check& check) {
    check.height = height_of(check.skeleton);
    check_signs(check);
    check_sizes(check);
    check_axis(check);
    check_jumps(check);
    check_limits(check);
    check_knees(check);
    check_feet(check);
    std::ranges::stable_sort(check.report.findings, {}, &Finding::frame);
}

}  // namespace lint_detail

const char* name(Fault fault) noexcept {
    constexpr const char* names[] = {"skating", "floating", "sinking", "knee_pop", "sign_flip",
                                     "limit",   "jump",     "scale",   "axis"};
    return names[static_cast<std::size_t>(fault)];
}

LintReport lint(const Skeleton& skeleton, const BoneMap& given, const Clip& clip,
                const LintSettings& settings) {
    const BoneMap& map = detail::map_or_none(given, skeleton);
    LintReport report = lint_detail::blank_report(clip, settings);
    lint_detail::Check check{skeleton, map, clip, settings, 0.0, report};
    judge(check);
    return report;
}

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::LintSettings>() noexcept {
    using humanoid::LintSettings;
    static constexpr FieldRange metres{0.0, 1e3}, degrees{0.0, 180.0};
    static constexpr Field rows[] = {field<&LintSettings::rate>("rate", {0.0, 1000.0}, "1/s"),
                                     field<&LintSettings::skating>("skating", metres, "m"),
                                     field<&LintSettings::floating>("floating", metres, "m"),
                                     field<&LintSettings::sinking>("sinking", metres, "m"),
                                     field<&LintSettings::knee>("knee", degrees, "deg"),
                                     field<&LintSettings::turn>("turn", degrees, "deg"),
                                     field<&LintSettings::shift>("shift", {0.0, 1e3}),
                                     field<&LintSettings::beyond>("beyond", degrees, "deg")};
    return rows;
}
