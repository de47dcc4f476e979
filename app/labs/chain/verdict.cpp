#include "app/labs/chain/verdict.hpp"

#include <glm/geometric.hpp>

#include "app/document/units.hpp"

namespace tendril::app {
namespace {

/// "0.23 m", or "4.1 mm" of what is small.
std::string distance_text(float metres) {
    const auto value = static_cast<double>(metres);
    return value >= 0.01 ? fixed_text(value, 2) + " m" : si_text(value, "m");
}

Verdict reach_verdict(const ChainPart& part) {
    if (!part.result) return {"Drag the target", Verdict::Kind::Open};
    const ik::Report& report = part.result->report;
    const std::string off = distance_text(report.residual);
    switch (report.status) {
        case ik::Status::Converged:
            return {"Reached", Verdict::Kind::Good};
        case ik::Status::Stretched:
            return {"Out of reach: " + off + " short", Verdict::Kind::Bad};
        case ik::Status::TooClose:
            return {"Too close: " + off + " off", Verdict::Kind::Bad};
        case ik::Status::Limited: {
            const auto& limit = part.result->active_limit;
            if (!limit) return {"Limited: " + off + " short", Verdict::Kind::Bad};
            return {"Limited by joint " + std::to_string(limit->joint) + ": " + off + " short",
                    Verdict::Kind::Bad};
        }
        case ik::Status::Stalled:
            return {"Stalled: " + off + " short", Verdict::Kind::Bad};
        case ik::Status::IterationLimit:
            return {"Not there yet: " + off + " to go", Verdict::Kind::Bad};
        case ik::Status::InvalidInput:
            break;
    }
    return {"Refused", Verdict::Kind::Bad};
}

/// Which joint a trailing mode brings to the target.
std::size_t led_joint(const ChainPart& part) {
    if (part.mode == ChainMode::Backward) return part.chain.size() - 1;
    return part.mode == ChainMode::WithIndex ? part.index : 0;
}

}  // namespace

Verdict chain_verdict(const ChainPart& part) {
    if (part.chain.empty()) return {"No joints", Verdict::Kind::Open};
    if (part.mode == ChainMode::Reach) return reach_verdict(part);
    const std::size_t joint = led_joint(part);
    const std::string end = joint == 0                       ? "Head"
                            : joint + 1 == part.chain.size() ? "Tail"
                                                             : "Joint " + std::to_string(joint);
    const float off = glm::distance(part.chain.position(joint), part.target);
    if (off <= std::max(part.tolerance, 1e-6f * part.chain.reach()))
        return {end + " on the target", Verdict::Kind::Good};
    return {end + " " + distance_text(off) + " from the target", Verdict::Kind::Open};
}

}  // namespace tendril::app
