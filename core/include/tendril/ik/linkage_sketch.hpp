// Linkages in the plane z = 0, drawn as points and bars, from which linkage_from() makes links and closures.
//
//     LinkageSketch sketch;
//     sketch.points = {{"A", {0, 0}, SketchHold::Pinned}, {"B", {0.5, 0.9}}, {"C", {2, 1.5}},
//                      {"D", {3, 0}, SketchHold::Pinned}};
//     sketch.bars = {{"crank", {0, 1}}, {"coupler", {1, 2}}, {"rocker", {2, 3}}};
//     sketch.motors = {{"motor", 0, 0}};
//     const Expected<Linkage> linkage = linkage_from(sketch);
//
// Wherever bars share a point, a hinge joins them. A bar with three points is a ternary link. The sketch is a
// plain value; edit its lists, or use the functions below, which keep the indices right.
//
// Method: a spanning tree over the bars, from the ground, breadth first; motors' hinges are in it. The other
// hinges become closures. Cost: O(bars * points), with motors O(bars^3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/ik/linkage.hpp"

namespace tendril::ik {

/// How the ground holds a point.
enum class SketchHold : std::uint8_t {
    Free,    ///< not at all
    Pinned,  ///< stays where it is
    Guided   ///< slides along a line through its position as drawn
};
/// "free", "pinned", "guided"
const char* name(SketchHold hold) noexcept;

struct SketchPoint {
    std::string name{};
    glm::dvec2 at{0.0};  ///< metres
    SketchHold hold = SketchHold::Free;
    double guide = 0.0;  ///< angle of its line from +X, radians
    bool operator==(const SketchPoint&) const = default;
};

/// A rigid bar through two points or more.
struct SketchBar {
    std::string name{};
    std::vector<std::size_t> points{};
    bool operator==(const SketchBar&) const = default;
};

/// A hinge that can be driven or has a range. Its angle in radians is the direction of `bar`, from the hinge
/// to the bar's first other point, measured from +X or from the direction of `against`.
struct SketchMotor {
    std::string name{};  ///< name of the driven link
    std::size_t point = 0;
    std::size_t bar = 0;
    std::size_t against = ground_link;  ///< another bar; by default the ground, to which the point is pinned
    /// Range of the angle. The drawn angle gets the full turns that bring it into the range, nearest to 0.
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    bool operator==(const SketchMotor&) const = default;
};

struct LinkageSketch {
    std::vector<SketchPoint> points{};
    std::vector<SketchBar> bars{};
    std::vector<SketchMotor> motors{};

    /// nullopt for an unknown name.
    std::optional<std::size_t> find_point(std::string_view name) const noexcept;
    std::optional<std::size_t> find_bar(std::string_view name) const noexcept;
    bool operator==(const LinkageSketch&) const = default;
};

/// For each bar, the first bar of its rigid body, or ground_link if it cannot move. The bars of a body cannot
/// turn relative to each other. Found by the rank of the closures as drawn, so three bars in one line are not
/// recognised as one body. A bar that linkage_from() refuses is a body of its own. Costs O(bars^3) for each
/// set of bars that is split.
std::vector<std::size_t> rigid_bodies(const LinkageSketch& sketch);

/// Removes the point, the bars that would have one point left, and the motors of both; OutOfRange for a bad
/// index. remove_bar() keeps the bar's points.
Result remove_point(LinkageSketch& sketch, std::size_t point);
Result remove_bar(LinkageSketch& sketch, std::size_t bar);

/// The linkage as drawn. It has the sketch's points in their order; links are named after their bars, or
/// after the motor that drives them. A guided point becomes a slider's link with the point's name; its value
/// is the distance from the origin along its line.
///
/// Refuses bars that no pin or guide reaches, since they cannot be placed, bars with fewer than two points or
/// without length, missing points or bars, motors in a circle, motors between bars of one rigid body or drawn
/// outside their range, two links of one name, and everything that check() refuses. Messages give the name.
Expected<Linkage> linkage_from(const LinkageSketch& sketch);

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::SketchPoint>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::SketchBar>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::SketchMotor>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkageSketch>() noexcept;
