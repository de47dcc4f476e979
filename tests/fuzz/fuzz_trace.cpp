// A trace is refused with a std::runtime_error, or read up to where it is damaged; every incident lies within
// the frames that were read, and its amount is a number.
#include <cmath>
#include <sstream>

#include "app/io/trace/trace.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril;
using tendril::fuzz::check;

FUZZ_TARGET(trace) {
    std::istringstream in{std::string(text)};
    try {
        app::TraceReader reader(in);
        check(std::isfinite(reader.fps()) && reader.fps() > 0.0, "frames a second are a number");
        for (const auto& chain : app::find_incidents(reader).chains)
            for (const ik::ChainIncident& each : chain.incidents) {
                check(each.frame <= each.last_frame && each.last_frame < chain.frames + 1,
                      "an incident lies in the trace");
                check(!std::isnan(each.amount) && !std::isnan(each.hertz), "an amount is a number");
            }
    } catch (const std::runtime_error& error) {
        check(*error.what() != 0, "a refusal says why");
    }
}
