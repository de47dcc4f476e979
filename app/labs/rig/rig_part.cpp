#include "app/labs/rig/rig_part.hpp"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <tendril/rig/workspace.hpp>

#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/part_cache.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_edit.hpp"

namespace tendril::app {
namespace {

bool same(const rig::Residual& a, const rig::Residual& b) {
    return a.metres == b.metres && a.radians == b.radians && a.scale == b.scale;
}

double most(const std::vector<rig::Residual>& elements, double rig::Residual::*of) {
    double worst = 0.0;
    for (const rig::Residual& each : elements) worst = std::max(worst, each.*of);
    return worst;
}

template <class T>
bool same_value(const std::shared_ptr<const T>& a, const std::shared_ptr<const T>& b) {
    return a == b || (a && b && *a == *b);
}

}  // namespace

bool BackwardLeft::operator==(const BackwardLeft& other) const {
    return bone == other.bone && stopped == other.stopped &&
           std::ranges::equal(elements, other.elements, same);
}

double BackwardLeft::worst_mm() const {
    return 1000.0 * most(elements, &rig::Residual::metres);
}
double BackwardLeft::worst_degrees() const {
    return glm::degrees(most(elements, &rig::Residual::radians));
}
double BackwardLeft::worst_scale() const {
    return most(elements, &rig::Residual::scale);
}

bool BackwardLeft::expressed() const {
    return worst_mm() <= min_shown_mm && worst_degrees() <= min_shown_degrees &&
           worst_scale() <= min_shown_scale;
}

double amount(const rig::Residual& left) {
    return left.metres + 0.3 * (left.radians + left.scale);
}

RigPart::RigPart() : RigPart(rig::Definition()) {}

RigPart::RigPart(rig::Definition definition)
    : rig(make_rig(std::move(definition))), state(rig.initial_state()) {
    rig::Workspace workspace(rig);
    moving = rig.solve(state.edit(), tick_seconds, workspace);
}

std::optional<std::size_t> RigSelection::only_element() const {
    return elements.several() ? std::nullopt : elements.active();
}

std::string RigPart::selected_element() const {
    const auto active = selected.elements.active();
    return active ? rig.definition().elements[*active].name : std::string();
}

RigPart first_rig() {
    return RigPart(rig_presets().front().definition);
}

bool RigPart::operator==(const RigPart& other) const {
    return moving == other.moving && backward == other.backward && selected == other.selected &&
           walks == other.walks && flips == other.flips && rates == other.rates &&
           same_value(clip, other.clip) && same_value(clip_left, other.clip_left) && take == other.take &&
           state == other.state && rig.definition() == other.rig.definition();
}

/// Keeps the current selection and flip rule.
std::shared_ptr<const Part> RigPart::at_moment(std::shared_ptr<const Part> then) const {
    const auto& earlier = dynamic_cast<const RigPart&>(*then);
    if (earlier.selected == RigSelection{} && selected == RigSelection{} && earlier.flips == flips)
        return then;
    auto part = std::make_shared<RigPart>(earlier);
    part->flips = flips;
    select_as_in(*part, selected, rig);  // the selection holds definition indices
    return part;
}

std::size_t state_bytes(const rig::State& state) {
    constexpr std::size_t an_element = 750, a_unit = 200;
    std::size_t bytes = state.controls.size() * an_element + state.units.size() * a_unit;
    for (const rig::UnitState& unit : state.units) bytes += unit.memory.size() * sizeof(rig::UnitMemory);
    return bytes;
}

/// Approximate. The compiled rig is about as large as its definition.
std::size_t RigPart::bytes() const {
    constexpr std::size_t an_element = 750, a_unit = 800;
    std::size_t shared = clip ? share_of(clip, clip->poses.size() * sizeof(ClipPose)) : 0;
    if (take.keys) shared += share_of(take.keys, take.keys->size() * sizeof(TakeKey));
    if (take.start) shared += share_of(take.start, state_bytes(*take.start));
    if (clip_left) shared += share_of(clip_left, clip_left->done() * sizeof(FrameLeft));
    if (last_solved) shared += share_of(last_solved, state_bytes(*last_solved));
    return sizeof(*this) + shared + state->controls.size() * an_element + state->units.size() * a_unit +
           state_bytes(state) + selected.elements.all().size() * sizeof(std::size_t);
}

}  // namespace tendril::app
