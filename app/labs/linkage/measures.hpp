// Measurements of a linkage, in its pose and over the last ten seconds: values as displayed, angles,
// transmission, and why a motor stops.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/incident.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/linkage/linkage_part.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {

/// True if the link's joint is a hinge, so that its values are angles.
bool turns(const LinkagePart& part, std::string_view joint);
/// Converts a value or speed of the joint to degrees or metres, as in files, commands and panels; and back.
double in_degrees(const LinkagePart& part, std::string_view joint, double value);
double from_degrees(const LinkagePart& part, std::string_view joint, double value);
/// A command that runs the joint at a speed, degrees or metres per second.
CommandCall motor_call(const LinkagePart& part, const std::string& joint, ArgumentValue speed);

/// A joint's value as displayed, in degrees or metres. An angle in the plane without a range is shown within
/// its turn, 0 to 360.
struct ShownValue {
    double value = 0.0;
    int turns = 0;  ///< number of whole turns before it
};
ShownValue shown_value(const LinkagePart& part, std::string_view joint, double value);
/// "43.0 degrees", "0.250 m"
std::string value_text(const LinkagePart& part, std::string_view joint, double value);

/// Degrees, 0 to 180, between two bars at a point of the sketch, of different rigid bodies if two meet there.
/// A single bar, or one body on a pin, is measured from +X. NaN if there is no angle. `name`: "ABC", or "AB
/// to X" at A; "hip-knee-foot".
double angle_at(const LinkagePart& part, std::string_view point, std::string* name = nullptr);

/// Below this angle a coupler pushes poorly: the usual limit in textbooks on mechanisms.
inline constexpr double poor_transmission = 40.0;
/// Angle between the coupler and the bar or slider that it drives, 0 to 90 degrees; near 90 it pushes best.
/// The smallest if a crank drives several. NaN if no motor drives a four-bar or slider-crank.
double transmission_angle(const LinkagePart& part);
/// The smallest transmission angle in a turn, and the leading joint's value there. None if there is no turn.
struct WorstTransmission {
    double degrees = 90.0;
    double value = 0.0;
};
std::optional<WorstTransmission> worst_transmission(const LinkagePart& part, const LinkageTurn& turn);
/// Poses the part along its turn, to measure it there. Balls keep their rotations.
class PartInTurn {
  public:
    explicit PartInTurn(const LinkagePart& part) : part_(std::make_shared<LinkagePart>(part)) {}
    const std::shared_ptr<LinkagePart>& at(const LinkageTurn::Pose& pose) {
        part_->links = pose.links;
        for (std::size_t i = 0; i < pose.joints.size(); ++i) part_->state.joints[i].value = pose.joints[i];
        return part_;
    }

  private:
    std::shared_ptr<LinkagePart> part_;
};

/// The default speed of a motor, radians or metres per second: its last speed or, without one, 90 degrees or
/// a tenth of the linkage's size per second.
double usual_motor_rate(const LinkagePart& part, std::string_view joint, LinkageRuntime& runtime);
/// The held drivers; if none runs, the first one as a motor at its usual speed.
std::vector<LinkageDrive> moving_drives(const LinkagePart& part, LinkageRuntime& runtime);
/// Speed of a point in this pose, m/s, with moving_drives(). NaN for a point of the ground, without a motor,
/// at a dead point, or if the motors contradict each other.
double point_speed(const LinkagePart& part, std::string_view point, LinkageRuntime& runtime);
/// "0.52 m/s", or "523.6 mm/s" if the linkage is smaller than a metre.
std::string speed_text(const LinkagePart& part, double speed, LinkageRuntime& runtime);
/// "0.52 m/s", or "1.85 m/s at 90 deg/s" if the motor is at rest; empty if there is no speed.
std::string point_speed_text(const LinkagePart& part, std::string_view point, LinkageRuntime& runtime);

/// Degrees of freedom, including those of floating bars: three for each free piece, plus its internal ones.
ik::LinkageFreedom freedom_of(const LinkagePart& part);

/// Why the stopped motor or, if none is stopped, the first one is at a dead point, found from the forces that
/// balance its torque. Either two bodies with two joints each are in line, or the forces on a body with three
/// joints meet in a point. Bars joined by triangles are one body.
struct DeadPoint {
    std::vector<std::array<std::size_t, 2>> lines{};  ///< each from one point of the sketch to another
    std::string text{};                               ///< "B, C and D are in line"
};
/// `within`: rough distance of a joint from the dead point, in degrees. None for linkages in space, or if
/// more than three forces balance.
std::optional<DeadPoint> dead_point(const LinkagePart& part, LinkageRuntime& runtime, double within = 4.0);
/// The dead point's text; empty if there is none.
std::string dead_point_reason(const LinkagePart& part, LinkageRuntime& runtime, double within = 4.0);
/// "Crank at 43.0 degrees"
std::string stop_text(const LinkagePart& part);
/// The type of a four-bar with a motor by Grashof's rule: "crank-rocker", "drag link", "double rocker"...
/// Empty for other linkages.
std::string four_bar_kind(const LinkagePart& part);
/// Ways to restart a motor that is stopped at a dead point; empty if there are none.
std::vector<Cure> ways_on(const LinkagePart& part, LinkageRuntime& runtime);

// The Linkage lab's last ten seconds: plots, past poses and incidents.

inline constexpr const char* transmission_name = "transmission angle";
/// The plotted number against the displayed value of the leading joint: two pieces if that passes 360
/// degrees. None if there is no turn, or the number is that joint's own value.
std::vector<Curve> linkage_turn_curves(const Workspace& workspace, const PastCurve& curve);
/// The target whose point jumped in the last solve; the mouse's during a drag. Null if none did.
const LinkageTarget* jumped_target(const LinkagePart& part);

}  // namespace tendril::app
