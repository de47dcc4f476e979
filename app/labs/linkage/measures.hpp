// What is read off a linkage in its pose: values as a person reads them, angles, how well the coupler pushes,
// and why a motor stops.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/incident.hpp"
#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

/// Whether the joint of that link turns: its values are angles.
bool turns(const LinkagePart& part, std::string_view joint);
/// A value or speed of the joint as files, commands and panels have it, in degrees or metres; and back.
double in_degrees(const LinkagePart& part, std::string_view joint, double value);
double from_degrees(const LinkagePart& part, std::string_view joint, double value);
/// Runs the joint at a speed, degrees or metres a second.
CommandCall motor_call(const LinkagePart& part, const std::string& joint, ArgumentValue speed);

/// A joint's value as it is shown: degrees or metres. An angle in the plane without a range is that in its
/// turn, 0 to 360.
struct ShownValue {
    double value = 0.0;
    int turns = 0;  ///< whole ones before it
};
ShownValue shown_value(const LinkagePart& part, std::string_view joint, double value);
/// "43.0 degrees", "0.250 m"
std::string value_text(const LinkagePart& part, std::string_view joint, double value);

/// The angle between two bars at a point of the sketch, of two rigid bodies if two meet there: degrees, 0 to
/// 180. A single bar, or one body on a pin, is measured from +X. NaN if there is no angle.
double angle_at(const LinkagePart& part, std::string_view point);

/// Below this a coupler pushes poorly: the usual limit in books on mechanisms.
inline constexpr double poor_transmission = 40.0;
/// Between the coupler and what it drives, 0 to 90 degrees: the nearer to 90, the better it pushes. The
/// smallest if a crank drives several. NaN if no motor drives a four-bar or slider-crank.
double transmission_angle(const LinkagePart& part);
/// The smallest through a turn, and at which value of the joint that leads it. None where there is no turn.
struct WorstTransmission {
    double degrees = 90.0;
    double value = 0.0;
};
std::optional<WorstTransmission> worst_transmission(const LinkagePart& part, const LinkageTurn& turn);
/// The part in a pose of its turn: for what is read off the places of its links.
class PartInTurn {
  public:
    explicit PartInTurn(const LinkagePart& part) : part_(std::make_shared<LinkagePart>(part)) {}
    const std::shared_ptr<LinkagePart>& at(const LinkageTurn::Pose& pose) {
        part_->links = pose.links;
        return part_;
    }

  private:
    std::shared_ptr<LinkagePart> part_;
};

/// Degrees of freedom, with those of what floats: three for each piece that no pin holds, and its own.
ik::LinkageFreedom freedom_of(const LinkagePart& part);

/// Why the stopped motor, or else the first, is at a dead point: found from the forces by which the rest of
/// the linkage balances its torque. Two bodies that two joints hold each are in line, or the forces on one
/// that three hold meet. A body is all bars that triangles join.
struct DeadPoint {
    std::vector<std::array<std::size_t, 2>> lines{};  ///< each from one point of the sketch to another
    std::string text{};                               ///< "B, C and D are in line"
};
/// `within`: degrees of a joint off the dead point, roughly. None in space, and where more than three forces
/// balance.
std::optional<DeadPoint> dead_point(const LinkagePart& part, LinkageRuntime& runtime, double within = 4.0);
/// Its text, or empty.
std::string dead_point_reason(const LinkagePart& part, LinkageRuntime& runtime, double within = 4.0);
/// "Crank at 43.0 degrees"
std::string stop_text(const LinkagePart& part);
/// What a four-bar with a motor is by Grashof's rule: "crank-rocker", "drag link", "double rocker"... Empty:
/// it is another linkage.
std::string four_bar_kind(const LinkagePart& part);
/// Metres: with a crank between these two a motor turns all round.
struct RoundCranks {
    double shortest = 0.0;  ///< 0 but for a drag link, whose crank is longer than its ground
    double longest = 0.0;
};
/// Those of a four-bar (by Grashof's rule) or slider-crank whose crank stops at a dead point: the nearest
/// that are shorter. None if the other bars allow none, or it is another linkage.
std::optional<RoundCranks> shorter_round_cranks(const LinkagePart& part);
/// What lets a motor that stands at a dead point go on. Empty: none does.
std::vector<Cure> ways_on(const LinkagePart& part);

}  // namespace tendril::app
