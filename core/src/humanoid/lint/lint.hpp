// What the parts of the lint share. Not installed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rig/math.hpp"
#include "tendril/humanoid/lint.hpp"

namespace tendril::humanoid::lint_detail {

inline constexpr double degrees = 180.0 / rig::detail::pi;

/// Numbers of a sentence: "62", "1.5"
std::string shown(double value, int decimals = 0);

/// What every check is given, and where it puts what it finds.
struct Check {
    const Skeleton& skeleton;
    const BoneMap& map;
    const Clip& clip;
    const LintSettings& settings;
    double height;  ///< of the figure at rest, metres
    LintReport& report;

    double time_of(std::size_t frame) const noexcept;
    /// "LeftFoot"; "the figure" where there is no node.
    std::string name_of(std::int32_t node) const;
    /// `text` is put after the node's name: "LeftFoot slides 62 mm".
    Finding& add(Fault fault, std::int32_t node, std::size_t frame, std::size_t first, std::size_t last,
                 double amount, const char* unit, const std::string& text);
};

/// Of a clip before anything was found in it.
LintReport blank_report(const Clip& clip, const LintSettings& settings);

void check_feet(Check& check);
void check_knees(Check& check);
void check_jumps(Check& check);
void check_limits(Check& check);
void check_signs(Check& check);
void check_sizes(Check& check);
void check_axis(Check& check);

// Outliers in the motion of one thing from frame to frame.
struct Outlier {
    std::size_t frame;  ///< the first that is elsewhere
    std::size_t until;  ///< the first after that which is back; the number of frames: none is
    double amount;      ///< how far
};
/// `moves[i]` is the way from frame i - 1 to frame i, moves[0] is not read. One that is over `minimum` and
/// over three times what the motion changes by from frame to frame around it.
std::vector<Outlier> outliers(const std::vector<glm::dvec3>& moves, double minimum);

/// The way from a value to the next: in degrees about each axis for rotations.
glm::dvec3 step_between(const glm::dvec3& from, const glm::dvec3& to) noexcept;
glm::dvec3 step_between(const glm::dquat& from, const glm::dquat& to) noexcept;

/// What the translations of a clip are of the skeleton's, nearly all of them alike; none where they are not.
std::optional<double> size_of_clip(const Skeleton& skeleton, const Clip& clip);
/// The turn that sets a clip upright of which every frame lies; none where it need not.
std::optional<glm::dquat> upright_turn(const Skeleton& skeleton, const BoneMap& map, const Clip& clip);

}  // namespace tendril::humanoid::lint_detail
