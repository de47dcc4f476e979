// Shared by the checks of the lint. Not installed.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "rig/math.hpp"
#include "tendril/humanoid/lint.hpp"

namespace tendril::humanoid::lint_detail {

inline constexpr double degrees = 180.0 / rig::detail::pi;

/// "62", "1.5"
std::string shown(double value, int decimals = 0);

/// The input of every check, and the report to which it adds findings.
struct Check {
    const Skeleton& skeleton;
    const BoneMap& map;
    const Clip& clip;
    const LintSettings& settings;
    double height;  ///< the figure's height at rest, metres; judge() sets it
    LintReport& report;
    std::size_t begin = 0;  ///< the first frame judged; the checks count from it, findings from time 0

    double time_of(std::size_t frame) const noexcept;
    /// "LeftFoot"; "The figure" if `node` is negative.
    std::string name_of(std::int32_t node) const;
    /// `text` follows the node's name: "LeftFoot slides 62 mm".
    Finding& add(Fault fault, std::int32_t node, std::size_t frame, std::size_t first, std::size_t last,
                 double amount, const char* unit, const std::string& text);
};

/// Adds the findings of all checks. A check that begins with a report on the clip's feet keeps their floor.
void judge(Check& check);

/// An empty report on a clip: only rate and frames are set.
LintReport blank_report(const Clip& clip, const LintSettings& settings);

void check_feet(Check& check);
void check_knees(Check& check);
void check_jumps(Check& check);
void check_limits(Check& check);
void check_signs(Check& check);
void check_sizes(Check& check);
void check_axis(Check& check);

struct Outlier {
    std::size_t frame;  ///< the first frame that departs from the motion
    std::size_t until;  ///< the first frame back on it; the number of frames if none is
    double amount;      ///< size of the departure
};
/// Finds departures over `minimum` that stand out from the motion around them. `moves[i]` is the motion from
/// frame i - 1 to frame i; moves[0] is not read.
std::vector<Outlier> outliers(const std::vector<glm::dvec3>& moves, double minimum);

/// Scales thresholds that are given for 60 frames per second: at lower rates, more happens in each frame.
inline double fps_scale(double rate) noexcept {
    return (2.0 + 60.0 / rate) / 3.0;
}

/// 1 at 0, 0 from 1 on; smooth.
inline double falloff(double u) noexcept {
    return u >= 1.0 ? 0.0 : (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u);
}
/// The median of at least one value, the larger of two in the middle. Reorders the values.
inline double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The motion from one value to the next; for rotations a rotation vector in degrees.
glm::dvec3 step_between(const glm::dvec3& from, const glm::dvec3& to) noexcept;
glm::dvec3 step_between(const glm::dquat& from, const glm::dquat& to) noexcept;

/// The ratio of the clip's bone lengths to the skeleton's, if most bones agree and it is not between 0.5 and
/// 2; otherwise nullopt.
std::optional<double> size_of_clip(const Skeleton& skeleton, const Clip& clip);
/// The rotation that turns a clip upright, if its figure walks lying on its side; otherwise nullopt.
std::optional<glm::dquat> upright_turn(const Skeleton& skeleton, const BoneMap& map, const Clip& clip);

struct FootCure {
    double ease = 0.15;     ///< seconds of blending into the clip before and after
    double nearer = 0.005;  ///< metres that soft IK brings a foot nearer to the hip at a leg's full length
};

/// The clip without the fault: the foot stands, or its leg no longer snaps. Refuses a finding that is not in
/// the clip, and one whose cure would reach beyond the judged frames.
Expected<Clip> cure_foot(const Check& check, const Finding& finding, const FootCure& options);

}  // namespace tendril::humanoid::lint_detail
