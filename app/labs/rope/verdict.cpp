#include <algorithm>

#include "app/document/units.hpp"
#include "app/labs/rope/panels.hpp"

namespace tendril::app {

Verdict rope_verdict(const RopePart& part) {
    constexpr double seen = 0.01;  // of its length: from here on one sees that a rope is longer
    if (part.world->state().bodies.empty())
        return {"No ropes", Verdict::Kind::Open, "Add a rope, cloth or hair, or take a preset."};
    if (part.samples.empty())
        return {"Not moved yet", Verdict::Kind::Open, "Space runs the simulation, and pauses it."};
    const RopeSample last = part.samples.back();
    const auto error = static_cast<double>(last.error), before = static_cast<double>(last.stretch);
    const std::string percent = error < 1e-4 ? "under 0.01 %" : fixed_text(100.0 * error, error < 0.1 ? 2 : 0) + " %";
    if (error < seen) return {"Lengths hold", Verdict::Kind::Good, "The worst link is off by " + percent + "."};
    return {"Lengths off by " + percent, Verdict::Kind::Bad,
            before < 0.5 * error ? "Contact displaced links after the solve."
                                 : "The solver left it: more iterations or substeps hold lengths better."};
}

}  // namespace tendril::app
