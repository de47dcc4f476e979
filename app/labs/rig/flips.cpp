#include "app/labs/rig/flips.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <set>
#include <tendril/rig/workspace.hpp>

#include "app/io/text.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/unit_inputs.hpp"

namespace tendril::app {
namespace {

using ik::InputMove;

/// A control that changed. Its frames are global, before any unit moved it.
struct Moved {
    bool placed = false;  ///< it has a position
    rig::Transform from{}, to{};
    double share = 0.0;  ///< the changed fraction of its range; 1 for a toggled switch

    /// The angle is relative to the bone, which may move; the distance is the control's own.
    InputMove relative_to(const rig::Transform& was, const rig::Transform& is) const {
        InputMove move;
        if (placed)
            move = {
                .distance = glm::distance(from.translation, to.translation),
                .angle = ik::move_between(from.translation - was.translation, to.translation - is.translation)
                             .angle};
        move.turn = turn_between(from.rotation, to.rotation);
        move.share = share;
        return move;
    }
};

double changed_share(const rig::Control& control, const rig::Value& from, const rig::Value& to) {
    if (control.kind == rig::ControlKind::Bool) return from != to ? 1.0 : 0.0;
    if (control.kind != rig::ControlKind::Float) return 0.0;
    const double range = control.minimum && control.maximum ? control.maximum->x - control.minimum->x : 1.0,
                 change = std::abs(std::get<double>(to) - std::get<double>(from));
    return range > 0.0 ? change / range : change > 0.0 ? 1.0 : 0.0;
}

/// Controls that were set, and those whose parents moved them.
std::vector<Moved> moved_controls(const rig::Rig& rig, const rig::State& was, const rig::State& is) {
    using enum rig::ControlKind;
    std::vector<Moved> moved;
    const auto& elements = rig.definition().elements;
    if (was.controls == is.controls) return moved;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (!elements[i].control) continue;
        const rig::Control& control = *elements[i].control;
        moved.push_back({control.kind == Transform || control.kind == Position || control.kind == Vector2d,
                         rig.start_pose(was, i), rig.start_pose(is, i),
                         changed_share(control, was.controls[i], is.controls[i])});
    }
    return moved;
}

/// Diagonal of the bounding box of all bones, metres; 1 if that is empty.
double skeleton_size(const rig::Rig& rig, rig::State& state) {
    glm::dvec3 low(1e300), high(-1e300);
    for (std::size_t i = 0; i < state.controls.size(); ++i) {
        if (state.elements.kind(rig.id(i)) != rig::ElementKind::Bone) continue;
        const glm::dvec3 at = state.elements.get(rig.id(i), rig::Space::Global).translation;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const double size = low.x <= high.x ? glm::distance(low, high) : 0.0;
    return size > 0.0 ? size : 1.0;
}

/// Finds flips, without causes. The largest rotation first; among equals, the bone nearest the root.
std::vector<RigFlip> find_flips(const rig::Rig& rig, const rig::State& was, const rig::State& is,
                                const FlipRule& rule) {
    rig::State before = was, after = is;  // copies: reading computes pending poses
    const std::vector<Moved> controls = moved_controls(rig, before, after);
    std::vector<RigFlip> flips;
    std::optional<double> size;
    for (const std::size_t i : from_the_roots(rig, before.elements)) {
        if (before.elements.kind(rig.id(i)) != rig::ElementKind::Bone) continue;
        const rig::Transform from = before.elements.get(rig.id(i), rig::Space::Global),
                             to = after.elements.get(rig.id(i), rig::Space::Global);
        const double radians = turn_between(from.rotation, to.rotation);
        if (radians <= glm::radians(static_cast<double>(rule.degrees))) continue;
        if (!size) size = skeleton_size(rig, before);
        const bool explained = std::ranges::any_of(controls, [&](const Moved& each) {
            return ik::explains(each.relative_to(from, to), radians, *size, rule);
        });
        if (!explained) flips.push_back({i, radians});
    }
    std::ranges::stable_sort(flips, [](const RigFlip& a, const RigFlip& b) {
        constexpr double together = 1e-3;  // radians
        return std::round(a.radians / together) > std::round(b.radians / together);
    });
    return flips;
}

constexpr const char* not_known = "cause not known";

/// Observes a solve with a zero time step to find why bones flipped.
class Watched final : public rig::Observer {
  public:
    /// Keeps the rig just before and just after `unit`, if one is given.
    Watched(const RigPart& part, rig::State state, const std::vector<RigFlip>& flips, rig::Workspace& scratch,
            std::optional<std::size_t> unit = std::nullopt)
        : found(part), left(part), rig_(part.rig), flips_(flips), unit_(unit) {
        part.rig.solve(state, 0.0, scratch, this);
        found.state.edit().elements.resolve_all();
        left.state.edit().elements.resolve_all();
    }
    void begin(rig::State& state) override {
        row(state);
        if (unit_ == 0u) found.state = state;
    }
    void unit_done(std::size_t unit, rig::State& state) override {
        row(state);
        if (unit_ == unit + 1) found.state = state;
        if (unit_ == unit) left.state = state;
    }
    /// The last unit that turned the bone; none if no unit did.
    std::optional<std::size_t> last_unit(std::size_t flip) const {
        constexpr double touched = 1e-7;  // radians
        for (std::size_t row = rows.size(); row-- > 1;)
            if (turn_between(rows[row - 1][flip], rows[row][flip]) > touched) return row - 1;
        return std::nullopt;
    }

    RigPart found, left;
    std::vector<std::vector<glm::dquat>> rows;  ///< the bones' global rotations, at first and after each unit

  private:
    void row(rig::State& state) {
        std::vector<glm::dquat>& row = rows.emplace_back();
        for (const RigFlip& flip : flips_)
            row.push_back(state.elements.get(rig_.id(flip.element), rig::Space::Global).rotation);
    }

    const rig::Rig& rig_;
    const std::vector<RigFlip>& flips_;
    std::optional<std::size_t> unit_;
};

// Reasons for a bone's sudden rotation, by kind of unit.

using Cause = std::optional<std::string>;
constexpr float half_turn_margin = 0.17f;  ///< radians, about ten degrees

/// The inputs of a unit in one of the two solves.
class Given {
  public:
    Given(const rig::Unit& unit, const RigPart& part)
        : inputs_(unit_inputs(part, part.state->elements, unit)) {}

    const std::vector<UnitInput>& all() const { return inputs_; }
    const rig::Value* value(std::string_view path) const {
        const auto found = std::ranges::find(inputs_, path, &UnitInput::path);
        return found != inputs_.end() && found->value ? &*found->value : nullptr;
    }
    std::optional<glm::vec3> point(std::string_view path) const {
        const rig::Value* const given = value(path);
        if (!given) return std::nullopt;
        if (const auto* vector = std::get_if<glm::dvec3>(given)) return glm::vec3(*vector);
        if (const auto* pose = std::get_if<rig::Transform>(given)) return glm::vec3(pose->translation);
        return std::nullopt;
    }
    std::optional<glm::dquat> rotation(std::string_view path) const {
        const rig::Value* const given = value(path);
        if (!given) return std::nullopt;
        if (const auto* rotation = std::get_if<glm::dquat>(given)) return *rotation;
        if (const auto* pose = std::get_if<rig::Transform>(given)) return pose->rotation;
        return std::nullopt;
    }
    double number(std::string_view path, double otherwise) const {
        const rig::Value* const given = value(path);
        if (!given) return otherwise;
        if (const auto* on = std::get_if<bool>(given)) return *on ? 1.0 : 0.0;
        const auto* number = std::get_if<double>(given);
        return number ? *number : otherwise;
    }

  private:
    std::vector<UnitInput> inputs_;
};

struct Both {
    const rig::Unit& unit;
    const Watched &before, &after;
    Given was{unit, before.found}, is{unit, after.found};
    double radians = 0.0;
};

/// The library's warning, for the unit or one in its body.
Cause by_report(const Both& both) {
    const rig::State &was = both.before.left.state, &is = both.after.left.state;
    const auto top = unit_row(both.before.left, both.unit.name);
    for (const UnitRow& row : unit_rows(both.before.left)) {
        const rig::Warning before = was.units[row.at].warning, after = is.units[row.at].warning;
        if (row.top != top->top || before == after) continue;
        const std::string who = row.inner ? "in its body, " + row.unit->name + ": " : "";
        if (after != rig::Warning::None) return who + rig::message(after);
        return who + "no longer the case: " + rig::message(before);
    }
    return std::nullopt;
}

Cause by_switch(const Both& both) {
    const double was = both.was.number("/when", 1.0), is = both.is.number("/when", 1.0);
    if (was != is) return is > 0.0 ? "it was switched on" : "it was switched off";
    const double from = both.was.number("/weight", 1.0), to = both.is.number("/weight", 1.0);
    if (std::abs(to - from) < 0.1) return std::nullopt;
    return "its weight went from " + fixed_text(from, 2) + " to " + fixed_text(to, 2);
}

/// A rotation input that rotated at least half as far.
Cause by_input(const Both& both) {
    for (const UnitInput& input : both.was.all()) {
        if (input.literal()) continue;
        const auto from = both.was.rotation(input.path), to = both.is.rotation(input.path);
        if (!from || !to) continue;
        const double turn = turn_between(*from, *to);
        if (turn >= 0.5 * both.radians)
            return "its input " + input.title + ", from " + input.from + ", turned " +
                   fixed_text(glm::degrees(turn), 0) + " degrees";
    }
    return std::nullopt;
}

/// At half a turn there is no shortest direction: near it the axis of rotation can swing round, and the bone
/// rotates with it, by twice as much.
Cause by_half_turn(glm::vec3 from_was, glm::vec3 to_was, glm::vec3 from_is, glm::vec3 to_is, double radians) {
    const float furthest = std::max(ik::angle_between(from_was, to_was), ik::angle_between(from_is, to_is));
    const float axis = ik::angle_between(glm::cross(from_was, to_was), glm::cross(from_is, to_is));
    if (glm::pi<float>() - furthest > half_turn_margin || axis < 0.25f * static_cast<float>(radians))
        return std::nullopt;
    return "the target was about half a turn away, where neither way round is shorter";
}

/// Direction to an aim's target; none if unknown.
std::optional<glm::vec3> way_to(const Given& given, const rig::AimInputs& inputs, const std::string& path,
                                glm::vec3 from) {
    const auto target = given.point(path + "/target");
    if (!target) return std::nullopt;
    return inputs.kind == rig::AimTarget::Location ? *target - from : *target;
}

Cause by_aim(const Both& both, const rig::Transform& was, const rig::Transform& is,
             const rig::AimInputs& primary, const std::optional<rig::AimInputs>& secondary) {
    const glm::vec3 at_was(was.translation), at_is(is.translation);
    const auto first_was = way_to(both.was, primary, "/primary", at_was),
               first_is = way_to(both.is, primary, "/primary", at_is);
    const auto axis_was = both.was.point("/primary/axis"), axis_is = both.is.point("/primary/axis");
    if (!first_was || !first_is || !axis_was || !axis_is) return std::nullopt;
    rig::State scratch = both.before.found.state;
    const auto size = static_cast<float>(skeleton_size(both.before.found.rig, scratch));
    if (primary.kind == rig::AimTarget::Location &&
        distance_to(glm::vec3(0.0f), *first_was, *first_is) < 0.02f * size)
        return "the target went through the bone";
    if (secondary) {
        const auto second_was = way_to(both.was, *secondary, "/secondary", at_was),
                   second_is = way_to(both.is, *secondary, "/secondary", at_is);
        if (!second_was || !second_is) return std::nullopt;
        const ik::ReachPose before{{at_was}, at_was + *first_was, at_was + *second_was},
            after{{at_was}, at_was + *first_is, at_was + *second_is};
        const ik::PolePassage passage = ik::pole_passage(before, after);
        if (passage.passed) return "the second target crossed the line to the first";
        if (passage.close) return "the second target came close to the line to the first";
        return std::nullopt;  // the second target fixes the roll, so half turns do not matter
    }
    return by_half_turn(glm::vec3(was.rotation * glm::dvec3(*axis_was)), *first_was,
                        glm::vec3(is.rotation * glm::dvec3(*axis_is)), *first_is, both.radians);
}

/// The pose of the unit's item.
std::optional<rig::Transform> item_pose(const RigPart& part, const rig::Item& item) {
    const auto* const name = std::get_if<std::string>(&item.which);
    const auto at = name ? part.rig.element(*name) : std::nullopt;
    return at ? part.state->elements.known(part.rig.id(*at), rig::Space::Global) : std::nullopt;
}

/// The joints from root to tip.
std::vector<glm::vec3> joints_between(const RigPart& part, const rig::Item& root, const rig::Item& tip) {
    const rig::Hierarchy& tree = part.state->elements;
    const auto first = part.rig.element(std::get<std::string>(root.which)),
               last = part.rig.element(std::get<std::string>(tip.which));
    std::vector<glm::vec3> joints;
    if (!first || !last) return joints;
    for (rig::ElementId at = part.rig.id(*last); at; at = tree.parent(at)) {
        joints.insert(joints.begin(), glm::vec3(tree.known(at, rig::Space::Global)->translation));
        if (at == part.rig.id(*first)) break;
    }
    return joints;
}

std::optional<ik::ReachPose> reach_pose(const Given& given, const RigPart& found, const RigPart& left,
                                        const rig::Item& root, const rig::Item& tip) {
    const auto target = given.point("/target");
    ik::ReachPose pose{joints_between(left, root, tip), {}, given.point("/pole_target")};
    // Use the joints after the unit ran, which show how the chain is bent.
    if (!target || pose.joints.empty() || joints_between(found, root, tip).empty()) return std::nullopt;
    pose.target = *target;
    return pose;
}

Cause by_reach(const Both& both, const rig::Item& root, const rig::Item& tip) {
    const auto was = reach_pose(both.was, both.before.found, both.before.left, root, tip),
               is = reach_pose(both.is, both.after.found, both.after.left, root, tip);
    if (!was || !is) return std::nullopt;
    const ik::FlipCause cause = ik::flip_cause(*was, *is);
    if (cause == ik::FlipCause::Unexplained) return std::nullopt;
    return ik::text(cause);
}

Cause by_kind(const Both& both) {
    const rig::Operation& operation = both.unit.operation;
    if (const auto* aim = std::get_if<rig::Aim>(&operation)) {
        const auto was = item_pose(both.before.found, aim->item), is = item_pose(both.after.found, aim->item);
        return was && is ? by_aim(both, *was, *is, aim->primary, aim->secondary) : std::nullopt;
    }
    if (const auto* chain = std::get_if<rig::TwoBone>(&operation))
        return by_reach(both, chain->root, chain->tip);
    if (const auto* chain = std::get_if<rig::Fabrik>(&operation))
        return by_reach(both, chain->root, chain->tip);
    return std::nullopt;
}

/// The cause in this unit.
Cause unit_cause(const Both& both) {
    for (const auto& look : {by_report, by_switch, by_kind, by_input})
        if (Cause cause = look(both)) return cause;
    return std::nullopt;
}

}  // namespace

std::vector<RigFlip> rig_flips(const RigPart& part, const rig::State& was, const rig::State& is,
                               std::size_t most) {
    std::vector<RigFlip> flips = find_flips(part.rig, was, is, part.flips), reported;
    if (flips.empty()) return reported;
    flips.resize(std::min(flips.size(), 16 * most));
    const rig::Units& units = part.rig.definition().units;
    rig::Workspace scratch(part.rig);
    const Watched before(part, was, flips, scratch), after(part, is, flips, scratch);
    std::set<std::optional<std::size_t>> causing;
    for (std::size_t i = 0; i < flips.size() && reported.size() < most; ++i) {
        // The first unit after which the two solves differ by at least half the flip.
        std::optional<std::size_t> unit;
        for (std::size_t row = 1; row < std::min(before.rows.size(), after.rows.size()) && !unit; ++row)
            if (turn_between(before.rows[row][i], after.rows[row][i]) >= 0.5 * flips[i].radians)
                unit = row - 1;
        if (!causing.insert(unit).second) continue;
        RigFlip& flip = reported.emplace_back(flips[i]);
        flip.cause = not_known;
        if (!unit) continue;
        std::string who = "unit " + units[*unit].name;
        if (const auto last = after.last_unit(i); last && *last != *unit)
            who += " (unit " + units[*last].name + " wrote it last)";
        const Watched first(part, was, flips, scratch, unit), second(part, is, flips, scratch, unit);
        const Both both{.unit = units[*unit], .before = first, .after = second, .radians = flip.radians};
        flip.cause = who + ": " + unit_cause(both).value_or(not_known);
    }
    return reported;
}

}  // namespace tendril::app
