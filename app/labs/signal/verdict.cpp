#include <cctype>
#include <cmath>

#include "app/document/units.hpp"
#include "app/labs/signal/panels.hpp"

namespace tendril::app {

Verdict signal_verdict(const SignalPart& part, const signal::Measures& whole) {
    if (enabled_filters(part).empty())
        return {"No filter is on", Verdict::Kind::Open, "The output is the input."};
    if (whole.following == signal::Following::Unstable)
        return {"Runs away", Verdict::Kind::Bad, "The output leaves the input behind, ever farther."};
    if (whole.following == signal::Following::DoesNotFollow)
        return {"Does not follow", Verdict::Kind::Bad, "No shift in time makes the output like the input."};
    std::string why;
    const auto add = [&](const std::string& what) { why += (why.empty() ? "" : ", ") + what; };
    if (whole.lag)
        add(std::abs(*whole.lag) < 5e-5 ? "without lag" : si_text(*whole.lag, "s") + " behind the input");
    if (whole.overshoot) {
        add(*whole.overshoot < 5e-4 ? "without overshoot"
                                    : "overshoots by " + fixed_text(100.0 * *whole.overshoot, 1) + " %");
    }
    if (!why.empty())
        why[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(why[0]))), why += '.';
    if (whole.settling_time)
        return {"Settles in " + si_text(*whole.settling_time, "s"), Verdict::Kind::Good, why};
    if (whole.overshoot)
        return {"Does not settle", Verdict::Kind::Bad, "It still moves when the input moves on. " + why};
    if (whole.following == signal::Following::Follows) return {"Follows", Verdict::Kind::Good, why};
    return {"Nothing to follow yet", Verdict::Kind::Open, "The input has not changed."};
}

}  // namespace tendril::app
