// Commands of the Linkage lab.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "app/document/command.hpp"
#include "app/fields/fields.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/linkage/linkage_part.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {

/// Commands for presets, lengths, drivers, motors, targets and drags.
void add_linkage_commands(CommandTable& table);
/// Commands for drawing a linkage by hand: joints, bars, pins.
void add_sketch_commands(CommandTable& table);

inline bool is_on_bar(const ik::SketchBar& bar, std::size_t point) {
    return std::ranges::count(bar.points, point) > 0;
}
/// The direction of a sliding joint's line.
inline glm::dvec2 guide_direction(const ik::SketchPoint& point) {
    return {math::cosine(point.guide), math::sine(point.guide)};
}
/// That line's field, for the command linkage.guide and the inspector.
std::span<const Field> guide_fields();
/// The bars that meet at a point of the sketch.
std::vector<std::size_t> bars_at(const ik::LinkageSketch& sketch, std::size_t point);
/// True if the inspector offers a motor for each pair of bars at the point: it is free and has few bars.
bool chooses_pair(const ik::LinkageSketch& sketch, std::size_t point);
/// Changes the length of a bar with two joints. The others keep their lengths; motors and held joints stay if
/// they can. Throws Refused with the length that can be reached.
void set_bar_length(ik::LinkageSketch& sketch, std::size_t bar, double metres);
/// Reads lengths by name from an object; omitted ones stay the same. Throws std::runtime_error with the JSON
/// path of the error.
void read_lengths(const JsonPlace& lengths, Mechanism& mechanism);
/// Advances all motors by one tick.
void run_motors(LinkagePart& part, double seconds, LinkageRuntime& runtime);
/// True if the motor is switched on, even if it cannot move.
inline bool is_running(const LinkageDrive& drive) {
    return drive.rate != 0.0;
}
/// True if a driver is still short of a value that one solve could not reach; the next solve continues.
bool goes_on(const LinkagePart& part);
/// True if the motor cannot continue: it is at a dead point, or at the end of a range.
bool is_stalled(const LinkagePart& part, const LinkageDrive& drive);

/// An argument that names a point.
Argument linkage_point_argument(const char* name, bool required, const char* help);
/// Throws Refused unless the joint is a hinge or slider.
void require_linkage_joint(const LinkagePart& part, const std::string& joint);
/// Throws Refused if there is no point of that name.
std::size_t require_linkage_point(const LinkagePart& part, const std::string& name);

}  // namespace tendril::app

template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::ik::SketchPoint>();
