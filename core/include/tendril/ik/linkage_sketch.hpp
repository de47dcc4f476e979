// Linkages in the plane z = 0, drawn as joints and bars: the tree and its closures follow.
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
    Pinned,  ///< it stays where it is
    Guided   ///< it slides along a line through where it is drawn
};
/// "free", "pinned", "guided"
const char* name(SketchHold hold) noexcept;

struct SketchPoint {
    std::string name{};
    glm::dvec2 at{0.0};  ///< metres
    SketchHold hold = SketchHold::Free;
    double guide = 0.0;  ///< direction of its line from +X, radians
    bool operator==(const SketchPoint&) const = default;
};

/// A rigid bar through two points or more.
struct SketchBar {
    std::string name{};
    std::vector<std::size_t> points{};
    bool operator==(const SketchBar&) const = default;
};

/// A hinge that can be driven, or has a range. Its angle, radians, is the direction of `bar`, from the hinge
/// to its first other point, counted from +X, or from the direction of `against`.
struct SketchMotor {
    std::string name{};  ///< of the driven link
    std::size_t point = 0;
    std::size_t bar = 0;
    std::size_t against = ground_link;  ///< another bar; by default the ground, to which the point is pinned
    /// The joint starts at the drawn angle, plus the full turns that bring it nearest to 0 in this range.
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    bool operator==(const SketchMotor&) const = default;
};

struct LinkageSketch {
    std::vector<SketchPoint> points{};
    std::vector<SketchBar> bars{};
    std::vector<SketchMotor> motors{};

    /// nullopt if there is none of that name.
    std::optional<std::size_t> find_point(std::string_view name) const noexcept;
    std::optional<std::size_t> find_bar(std::string_view name) const noexcept;
    bool operator==(const LinkageSketch&) const = default;
};

/// The first bar of each bar's rigid body, or ground_link for bars that cannot move. The bars of a body
/// cannot turn against each other. Judged by the rank of the closures as drawn, so three bars in one line are
/// not recognised as one body. A bar that linkage_from() refuses is a body of its own. Costs O(bars^3) for
/// each set of bars that is split.
std::vector<std::size_t> rigid_bodies(const LinkageSketch& sketch);

/// Removes the point, the bars that would have one point left, and the motors of these; OutOfRange for an
/// index that is not there. Likewise remove_bar: its points stay.
Result remove_point(LinkageSketch& sketch, std::size_t point);
Result remove_bar(LinkageSketch& sketch, std::size_t bar);

/// The linkage as drawn. Its points are the sketch's, in their order; links are named after their bars, or
/// after the motor that drives them. A guided point is a slider's link, with the point's name, whose value is
/// how far it is from the origin along its line.
///
/// Bars that no pin or guide reaches float: they cannot be placed, and are refused, as are bars of fewer than
/// two points or of no length, points or bars that are not there, motors in a circle, between bars of one
/// rigid body or drawn outside their range, two links of one name, and what check() refuses. Each message has
/// the name.
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
