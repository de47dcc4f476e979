// The Rig lab's last ten seconds: plots of an element's rotation, relative to its parent and initial pose;
// earlier poses; incidents; and each unit's contribution to an element.
#include "app/labs/kit/past.hpp"

#include <imgui.h>
#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/io/text.hpp"
#include "app/labs/kit/limit_shape.hpp"
#include "app/labs/rig/draw.hpp"
#include "app/labs/rig/flips.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/rig_part.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "app/labs/rig/values.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

/// The element to plot; empty in a rig without elements.
std::string plotted_element(const RigPart& part) {
    if (part.selected.elements.active()) return part.selected_element();
    const auto& elements = part.rig.definition().elements;
    const auto is_bone = [&](const std::string& name) {
        const auto at = part.rig.element(name);
        return at && elements[*at].kind == rig::ElementKind::Bone;
    };
    const rig::Element* first = nullptr;
    for (const rig::Element& each : elements) {
        if (!is_bone(each.name)) continue;
        if (is_bone(each.parent)) return each.name;
        if (first == nullptr) first = &each;
    }
    if (first == nullptr && !elements.empty()) first = &elements.front();
    return first != nullptr ? first->name : std::string();
}

/// The direction in which a bone is drawn at rest, in its own frame: towards its child bones; without any,
/// away from its parent bone; without that, up.
glm::dvec3 direction(const rig::Definition& definition, const rig::Element& bone) {
    glm::dvec3 sum(0.0);
    for (const rig::Element& each : definition.elements)
        if (each.parent == bone.name && each.kind == rig::ElementKind::Bone) sum += each.initial.translation;
    if (glm::length(sum) > 1e-9) return sum;
    const auto is_its_parent = [&](const rig::Element& each) {
        return each.name == bone.parent && each.kind == rig::ElementKind::Bone;
    };
    const auto& elements = definition.elements;
    const bool led = std::any_of(elements.begin(), elements.end(), is_its_parent) &&
                     glm::length(bone.initial.translation) > 1e-9;
    return led ? bone.initial.translation : glm::dvec3(0.0, 1.0, 0.0);
}

glm::dquat local_rotation(const rig::Hierarchy& elements, rig::ElementId id) {
    if (const auto known = elements.known(id, rig::Space::Local)) return known->rotation;
    rig::Hierarchy resolved = elements;
    return resolved.get(id, rig::Space::Local).rotation;
}

/// The element's rotation relative to its parent, from its initial pose; only for bones, unless `any`.
std::optional<JointTurn> turn_of(const RigPart& part, const std::string& name, bool any) {
    const auto at = part.rig.element(name);
    if (!at) return std::nullopt;
    const rig::Element& element = part.rig.definition().elements[*at];
    const bool bone = element.kind == rig::ElementKind::Bone;
    if (!bone && !any) return std::nullopt;
    const glm::dquat now = local_rotation(part.state->elements, part.rig.id(*at));
    return joint_turn(glm::conjugate(element.initial.rotation) * now,
                      bone ? direction(part.rig.definition(), element) : glm::dvec3(0, 1, 0));
}

PastCurve turn_curve(const Workspace& workspace, const char* what, double JointTurn::*number) {
    const std::string element = plotted_element(rig_part(workspace));
    const bool any = number == &JointTurn::angle;
    return {.name = what + element,
            .missing = element.empty()
                           ? "The rig has no elements: add one."
                           : element + " has no swing and twist: select a bone, or plot the angle.",
            .value = [=](const SharedPart& part) {
                const auto turn = turn_of(part_as<RigPart>(part), element, any);
                return turn ? (*turn).*number : no_value;
            }};
}

bool same_elements(const Part& then, const Part& now) {
    const auto elements = [](const Part& part) -> const auto& {
        return part_as<RigPart>(part).rig.definition().elements;
    };
    return std::equal(elements(then).begin(), elements(then).end(), elements(now).begin(),
                      elements(now).end(), [](const rig::Element& a, const rig::Element& b) {
                          return a.kind == b.kind && a.name == b.name && a.parent == b.parent;
                      });
}

/// A line to each end of a bone.
PoseLines lines_of(const Workspace&, const SharedPart& part) {
    const auto& then = part_as<RigPart>(part);
    PoseLines lines;
    if (then.state->controls.size() > 2 * max_ghost_lines) return lines;
    rig::Hierarchy elements = then.state->elements;
    elements.resolve_all();
    for (std::size_t i = 0; i < then.state->controls.size(); ++i) {
        const rig::ElementId id = then.rig.id(i);
        if (elements.kind(id) != rig::ElementKind::Bone) continue;
        const glm::vec3 from(elements.known(id, rig::Space::Global)->translation);
        for (const glm::dvec3& end : bone_ends(elements, id)) lines.emplace_back(from, glm::vec3(end));
    }
    return lines;
}

constexpr std::size_t max_of_a_kind = 8;  ///< per tick: a rig may have thousands of bones

void add_flips(const RigPart& before, const RigPart& after, std::vector<Incident>& incidents) {
    if (before.edited || after.edited) return;
    const rig::State &was = before.solved_state(), &is = after.solved_state();
    if (was.controls == is.controls && !before.moving) return;
    for (const RigFlip& flip : rig_flips(after, was, is, max_of_a_kind))
        incidents.push_back({.kind = Incident::Kind::Flip,
                             .joint = flip.element,
                             .name = after.rig.definition().elements[flip.element].name,
                             .degrees = static_cast<float>(glm::degrees(flip.radians)),
                             .cause = flip.cause});
}

void add_reports(const RigPart& before, const RigPart& after, std::vector<Incident>& incidents) {
    std::size_t count = 0;
    for (const UnitRow& row : unit_rows(after)) {
        const rig::Warning was = before.state->units[row.at].warning, is = after.state->units[row.at].warning;
        if (is == was || is == rig::Warning::None) continue;
        if (++count > max_of_a_kind) return;
        incidents.push_back({.kind = Incident::Kind::Status,
                             .name = row.unit->name,
                             .cause = "unit " + row.unit->name + " has a problem: " + rig::message(is)});
    }
}

/// One number of a control's value.
std::optional<double> part_of(const rig::Value& value, int axis) {
    if (const auto* number = std::get_if<double>(&value))
        return axis == 0 ? std::optional(*number) : std::nullopt;
    if (const auto* vector = std::get_if<glm::dvec3>(&value)) return (*vector)[axis];
    if (const auto* pose = std::get_if<rig::Transform>(&value)) return pose->translation[axis];
    return std::nullopt;
}

int axis_count(rig::ControlKind kind) {
    constexpr int counts[] = {3, 3, 0, 1, 0, 2};
    return counts[static_cast<std::size_t>(kind)];
}

/// "its maximum is 1.00", "its minimum is 0.20 m along y"
std::string limit_text(const rig::Control& control, int axis, bool maximum) {
    const double at = (maximum ? *control.maximum : *control.minimum)[axis];
    std::string text = (maximum ? "its maximum is " : "its minimum is ") + fixed_text(at, 2);
    if (control.kind == rig::ControlKind::Float) return text;
    const int along =
        control.kind == rig::ControlKind::Vector2d ? control.axes[static_cast<std::size_t>(axis)] : axis;
    return text + " m along " + std::array{"x", "y", "z"}[static_cast<std::size_t>(along)];
}

/// True if one of its numbers is at its limit. An empty range has no limits.
bool at_limit(const rig::Control& control, const rig::Value& value, int axis, bool maximum) {
    const auto& limit = maximum ? control.maximum : control.minimum;
    if (!limit) return false;
    if (control.minimum && control.maximum && (*control.minimum)[axis] == (*control.maximum)[axis])
        return false;
    const auto number = part_of(value, axis);
    return number && *number == (*limit)[axis];
}

void add_limits(const RigPart& before, const RigPart& after, std::vector<Incident>& incidents) {
    if (before.state->controls == after.state->controls) return;
    std::size_t count = 0;
    const auto& elements = after.rig.definition().elements;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (!elements[i].control) continue;
        const rig::Control& control = *elements[i].control;
        for (int axis = 0; axis < axis_count(control.kind); ++axis)
            for (const bool maximum : {false, true}) {
                const bool was = at_limit(control, before.state->controls[i], axis, maximum),
                           is = at_limit(control, after.state->controls[i], axis, maximum);
                if (was == is || ++count > max_of_a_kind) continue;
                incidents.push_back({.kind = Incident::Kind::Limit,
                                     .joint = i,
                                     .name = elements[i].name,
                                     .cause = "control " + elements[i].name +
                                              (is ? " reached its limit: " : " left its limit: ") +
                                              limit_text(control, axis, maximum)});
            }
    }
}

/// Flips, unit warnings, controls at their limits. Flips are reported only between two solves between which
/// only controls were set, and only the bone that rotated furthest for each unit.
std::vector<Incident> incidents_of(const Workspace&, const Part& was, const Part& is) {
    const auto &before = part_as<RigPart>(was), &after = part_as<RigPart>(is);
    if (&before.rig.definition() != &after.rig.definition()) return {};
    std::vector<Incident> incidents;
    add_flips(before, after, incidents);
    add_reports(before, after, incidents);
    add_limits(before, after, incidents);
    return incidents;
}

}  // namespace

const Past& rig_past() {
    static const Past past{
        .lab = rig_lab,
        .what = "rig",
        .probes = {{"swing", "swing of a bone",
                    [](const Workspace& w) { return turn_curve(w, "swing of ", &JointTurn::swing); }},
                   {"twist", "twist of a bone",
                    [](const Workspace& w) { return turn_curve(w, "twist of ", &JointTurn::twist); }},
                   {"angle", "angle of an element",
                    [](const Workspace& w) { return turn_curve(w, "angle of ", &JointTurn::angle); }}},
        .plot_help =
            "Plotted below the scene for the last ten seconds: how the selected element is "
            "turned within its parent, from its initial pose",
        .ghosts_help = "Shows the bones at every half second",
        .pose = lines_of,
        .same_joints = same_elements,
        .incidents = incidents_of};
    return past;
}

// Why a bone is where it is: each unit's contribution to the selected element, in order.

namespace {

std::string added_text(const rig::Contribution& step) {
    std::string text =
        length_text(step.metres) + "  " + fixed_text(glm::degrees(step.radians), 1) + "\xC2\xB0";
    return step.before.scale == step.after.scale ? text : text + ", scale";
}

/// Ignores changes by rounding.
bool touched(const rig::Contribution& step) {
    constexpr double enough = 1e-7;
    const glm::dvec3 scale = glm::abs(step.after.scale - step.before.scale);
    return step.metres > enough || step.radians > enough || std::max({scale.x, scale.y, scale.z}) > enough;
}

void unit_line(const RigPanel& panel, const rig::Unit& unit, const rig::Contribution& step) {
    ImGui::PushID(unit.name.c_str());
    switch_box(panel, unit);
    const bool on = unit.enabled;
    ImGui::SameLine(0.0f, 0.5f * ImGui::GetFontSize());
    const std::string added = !on ? "muted" : touched(step) ? added_text(step) : "nothing";
    const float room =
        ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(added.c_str()).x - 0.6f * ImGui::GetFontSize();
    text_elided(unit.name, std::max(room, 3.0f * ImGui::GetFontSize()), !on || !touched(step));
    ImGui::SameLine();
    text_flush_right(added, !on || !touched(step));
    if (ImGui::IsItemHovered())
        tooltip("Adds " + value_text(step.change) + " in its own space.\nResult: " + value_text(step.after) +
                '.');
    ImGui::PopID();
}

void place_line(const char* title, const rig::Transform& pose) {
    ImGui::TextDisabled("%s", title);
    ImGui::SameLine();
    text_flush_right(vector_text(pose.translation, 3));
    if (ImGui::IsItemHovered()) tooltip(value_text(pose));
}

}  // namespace

void why_rows(const RigPanel& panel) {
    const auto element = panel.part.selected.elements.active();
    if (!element) return;
    const rig::Element& selected = panel.part.rig.definition().elements[*element];
    const std::string title =
        selected.kind == rig::ElementKind::Bone ? "Why is this bone here?" : "Why is it here?";
    const PanelSection ids(title.c_str());
    const rig::Explanation& why = panel.runtime.explanation(panel.workspace, *element);
    const rig::Units& units = panel.part.rig.definition().units;
    place_line("before any unit", why.input);
    std::size_t untouched = 0;
    bool& all = panel.runtime.panel.all_units;
    for (std::size_t i = 0; i < why.units.size(); ++i) {
        const bool idle = units[i].enabled && !touched(why.units[i]);
        untouched += idle;
        if (!idle || all) unit_line(panel, units[i], why.units[i]);
    }
    if (untouched > 0) {
        const std::string count = count_text(untouched, "unit") + " did not change it";
        if (row_button((all ? "Hide idle units" : count).c_str(), 1, true,
                       all ? "Lists only the units that changed it" : "Lists every unit"))
            all = !all;
        end_row();
    }
    place_line("where it is", why.result);
}

}  // namespace tendril::app
