// How an element is turned, over the last ten seconds: within its parent, from its initial pose; and the
// poses of them.
#include "app/labs/rig/past.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "app/labs/kit/joint_turn.hpp"
#include "app/labs/rig/figure.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

enum class Number { Swing, Twist, Angle };  // in the order of rig_past()

const RigPart& rig_of(const SharedPart& part) {
    return dynamic_cast<const RigPart&>(*part);
}

/// The one that is plotted; empty in a rig without elements.
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

/// Where a bone points at rest, in its own frame, as it is drawn: to the bones below it, else on the way that
/// led to it from another bone, else up.
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

double value_of(Number what, const RigPart& part, const std::string& name) {
    const auto at = part.rig.element(name);
    if (!at) return nothing;
    const rig::Element& element = part.rig.definition().elements[*at];
    const bool bone = element.kind == rig::ElementKind::Bone;
    if (!bone && what != Number::Angle) return nothing;
    const glm::dquat now = local_rotation(part.state.elements, part.rig.id(*at));
    const JointTurn turn = joint_turn(glm::conjugate(element.initial.rotation) * now,
                                      bone ? direction(part.rig.definition(), element) : glm::dvec3(0, 1, 0));
    return what == Number::Swing ? turn.swing : what == Number::Twist ? turn.twist : turn.angle;
}

bool same_elements(const Part& then, const Part& now) {
    const auto elements = [](const Part& part) -> const auto& {
        return dynamic_cast<const RigPart&>(part).rig.definition().elements;
    };
    return std::equal(elements(then).begin(), elements(then).end(), elements(now).begin(),
                      elements(now).end(), [](const rig::Element& a, const rig::Element& b) {
                          return a.kind == b.kind && a.name == b.name && a.parent == b.parent;
                      });
}

}  // namespace

PastView rig_past() {
    return past_view(
        rig_lab, "rig",
        {{"swing", "swing of a bone"}, {"twist", "twist of a bone"}, {"angle", "angle of an element"}},
        same_elements);
}

std::optional<PastCurve> rig_past_curve(const Workspace& workspace) {
    const PastView view = rig_past();
    if (!view.plots(workspace.settings)) return std::nullopt;
    const auto what = static_cast<Number>(view.chosen(workspace.settings));
    const std::string element = plotted_element(rig_part(workspace));
    const std::string number = what == Number::Swing   ? "swing of "
                               : what == Number::Twist ? "twist of "
                                                       : "angle of ";
    return PastCurve{
        .name = number + element,
        .of = number + element,
        .missing = element.empty() ? "The rig has no element: add one."
                                   : element +
                                         " has no swing and twist: select a bone, or plot "
                                         "the angle.",
        .value = [what, element](const SharedPart& part) { return value_of(what, rig_of(part), element); }};
}

PoseLines rig_lines(const SharedPart& part) {
    const RigPart& then = rig_of(part);
    PoseLines lines;
    if (then.state.controls.size() > 2 * max_ghost_lines) return lines;
    rig::Hierarchy elements = then.state.elements;
    elements.resolve_all();
    for (std::size_t i = 0; i < then.state.controls.size(); ++i) {
        const rig::ElementId id = then.rig.id(i);
        if (elements.kind(id) != rig::ElementKind::Bone) continue;
        const glm::vec3 from(elements.known(id, rig::Space::Global)->translation);
        for (const glm::dvec3& end : bone_ends(elements, id)) lines.emplace_back(from, glm::vec3(end));
    }
    return lines;
}

}  // namespace tendril::app
