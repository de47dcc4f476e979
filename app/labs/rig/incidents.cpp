#include "app/labs/rig/incidents.hpp"

#include <algorithm>
#include <array>
#include <glm/trigonometric.hpp>
#include <set>

#include "app/document/units.hpp"
#include "app/labs/rig/flip_cause.hpp"
#include "app/labs/rig/unit_inputs.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_of_a_kind = 8;  ///< in one tick: a rig may have thousands of bones

void add_flips(const RigPart& before, const RigPart& after, std::vector<Incident>& incidents) {
    if (before.edited || after.edited) return;
    const rig::State &was = before.solved_state(), &is = after.solved_state();
    if (was.controls == is.controls && !before.moving) return;
    std::vector<BoneFlip> flips = bone_flips(after.rig, was, is, after.flips);
    if (flips.empty()) return;
    flips.resize(std::min<std::size_t>(flips.size(), 16 * max_of_a_kind));
    const std::vector<FlipCause> causes = flip_causes(after, was, is, flips);
    std::set<std::optional<std::size_t>> told;
    for (std::size_t i = 0; i < flips.size() && told.size() < max_of_a_kind; ++i) {
        if (!told.insert(causes[i].unit).second) continue;
        incidents.push_back({.kind = Incident::Kind::Flip,
                             .joint = flips[i].element,
                             .name = after.rig.definition().elements[flips[i].element].name,
                             .degrees = static_cast<float>(glm::degrees(flips[i].radians)),
                             .cause = causes[i].text});
    }
}

void add_reports(const RigPart& before, const RigPart& after, std::vector<Incident>& incidents) {
    std::size_t count = 0;
    for (const UnitRow& row : unit_rows(after)) {
        const rig::Warning was = before.state.units[row.at].warning, is = after.state.units[row.at].warning;
        if (is == was || is == rig::Warning::None) continue;
        if (++count > max_of_a_kind) return;
        incidents.push_back({.kind = Incident::Kind::Status,
                             .name = row.unit->name,
                             .cause = "unit " + row.unit->name + " has a problem: " + rig::message(is)});
    }
}

/// A number, or one of the numbers, of a control.
std::optional<double> part_of(const rig::Value& value, int axis) {
    if (const auto* number = std::get_if<double>(&value))
        return axis == 0 ? std::optional(*number) : std::nullopt;
    if (const auto* vector = std::get_if<glm::dvec3>(&value)) return (*vector)[axis];
    if (const auto* pose = std::get_if<rig::Transform>(&value)) return pose->translation[axis];
    return std::nullopt;
}

int axis_count(rig::ControlKind kind) {
    switch (kind) {
        case rig::ControlKind::Float:
            return 1;
        case rig::ControlKind::Vector2d:
            return 2;
        case rig::ControlKind::Position:
        case rig::ControlKind::Transform:
            return 3;
        default:
            return 0;
    }
}

/// "maximum 1.00", "minimum 0.20 m along y"
std::string limit_text(const rig::Control& control, int axis, bool maximum) {
    const double at = (maximum ? *control.maximum : *control.minimum)[axis];
    std::string text = (maximum ? "its maximum is " : "its minimum is ") + fixed_text(at, 2);
    if (control.kind == rig::ControlKind::Float) return text;
    const int along =
        control.kind == rig::ControlKind::Vector2d ? control.axes[static_cast<std::size_t>(axis)] : axis;
    return text + " m along " + std::array{"x", "y", "z"}[static_cast<std::size_t>(along)];
}

/// At the limit of one of its numbers; a range of no length is none.
bool at_limit(const rig::Control& control, const rig::Value& value, int axis, bool maximum) {
    const auto& limit = maximum ? control.maximum : control.minimum;
    if (!limit) return false;
    if (control.minimum && control.maximum && (*control.minimum)[axis] == (*control.maximum)[axis])
        return false;
    const auto number = part_of(value, axis);
    return number && *number == (*limit)[axis];
}

void add_limits(const RigPart& before, const RigPart& after, std::vector<Incident>& incidents) {
    if (before.state.controls == after.state.controls) return;
    std::size_t count = 0;
    const auto& elements = after.rig.definition().elements;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (!elements[i].control) continue;
        const rig::Control& control = *elements[i].control;
        for (int axis = 0; axis < axis_count(control.kind); ++axis)
            for (const bool maximum : {false, true}) {
                const bool was = at_limit(control, before.state.controls[i], axis, maximum),
                           is = at_limit(control, after.state.controls[i], axis, maximum);
                if (was == is || ++count > max_of_a_kind) continue;
                incidents.push_back({.kind = Incident::Kind::Limit,
                                     .joint = i,
                                     .name = elements[i].name,
                                     .cause = "control " + elements[i].name +
                                              (is ? " came to its limit: " : " left its limit: ") +
                                              limit_text(control, axis, maximum)});
            }
    }
}

}  // namespace

std::vector<Incident> rig_incidents(const RigPart& before, const RigPart& after) {
    if (&before.rig.definition() != &after.rig.definition()) return {};
    std::vector<Incident> incidents;
    add_flips(before, after, incidents);
    add_reports(before, after, incidents);
    add_limits(before, after, incidents);
    return incidents;
}

}  // namespace tendril::app
