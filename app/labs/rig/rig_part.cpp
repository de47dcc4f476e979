#include "app/labs/rig/rig_part.hpp"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <tendril/rig/workspace.hpp>

#include "app/labs/kit/require.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_edit.hpp"

namespace tendril::app {
namespace {

bool same(const rig::Residual& a, const rig::Residual& b) {
    return a.metres == b.metres && a.radians == b.radians && a.scale == b.scale;
}

}  // namespace

bool BackwardLeft::operator==(const BackwardLeft& other) const {
    return bone == other.bone && std::ranges::equal(elements, other.elements, same);
}

double BackwardLeft::worst_mm() const {
    double worst = 0.0;
    for (const rig::Residual& each : elements) worst = std::max(worst, 1000.0 * each.metres);
    return worst;
}

double BackwardLeft::worst_degrees() const {
    double worst = 0.0;
    for (const rig::Residual& each : elements) worst = std::max(worst, glm::degrees(each.radians));
    return worst;
}

RigPart::RigPart() : RigPart(rig::Definition()) {}

RigPart::RigPart(rig::Definition definition)
    : rig(make_rig(std::move(definition))), state(rig.initial_state()) {
    rig::Workspace workspace(rig);
    moving = rig.solve(state, tick_seconds, workspace);
}

RigPart first_rig() {
    return RigPart(rig_presets().front().make());
}

bool RigPart::operator==(const RigPart& other) const {
    return moving == other.moving && backward == other.backward && selected == other.selected &&
           rig.definition() == other.rig.definition() && state == other.state;
}

/// Roughly; what is compiled is as large again as what it was made of.
std::size_t RigPart::bytes() const {
    constexpr std::size_t an_element = 1'500, a_unit = 1'000;
    std::size_t memory = 0;
    for (const rig::UnitState& unit : state.units) memory += unit.memory.size() * sizeof(rig::UnitMemory);
    return sizeof(*this) + state.controls.size() * an_element + state.units.size() * a_unit + memory;
}

}  // namespace tendril::app
