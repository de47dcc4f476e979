#include <algorithm>

#include "app/document/units.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/panels.hpp"

namespace tendril::app {

Verdict rope_verdict(const RopePart& part) {
    constexpr double seen = 0.01;  // of its length: from here on one sees that a rope is longer
    if (part.world->state().bodies.empty())
        return {"No ropes", Verdict::Kind::Open, "Add a rope, cloth or hair, or take a preset."};
    if (part.samples.empty())
        return {"Not moved yet", Verdict::Kind::Open, "Space runs the simulation, and pauses it."};
    const RopeSample last = part.samples.back();
    const RopeReport report = last_second(part.samples);
    const auto error = static_cast<double>(last.error), before = static_cast<double>(last.stretch);
    if (report.inside > 0)
        return {"Inside a collider", Verdict::Kind::Bad,
                std::to_string(report.inside) + " particles found no way out. Move the body or a collider."};
    const std::string percent =
        error < 1e-4 ? "under 0.01 %" : fixed_text(100.0 * error, error < 0.1 ? 2 : 0) + " %";
    if (error >= seen) {
        const std::string off = "Lengths off by " + percent;
        if (const auto pulled = over_pulled(*part.world))
            return {off, Verdict::Kind::Bad,
                    "Pins of " + pulled->body + " are " + fixed_text(pulled->apart, 2) +
                        " m apart; between them it is " + fixed_text(pulled->length, 2) + " m long."};
        if (before < 0.5 * error)
            return {off, Verdict::Kind::Bad, "Contact displaced links after the solve."};
        return {off, Verdict::Kind::Bad,
                "The solver left it: more iterations or substeps hold lengths better."};
    }
    if (last.report.suspended > 0)
        return {"Neither held nor falling", Verdict::Kind::Bad,
                "Nothing holds or touches it, and it does not fall: it is at the edge of the world, or the "
                "solver "
                "holds it."};
    if (report.unconverged > 0)
        return {"Lengths hold; steps taken in part", Verdict::Kind::Open,
                "In the last second the solver did not converge " + std::to_string(report.unconverged) +
                    " times. Shorter substeps help."};
    return {"Lengths hold", Verdict::Kind::Good, "The worst link is off by " + percent + "."};
}

}  // namespace tendril::app
