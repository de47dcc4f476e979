#include "app/document/units.hpp"
#include "app/labs/rig/panels.hpp"

namespace tendril::app {

Verdict rig_verdict(const RigPart& part) {
    std::size_t on = 0, all = 0, warned = 0;
    std::string first;
    const auto& units = part.rig.definition().units;
    for (const UnitRow& row : unit_rows(part)) {
        ++all;
        if (!row.unit->enabled || !units[row.top].enabled) continue;
        ++on;
        const rig::Warning warning = part.state.units[row.at].warning;
        if (warning == rig::Warning::None) continue;
        if (warned++ == 0) first = row.unit->name + ": " + rig::message(warning) + ".";
    }
    if (all == 0) return {"No units", Verdict::Kind::Open, "Add a unit: it moves what the rig is made of."};
    if (warned > 0) return {count_text(warned, "unit") + " left out", Verdict::Kind::Bad, first};
    if (on == 0) return {"All units are off", Verdict::Kind::Open, "Switch one on in the list of units."};
    const std::string of = std::to_string(on) + " of " + count_text(all, "unit") + " switched on.";
    return {on == 1 ? "The unit ran" : "All units ran", Verdict::Kind::Good, of};
}

}  // namespace tendril::app
