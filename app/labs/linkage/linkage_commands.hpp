// Commands of the Linkage lab.
#pragma once

#include <algorithm>

#include "app/document/command.hpp"
#include "app/document/json_place.hpp"
#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

/// Presets, lengths, drivers, motors, targets, drags.
void add_linkage_commands(CommandTable& table);
/// Joints, bars, pins: a linkage drawn by hand.
void add_sketch_commands(CommandTable& table);

/// Export: a complete C++ program that uses the library. The linkage, its motors through a second, its points
/// printed.
std::string linkage_code(const LinkagePart& part);

/// A motor that does not say turns this fast, degrees a second; a slider's moves a tenth of the linkage.
inline constexpr double usual_motor_rate = 90.0;

inline bool is_on_bar(const ik::SketchBar& bar, std::size_t point) {
    return std::ranges::count(bar.points, point) > 0;
}
/// The bars that meet at a point of the sketch.
std::vector<std::size_t> bars_at(const ik::LinkageSketch& sketch, std::size_t point);
/// Whether the inspector offers a motor between each two of them: nothing pins the joint, and they are few.
bool chooses_pair(const ik::LinkageSketch& sketch, std::size_t point);
/// Whether a bar, a motor or a sliding joint has the name: all are links.
bool is_link_name(const ik::LinkageSketch& sketch, const std::string& name);
/// Reads an object of lengths by their names; those that it leaves out stay. Throws std::runtime_error with
/// the place of what is wrong.
void read_lengths(const JsonPlace& lengths, Mechanism& mechanism);
/// One tick of all motors.
void run_motors(LinkagePart& part, double seconds, LinkageRuntime& runtime);
/// The motor is switched on, whether it can go on or not.
inline bool is_running(const LinkageDrive& drive) {
    return drive.rate != 0.0;
}
/// A driver is on its way to a value that one solve did not get to: the next one goes on.
bool goes_on(const LinkagePart& part);
/// A motor that cannot go on: at a dead point, or at the end of a range.
bool is_stalled(const LinkagePart& part, const LinkageDrive& drive);

/// A command that changes the part, given the lab's solver.
Command linkage_command(const char* name, const char* title, std::vector<Argument> arguments,
                        const char* help, void (*change)(LinkagePart&, const Arguments&, LinkageRuntime&),
                        Effect effect = Effect::Edit);
/// An argument that names a point.
Argument linkage_point_argument(const char* name, bool required, const char* help);
/// Throws Refused for anything but a hinge or slider.
void require_linkage_joint(const LinkagePart& part, const std::string& joint);
/// Throws Refused where there is none of that name.
std::size_t require_linkage_point(const LinkagePart& part, const std::string& name);

}  // namespace tendril::app
